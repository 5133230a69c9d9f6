//! Paths that positions alone cannot align: straight, stationary, turning in place, one pose.

use cinesplat::evaluation::{Align, EvalSettings, Evaluation, Relation, Trajectory, evaluate};
use cinesplat::geometry::{Pose, rotation};
use glam::{DMat3, DQuat, DVec3};
use strum::VariantArray;

use super::paths::{at_30_fps, through};

/// The path after a known rotation, scale and translation, which the alignment has to invert.
fn displaced(path: &Trajectory, turn: DQuat, shift: DVec3, scale: f64) -> Trajectory {
    let mut out = path.clone();
    out.positions.iter_mut().for_each(|p| *p = turn * (*p * scale) + shift);
    out.rotations.iter_mut().for_each(|r| *r = DMat3::from_quat(turn) * *r);
    out
}

fn full(reference: &Trajectory, estimate: &Trajectory, align: Align) -> Evaluation {
    evaluate(reference, estimate, &EvalSettings { align, relation: Relation::Full, ..EvalSettings::default() }).unwrap()
}

fn turn() -> DQuat {
    rotation::exp(DVec3::new(0.3, -1.1, 2.0))
}

#[test]
fn a_straight_dolly_aligns_to_itself_with_its_roll() {
    let dolly =
        through((0..60).map(|k| DVec3::new(0.0, 0.3, 0.05 * f64::from(k))), rotation::exp(DVec3::new(0.2, 0.1, 0.4)));
    for (align, scale) in [(Align::Se3, 1.0), (Align::Sim3, 0.25), (Align::Sim3, 40.0)] {
        let result = full(&dolly, &displaced(&dolly, turn(), DVec3::new(4.0, 5.0, -6.0), scale), align);
        assert!(result.statistics.max < 1e-12, "{align:?}: {}", result.statistics.max);
        assert!((result.alignment.scale * scale - 1.0).abs() < 1e-12);
        assert!(result.notes.iter().any(|note| note.contains("straight line")), "{:?}", result.notes);
    }
}

#[test]
fn noise_on_a_straight_line_does_not_choose_the_roll() {
    // Lateral noise of a millionth of the length: evo accepts it, and the noise determines the roll.
    let mut seed = 1_u64;
    let mut noise = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 33) as f64 / f64::from(u32::MAX) * 2e-6
    };
    let line: Vec<DVec3> = (0..60).map(|k| DVec3::new(noise(), noise(), 0.05 * f64::from(k))).collect();
    let shaken: Vec<DVec3> = line.iter().map(|p| *p + DVec3::new(noise(), noise(), 0.0)).collect();
    let (reference, estimate) =
        (through(line.into_iter(), DQuat::IDENTITY), through(shaken.into_iter(), DQuat::IDENTITY));
    let result = full(&reference, &displaced(&estimate, turn(), DVec3::ONE, 1.0), Align::Se3);
    assert!(result.statistics.max < 1e-4, "{}", result.statistics.max);
}

#[test]
fn a_camera_that_only_turns_aligns_by_its_rotations() {
    let pan: Vec<Pose> =
        (0..45).map(|k| Pose::new(DVec3::new(1.0, 2.0, 3.0), DQuat::from_rotation_y(0.02 * f64::from(k)))).collect();
    let pan = at_30_fps(&pan);
    for align in [Align::Origin, Align::Se3, Align::Sim3] {
        let result = full(&pan, &displaced(&pan, turn(), DVec3::new(4.0, 5.0, -6.0), 1.0), align);
        assert!(result.statistics.max < 1e-12, "{align:?}: {}", result.statistics.max);
        assert_eq!((result.alignment.scale, result.notes.is_empty()), (1.0, align == Align::Origin));
    }
}

