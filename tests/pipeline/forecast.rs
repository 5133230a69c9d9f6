//! Forecasts of cost and accuracy, and the quality that a wish chooses.

use std::path::Path;
use std::time::Duration;
use strum::VariantArray;

use cinesplat::pipeline::{
    FilmCost, FilmSettings, Forecast, PipelineError, Requirements, TimeCost, checked_psnr_db, choose, forecast,
};
use cinesplat::render::{Quality, RenderSettings, Renderer};

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
    };
    vec![
        of(Quality::Draft, 10, 30.0),
        of(Quality::Standard, 20, 56.0),
        of(Quality::Final, 30, 106.0),
        of(Quality::Reference, 3000, f64::INFINITY),
    ]
}

#[test]
fn a_wish_chooses_the_most_accurate_in_time_or_the_fastest_good_enough() {
    let chosen = |secs: Option<u64>, min_psnr_db: Option<f64>| {
        choose(&forecasts(), Requirements { budget: secs.map(Duration::from_secs), min_psnr_db }).ok()
    };
    assert_eq!(chosen(Some(25), None), Some(Quality::Standard));
    assert_eq!(chosen(Some(10_000), None), Some(Quality::Reference));
    assert_eq!(chosen(None, Some(50.0)), Some(Quality::Standard));
    assert_eq!(chosen(None, Some(29.5)), Some(Quality::Standard), "the worst frame counts");
    assert_eq!(chosen(Some(40), Some(60.0)), Some(Quality::Final));
    assert_eq!((chosen(Some(25), Some(60.0)), chosen(Some(5), None)), (None, None));
}

#[test]
fn a_wish_out_of_reach_says_what_is_in_reach() {
    let wish = Requirements { budget: Some(Duration::from_secs(25)), min_psnr_db: Some(60.0) };
    let error: PipelineError = choose(&forecasts(), wish).unwrap_err();
    assert_eq!(error.code(), "COST-BUDGET");
    let text = error.to_string();
    assert!(text.contains("at most 25.0 s and at least 60.0 dB") && text.contains("final 30.0 s, 106.0 dB"), "{text}");
}

#[test]
fn reference_is_forecast_only_where_it_may_be_chosen() {
    let others = &forecasts()[..3];
    let may = |secs: Option<u64>, min_psnr_db: Option<f64>| {
        Requirements { budget: secs.map(Duration::from_secs), min_psnr_db }.may_need_reference(others)
    };
    assert!(!may(None, Some(50.0)), "final has 50 dB");
    assert!(may(None, Some(200.0)), "no other quality has 200 dB");
    assert!(!may(Some(60), None), "a budget of twice final is none of reference");
    assert!(may(Some(300), None));
    assert!(!may(Some(60), Some(200.0)), "out of reach either way");
    assert!(!may(Some(10_000), Some(50.0)), "the fastest that is good enough is chosen");
}

/// 100 frames of 20 ms to render on both of two cores and 10 ms of one core to encode.
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
    // 2 s of rendering keep both cores busy, so the encoder's 1 s of one core comes on top as half a second.
    assert_secs(COST.film_secs(), 2.5);
    // With a core to itself the encoder, the faster one, costs nothing.
    assert_secs(FilmCost { num_cores: 3, ..COST }.film_secs(), 2.0);
    // A renderer of one core leaves the other to the encoder.
    let alone = TimeCost { wall_secs: 0.020, cpu_secs: 0.020 };
    assert_secs(FilmCost { render: alone, ..COST }.film_secs(), 2.0);
    // An encoder that is slower by the clock sets the pace, whatever cores are free.
    let slow = TimeCost { wall_secs: 0.030, cpu_secs: 0.030 };
    assert_secs(FilmCost { first_encode: slow, encode: slow, num_cores: 16, ..COST }.film_secs(), 3.0);
}

#[test]
fn an_encoder_that_looks_ahead_has_its_last_frames_to_itself() {
    let free = FilmCost { num_cores: 16, ..COST };
    assert_secs(FilmCost { num_ahead: 40, ..free }.film_secs(), 2.0 + 40.0 * 0.010);
    // One that looks farther ahead than the film is long starts when all is rendered.
    assert_secs(FilmCost { num_ahead: 400, ..free }.film_secs(), 3.0);
}

#[test]
fn frames_that_stand_still_are_free_to_render_and_cheap_to_encode() {
    let held = FilmCost { num_rendered: 40, ..COST };
    assert_secs(held.render_all().wall_secs, 40.0 * 0.020);
    assert_secs(held.encode_all().wall_secs, 40.0 * 0.010 + 60.0 * 0.001);
    assert_secs(FilmCost { num_frames: 1, num_rendered: 1, ..COST }.encode_all().wall_secs, 0.010);
}

#[test]
fn a_forecast_takes_no_frame_of_a_resting_camera_for_work() {
    let (scene, film) = (scene(), Path::new("frames/%03d.png"));
    let renderer = Renderer::new(&scene.gaussians);
    let mut resting = shot();
    resting.keyframes[1].pose = resting.keyframes[0].pose;
    let render_time = |shot| forecast(&renderer, shot, film, &settings(), &[Quality::Draft]).unwrap()[0].render_time;
    let mut longer = resting.clone();
    longer.duration_secs = 1000.0;
    // One frame of the second film is rendered, as of the first; ten thousand would take a thousand times the time.
    assert!(render_time(&longer) < render_time(&resting) * 100);
}

#[test]
fn a_forecast_has_every_quality_and_the_accuracy_of_frames_it_did_not_see() {
    let scene = scene();
    let renderer = Renderer::new(&scene.gaussians);
    let (shot, film) = (shot(), Path::new("film.mkv"));
    let found = forecast(&renderer, &shot, film, &settings(), &Quality::VARIANTS).unwrap();
    assert_eq!(found.iter().map(|forecast| forecast.quality).collect::<Vec<_>>(), Quality::VARIANTS);
    for forecast in found {
        assert!(forecast.render_time > Duration::ZERO && forecast.worst_psnr_db <= forecast.psnr_db + 1e-9);
        assert!(forecast.film_time >= forecast.render_time && forecast.memory_bytes > 0);
        let render = RenderSettings { quality: forecast.quality, ..settings().render };
        let checked = checked_psnr_db(&renderer, &shot, &FilmSettings { render, ..settings() }).unwrap();
        let is_near = (checked - forecast.psnr_db).abs() < 6.0 || forecast.psnr_db > 80.0;
        assert!(is_near, "{}: {checked} dB, predicted {}", forecast.quality.as_ref(), forecast.psnr_db);
    }
    assert!(!film.exists(), "a forecast leaves no file");
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
