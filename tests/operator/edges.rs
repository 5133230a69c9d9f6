//! The edge of a capture and of the frame: void beside a subject, the floor, flat things, and turns that show.

use cinesplat::geometry::Pose;
use cinesplat::objects::{Object, ObjectSet};
use cinesplat::operator::{Amount, Framing, Program, SolveLevel, SolveSettings, Step, StepCameras, World, realize};
use cinesplat::scene::Gaussians;
use cinesplat::trajectory::{CameraState, Move, ShotSize};
use glam::{DVec3, Quat, Vec3};

use super::composition::{CENTER, HALF, in_frame};
use super::{ROOM, add, film, room, solved, wall, world};

fn about(id: u32) -> Framing {
    Framing { subjects: vec![id], ..Framing::default() }
}

/// The room as far as `kept` keeps its Gaussians, prepared for planning.
fn part_of_room(kept: impl Fn(DVec3) -> bool) -> World {
    let (all, objects) = room();
    let mut gaussians = Gaussians::default();
    for i in (0..all.len()).filter(|&i| kept(all.mean_world(i))) {
        add(&mut gaussians, all.mean_world(i), all.scales[i], all.rotations[i], all.opacities[i]);
    }
    World::new(&gaussians, DVec3::Y, &objects, &[1, 2]).unwrap()
}

/// Where box 1 is in the last frame of a push-in that begins with a look at it along +z; right positive.
fn place_at_end(world: &World) -> f64 {
    let pose = Pose::look_at(CENTER + DVec3::new(0.0, 0.5, -2.9), CENTER, DVec3::Y, None).unwrap();
    let start = CameraState { pose, fov_y_rad: 0.8, focus_distance: None };
    let steps = vec![Step { end: about(1), ..Step::of(Move::PushIn) }];
    let settings = SolveSettings { level: SolveLevel::Off, ..SolveSettings::default() };
    let suggestion = StepCameras { start, end: start, secs: 3.0 };
    let frames = film(&realize(world, &Program { steps, ..Program::default() }, "", &[suggestion], &settings));
    in_frame(&frames[frames.len() - 1], CENTER).x
}

#[test]
fn a_picture_turns_away_from_the_side_that_was_not_captured() {
    assert!(place_at_end(&world()).abs() < 0.02, "in the middle of a whole room");
    // Looking along +z, the wall at x = 3 is on the left.
    let place = place_at_end(&part_of_room(|mean| mean.x < 1.6));
    assert!((-0.19..-0.04).contains(&place), "void on the left, box at {place}");
}

/// Share of a frame beyond the walls of the room, of which all beyond `x` is missing: where its rays leave the room.
fn void(state: &CameraState, x: f64) -> f64 {
    let (columns, rows) = (16, 9);
    let tan = (state.fov_y_rad / 2.0).tan();
    let is_void = |i: i32| {
        let at = |i: i32, count: i32| (f64::from(i) + 0.5) / f64::from(count) * 2.0 - 1.0;
        let (across, down) = (at(i % columns, columns), at(i / columns, rows));
        let ray = state.pose.rotation * DVec3::new(across * tan * 16.0 / 9.0, down * tan, 1.0).normalize();
        let eye = state.pose.position;
        let limits = DVec3::select(ray.cmpgt(DVec3::ZERO), ROOM, DVec3::new(-ROOM.x, 0.0, -ROOM.z));
        let reach =
            ((limits - eye) / ray).to_array().into_iter().filter(|r| r.is_finite()).fold(f64::INFINITY, f64::min);
        let hit = eye + ray * reach;
        // The room has no ceiling.
        hit.x > x || hit.y > ROOM.y - 1e-6
    };
    (0..columns * rows).filter(|&i| is_void(i)).count() as f64 / f64::from(columns * rows)
}

