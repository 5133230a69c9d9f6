//! Light baking by Monte Carlo integration of diffuse transport.
//!
//! Enters: surfels, occluders and lights. Leaves: linear radiance and direct light per surfel. Invariant: sample directions
//! are hashes of surfel indices, so the result does not depend on the number of threads.
//!
//! Direct light comes from windows, sun and lamps. The first bounce is gathered from a coarse grid of directly lit
//! radiance; later bounces are a geometric series of the first.

use std::f32::consts::{PI, TAU};

use glam::{Quat, Vec3};
use rayon::prelude::*;

use super::bake_quality::BakeQuality;
use super::bvh::OccluderBvh;
use super::lights::{Lamp, Lights, Portal};
use super::noise;
use super::occluder::Ray;
use super::radiance::{GatheredLight, RadianceGrid, SmoothGrid};
use super::surfel::Surfel;

/// Distance between a surface and the start of its rays, m.
const RAY_OFFSET: f32 = 0.004;

/// Light of all later bounces relative to the first: r + r^2 + ... of the mean reflectance r of rooms.
const LATER_BOUNCES: f32 = 0.75;

/// Minimum distance to the nearest occluder at which a direction counts as open, m.
const OPEN_DISTANCE: f32 = 0.6;

/// Clamp of the radiance of one gathered ray: suppresses fireflies from sunlit spots.
const MAX_RAY_RADIANCE: f32 = 2.0;

/// Linear luminance of irradiance below which no shadow ray is cast.
const NEGLIGIBLE: f32 = 0.006;

/// Direct light on a surfel.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct DirectLight {
    /// Irradiance.
    pub(super) irradiance: Vec3,
    /// Sum of the unit directions to the lights, weighted by luminance.
    pub(super) toward: Vec3,
}

/// Baked light of every surfel.
pub(super) struct BakedLight {
    /// Outgoing linear radiance.
    pub(super) radiance: Vec<Vec3>,
    /// Direct light.
    pub(super) direct: Vec<DirectLight>,
}

/// Integrates the light on all surfels.
pub(super) fn bake(surfels: &[Surfel], occluders: &OccluderBvh, lights: &Lights, quality: BakeQuality) -> BakedLight {
    let integrator = LightIntegrator { occluders, lights, quality };
    let direct: Vec<DirectLight> =
        surfels.par_iter().enumerate().map(|(i, s)| integrator.direct(s, i as u32)).collect();
    let mut grid = RadianceGrid::direct(surfels, quality);
    for (surfel, lit) in surfels.iter().zip(&direct) {
        grid.add(surfel, outgoing(surfel, lit.irradiance));
    }
    let gathered: Vec<GatheredLight> =
        surfels.par_iter().enumerate().map(|(i, s)| integrator.gather(&grid, s, i as u32 ^ 0x5f35_6495)).collect();
    let smooth = SmoothGrid::of(surfels, &gathered, quality);
    let bounced: Vec<Vec3> = surfels.par_iter().zip(&gathered).map(|(s, own)| smooth.irradiance(s, own)).collect();
    let total = |i: usize| outgoing(&surfels[i], direct[i].irradiance + bounced[i] * (1.0 + LATER_BOUNCES));
    BakedLight { radiance: (0..surfels.len()).map(total).collect(), direct }
}

/// Outgoing radiance of a diffuse surfel.
fn outgoing(surfel: &Surfel, irradiance: Vec3) -> Vec3 {
    surfel.albedo * (irradiance / PI + surfel.emission)
}

/// Luminance of a linear color (Rec. 709).
pub(super) fn luminance(color: Vec3) -> f32 {
    color.dot(Vec3::new(0.2126, 0.7152, 0.0722))
}

struct LightIntegrator<'a> {
    occluders: &'a OccluderBvh,
    lights: &'a Lights,
    quality: BakeQuality,
}

/// Two hashed numbers in 0..1 for sample `k` of a surfel.
fn jitter(seed: u32, k: u32) -> (f32, f32) {
    let h = noise::hash(seed as i32, k as i32, 0x2545_f491);
    ((h & 0xffff) as f32 / 65_536.0, (h >> 16) as f32 / 65_536.0)
}

/// Cosine between the surfel's normal and a direction. A two-sided surfel transmits light, so its value is positive.
fn cosine_to(surfel: &Surfel, toward: Vec3) -> f32 {
    let cosine = surfel.normal.dot(toward);
    if surfel.two_sided { if cosine > 0.0 { cosine.max(0.35) } else { 0.6 * cosine.abs().max(0.35) } } else { cosine }
}

