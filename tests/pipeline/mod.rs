//! The pipeline used as a library.

mod directed;
mod forecast;
mod job;
mod promises;

use std::ops::ControlFlow;
use std::path::Path;

use cinesplat::pipeline::{FilmProgress, FilmSettings, FrameRange, Piece, PipelineError, film, open_scene};
use cinesplat::render::{Quality, RenderSettings, Renderer};
use cinesplat::scene::{LoadOptions, Scene};
use cinesplat::trajectory::Shot;
use cinesplat::video::VideoSettings;

const SHOT: &str = r#"{"format":"cinesplat.shot","version":1,"width":48,"height":28,"fps":10,"duration_secs":1,"keyframes":[
    {"time_secs":0,"position":[0,1.2,1.5],"rotation_xyzw":[1,0,0,0],"fov_y_deg":50,"easing":"smooth"},
    {"time_secs":1,"position":[0.3,1.2,1.5],"rotation_xyzw":[1,0,0,0],"fov_y_deg":50,"easing":"smooth"}]}"#;

fn scene() -> Scene {
    open_scene(Path::new("synth:tabletop:1:0.02"), &LoadOptions::default()).unwrap().scene
}

fn shot() -> Shot {
    cinesplat::export::shot_json::read(SHOT).unwrap().shot
}

fn settings() -> FilmSettings {
    FilmSettings {
        effects: cinesplat::lens::EffectChoice::Auto,
        render: RenderSettings { quality: Quality::Draft, near: 0.05, ..RenderSettings::default() },
        video: VideoSettings::default(),
        frames: FrameRange::default(),
        sheet: None,
        job: None,
        promise: None,
    }
}

#[test]
fn ranges_of_frames_are_parsed() {
    let of_ten = |text: &str| text.parse::<FrameRange>().unwrap().of_film(10).ok();
    assert_eq!(of_ten("2..5"), Some(2..5));
    assert_eq!(of_ten(".."), Some(0..10));
    assert_eq!(of_ten("..4"), Some(0..4));
    assert_eq!(of_ten("4.."), Some(4..10));
    assert_eq!([of_ten("5..5"), of_ten("7..3"), of_ten("0..11"), of_ten("10..")], [None, None, None, None]);
    for wrong in ["", "5", "a..b", "-1..3", "1...3", "1..=3"] {
        assert!(wrong.parse::<FrameRange>().is_err(), "{wrong:?}");
    }
}

#[test]
fn every_piece_begins_at_a_place_of_its_own_and_goes_around() {
    let order = |piece: &str| piece.parse::<Piece>().unwrap().order(10..15).collect::<Vec<_>>();
    assert_eq!(order("1/2"), [10, 11, 12, 13, 14]);
    assert_eq!(order("2/2"), [12, 13, 14, 10, 11]);
    assert_eq!(order("7/7"), [14, 10, 11, 12, 13], "more pieces than frames");
    for wrong in ["", "1", "0/3", "4/3", "1/0", "-1/2", "1/2/3"] {
        assert!(wrong.parse::<Piece>().is_err(), "{wrong:?}");
    }
}

#[test]
fn generated_scenes_are_opened_by_name() {
    let open = |name: &str| open_scene(Path::new(name), &LoadOptions::default());
    let source = open("synth:tabletop:1:0.02").unwrap();
    let objects = source.objects.unwrap();
    assert_eq!(objects.labels.len(), source.scene.gaussians.len());
    for object in &objects.objects {
        let members = objects.labels.iter().filter(|&&label| u32::from(label) == object.id).count();
        assert_eq!(object.num_gaussians, members, "{}", object.label);
    }
    for wrong in ["synth:", "synth:room", "synth:room:x", "synth:room:1:9", "synth:room:1:1:1", "synth:cave:1"] {
        assert!(matches!(open(wrong), Err(PipelineError::UnknownSynth { .. })), "{wrong}");
    }
}

#[test]
fn progress_is_reported_once_per_frame() {
    let folder = tempfile::tempdir().unwrap();
    let mut seen = Vec::new();
    let mut watch = |progress: FilmProgress| {
        seen.push((progress.done, progress.total));
        ControlFlow::Continue(())
    };
    let path = folder.path().join("film.mkv");
    let report = film(&Renderer::new(&scene().gaussians), &shot(), &path, &settings(), &mut watch).unwrap();
    assert_eq!(seen, (1..=10).map(|done| (done, 10)).collect::<Vec<_>>());
    assert_eq!((report.num_frames, report.is_partial(), report.path), (10, false, path));
}

#[test]
fn a_resting_camera_repeats_its_frame() {
    let folder = tempfile::tempdir().unwrap();
    let mut resting = shot();
    // The camera rests in the first half and moves in the second.
    let mut middle = resting.keyframes[0].clone();
    middle.time_secs = 0.5;
    resting.keyframes.insert(1, middle);
    let (scene, path) = (scene(), folder.path().join("%02d.png"));
    film(&Renderer::new(&scene.gaussians), &resting, &path, &settings(), &mut |_| ControlFlow::Continue(())).unwrap();
    let frame = |idx: usize| std::fs::read(folder.path().join(format!("{idx:02}.png"))).unwrap();
    for idx in 1..=4 {
        assert_eq!(frame(idx), frame(0), "frame {idx}");
    }
    for idx in 6..10 {
        assert_ne!(frame(idx), frame(idx - 1), "frame {idx}");
    }
}

#[test]
fn a_stopped_film_without_a_job_folder_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let mut watch =
        |progress: FilmProgress| if progress.done == 4 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) };
    let path = folder.path().join("film.mkv");
    let report = film(&Renderer::new(&scene().gaussians), &shot(), &path, &settings(), &mut watch).unwrap();
    assert_eq!((report.num_frames, report.num_wanted, report.is_partial()), (4, 10, true));
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn a_film_that_cannot_be_rendered_leaves_no_file() {
    let folder = tempfile::tempdir().unwrap();
    let broken = FilmSettings { render: RenderSettings { near: f64::NAN, ..settings().render }, ..settings() };
    let made = film(&Renderer::new(&scene().gaussians), &shot(), &folder.path().join("film.mp4"), &broken, &mut |_| {
        ControlFlow::Continue(())
    });
    assert!(matches!(made, Err(PipelineError::Render(_))), "{made:?}");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn an_error_of_the_encoder_is_returned() {
    let folder = tempfile::tempdir().unwrap();
    let mut appears = |progress: FilmProgress| {
        if progress.done == 1 {
            std::fs::write(folder.path().join("frames/05.png"), "mine").unwrap();
        }
        ControlFlow::Continue(())
    };
    let made = film(
        &Renderer::new(&scene().gaussians),
        &shot(),
        &folder.path().join("frames/%02d.png"),
        &settings(),
        &mut appears,
    );
    assert!(matches!(&made, Err(PipelineError::Video(error)) if error.code() == "OUTPUT-EXISTS"), "{made:?}");
    assert_eq!(std::fs::read(folder.path().join("frames/05.png")).unwrap(), b"mine");
}
