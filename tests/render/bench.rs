//! The bench of the renderer: rows for every camera and variant, knobs that must be free are free.

use cinesplat::render::bench::{BenchSettings, measure, to_csv};
use cinesplat::render::{Quality, RenderSettings, Renderer};

use super::scenes::{camera, crowd};

#[test]
fn rows_hold_accuracy_and_counts_of_every_variant() {
    let scene = crowd(2_000, 20);
    let variant =
        |quality: Quality| (quality.name().to_string(), RenderSettings { quality, ..RenderSettings::default() });
    let settings = BenchSettings {
        variants: vec![variant(Quality::Final), variant(Quality::Standard), variant(Quality::Draft)],
        num_repeats: 3,
        measures_accuracy: true,
    };
    let rows = measure(&Renderer::new(&scene), &[("c0".into(), camera(160, 90))], &settings).unwrap();
    let db: Vec<f64> = rows.iter().map(|row| row.accuracy.unwrap().0).collect();
    assert!(db[0] > 60.0 && db[0] > db[1] && db[1] > db[2], "{db:?}");
    assert!(rows.iter().all(|row| row.range[0] <= row.median && row.median <= row.range[1]));
    assert!(rows[0].stats.counts.num_pairs >= rows[0].stats.counts.num_splats);
    let csv = to_csv(&rows);
    let columns = |line: &str| line.split(',').count();
    assert_eq!(csv.lines().count(), 4);
    assert!(csv.lines().all(|line| columns(line) == 18), "{csv}");
}
