//! Measures how time and memory grow with the number of Gaussians, of pixels or of overlapping layers. One grows, the
//! others are constant.
//!
//! Enters: a scene to tile and one [`ScalingCase`]. Leaves: a [`ScalingRow`] with time, counters and memory. Run each
//! case in a process of its own: memory that an earlier case has freed would hide the memory that a later one takes.

use std::fmt::Write as _;

use glam::{DQuat, DVec3, Quat, Vec3};

use super::Timing;
use super::measure::time;
use super::report::ms;
use cinesplat_geometry::{Camera, Intrinsics, Pose};
use cinesplat_plot::{Axis, COLORS, Chart, LegendEntry, LegendSymbol, Marker, Series, grid};
use cinesplat_render::{RenderError, RenderSettings, Renderer, memory_target_bytes};
use cinesplat_scene::{Bounds, Gaussians, NUM_SH_REST};

/// Maximum number of Gaussians per copy in a tiled scene.
const TILE_LEN: usize = 10_000;
/// Size of the picture, except in [`Growth::Pixels`].
const SIZE_PX: [u32; 2] = [1280, 720];
const FOV_Y_RAD: f64 = 0.9;

/// The quantity that grows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[derive(strum::AsRefStr, strum::Display, strum::EnumString, strum::IntoStaticStr)]
#[derive(strum::VariantArray, strum::VariantNames)]
#[strum(serialize_all = "kebab-case")]
pub enum Growth {
    /// Gaussians: more and more copies of a scene side by side, all in view.
    Gaussians,
    /// Pixels of the picture.
    Pixels,
    /// Faint layers of splats, each covering the picture.
    Overdraw,
}

/// One amount of work.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ScalingCase {
    /// The quantity that grows.
    pub growth: Growth,
    /// Its value: number of Gaussians, of rows of pixels, or of layers.
    pub value: u64,
}

/// Time and memory of one case.
#[derive(Debug, Clone, PartialEq)]
pub struct ScalingRow {
    /// The case.
    pub case: ScalingCase,
    /// Gaussians in the scene.
    pub num_gaussians: u64,
    /// Pixels of the picture.
    pub num_pixels: u64,
    /// Times and counters.
    pub timing: Timing,
    /// Bytes of the renderer's buffers and the picture, by the renderer's own count.
    pub held_bytes: u64,
    /// Growth of the peak memory of the process while renderer and pictures were made; `None` if the system does not
    /// report it.
    pub peak_bytes: Option<u64>,
}

impl Growth {
    /// The values to measure, ascending.
    pub fn values(self) -> &'static [u64] {
        match self {
            Self::Gaussians => &[10_000, 30_000, 100_000, 300_000, 1_000_000, 2_000_000, 4_000_000],
            Self::Pixels => &[180, 360, 540, 720, 1080, 1440, 2160],
            Self::Overdraw => &[1, 4, 16, 64, 256],
        }
    }
}

impl ScalingCase {
    /// The scene of this case, made of copies of `base`, and a camera that sees all of it.
    fn scene(self, base: &Gaussians) -> (Gaussians, Camera) {
        let [width, height] = SIZE_PX;
        match self.growth {
            Growth::Gaussians => tiled(base, self.value as usize, [width, height]),
            Growth::Pixels => tiled(base, 10 * TILE_LEN, [self.value as u32 * 16 / 9, self.value as u32]),
            Growth::Overdraw => (layers(self.value as usize), camera([width, height], DVec3::ZERO)),
        }
    }
}

/// Measures one case with a renderer of its own: one warm-up run and `num_repeats` timed runs.
///
/// # Errors
/// Those of [`Renderer::render`].
pub fn measure(
    case: ScalingCase,
    base: &Gaussians,
    settings: &RenderSettings,
    num_repeats: usize,
) -> Result<ScalingRow, RenderError> {
    let (scene, camera) = case.scene(base);
    let before = process_memory::reset_peak();
    let renderer = Renderer::new(&scene);
    let timing = time(&renderer, &camera, (settings, num_repeats))?;
    let peak_bytes = before.and_then(|before| Some(process_memory::peak()?.saturating_sub(before)));
    let num_pixels = u64::from(camera.intrinsics.width) * u64::from(camera.intrinsics.height);
    Ok(ScalingRow {
        case,
        num_gaussians: scene.len() as u64,
        num_pixels,
        timing,
        held_bytes: renderer.memory_bytes() + num_pixels * 4 * size_of::<f32>() as u64,
        peak_bytes,
    })
}

