//! Time: how moves flow into each other, the rest at both ends, and how long a move takes.

use cinesplat::geometry::rotation;
use cinesplat::operator::{Amount, Framing, Program, Solution, SolveLevel, SolveSettings, Speed, Step, realize};
use cinesplat::trajectory::{CameraPath, Easing, Move, Shot};

use super::{solved, world};
use crate::support::shot_over;

const STEP_SECS: f64 = 0.02;

fn about(id: u32) -> Framing {
    Framing { subjects: vec![id], ..Framing::default() }
}

fn push() -> Step {
    Step { start: about(1), ..Step::of(Move::PushIn) }
}

fn pan(degrees: f64) -> Step {
    Step { amount: Some(Amount::Degrees(degrees)), ..Step::of(Move::PanLeft) }
}

/// Speed and turn rate over time: scene units and radians per second. The room is 9 units across.
fn rates(solution: &Solution) -> Vec<[f64; 2]> {
    let shot = Shot { duration_secs: solution.duration_secs, ..shot_over(solution.keyframes.clone()) };
    let path = CameraPath::new(&shot).unwrap();
    let count = (solution.duration_secs / STEP_SECS) as usize;
    let states: Vec<_> = (0..=count).map(|i| path.sample(i as f64 * STEP_SECS)).collect();
    let rate = |a: f64| a / STEP_SECS;
    let pairs = states.windows(2);
    pairs
        .map(|p| {
            let turn = rotation::angle_between(p[0].pose.rotation, p[1].pose.rotation);
            [rate(p[0].pose.position.distance(p[1].pose.position)), rate(turn)]
        })
        .collect()
}

/// Time at rest between the first and the last motion.
fn rest_inside(solution: &Solution) -> f64 {
    let moving: Vec<bool> = rates(solution).iter().map(|[speed, turn]| speed + turn > 0.02).collect();
    let (first, last) = (moving.iter().position(|&m| m).unwrap(), moving.iter().rposition(|&m| m).unwrap());
    moving[first..last].iter().filter(|&&moving| !moving).count() as f64 * STEP_SECS
}

/// Time at rest at both ends.
fn rest_at_ends(solution: &Solution) -> [f64; 2] {
    let moving: Vec<bool> = rates(solution).iter().map(|[speed, turn]| speed + turn > 1e-4).collect();
    let count = |n: Option<usize>| n.unwrap_or(moving.len()) as f64 * STEP_SECS;
    [count(moving.iter().position(|&m| m)), count(moving.iter().rev().position(|&m| m))]
}

fn secs(step: Step) -> f64 {
    solved(&world(), vec![step]).duration_secs
}

#[test]
fn one_move_flows_into_the_next_without_a_stop() {
    for next in [pan(50.0), Step { end: about(2), ..Step::of(Move::PanLeft) }, Step::of(Move::TruckLeft)] {
        let name = next.movement;
        let solution = solved(&world(), vec![push(), next]);
        assert!(rest_inside(&solution) < 0.05, "{}: rests {} s", name.as_ref(), rest_inside(&solution));
        assert!(solution.clearance.is_clear());
    }
}

#[test]
fn the_turn_to_the_next_subject_begins_before_the_last_move_ends() {
    let next = Step { start: about(2), end: about(2), ..Step::of(Move::PushIn) };
    let solution = solved(&world(), vec![push(), next]);
    let both = rates(&solution).iter().filter(|[speed, turn]| *speed > 0.02 && *turn > 0.02).count();
    assert!(both as f64 * STEP_SECS > 0.4, "travels and turns for {both} frames");
    assert!(rest_inside(&solution) < 0.05, "rests {} s", rest_inside(&solution));
}

