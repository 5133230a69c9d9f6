//! Clearance certificates of whole paths: they hold between frames, and they agree with dense sampling.

use cinesplat::operator::{Framing, Step, World, prove_clear, prove_clear_around};
use cinesplat::scene::Gaussians;
use cinesplat::trajectory::{CameraPath, ClearanceProof, Easing, Intent, Keyframe, Move, Shot};
use glam::{DQuat, DVec3, Quat, Vec3};

use super::{add, brute_force, room, solved, wall};
use crate::support::shot_over;
use cinesplat::geometry::Pose;

fn key(time_secs: f64, position: DVec3) -> Keyframe {
    Keyframe {
        time_secs,
        pose: Pose { position, rotation: DQuat::IDENTITY },
        fov_y_rad: 0.8,
        focus_distance: None,
        optics: cinesplat::trajectory::KeyOptics::default(),
        easing: Easing::Linear,
        cut: false,
        intent: None,
    }
}

fn path(keyframes: Vec<Keyframe>) -> CameraPath {
    CameraPath::new(&shot_over(keyframes)).unwrap()
}

/// A scene of a given extent about the origin: small Gaussians at the corners of a box.
fn corners(half: f64) -> Gaussians {
    let mut gaussians = Gaussians::default();
    for i in 0..8 {
        let sign = |bit: i32| if i >> bit & 1 == 0 { -half } else { half };
        add(&mut gaussians, DVec3::new(sign(0), sign(1), sign(2)), Vec3::splat(0.01), Quat::IDENTITY, 0.9);
    }
    gaussians
}

/// A thin sheet across the path at `x`.
fn sheet(gaussians: &mut Gaussians, x: f64, y: f64) {
    add(gaussians, DVec3::new(x, y, 0.0), Vec3::new(1e-5, 0.4, 0.4), Quat::IDENTITY, 0.9);
}

fn straight() -> CameraPath {
    path(vec![key(0.0, DVec3::new(-5.0, 0.0, 0.0)), key(10.0, DVec3::new(5.0, 0.0, 0.0))])
}

#[test]
fn a_thin_wall_between_two_frames_is_caught() {
    let mut gaussians = corners(6.0);
    sheet(&mut gaussians, 1.37, 0.0);
    let proof = prove_clear(&gaussians, &straight());
    // At two frames per second no frame is within the camera's radius of the wall.
    let frames = (0..=20).map(|i| straight().sample(f64::from(i) * 0.5).pose.position);
    assert!(frames.map(|p| brute_force(&gaussians, p).0).all(|distance| distance > proof.camera_radius * 0.4));
    let failure = proof.failure.unwrap();
    assert_eq!((failure.gaussian_idx, proof.gaussian_idx), (8, Some(8)));
    assert!(proof.min_distance < 0.02 * proof.camera_radius);
    // The camera crosses x = 1.37 at 6.37 s and is too near to it within one radius on both sides.
    let (from, to) = (6.37 - proof.camera_radius, 6.37 + proof.camera_radius);
    assert!((failure.from_secs - from).abs() < 0.02 && (failure.to_secs - to).abs() < 0.02, "{failure:?}");
}

#[test]
fn the_verdict_changes_where_the_wall_leaves_the_path() {
    let verdict = |y: f64| {
        let mut gaussians = corners(6.0);
        sheet(&mut gaussians, 1.37, y);
        prove_clear(&gaussians, &straight())
    };
    // The sheet's edge is 0.6 below its middle (1.5 standard deviations of 0.4).
    let radius = verdict(3.0).camera_radius;
    assert!(radius > 0.0);
    assert!(!verdict(0.6 + 0.98 * radius).is_clear());
    let clear = verdict(0.6 + 1.02 * radius);
    assert!(
        clear.is_clear() && clear.min_distance >= radius && clear.min_distance <= 1.02 * radius + 1e-6,
        "{clear:?}"
    );
}

/// Least distance on 4000 samples of a path.
fn sampled_least(gaussians: &Gaussians, path: &CameraPath, secs: f64) -> f64 {
    let at = |i: i32| path.sample(secs * f64::from(i) / 4000.0).pose.position;
    (0..=4000).map(|i| brute_force(gaussians, at(i)).0).fold(f64::INFINITY, f64::min)
}

fn agrees(gaussians: &Gaussians, path: &CameraPath, secs: f64) -> ClearanceProof {
    let proof = prove_clear(gaussians, path);
    let sampled = sampled_least(gaussians, path, secs);
    assert!(proof.min_distance <= sampled, "a proof of {} where a sample is at {sampled}", proof.min_distance);
    assert!(
        proof.min_distance >= sampled - 0.03 * proof.camera_radius,
        "{} is a poor bound for {sampled}",
        proof.min_distance
    );
    let there = brute_force(gaussians, path.sample(proof.at_secs).pose.position).0;
    assert!((there - proof.min_distance).abs() <= 0.05 * proof.camera_radius, "{there} at the time it names");
    proof
}

