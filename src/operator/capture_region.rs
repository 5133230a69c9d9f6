//! The region from which the scene was captured, estimated from its matter.
//!
//! A capture reconstructs surfaces as seen from its photographs. From behind walls and inside furniture only back faces
//! show. The scene file does not contain the photographs' poses, so the region is estimated: viewpoints are free places
//! that see much of the scene around them at a distance, and a point is in the region where enough viewpoints see it.

use glam::{DMat3, DVec3};
use rayon::prelude::*;

use super::clearance::ClearanceIndex;
use super::opacity_grid::OpacityGrid;
use cinesplat_geometry::{LevelFrame, sphere_directions};
use cinesplat_objects::Object;
use cinesplat_scene::Bounds;

/// Share of all directions in which the best viewpoint must see matter for the scene to count as indoor.
const INDOOR_HIT_FRAC: f64 = 0.5;
/// Share of the directions around it, those whose sine above the horizon is in this range, in which it must see matter too,
/// and rays over the whole sphere of which these are taken.
const AROUND_FRAC: f64 = 0.25;
const AROUND_SIN: std::ops::Range<f64> = -0.1..0.6;
const AROUND_RAYS: usize = 240;
/// Least sine of the angle below the horizon of rays that look for the floor.
const STEEP_SIN: f64 = 0.8;
/// Points on surfaces by which it is told how much of the scene a place sees.
const NUM_SAMPLES: usize = 72;
/// Viewpoints per scene.
const NUM_VIEWPOINTS: usize = 24;
/// Share of the viewpoints that must see a point of the region. A few viewpoints see through a window or a hole in a
/// wall; more of them see even a niche of their own room.
const SEEN_BY_FRAC: f64 = 0.25;
/// Least grounded share of a point that sees front faces, over the mean grounded share of the viewpoints.
const GROUNDED_OF_VIEWPOINTS_FRAC: f64 = 0.62;

/// The region in which a camera may stand.
#[derive(Debug, Clone)]
pub(super) struct CaptureRegion {
    /// Least grounded share of a point that sees front faces; 0 for outdoor scenes, which have no floor.
    least_grounded: f64,
    up: DVec3,
    size: f64,
    /// Free places with a wide view of the scene, the best one first; world.
    pub(super) viewpoints: Vec<DVec3>,
    /// Whether the scene surrounds the camera.
    pub(super) indoor: bool,
    /// Points on the scene's surfaces.
    samples: Vec<DVec3>,
    /// Largest share of them that a viewpoint sees.
    most_seen: f64,
}

impl CaptureRegion {
    /// Estimates the region of a scene. No viewpoint lies inside one of the `objects`: their inside is enclosed like a
    /// room, but it was not captured. `surface`: points of the scene's matter.
    pub(super) fn of(
        matter: &OpacityGrid,
        clearance: &ClearanceIndex,
        bounds: &Bounds,
        frame: &LevelFrame,
        objects: &[Object],
        surface: &[DVec3],
    ) -> Self {
        let free = |p: DVec3| {
            let open = clearance.nearest_within(p, 0.03 * bounds.size()).is_none();
            open && !objects.iter().any(|object| object.contains(p, 0.0))
        };
        let (enclosed, is_enclosed) = viewpoints(matter, bounds, frame, free);
        let indoor = is_enclosed && surrounds(matter, bounds, frame, &enclosed, surface);
        let viewpoints = if indoor == is_enclosed { enclosed } else { ring(bounds, frame) };
        let (up, size) = (frame.up, bounds.size());
        let mean = |values: Vec<f64>| values.iter().sum::<f64>() / values.len().max(1) as f64;
        let grounded = mean(viewpoints.iter().map(|&eye| grounded_frac(matter, eye, up, size, 96)).collect());
        let least_grounded = if indoor { GROUNDED_OF_VIEWPOINTS_FRAC * grounded } else { 0.0 };
        // Outdoors nobody stands behind a curtain.
        let samples = if indoor { surface_samples(matter, &viewpoints, size) } else { Vec::new() };
        let most_seen = viewpoints.iter().map(|&eye| seen_frac(matter, &samples, eye)).fold(0.0, f64::max);
        Self { least_grounded, up, size, viewpoints, indoor, samples, most_seen }
    }

