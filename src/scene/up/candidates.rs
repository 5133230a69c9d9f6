use glam::DVec3;

use super::facets::{Facet, fit_plane};
use super::sample::PatchSample;

/// Maximum number of directions from the scene's surfaces.
const MAX_PEAKS: usize = 8;

/// Cosines of the angle within which normals belong to one peak (12 degrees), and within which two peaks count as one
/// (20 degrees).
const PEAK_COS: f64 = 0.978;
const APART_COS: f64 = 0.94;

/// Maximum number of normals, and of normals that start a mean shift.
const MAX_NORMALS: usize = 4000;
const MAX_STARTS: usize = 200;

/// Frequent surface normals, of arbitrary sign, strongest first. They are the modes of the distribution of normals: first
/// those of the facets, then new ones of the patches.
pub(super) fn normal_peaks(sample: &PatchSample, facets: &[Facet]) -> Vec<DVec3> {
    let facet_normals: Vec<DVec3> = facets.iter().map(|f| f.normal).filter(|n| *n != DVec3::ZERO).collect();
    let patch_normals: Vec<DVec3> = sample.patches.iter().map(|p| p.normal).filter(|n| *n != DVec3::ZERO).collect();
    let mut peaks: Vec<DVec3> = Vec::new();
    for normals in [facet_normals, patch_normals] {
        let found = peaks_of(&normals);
        let is_new = |peak: &DVec3| peaks.iter().all(|known| known.dot(*peak).abs() < APART_COS);
        let new: Vec<DVec3> = found.into_iter().filter(is_new).collect();
        peaks.extend(new);
    }
    peaks
}

/// Modes of a distribution of normals.
fn peaks_of(normals: &[DVec3]) -> Vec<DVec3> {
    let stride = normals.len().div_ceil(MAX_NORMALS).max(1);
    let normals: Vec<DVec3> = normals.iter().copied().step_by(stride).collect();
    let start_stride = normals.len().div_ceil(MAX_STARTS).max(1);
    // Mean shift on the unit sphere, with opposite directions identified.
    let shifted = |start: DVec3| {
        let near = normals.iter().filter(|normal| normal.dot(start).abs() > PEAK_COS);
        let mean = near.map(|normal| *normal * normal.dot(start).signum()).sum::<DVec3>();
        mean.normalize_or(start)
    };
    let strength = |peak: DVec3| normals.iter().filter(|normal| normal.dot(peak).abs() > PEAK_COS).count();
    let mut ranked: Vec<(usize, DVec3)> =
        normals.iter().step_by(start_stride).map(|start| (strength(*start), *start)).collect();
    ranked.sort_by_key(|(strength, _)| std::cmp::Reverse(*strength));
    let mut peaks: Vec<DVec3> = Vec::new();
    for (_, start) in ranked {
        if peaks.len() == MAX_PEAKS {
            break;
        }
        let is_new = |direction: DVec3| peaks.iter().all(|known| known.dot(direction).abs() < APART_COS);
        let peak = if is_new(start) { (0..4).fold(start, |peak, _| shifted(peak)) } else { continue };
        if is_new(peak) {
            peaks.push(peak);
        }
    }
    peaks
}

/// Normal, near `up`, of the plane through the patches around a height. Repeated fitting and trimming excludes the feet of
/// furniture and noise below the floor.
pub(super) fn level(sample: &PatchSample, up: DVec3, height: f64) -> DVec3 {
    let mut reach = sample.size / 50.0;
    let (mut normal, mut offset) = (up, height);
    for _ in 0..8 {
        let is_near = |p: &DVec3| (p.dot(normal) - offset).abs() < reach;
        let points: Vec<DVec3> = sample.patches.iter().map(|patch| patch.position).filter(is_near).collect();
        if points.len() < 30 {
            break;
        }
        let plane = fit_plane(&points);
        let turned = plane.normal() * plane.normal().dot(up).signum();
        // Patches that do not form a plane (a pole, a ball) keep `up`.
        if turned.dot(up) < APART_COS {
            return up;
        }
        (normal, offset) = (turned, plane.middle.dot(turned));
        reach = (2.5 * plane.thickness).clamp(sample.size / 400.0, reach);
    }
    normal
}
