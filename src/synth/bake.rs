//! Baked light: what falls on every surfel from windows, the sun, lamps, and once more from all that these light up.
//!
//! Enters: surfels and blockers. Leaves: linear radiance and a sheen a surfel. Diffuse transport by Monte Carlo with hashed
//! directions, so the result depends on nothing but the surfels; the first bounce is gathered from a coarse grid of
//! the directly lit radiance, further bounces are its geometric series.

use std::f32::consts::{PI, TAU};

use glam::{Quat, Vec3};
use rayon::prelude::*;

use super::noise;
use super::radiance::{Gathered, RadianceGrid, SmoothGrid};
use super::ray::{Blockers, Ray};
use super::surfel::Surfel;

/// How far off its surface a ray starts, m.
const LIFT: f32 = 0.004;

/// Light that all later bounces add to the first: mean reflectance of rooms, r + r^2 + ...
const LATER_BOUNCES: f32 = 0.75;

/// An opening onto the bright sky: a rectangle that shines inward.
#[derive(Debug, Clone, Copy)]
pub(super) struct Portal {
    /// Middle.
    pub(super) center: Vec3,
    /// Half of its width as a vector.
    pub(super) half_width: Vec3,
    /// Half of its height as a vector.
    pub(super) half_height: Vec3,
    /// Direction into the room.
    pub(super) inward: Vec3,
    /// Radiance, linear.
    pub(super) radiance: Vec3,
}

/// Direct sun.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sun {
    /// Unit direction to it.
    pub(super) toward: Vec3,
    /// Irradiance on a surface that faces it.
    pub(super) irradiance: Vec3,
}

/// A small round light.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lamp {
    /// Middle.
    pub(super) center: Vec3,
    /// Radius, m.
    pub(super) radius: f32,
    /// Radiant intensity, linear.
    pub(super) intensity: Vec3,
}

/// All lights of a scene.
#[derive(Debug, Clone, Default)]
pub(super) struct Lights {
    /// Windows.
    pub(super) portals: Vec<Portal>,
    /// Sun, if it shines.
    pub(super) sun: Option<Sun>,
    /// Lamps.
    pub(super) lamps: Vec<Lamp>,
    /// Even light from everywhere, scaled by how open the surroundings are.
    pub(super) ambient: Vec3,
}

/// Distance from which surroundings count as open, m.
const OPEN_DISTANCE: f32 = 0.6;

/// Highest radiance that a single gathered ray may bring: keeps speckles of sunlit spots down.
const BRIGHTEST: f32 = 2.0;

/// Irradiance, linear luminance, that is not worth a shadow ray.
const NEGLIGIBLE: f32 = 0.006;

/// Rays a surfel.
#[derive(Debug, Clone, Copy)]
pub(super) struct RayCounts {
    /// To the windows together.
    pub(super) portal: u32,
    /// To the sun and to each lamp.
    pub(super) point: u32,
    /// Into the half space.
    pub(super) gather: u32,
    /// Edge of the radiance grid's cells relative to film quality.
    pub(super) grid: f32,
}

/// Light on a surfel.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Lit {
    /// Irradiance.
    pub(super) irradiance: Vec3,
    /// Where direct light comes from, weighted by its luminance.
    pub(super) toward: Vec3,
}

/// Radiance leaving every surfel, and its direct light.
pub(super) struct Baked {
    /// Linear radiance.
    pub(super) radiance: Vec<Vec3>,
    /// Direct light alone.
    pub(super) direct: Vec<Lit>,
}

