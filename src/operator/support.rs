//! Where a camera belongs: the part of space from which the capture shows its good side.
//!
//! A scan holds surfaces as seen from where its photographs were taken; behind walls and inside furniture there are only
//! backs. The photographs are not in the file, so the stand is found from the matter itself: hubs are free places that
//! see much of the scene around them at a distance, and a place is supported if enough hubs see it.

use glam::{DMat3, DVec3};
use rayon::prelude::*;

use super::clearance::ClearanceIndex;
use super::grid::OpacityGrid;
use cinesplat_geometry::LevelFrame;
use cinesplat_objects::Object;
use cinesplat_scene::Bounds;

/// Share of all directions in which the best place must meet matter for the scene to count as a place one stands inside.
const INDOOR_HIT_FRAC: f64 = 0.5;
/// Hubs of a scene.
const NUM_HUBS: usize = 24;
/// Share of the hubs that must see a place. Through a window or a hole in a wall a few hubs see what is behind it; from
/// within a room even a niche is seen by more.
const SEEN_BY_FRAC: f64 = 0.25;

/// What a place sees must stand on ground in at least this share of what the hubs see.
const GROUNDED_OF_HUBS_FRAC: f64 = 0.62;

/// Which places a camera may stand in.
#[derive(Debug, Clone)]
pub(super) struct Support {
    /// Least share of grounded sights of a place; 0 where the scene has no ground.
    least_grounded: f64,
    up: DVec3,
    size: f64,
    /// Free places with a good view, the best one first.
    pub(super) hubs: Vec<DVec3>,
    /// Whether the scene surrounds the camera.
    pub(super) indoor: bool,
}

impl Support {
    /// The supported space of a scene.
    ///
    /// No hub stands in one of `boxes`: the inside of a thing is no place to film from, however well it is enclosed.
    pub(super) fn of(
        matter: &OpacityGrid,
        clearance: &ClearanceIndex,
        bounds: &Bounds,
        frame: &LevelFrame,
        boxes: &[Object],
    ) -> Self {
        let free = |p: DVec3| {
            let open = clearance.nearest_within(p, 0.03 * bounds.size()).is_none();
            open && !boxes.iter().any(|object| object.contains(p, 0.0))
        };
        let (hubs, indoor) = hubs(matter, bounds, frame, free);
        let (up, size) = (frame.up, bounds.size());
        let mean = |values: Vec<f64>| values.iter().sum::<f64>() / values.len().max(1) as f64;
        let grounded = mean(hubs.iter().map(|&hub| grounded_frac(matter, hub, up, size, 96)).collect());
        let least_grounded = if indoor { GROUNDED_OF_HUBS_FRAC * grounded } else { 0.0 };
        Self { least_grounded, up, size, hubs, indoor }
    }

    /// Whether what is seen from a point is seen from its good side: what stands on a floor has that floor before it.
    pub(super) fn is_good_side(&self, matter: &OpacityGrid, point: DVec3) -> bool {
        self.least_grounded <= 0.0 || grounded_frac(matter, point, self.up, self.size, 40) >= self.least_grounded
    }

    /// Whether a camera may stand at a point.
    pub(super) fn holds(&self, matter: &OpacityGrid, point: DVec3) -> bool {
        let needed = (SEEN_BY_FRAC * self.hubs.len() as f64).ceil() as usize;
        let (mut seen, mut left) = (0, self.hubs.len());
        for &hub in &self.hubs {
            if seen >= needed || seen + left < needed {
                break;
            }
            left -= 1;
            seen += usize::from(matter.is_open(point, hub));
        }
        seen >= needed
    }
}

fn hubs(
    matter: &OpacityGrid,
    bounds: &Bounds,
    frame: &LevelFrame,
    free: impl Fn(DVec3) -> bool + Sync,
) -> (Vec<DVec3>, bool) {
    let size = bounds.size();
    let mut scored: Vec<(f64, f64, DVec3)> = lattice(bounds, frame)
        .into_par_iter()
        .filter(|&p| free(p))
        .map(|p| {
            let (hit_frac, spread) = openness(matter, p, size);
            (hit_frac * hit_frac * spread, hit_frac, p)
        })
        .collect();
    scored.sort_by(|a, b| b.0.total_cmp(&a.0));
    // Ground is dear to look for: only for the most open third.
    scored.truncate(scored.len().div_ceil(3));
    scored.par_iter_mut().for_each(|(score, _, p)| *score *= 0.1 + grounded_frac(matter, *p, frame.up, size, 48));
    scored.sort_by(|a, b| b.0.total_cmp(&a.0));
    match scored.first() {
        Some(&(best, hit_frac, first)) if hit_frac >= INDOOR_HIT_FRAC => {
            let good: Vec<DVec3> =
                scored.iter().filter(|s| s.0 >= 0.4 * best && s.1 >= 0.8 * hit_frac).map(|s| s.2).collect();
            (spread(first, &good, matter), true)
        }
        _ => (ring(bounds, frame), false),
    }
}

