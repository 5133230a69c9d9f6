//! The picture of the Gaussians behind a view: their colors, pale, with dark edges where depth jumps.

use cinesplat_geometry::{Camera, Intrinsics, Pose};
use cinesplat_render::{Frame, Quality, RenderSettings, Renderer};
use cinesplat_scene::{Gaussians, Scene};
use glam::{DMat3, DQuat, DVec2};

use crate::error::MapError;
use crate::panel::{Panel, View};
use crate::space::Space;
use cinesplat_plot::drawing::Picture;

/// Pixels of the picture per px of the page.
const PIXELS_PER_PX: f64 = 1.6;
/// Distance of the camera over the extent of the map. Perspective then moves nothing by more than a 400th of its depth.
const DISTANCE: f64 = 400.0;
/// Share of color in the picture; the rest is gray.
const SATURATION: f32 = 0.55;
/// How much of the contrast to white is kept.
const STRENGTH: f32 = 0.62;
/// Contrast of slopes that face the light.
const LIGHT_STRENGTH: f32 = 0.1;
/// Step between two levels of a color: coarse levels make smaller files and cannot be told apart in pale tones.
const LEVEL_STEP: f32 = 3.0;
/// Jump of depth between neighboring pixels, over the width of a pixel, at which an edge is half drawn.
const EDGE_PIXELS: f32 = 9.0;
/// Darkness of an edge.
const EDGE_STRENGTH: f32 = 0.6;

/// Draws the matter that a view shows, behind its cut.
///
/// The renderer draws perspective, so the camera stands far away with a narrow lens.
pub(crate) fn picture(scene: &Scene, space: &Space, panel: &Panel) -> Result<Picture, MapError> {
    let kept = behind_cut(&scene.gaussians, space, panel);
    let size = (panel.size_px() * PIXELS_PER_PX).round().max(DVec2::ONE);
    let intrinsics = Intrinsics::from_fov_y(size.x as u32, size.y as u32, 1.0);
    if kept.is_empty() {
        let white = vec![255; size.x as usize * size.y as usize * 3];
        return Ok(Picture::new([size.x as u32, size.y as u32], white)?);
    }
    let extent = (space.high - space.low).max_element();
    let distance = DISTANCE * extent;
    let focal_px = panel.px_per_unit * PIXELS_PER_PX * distance;
    let middle = (panel.low + panel.high) / 2.0;
    let depth = (space.along(panel.toward).dot(space.low + space.high)) / 2.0;
    let center = panel.right * middle.x + panel.upward * middle.y + panel.toward * depth;
    let axes = DMat3::from_cols(panel.right, -panel.upward, -panel.toward);
    let pose = Pose::new(center + panel.toward * distance, DQuat::from_mat3(&axes));
    let camera = Camera { pose, intrinsics: Intrinsics { fx_px: focal_px, fy_px: focal_px, ..intrinsics } };
    let settings = RenderSettings { quality: Quality::Final, near: distance / 2.0, ..RenderSettings::for_scene(scene) };
    let renderer = Renderer::new(&kept);
    let (frame, depth) = (renderer.render(&camera, &settings)?, renderer.depth(&camera, &settings)?);
    let relief = Relief { depths: &depth.median, width: size.x as usize, pixel: distance as f32 / focal_px as f32 };
    let rgb8 = (0..frame.transmittance.len()).flat_map(|i| shade(&frame, &relief, i)).collect();
    Ok(Picture::new([size.x as u32, size.y as u32], rgb8)?)
}

/// The Gaussians inside the extent along the view axis and behind its cut, without colors that depend on the direction: no
/// capture has seen the scene from there.
fn behind_cut(gaussians: &Gaussians, space: &Space, panel: &Panel) -> Gaussians {
    let is_kept = |i: usize| {
        let at = space.along(gaussians.mean_world(i));
        let axes = gaussians.scales[i].as_dvec3() * (gaussians.rotations[i].as_dquat().conjugate() * panel.toward);
        match panel.view {
            View::Plan => at.z + axes.length() <= space.cut_height && at.z >= space.low.z,
            View::Elevation => at.y - axes.length() >= space.cut_ahead && at.y <= space.high.y,
        }
    };
    let kept: Vec<usize> = (0..gaussians.len()).filter(|&i| is_kept(i)).collect();
    gaussians.plain_subset(&kept)
}

/// Depths of a picture.
struct Relief<'a> {
    depths: &'a [f32],
    width: usize,
    /// Width of a pixel, scene units.
    pixel: f32,
}

impl Relief<'_> {
    /// Depth of the pixel `dx` columns and `dy` rows away from pixel `i`; NaN beyond the border and where nothing is.
    fn at(&self, i: usize, dx: isize, dy: isize) -> f32 {
        let column = (i % self.width) as isize + dx;
        let idx = (i as isize + dx + dy * self.width as isize) as usize;
        let is_inside = (0..self.width as isize).contains(&column);
        self.depths.get(idx).copied().filter(|_| is_inside).unwrap_or(f32::NAN)
    }

    /// How dark the edge at a pixel is, 0..1: pixels behind a neighbor are, so that edges are one pixel wide.
    fn edge(&self, i: usize) -> f32 {
        let own = self.depths[i];
        let behind = [(1, 0), (-1, 0), (0, 1), (0, -1)].map(|(dx, dy)| own - self.at(i, dx, dy));
        let jump = behind.into_iter().fold(0.0, f32::max) / self.pixel;
        jump.powi(2) / (jump.powi(2) + EDGE_PIXELS.powi(2))
    }

    /// Light from the upper left on the slope at a pixel, -1..1; 0 on level ground.
    fn light(&self, i: usize) -> f32 {
        let across = self.at(i, 1, 0) - self.at(i, -1, 0) + self.at(i, 0, 1) - self.at(i, 0, -1);
        let slope = across / (2.0 * self.pixel);
        if slope.is_finite() { -slope / (1.0 + slope.abs()) } else { 0.0 }
    }
}

/// One pixel of the picture in 8 bits.
fn shade(frame: &Frame, relief: &Relief<'_>, i: usize) -> [u8; 3] {
    let covered = 1.0 - frame.transmittance[i];
    let color: [f32; 3] = std::array::from_fn(|channel| frame.rgb[i * 3 + channel].clamp(0.0, 1.0) + 1.0 - covered);
    let gray = 0.299 * color[0] + 0.587 * color[1] + 0.114 * color[2];
    let light = 1.0 + LIGHT_STRENGTH * relief.light(i) * covered;
    let edge = 1.0 - EDGE_STRENGTH * relief.edge(i) * covered;
    color.map(|value| {
        let muted = (gray + (value - gray) * SATURATION) * light;
        let pale = 1.0 - (1.0 - muted) * STRENGTH;
        let level = (pale * edge * 255.0 / LEVEL_STEP).round() * LEVEL_STEP;
        level.clamp(0.0, 255.0) as u8
    })
}
