use cinesplat::pipeline::open_scene;
use cinesplat::scene::{Gaussians, LoadOptions, UpPrior, UpSource, estimate_up, load, up_estimates};
use glam::{DQuat, DVec3};
use std::path::Path;

use crate::support;

fn shared_scene(name: &str) -> Option<Gaussians> {
    let path = support::shared(&format!("data/{name}"))?;
    Some(load(&path, &LoadOptions::default()).unwrap().gaussians)
}

/// Up directions from the manifest; the files do not state them.
#[test]
fn estimate_agrees_with_the_manifest() {
    let living_room = DVec3::new(0.004, -0.9995, -0.031);
    let table = [
        ("kitchen/scene.spz", DVec3::Y),
        ("composites/kitchen_plus_dev.spz", DVec3::Y),
        ("composites/livingroom_surfels.spz", living_room),
        ("guitar/guitar.compressed.ply", DVec3::NEG_Y),
        ("skull/skull.sog", DVec3::NEG_Y),
        ("palm/centered_lastchance.splat", DVec3::NEG_Y),
        ("playbot/2_0", DVec3::NEG_Y),
        ("playbot/6_0", DVec3::NEG_Y),
        ("logo_sogv1", DVec3::NEG_Y),
    ];
    for (name, up) in table {
        let Some(path) = support::shared(&format!("data/{name}")) else { continue };
        let scene = load(&path, &LoadOptions::default()).unwrap();
        let off = scene.up.angle_between(up.normalize()).to_degrees();
        assert!(off < 0.6, "{name}: {} is {off:.2} degrees off", scene.up);
        assert!(matches!(scene.up_source, UpSource::Estimated(50..)), "{name}: {:?}", scene.up_source);
    }
}

/// The same scenes, rotated: the estimate must follow the floor, against the prior of the kind of file.
#[test]
fn estimate_follows_a_rotated_scene() {
    let living_room = DVec3::new(0.004, -0.9995, -0.031).normalize();
    for (name, up) in [
        ("kitchen/scene.spz", DVec3::Y),
        ("composites/livingroom_surfels.spz", living_room),
        ("playbot/4_0", DVec3::NEG_Y),
    ] {
        let Some(gaussians) = shared_scene(name) else { continue };
        for (to, tilt_deg, prior) in [
            (DVec3::NEG_Y, 15.0, UpPrior::PlyFrame),
            (DVec3::NEG_Y, 40.0, UpPrior::PlyFrame),
            (DVec3::Y, 0.0, UpPrior::PlyFrame),
            (DVec3::Z, 0.0, UpPrior::PlyFrame),
            (DVec3::NEG_Y, 20.0, UpPrior::Spz),
        ] {
            let tilt = DQuat::from_axis_angle(DVec3::X, f64::to_radians(tilt_deg));
            let turn = tilt * DQuat::from_rotation_arc(up, to) * DQuat::from_axis_angle(up, 0.7);
            let found = estimate_up(&turned(&gaussians, turn), prior).up;
            let off = found.angle_between(turn * up).to_degrees();
            assert!(off < 1.0, "{name} to {to}, tilt {tilt_deg}: {off:.2} degrees off");
        }
    }
}

fn turned(gaussians: &Gaussians, turn: DQuat) -> Gaussians {
    let mut out = gaussians.clone();
    out.means.iter_mut().for_each(|mean| *mean = (turn * mean.as_dvec3()).as_vec3());
    out.rotations.iter_mut().for_each(|rotation| *rotation = (turn * rotation.as_dquat()).as_quat());
    out
}

#[test]
fn without_evidence_the_prior_decides() {
    let ball = Gaussians {
        means: vec![glam::Vec3::ZERO],
        scales: vec![glam::Vec3::ONE],
        rotations: vec![glam::Quat::IDENTITY],
        opacities: vec![1.0],
        sh_dc: vec![glam::Vec3::ZERO],
        ..Gaussians::default()
    };
    assert_eq!(estimate_up(&ball, UpPrior::PlyFrame).up, DVec3::NEG_Y);
    assert_eq!(estimate_up(&ball, UpPrior::Spz).up, DVec3::Y);
    assert_eq!(estimate_up(&Gaussians::default(), UpPrior::PlyFrame).up, DVec3::NEG_Y);
}

/// Random poses, without what a kind of file suggests. The scans of rooms are right in every one of them.
#[test]
fn up_does_not_depend_on_the_pose_of_the_file() {
    let mut rooms = Vec::new();
    for name in ["synth:room:501:0.06", "synth:room:502:0.06", "synth:tabletop:501:0.06", "synth:tabletop:502:0.06"] {
        let scene = open_scene(Path::new(name), &LoadOptions::default()).unwrap().scene;
        rooms.push((name, scene.gaussians, DVec3::Y));
    }
    for (name, up) in [
        ("playbot/6_0", DVec3::NEG_Y),
        ("composites/livingroom_surfels.spz", DVec3::new(0.004, -0.9995, -0.031)),
        ("skull/skull.sog", DVec3::NEG_Y),
    ] {
        rooms.extend(shared_scene(name).map(|gaussians| (name, gaussians, up.normalize())));
    }
    for (name, gaussians, up) in rooms {
        for (x, y, z) in [(0.3, -1.2, 2.1), (2.8, 0.4, -0.9)] {
            let turn = DQuat::from_euler(glam::EulerRot::XYZ, x, y, z);
            let found = estimate_up(&turned(&gaussians, turn), UpPrior::Any).up;
            let off = found.angle_between(turn * up).to_degrees();
            assert!(off < 5.0, "{name}: {off:.2} degrees off");
        }
    }
}

/// A cube looks the same from all sides, so that no side can be sure to be up, and all are named.
#[test]
fn the_candidates_of_a_cube_are_unsure_and_add_up() {
    let mut cube = Gaussians::default();
    crate::objects::push_box(&mut cube, DVec3::ZERO, DVec3::ONE, 0.1, glam::Vec3::splat(0.5));
    let turn = DQuat::from_euler(glam::EulerRot::XYZ, 0.4, 0.9, -0.3);
    let found = up_estimates(&turned(&cube, turn), UpPrior::Any);
    let axes = [DVec3::X, DVec3::Y, DVec3::Z].into_iter().flat_map(|axis| [turn * axis, -(turn * axis)]);
    for axis in axes {
        let nearest = found.iter().map(|c| c.up.angle_between(axis).to_degrees()).fold(180.0, f64::min);
        assert!(nearest < 6.0, "a side is no candidate: {nearest} degrees off");
    }
    assert!(found[0].confidence_percent < 50, "{:?}", found[0]);
    let sum: u32 = found.iter().map(|c| u32::from(c.confidence_percent)).sum();
    assert!((90..=110).contains(&sum), "{sum}");
}