#[test]
fn one_pose_is_enough_for_every_alignment() {
    let one = through(std::iter::once(DVec3::new(1.0, 2.0, 3.0)), turn());
    for align in
        Align::VARIANTS.iter().copied().filter(|align| !matches!(align, Align::None | Align::Scale | Align::Yaw))
    {
        let result = full(&one, &displaced(&one, turn(), DVec3::ONE, 1.0), align);
        assert!(result.statistics.max < 1e-12, "{align:?}");
    }
    assert!(full(&one, &one, Align::None).statistics.max < 1e-14);
}

#[test]
fn yaw_turns_about_up_alone() {
    let bent = through(
        (0..60).map(|k| DVec3::new(f64::from(k).sin(), 0.01 * f64::from(k), 0.05 * f64::from(k))),
        DQuat::IDENTITY,
    );
    let bent = Trajectory { up: Some(DVec3::NEG_Y), ..bent };
    let heading = DQuat::from_rotation_y(1.2);
    let result = full(&bent, &displaced(&bent, heading, DVec3::new(3.0, -1.0, 2.0), 1.0), Align::Yaw);
    assert!(result.statistics.max < 1e-12 && result.notes.is_empty());
    // Yaw alignment does not correct a tilt: the up axis is unchanged.
    let tilted = full(&bent, &displaced(&bent, DQuat::from_rotation_x(0.2), DVec3::ZERO, 1.0), Align::Yaw);
    assert!((tilted.alignment.rotation * DVec3::Y - DVec3::Y).length() < 1e-12);
    assert!(tilted.statistics.rmse > 0.1);
}

#[test]
fn yaw_of_a_vertical_path_is_that_of_the_cameras() {
    let crane = through((0..30).map(|k| DVec3::NEG_Y * (0.1 * f64::from(k))), DQuat::from_rotation_y(0.4));
    let crane = Trajectory { up: Some(DVec3::NEG_Y), ..crane };
    let result = full(&crane, &displaced(&crane, DQuat::from_rotation_y(-2.0), DVec3::ONE, 1.0), Align::Yaw);
    assert!(result.statistics.max < 1e-12, "{}", result.statistics.max);
    assert!(result.notes.iter().any(|note| note.contains("no heading")));
}

#[test]
fn a_mirrored_path_is_not_mirrored_back() {
    let helix = through(
        (0..60).map(|k| DVec3::new(f64::from(k).cos(), f64::from(k).sin(), 0.1 * f64::from(k))),
        DQuat::IDENTITY,
    );
    let mut mirrored = helix.clone();
    mirrored.positions.iter_mut().for_each(|p| p.x = -p.x);
    let result = full(&helix, &mirrored, Align::Se3);
    assert!((result.alignment.rotation.determinant() - 1.0).abs() < 1e-12);
    assert!(result.statistics.max > 0.1);
}

#[test]
fn lens_errors_are_reported_beside_the_poses() {
    let zoomed = |fov_deg: f64| {
        let path = through((0..10).map(|k| DVec3::X * f64::from(k)), DQuat::IDENTITY);
        Trajectory { fov_y_rad: vec![Some(fov_deg.to_radians()); 10], ..path }
    };
    let result = full(&zoomed(90.0), &zoomed(53.130_102_354_155_98), Align::None);
    // tan of the half angles: 1 and 1 / 2, so the estimate's focal length is twice the reference's.
    let focal = result.focal.unwrap();
    assert!((focal.log_ratio_rmse - 2_f64.ln()).abs() < 1e-12 && (focal.log_ratio_mean - 2_f64.ln()).abs() < 1e-12);
}

#[test]
fn errors_over_the_diameter_do_not_depend_on_the_scale() {
    let path = |scale: f64| through((0..10).map(|k| DVec3::X * (scale * f64::from(k))), DQuat::IDENTITY);
    let off = |scale: f64| {
        let estimate = displaced(&path(scale), DQuat::IDENTITY, DVec3::Y * (0.9 * scale), 1.0);
        evaluate(&path(scale), &estimate, &EvalSettings::default()).unwrap().relative_to_diameter.unwrap()
    };
    assert!((off(1.0) - 0.1).abs() < 1e-12 && (off(1000.0) - 0.1).abs() < 1e-12);
}
