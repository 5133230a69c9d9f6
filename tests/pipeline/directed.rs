//! From a sentence to a shot.

use cinesplat::director::Director;
use cinesplat::geometry::LevelFrame;
use cinesplat::operator::SolveLevel;
use cinesplat::pipeline::{
    DirectSettings, FilmChoice, Interpreter, OpenedScene, certify, direct, open_scene, prove_clearance,
};
use cinesplat::scene::LoadOptions;
use cinesplat::trajectory::{Keyframe, Move, ReportLine, Shot};
use glam::DVec3;
use std::path::Path;

use crate::critic::fronts::striped;
use crate::objects::scene_of;

fn opened() -> OpenedScene {
    open_scene(Path::new("synth:tabletop:1:0.02"), &LoadOptions::default()).unwrap()
}

/// The takes of a prompt.
fn takes(opened: &OpenedScene, prompt: &str, solve: SolveLevel) -> Vec<Shot> {
    let interpreter = Interpreter::from(Director::embedded().unwrap());
    let choice = FilmChoice { num_takes: 2, ..FilmChoice::default() };
    let settings = DirectSettings { width: 320, height: 180, solve, choice, ..DirectSettings::default() };
    let objects = opened.objects.clone().unwrap();
    direct(&opened.scene, &objects, prompt, &interpreter, &settings).unwrap().takes
}

fn clearance_line(shot: &Shot) -> &ReportLine {
    shot.report.iter().find(|line| line.clause == "clear of matter").unwrap()
}

/// The thing itself had lost its front to its parts once.
#[test]
fn a_lone_thing_is_filmed_from_its_front() {
    let interpreter = Interpreter::from(Director::embedded().unwrap());
    let settings = DirectSettings { width: 320, height: 180, ..DirectSettings::default() };
    for toward in [DVec3::X, -DVec3::X, DVec3::Z, -DVec3::Z] {
        let (gaussians, objects) = striped(Some(toward));
        let shot = direct(&scene_of(gaussians), &objects, "push in on the box", &interpreter, &settings).unwrap().shot;
        for key in &shot.keyframes {
            let eye = key.pose.position;
            let level = eye - eye.y * DVec3::Y;
            assert!(level.angle_between(toward).to_degrees() < 60.0, "striped toward {toward}, seen from {eye}");
        }
    }
}

/// The hand took part neither in the search nor in the report, but in the proof.
#[test]
fn a_shaky_camera_is_reported_clear_of_matter_although_its_proof_fails() {
    let opened = opened();
    for (prompt, solve) in [
        ("push in to an extreme close-up of the wine glass, very shaky handheld, 3 seconds", SolveLevel::Full),
        ("push in to an extreme close-up of the wine glass, very shaky handheld, 3 seconds", SolveLevel::Off),
        ("truck left past the globe, very shaky handheld", SolveLevel::Fast),
        ("orbit the globe handheld, then push in on the wine glass", SolveLevel::Fast),
        ("push in on the globe", SolveLevel::Fast),
    ] {
        for take in takes(&opened, prompt, solve) {
            let (proof, line) = (take.clearance.clone().unwrap(), clearance_line(&take));
            assert_eq!(line.met, proof.is_clear(), "{prompt}: {line:?}, {proof:?}");
            assert_eq!(line.note.is_empty(), line.met, "{prompt}: {line:?}");
            assert!((line.got - proof.min_distance).abs() < 1e-12, "{prompt}: {line:?}, {proof:?}");
            // The search proves what a proof of the finished shot does, with the hand's reach.
            assert_eq!(proof, prove_clearance(&opened.scene, &take).unwrap(), "{prompt}");
        }
    }
}

/// What was in focus after a rack focus had stayed at its distance from the camera, wherever that went.
#[test]
fn the_focus_follows_the_camera_after_a_rack_focus() {
    let opened = opened();
    let prompt = "close-up of the wine glass, rack focus to the globe, then pull out from the globe to a wide shot";
    for take in takes(&opened, prompt, SolveLevel::Fast) {
        let focus = |key: &Keyframe| (key.focus_distance.unwrap(), key.pose.position);
        let racked = take
            .keyframes
            .iter()
            .rposition(|key| key.intent.as_ref().is_some_and(|intent| intent.movement == Some(Move::RackFocus)));
        let (there, from) = focus(&take.keyframes[racked.unwrap() + 1]);
        let (last, to) = focus(take.keyframes.last().unwrap());
        let way = from.distance(to);
        assert!((last - there - way).abs() < 0.35 * way, "from {there} to {last} on a way of {way}");
    }
}

/// A camera that may come as near as its radius came nearer by the reach of the hand.
#[test]
fn a_hand_takes_the_camera_into_matter_where_there_is_room() {
    let opened = opened();
    for take in takes(&opened, "push in on the wine glass, very shaky handheld, 3 seconds", SolveLevel::Full) {
        assert!(take.clearance.as_ref().unwrap().is_clear(), "{:?}", take.clearance);
    }
}

/// `--retime` and edits by hand gave a new proof beside the old line.
#[test]
fn a_shot_that_was_moved_into_matter_keeps_the_line_that_it_is_clear() {
    let opened = opened();
    let mut shot = takes(&opened, "push in on the globe", SolveLevel::Off).swap_remove(0);
    let objects = opened.objects.clone().unwrap();
    let globe = objects.objects.iter().find(|object| object.label == "globe").unwrap();
    certify(&opened.scene, &mut shot).unwrap();
    let before = clearance_line(&shot).clone();
    certify(&opened.scene, &mut shot).unwrap();
    assert_eq!(clearance_line(&shot), &before, "nothing has changed");
    shot.keyframes.last_mut().unwrap().pose.position = globe.center;
    certify(&opened.scene, &mut shot).unwrap();
    let line = clearance_line(&shot);
    assert!(!line.met && line.note.contains("from matter between"), "{line:?}");
    assert!(!shot.clearance.unwrap().is_clear());
}

/// The words of the next step may be nearer than those of the step that the phrase belongs to.
#[test]
fn a_dutch_angle_slants_the_step_after_its_own() {
    let opened = opened();
    let (slanted, level) = (15.0, 0.0);
    for (prompt, ends) in [
        ("push in on the globe with a dutch angle, then pull back", [slanted, level]),
        ("with a dutch angle, push in on the globe, then pull back", [slanted, level]),
        ("push in on the globe, dutch angle, then pull back", [slanted, level]),
        ("push in on the globe, then pull back with a dutch angle", [level, slanted]),
        ("push in on the globe. Then, with a dutch angle, pull back", [level, slanted]),
        ("push in on the globe, then pull back, dutch angle throughout", [slanted, slanted]),
    ] {
        let shot = takes(&opened, prompt, SolveLevel::Off).swap_remove(0);
        let frame = LevelFrame::new(shot.scene.up.unwrap()).unwrap();
        let keys = [shot.keyframes.first(), shot.keyframes.last()].map(Option::unwrap);
        let rolls = keys.map(|key| frame.roll_rad(&key.pose).to_degrees());
        for (roll, wanted) in rolls.into_iter().zip(ends) {
            assert!((roll - wanted).abs() < 0.01, "{prompt}: {rolls:?}, expected {ends:?}");
        }
    }
}
