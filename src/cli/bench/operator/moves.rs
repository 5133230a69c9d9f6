use std::path::Path;

use glam::DVec3;

use super::path_facts::{Sampled, height_frac};
use crate::cli::console;
use crate::cli::failure::Failure;
use cinesplat::geometry::{LevelFrame, Pose};
use cinesplat::objects::{Object, ObjectSet};
use cinesplat::operator::{Amount, Framing, Program, SolveLevel, SolveSettings, Step, Via, World, realize};
use cinesplat::pipeline::{self, DirectSettings, OpenedScene};
use cinesplat::scene::{LoadOptions, Scene};
use cinesplat::trajectory::{Easing, Intent, Keyframe, Move, SceneRef, Shot, retimed};

/// Generated room in which moves are planned.
const ROOM: &str = "synth:room:7:0.2";
/// Number of objects of the room about which each move is planned.
const NUM_SUBJECTS: usize = 6;

/// The worst value of a measurement over `cases`, and its limit.
struct Check {
    what: &'static str,
    cases: usize,
    worst: f64,
    limit: f64,
}

impl Check {
    fn of(what: &'static str, limit: f64, values: &[f64]) -> Self {
        // A NaN counts as the worst value.
        let worst = values.iter().copied().max_by(f64::total_cmp).unwrap_or(f64::NAN);
        Self { what, cases: values.len(), worst, limit }
    }
}

/// Measures the moves and prints one CSV line per check.
pub(super) fn run() -> Result<(), Failure> {
    let room = TestRoom::open()?;
    let mut rows = authored()?;
    rows.extend(planned(&room)?);
    console::data("what,cases,worst,limit,holds\n")?;
    for row in rows {
        let holds = row.worst <= row.limit;
        console::data(&format!("{},{},{:.2e},{},{holds}\n", row.what, row.cases, row.worst, row.limit))?;
    }
    Ok(())
}

/// Checks of given keyframes, without the operator.
fn authored() -> Result<Vec<Check>, Failure> {
    let frame = LevelFrame::new(DVec3::Y)?;
    let pivot = DVec3::new(3.0, -1.0, 0.5);
    let mut radius = Vec::new();
    for count in 3..=12 {
        for uneven in [0.0, 0.35] {
            radius.push(Sampled::new(&orbit_keys(pivot, count, uneven)?)?.radius_error(&frame, pivot));
        }
    }
    let bound = uneven_keys();
    let even = retimed(&bound);
    let (bound, even) = (Sampled::new(&bound)?, Sampled::new(&even)?);
    let (jump, turn_jump) = bound.velocity_jumps();
    let back = bound.num_reversals() + even.num_reversals();
    Ok(vec![
        Check::of("orbit radius error from 3 to 12 keys", 1e-3, &radius),
        Check::of("speed variation of keys 1 and 0.2 and 3.8 apart retimed", 0.01, &[even.speed_variation([0.0, 1.0])]),
        Check::of("velocity jump at their bound times", 0.01, &[jump]),
        Check::of("angular velocity jump at their bound times", 0.01, &[turn_jump]),
        Check::of("steps backward between them", 0.0, &[back as f64]),
    ])
}

fn shot(up: DVec3, keyframes: Vec<Keyframe>, duration_secs: f64) -> Shot {
    let scene = SceneRef { up: Some(up), ..SceneRef::default() };
    Shot { scene, ..Shot::from_keyframes([1280, 720], 30.0, duration_secs, keyframes) }
}

fn key(time_secs: f64, pose: Pose, intent: Option<Intent>) -> Keyframe {
    let easing = Easing::Linear;
    Keyframe {
        time_secs,
        pose,
        fov_y_rad: 0.8,
        focus_distance: None,
        optics: cinesplat::trajectory::KeyOptics::default(),
        easing,
        cut: false,
        intent,
    }
}

/// An orbit of 300 degrees in `count` keys, shifted along the circle by up to `uneven` times their spacing.
fn orbit_keys(pivot: DVec3, count: usize, uneven: f64) -> Result<Shot, Failure> {
    let at = |i: usize| {
        let inner = i > 0 && i + 1 < count;
        let off = if inner { uneven * (i as f64 * 2.4).sin() } else { 0.0 };
        let angle = (300.0 * (i as f64 + off) / (count - 1) as f64).to_radians();
        let position = pivot + DVec3::new(angle.sin(), 0.35, angle.cos()) * 2.0;
        let intent = Intent { movement: Some(Move::OrbitRight), pivot: Some(pivot), ..Intent::default() };
        Ok(key(i as f64, Pose::look_at(position, pivot, DVec3::Y, None)?, Some(intent)))
    };
    let keys: Result<Vec<Keyframe>, Failure> = (0..count).map(at).collect();
    Ok(shot(DVec3::Y, keys?, (count - 1) as f64))
}