    /// Height along up of the floor: of what lies below the viewpoints, a quarter is no higher. Things stand on the floor,
    /// and through windows one sees the ground outside. `None` where nothing lies below them.
    pub(super) fn floor_height(&self, matter: &OpacityGrid) -> Option<f64> {
        let below = sphere_directions(NUM_SAMPLES).into_iter().filter(|ray| ray.dot(self.up) < -STEEP_SIN);
        let rays: Vec<DVec3> = below.collect();
        let hit =
            |(eye, ray): (DVec3, DVec3)| Some((eye + ray * matter.hit_distance(eye, ray, self.size)?).dot(self.up));
        let pairs = self.viewpoints.iter().flat_map(|&eye| rays.iter().map(move |&ray| (eye, ray)));
        let mut heights: Vec<f64> = pairs.filter_map(hit).collect();
        heights.sort_by(f64::total_cmp);
        heights.get(heights.len() / 4).copied()
    }

    /// Share of the scene's surfaces that a point sees, over what the best viewpoint sees, 0..=1: a capture was made from
    /// where much of it is in sight, not from behind a curtain.
    pub(super) fn seen_of_best_frac(&self, matter: &OpacityGrid, point: DVec3) -> f64 {
        let seen = seen_frac(matter, &self.samples, point);
        if self.most_seen > 0.0 { (seen / self.most_seen).min(1.0) } else { 1.0 }
    }

    /// Whether a point sees surfaces from the captured side: the floor in front of them was captured too.
    pub(super) fn sees_front_faces(&self, matter: &OpacityGrid, point: DVec3) -> bool {
        self.least_grounded <= 0.0 || grounded_frac(matter, point, self.up, self.size, 40) >= self.least_grounded
    }

    /// Whether a point lies in the region.
    pub(super) fn contains(&self, matter: &OpacityGrid, point: DVec3) -> bool {
        let needed = (SEEN_BY_FRAC * self.viewpoints.len() as f64).ceil() as usize;
        let (mut seen, mut left) = (0, self.viewpoints.len());
        for &viewpoint in &self.viewpoints {
            if seen >= needed || seen + left < needed {
                break;
            }
            left -= 1;
            seen += usize::from(matter.is_open(point, viewpoint));
        }
        seen >= needed
    }
}

/// Points on surfaces: where rays from the viewpoints end.
fn surface_samples(matter: &OpacityGrid, viewpoints: &[DVec3], size: f64) -> Vec<DVec3> {
    let each = NUM_SAMPLES.div_ceil(viewpoints.len().max(1));
    let rays = sphere_directions(each * viewpoints.len());
    let from = |(i, &eye): (usize, &DVec3)| {
        // Every viewpoint takes other directions of the same spiral.
        let own = rays.iter().skip(i).step_by(viewpoints.len());
        own.filter_map(|&ray| Some(eye + ray * matter.hit_distance(eye, ray, size)?)).collect::<Vec<_>>()
    };
    viewpoints.iter().enumerate().flat_map(from).collect()
}

/// Share of some points on surfaces that a point sees.
fn seen_frac(matter: &OpacityGrid, samples: &[DVec3], point: DVec3) -> f64 {
    samples.iter().filter(|sample| sees(matter, point, **sample)).count() as f64 / samples.len().max(1) as f64
}

/// The viewpoints of a scene, and whether it is indoor.
fn viewpoints(
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
    // The grounded share is expensive: only the best third is tested.
    scored.truncate(scored.len().div_ceil(3));
    scored.par_iter_mut().for_each(|(score, _, p)| *score *= 0.1 + grounded_frac(matter, *p, frame.up, size, 48));
    scored.sort_by(|a, b| b.0.total_cmp(&a.0));
    match scored.first() {
        Some(&(best, hit_frac, first))
            if hit_frac >= INDOOR_HIT_FRAC && around_frac(matter, first, frame.up, size) >= AROUND_FRAC =>
        {
            let good: Vec<DVec3> =
                scored.iter().filter(|s| s.0 >= 0.4 * best && s.1 >= 0.8 * hit_frac).map(|s| s.2).collect();
            (spread_out(first, &good, matter), true)
        }
        _ => (ring(bounds, frame), false),
    }
}

/// Candidate viewpoints: a lattice over the core box and a margin around it, where the camera of a capture of one side
/// of a room may have stood.
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

