//! Decisions on requested effects.

use cinesplat::lens::{Decision, Effect, EffectCall, EffectChoice, Verdict, decide};
use strum::VariantArray;

fn call(kind: &str, because: &str) -> EffectCall {
    EffectCall { kind: kind.into(), because: because.to_owned() }
}

#[test]
fn choices_parse_and_unknown_names_fail() {
    assert_eq!("auto".parse(), Ok(EffectChoice::Auto));
    assert_eq!("off".parse(), Ok(EffectChoice::Off));
    let both = EffectChoice::These(vec![Effect::MotionBlur, Effect::Fog]);
    assert_eq!("motion-blur, fog".parse(), Ok(both));
    for wrong in ["", "blur", "auto,fog", "fog,,fog", "Fog"] {
        assert!(wrong.parse::<EffectChoice>().is_err(), "{wrong:?}");
    }
    assert!(Effect::VARIANTS.iter().all(|&effect| effect.as_ref().parse() == Ok(effect)));
}

#[test]
fn every_request_gets_a_verdict_in_words() {
    let calls = [call("depth-of-field", "shallow focus"), call("music", "soundtrack")];
    let sentences = |choice| decide(&choice, &calls).iter().map(Decision::sentence).collect::<Vec<_>>().join("\n");
    insta::assert_snapshot!(sentences(EffectChoice::Auto), @r"
    depth-of-field requested by 'shallow focus': not implemented, rendered without it
    music requested by 'soundtrack': not an effect of the lens, rendered without it
    ");
    insta::assert_snapshot!(sentences(EffectChoice::Off), @r"
    depth-of-field requested by 'shallow focus': disabled by --effects
    music requested by 'soundtrack': not an effect of the lens, rendered without it
    ");
    insta::assert_snapshot!(sentences(EffectChoice::These(vec![Effect::Fog])), @r"
    depth-of-field requested by 'shallow focus': disabled by --effects
    music requested by 'soundtrack': not an effect of the lens, rendered without it
    fog requested by '--effects': not implemented, rendered without it
    ");
}

#[test]
fn the_report_lists_missing_effects_but_not_disabled_ones() {
    let calls = [call("depth-of-field", "bokeh"), call("rain", "raining")];
    let lines =
        |choice| decide(&choice, &calls).iter().filter_map(Decision::report_line).map(|l| l.met).collect::<Vec<_>>();
    assert_eq!(lines(EffectChoice::Auto), [false, false]);
    assert_eq!(lines(EffectChoice::Off), [false]);
    let requests = |choice| decide(&choice, &calls).iter().filter_map(Decision::request).count();
    assert_eq!((requests(EffectChoice::Auto), requests(EffectChoice::Off)), (1, 0));
    assert_eq!(decide(&EffectChoice::Off, &calls)[1].verdict, Verdict::NotAnEffect);
}
