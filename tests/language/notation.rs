use cinesplat::language::{program_from_notation, program_to_notation};
use cinesplat::operator::{Amount, Framing, Pass, Program, Speed, Step, SubjectPart, Via};
use cinesplat::trajectory::{Easing, Move, ShotAngle, ShotSize};

#[test]
fn every_part_of_a_step_is_read() {
    let text = "orbit-left with=crane-up start=3+5:long:low! end=3:close-up:top between=1+2 amount=45deg dur=2.5s slow ease=ease-in cut returns either | total=8s";
    let step = Step {
        with: Some(Move::CraneUp),
        either_way: true,
        start: Framing {
            subjects: vec![3, 5],
            size: Some(ShotSize::Long),
            angle: Some(ShotAngle::Low),
            part: SubjectPart::Middle,
            whole: true,
        },
        end: Framing {
            subjects: vec![3],
            size: Some(ShotSize::CloseUp),
            angle: None,
            part: SubjectPart::Top,
            whole: false,
        },
        via: Some(Via { how: Pass::Between, objects: vec![1, 2] }),
        amount: Some(Amount::Degrees(45.0)),
        duration_secs: Some(2.5),
        speed: Speed::Slow,
        easing: Some(Easing::EaseIn),
        cut: true,
        returns: true,
        ..Step::of(Move::OrbitLeft)
    };
    let program = Program { steps: vec![step], duration_secs: Some(8.0), unmet: Vec::new() };
    assert_eq!(program_from_notation(text).unwrap(), program);
    assert_eq!(program_to_notation(&program), text);
}

#[test]
fn a_move_takes_its_direction_from_the_step_and_is_open_without_one() {
    let step = |text: &str| program_from_notation(text).unwrap().steps.remove(0);
    assert_eq!(step("pan left end=1").movement, Move::PanLeft);
    assert!(!step("pan left end=1").either_way);
    assert_eq!(step("orbit end=1").movement, Move::OrbitRight);
    assert!(step("orbit end=1").either_way);
    assert_eq!(step("pull-out end=room:long").end, Framing { size: Some(ShotSize::Long), ..Framing::default() });
}

#[test]
fn contradictions_and_nonsense_are_told() {
    for text in [
        "",
        "fly",
        "push-in slow fast",
        "pan left right",
        "push-in left",
        "push-in end=x",
        "push-in end=1:huge",
        "push-in amount=1deg amount=2deg",
        "push-in foo=1",
        "push-in | dur=3s",
    ] {
        assert!(program_from_notation(text).is_err(), "{text}");
    }
}