/// Share of directions that hit matter, and the spread of the hits over the scene size: the geometric mean of their
/// standard deviations. Behind a wall every hit is on the wall, which is flat, so that the spread is small.
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

/// Share of the directions from just below the horizon to well above it that meet matter: ground below a thing is no room.
fn around_frac(matter: &OpacityGrid, point: DVec3, up: DVec3, size: f64) -> f64 {
    let level = |ray: &DVec3| AROUND_SIN.contains(&ray.dot(up));
    let rays: Vec<DVec3> = sphere_directions(AROUND_RAYS).into_iter().filter(level).collect();
    let hits = rays.iter().filter(|&&ray| matter.hit_distance(point, ray, size).is_some()).count();
    hits as f64 / rays.len().max(1) as f64
}

/// Share of a point's hits that have ground below the space before them. A capture contains the floor in front of a
/// wall, not behind it: from the wrong side of a surface there is no ground before it.
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

/// Farthest point sampling among the `good` places, from `first` on; each one is visible from one before it.
fn spread_out(first: DVec3, good: &[DVec3], matter: &OpacityGrid) -> Vec<DVec3> {
    let mut chosen = vec![first];
    while chosen.len() < NUM_VIEWPOINTS {
        let apart = |p: &DVec3| chosen.iter().map(|other| other.distance(*p)).fold(f64::INFINITY, f64::min);
        let seen = |p: &&DVec3| chosen.iter().any(|&other| matter.is_open(other, **p));
        match good.iter().filter(seen).max_by(|a, b| apart(a).total_cmp(&apart(b))) {
            Some(&next) if apart(&next) > 2.0 * matter.grid.cell => chosen.push(next),
            _ => break,
        }
    }
    chosen
}

/// Number of viewpoints inside, and what they must see together over what is seen from outside, for the scene to be a room:
/// between the flowers of a bouquet and on the seat of an armchair .2 to .36 is seen, in rooms at least .8.
const NUM_INSIDE: usize = 8;
const SURROUNDED_FRAC: f64 = 0.6;
/// Share of directions in which the best viewpoint meets matter from which the scene is closed around it, and the share that has to
/// be seen there: the ground outside may have been captured too. Inside a hollow figure .05 is seen.
const CLOSED_FRAC: f64 = 0.75;
const CLOSED_SURROUNDED_FRAC: f64 = 0.15;
/// Places outside: directions, their angles above the horizon, and their distance over the scene size.
const NUM_AROUND: usize = 12;
const ABOVE_RAD: [f64; 2] = [0.1, 0.6];
const OUTSIDE_FRAC: f64 = 1.1;

/// Whether a scene is seen from inside: most of what anybody sees of its `surface` is seen from the `inside` viewpoints.
fn surrounds(matter: &OpacityGrid, bounds: &Bounds, frame: &LevelFrame, inside: &[DVec3], surface: &[DVec3]) -> bool {
    let place = |away: DVec3| bounds.center() + away * OUTSIDE_FRAC * bounds.size();
    let outside: Vec<DVec3> = frame.rings(NUM_AROUND, &ABOVE_RAD).map(place).collect();
    let num_seen = |eyes: &[DVec3]| {
        let is_seen = |point: &&DVec3| eyes.iter().any(|&eye| sees(matter, eye, **point));
        surface.par_iter().filter(is_seen).count() as f64
    };
    let inside = &inside[..inside.len().min(NUM_INSIDE)];
    let (hit_frac, _) = inside.first().map_or((0.0, 0.0), |&eye| openness(matter, eye, bounds.size()));
    let needed_frac = if hit_frac >= CLOSED_FRAC { CLOSED_SURROUNDED_FRAC } else { SURROUNDED_FRAC };
    num_seen(inside) >= needed_frac * num_seen(&outside)
}

/// Whether a point sees one on a surface.
fn sees(matter: &OpacityGrid, eye: DVec3, surface: DVec3) -> bool {
    let to = surface - eye;
    let reach = to.length();
    let Some(ray) = to.try_normalize() else { return true };
    let stop = reach - 2.0 * matter.grid.cell;
    matter.hit_distance(eye, ray, reach).is_none_or(|distance| distance >= stop)
}

/// Viewpoints on two rings around an outdoor scene.
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
