//! Forecasts of cost and accuracy, and the quality that requirements choose.

use std::path::Path;
use std::time::Duration;
use strum::VariantArray;

use cinesplat::pipeline::{
    FilmCost, FilmSettings, Forecast, Pace, PathProfile, PipelineError, Requirements, TimeCost, checked_psnr_db,
    choose, forecast,
};
use cinesplat::render::{Quality, RenderSettings, Renderer};
use cinesplat::scene::Scene;

use super::{scene, settings, shot};

fn forecasts() -> Vec<Forecast> {
    let of = |quality, secs, psnr_db| Forecast {
        quality,
        render_time: Duration::from_secs(1),
        encode_time: Duration::from_secs(1),
        film_time: Duration::from_secs(secs),
        psnr_db,
        worst_psnr_db: psnr_db - 1.0,
        memory_bytes: 1 << 28,
        is_empty: false,
        pace: Pace {
            quality,
            render_secs: 1.0,
            film_secs: 1.0,
            encode_secs: 1.0,
            num_ahead: 0,
            profile: PathProfile::new(&[]),
        },
    };
    vec![
        of(Quality::Draft, 10, 30.0),
        of(Quality::Standard, 20, 56.0),
        of(Quality::Final, 30, 106.0),
        of(Quality::Reference, 3000, f64::INFINITY),
    ]
}

#[test]
fn a_budget_chooses_the_most_accurate_quality_and_a_psnr_the_fastest() {
    let chosen = |secs: Option<u64>, min_psnr_db: Option<f64>| {
        choose(&forecasts(), Requirements { budget: secs.map(Duration::from_secs), min_psnr_db }).ok()
    };
    assert_eq!(chosen(Some(25), None), Some(Quality::Standard));
    assert_eq!(chosen(Some(10_000), None), Some(Quality::Reference));
    assert_eq!(chosen(None, Some(50.0)), Some(Quality::Standard));
    assert_eq!(chosen(None, Some(29.5)), Some(Quality::Standard), "the worst frame counts");
    assert_eq!(chosen(Some(40), Some(60.0)), Some(Quality::Final));
    assert_eq!((chosen(Some(25), Some(60.0)), chosen(Some(5), None)), (None, None));
    // The reserve for opening and closing a film decides for a film of two seconds.
    let short = |millis: u64| {
        let film_time = Duration::from_secs(2);
        let made = forecasts().into_iter().map(|forecast| Forecast { film_time, ..forecast }).collect::<Vec<_>>();
        choose(&made, Requirements { budget: Some(Duration::from_millis(millis)), min_psnr_db: None }).ok()
    };
    assert_eq!((short(2600), short(2700)), (Some(Quality::Draft), Some(Quality::Reference)));
    // In time without a margin.
    assert_eq!((chosen(Some(11), None), chosen(Some(31), Some(60.0))), (Some(Quality::Draft), Some(Quality::Final)));
}

#[test]
fn requirements_out_of_reach_report_every_forecast() {
    let requirements = Requirements { budget: Some(Duration::from_secs(25)), min_psnr_db: Some(60.0) };
    let error: PipelineError = choose(&forecasts(), requirements).unwrap_err();
    assert_eq!(error.code(), "COST-BUDGET");
    let text = error.to_string();
    assert!(text.contains("at most 25.0 s and at least 60.0 dB") && text.contains("final 30.0 s, 106.0 dB"), "{text}");
    let short = Requirements { budget: Some(Duration::from_millis(1200)), ..Requirements::default() };
    let text = choose(&forecasts(), short).unwrap_err().to_string();
    assert!(text.starts_with("no quality gives at most 1.20 s; predicted: draft 10.0 s"), "{text}");
}

#[test]
fn reference_is_forecast_only_if_it_may_be_chosen() {
    let others = &forecasts()[..3];
    let may = |secs: Option<u64>, min_psnr_db: Option<f64>| {
        Requirements { budget: secs.map(Duration::from_secs), min_psnr_db }.may_need_reference(others)
    };
    assert!(!may(None, Some(50.0)), "final has 50 dB");
    assert!(may(None, Some(200.0)), "no other quality has 200 dB");
    assert!(!may(Some(60), None), "a budget of twice the time of final is too small for reference");
    assert!(may(Some(300), None));
    assert!(!may(Some(60), Some(200.0)), "out of reach either way");
    assert!(!may(Some(10_000), Some(50.0)), "the fastest sufficient quality is chosen");
}

/// 100 frames: 20 ms each to render on two cores, 10 ms each to encode on one core.
const COST: FilmCost = FilmCost {
    num_frames: 100,
    num_rendered: 100,
    render: TimeCost { wall_secs: 0.020, cpu_secs: 0.040 },
    first_encode: TimeCost { wall_secs: 0.010, cpu_secs: 0.010 },
    encode: TimeCost { wall_secs: 0.010, cpu_secs: 0.010 },
    still_encode: TimeCost { wall_secs: 0.001, cpu_secs: 0.001 },
    num_ahead: 0,
    num_cores: 2,
};