/// A scene of `len` Gaussians (copies of a subset of `base`, side by side) and a camera in front of it.
fn tiled(base: &Gaussians, len: usize, size_px: [u32; 2]) -> (Gaussians, Camera) {
    let step = base.len().div_ceil(TILE_LEN).max(1);
    let tile: Vec<usize> = (0..base.len()).step_by(step).collect();
    let bounds = Bounds::of(base);
    let pitch = (bounds.core_max - bounds.core_min).max(DVec3::splat(1e-3));
    let num_tiles = len.div_ceil(tile.len().max(1)).max(1);
    let across = (num_tiles as f64).sqrt().ceil() as usize;
    let num_rest = NUM_SH_REST[usize::from(base.sh_degree.min(3))];
    let mut scene = Gaussians { origin: base.origin, sh_degree: base.sh_degree, ..Gaussians::default() };
    for (slot, &idx) in (0..num_tiles).flat_map(|slot| tile.iter().map(move |idx| (slot, idx))).take(len) {
        let (column, row) = ((slot % across) as f64, (slot / across) as f64);
        let middle = (across - 1) as f64 / 2.0;
        let offset = DVec3::new((column - middle) * pitch.x, (row - middle) * pitch.y, 0.0);
        scene.means.push(base.means[idx] + offset.as_vec3());
        scene.scales.push(base.scales[idx]);
        scene.rotations.push(base.rotations[idx]);
        scene.opacities.push(base.opacities[idx]);
        scene.sh_dc.push(base.sh_dc[idx]);
        scene.sh_rest.extend_from_slice(&base.sh_rest[idx * num_rest..][..num_rest]);
    }
    let half_tan = (FOV_Y_RAD / 2.0).tan();
    let aspect = f64::from(size_px[0]) / f64::from(size_px[1]);
    let reach = across as f64 / 2.0 * (pitch.x / aspect).max(pitch.y);
    let back = DVec3::Z * (reach / half_tan + pitch.z / 2.0);
    (scene, camera(size_px, bounds.center() - back))
}

/// Layers of faint splats, one behind the other; each layer covers the picture with 32 x 18 splats.
fn layers(num_layers: usize) -> Gaussians {
    let mut scene = Gaussians::default();
    for layer in 0..num_layers {
        let depth = 2.0 + layer as f32 * 0.01;
        let half = depth * (FOV_Y_RAD as f32 / 2.0).tan();
        for cell in 0..32 * 18 {
            let (column, row) = ((cell % 32) as f32, (cell / 32) as f32);
            let position = Vec3::new((column - 15.5) / 16.0 * half * 16.0 / 9.0, (row - 8.5) / 9.0 * half, depth);
            scene.means.push(position);
            scene.scales.push(Vec3::new(half / 9.0, half / 9.0, 1e-3) * 0.5);
            scene.rotations.push(Quat::IDENTITY);
            scene.opacities.push(0.02);
            scene.sh_dc.push(Vec3::splat((layer % 7) as f32 * 0.2));
        }
    }
    scene
}

/// A camera that looks along +z.
fn camera([width, height]: [u32; 2], position: DVec3) -> Camera {
    Camera { pose: Pose::new(position, DQuat::IDENTITY), intrinsics: Intrinsics::from_fov_y(width, height, FOV_Y_RAD) }
}

impl ScalingRow {
    /// Memory target of the renderer for this scene and picture; see [`memory_target_bytes`].
    fn allowed_bytes(&self) -> u64 {
        memory_target_bytes(self.num_gaussians, self.num_pixels)
    }
}

/// Header of [`csv_line`].
pub const CSV_HEADER: &str = "growth,value,gaussians,pixels,median_ms,min_ms,max_ms,project_ms,sort_ms,bin_ms,blend_ms,\
    splats,pairs,block_blends,held_bytes,peak_bytes,allowed_bytes\n";