#[test]
fn bounds_are_below_every_sample_and_close_to_the_least() {
    let mut gaussians = corners(4.0);
    wall(&mut gaussians, DVec3::new(-1.0, -1.0, 1.2), DVec3::X * 2.0, DVec3::Y * 2.0);
    let bent = [[-2.0, 0.0, 0.0], [0.0, 0.6, 0.7], [0.9, -0.4, -0.6], [2.5, 0.2, 0.9], [2.6, 0.2, 1.0]];
    let keys = bent.iter().zip([0.0, 1.0, 3.5, 4.0, 6.0]).map(|(&p, t)| key(t, DVec3::from_array(p))).collect();
    agrees(&gaussians, &path(keys), 6.0);

    let orbit = |degrees: f64, radius: f64, height: f64| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        DVec3::new(radius * sin, height, radius * cos)
    };
    let around = |time: f64, position: DVec3| Keyframe {
        easing: Easing::Smooth,
        intent: Some(Intent { movement: Some(Move::OrbitRight), pivot: Some(DVec3::ZERO), ..Intent::default() }),
        ..key(time, position)
    };
    // A circle of 1.1 that comes near the wall, then a rising spiral.
    let keys = vec![
        around(0.0, orbit(-120.0, 1.1, 0.1)),
        around(4.0, orbit(20.0, 1.1, 0.1)),
        around(7.0, orbit(120.0, 2.0, 0.9)),
    ];
    agrees(&gaussians, &path(keys), 7.0);
}

#[test]
fn the_verdict_ignores_timing_and_cuts_may_cross_walls() {
    let mut gaussians = corners(6.0);
    sheet(&mut gaussians, 0.0, 0.0);
    let keys = |cut: bool, easing: Easing| {
        let mut keys = vec![key(0.0, DVec3::new(-4.0, 0.0, 0.0)), key(2.0, DVec3::new(4.0, 0.0, 0.0))];
        keys.push(key(3.0, DVec3::new(4.5, 0.0, 0.0)));
        keys[1].cut = cut;
        keys[0].easing = easing;
        keys
    };
    let verdicts = [Easing::Linear, Easing::Smooth, Easing::EaseOut].map(|easing| {
        let proof = prove_clear(&gaussians, &path(keys(false, easing)));
        (proof.is_clear(), proof.gaussian_idx)
    });
    assert_eq!(verdicts, [(false, Some(8)); 3]);
    assert!(prove_clear(&gaussians, &path(keys(true, Easing::Linear))).is_clear());
}

#[test]
fn a_camera_that_stands_still_and_an_empty_scene_have_proofs_too() {
    let gaussians = corners(3.0);
    let still = prove_clear(&gaussians, &path(vec![key(0.0, DVec3::ZERO)]));
    let wanted = 27.0_f64.sqrt() - 0.015;
    assert!(still.is_clear() && (still.min_distance - wanted).abs() < 1e-4, "{still:?}");
    let nothing = prove_clear(&Gaussians::default(), &straight());
    assert!(nothing.is_clear() && nothing.min_distance == f64::INFINITY && nothing.gaussian_idx.is_none());
    assert!(nothing.camera_radius > 0.0);
}

/// A ball that fits nowhere: the search for a place must end, and the film must say what is wrong with it.
#[test]
fn a_camera_that_shakes_wider_than_its_room_is_clear_where_its_proof_says_so() {
    for reach in [0.4, 3.0, 100.0] {
        let (gaussians, objects) = room();
        let mut world = World::new(&gaussians, DVec3::Y, &objects, &[1, 2]).unwrap();
        world.add_reach(reach);
        for movement in [Move::PushIn, Move::OrbitLeft, Move::Follow, Move::TruckLeft, Move::PedestalUp] {
            let end = Framing { subjects: vec![2], ..Framing::default() };
            let solution = solved(&world, vec![Step { end, ..Step::of(movement) }]);
            let shot = shot_over(solution.keyframes.clone());
            let path = CameraPath::new(&Shot { duration_secs: solution.duration_secs, ..shot }).unwrap();
            let proof = prove_clear_around(&gaussians, &path, reach);
            let line = solution.report.iter().find(|line| line.clause == "clear of matter").unwrap();
            assert_eq!(line.met, proof.is_clear(), "{movement}: {line:?}");
            assert_eq!(solution.clearance, proof, "{movement}");
        }
    }
}