/// Keys 1, 0.2 and 3.8 units apart, one second apart, with turning cameras.
fn uneven_keys() -> Shot {
    let at = |(i, x): (usize, f64)| {
        let forward = DVec3::new((0.4 * i as f64).sin(), -0.1 * i as f64, -(0.4 * i as f64).cos()).normalize();
        key(i as f64, Pose::facing(DVec3::X * x, forward, DVec3::Y, None), None)
    };
    shot(DVec3::Y, [0.0, 1.0, 1.2, 5.0].into_iter().enumerate().map(at).collect(), 3.0)
}

/// A generated room with its first objects.
struct TestRoom {
    scene: Scene,
    subjects: Vec<Object>,
    world: World,
}

impl TestRoom {
    fn open() -> Result<Self, Failure> {
        let OpenedScene { scene, objects } = pipeline::open_scene(Path::new(ROOM), &LoadOptions::default())?;
        let objects: ObjectSet = objects.ok_or_else(|| Failure::fault("a generated room without objects"))?;
        let subjects: Vec<Object> = objects.objects.iter().take(NUM_SUBJECTS).cloned().collect();
        let ids: Vec<u32> = subjects.iter().map(|object| object.id).collect();
        let world = World::new(&scene.gaussians, scene.up, &objects, &ids)?;
        Ok(Self { scene, subjects, world })
    }

    /// The shot of one step.
    fn plan(&self, step: Step) -> Shot {
        let program = Program { steps: vec![step], ..Program::default() };
        let solve = SolveSettings { level: SolveLevel::Fast, ..SolveSettings::default() };
        let solution = realize(&self.world, &program, "", &[], &solve);
        pipeline::shot_of(&self.scene, "", solution, &DirectSettings::default())
    }
}

fn about(object: &Object) -> Framing {
    Framing { subjects: vec![object.id], ..Framing::default() }
}

/// Checks of moves that the operator plans.
fn planned(room: &TestRoom) -> Result<Vec<Check>, Failure> {
    let frame = &room.world.frame;
    let (mut radius, mut even, mut plane, mut boxes) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    let (mut jumps, mut back) = (Vec::new(), Vec::new());
    for object in &room.subjects {
        for degrees in [45.0, 120.0, 360.0] {
            let amount = Some(Amount::Degrees(degrees));
            let step = Step { start: about(object), amount, easing: Some(Easing::Linear), ..Step::of(Move::OrbitLeft) };
            let film = room.plan(step);
            let path = Sampled::new(&film)?;
            radius.push(path.radius_error(frame, object.center));
            even.push(path.speed_variation([0.0, 1.0]));
            back.push(path.num_reversals() as f64);
        }
        for movement in [Move::DollyZoomIn, Move::DollyZoomOut] {
            let film = room.plan(Step { start: about(object), ..Step::of(movement) });
            let path = Sampled::new(&film)?;
            let corners = object.corners();
            let distance = |s: &cinesplat::trajectory::CameraState| s.pose.position.distance(object.center);
            plane.push(path.drift(|s| distance(s) * (s.fov_y_rad / 2.0).tan()));
            boxes.push(path.drift(|s| height_frac(s, &corners)));
            back.push(path.num_reversals() as f64);
        }
    }
    for film in one_way_moves(room) {
        let path = Sampled::new(&film)?;
        let (jump, turn_jump) = path.velocity_jumps();
        jumps.push(jump.max(turn_jump));
        back.push(path.num_reversals() as f64);
    }
    for film in &cruises(room) {
        even.push(Sampled::new(film)?.speed_variation([0.0, 1.0]));
    }
    Ok(vec![
        Check::of("orbit radius error as planned", 1e-3, &radius),
        Check::of("speed variation of even moves as planned", 0.01, &even),
        Check::of("dolly zoom drift of the subject's plane", 0.01, &plane),
        Check::of("dolly zoom drift of the box's projected height", f64::INFINITY, &boxes),
        Check::of("velocity jump of films of several moves", 0.01, &jumps),
        Check::of("steps backward in one move", 0.0, &back),
    ])
}

/// Paths of constant speed: from one object to another, and over one to another.
fn cruises(room: &TestRoom) -> Vec<Shot> {
    let pairs = room.subjects.windows(2);
    let follow = |pair: &[Object]| {
        let easing = Some(Easing::Linear);
        let via = Some(Via { how: cinesplat::operator::Pass::Over, objects: vec![pair[0].id] });
        [
            room.plan(Step { start: about(&pair[0]), end: about(&pair[1]), easing, ..Step::of(Move::Follow) }),
            room.plan(Step { via, end: about(&pair[1]), easing, ..Step::of(Move::FlyThrough) }),
        ]
    };
    pairs.flat_map(follow).collect()
}

/// Shots of one move each, whose paths must not reverse.
fn one_way_moves(room: &TestRoom) -> Vec<Shot> {
    let film = |object: &Object| {
        [Move::PushIn, Move::PullOut, Move::TruckLeft, Move::TruckRight, Move::PedestalUp, Move::CraneUp]
            .map(|movement| room.plan(Step { start: about(object), end: about(object), ..Step::of(movement) }))
    };
    let mut out: Vec<Shot> = room.subjects.iter().flat_map(film).collect();
    out.extend(cruises(room));
    out
}
