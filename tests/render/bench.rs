//! The benchmark of the renderer: one row per camera and variant; free knobs change no bit.

use cinesplat::render::{Frame, RenderSettings, Renderer};
use cinesplat_bench::{
    AccuracyAxis, BenchPlan, BenchRow, KnobKind, RenderOutput, difference, measure, pareto_svg, scaling, to_csv,
    to_table, variants,
};
use strum::VariantArray;

use super::scenes::{camera, crowd};

fn rows() -> Vec<BenchRow> {
    let scene = crowd(2_000, 20);
    let variants = variants(&RenderSettings::default());
    let plan = BenchPlan { scene: "crowd".into(), variants, num_repeats: 2 };
    let cameras = [("c0".into(), camera(96, 54)), ("c1".into(), camera(96, 54))];
    let rows = measure(&Renderer::new(&scene), &cameras, &plan, &mut |_| ()).unwrap();
    assert_eq!(rows.len(), plan.num_rows(2));
    rows
}

#[test]
fn presets_are_ordered_by_accuracy_and_free_knobs_change_no_bit() {
    let rows = rows();
    let db = |variant: &str| rows.iter().find(|row| row.variant == variant).unwrap().difference.psnr_db;
    assert!(db("final") > 60.0 && db("final") > db("standard") && db("standard") > db("draft"));
    assert!(db("1/512") > db("1/64") && db("1/64") > db("1/32"));
    assert!(db("0.001") > db("0.03") && db("0.90") > db("0.33"));
    let free: Vec<&BenchRow> = rows.iter().filter(|row| row.kind == KnobKind::Free).collect();
    assert!(free.len() >= 6);
    for row in free {
        assert_eq!(row.difference.psnr_db, f64::INFINITY, "{}", row.variant);
        assert!(row.difference.worst == 0.0 && (row.difference.ssim - 1.0).abs() < 1e-12, "{}", row.variant);
    }
    assert!(
        rows.iter().all(|row| row.timing.range[0] <= row.timing.median && row.timing.median <= row.timing.range[1])
    );
    let csv = to_csv(&rows);
    assert_eq!(csv.lines().count(), rows.len() + 1);
    assert!(csv.lines().all(|line| line.split(',').count() == 22), "{csv}");
    let table = to_table(&rows);
    assert!(table.contains("| crowd | 96x54 | draft |") && table.contains("13 of 13 pictures equal"), "{table}");
    // A slow variant is measured with the first camera only.
    assert_eq!(rows.iter().filter(|row| row.variant == "scalar").count(), 1);
    let outputs: Vec<&BenchRow> = rows.iter().filter(|row| row.kind == KnobKind::Output).collect();
    assert_eq!(outputs.len(), 2 * RenderOutput::VARIANTS.len());
    assert!(outputs.iter().all(|row| row.times_color.is_some_and(|ratio| ratio > 0.0 && ratio.is_finite())));
    assert!(outputs.iter().all(|row| row.difference.psnr_db.is_nan()) && !csv.contains("NaN"));
    for &axis in AccuracyAxis::VARIANTS {
        let svg = pareto_svg(&rows, [96, 54], axis);
        assert!(svg.starts_with("<svg") && svg.contains("crowd") && !svg.contains("NaN") && !svg.contains("inf"));
    }
}

#[test]
fn a_dominated_preset_is_named() {
    let mut rows: Vec<BenchRow> = rows().into_iter().filter(|row| row.kind == KnobKind::Preset).collect();
    let at = |rows: &mut Vec<BenchRow>, variant: &str, ms: u64| {
        let of_variant = rows.iter_mut().filter(|row| row.variant == variant);
        of_variant.for_each(|row| row.timing.median = std::time::Duration::from_millis(ms));
    };
    at(&mut rows, "draft", 10);
    at(&mut rows, "standard", 20);
    at(&mut rows, "final", 30);
    assert!(to_table(&rows).contains("of the same scene and size: none."), "{}", to_table(&rows));
    at(&mut rows, "draft", 21);
    assert!(to_table(&rows).contains("crowd at 96x54: draft by standard."), "{}", to_table(&rows));
}

