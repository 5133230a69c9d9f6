//! The mask of an object in one view, and its outline.

use cinesplat_geometry::Camera;
use cinesplat_render::{Quality, RenderSettings, Renderer};
use cinesplat_scene::SplatFilter;
use glam::DVec2;

use super::error::ObjectsError;

/// Transmittance below which a pixel belongs to the object's mask.
const MASK_TRANSMITTANCE: f32 = 0.5;

/// The pixels that an object covers in a square picture.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Mask {
    /// Side of the picture.
    pub(crate) size: usize,
    /// Row-major.
    pub(crate) inside: Vec<bool>,
}

impl Mask {
    /// Renders the mask of the renderer's Gaussians at twice the size, because the renderer dilates every splat by about
    /// half a pixel. A pixel of the mask is covered where at least half of its four are.
    pub(crate) fn render(renderer: &Renderer, camera: &Camera, filter: SplatFilter) -> Result<Self, ObjectsError> {
        let settings = RenderSettings { quality: Quality::Standard, filter, near: 0.0, ..RenderSettings::default() };
        let fine = Camera { intrinsics: camera.intrinsics.scaled(2.0), ..*camera };
        let picture = renderer.render(&fine, &settings);
        let frame = picture.map_err(|error| ObjectsError::Picture { reason: error.to_string() })?;
        let (size, stride) = (camera.intrinsics.width as usize, frame.width as usize);
        let is_covered = |i: usize| usize::from(frame.transmittance[i] < MASK_TRANSMITTANCE);
        let quarters =
            |i: usize| is_covered(i) + is_covered(i + 1) + is_covered(i + stride) + is_covered(i + stride + 1);
        let inside = |pixel: usize| quarters(2 * (pixel / size) * stride + 2 * (pixel % size)) >= 2;
        Ok(Self { size, inside: (0..size * size).map(inside).collect() })
    }

    /// Number of covered pixels.
    pub(crate) fn area(&self) -> usize {
        self.inside.iter().filter(|inside| **inside).count()
    }

    /// The sides of the smallest rectangle of pixels around the covered ones: left, top, right, bottom; `None` where there are
    /// none.
    pub(crate) fn bounds(&self) -> Option<[usize; 4]> {
        let covered = (0..self.inside.len()).filter(|&pixel| self.inside[pixel]);
        covered.map(|pixel| [pixel % self.size, pixel / self.size]).fold(None, |bounds, [x, y]| {
            let [left, top, right, bottom] = bounds.unwrap_or([x, y, x + 1, y + 1]);
            Some([left.min(x), top.min(y), right.max(x + 1), bottom.max(y + 1)])
        })
    }

    /// Whether a pixel is covered; pixels beyond the border are not.
    pub(crate) fn at(&self, x: i64, y: i64) -> bool {
        let size = self.size as i64;
        (0..size).contains(&x) && (0..size).contains(&y) && self.inside[(y * size + x) as usize]
    }

    /// The outline: the middles of the sides between covered and uncovered pixels, px, with the outward normal. Normals
    /// are smoothed over the pixels around, because those of the sides themselves have only four directions.
    pub(crate) fn outline(&self) -> Vec<(DVec2, DVec2)> {
        let mut outline = Vec::new();
        for y in 0..self.size as i64 {
            for x in 0..self.size as i64 {
                for (dx, dy) in [(1, 0), (-1, 0), (0, 1), (0, -1)] {
                    if self.at(x, y) && !self.at(x + dx, y + dy) {
                        let side = DVec2::new(dx as f64, dy as f64);
                        let middle = DVec2::new(x as f64 + 0.5, y as f64 + 0.5) + side / 2.0;
                        outline.push((middle, (side + self.away(x, y)).normalize_or(side)));
                    }
                }
            }
        }
        outline
    }

    /// Mean direction from a pixel to the uncovered pixels around it.
    fn away(&self, x: i64, y: i64) -> DVec2 {
        let mut sum = DVec2::ZERO;
        for dy in -2_i64..=2 {
            for dx in -2_i64..=2 {
                if !self.at(x + dx, y + dy) {
                    sum += DVec2::new(dx as f64, dy as f64).normalize_or_zero();
                }
            }
        }
        sum.normalize_or_zero()
    }

    /// Whether a position (px) lies on the mask or at most about a pixel beside it.
    pub(crate) fn holds(&self, position_px: DVec2) -> bool {
        let (x, y) = ((position_px.x - 0.5).floor() as i64, (position_px.y - 0.5).floor() as i64);
        (0..2).any(|dy| (0..2).any(|dx| self.at(x + dx, y + dy)))
    }
}
