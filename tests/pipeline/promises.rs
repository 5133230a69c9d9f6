//! Films that keep a least PSNR and a time.

use std::ops::ControlFlow;
use std::path::Path;
use std::time::{Duration, Instant};

use cinesplat::pipeline::{FilmReport, FilmSettings, PipelineError, Promise, Requirements, camera_at, film, promised};
use cinesplat::render::{Quality, RenderSettings, Renderer};
use cinesplat::scene::Scene;
use cinesplat::trajectory::{CameraPath, Shot};

use super::{scene, settings, shot};

/// A move of 24 frames from outside into the things on the table.
fn approach() -> Shot {
    let mut shot = Shot { fps: 24.0, width: 96, height: 54, ..shot() };
    shot.keyframes[1].pose.position.z -= 1.1;
    shot
}

fn filmed(scene: &Scene, shot: &Shot, settings: &FilmSettings) -> FilmReport {
    let folder = tempfile::tempdir().unwrap();
    let renderer = Renderer::new(&scene.gaussians);
    film(&renderer, shot, &folder.path().join("%03d.png"), settings, &mut |_| ControlFlow::Continue(())).unwrap()
}

/// PSNR against `reference` of every frame that was rendered, at the quality that it got.
fn psnrs_db(scene: &Scene, shot: &Shot, report: &FilmReport) -> Vec<f64> {
    let renderer = Renderer::new(&scene.gaussians);
    let path = CameraPath::new(shot).unwrap();
    let at = |frame_idx: usize, quality: Quality| {
        let render = RenderSettings { quality, ..settings().render };
        renderer.render(&camera_at(&path, shot, frame_idx), &render).unwrap()
    };
    report.qualities.iter().map(|&(idx, quality)| at(idx, quality).psnr_db(&at(idx, Quality::Reference))).collect()
}

fn least(min_psnr_db: f64) -> Requirements {
    Requirements { min_psnr_db: Some(min_psnr_db), ..Requirements::default() }
}

#[test]
fn every_frame_has_the_least_psnr_and_those_that_fall_short_are_rendered_better() {
    let (scene, shot) = (scene(), approach());
    let renderer = Renderer::new(&scene.gaussians);
    let draft = psnrs_db(&scene, &shot, &filmed(&scene, &shot, &settings()));
    let (low, high) = draft.iter().fold((f64::INFINITY, 0.0_f64), |(low, high), db| (low.min(*db), high.max(*db)));
    // Frames that fall short between the forecast's samples: the film begins with `draft` all the same.
    let asked = low + 0.6 * (high - low);
    let found = promised(&renderer, &shot, Path::new("a.mp4"), &settings(), least(asked)).unwrap();
    let watched = FilmSettings { promise: Some(Promise { final_db: 80.0, ..found.promise }), ..settings() };
    let report = filmed(&scene, &shot, &watched);
    let got = psnrs_db(&scene, &shot, &report);
    assert_eq!(got.len(), draft.len());
    assert!(got.iter().all(|db| *db >= asked), "asked {asked}, got {got:?}");
    assert!(report.qualities.iter().any(|(_, quality)| *quality != Quality::Draft), "{low}..{high} dB");
}

#[test]
fn the_same_least_psnr_chooses_the_same_quality_on_every_run() {
    let (scene, shot) = (scene(), approach());
    for asked in [45.0, 75.0] {
        let choose = || {
            let renderer = Renderer::new(&scene.gaussians);
            let found = promised(&renderer, &shot, Path::new("a.mp4"), &settings(), least(asked)).unwrap();
            (found.forecast.quality, found.forecast.worst_psnr_db, found.promise.final_db)
        };
        let first = choose();
        assert_eq!(choose(), first);
        let render = RenderSettings { quality: first.0, ..settings().render };
        let watched = || {
            let promise =
                promised(&Renderer::new(&scene.gaussians), &shot, Path::new("a.mp4"), &settings(), least(asked));
            filmed(&scene, &shot, &FilmSettings { render, promise: Some(promise.unwrap().promise), ..settings() })
        };
        assert_eq!(watched().qualities, watched().qualities, "{asked} dB");
    }
}

#[test]
fn more_than_final_can_promise_is_rendered_as_reference() {
    // `final` often has 110 dB, and a pixel that rounds the other way takes it below.
    let (scene, shot) = (scene(), approach());
    let found =
        promised(&Renderer::new(&scene.gaussians), &shot, Path::new("a.mp4"), &settings(), least(110.0)).unwrap();
    assert_eq!(found.forecast.quality, Quality::Reference);
}

#[test]
fn a_film_whose_time_is_gone_steps_down_and_stays_there() {
    let (scene, shot) = (scene(), approach());
    let renderer = Renderer::new(&scene.gaussians);
    let an_hour = Requirements { budget: Some(Duration::from_hours(1)), ..Requirements::default() };
    let found = promised(&renderer, &shot, Path::new("a.mp4"), &settings(), an_hour).unwrap();
    let render = RenderSettings { quality: Quality::Final, ..settings().render };
    let with_deadline = |deadline: Instant| {
        let promise = Promise { deadline: Some(deadline), ..found.promise.clone() };
        filmed(&scene, &shot, &FilmSettings { render, promise: Some(promise), ..settings() })
    };
    let late = with_deadline(Instant::now());
    let qualities: Vec<Quality> = late.qualities.iter().map(|(_, quality)| *quality).collect();
    assert_eq!(qualities[..3], [Quality::Final; 3]);
    assert!(qualities.len() == 24 && qualities[3..].iter().all(|quality| *quality == Quality::Draft), "{qualities:?}");
    let early = with_deadline(Instant::now() + Duration::from_hours(1));
    assert!(early.qualities.iter().all(|(_, quality)| *quality == Quality::Final));
}

#[test]
fn a_budget_that_cannot_be_kept_is_refused_before_the_film() {
    let (scene, shot) = (scene(), approach());
    let little = Requirements { budget: Some(Duration::from_micros(10)), ..Requirements::default() };
    let error = promised(&Renderer::new(&scene.gaussians), &shot, Path::new("a.mp4"), &settings(), little).unwrap_err();
    assert!(matches!(error, PipelineError::Unreachable { .. }));
    // It used to name what the forecast had left of the budget: `no quality gives at most 0.0 s`.
    let text = error.to_string();
    assert!(text.starts_with("no quality gives at most 0.01 ms (the forecast took "), "{text}");
}
