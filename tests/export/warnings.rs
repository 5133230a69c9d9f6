//! Warnings name the properties that a format cannot hold, and nothing else.

use cinesplat::export::{Content, Format};
use cinesplat::trajectory::{Easing, EffectRequest, Shot};
use glam::{DQuat, DVec3};

use super::sample_shot::{key, shot, there_and_back, with_cut};

#[test]
fn every_loss_has_a_line() {
    let lines = |format: Format, name: &str| there_and_back(&with_cut(), format, name, Content::Keyframes).1.join("\n");
    insta::assert_snapshot!(lines(Format::Tum, "a.tum"), @r"
    tum holds no field of view: 35.000 to 50.000 degrees are lost
    tum holds no image size
    tum holds no focus distance
    tum holds no cuts: other programs may interpolate across them
    ");
    insta::assert_snapshot!(lines(Format::Kitti, "a.kitti"), @r"
    kitti holds no times: only the order of the frames is kept
    kitti holds no field of view: 35.000 to 50.000 degrees are lost
    kitti holds no image size
    kitti holds no focus distance
    kitti holds no cuts: other programs may interpolate across them
    ");
    insta::assert_snapshot!(lines(Format::Usd, "a.usda"), @"usd joins keyframes with lines: up to 0.0000 scene units (at 0.50 s), 0.67 degrees and a field of view 0.00 degrees off the film; export every frame for the path of the film");
    insta::assert_snapshot!(lines(Format::Supersplat, "settings.json"), @r"
    supersplat holds no image size
    supersplat holds no focus distance
    supersplat holds no roll: up to 7.4 degrees relative to its up (-y) are lost
    supersplat's viewer plays the keys that hold both sides of a cut; its check for editors takes whole frames alone
    supersplat joins keyframes with its own spline: up to 0.0828 scene units (at 0.67 s), 8.31 degrees and a field of view 0.70 degrees off the film; export every frame for the path of the film
    ");
    insta::assert_snapshot!(lines(Format::Cameras, "cameras.json"), @r"
    cameras holds no times: only the order of the frames is kept
    cameras holds no focus distance
    cameras holds no cuts: other programs may interpolate across them
    ");
}

/// A shot for 360 video became a path of plain pictures without a word.
#[test]
fn effects_that_other_programs_lack_are_named() {
    let request = |kind: &str| EffectRequest {
        kind: kind.to_owned(),
        because: "asked for".to_owned(),
        settings: Vec::new(),
        runs: None,
    };
    let shot = Shot { effects: vec![request("panorama"), request("film-grain")], ..with_cut() };
    for (format, name) in [(Format::Nerfstudio, "a.json"), (Format::Blender, "a.py"), (Format::Cameras, "cameras.json")]
    {
        let (_, warnings, _folder) = there_and_back(&shot, format, name, Content::Sampled);
        let line = format!("{format} holds no effects: panorama, film-grain are lost");
        assert!(warnings.contains(&line), "{warnings:?}");
    }
    let (_, warnings, _folder) = there_and_back(&shot, Format::Shot, "a.shot.json", Content::Keyframes);
    assert_eq!(warnings, Vec::<String>::new());
}

#[test]
fn a_lens_that_lichtfeld_would_clamp_is_named() {
    let mut wide = with_cut();
    wide.keyframes[0].fov_y_rad = 2.2;
    let (_, warnings, _folder) = there_and_back(&wide, Format::Lichtfeld, "a.json", Content::Sampled);
    assert!(warnings.iter().any(|line| line.contains("10 to 200 mm")), "{warnings:?}");
}

#[test]
fn easings_that_lichtfeld_lacks_become_a_key_per_frame() {
    let mut eased = with_cut();
    eased.keyframes.iter_mut().for_each(|key| key.cut = false);
    eased.keyframes[0].easing = Easing::SineIn;
    let (imported, warnings, _folder) = there_and_back(&eased, Format::Lichtfeld, "a.json", Content::Keyframes);
    assert_eq!(imported.track.frames.len(), eased.num_frames());
    let line = "lichtfeld has linear and cubic easings: every frame is a key, because 1 of 4 keys ease otherwise";
    assert!(warnings.iter().any(|warning| warning == line), "{warnings:?}");
    // Those that it has stay, and the line about its own spline follows them.
    for (easing, number) in [(Easing::CubicIn, 1), (Easing::CubicOut, 2), (Easing::CubicInOut, 3)] {
        eased.keyframes[0].easing = easing;
        let (imported, warnings, folder) = there_and_back(&eased, Format::Lichtfeld, "a.json", Content::Keyframes);
        assert_eq!((imported.track.frames.len(), imported.track.frames[0].easing), (4, easing));
        let text = std::fs::read_to_string(folder.path().join("a.json")).unwrap();
        assert!(text.contains(&format!("\"easing\": {number}")), "{text}");
        assert!(warnings.iter().any(|line| line.starts_with("lichtfeld joins keyframes with its own spline")));
    }
}

#[test]
fn the_ends_of_lichtfelds_spline_stray_by_a_known_share() {
    let keys = [0.0, 1.0, 2.0, 3.0].map(|secs| key(secs, DVec3::new(0.0, 0.0, secs), DQuat::IDENTITY, 40.0));
    let line = shot(keys.to_vec(), DVec3::NEG_Y);
    let (_, warnings, _folder) = there_and_back(&line, Format::Lichtfeld, "a.json", Content::Keyframes);
    // Without a key before the first, the spline there is (t + 2 t^2 - t^3) / 2: at a third of a second 2/27 behind.
    let expected = "up to 0.0741 scene units (at 0.33 s), 0.00 degrees and a field of view 0.00 degrees off the film";
    assert!(warnings.iter().any(|warning| warning.contains(expected)), "{warnings:?}");
}
