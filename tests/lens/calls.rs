use cinesplat::lens::{EffectChoice, Unmet, is_known, names, unknown_names};
use cinesplat::trajectory::EffectRequest;

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
        [call("vignette", &[]), call("stereo", &[]), call("music", &[]), call("film-grain", &[("strength", 0.0)])];
    let sentences = |choice: &EffectChoice| {
        let called = called(&calls, choice);
        let effects: Vec<_> = called.effects.iter().map(|effect| effect.name).collect();
        let unmet: Vec<_> = called.unmet.iter().map(Unmet::sentence).collect();
        format!("{}\n{}", effects.join(" "), unmet.join("\n"))
    };
    insta::assert_snapshot!(sentences(&EffectChoice::Auto), @r"
    stereo vignette
    film-grain requested by 'the test': left out, its settings do nothing
    music requested by 'the test': not an effect of the camera, rendered without it
    ");
    insta::assert_snapshot!(sentences(&EffectChoice::Off), @r"

    film-grain requested by 'the test': disabled by --effects
    stereo requested by 'the test': disabled by --effects
    vignette requested by 'the test': disabled by --effects
    music requested by 'the test': not an effect of the camera, rendered without it
    ");
    insta::assert_snapshot!(sentences(&"handheld".parse().unwrap()), @r"
    handheld
    film-grain requested by 'the test': disabled by --effects
    stereo requested by 'the test': disabled by --effects
    vignette requested by 'the test': disabled by --effects
    music requested by 'the test': not an effect of the camera, rendered without it
    ");
}

#[test]
fn settings_make_the_same_effect_again() {
    for name in names() {
        let Some(first) = called(&[call(name, &[])], &EffectChoice::Auto).effects.pop() else { continue };
        let again = called(&[call(name, &first.effect.settings())], &EffectChoice::Auto).effects.pop().unwrap();
        assert_eq!(first, again);
    }
}

/// Together they gave garbage: each one took the pinhole picture that the others need.
#[test]
fn panorama_fisheye_and_distortion_called_together_give_garbage() {
    let names = ["lens-distortion", "panorama", "fisheye", "stereo", "tilt-shift"];
    let of = |names: &[&str]| {
        let calls: Vec<_> = names.iter().map(|name| call(name, &[])).collect();
        let called = called(&calls, &EffectChoice::Auto);
        let kept: Vec<_> = called.effects.iter().map(|effect| effect.name).collect();
        assert!(called.unmet.iter().all(Unmet::is_missing), "somebody asked for it");
        format!("{}\n{}", kept.join(" "), called.unmet.iter().map(Unmet::sentence).collect::<Vec<_>>().join("\n"))
    };
    insta::assert_snapshot!(of(&names), @r"
    panorama
    stereo requested by 'the test': left out, panorama takes its place: an eye that looks everywhere has no right side
    tilt-shift requested by 'the test': left out, panorama takes its place: a picture of all directions has no upper border
    lens-distortion requested by 'the test': left out, panorama takes its place: a picture has one projection
    fisheye requested by 'the test': left out, panorama takes its place: a picture has one projection
    ");
    insta::assert_snapshot!(of(&["lens-distortion", "fisheye"]), @r"
    fisheye
    lens-distortion requested by 'the test': left out, fisheye takes its place: a picture has one projection
    ");
    // A list of the user's is no different.
    let listed = called(&[], &"lens-distortion,panorama".parse().unwrap());
    assert_eq!(listed.effects.iter().map(|effect| effect.name).collect::<Vec<_>>(), ["panorama"]);
}

#[test]
fn fog_takes_the_place_of_a_background_and_says_so() {
    let calls = [call("fog", &[]), call("background", &[("alpha", 1.0)])];
    let called = called(&calls, &EffectChoice::Auto);
    assert!(called.effects.iter().all(|effect| !effect.effect.is_transparent()), "fog is opaque");
    insta::assert_snapshot!(called.unmet[0].sentence(), @"background requested by 'the test': left out, fog takes its place: fog hides what is behind the scene, and its film is opaque");
}

#[test]
fn every_effect_lists_its_settings() {
    for kind in cinesplat::lens::KINDS {
        let stated: Vec<(&str, f64)> = kind.settings.iter().map(|name| (*name, 0.5)).collect();
        for effect in called(&[call(kind.name, &stated)], &EffectChoice::Auto).effects {
            for (name, _) in effect.effect.settings() {
                assert!(kind.settings.contains(&name), "{}: {name}", kind.name);
            }
        }
    }
}

#[test]
fn a_misspelled_setting_or_effect_gets_a_line_with_the_nearest_name() {
    let request = |kind: &str, name: &str| EffectRequest {
        kind: kind.to_owned(),
        because: String::new(),
        settings: vec![(name.to_owned(), 2.8)],
        runs: None,
    };
    let requests = [
        request("depth-of-field", "f_stpo"),
        request("vignete", "stops"),
        request("vignette", "stops"),
        request("panorama", "fov"),
    ];
    assert_eq!(
        unknown_names(&requests),
        [
            "effects[1].kind: unknown effect, the nearest known effect is vignette",
            "effects[0].f_stpo: unknown key, the nearest known key is f_stop",
            // Panoramas have no settings.
            "effects[3].fov: unknown key",
        ]
    );
}