/// Lights all surfels.
pub(super) fn bake(surfels: &[Surfel], blockers: &Blockers, lights: &Lights, counts: RayCounts) -> Baked {
    let scene = Scene { blockers, lights, counts };
    let direct: Vec<Lit> = surfels.par_iter().enumerate().map(|(i, s)| scene.direct(s, i as u32)).collect();
    let mut grid = RadianceGrid::direct(surfels, counts);
    for (surfel, lit) in surfels.iter().zip(&direct) {
        grid.add(surfel, leaving(surfel, lit.irradiance));
    }
    let gathered: Vec<Gathered> =
        surfels.par_iter().enumerate().map(|(i, s)| scene.gather(&grid, s, i as u32 ^ 0x5f35_6495)).collect();
    let smooth = SmoothGrid::of(surfels, &gathered, counts);
    let bounced: Vec<Vec3> = surfels.par_iter().zip(&gathered).map(|(s, own)| smooth.irradiance(s, own)).collect();
    let total = |i: usize| leaving(&surfels[i], direct[i].irradiance + bounced[i] * (1.0 + LATER_BOUNCES));
    Baked { radiance: (0..surfels.len()).map(total).collect(), direct }
}

fn leaving(surfel: &Surfel, irradiance: Vec3) -> Vec3 {
    surfel.albedo * (irradiance / PI + surfel.glow)
}

/// Share of red, green and blue in luminance (Rec. 709).
pub(super) fn luminance(color: Vec3) -> f32 {
    color.dot(Vec3::new(0.2126, 0.7152, 0.0722))
}

struct Scene<'a> {
    blockers: &'a Blockers,
    lights: &'a Lights,
    counts: RayCounts,
}

/// A pair of hashed numbers in 0..1 for sample `k` of a surfel.
fn jitter(seed: u32, k: u32) -> (f32, f32) {
    let h = noise::hash(seed as i32, k as i32, 0x2545_f491);
    ((h & 0xffff) as f32 / 65_536.0, (h >> 16) as f32 / 65_536.0)
}

/// The side of a two-sided surfel that faces a direction.
fn facing(surfel: &Surfel, toward: Vec3) -> f32 {
    let cosine = surfel.normal.dot(toward);
    if surfel.thin { if cosine > 0.0 { cosine.max(0.35) } else { 0.6 * cosine.abs().max(0.35) } } else { cosine }
}

