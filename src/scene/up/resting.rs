//! Directions in which a thing can stand: opposite to the faces of its convex hull that it can rest on.
//!
//! Enters: the sample. Leaves: unit directions. A thing stands on at least three points, so that of all directions
//! nearby its contact with the ground is widest in that one.

use glam::DVec3;

use super::evidence::{BOTTOM_FRAC, CONTACT_FRAC, spread};
use super::facets::fit_plane;
use super::sample::PatchSample;

/// Number of directions that are compared: 9 degrees apart.
const NUM_DIRECTIONS: usize = 500;

/// Maximum number of patches for the comparison.
const MAX_PATCHES: usize = 2500;

/// Maximum number of directions.
const MAX_RESTING: usize = 14;

/// Cosine of the angle within which only the widest contact counts (20 degrees).
const APART_COS: f64 = 0.94;

/// The directions with the widest contact, widest first.
pub(super) fn resting(sample: &PatchSample) -> Vec<DVec3> {
    let stride = sample.patches.len().div_ceil(MAX_PATCHES).max(1);
    let points: Vec<DVec3> = sample.patches.iter().step_by(stride).map(|patch| patch.position).collect();
    if points.len() < 30 {
        return Vec::new();
    }
    let contact = |up: DVec3| contact_area(&points, up, 2.0 * CONTACT_FRAC * sample.size);
    let mut ranked: Vec<(f64, DVec3)> = sphere().map(|up| (contact(up), up)).collect();
    ranked.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut chosen: Vec<DVec3> = Vec::new();
    for (_, up) in ranked {
        if chosen.len() == MAX_RESTING {
            break;
        }
        if chosen.iter().all(|known| known.dot(up) < APART_COS) {
            chosen.push(up);
        }
    }
    chosen.into_iter().map(|up| settled(&points, up, sample.size)).collect()
}

/// Directions that cover the sphere evenly: a Fibonacci lattice.
fn sphere() -> impl Iterator<Item = DVec3> {
    let golden = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    (0..NUM_DIRECTIONS).map(move |i| {
        let z = 1.0 - (2.0 * i as f64 + 1.0) / NUM_DIRECTIONS as f64;
        let (sin, cos) = (golden * i as f64).sin_cos();
        let r = (1.0 - z * z).sqrt();
        DVec3::new(r * cos, r * sin, z)
    })
}

/// Height below which only outliers lie.
fn bottom(points: &[DVec3], up: DVec3) -> f64 {
    let mut heights: Vec<f64> = points.iter().map(|p| p.dot(up)).collect();
    let rank = (BOTTOM_FRAC * (heights.len() - 1) as f64) as usize;
    *heights.select_nth_unstable_by(rank, f64::total_cmp).1
}

fn contact_area(points: &[DVec3], up: DVec3, reach: f64) -> f64 {
    let top = bottom(points, up) + reach;
    let east = up.any_orthonormal_vector();
    let north = up.cross(east);
    spread(points.iter().filter(|p| p.dot(up) < top).map(|p| [p.dot(east), p.dot(north)])).area
}

/// The direction after the thing tilted onto what it touches: planes through ever thinner contacts. A contact that is
/// not flat tells nothing about the tilt; then it is the direction nearby with the widest contact.
fn settled(points: &[DVec3], up: DVec3, size: f64) -> DVec3 {
    let mut settled = up;
    for reach in [3.0, 2.0, 1.5, 1.0, 1.0] {
        let top = bottom(points, settled) + reach * CONTACT_FRAC * size;
        let touching: Vec<DVec3> = points.iter().copied().filter(|p| p.dot(settled) < top).collect();
        if touching.len() < 10 {
            return climbed(points, up, size);
        }
        let plane = fit_plane(&touching);
        let turned = plane.normal() * plane.normal().dot(settled).signum();
        if turned.dot(up) < APART_COS || plane.thickness > 0.4 * plane.width {
            return climbed(points, up, size);
        }
        settled = turned;
    }
    settled
}

/// A local maximum of the area of contact, by steps of 4 and 2 degrees.
fn climbed(points: &[DVec3], up: DVec3, size: f64) -> DVec3 {
    let area = |direction: DVec3| contact_area(points, direction, 2.0 * CONTACT_FRAC * size);
    let mut best = (area(up), up);
    for step in [0.07, 0.07, 0.035, 0.035] {
        let east = best.1.any_orthonormal_vector();
        let north = best.1.cross(east);
        for tilt in [east, -east, north, -north] {
            let tried = (best.1 + tilt * step).normalize();
            best = Some((area(tried), tried)).filter(|tried| tried.0 > best.0).unwrap_or(best);
        }
    }
    best.1
}

/// The principal axes of the patches and their opposites.
pub(super) fn principal(sample: &PatchSample) -> [DVec3; 6] {
    let points: Vec<DVec3> = sample.patches.iter().map(|patch| patch.position).collect();
    let [least, middle, longest] = fit_plane(&points).axes;
    [least, -least, middle, -middle, longest, -longest]
}
