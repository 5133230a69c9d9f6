//! The front of a lone thing: the side that shows the most.

use cinesplat_geometry::{Camera, Intrinsics, LevelFrame, Pose};
use cinesplat_render::{Frame, Quality, RenderError, RenderSettings, Renderer};
use glam::DVec3;

use super::picture;
use super::subjects::{Subject, Subjects};

/// Directions from which a thing is looked at.
const NUM_SIDES: usize = 16;
/// Height of the camera above the thing's middle over its distance.
const RISE: f64 = 0.15;
/// Distance of the camera over the thing's radius, and the field of view that holds it.
const DISTANCE: f64 = 3.0;
const FOV_DEG: f64 = 40.0;
/// Pixels of a picture's side.
const SIZE_PX: u32 = 96;
/// Transmittance below which a pixel shows the thing.
const SOLID: f32 = 0.3;
/// Weight of brightness beside detail.
const BRIGHTNESS: f64 = 0.1;
/// Area of a side over that of the widest one from which it counts fully.
const WIDE_FRAC: f64 = 0.6;
/// Worth of the best side over the mean of all sides from which a thing has a front.
const LEAST_CONTRAST: f64 = 1.12;

impl Subjects {
    /// The fronts of the subjects that have one: the id of the object, and the level unit direction from its middle.
    ///
    /// Every thing is rendered alone from 16 sides. Its front is the middle of the sides with the most detail (change of
    /// luminance from pixel to pixel), light and area, where they stand out from the others: a guitar has strings, its
    /// back is plain wood.
    ///
    /// # Errors
    /// Those of [`Renderer::render`].
    pub fn fronts(&self, frame: &LevelFrame) -> Result<Vec<(u32, DVec3)>, RenderError> {
        let mut fronts = Vec::new();
        for subject in &self.subjects {
            fronts.extend(front(subject, frame)?.map(|direction| (subject.id, direction)));
        }
        Ok(fronts)
    }
}

fn front(subject: &Subject, frame: &LevelFrame) -> Result<Option<DVec3>, RenderError> {
    let renderer = Renderer::new(&subject.cloud);
    let direction = |side: usize| frame.direction(std::f64::consts::TAU * side as f64 / NUM_SIDES as f64);
    let mut seen = Vec::with_capacity(NUM_SIDES);
    for side in 0..NUM_SIDES {
        seen.push(seen_from(&renderer, subject, direction(side), frame.up)?);
    }
    // The edge of a guitar is none of its sides, whatever there is to see on it.
    let widest = seen.iter().map(|[_, area]| *area).fold(0.0, f64::max);
    let breadth = |area: f64| (area / (WIDE_FRAC * widest).max(1.0)).min(1.0).powi(2);
    let worths: Vec<f64> = seen.iter().map(|[worth, area]| worth * breadth(*area)).collect();
    let mean = worths.iter().sum::<f64>() / NUM_SIDES as f64;
    let best = worths.iter().copied().fold(0.0, f64::max);
    // A face is seen from several sides: the front is the middle of those that show more than others.
    let excess = |side: usize| (worths[side] - mean).max(0.0).powi(2);
    let toward = (0..NUM_SIDES).map(|side| direction(side) * excess(side)).sum::<DVec3>();
    let Some(toward) = toward.try_normalize().filter(|_| best > LEAST_CONTRAST * mean) else { return Ok(None) };
    Ok(Some(faced(&renderer, subject, frame, toward)?))
}

/// Largest angle between the side that shows the most and the front, degrees, and the step between the sides that are
/// tried.
const MOST_TURN_DEG: i32 = 60;
const TURN_STEP_DEG: usize = 6;
/// Share of its symmetry that a side loses that is as far from the one that shows the most as any that is tried, and the area
/// of a side over that one's below which it is an edge.
const FAR_LOSS: f64 = 0.1;
const LEAST_AREA: f64 = 0.8;
/// Symmetry of the front over the median of the sides that are tried: what is alike from everywhere faces nowhere.
const LEAST_SYMMETRY: f64 = 1.06;

