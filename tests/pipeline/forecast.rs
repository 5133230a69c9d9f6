//! Forecasts of cost and accuracy, and the quality that a wish chooses.

use std::time::Duration;

use cinesplat::pipeline::{Forecast, PipelineError, Wish, checked_psnr_db, choose, forecast};
use cinesplat::render::{Quality, Renderer};

use super::{scene, settings, shot};

fn forecasts() -> Vec<Forecast> {
    let of = |quality, secs, psnr_db| Forecast {
        quality,
        render_time: Duration::from_secs(secs),
        psnr_db,
        worst_psnr_db: psnr_db - 1.0,
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
        choose(&forecasts(), Wish { budget: secs.map(Duration::from_secs), min_psnr_db }).ok()
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
    let wish = Wish { budget: Some(Duration::from_secs(25)), min_psnr_db: Some(60.0) };
    let error: PipelineError = choose(&forecasts(), wish).unwrap_err();
    assert_eq!((error.code(), error.exit_code()), ("COST-BUDGET", 71));
    let text = error.to_string();
    assert!(text.contains("at most 25.0 s and at least 60.0 dB") && text.contains("final 30.0 s, 106.0 dB"), "{text}");
}

#[test]
fn a_forecast_has_every_quality_and_the_accuracy_of_frames_it_did_not_see() {
    let scene = scene();
    let renderer = Renderer::new(&scene.gaussians);
    let shot = shot();
    let found = forecast(&renderer, &shot, &(0..10), &settings().render, &Quality::ALL).unwrap();
    assert_eq!(found.iter().map(|forecast| forecast.quality).collect::<Vec<_>>(), Quality::ALL);
    for forecast in found {
        assert!(forecast.render_time > Duration::ZERO && forecast.worst_psnr_db <= forecast.psnr_db + 1e-9);
        let render = cinesplat::render::RenderSettings { quality: forecast.quality, ..settings().render };
        let checked = checked_psnr_db(&renderer, &shot, &(0..10), &render).unwrap();
        let is_near = (checked - forecast.psnr_db).abs() < 6.0 || forecast.psnr_db > 80.0;
        assert!(is_near, "{}: {checked} dB, predicted {}", forecast.quality.name(), forecast.psnr_db);
    }
}
