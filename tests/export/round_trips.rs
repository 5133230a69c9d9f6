//! Random shots read back from every format, to the precision of the format.

use cinesplat::export::{Content, EncodedFiles, ExportSettings, Format, ImportSettings, PoseTrack, encode};
use cinesplat::geometry::{Pose, rotation};
use cinesplat::trajectory::{Easing, Keyframe, ReportLine, SceneRef, Shot};
use glam::{DQuat, DVec3};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

use super::sample_shot::{key, shot, there_and_back, with_cut};

/// A format, a file name, and the properties that the format keeps.
struct Row {
    format: Format,
    name: &'static str,
    /// Largest error of a position of size 1, and of an angle in rad.
    tolerance: f64,
    keeps_fov: bool,
    keeps_times: bool,
    keeps_size: bool,
}

const fn row(format: Format, name: &'static str, tolerance: f64) -> Row {
    Row { format, name, tolerance, keeps_fov: true, keeps_times: true, keeps_size: true }
}

const ROWS: [Row; 16] = [
    Row { keeps_fov: false, keeps_size: false, ..row(Format::Tum, "a.txt", 1e-14) },
    Row { keeps_fov: false, keeps_times: false, keeps_size: false, ..row(Format::Kitti, "b.txt", 1e-14) },
    Row { keeps_fov: false, keeps_size: false, ..row(Format::Euroc, "c.csv", 1e-14) },
    row(Format::Nerfstudio, "d.json", 1e-14),
    row(Format::Transforms, "e.json", 1e-14),
    Row { keeps_times: false, ..row(Format::Colmap, "sparse", 1e-14) },
    Row { keeps_times: false, ..row(Format::Colmap, "images.bin", 1e-14) },
    Row { keeps_size: false, ..row(Format::Lichtfeld, "f.json", 1e-14) },
    Row { keeps_size: false, ..row(Format::Gltf, "g.gltf", 1e-6) },
    Row { keeps_size: false, ..row(Format::Gltf, "g.glb", 1e-6) },
    row(Format::Usd, "h.usda", 1e-14),
    row(Format::Blender, "i.py", 1e-14),
    Row { keeps_size: false, ..row(Format::Csv, "j.csv", 1e-14) },
    Row { keeps_fov: false, keeps_times: false, keeps_size: false, ..row(Format::Log, "k.log", 1e-14) },
    Row { keeps_times: false, ..row(Format::Cameras, "m.json", 1e-14) },
    row(Format::Shot, "l.json", 1e-14),
];

fn rotations() -> impl Strategy<Value = DQuat> {
    let part = || -1.0..1.0_f64;
    (part(), part(), part(), part())
        .prop_map(|(x, y, z, w)| DQuat::from_xyzw(x, y, z, w))
        .prop_filter("a direction", |q| q.length() > 0.1)
        .prop_map(DQuat::normalize)
}

pub(super) fn shots() -> impl Strategy<Value = Shot> {
    let position = || (-5.0..5.0_f64, -5.0..5.0_f64, -5.0..5.0_f64).prop_map(|(x, y, z)| DVec3::new(x, y, z));
    let keys = prop::collection::vec((0.2..1.0_f64, position(), rotations(), 15.0..90.0_f64, prop::bool::ANY), 1..5);
    let sizes = prop::sample::select(vec![(1280, 720), (720, 1280), (1080, 1080), (1998, 1080)]);
    let rates = prop::sample::select(vec![24.0, 25.0, 30_000.0 / 1001.0, 120.0]);
    (keys, rotations(), sizes, rates).prop_map(|(keys, up, (width, height), fps)| {
        let mut time_secs = -0.2;
        let keyframes: Vec<_> = keys
            .into_iter()
            .map(|(step, position, turn, fov_deg, is_cut)| {
                let cut = is_cut && time_secs >= 0.0;
                time_secs = if time_secs < 0.0 { 0.0 } else { time_secs + step };
                Keyframe { cut, ..key(time_secs, position, turn, fov_deg) }
            })
            .collect();
        Shot { width, height, fps, ..shot(keyframes, up * DVec3::Y) }
    })
}