#[test]
fn a_slide_past_a_thing_at_the_edge_of_a_capture_does_not_run_out_of_it() {
    let world = part_of_room(|mean| mean.x < 1.6);
    for movement in [Move::TruckLeft, Move::TruckRight] {
        let worst = (0..6).map(|seed| {
            let settings = SolveSettings { level: SolveLevel::Fast, seed, ..SolveSettings::default() };
            let steps = vec![Step { end: about(1), ..Step::of(movement) }];
            let frames = film(&realize(&world, &Program { steps, ..Program::default() }, "", &[], &settings));
            void(&frames[0], 1.6).max(void(&frames[frames.len() - 1], 1.6))
        });
        let mut worst: Vec<f64> = worst.collect();
        worst.sort_by(f64::total_cmp);
        assert!(worst[4] < 0.3 && worst[2] < 0.2, "{movement}: {worst:?}");
    }
}

#[test]
fn a_zoom_out_to_the_room_may_leave_its_start_small() {
    let steps = vec![Step {
        start: Framing { size: Some(ShotSize::CloseUp), ..about(1) },
        end: Framing { size: Some(ShotSize::Long), ..Framing::default() },
        ..Step::of(Move::ZoomOut)
    }];
    let solution = solved(&world(), steps);
    let unmet: Vec<_> = solution.report.iter().filter(|line| !line.met && line.wanted.contains("height")).collect();
    assert!(unmet.is_empty(), "{unmet:?}");
    let last = film(&solution).last().copied().unwrap();
    assert!(last.fov_y_rad.to_degrees() > 53.0, "the room under {} degrees", last.fov_y_rad.to_degrees());
}

#[test]
fn the_floor_of_a_room_is_not_the_ground_outside() {
    let (mut gaussians, objects) = room();
    for (corner, along) in [(DVec3::new(3.5, -0.6, -9.0), DVec3::X), (DVec3::new(-9.5, -0.6, -9.0), DVec3::X)] {
        wall(&mut gaussians, corner, along * 6.0, DVec3::Z * 18.0);
    }
    let world = World::new(&gaussians, DVec3::Y, &objects, &[1]).unwrap();
    assert!(world.is_indoor());
    let step = Step { end: Framing { height: Some(1.3), ..about(1) }, ..Step::of(Move::Static) };
    let eye = film(&solved(&world, vec![step]))[0].pose.position;
    assert!((eye.y - 1.3).abs() < 0.2, "1.3 above the floor, camera at {eye}");
}

#[test]
fn a_pan_of_a_full_turn_comes_round() {
    let step = Step { amount: Some(Amount::Degrees(360.0)), ..Step::of(Move::PanRight) };
    let frames = film(&solved(&world(), vec![step]));
    let yaw = |state: &CameraState| state.pose.forward().x.atan2(state.pose.forward().z);
    let turn = |pair: &[CameraState]| {
        (yaw(&pair[1]) - yaw(&pair[0]) + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU) - std::f64::consts::PI
    };
    let turns = frames.windows(2).map(|pair| turn(pair).to_degrees().abs());
    let (turned, most) = turns.fold((0.0, 0.0_f64), |(sum, most), deg| (sum + deg, most.max(deg)));
    assert!((turned - 360.0).abs() < 0.1, "turned by {turned} degrees");
    assert!(most < 9.0, "{most} degrees in a tenth of a second");
    assert!(frames[0].pose.forward().distance(frames[frames.len() - 1].pose.forward()) < 1e-6);
}

#[test]
fn a_pan_from_thing_to_thing_changes_the_picture() {
    for seed in 0..4 {
        let steps = vec![Step { start: about(1), end: about(2), either_way: true, ..Step::of(Move::PanRight) }];
        let settings = SolveSettings { level: SolveLevel::Fast, seed, ..SolveSettings::default() };
        let frames = film(&realize(&world(), &Program { steps, ..Program::default() }, "", &[], &settings));
        let (first, last) = (&frames[0], &frames[frames.len() - 1]);
        let field_deg = 2.0 * ((first.fov_y_rad / 2.0).tan() * 16.0 / 9.0).atan().to_degrees();
        let turned_deg = first.pose.forward().angle_between(last.pose.forward()).to_degrees();
        assert!(turned_deg > 0.45 * field_deg, "seed {seed}: {turned_deg} of {field_deg} degrees");
    }
}

