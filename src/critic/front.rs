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
    Ok(toward.try_normalize().filter(|_| best > LEAST_CONTRAST * mean))
}

/// Detail and light of one side, over the pixels that show the thing, and the number of these pixels.
fn seen_from(renderer: &Renderer<'_>, subject: &Subject, toward: DVec3, up: DVec3) -> Result<[f64; 2], RenderError> {
    let distance = DISTANCE * subject.radius;
    let eye = subject.center + (toward + up * RISE).normalize_or_zero() * distance;
    let Ok(pose) = Pose::look_at(eye, subject.center, up, None) else { return Ok([0.0; 2]) };
    let intrinsics = Intrinsics::from_fov_y(SIZE_PX, SIZE_PX, FOV_DEG.to_radians());
    let settings = RenderSettings { quality: Quality::Draft, near: 0.01 * distance, ..RenderSettings::default() };
    Ok(shown(&renderer.render(&Camera { pose, intrinsics }, &settings)?))
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
