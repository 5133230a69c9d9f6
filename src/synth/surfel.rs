//! Surfels: the flat Gaussians that cover a surface, before light falls on them.

use glam::{DMat3, DQuat, DVec2, DVec3, Quat, Vec3};

use super::noise;
use super::paint::{Paint, Texel};
use super::place::Place;
use super::ray::{Blockers, Ray};

/// Cell width over standard deviation: with 1.35 a flat sheet lets less than one percent through.
const CELL_PER_SIGMA: f64 = 1.35;

/// A flat Gaussian with its material at that point, world frame.
#[derive(Debug, Clone, Copy)]
pub(super) struct Surfel {
    /// Mean.
    pub(super) mean: Vec3,
    /// Own axes to world; the third is the normal.
    pub(super) rotation: Quat,
    /// Standard deviations, m.
    pub(super) scale: Vec3,
    /// Outward normal.
    pub(super) normal: Vec3,
    /// Linear reflectance.
    pub(super) albedo: Vec3,
    /// Light given off over the reflectance.
    pub(super) glow: f32,
    /// Peak opacity.
    pub(super) opacity: f32,
    /// Sheen.
    pub(super) gloss: f32,
    /// Lit from both sides.
    pub(super) thin: bool,
    /// Object id, 0 = the room itself.
    pub(super) object: u16,
}

/// How far inside another part a surfel has to lie to count as buried, m: stand-ins are a little larger than round parts.
const BURIED: f32 = 0.02;

/// Gap before a surface, m, that nobody can look into.
const CLOSED_GAP: f32 = 0.035;

impl Surfel {
    /// Half extents of its one-sigma ellipsoid along the axes that `turn` takes the world to.
    pub(super) fn spread(&self, turn: DQuat) -> DVec3 {
        let own = DMat3::from_quat(turn * self.rotation.as_dquat()) * DMat3::from_diagonal(self.scale.as_dvec3());
        let row = |i: usize| own.row(i).length();
        DVec3::new(row(0), row(1), row(2))
    }

    /// Whether it is inside another part, or so close behind one all over its extent that it cannot be seen. Such
    /// surfels would be drawn over what hides them at grazing views, where splats are ordered by their centers.
    pub(super) fn hidden(&self, blockers: &Blockers, part: u32) -> bool {
        if self.thin || self.glow > 0.0 {
            return false;
        }
        let axes = [self.rotation * Vec3::X * self.scale.x, self.rotation * Vec3::Y * self.scale.y];
        let shut = |offset: Vec3| {
            let origin = self.mean + offset + self.normal * 0.001;
            let ray = Ray { origin, direction: self.normal, object: self.object, part: Some(part) };
            blockers.blocked(&ray, CLOSED_GAP)
        };
        blockers.bury(self.mean, part, BURIED)
            || [Vec3::ZERO, axes[0], -axes[0], axes[1], -axes[1]].into_iter().all(shut)
    }
}

/// Collects the surfels of one part.
pub(super) struct Brush<'a> {
    /// Part to world.
    pub(super) place: Place,
    /// Material.
    pub(super) paint: &'a Paint,
    /// Longest axis of the part, 0..=2.
    pub(super) grain: usize,
    /// Object id.
    pub(super) object: u16,
    /// What has been laid down.
    pub(super) out: Vec<Surfel>,
}

/// One cell of a surface in the part's frame: its middle and the vectors across it.
pub(super) struct Cell {
    /// Middle.
    pub(super) middle: DVec3,
    /// From its one side to the other along the first direction.
    pub(super) across: DVec3,
    /// The same along the second.
    pub(super) along: DVec3,
    /// Standard deviations as fractions of the two lengths.
    pub(super) sigma_frac: DVec2,
    /// Place in the pattern.
    pub(super) texel: Texel,
}