#[test]
fn a_push_in_without_a_stated_size_ends_before_the_frame_cuts_its_subject() {
    for seed in 0..4 {
        let steps = vec![Step { end: about(1), ..Step::of(Move::PushIn) }];
        let settings = SolveSettings { level: SolveLevel::Fast, seed, ..SolveSettings::default() };
        let frames = film(&realize(&world(), &Program { steps, ..Program::default() }, "", &[], &settings));
        let last = &frames[frames.len() - 1];
        for i in 0..8 {
            let sign = |bit: i32| if i >> bit & 1 == 1 { 1.0 } else { -1.0 };
            let corner = in_frame(last, CENTER + HALF * DVec3::new(sign(0), sign(1), sign(2)));
            assert!(corner.abs().max_element() < 0.52, "seed {seed}: corner at {corner}");
        }
    }
}

#[test]
fn a_flat_thing_is_not_filmed_from_its_edge() {
    // A sheet across the diagonal of its box: from the box alone both of its diagonals look alike.
    for turn_deg in [35.0_f64, 145.0] {
        let normal = DVec3::new(turn_deg.to_radians().cos(), 0.0, turn_deg.to_radians().sin());
        let across = DVec3::Y.cross(normal);
        let mut gaussians = Gaussians::default();
        for (i, j) in (-20..=20).flat_map(|i| (-12..=12).map(move |j| (i, j))) {
            let at = across * f64::from(i) * 0.03 + DVec3::Y * f64::from(j) * 0.03;
            let rotation = Quat::from_rotation_arc(Vec3::Z, normal.as_vec3());
            add(&mut gaussians, at, Vec3::new(0.03, 0.03, 0.002), rotation, 0.95);
        }
        let half = DVec3::new(0.6 * across.x.abs(), 0.36, 0.6 * across.z.abs());
        let objects =
            vec![Object { num_gaussians: gaussians.len(), ..Object::from_box(1, "sheet", DVec3::ZERO, half) }];
        let world = World::new(&gaussians, DVec3::Y, &ObjectSet { objects, labels: Vec::new() }, &[1]).unwrap();
        for seed in 0..3 {
            let steps = vec![Step { end: about(1), ..Step::of(Move::Static) }];
            let settings = SolveSettings { level: SolveLevel::Fast, seed, ..SolveSettings::default() };
            let solution = realize(&world, &Program { steps, ..Program::default() }, "", &[], &settings);
            let eye = film(&solution)[0].pose.position.with_y(0.0).normalize();
            assert!(eye.dot(normal).abs() > 0.5, "normal {normal}, seed {seed}: filmed from {eye}");
        }
    }
}

#[test]
fn a_film_that_widens_out_stays_in_the_room() {
    let (mut gaussians, mut objects) = room();
    // Something small on top of box 1.
    let (center, half) = (DVec3::new(1.2, 1.24, 0.9), DVec3::splat(0.04));
    let first = gaussians.len();
    for i in 0..64 {
        let at = |bit: i32| f64::from(i >> bit & 3) / 3.0 * 2.0 - 1.0;
        let mean = center + half * DVec3::new(at(0), at(2), at(4));
        add(&mut gaussians, mean, Vec3::splat(0.01), Quat::IDENTITY, 0.95);
    }
    let small = Object { num_gaussians: gaussians.len() - first, ..Object::from_box(3, "die", center, half) };
    objects.objects.push(small);
    let world = World::new(&gaussians, DVec3::Y, &objects, &[1, 2, 3]).unwrap();
    let close = Framing { size: Some(ShotSize::CloseUp), ..about(3) };
    let both = Framing { subjects: vec![3, 2], whole: true, ..Framing::default() };
    let steps = vec![Step { end: close, ..Step::of(Move::Static) }, Step { end: both, ..Step::of(Move::PullOut) }];
    let eye = film(&solved(&world, steps)).last().unwrap().pose.position;
    assert!(eye.x.abs() < ROOM.x && eye.z.abs() < ROOM.z, "{eye} is outside");
}