/// The direction near the side that shows the most from which a thing is its own mirror image, as faces are; that side
/// itself where none is.
fn faced(renderer: &Renderer<'_>, subject: &Subject, frame: &LevelFrame, toward: DVec3) -> Result<DVec3, RenderError> {
    let azimuth = frame.azimuth(toward);
    // Turn, symmetry, area and direction of every side; the one without a turn shows the most.
    let mut sides = Vec::new();
    for turn_deg in (-MOST_TURN_DEG..=MOST_TURN_DEG).step_by(TURN_STEP_DEG) {
        let direction = frame.direction(azimuth + f64::from(turn_deg).to_radians());
        if let Some(picture) = picture_from(renderer, subject, direction, frame.up)? {
            let near = 1.0 - FAR_LOSS * f64::from(turn_deg.abs()) / f64::from(MOST_TURN_DEG);
            let [_, area] = shown(&picture);
            sides.push((turn_deg, symmetry(&picture) * near, area, direction));
        }
    }
    let most_area = sides.iter().find(|(turn_deg, ..)| *turn_deg == 0).map_or(0.0, |(_, _, area, _)| *area);
    let broad = sides.into_iter().filter(|(_, _, area, _)| *area >= LEAST_AREA * most_area);
    let mut tried: Vec<(f64, DVec3)> = broad.map(|(_, symmetry, _, direction)| (symmetry, direction)).collect();
    tried.sort_by(|a, b| b.0.total_cmp(&a.0));
    let (Some((most, direction)), Some((median, _))) = (tried.first(), tried.get(tried.len() / 2)) else {
        return Ok(toward);
    };
    Ok(if *most > LEAST_SYMMETRY * median { *direction } else { toward })
}

/// How alike a picture of a thing and its mirror image are, 0..=1: the share of the pixels of either that show the thing in
/// both, each by how alike its luminances are.
fn symmetry(frame: &Frame) -> f64 {
    let (width, height) = (frame.width as usize, frame.height as usize);
    let luminance = |i: usize| picture::luminance([frame.rgb[3 * i], frame.rgb[3 * i + 1], frame.rgb[3 * i + 2]]);
    let is_solid = |x: usize, y: usize| frame.transmittance[y * width + x] < SOLID;
    let solid = (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).filter(|&(x, y)| is_solid(x, y));
    let (sum, count) = solid.clone().fold((0, 0), |(sum, count), (x, _)| (sum + x, count + 1));
    if count == 0 {
        return 0.0;
    }
    // Twice the column of the middle.
    let axis = 2 * sum / count;
    let alike = solid.filter_map(|(x, y)| {
        let mirrored = axis.checked_sub(x).filter(|mirrored| *mirrored < width && is_solid(*mirrored, y))?;
        let (a, b) = (luminance(y * width + x), luminance(y * width + mirrored));
        Some(1.0 - (a - b).abs() / (a + b).max(1e-6))
    });
    let alike: Vec<f64> = alike.collect();
    alike.iter().sum::<f64>() / (2 * count - alike.len()).max(1) as f64
}

/// Detail and light of one side, over the pixels that show the thing, and the number of these pixels.
fn seen_from(renderer: &Renderer<'_>, subject: &Subject, toward: DVec3, up: DVec3) -> Result<[f64; 2], RenderError> {
    Ok(picture_from(renderer, subject, toward, up)?.map_or([0.0; 2], |picture| shown(&picture)))
}

/// The picture of a thing from one side; `None` where there is no such view.
fn picture_from(
    renderer: &Renderer<'_>,
    subject: &Subject,
    toward: DVec3,
    up: DVec3,
) -> Result<Option<Frame>, RenderError> {
    let distance = DISTANCE * subject.radius;
    let eye = subject.center + (toward + up * RISE).normalize_or_zero() * distance;
    let Ok(pose) = Pose::look_at(eye, subject.center, up, None) else { return Ok(None) };
    let intrinsics = Intrinsics::from_fov_y(SIZE_PX, SIZE_PX, FOV_DEG.to_radians());
    let settings = RenderSettings { quality: Quality::Draft, near: 0.01 * distance, ..RenderSettings::default() };
    renderer.render(&Camera { pose, intrinsics }, &settings).map(Some)
}

fn shown(frame: &Frame) -> [f64; 2] {
    let width = frame.width as usize;
    let luminance = |i: usize| picture::luminance([frame.rgb[3 * i], frame.rgb[3 * i + 1], frame.rgb[3 * i + 2]]);
    let is_solid = |i: usize| frame.transmittance[i] < SOLID;
    let (mut num, mut change, mut light) = (0.0, 0.0, 0.0);
    for i in 0..frame.transmittance.len().saturating_sub(width + 1) {
        let is_inside = (i + 1) % width != 0 && is_solid(i) && is_solid(i + 1) && is_solid(i + width);
        if is_inside {
            num += 1.0;
            change += (luminance(i + 1) - luminance(i)).abs() + (luminance(i + width) - luminance(i)).abs();
            light += luminance(i);
        }
    }
    [if num > 0.0 { (change + BRIGHTNESS * light) / num } else { 0.0 }, num]
}
