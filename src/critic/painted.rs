//! The scene painted with what the critic wants to know: a color per Gaussian that says where it is, how coarse it is and to
//! which subject it belongs. A picture of these colors is as fast as any, and its blended colors are means of these values.

use glam::{DVec3, Vec3};

use cinesplat_geometry::Camera;
use cinesplat_render::{Frame, RenderError, RenderSettings, Renderer};
use cinesplat_scene::Gaussians;

/// Value of a color coefficient of degree 0 per unit of color, from [`Gaussians::sh_dc`].
const SH_DC: f32 = 0.282_094_8;
/// Channels before those of the subjects: position (3), size.
const NUM_FIXED: usize = 4;
/// The logarithms of sizes over the scene size are moved up by this, since colors are not negative.
const LOG_SHIFT: f32 = 32.0;

/// Whether a label is that of a subject or of a part of it.
fn belongs(label: u16, subject: usize, wholes: &[Vec<usize>]) -> bool {
    let own = usize::from(label).checked_sub(1);
    own.is_some_and(|own| own == subject || wholes[own].contains(&subject))
}

/// Painted copies of a scene: three channels each.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Painted {
    copies: Vec<Gaussians>,
    num_subjects: usize,
    low: DVec3,
    extent: DVec3,
    /// Sizes are measured in this, scene units.
    unit: f64,
}

/// What a picture shows, one value per pixel: `[row * width + column]`.
pub(super) struct Shown {
    /// The picture as a film shows it.
    pub(super) frame: Frame,
    /// Mean depth, scene units; NaN in a void.
    pub(super) depth: Vec<f32>,
    /// Geometric mean of the splats' sizes, scene units.
    pub(super) size: Vec<f32>,
    /// Weight of each subject, 0..=1: `[subject]`, then per pixel.
    pub(super) subjects: Vec<Vec<f32>>,
}

impl Painted {
    /// Paints a scene without view-dependent color. `sizes` are in scene units and above 0; `labels` are one more than the index of a subject, or 0;
    /// `wholes` are the subjects of which each subject is a part.
    pub(super) fn new(gaussians: &Gaussians, sizes: &[f32], labels: &[u16], wholes: &[Vec<usize>]) -> Self {
        let all = || (0..gaussians.len()).map(|i| gaussians.mean_world(i));
        let low = all().reduce(DVec3::min).unwrap_or(DVec3::ZERO);
        let extent = (all().reduce(DVec3::max).unwrap_or(DVec3::ONE) - low).max(DVec3::splat(f64::MIN_POSITIVE));
        let unit = extent.max_element();
        let value = |i: usize, channel: usize| match channel {
            0..3 => ((gaussians.mean_world(i) - low) / extent)[channel] as f32,
            3 => ((sizes[i] / unit as f32).max(f32::MIN_POSITIVE).ln() + LOG_SHIFT).max(0.0),
            _ => f32::from(u8::from(belongs(labels[i], channel - NUM_FIXED, wholes))),
        };
        let num_subjects = wholes.len();
        let num_channels = NUM_FIXED + num_subjects;
        let copies = (0..num_channels).step_by(3).map(|first| painted(gaussians, |i, k| value(i, first + k))).collect();
        Self { copies, num_subjects, low, extent, unit }
    }

    /// Renderers of the copies.
    pub(super) fn renderers(&self) -> Vec<Renderer<'_>> {
        self.copies.iter().map(Renderer::new).collect()
    }

    /// Looks at a frame of the scene: `renderers` are those of the copies.
    pub(super) fn show(
        &self,
        renderers: &[Renderer<'_>],
        frame: Frame,
        (camera, settings): (&Camera, &RenderSettings),
    ) -> Result<Shown, RenderError> {
        let frames: Vec<Frame> =
            renderers.iter().map(|renderer| renderer.render(camera, settings)).collect::<Result<_, _>>()?;
        let channel = |pixel: usize, channel: usize| frames[channel / 3].rgb[pixel * 3 + channel % 3];
        let num = frame.transmittance.len();
        let weight = |pixel: usize| (1.0 - frame.transmittance[pixel]).max(1e-6);
        let (eye, forward) = (camera.pose.position, camera.pose.forward());
        let depth = |pixel: usize| {
            let share = DVec3::from_array([0, 1, 2].map(|k| f64::from(channel(pixel, k) / weight(pixel))));
            let is_void = frame.transmittance[pixel] > 0.99;
            if is_void { f32::NAN } else { (self.low + self.extent * share - eye).dot(forward) as f32 }
        };
        let size = |pixel: usize| ((channel(pixel, 3) / weight(pixel) - LOG_SHIFT).exp()) * self.unit as f32;
        let depth: Vec<f32> = (0..num).map(depth).collect();
        let size: Vec<f32> = (0..num).map(size).collect();
        let of_subject = |subject: usize| (0..num).map(|pixel| channel(pixel, NUM_FIXED + subject)).collect();
        let subjects = (0..self.num_subjects).map(of_subject).collect();
        Ok(Shown { frame, depth, size, subjects })
    }
}

/// A copy of Gaussians without view-dependent color, whose colors are three values per Gaussian, each 0 or more.
fn painted(gaussians: &Gaussians, value: impl Fn(usize, usize) -> f32) -> Gaussians {
    let color = |i: usize| Vec3::from_array([0, 1, 2].map(|k| value(i, k)));
    Gaussians { sh_dc: (0..gaussians.len()).map(|i| (color(i) - 0.5) / SH_DC).collect(), ..gaussians.clone() }
}