impl Brush<'_> {
    /// Lays one surfel over a cell; cells without area are left out.
    pub(super) fn dab(&mut self, cell: &Cell) {
        let (width, height) = (cell.across.length(), cell.along.length());
        let Some(normal) = cell.across.cross(cell.along).try_normalize() else { return };
        let second = normal.cross(cell.across / width);
        let frame = DQuat::from_mat3(&DMat3::from_cols(cell.across / width, second, normal));
        let sigma = DVec2::new(width, height) * cell.sigma_frac;
        let thickness = (0.1 * sigma.min_element()).clamp(3e-4, 2e-3);
        let rotation = (self.place.rotation * frame).normalize();
        let mean = self.place.apply(cell.middle).as_vec3();
        let bits = mean.to_array().map(f32::to_bits);
        let speck = 0.97 + 0.06 * noise::cell(bits[0] as i32, bits[1] as i32, bits[2]) as f32;
        self.out.push(Surfel {
            mean,
            rotation: rotation.as_quat(),
            scale: DVec3::new(sigma.x.max(thickness), sigma.y.max(thickness), thickness).as_vec3(),
            normal: (self.place.rotation * normal).as_vec3(),
            albedo: self.paint.albedo(&cell.texel, self.grain) * speck,
            glow: self.paint.glow,
            opacity: self.paint.opacity,
            gloss: self.paint.gloss,
            thin: self.paint.thin,
            object: self.object,
        });
    }

    /// Covers the surface over a grid of parameters. `first` x `second` must point outward; `size` is its rough extent, m.
    pub(super) fn cover(&mut self, cells: [&[Span]; 2], size: DVec2, surface: impl Fn(f64, f64) -> DVec3) {
        for v in cells[1] {
            for u in cells[0] {
                let middle = surface(u.middle, v.middle);
                let frac = DVec2::new(u.frac, v.frac);
                self.dab(&Cell {
                    middle,
                    across: surface(u.high, v.middle) - surface(u.low, v.middle),
                    along: surface(u.middle, v.high) - surface(u.middle, v.low),
                    sigma_frac: DVec2::new(u.sigma_frac, v.sigma_frac),
                    texel: Texel { along: frac * size, frac, local: middle },
                });
            }
        }
    }
}

/// One interval of a parameter.
#[derive(Debug, Clone, Copy)]
pub(super) struct Span {
    low: f64,
    high: f64,
    middle: f64,
    /// Of the whole range, 0..=1.
    frac: f64,
    sigma_frac: f64,
}

impl Span {
    /// Middle of the interval.
    pub(super) fn middle(&self) -> f64 {
        self.middle
    }

    /// Its ends.
    pub(super) fn ends(&self) -> (f64, f64) {
        (self.low, self.high)
    }
}

/// `low..high` cut into intervals of about `step`, whose Gaussians shrink toward the two ends so that outlines are crisp.
pub(super) fn spans(low: f64, high: f64, step: f64) -> Vec<Span> {
    let count = ((high - low) / step).round().max(1.0) as usize;
    let breaks: Vec<f64> = (0..=count).map(|i| low + (high - low) * i as f64 / count as f64).collect();
    between(&breaks)
}

/// As [`spans`] around a loop, without ends.
pub(super) fn loop_spans(low: f64, high: f64, count: usize) -> Vec<Span> {
    let count = count.max(3);
    let at = |i: f64| low + (high - low) * i / count as f64;
    (0..count)
        .map(|i| {
            let i = i as f64;
            let (frac, sigma_frac) = ((i + 0.5) / count as f64, 1.0 / CELL_PER_SIGMA);
            Span { low: at(i), high: at(i + 1.0), middle: at(i + 0.5), frac, sigma_frac }
        })
        .collect()
}

/// `-half..half` with narrow cells of `edge` width at both ends (none where `edge` is 0) and about `step` between.
pub(super) fn edged_spans(half: f64, edge: f64, step: f64) -> Vec<Span> {
    if edge <= 0.0 || edge >= half {
        return spans(-half, half, step);
    }
    let inner = half - edge;
    let corner = (1.3 * edge / step).ceil().max(1.0) as usize;
    let count = (2.0 * inner / step).round().max(1.0) as usize;
    let ramp = |i: usize, n: usize, a: f64, b: f64| a + (b - a) * i as f64 / n as f64;
    let mut breaks: Vec<f64> = (0..corner).map(|i| ramp(i, corner, -half, -inner)).collect();
    breaks.extend((0..count).map(|i| ramp(i, count, -inner, inner)));
    breaks.extend((0..=corner).map(|i| ramp(i, corner, inner, half)));
    between(&breaks)
}

/// The intervals between breaks.
pub(super) fn between(breaks: &[f64]) -> Vec<Span> {
    let (Some(&first), Some(&last)) = (breaks.first(), breaks.last()) else { return Vec::new() };
    let total = (last - first).max(1e-12);
    breaks
        .windows(2)
        .map(|pair| {
            let (low, high) = (pair[0], pair[1]);
            let (middle, width) = (f64::midpoint(low, high), high - low);
            let to_end = (middle - first).min(last - middle);
            let sigma = (width / CELL_PER_SIGMA).min(0.75 * to_end).max(width / 2.1);
            Span { low, high, middle, frac: (middle - first) / total, sigma_frac: sigma / width }
        })
        .collect()
}