/// Points to try as hubs: a lattice over the core box and a way around it, where a camera may have stood that saw only
/// one side of a room.
fn lattice(bounds: &Bounds, frame: &LevelFrame) -> Vec<DVec3> {
    const N: usize = 12;
    let upright = frame.up.abs();
    let margin = (DVec3::ONE - upright) * 0.25 * bounds.size();
    let (low, extent) = (bounds.core_min - margin, bounds.core_max - bounds.core_min + margin * 2.0);
    let at = |i: usize| (i as f64 + 0.5) / N as f64;
    let mut points = Vec::with_capacity(N * N * N);
    for x in 0..N {
        for y in 0..N {
            points.extend((0..N).map(|z| low + extent * DVec3::new(at(x), at(y), at(z))));
        }
    }
    points
}

/// Share of directions that meet matter, and how far what they meet spreads in space over the scene size: the geometric
/// mean of its standard deviations. Behind a wall all that is met is the wall, which is flat.
fn openness(matter: &OpacityGrid, point: DVec3, size: f64) -> (f64, f64) {
    let rays = sphere_directions(96);
    let hits: Vec<DVec3> =
        rays.iter().filter_map(|&ray| matter.hit_distance(point, ray, size).map(|distance| ray * distance)).collect();
    let count = hits.len().max(1) as f64;
    let mean = hits.iter().sum::<DVec3>() / count;
    let covariance = hits.iter().map(|&hit| outer(hit - mean)).fold(DMat3::ZERO, |sum, m| sum + m) * (1.0 / count);
    let spread = covariance.determinant().max(0.0).powf(1.0 / 6.0);
    (hits.len() as f64 / rays.len() as f64, spread / size)
}

/// Share of the sights of a place that have ground under the space before them. A scan holds the floor in front of a
/// wall, not behind it: from the wrong side of a surface the space before it hangs over nothing.
fn grounded_frac(matter: &OpacityGrid, point: DVec3, up: DVec3, size: f64, num_rays: usize) -> f64 {
    let (mut hits, mut grounded) = (0.0_f64, 0.0);
    for ray in sphere_directions(num_rays) {
        let Some(distance) = matter.hit_distance(point, ray, size) else { continue };
        let before = point + ray * (distance - 0.05 * size).max(0.0);
        hits += 1.0;
        grounded += f64::from(u8::from(matter.hit_distance(before, -up, 0.8 * size).is_some()));
    }
    if hits > 0.0 { grounded / hits } else { 0.0 }
}

fn outer(v: DVec3) -> DMat3 {
    DMat3::from_cols(v * v.x, v * v.y, v * v.z)
}

/// Even directions over the sphere (Fibonacci spiral).
pub(super) fn sphere_directions(count: usize) -> Vec<DVec3> {
    let golden = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    let direction = |i: usize| {
        let y = 1.0 - 2.0 * (i as f64 + 0.5) / count as f64;
        let ring = (1.0 - y * y).sqrt();
        let (sin, cos) = (golden * i as f64).sin_cos();
        DVec3::new(ring * cos, y, ring * sin)
    };
    (0..count).map(direction).collect()
}

/// The first hub and others far from it and from each other, each in sight of one before.
fn spread(first: DVec3, good: &[DVec3], matter: &OpacityGrid) -> Vec<DVec3> {
    let mut hubs = vec![first];
    while hubs.len() < NUM_HUBS {
        let apart = |p: &DVec3| hubs.iter().map(|hub| hub.distance(*p)).fold(f64::INFINITY, f64::min);
        let seen = |p: &&DVec3| hubs.iter().any(|&hub| matter.is_open(hub, **p));
        match good.iter().filter(seen).max_by(|a, b| apart(a).total_cmp(&apart(b))) {
            Some(&next) if apart(&next) > 2.0 * matter.grid.cell => hubs.push(next),
            _ => break,
        }
    }
    hubs
}

/// Places around a scene that is looked at from outside.
fn ring(bounds: &Bounds, frame: &LevelFrame) -> Vec<DVec3> {
    let reach = 0.52 * bounds.size() + frame.horizontal(bounds.core_max - bounds.core_min).length() / 2.0;
    let height = frame.height(bounds.core_max - bounds.core_min).abs();
    let place = |i: usize| {
        let azimuth = std::f64::consts::TAU * (i % 12) as f64 / 12.0;
        let rise = [0.05, 0.45][i / 12] * height;
        bounds.center() + frame.direction(azimuth) * reach * 0.95 + frame.up * rise
    };
    (0..24).map(place).collect()
}