fn check(shot: &Shot, row: &Row, content: Content) {
    let wanted = match content {
        Content::Sampled => PoseTrack::sampled(shot, None).unwrap(),
        Content::Keyframes => PoseTrack::keyframes(shot),
    };
    let (imported, _, _folder) = there_and_back(shot, row.format, row.name, content);
    let (name, mut got) = (row.name, imported.track);
    if content == Content::Keyframes && !got.keys.is_empty() {
        // The path of every frame stands beside the keyframes.
        got.frames = got.keys.clone();
    }
    assert_eq!((imported.format, got.timed), (row.format, row.keeps_times), "{name}");
    assert_eq!(got.frames.len(), wanted.frames.len(), "{name}");
    assert_eq!(got.size_px == wanted.size_px, row.keeps_size || got.size_px == Some((1280, 720)), "{name}");
    for (a, b) in wanted.frames.iter().zip(&got.frames) {
        let moved = (a.pose.position - b.pose.position).length();
        let turned = rotation::angle_between(a.pose.rotation, b.pose.rotation);
        assert!(
            moved < 20.0 * row.tolerance && turned < 10.0 * row.tolerance,
            "{name}: moved {moved}, turned {turned}"
        );
        let zoomed = b.fov_y_rad.map(|fov| (fov - a.fov_y_rad.unwrap()).abs());
        assert_eq!(zoomed.is_some_and(|zoomed| zoomed < 10.0 * row.tolerance), row.keeps_fov, "{name}: {zoomed:?}");
        let holds_cuts =
            matches!(row.format, Format::Gltf | Format::Usd | Format::Blender | Format::Csv | Format::Shot);
        assert!(!holds_cuts || a.cut == b.cut, "{name}: a cut is {}", b.cut);
        let late = (a.time_secs - b.time_secs).abs();
        // Key times are sums of transitions in nerfstudio and whole nanoseconds in EuRoC.
        assert!(!row.keeps_times || late < 1e-9_f64.max(row.tolerance), "{name}: {late} s late");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 12, failure_persistence: None, rng_seed: RngSeed::Fixed(7), ..ProptestConfig::default() })]

    #[test]
    fn frames_of_random_shots(shot in shots()) {
        for row in &ROWS {
            check(&shot, row, Content::Sampled);
        }
    }

    #[test]
    fn keyframes_of_random_shots(shot in shots()) {
        for row in &ROWS {
            check(&shot, row, Content::Keyframes);
        }
    }
}

/// SuperSplat's viewer holds no roll: level cameras keep everything else, in portrait sizes as well.
#[test]
fn level_shots_through_supersplats_settings_in_every_size_and_rate() {
    for (width, height) in [(1280, 720), (720, 1280), (1080, 1080), (1998, 1080)] {
        for fps in [24.0, 25.0, 30_000.0 / 1001.0, 120.0] {
            let at = |secs: f64, x: f64| {
                let pose = Pose::look_at(DVec3::new(x, -2.0, 0.5 * x), DVec3::new(1.0, -1.0, 5.0), DVec3::NEG_Y, None)
                    .unwrap();
                key(secs, pose.position, pose.rotation, 30.0 + 10.0 * secs)
            };
            let mut level =
                Shot { width, height, fps, ..shot(vec![at(0.0, 0.0), at(0.5, 1.0), at(1.0, -3.0)], DVec3::NEG_Y) };
            level.keyframes[2].cut = true;
            let wanted = PoseTrack::keyframes(&level);
            let (imported, ..) = there_and_back(&level, Format::Supersplat, "settings.json", Content::Keyframes);
            let settings = ImportSettings { size_px: Some((width, height)), ..ImportSettings::default() };
            let (back, _) = imported.into_shot(&settings).unwrap();
            assert_eq!(back.keyframes.iter().filter(|key| key.cut).count(), 1, "{width} x {height} at {fps}");
            for a in &wanted.frames {
                let late = |key: &&Keyframe| (key.time_secs - a.time_secs).abs();
                let b = back.keyframes.iter().min_by(|x, y| late(x).total_cmp(&late(y))).unwrap();
                assert!(late(&b) < 1e-9, "{width} x {height} at {fps}: {} s", late(&b));
                assert!(b.pose.position.distance(a.pose.position) < 1e-9);
                assert!(rotation::angle_between(a.pose.rotation, b.pose.rotation) < 1e-6);
                assert!((b.fov_y_rad - a.fov_y_rad.unwrap()).abs() < 1e-9, "{width} x {height}: {}", b.fov_y_rad);
            }
        }
    }
}

#[test]
fn cuts_read_back_from_formats_that_hold_them() {
    let cuts = |track: &PoseTrack| track.frames.iter().map(|frame| frame.cut).collect::<Vec<_>>();
    let wanted = PoseTrack::sampled(&with_cut(), None).unwrap();
    assert_eq!(cuts(&wanted).iter().position(|cut| *cut), Some(48));
    for name in ["a.gltf", "a.glb", "a.usda", "a.py", "a.csv", "a.shot.json"] {
        let format = Format::from_path(name.as_ref()).unwrap();
        let (imported, _, _folder) = there_and_back(&with_cut(), format, name, Content::Sampled);
        assert_eq!(cuts(&imported.track), cuts(&wanted), "{name}");
    }
}