impl Scene<'_> {
    fn direct(&self, surfel: &Surfel, seed: u32) -> Lit {
        let mut lit = Lit::default();
        let mut add = |toward: Vec3, light: Vec3| {
            lit.irradiance += light;
            lit.toward += toward * luminance(light);
        };
        for (p, portal) in self.lights.portals.iter().enumerate() {
            self.add_portal(surfel, portal, seed ^ (p as u32) << 20, &mut add);
        }
        for k in 0..self.counts.point {
            if let Some(sun) = &self.lights.sun {
                let (a, b) = jitter(seed ^ 0x51ed, k);
                let wobble = Vec3::new(a - 0.5, b - 0.5, a + b - 1.0) * 0.012;
                let toward = (sun.toward + wobble).normalize();
                let cosine = facing(surfel, toward);
                if cosine > 0.0 && self.through_window(surfel.mean, toward) && !self.blocked(surfel, toward, 40.0) {
                    add(toward, sun.irradiance * cosine / self.counts.point as f32);
                }
            }
            for (l, lamp) in self.lights.lamps.iter().enumerate() {
                self.add_lamp(surfel, lamp, jitter(seed ^ 0x9d2c ^ (l as u32) << 12, k), &mut add);
            }
        }
        lit
    }

    fn add_portal(&self, surfel: &Surfel, portal: &Portal, seed: u32, add: &mut impl FnMut(Vec3, Vec3)) {
        let count = (self.counts.portal / self.lights.portals.len() as u32).max(1);
        let columns = (count as f32).sqrt().floor().max(1.0) as u32;
        let rows = count.div_ceil(columns);
        let area = 4.0 * portal.half_width.length() * portal.half_height.length();
        for k in 0..count {
            let (a, b) = jitter(seed, k);
            let u = ((k % columns) as f32 + a) / columns as f32 * 2.0 - 1.0;
            let v = ((k / columns) as f32 + b) / rows as f32 * 2.0 - 1.0;
            let to = portal.center + portal.half_width * u + portal.half_height * v - surfel.mean;
            let distance = to.length().max(1e-3);
            let toward = to / distance;
            let (here, there) = (facing(surfel, toward), -portal.inward.dot(toward));
            if here > 0.0 && there > 0.0 {
                let solid_angle = area * there / distance.powi(2).max(0.09);
                let light = portal.radiance * (here * solid_angle / count as f32);
                if luminance(light) < NEGLIGIBLE || !self.blocked(surfel, toward, distance - 0.02) {
                    add(toward, light);
                }
            }
        }
    }

    fn add_lamp(&self, surfel: &Surfel, lamp: &Lamp, (a, b): (f32, f32), add: &mut impl FnMut(Vec3, Vec3)) {
        let to = lamp.center + on_ball(a, b) * lamp.radius - surfel.mean;
        let distance = to.length().max(0.05);
        let toward = to / distance;
        let cosine = facing(surfel, toward);
        if cosine > 0.0 {
            let light = lamp.intensity * (cosine / distance.powi(2).max(0.03) / self.counts.point as f32);
            if luminance(light) < NEGLIGIBLE || !self.blocked(surfel, toward, distance - 0.02) {
                add(toward, light);
            }
        }
    }

    /// Whether a ray to the sun leaves the room through a window: walls and ceiling stop all others.
    fn through_window(&self, from: Vec3, toward: Vec3) -> bool {
        self.lights.portals.iter().any(|portal| {
            let speed = toward.dot(portal.inward);
            let at = from + toward * ((portal.center - from).dot(portal.inward) / speed) - portal.center;
            let within = |half: Vec3| at.dot(half).abs() <= half.length_squared();
            speed < 0.0 && within(portal.half_width) && within(portal.half_height)
        })
    }

    fn ray(surfel: &Surfel, direction: Vec3) -> Ray {
        let side = if surfel.normal.dot(direction) < 0.0 { -surfel.normal } else { surfel.normal };
        Ray { origin: surfel.mean + side * LIFT, direction, object: surfel.object, part: None }
    }

    fn blocked(&self, surfel: &Surfel, direction: Vec3, far: f32) -> bool {
        self.blockers.blocked(&Self::ray(surfel, direction), far)
    }

    /// Irradiance by one bounce, cosine-weighted over the half space, and how open that is.
    fn gather(&self, grid: &RadianceGrid, surfel: &Surfel, seed: u32) -> Gathered {
        let frame = Quat::from_rotation_arc(Vec3::Z, surfel.normal);
        let count = self.counts.gather;
        let (turn, lift) = jitter(seed, 0xffff);
        let mut sum = Gathered::default();
        for k in 0..count {
            let (a, _) = jitter(seed, k);
            let square = (k as f32 + a) / count as f32;
            // Golden-angle spiral over the disc, lifted to the half sphere (Malley's method).
            let angle = TAU * (turn + k as f32 * 0.618_034);
            let local = Vec3::new(square.sqrt() * angle.cos(), square.sqrt() * angle.sin(), (1.0 - square).sqrt());
            let flip = if surfel.thin && (k as f32 + lift) % 3.0 < 1.0 { -1.0 } else { 1.0 };
            let (radiance, openness) = self.incoming(grid, surfel, frame * local * flip);
            sum.irradiance += radiance * (PI / count as f32);
            sum.openness += openness / count as f32;
        }
        sum
    }

    /// Radiance from a direction and how far off it comes from, 0..=1.
    fn incoming(&self, grid: &RadianceGrid, surfel: &Surfel, direction: Vec3) -> (Vec3, f32) {
        let ray = Self::ray(surfel, direction);
        let Some(hit) = self.blockers.first(&ray, 30.0) else { return (self.lights.ambient, 1.0) };
        if hit.distance <= 0.0 {
            return (Vec3::ZERO, 0.0);
        }
        let openness = (hit.distance / OPEN_DISTANCE).min(1.0);
        let radiance = grid.radiance(ray.origin + direction * hit.distance, hit.normal).min(Vec3::splat(BRIGHTEST));
        (radiance + self.lights.ambient * openness, openness)
    }
}

fn on_ball(a: f32, b: f32) -> Vec3 {
    let z = 2.0 * a - 1.0;
    let r = (1.0 - z * z).max(0.0).sqrt();
    Vec3::new(r * (TAU * b).cos(), z, r * (TAU * b).sin())
}