#[test]
fn speed_and_turn_rate_have_no_jump_at_a_join() {
    let solution = solved(&world(), vec![push(), pan(50.0), Step { end: about(2), ..Step::of(Move::PushIn) }]);
    let rates = rates(&solution);
    let peak = |k: usize| rates.iter().map(|r| r[k]).fold(0.0, f64::max);
    for k in [0, 1] {
        let jump = rates.windows(2).map(|p| (p[1][k] - p[0][k]).abs()).fold(0.0, f64::max);
        // The steepest ramp of a smoothstep over half a second: 3 times the peak per second.
        assert!(jump <= 3.2 * STEP_SECS * peak(k), "jump {jump} of {}", peak(k));
    }
}

#[test]
fn a_hold_and_a_cut_keep_the_stop() {
    let hold = Step { duration_secs: Some(1.0), ..Step::of(Move::Static) };
    let held = solved(&world(), vec![push(), hold, pan(50.0)]);
    assert!(rest_inside(&held) >= 1.0, "rests {} s", rest_inside(&held));
    let cut = solved(&world(), vec![push(), Step { cut: true, start: about(2), ..pan(50.0) }]);
    let at = cut.keyframes.iter().find(|key| key.cut).unwrap().time_secs;
    let before = rates(&cut)[(at / STEP_SECS) as usize - 3];
    assert!(before[0] + before[1] < 0.02, "moves {before:?} before the cut");
}

#[test]
fn words_that_ask_for_a_stop_get_one() {
    let film = |prompt: &str, second: usize| {
        let words = |step: Step, from: usize, to: usize| Step { words: Some([from, to]), ..step };
        let steps = vec![words(push(), 0, 7), words(pan(50.0), second, prompt.len())];
        let settings = SolveSettings { level: SolveLevel::Fast, ..SolveSettings::default() };
        realize(&world(), &Program { steps, ..Program::default() }, prompt, &[], &settings)
    };
    let stop_secs = rest_inside(&film("push in, stop, then pan left", 7));
    let flow_secs = rest_inside(&film("push in, then pan left", 7));
    let after_secs = rest_inside(&film("push in, then pan left and stop", 7));
    assert!(stop_secs > 0.1 && flow_secs < 0.05 && after_secs < 0.05, "{stop_secs} {flow_secs} {after_secs}");
}

#[test]
fn films_rest_at_both_ends_unless_the_time_is_given() {
    let [before, after] = rest_at_ends(&solved(&world(), vec![push()]));
    assert!((0.5..=1.0).contains(&before) && (0.5..=1.0).contains(&after), "{before} {after}");
    let timed = Program { steps: vec![push()], duration_secs: Some(4.0), ..Program::default() };
    let timed = realize(&world(), &timed, "", &[], &SolveSettings::default());
    let [before, after] = rest_at_ends(&timed);
    assert!((timed.duration_secs - 4.0).abs() < 1e-9 && before < 0.2 && after < 0.2, "{before} {after}");
}

#[test]
fn a_whip_pan_settles_for_a_second() {
    let whip = Step { with: vec![Move::PanLeft], start: about(1), end: about(2), ..Step::of(Move::WhipPan) };
    let alone = solved(&world(), vec![whip.clone()]);
    assert!(rest_at_ends(&alone)[1] >= 0.98, "{:?}", rest_at_ends(&alone));
    let inside = solved(&world(), vec![whip, Step { end: about(2), ..Step::of(Move::PushIn) }]);
    assert!(rest_inside(&inside) >= 0.9, "rests {} s", rest_inside(&inside));
}

#[test]
fn durations_grow_with_the_motion_on_the_screen() {
    let pans = [20.0, 60.0, 160.0].map(|degrees| secs(Step { start: about(1), ..pan(degrees) }));
    assert!(pans[0] + 0.5 < pans[1] && pans[1] + 0.5 < pans[2], "{pans:?}");
    let whips = [30.0, 150.0].map(|degrees| secs(Step { movement: Move::WhipPan, start: about(1), ..pan(degrees) }));
    assert!(whips[0] + 0.1 < whips[1], "{whips:?}");
    let orbits = [30.0, 90.0, 360.0].map(|degrees| {
        secs(Step { start: about(1), amount: Some(Amount::Degrees(degrees)), ..Step::of(Move::OrbitLeft) })
    });
    assert!(orbits[0] + 0.5 < orbits[1] && orbits[1] + 0.5 < orbits[2] && orbits[2] <= 15.0, "{orbits:?}");
    let pushes = [0.8, 0.3].map(|factor| secs(Step { amount: Some(Amount::Factor(factor)), ..push() }));
    assert!(pushes[0] + 0.5 < pushes[1], "{pushes:?}");
}