/// glTF holds times with 32 bits: a cut that came back a hair late showed one more frame of what was before it.
#[test]
fn the_frame_at_a_cut_is_behind_the_cut_in_every_format_that_holds_cuts() {
    for fps in [24.0, 25.0, 30_000.0 / 1001.0, 120.0] {
        let mut cut = with_cut();
        cut.fps = fps;
        cut.keyframes[2].time_secs = (1.58 * fps).round() / fps;
        let wanted = PoseTrack::sampled(&cut, None).unwrap().frames;
        for (name, content) in ["a.gltf", "a.glb", "a.usda", "a.py", "a.csv"]
            .into_iter()
            .flat_map(|name| [Content::Sampled, Content::Keyframes].map(|content| (name, content)))
        {
            let format = Format::from_path(name.as_ref()).unwrap();
            let (imported, _, _folder) = there_and_back(&cut, format, name, content);
            let settings = ImportSettings { fps: Some(fps), ..ImportSettings::default() };
            let (back, _) = imported.into_shot(&settings).unwrap();
            let got = PoseTrack::sampled(&back, None).unwrap().frames;
            let at = wanted.iter().position(|frame| frame.cut).unwrap();
            assert!(
                got[at].pose.position.distance(wanted[at].pose.position) < 1e-5,
                "{name} at {fps}: {} instead of {}",
                got[at].pose.position,
                wanted[at].pose.position
            );
        }
    }
}

/// Blender joined keyframes with lines, without a word on how far these are from the film.
#[test]
fn keyframes_in_blender_are_joined_by_curves_with_the_slopes_of_the_film() {
    let mut eased = with_cut();
    eased.keyframes[0].easing = Easing::Smooth;
    let settings = ExportSettings { content: Content::Keyframes, ..ExportSettings::default() };
    let encoded = encode(Format::Blender, &eased, &settings).unwrap();
    let EncodedFiles::Single(bytes) = encoded.files else { panic!("one file") };
    let text = String::from_utf8(bytes).unwrap();
    let data = text.split_once("DATA = ").unwrap().1.split_once("# end of DATA").unwrap().0;
    let data: serde_json::Value = serde_json::from_str(data).unwrap();
    let slope = |key: usize, side: usize| {
        let of = &data["frames"][key]["slopes"][side]["position"];
        DVec3::from_array([0, 1, 2].map(|k| of[k].as_f64().unwrap()))
    };
    // The first key rests, and nothing passes through a cut. The last piece is a line of one second.
    assert!(slope(0, 1).length() < 1e-2 && slope(1, 1) == DVec3::ZERO && slope(2, 0) == DVec3::ZERO);
    let way = eased.keyframes[3].pose.position - eased.keyframes[2].pose.position;
    let path = cinesplat::trajectory::CameraPath::new(&eased).unwrap();
    let passed = |secs: f64| (path.sample(secs + 1e-6).pose.position - path.sample(secs).pose.position) / 1e-6;
    assert!((slope(2, 1) - passed(2.0)).length() < 1e-3 * way.length(), "{} {}", slope(2, 1), passed(2.0));
    let strays = encoded.losses.iter().find(|line| line.contains("blender joins keyframes with Bezier curves"));
    assert!(strays.is_some(), "{:?}", encoded.losses);
}

#[test]
fn focus_distances_read_back_from_formats_that_hold_them() {
    for name in ["a.usda", "a.py", "a.csv", "a.shot.json"] {
        let format = Format::from_path(name.as_ref()).unwrap();
        let (imported, _, _folder) = there_and_back(&with_cut(), format, name, Content::Keyframes);
        let focus: Vec<_> = imported.track.frames.iter().map(|frame| frame.focus_distance).collect();
        assert_eq!(focus, [Some(2.0), Some(3.0), Some(4.0), Some(5.0)], "{name}");
    }
}

#[test]
fn a_shot_exported_with_its_keyframes_is_the_same_shot() {
    let shot = with_cut();
    let (imported, warnings, _folder) = there_and_back(&shot, Format::Shot, "a.shot.json", Content::Keyframes);
    let (back, assumed) = imported.into_shot(&ImportSettings::default()).unwrap();
    assert_eq!((back.keyframes.len(), back.scene.up), (4, Some(DVec3::NEG_Y)));
    assert!(warnings.is_empty() && assumed.is_empty());
}

#[test]
fn a_sampled_shot_keeps_its_prompt_and_says_what_it_drops() {
    let mut shot = with_cut();
    shot.keyframes[0].easing = Easing::Smooth;
    let line = ReportLine { clause: "c".into(), wanted: "w".into(), got: 1.0, met: true, note: String::new() };
    let shot = Shot {
        prompt: "push in".into(),
        seed: 7,
        scene: SceneRef { path: "room.spz".into(), ..shot.scene },
        report: vec![line],
        ..shot
    };
    let (imported, warnings, _folder) = there_and_back(&shot, Format::Shot, "a.shot.json", Content::Sampled);
    let (back, _) = imported.into_shot(&ImportSettings::default()).unwrap();
    assert_eq!((back.prompt, back.seed, back.scene), ("push in".to_owned(), 7, shot.scene));
    assert_eq!((back.keyframes.len(), back.report.len()), (72, 0));
    insta::assert_snapshot!(warnings.join("\n"), @r"
    shot: the easings of 1 of 4 keys are in the times of the sampled keys
    shot: the report does not apply to sampled keys (lines: 1)
    ");
}