/// The row as a line of CSV.
pub fn csv_line(row: &ScalingRow) -> String {
    let (times, counts, [low, high]) = (&row.timing.stats.times, &row.timing.stats.counts, row.timing.range);
    let times = [row.timing.median, low, high, times.project, times.sort, times.bin, times.blend];
    let times: Vec<String> = times.iter().map(|time| format!("{:.3}", ms(*time))).collect();
    let mut line = format!("{},{},{},{},", row.case.growth.as_ref(), row.case.value, row.num_gaussians, row.num_pixels);
    // Writing to a string cannot fail.
    let _ = writeln!(
        line,
        "{},{},{},{},{},{},{}",
        times.join(","),
        counts.num_splats,
        counts.num_pairs,
        counts.num_block_blends,
        row.held_bytes,
        row.peak_bytes.map_or_else(String::new, |bytes| bytes.to_string()),
        row.allowed_bytes()
    );
    line
}

/// Plots as SVG, from the lines of a CSV with [`CSV_HEADER`]: time against each quantity, and memory against its
/// target.
pub fn scaling_svg(csv: &str) -> String {
    let column = |name: &str| CSV_HEADER.trim_end().split(',').position(|column| column == name).unwrap_or(0);
    let rows: Vec<Vec<&str>> = csv.lines().skip(1).map(|line| line.split(',').collect()).collect();
    let number = |row: &[&str], name: &str| row.get(column(name)).and_then(|cell| cell.parse::<f64>().ok());
    let line = |growth: Growth, x: &str, y: &str, color: &'static str| {
        let of_growth = rows.iter().filter(|row| row.first() == Some(&growth.as_ref()));
        let points: Vec<(f64, f64)> = of_growth.filter_map(|row| Some((number(row, x)?, number(row, y)?))).collect();
        let markers = (0..points.len()).map(|idx| Marker::dot(idx, 2.2)).collect();
        Series { points, color, line_px: 1.3, markers }
    };
    let chart = |title: &str, (growth, x): (Growth, &str), y: &str, lines: &[(&str, &'static str)]| Chart {
        series: lines.iter().map(|(name, color)| line(growth, x, name, color)).collect(),
        ..Chart::new(title, Axis::logarithmic(x), Axis::logarithmic(y))
    };
    let stages = ["median_ms", "project_ms", "sort_ms", "bin_ms", "blend_ms"];
    let times: Vec<(&str, &'static str)> = stages.into_iter().zip([7, 1, 2, 3, 4].map(|idx| COLORS[idx])).collect();
    let memory = [("held_bytes", COLORS[5]), ("allowed_bytes", COLORS[6])];
    let charts = [
        chart("More Gaussians, 1280 x 720 pixels", (Growth::Gaussians, "gaussians"), "ms per frame", &times),
        chart("More pixels, 100,000 Gaussians", (Growth::Pixels, "pixels"), "ms per frame", &times),
        chart("More layers, 1280 x 720 pixels", (Growth::Overdraw, "block_blends"), "ms per frame", &times),
        chart("Memory beyond the scene, bytes", (Growth::Gaussians, "gaussians"), "bytes", &memory),
    ];
    let names = ["whole frame", "project", "sort", "bin", "blend", "held", "allowed"];
    let colors = times.iter().chain(&memory).map(|(_, color)| *color);
    let entry =
        |(name, color): (&str, &'static str)| LegendEntry { name: name.to_owned(), color, symbol: LegendSymbol::Line };
    let entries: Vec<LegendEntry> = names.into_iter().zip(colors).map(entry).collect();
    grid("Time and memory against work", &entries, &charts, 2, [420.0, 290.0])
}

/// Memory of the process, as Linux reports it.
mod process_memory {
    use std::fs;

    /// Resets the peak to the resident memory and returns it; `None` if the system does not support that.
    pub(super) fn reset_peak() -> Option<u64> {
        fs::write("/proc/self/clear_refs", "5").ok()?;
        peak()
    }

    /// Peak resident memory, bytes.
    pub(super) fn peak() -> Option<u64> {
        let status = fs::read_to_string("/proc/self/status").ok()?;
        let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
        Some(line.trim().trim_end_matches("kB").trim().parse::<u64>().ok()? * 1024)
    }
}
