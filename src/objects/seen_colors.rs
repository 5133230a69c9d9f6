//! The colors of a thing as somebody sees it who walks around it.
//!
//! Enters: the Gaussians of a thing and its box. Leaves: the colors of small pictures of it from its four sides and from above,
//! with what lies inside hidden.

use glam::{DVec3, Vec3};

use super::boxes::UprightBox;
use super::color;
use cinesplat_scene::Gaussians;

/// Pixels along the longest side of a picture.
const SIDE_PX: f64 = 40.0;
/// Most Gaussians of a picture; of more, every so many stand for the others.
const MOST_MEMBERS: usize = 20_000;
/// Least opacity of a Gaussian that counts: haze around a thing has the color of what was behind it.
const FAINT_OPACITY: f32 = 0.4;
/// Most pixels from the center of a Gaussian that it covers, along an axis.
const REACH_PX: f64 = 6.0;
/// Transmittance below which nothing behind is seen, and least share of a pixel that is covered where it has a color.
const LEAST_TRANSMITTANCE: f32 = 0.05;
const COVERED: f32 = 0.7;

/// A Gaussian in the frame of the box.
struct Blob {
    center: DVec3,
    /// Standard deviation along the axes of the box, scene units.
    sigma: DVec3,
    opacity: f32,
    rgb: Vec3,
}

/// A pixel while Gaussians are added to it from front to back.
#[derive(Clone, Copy)]
struct Pixel {
    rgb: Vec3,
    transmittance: f32,
}

/// The colors of the pixels, CIE Lab, of pictures of a thing from its sides and from above; empty for a thing without extent.
pub(crate) fn seen_colors(gaussians: &Gaussians, members: &[usize], fitted: &UprightBox) -> Vec<Vec3> {
    let pixel = 2.0 * fitted.half_extents.max_element() / SIDE_PX;
    if !(pixel > 0.0 && pixel.is_finite()) {
        return Vec::new();
    }
    let every = members.len().div_ceil(MOST_MEMBERS).max(1);
    let chosen = members.iter().step_by(every).filter(|&&i| gaussians.opacities[i] >= FAINT_OPACITY);
    let blobs: Vec<Blob> = chosen.map(|&i| blob(gaussians, i, fitted, every)).collect();
    let views = [(0, 1.0), (0, -1.0), (2, 1.0), (2, -1.0), (1, 1.0)];
    let pictures = views.into_iter().flat_map(|view| picture(&blobs, fitted.half_extents, view, pixel));
    pictures.map(|pixel| color::lab(pixel.rgb / (1.0 - pixel.transmittance))).collect()
}

/// A Gaussian that stands for `every` ones.
fn blob(gaussians: &Gaussians, gaussian: usize, fitted: &UprightBox, every: usize) -> Blob {
    let local_from_world = fitted.rotation.conjugate();
    let turn = local_from_world * gaussians.rotations[gaussian].as_dquat();
    let scale = gaussians.scales[gaussian].as_dvec3();
    let square = DVec3::AXES.map(|axis| (turn * (axis * scale)).powf(2.0));
    Blob {
        center: local_from_world * (gaussians.mean_world(gaussian) - fitted.center),
        sigma: square.into_iter().sum::<DVec3>().powf(0.5) * (every as f64).sqrt(),
        opacity: gaussians.opacities[gaussian].min(0.99),
        rgb: gaussians.base_color(gaussian),
    }
}

/// The covered pixels of a picture along an axis of the box, from its positive or negative end.
fn picture(blobs: &[Blob], half: DVec3, (axis, sign): (usize, f64), pixel: f64) -> Vec<Pixel> {
    let (right, up) = ((axis + 1) % 3, (axis + 2) % 3);
    let width = (2.0 * half[right] / pixel).ceil().max(1.0);
    let height = (2.0 * half[up] / pixel).ceil().max(1.0);
    let mut pixels = vec![Pixel { rgb: Vec3::ZERO, transmittance: 1.0 }; (width * height) as usize];
    let mut order: Vec<&Blob> = blobs.iter().collect();
    order.sort_by(|a, b| (sign * b.center[axis]).total_cmp(&(sign * a.center[axis])));
    for blob in order {
        let range = |along: usize, count: f64| {
            let at = (blob.center[along] + half[along]) / pixel;
            let reach = (blob.sigma[along] / pixel).min(REACH_PX);
            let (low, high) = ((at - reach).round(), (at + reach).round());
            // What is thinner than a pixel covers a part of the one that it is in.
            let (low, high) = if high > low { (low, high) } else { (at.floor(), at.floor() + 1.0) };
            (low.max(0.0) as usize, high.clamp(0.0, count) as usize, (2.0 * reach).min(1.0) as f32)
        };
        let (left, end, wide) = range(right, width);
        let (bottom, top, high) = range(up, height);
        let alpha = blob.opacity * wide * high;
        for row in bottom..top {
            for column in left..end {
                let Some(seen) = pixels.get_mut(row * width as usize + column) else { continue };
                if seen.transmittance > LEAST_TRANSMITTANCE {
                    seen.rgb += blob.rgb * alpha * seen.transmittance;
                    seen.transmittance *= 1.0 - alpha;
                }
            }
        }
    }
    pixels.retain(|pixel| pixel.transmittance < 1.0 - COVERED);
    pixels
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DQuat, Quat};

    #[test]
    fn what_is_inside_is_not_seen() {
        let mut gaussians = Gaussians::default();
        // A red shell around many green grains, in rows of which every so many Gaussians do not leave out a side.
        for i in 0..41 * 41 * 41 {
            let at = [i % 41, i / 41 % 41, i / 1681].map(|along| along as f32 / 40.0 - 0.5);
            let on_shell = at.iter().any(|along| along.abs() > 0.49);
            let color = if on_shell { Vec3::new(0.8, 0.1, 0.1) } else { Vec3::new(0.1, 0.7, 0.1) };
            gaussians.means.push(Vec3::from(at));
            gaussians.scales.push(Vec3::splat(0.02));
            gaussians.rotations.push(Quat::IDENTITY);
            gaussians.opacities.push(0.9);
            gaussians.sh_dc.push((color - 0.5) / 0.282_094_8);
        }
        let members: Vec<usize> = (0..gaussians.len()).collect();
        let fitted = UprightBox { center: DVec3::ZERO, half_extents: DVec3::splat(0.5), rotation: DQuat::IDENTITY };
        let seen = seen_colors(&gaussians, &members, &fitted);
        let red = seen.iter().filter(|lab| lab.y > 0.0).count();
        assert!(seen.len() > 5000 && red as f64 > 0.9 * seen.len() as f64, "{red} of {}", seen.len());
    }
}