impl LightIntegrator<'_> {
    /// Direct light of windows, sun and lamps.
    fn direct(&self, surfel: &Surfel, seed: u32) -> DirectLight {
        let mut lit = DirectLight::default();
        let mut add = |toward: Vec3, light: Vec3| {
            lit.irradiance += light;
            lit.toward += toward * luminance(light);
        };
        for (p, portal) in self.lights.portals.iter().enumerate() {
            self.add_portal(surfel, portal, seed ^ (p as u32) << 20, &mut add);
        }
        for k in 0..self.quality.point_rays {
            if let Some(sun) = &self.lights.sun {
                let (a, b) = jitter(seed ^ 0x51ed, k);
                let wobble = Vec3::new(a - 0.5, b - 0.5, a + b - 1.0) * 0.012;
                let toward = (sun.toward + wobble).normalize();
                let cosine = cosine_to(surfel, toward);
                if cosine > 0.0 && self.through_window(surfel.mean, toward) && !self.is_occluded(surfel, toward, 40.0) {
                    add(toward, sun.irradiance * cosine / self.quality.point_rays as f32);
                }
            }
            for (l, lamp) in self.lights.lamps.iter().enumerate() {
                self.add_lamp(surfel, lamp, jitter(seed ^ 0x9d2c ^ (l as u32) << 12, k), &mut add);
            }
        }
        lit
    }

    fn add_portal(&self, surfel: &Surfel, portal: &Portal, seed: u32, add: &mut impl FnMut(Vec3, Vec3)) {
        let count = (self.quality.portal_rays / self.lights.portals.len() as u32).max(1);
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
            let (here, there) = (cosine_to(surfel, toward), -portal.inward.dot(toward));
            if here > 0.0 && there > 0.0 {
                let solid_angle = area * there / distance.powi(2).max(0.09);
                let light = portal.radiance * (here * solid_angle / count as f32);
                if luminance(light) < NEGLIGIBLE || !self.is_occluded(surfel, toward, distance - 0.02) {
                    add(toward, light);
                }
            }
        }
    }

    fn add_lamp(&self, surfel: &Surfel, lamp: &Lamp, (a, b): (f32, f32), add: &mut impl FnMut(Vec3, Vec3)) {
        let to = lamp.center + on_unit_sphere(a, b) * lamp.radius - surfel.mean;
        let distance = to.length().max(0.05);
        let toward = to / distance;
        let cosine = cosine_to(surfel, toward);
        if cosine > 0.0 {
            let light = lamp.intensity * (cosine / distance.powi(2).max(0.03) / self.quality.point_rays as f32);
            if luminance(light) < NEGLIGIBLE || !self.is_occluded(surfel, toward, distance - 0.02) {
                add(toward, light);
            }
        }
    }

    /// Whether a ray to the sun leaves the room through a window; walls and ceiling block all other rays.
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
        Ray { origin: surfel.mean + side * RAY_OFFSET, direction, object: surfel.object, primitive: None }
    }

    fn is_occluded(&self, surfel: &Surfel, direction: Vec3, far: f32) -> bool {
        self.occluders.is_occluded(&Self::ray(surfel, direction), far)
    }

    /// Irradiance of the first bounce, and the openness of the hemisphere.
    fn gather(&self, grid: &RadianceGrid, surfel: &Surfel, seed: u32) -> GatheredLight {
        let frame = Quat::from_rotation_arc(Vec3::Z, surfel.normal);
        let count = self.quality.gather_rays;
        let (turn, lift) = jitter(seed, 0xffff);
        let mut sum = GatheredLight::default();
        for k in 0..count {
            let (a, _) = jitter(seed, k);
            let square = (k as f32 + a) / count as f32;
            // A golden-angle spiral over the disc, projected onto the hemisphere (Malley's method).
            let angle = TAU * (turn + k as f32 * 0.618_034);
            let local = Vec3::new(square.sqrt() * angle.cos(), square.sqrt() * angle.sin(), (1.0 - square).sqrt());
            let flip = if surfel.two_sided && (k as f32 + lift) % 3.0 < 1.0 { -1.0 } else { 1.0 };
            let (radiance, openness) = self.incoming(grid, surfel, frame * local * flip);
            sum.irradiance += radiance * (PI / count as f32);
            sum.openness += openness / count as f32;
        }
        sum
    }

    /// Incoming radiance from a direction, and the openness of that direction, 0..=1.
    fn incoming(&self, grid: &RadianceGrid, surfel: &Surfel, direction: Vec3) -> (Vec3, f32) {
        let ray = Self::ray(surfel, direction);
        let Some(hit) = self.occluders.closest_hit(&ray, 30.0) else { return (self.lights.ambient, 1.0) };
        if hit.distance <= 0.0 {
            return (Vec3::ZERO, 0.0);
        }
        let openness = (hit.distance / OPEN_DISTANCE).min(1.0);
        let radiance =
            grid.radiance(ray.origin + direction * hit.distance, hit.normal).min(Vec3::splat(MAX_RAY_RADIANCE));
        (radiance + self.lights.ambient * openness, openness)
    }
}

/// Uniform point on the unit sphere from two uniform numbers in 0..1.
fn on_unit_sphere(a: f32, b: f32) -> Vec3 {
    let z = 2.0 * a - 1.0;
    let r = (1.0 - z * z).max(0.0).sqrt();
    Vec3::new(r * (TAU * b).cos(), z, r * (TAU * b).sin())
}