/// A gray picture of 24 x 16 pixels.
fn picture(value: impl Fn(usize, usize) -> f32) -> Frame {
    let pixels = (0..16).flat_map(|y| (0..24).map(move |x| (x, y)));
    let rgb = pixels.flat_map(|(x, y)| [value(x, y); 3]).collect();
    Frame { width: 24, height: 16, rgb, transmittance: vec![0.0; 24 * 16], ..Frame::default() }
}

#[test]
fn differences_of_flat_pictures_equal_the_formulas() {
    let apart = difference(&picture(|_, _| 0.5), &picture(|_, _| 0.6));
    // Without variance the SSIM is (2 a b + C1) / (a^2 + b^2 + C1).
    assert!((apart.ssim - (0.6 + 1e-4) / (0.25 + 0.36 + 1e-4)).abs() < 1e-6, "{apart:?}");
    assert!((apart.psnr_db - 20.0).abs() < 1e-4 && (apart.worst - 0.1).abs() < 1e-6, "{apart:?}");
    let one_dot = difference(&picture(|x, y| f32::from(u8::from((x, y) == (12, 8)))), &picture(|_, _| 0.0));
    assert!((one_dot.worst - 1.0).abs() < 1e-6 && one_dot.ssim < 0.999);
}

#[test]
fn ssim_equals_a_direct_sum_over_the_window() {
    let wave = |x: usize, y: usize| 0.5 + 0.4 * ((x * 7 + y * 13) as f32 * 0.61).sin();
    let other = |x: usize, y: usize| 0.45 + 0.35 * ((x * 7 + y * 13) as f32 * 0.61 + 0.3).sin();
    let found = difference(&picture(wave), &picture(other)).ssim;
    let weight = |dx: i32, dy: i32| (-f64::from(dx * dx + dy * dy) / 4.5).exp();
    let offsets = || (-5..=5).flat_map(|dy| (-5..=5).map(move |dx| (dx, dy)));
    let total: f64 = offsets().map(|(dx, dy)| weight(dx, dy)).sum();
    let mut sum = 0.0;
    for (x, y) in (5..11).flat_map(|y| (5..19).map(move |x| (x, y))) {
        let at = |f: &dyn Fn(usize, usize) -> f32, dx: i32, dy: i32| f64::from(f((x + dx) as usize, (y + dy) as usize));
        let mean =
            |f: &dyn Fn(i32, i32) -> f64| offsets().map(|(dx, dy)| weight(dx, dy) / total * f(dx, dy)).sum::<f64>();
        let (a, b) = (mean(&|dx, dy| at(&wave, dx, dy)), mean(&|dx, dy| at(&other, dx, dy)));
        let va = mean(&|dx, dy| (at(&wave, dx, dy) - a).powi(2));
        let vb = mean(&|dx, dy| (at(&other, dx, dy) - b).powi(2));
        let cov = mean(&|dx, dy| (at(&wave, dx, dy) - a) * (at(&other, dx, dy) - b));
        sum += (2.0 * a * b + 1e-4) * (2.0 * cov + 9e-4) / ((a * a + b * b + 1e-4) * (va + vb + 9e-4));
    }
    assert!((found - sum / 84.0).abs() < 1e-9, "{found} and {}", sum / 84.0);
}

#[test]
fn scaling_counts_what_it_renders() {
    let base = crowd(500, 21);
    let settings = RenderSettings { near: 0.01, ..RenderSettings::default() };
    let case = |growth, value| scaling::measure(scaling::ScalingCase { growth, value }, &base, &settings, 1).unwrap();
    let few = case(scaling::Growth::Gaussians, 1_000);
    let many = case(scaling::Growth::Gaussians, 8_000);
    assert_eq!((few.num_gaussians, many.num_gaussians), (1_000, 8_000));
    assert!(many.timing.stats.counts.num_splats > 4 * few.timing.stats.counts.num_splats);
    let small = case(scaling::Growth::Pixels, 90);
    assert_eq!(small.num_pixels, 160 * 90);
    let csv = format!("{}{}{}", scaling::CSV_HEADER, scaling::csv_line(&few), scaling::csv_line(&small));
    assert!(csv.lines().all(|line| line.split(',').count() == 17), "{csv}");
    assert!(scaling::scaling_svg(&csv).contains("<polyline"));
}
