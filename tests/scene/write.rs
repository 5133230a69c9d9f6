use cinesplat::files::Existing;
use cinesplat::scene::{Gaussians, LoadOptions, load, write_ply};
use glam::{DVec3, Quat, Vec3};

fn some(origin: DVec3) -> Gaussians {
    let n = 20;
    let at = |i: usize| i as f32;
    Gaussians {
        origin,
        means: (0..n).map(|i| Vec3::new(at(i), 0.5 * at(i), 0.25)).collect(),
        scales: (0..n).map(|i| Vec3::new(0.01 + at(i), 1.0, 0.0)).collect(),
        rotations: (0..n).map(|i| Quat::from_rotation_x(0.1 * at(i))).collect(),
        opacities: (0..n).map(|i| at(i) / (n - 1) as f32).collect(),
        sh_dc: (0..n).map(|i| Vec3::splat(0.1 * at(i))).collect(),
        sh_degree: 2,
        sh_rest: (0..n * 8).map(|i| Vec3::new(at(i), -at(i), 0.5)).collect(),
        ids: (0..n).map(|i| (i / 7) as u16).collect(),
    }
}

#[test]
fn written_gaussians_are_read_back() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("out.ply");
    for origin in [DVec3::ZERO, DVec3::new(5e5, 5e6, 128.0)] {
        let wanted = some(origin);
        write_ply(&path, &wanted, &["Vertical Axis: z".to_owned(), "two\nlines".to_owned()], Existing::Replace)
            .unwrap();
        let scene = load(&path, &LoadOptions::default()).unwrap();
        let found = &scene.gaussians;
        assert_eq!(
            (scene.up, &found.ids, &found.sh_dc, &found.sh_rest),
            (DVec3::Z, &wanted.ids, &wanted.sh_dc, &wanted.sh_rest)
        );
        for i in 0..wanted.len() {
            assert_eq!(found.mean_world(i), wanted.mean_world(i));
            assert!((found.opacities[i] - wanted.opacities[i]).abs() < 1e-6);
            assert!(((found.scales[i] - wanted.scales[i]) / (wanted.scales[i] + 1e-20)).abs().max_element() < 1e-6);
            assert!(found.rotations[i].angle_between(wanted.rotations[i]) < 1e-3);
        }
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1, "the temporary file is gone");
}

#[test]
fn an_unwritable_path_is_an_error() {
    let folder = tempfile::tempdir().unwrap();
    let error = write_ply(&folder.path().join("no/such/out.ply"), &some(DVec3::ZERO), &[], Existing::Keep).unwrap_err();
    assert_eq!(error.code(), "OUTPUT-CREATE");
}
