//! Films that keep a least PSNR and a time.

use std::ops::ControlFlow;
use std::path::Path;
use std::time::{Duration, Instant};

use cinesplat::pipeline::{
    FilmReport, FilmSettings, PipelineError, Promise, Requirements, camera_at, checked_psnr_db, film, forecast,
    promised,
};
use cinesplat::render::{Quality, RenderSettings, Renderer};
use cinesplat::scene::Scene;
use cinesplat::trajectory::{CameraPath, EffectRequest, Shot};

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

/// An approach of 4 frames with circles of confusion of up to 8 px, and blur of the motion.
fn blurred() -> Shot {
    let effect = |kind: &str, settings: &[(&str, f64)]| EffectRequest {
        kind: kind.to_owned(),
        because: "the test".to_owned(),
        settings: settings.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect(),
        runs: None,
    };
    let effects = vec![effect("depth-of-field", &[("background_blur", 0.08)]), effect("motion-blur", &[])];
    Shot { fps: 4.0, effects, ..approach() }
}

/// The frames of a film in 8 bits.
fn frames_of(scene: &Scene, shot: &Shot, settings: &FilmSettings) -> (FilmReport, Vec<Vec<u8>>) {
    let folder = tempfile::tempdir().unwrap();
    let pattern = folder.path().join("%03d.png");
    let renderer = Renderer::new(&scene.gaussians);
    let report = film(&renderer, shot, &pattern, settings, &mut |_| ControlFlow::Continue(())).unwrap();
    let picture = |idx: usize| image::open(folder.path().join(format!("{idx:03}.png"))).unwrap().to_rgb8().into_raw();
    (report, (0..shot.num_frames()).map(picture).collect())
}

/// PSNR of the worst of some frames.
fn worst_psnr_db(found: &[Vec<u8>], exact: &[Vec<u8>]) -> f64 {
    let psnr_db = |(found, exact): (&Vec<u8>, &Vec<u8>)| {
        let square = |(a, b): (&u8, &u8)| ((f64::from(*a) - f64::from(*b)) / 255.0).powi(2);
        -10.0 * (found.iter().zip(exact).map(square).sum::<f64>() / found.len() as f64).log10()
    };
    found.iter().zip(exact).map(psnr_db).fold(f64::INFINITY, f64::min)
}

/// The samples of blur counted for nothing: any film with blur got `final`, whatever its error.
#[test]
fn a_least_psnr_counts_the_samples_of_blur_and_is_kept_with_them() {
    let (scene, shot) = (scene(), blurred());
    let renderer = Renderer::new(&scene.gaussians);
    let at = |quality: Quality| FilmSettings { render: RenderSettings { quality, ..settings().render }, ..settings() };
    let (_, exact) = frames_of(&scene, &shot, &at(Quality::Reference));
    let [of_standard, of_final] = [Quality::Standard, Quality::Final]
        .map(|quality| worst_psnr_db(&frames_of(&scene, &shot, &at(quality)).1, &exact));
    assert!(of_standard < of_final && of_final < 53.0, "{of_standard} {of_final}");
    let kept = |asked: f64| {
        let found = promised(&renderer, &shot, Path::new("a.mp4"), &settings(), least(asked)).unwrap();
        let watched = FilmSettings { promise: Some(found.promise), ..at(found.forecast.quality) };
        let (report, frames) = frames_of(&scene, &shot, &watched);
        let got = worst_psnr_db(&frames, &exact);
        // The rounding to 8 bits.
        assert!(got >= asked - 0.3, "asked {asked}, got {got}");
        (found.forecast.quality, report.num_finest)
    };
    assert_eq!(kept(of_standard - 8.0), (Quality::Standard, 0));
    assert_eq!(kept(f64::midpoint(of_standard, of_final)).0, Quality::Final);
    let (quality, num_finest) = kept(of_final + 1.0);
    assert!(quality == Quality::Final && num_finest > 0, "{quality:?} {num_finest}");
}

/// They were those of its sharp pictures.
#[test]
fn the_decibels_of_a_forecast_are_those_of_the_film_with_its_blur() {
    let scene = scene();
    let renderer = Renderer::new(&scene.gaussians);
    // Large enough for a part of the frame to stand for it.
    let mut shot = Shot { width: 240, height: 240, ..blurred() };
    shot.effects[0].settings = vec![("background_blur".to_owned(), 0.0125)];
    let at = |quality: Quality| FilmSettings {
        render: RenderSettings { quality, ..settings().render },
        frames: "1..2".parse().unwrap(),
        ..settings()
    };
    let first = |quality: Quality| {
        let folder = tempfile::tempdir().unwrap();
        let pattern = folder.path().join("%03d.png");
        film(&renderer, &shot, &pattern, &at(quality), &mut |_| ControlFlow::Continue(())).unwrap();
        vec![image::open(folder.path().join("001.png")).unwrap().to_rgb8().into_raw()]
    };
    let exact = first(Quality::Reference);
    let predicted = |shot: &Shot, quality: Quality| {
        let forecasts = forecast(&renderer, shot, Path::new("a.mp4"), &at(quality), &[quality]).unwrap();
        forecasts[0].psnr_db
    };
    let found = worst_psnr_db(&first(Quality::Standard), &exact);
    let blurred_db = predicted(&shot, Quality::Standard);
    assert!((blurred_db - found).abs() < 3.0, "predicted {blurred_db}, found {found}");
    let checked_db = checked_psnr_db(&renderer, &shot, (&at(Quality::Standard), false)).unwrap();
    assert!((checked_db - found).abs() < 3.0, "checked {checked_db}, found {found}");
    let sharp_db = predicted(&Shot { effects: Vec::new(), ..shot.clone() }, Quality::Final);
    assert!(predicted(&shot, Quality::Final) < sharp_db - 10.0, "{sharp_db}");
}
