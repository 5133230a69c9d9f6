//! Which effects are called for, and what is said about each.

use cinesplat::lens::{Call, Decision, Effect, EffectChoice, Outcome, decide};
use strum::VariantArray;

fn call(kind: &str, because: &str) -> Call {
    Call { kind: kind.to_owned(), because: because.to_owned() }
}

#[test]
fn choices_read_as_they_are_written() {
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
fn what_is_called_for_and_absent_is_said() {
    let calls = [call("depth-of-field", "shallow focus"), call("music", "soundtrack")];
    let sentences = |choice| decide(&choice, &calls).iter().map(Decision::sentence).collect::<Vec<_>>().join("\n");
    insta::assert_snapshot!(sentences(EffectChoice::Auto), @r"
    depth-of-field is called for by 'shallow focus' but not built: absent
    music is called for by 'soundtrack' but no camera does that: absent
    ");
    insta::assert_snapshot!(sentences(EffectChoice::Off), @r"
    depth-of-field is called for by 'shallow focus' but left out by --effects
    music is called for by 'soundtrack' but no camera does that: absent
    ");
    insta::assert_snapshot!(sentences(EffectChoice::These(vec![Effect::Fog])), @r"
    depth-of-field is called for by 'shallow focus' but left out by --effects
    music is called for by 'soundtrack' but no camera does that: absent
    fog is called for by '--effects' but not built: absent
    ");
}

#[test]
fn the_report_admits_every_gap_but_not_a_persons_choice() {
    let calls = [call("depth-of-field", "bokeh"), call("rain", "raining")];
    let lines =
        |choice| decide(&choice, &calls).iter().filter_map(Decision::report_line).map(|l| l.met).collect::<Vec<_>>();
    assert_eq!(lines(EffectChoice::Auto), [false, false]);
    assert_eq!(lines(EffectChoice::Off), [false]);
    let requests = |choice| decide(&choice, &calls).iter().filter_map(Decision::request).count();
    assert_eq!((requests(EffectChoice::Auto), requests(EffectChoice::Off)), (1, 0));
    assert_eq!(decide(&EffectChoice::Off, &calls)[1].outcome, Outcome::NotOfTheLens);
}