fn assert_secs(found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-9, "{found} s, expected {expected} s");
}

#[test]
fn renderer_and_encoder_share_the_cores() {
    // Rendering keeps both cores busy for 2 s; the encoder's 1 s of CPU time adds half a second on two cores.
    assert_secs(COST.film_secs(), 2.5);
    // On a third core the encoder, which is faster, adds nothing.
    assert_secs(FilmCost { num_cores: 3, ..COST }.film_secs(), 2.0);
    // A renderer on one core leaves the other core to the encoder.
    let alone = TimeCost { wall_secs: 0.020, cpu_secs: 0.020 };
    assert_secs(FilmCost { render: alone, ..COST }.film_secs(), 2.0);
    // An encoder that is slower in wall time determines the time, however many cores are free.
    let slow = TimeCost { wall_secs: 0.030, cpu_secs: 0.030 };
    assert_secs(FilmCost { first_encode: slow, encode: slow, num_cores: 16, ..COST }.film_secs(), 3.0);
}

#[test]
fn the_encoder_delay_does_not_overlap_with_rendering() {
    let free = FilmCost { num_cores: 16, ..COST };
    assert_secs(FilmCost { num_ahead: 40, ..free }.film_secs(), 2.0 + 40.0 * 0.010);
    // A delay longer than the film: the encoder starts after the last frame is rendered.
    assert_secs(FilmCost { num_ahead: 400, ..free }.film_secs(), 3.0);
}

#[test]
fn frames_of_a_resting_camera_cost_no_rendering_and_little_encoding() {
    let held = FilmCost { num_rendered: 40, ..COST };
    assert_secs(held.render_all().wall_secs, 40.0 * 0.020);
    assert_secs(held.encode_all().wall_secs, 40.0 * 0.010 + 60.0 * 0.001);
    assert_secs(FilmCost { num_frames: 1, num_rendered: 1, ..COST }.encode_all().wall_secs, 0.010);
}

#[test]
fn a_forecast_covers_every_quality_and_predicts_the_accuracy_of_other_frames() {
    let scene = scene();
    let renderer = Renderer::new(&scene.gaussians);
    let (shot, film) = (shot(), Path::new("film.mkv"));
    let found = forecast(&renderer, &shot, film, &settings(), Quality::VARIANTS).unwrap();
    assert_eq!(found.iter().map(|forecast| forecast.quality).collect::<Vec<_>>(), Quality::VARIANTS);
    for forecast in found {
        assert!(forecast.render_time > Duration::ZERO && forecast.worst_psnr_db <= forecast.psnr_db + 1e-9);
        assert!(forecast.film_time >= forecast.render_time && forecast.memory_bytes > 0);
        let render = RenderSettings { quality: forecast.quality, ..settings().render };
        let checked = checked_psnr_db(&renderer, &shot, (&FilmSettings { render, ..settings() }, false)).unwrap();
        // `reference` is exact: both are infinite.
        let is_near = checked == forecast.psnr_db || (checked - forecast.psnr_db).abs() < 1.5;
        assert!(is_near, "{}: {checked} dB, predicted {}", forecast.quality.as_ref(), forecast.psnr_db);
    }
    assert!(!film.exists(), "a forecast writes no file");
}

#[test]
fn a_film_of_one_frame_has_a_forecast() {
    let scene = scene();
    let one = FilmSettings { frames: "3..4".parse().unwrap(), ..settings() };
    let film = Path::new("film.webm");
    let found = forecast(&Renderer::new(&scene.gaussians), &shot(), film, &one, &[Quality::Reference]).unwrap();
    assert_eq!(found.iter().map(|forecast| forecast.quality).collect::<Vec<_>>(), [Quality::Reference]);
    assert!(found[0].film_time > Duration::ZERO);
}

/// Such a film used to be rendered without a word.
#[test]
fn a_film_of_the_background_alone_is_forecast_as_empty() {
    let (scene, shot) = (scene(), shot());
    let is_empty = |scene: &Scene, near: f64| {
        let renderer = Renderer::new(&scene.gaussians);
        let film = FilmSettings { render: RenderSettings { near, ..settings().render }, ..settings() };
        let made =
            forecast(&renderer, &shot, Path::new("f.mp4"), &film, &[Quality::Draft, Quality::Reference]).unwrap();
        assert_eq!(made[0].is_empty, made[1].is_empty);
        made[0].is_empty
    };
    assert!(!is_empty(&scene, 0.05));
    assert!(is_empty(&scene, 1e6), "near plane beyond the scene");
    let mut transparent = scene.clone();
    transparent.gaussians.opacities.fill(0.0);
    assert!(is_empty(&transparent, 0.05));
}
