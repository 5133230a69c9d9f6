use cinesplat::lens::{EffectChoice, Unmet, is_known, names};

use super::stand::{call, called};

#[test]
fn choices_parse_and_unknown_names_fail() {
    assert_eq!("auto".parse(), Ok(EffectChoice::Auto));
    assert_eq!("off".parse(), Ok(EffectChoice::Off));
    let both = EffectChoice::These(vec!["vignette".to_owned(), "film-grain".to_owned()]);
    assert_eq!("vignette, film-grain".parse(), Ok(both));
    for wrong in ["", "blur", "auto,fog", "fog,,fog", "Fog"] {
        assert!(wrong.parse::<EffectChoice>().is_err(), "{wrong:?}");
    }
    assert!(names().all(is_known));
}

#[test]
fn every_call_leads_to_an_effect_or_to_a_reason() {
    let calls =
        [call("vignette", &[]), call("lens-flare", &[]), call("music", &[]), call("film-grain", &[("strength", 0.0)])];
    let sentences = |choice: &EffectChoice| {
        let called = called(&calls, choice);
        let effects: Vec<_> = called.effects.iter().map(|effect| effect.name).collect();
        let unmet: Vec<_> = called.unmet.iter().map(Unmet::sentence).collect();
        format!("{}\n{}", effects.join(" "), unmet.join("\n"))
    };
    insta::assert_snapshot!(sentences(&EffectChoice::Auto), @r"
    vignette
    film-grain requested by 'the test': left out, its settings do nothing
    lens-flare requested by 'the test': not implemented, rendered without it
    music requested by 'the test': not an effect of the camera, rendered without it
    ");
    insta::assert_snapshot!(sentences(&EffectChoice::Off), @r"

    film-grain requested by 'the test': disabled by --effects
    vignette requested by 'the test': disabled by --effects
    lens-flare requested by 'the test': disabled by --effects
    music requested by 'the test': not an effect of the camera, rendered without it
    ");
    insta::assert_snapshot!(sentences(&"handheld".parse().unwrap()), @r"
    handheld
    film-grain requested by 'the test': disabled by --effects
    vignette requested by 'the test': disabled by --effects
    lens-flare requested by 'the test': disabled by --effects
    music requested by 'the test': not an effect of the camera, rendered without it
    ");
}

#[test]
fn settings_make_the_same_effect_again() {
    for name in names().filter(|name| !cinesplat::lens::NOT_BUILT.contains(name)) {
        let Some(first) = called(&[call(name, &[])], &EffectChoice::Auto).effects.pop() else { continue };
        let again = called(&[call(name, &first.effect.settings())], &EffectChoice::Auto).effects.pop().unwrap();
        assert_eq!(first, again);
    }
}