#[test]
fn speed_words_are_relative_to_the_move() {
    let speeds = [Speed::Fast, Speed::Normal, Speed::Slow].map(|speed| secs(Step { speed, ..push() }));
    assert!(speeds[0] + 0.5 < speeds[1] && speeds[1] + 0.5 < speeds[2], "{speeds:?}");
}

#[test]
fn a_film_without_a_stated_time_lasts_at_most_15_seconds() {
    let circle = Step { amount: Some(Amount::Degrees(360.0)), speed: Speed::Slow, ..Step::of(Move::OrbitLeft) };
    let solution = solved(&world(), vec![push(), circle, pan(120.0)]);
    assert!(solution.duration_secs <= 15.0 + 1e-9, "{} s", solution.duration_secs);
}

#[test]
fn a_change_of_speed_shows_over_the_whole_move() {
    for (easing, faster) in [(Easing::EaseIn, 1), (Easing::EaseOut, 0)] {
        let speeds: Vec<f64> =
            rates(&solved(&world(), vec![Step { easing: Some(easing), ..push() }])).iter().map(|r| r[0]).collect();
        let fastest = |part: &[f64]| part.iter().copied().fold(0.0, f64::max);
        let share = speeds.len() * 2 / 5;
        let ends = [fastest(&speeds[..share]), fastest(&speeds[speeds.len() - share..])];
        assert!(ends[faster] > 1.3 * ends[1 - faster], "{easing}: {ends:?}");
    }
}

#[test]
fn a_film_is_as_long_as_its_parts() {
    let part = |step: Step, secs: f64| Step { duration_secs: Some(secs), ..step };
    let steps = vec![
        part(Step { end: about(1), ..Step::of(Move::Static) }, 2.0),
        part(Step { end: about(2), ..Step::of(Move::PanLeft) }, 3.0),
        part(Step { end: about(1), ..Step::of(Move::PushIn) }, 3.0),
    ];
    let program = Program { steps, duration_secs: Some(8.0), ..Program::default() };
    let settings = SolveSettings { level: SolveLevel::Fast, ..SolveSettings::default() };
    let solution = realize(&world(), &program, "", &[], &settings);
    assert!((solution.duration_secs - 8.0).abs() < 1e-9, "{}", solution.duration_secs);
    let moving: Vec<bool> = rates(&solution).iter().map(|[speed, turn]| speed + turn > 1e-3).collect();
    let at = |secs: f64| moving[(secs / STEP_SECS) as usize];
    assert!(!at(0.5) && !at(1.5) && at(3.5) && at(6.5), "rest for two seconds, then moves");
}

#[test]
fn a_short_film_of_many_moves_is_as_short_as_asked() {
    let about = |id: u32, movement: Move| Step { end: about(id), ..Step::of(movement) };
    let steps = vec![about(1, Move::PushIn), about(2, Move::PushIn), about(1, Move::OrbitRight)];
    for secs in [1.0, 1.5, 4.0] {
        let program = Program { steps: steps.clone(), duration_secs: Some(secs), ..Program::default() };
        let settings = SolveSettings { level: SolveLevel::Fast, ..SolveSettings::default() };
        let solution = realize(&world(), &program, "", &[], &settings);
        assert!((solution.duration_secs - secs).abs() < 1e-9, "{secs}: {}", solution.duration_secs);
    }
}
