use cinesplat::language::{NotationError, program_from_notation, program_to_notation};
use cinesplat::operator::{
    Amount, FramePlace, Framing, Lens, Level, Limit, Look, Motion, Pass, Program, Speed, Step, SubjectPart,
    SubjectSide, Via,
};
use cinesplat::trajectory::{Easing, Move, ShotAngle, ShotSize};

#[test]
fn every_token_of_a_step_is_parsed_and_printed() {
    let text = "orbit-left with=crane-up+zoom-in start=3+5:long:40%:low:30deg:h1.6u:d0.5u:35mm:from-back:at-upper-left:before-4:before-9! end=3:close-up:wide-lens:top:hidden between=1+2 look=4 keep=6+7 avoid=8 amount=45deg dur=2.5s slow ease=ease-in cut returns either | total=8s no=zoom+roll+rise";
    let step = Step {
        with: vec![Move::CraneUp, Move::ZoomIn],
        either_way: true,
        start: Framing {
            subjects: vec![3, 5],
            size: Some(ShotSize::Long),
            angle: Some(ShotAngle::Low),
            part: SubjectPart::Middle,
            whole: true,
            height_frac: Some(0.4),
            elevation_deg: Some(30.0),
            height: Some(1.6),
            distance: Some(0.5),
            lens: Some(Lens::FocalMm(35.0)),
            side: Some(SubjectSide::FromBack),
            place: Some(FramePlace::AtUpperLeft),
            hidden: false,
            backdrop: vec![4, 9],
        },
        end: Framing {
            subjects: vec![3],
            size: Some(ShotSize::CloseUp),
            part: SubjectPart::Top,
            lens: Some(Lens::Wide),
            hidden: true,
            ..Framing::default()
        },
        via: Some(Via { how: Pass::Between, objects: vec![1, 2] }),
        look: Some(Look::At(vec![4])),
        keep: vec![6, 7],
        avoid: vec![8],
        amount: Some(Amount::Degrees(45.0)),
        duration_secs: Some(2.5),
        speed: Speed::Slow,
        easing: Some(Easing::EaseIn),
        cut: true,
        returns: true,
        ..Step::of(Move::OrbitLeft)
    };
    let forbidden = vec![Motion::Zoom, Motion::Roll, Motion::Rise];
    let program = Program { steps: vec![step], duration_secs: Some(8.0), forbidden, limits: Vec::new() };
    assert_eq!(program_from_notation(text).unwrap(), program);
    assert_eq!(program_to_notation(&program), text);
}

#[test]
fn limits_of_the_whole_film_are_parsed_and_printed() {
    let text = "push-in end=3 | total=8s above=0.5u below=4 clear=0.3u clear=3:0.5u within=3:2u speed=0.2u speed=20deg";
    let limits = vec![
        Limit::Above(Level::Units(0.5)),
        Limit::Below(Level::Object(4)),
        Limit::Clear(None, 0.3),
        Limit::Clear(Some(3), 0.5),
        Limit::Within(3, 2.0),
        Limit::Speed(0.2),
        Limit::TurnSpeed(20.0),
    ];
    let program = program_from_notation(text).unwrap();
    assert_eq!(program.limits, limits);
    assert_eq!(program_to_notation(&program), text);
    assert_eq!(program.object_ids(), [3, 4]);
    for bad in ["above=x", "clear=3", "within=2u", "speed=fast", "over=2u"] {
        assert!(program_from_notation(&format!("push-in | {bad}")).is_err(), "{bad}");
    }
}

#[test]
fn a_move_takes_its_direction_from_the_step_and_is_either_way_without_one() {
    let step = |text: &str| program_from_notation(text).unwrap().steps.remove(0);
    assert_eq!(step("pan left end=1").movement, Move::PanLeft);
    assert!(!step("pan left end=1").either_way);
    assert_eq!(step("orbit end=1").movement, Move::OrbitRight);
    assert!(step("orbit end=1").either_way);
    assert_eq!(step("pull-out end=room:long").end, Framing { size: Some(ShotSize::Long), ..Framing::default() });
}

#[test]
fn a_program_without_steps_is_none() {
    assert_eq!(program_from_notation("none").unwrap(), Program::default());
    assert_eq!(program_to_notation(&Program::default()), "none");
}

#[test]
fn a_step_has_at_most_two_further_moves() {
    assert!(program_from_notation("orbit with=crane-up+zoom-in").is_ok());
    assert!(program_from_notation("orbit with=crane-up+zoom-in+roll").is_err());
}

#[test]
fn a_malformed_program_is_an_error_that_names_the_token() {
    let error = |text: &str| program_from_notation(text).unwrap_err();
    let named = str::to_owned;
    assert_eq!(error(""), NotationError::NoMove);
    assert_eq!(error("fly"), NotationError::UnknownMove { name: named("fly") });
    assert_eq!(error("push-in slow fast"), NotationError::Contradiction { token: named("fast") });
    assert_eq!(error("pan left right"), NotationError::Contradiction { token: named("right") });
    let left = NotationError::WrongDirection { movement: Move::PushIn, direction: named("left") };
    assert_eq!(error("push-in left"), left);
    assert_eq!(error("push-in end=x"), NotationError::UnknownObject { name: named("x") });
    assert_eq!(error("push-in end=1:huge"), NotationError::UnknownFraming { qualifier: named("huge") });
    let repeated = NotationError::Contradiction { token: named("amount=2deg") };
    assert_eq!(error("push-in amount=1deg amount=2deg"), repeated);
    assert_eq!(error("push-in foo=1"), NotationError::UnknownToken { token: named("foo=1") });
    assert_eq!(error("push-in dur=3"), NotationError::BadDuration { found: named("3") });
    assert_eq!(error("push-in | dur=3s"), NotationError::UnknownToken { token: named("dur=3s") });
    // The names of the default speed and of a move without its other direction are not tokens.
    assert_eq!(error("push-in normal"), NotationError::Contradiction { token: named("normal") });
    assert_eq!(error("push"), NotationError::UnknownMove { name: named("push") });
}
