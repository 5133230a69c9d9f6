use super::chart::{Panel, Scale, Series, Spacing, figure};
use super::report::ms;
use super::{BenchRow, Kind};

/// Plotted in place of infinity: pictures that are equal or nearly so.
const MOST_DB: f64 = 120.0;

/// What a Pareto plot shows against time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Axis {
    /// Peak signal-to-noise ratio, dB.
    Psnr,
    /// One less the structural similarity.
    Ssim,
    /// Largest difference of a pixel.
    Worst,
}

impl Axis {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Psnr, Self::Ssim, Self::Worst];

    /// The name in file names.
    pub fn name(self) -> &'static str {
        match self {
            Self::Psnr => "psnr",
            Self::Ssim => "ssim",
            Self::Worst => "worst",
        }
    }

    fn scale(self) -> Scale {
        let (name, spacing) = match self {
            Self::Psnr => ("PSNR, dB", Spacing::Even),
            Self::Ssim => ("1 - SSIM", Spacing::Logarithmic),
            Self::Worst => ("worst pixel", Spacing::Logarithmic),
        };
        Scale { name: name.to_owned(), spacing }
    }

    fn of(self, row: &BenchRow) -> f64 {
        match self {
            Self::Psnr => row.difference.psnr_db.min(MOST_DB),
            Self::Ssim => (1.0 - row.difference.ssim).max(1e-8),
            Self::Worst => row.difference.worst.max(1e-6),
        }
    }
}

/// A panel a scene: time against accuracy of presets (dots with names) and of each knob alone (lines), for the pictures
/// of one size; means over the cameras, geometric for times.
pub fn pareto_svg(rows: &[BenchRow], size_px: [u32; 2], axis: Axis) -> String {
    let shown: Vec<&BenchRow> = rows.iter().filter(|row| row.size_px == size_px && row.kind != Kind::Free).collect();
    let mut scenes: Vec<&str> = Vec::new();
    for row in &shown {
        if !scenes.contains(&row.scene.as_str()) {
            scenes.push(&row.scene);
        }
    }
    let panels: Vec<Panel> = scenes.iter().map(|scene| panel(&shown, scene, axis)).collect();
    let title = format!("Accuracy against time, {} x {} pixels, against the spec image", size_px[0], size_px[1]);
    let names: Vec<&str> = Kind::ALL.iter().filter(|kind| **kind != Kind::Free).map(|kind| kind.name()).collect();
    figure(&title, &names, &panels, 3.min(panels.len().max(1)))
}

fn panel(rows: &[&BenchRow], scene: &str, axis: Axis) -> Panel {
    let of_scene: Vec<&BenchRow> = rows.iter().copied().filter(|row| row.scene == scene).collect();
    let mut series = Vec::new();
    for (name_idx, kind) in Kind::ALL.into_iter().enumerate().rev() {
        let mut words: Vec<String> = Vec::new();
        for row in of_scene.iter().filter(|row| row.kind == kind) {
            if !words.contains(&row.variant) {
                words.push(row.variant.clone());
            }
        }
        let points = words.iter().map(|variant| {
            let cameras: Vec<&&BenchRow> =
                of_scene.iter().filter(|row| row.kind == kind && row.variant == *variant).collect();
            let mean = |value: &dyn Fn(&BenchRow) -> f64| {
                cameras.iter().map(|row| value(row)).sum::<f64>() / cameras.len() as f64
            };
            (mean(&|row| ms(row.timed.median).ln()).exp(), mean(&|row| axis.of(row)))
        });
        let points: Vec<(f64, f64)> = points.collect();
        if !points.is_empty() {
            series.push(Series { name_idx, is_line: kind != Kind::Preset, points, words });
        }
    }
    let x = Scale { name: "ms a frame".to_owned(), spacing: Spacing::Logarithmic };
    Panel { title: scene.to_owned(), x, y: axis.scale(), series }
}
