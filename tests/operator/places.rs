//! Allowed camera positions: clear of matter and inside the captured region.

use cinesplat::operator::{Amount, Framing, Program, SolveLevel, SolveSettings, Step, realize};
use cinesplat::trajectory::Move;
use glam::DVec3;

use super::{film, room, solved, world};

#[test]
fn the_captured_region_ends_at_the_walls() {
    let world = world();
    assert!(world.is_indoor());
    assert!(world.in_capture_region(DVec3::new(0.0, 1.2, -1.0)) && world.sees_front_faces(DVec3::new(0.0, 1.2, -1.0)));
    for outside in [DVec3::new(-3.6, 1.2, 0.0), DVec3::new(0.0, 1.2, 3.6), DVec3::new(0.0, -0.4, 0.0)] {
        assert!(!world.in_capture_region(outside), "{outside}");
    }
    assert!(!world.in_capture_region(DVec3::new(1.2, 0.6, 0.9)), "inside of a box");
}

#[test]
fn clearance_never_exceeds_the_distance_to_the_nearest_gaussian() {
    let (gaussians, _) = room();
    let world = world();
    let brute = |p: DVec3| gaussians.means.iter().map(|m| m.as_dvec3().distance(p)).fold(f64::INFINITY, f64::min);
    for i in 0..300 {
        let t = f64::from(i);
        let p = DVec3::new((t * 0.37).sin() * 2.9, 0.1 + (t * 0.13).fract() * 2.4, (t * 0.71).cos() * 2.9);
        assert!(world.clearance(p) <= brute(p) + 1e-6, "{p}");
    }
}

#[test]
fn films_stay_clear_of_every_gaussian() {
    let (gaussians, _) = room();
    let world = world();
    let about = |id: u32| Framing { subjects: vec![id], ..Framing::default() };
    let steps = vec![
        Step { start: about(1), amount: Some(Amount::Degrees(60.0)), ..Step::of(Move::OrbitLeft) },
        Step { end: about(2), ..Step::of(Move::PushIn) },
    ];
    let solution = solved(&world, steps);
    for state in film(&solution) {
        let p = state.pose.position;
        let nearest = gaussians.means.iter().map(|m| m.as_dvec3().distance(p)).fold(f64::INFINITY, f64::min);
        assert!(nearest >= world.camera_radius, "{nearest} from matter at {p}");
        assert!(p.x.abs() < 3.0 && p.z.abs() < 3.0 && p.y > 0.0, "left the room at {p}");
    }
}

#[test]
fn the_same_seed_gives_the_same_shot_on_any_number_of_threads() {
    let world = world();
    let step = Step { start: Framing { subjects: vec![1], ..Framing::default() }, ..Step::of(Move::CraneUp) };
    let program = Program { steps: vec![step], ..Program::default() };
    let settings = SolveSettings { level: SolveLevel::Fast, seed: 3, ..SolveSettings::default() };
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| realize(&world, &program, "", &[], &settings))
    };
    let one = on(1);
    assert_eq!(one, on(2));
    assert_eq!(one, on(5));
}
