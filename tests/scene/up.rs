use cinesplat::scene::{Gaussians, LoadOptions, UpPrior, UpSource, estimate_up, load};
use glam::{DQuat, DVec3};

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
