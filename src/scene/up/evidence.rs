//! Evidence that a direction is up.
//!
//! Enters: the sample and the facets of a scene. Leaves: numbers per direction, each near 0..=1 or -1..=1, that do not
//! depend on the axes of the world.

use glam::DVec3;

use super::facets::Facet;
use super::floor::{Floor, find_floor};
use super::legs::legs;
use super::sample::PatchSample;

/// Number of kinds of evidence.
pub(super) const NUM_EVIDENCE: usize = 21;

/// Maximum number of patches that are measured along a direction.
const MAX_PATCHES: usize = 6000;

/// Thickness of the contact patch, over the scene size.
pub(super) const CONTACT_FRAC: f64 = 0.02;

/// Shares of the patches below the robust bottom and above the robust top.
pub(super) const BOTTOM_FRAC: f64 = 0.01;

/// Cosine and sine of the angle within which a normal counts as level or upright: 10 degrees.
const LEVEL_COS: f64 = 0.985;
const UPRIGHT_SIN: f64 = 0.174;

/// Shares of random directions within those angles.
const LEVEL_CHANCE: f64 = 1.0 - LEVEL_COS;
const UPRIGHT_CHANCE: f64 = UPRIGHT_SIN;

/// Evidence for the unit direction `up`, and the floor perpendicular to it.
pub(super) fn evidence(sample: &PatchSample, facets: &[Facet], up: DVec3) -> ([f64; NUM_EVIDENCE], Floor) {
    let floor = find_floor(sample, facets, up);
    let column = Column::of(sample, up);
    let (level, upright) = normal_shares(facets, up);
    let e = floor.evidence;
    let low_mean = 0.5 - column.mean_frac();
    let light = column.light();
    let contact = column.contact();
    let flat = column.flatness();
    let taper = column.taper();
    let values = [
        e,
        floor.coverage,
        floor.levelness,
        e * (0.5 - floor.mean_height),
        low_mean,
        e * low_mean,
        contact.0,
        contact.1,
        contact.2,
        level,
        upright,
        light,
        e * light,
        outward_light(sample, up),
        flat,
        (flat - 0.3).abs(),
        column.sharpness(),
        taper,
        e * taper,
        column.skew(),
        legs(sample, up),
    ];
    (values, floor)
}

/// Heights and distances from the axis of the patches along a direction.
struct Column {
    /// Height, position in the plane (two coordinates) and luma, ordered by height.
    points: Vec<(f64, [f64; 2], f64)>,
    size: f64,
}

impl Column {
    fn of(sample: &PatchSample, up: DVec3) -> Self {
        let stride = sample.patches.len().div_ceil(MAX_PATCHES).max(1);
        let east = up.any_orthonormal_vector();
        let north = up.cross(east);
        let mut points: Vec<(f64, [f64; 2], f64)> = (sample.patches.iter().step_by(stride))
            .map(|p| (p.position.dot(up), [p.position.dot(east), p.position.dot(north)], p.luma))
            .collect();
        points.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        Self { points, size: sample.size }
    }

    fn height_at(&self, frac: f64) -> f64 {
        let last = self.points.len().saturating_sub(1);
        self.points.get((frac * last as f64) as usize).map_or(0.0, |point| point.0)
    }

    /// Bottom and top without outliers.
    fn ends(&self) -> (f64, f64) {
        (self.height_at(BOTTOM_FRAC), self.height_at(1.0 - BOTTOM_FRAC))
    }

    fn mean_frac(&self) -> f64 {
        let (low, high) = self.ends();
        let mean = self.points.iter().map(|p| p.0).sum::<f64>() / self.points.len().max(1) as f64;
        if high > low { (mean - low) / (high - low) } else { 0.5 }
    }

    /// Area and stability of the contact with the ground, and the area relative to that of the top.
    fn contact(&self) -> (f64, f64, f64) {
        let (low, high) = self.ends();
        let reach = CONTACT_FRAC * self.size;
        let whole = spread(self.points.iter().map(|p| p.1));
        let base = spread(self.points.iter().filter(|p| p.0 <= low + reach).map(|p| p.1));
        let roof = spread(self.points.iter().filter(|p| p.0 >= high - reach).map(|p| p.1));
        let area = |s: &Spread| (s.area / whole.area.max(1e-12 * self.size * self.size)).min(2.0);
        let (dx, dy) = (base.middle[0] - whole.middle[0], base.middle[1] - whole.middle[1]);
        let off = (dx * dx + dy * dy) / base.square.max(1e-6 * self.size * self.size);
        (area(&base), 1.0 / (1.0 + 2.0 * off), area(&base) - area(&roof))
    }

    /// Correlation of luma with height.
    fn light(&self) -> f64 {
        correlation(self.points.iter().map(|p| (p.0, p.2)))
    }

    /// Logarithm of height over width, in decades.
    fn flatness(&self) -> f64 {
        let (low, high) = self.ends();
        let whole = spread(self.points.iter().map(|p| p.1));
        ((high - low).max(1e-3 * self.size) / (3.0 * whole.area.sqrt()).max(1e-3 * self.size)).log10().clamp(-1.0, 1.0)
    }

    /// How much more abruptly matter ends below than above, -1..=1.
    fn sharpness(&self) -> f64 {
        let (low, high) = (self.height_at(0.08) - self.height_at(0.005), self.height_at(0.995) - self.height_at(0.92));
        if low + high > 0.0 { (high - low) / (high + low) } else { 0.0 }
    }

    /// How much wider the lower third is than the upper one, -1..=1.
    fn taper(&self) -> f64 {
        let (low, high) = self.ends();
        let third = (high - low) / 3.0;
        let lower = spread(self.points.iter().filter(|p| p.0 < low + third).map(|p| p.1)).square.sqrt();
        let upper = spread(self.points.iter().filter(|p| p.0 > high - third).map(|p| p.1)).square.sqrt();
        if lower + upper > 0.0 { (lower - upper) / (lower + upper) } else { 0.0 }
    }

    /// Skewness of the heights, positive where the tail points up, -1..=1.
    fn skew(&self) -> f64 {
        let n = self.points.len().max(1) as f64;
        let mean = self.points.iter().map(|p| p.0).sum::<f64>() / n;
        let moment = |power: i32| self.points.iter().map(|p| (p.0 - mean).powi(power)).sum::<f64>() / n;
        let deviation = moment(2).sqrt();
        if deviation > 0.0 { (moment(3) / deviation.powi(3)).tanh() } else { 0.0 }
    }
}

/// Mean, mean square distance from it, and area (the root of the determinant of the covariance) of points in a plane.
pub(super) struct Spread {
    pub(super) middle: [f64; 2],
    pub(super) square: f64,
    pub(super) area: f64,
}

pub(super) fn spread(points: impl Iterator<Item = [f64; 2]>) -> Spread {
    let (mut n, mut sum, mut xx, mut yy, mut xy) = (0.0, [0.0; 2], 0.0, 0.0, 0.0);
    for [x, y] in points {
        n += 1.0;
        sum = [sum[0] + x, sum[1] + y];
        (xx, yy, xy) = (xx + x * x, yy + y * y, xy + x * y);
    }
    let n = f64::max(n, 1.0);
    let [mx, my] = [sum[0] / n, sum[1] / n];
    let (xx, yy, xy) = (xx / n - mx * mx, yy / n - my * my, xy / n - mx * my);
    Spread { middle: [mx, my], square: xx + yy, area: (xx * yy - xy * xy).max(0.0).sqrt() }
}

fn correlation(pairs: impl Iterator<Item = (f64, f64)>) -> f64 {
    let (mut n, mut a, mut b, mut aa, mut bb, mut ab) = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    for (x, y) in pairs {
        n += 1.0;
        (a, b, aa, bb, ab) = (a + x, b + y, aa + x * x, bb + y * y, ab + x * y);
    }
    let n = f64::max(n, 1.0);
    let (va, vb) = (aa / n - a / n * (a / n), bb / n - b / n * (b / n));
    if va * vb > 0.0 { (ab / n - a / n * (b / n)) / (va * vb).sqrt() } else { 0.0 }
}

/// Shares of the facets that are level and upright, beyond chance, 0..=1.
fn normal_shares(facets: &[Facet], up: DVec3) -> (f64, f64) {
    let (mut all, mut level, mut upright) = (0.0, 0.0, 0.0);
    for facet in facets.iter().filter(|facet| facet.normal != DVec3::ZERO) {
        let rise = facet.normal.dot(up).abs();
        all += 1.0;
        level += f64::from(u8::from(rise > LEVEL_COS));
        upright += f64::from(u8::from(rise < UPRIGHT_SIN));
    }
    if all < 20.0 {
        return (0.0, 0.0);
    }
    let beyond = |share: f64, chance: f64| (share - chance) / (1.0 - chance);
    (beyond(level / all, LEVEL_CHANCE), beyond(upright / all, UPRIGHT_CHANCE))
}

/// Correlation of luma with how much a flat patch of a convex scene faces up. Light comes from above.
fn outward_light(sample: &PatchSample, up: DVec3) -> f64 {
    let stride = sample.patches.len().div_ceil(MAX_PATCHES).max(1);
    let flat = sample.patches.iter().step_by(stride).filter(|patch| patch.normal != DVec3::ZERO);
    correlation(flat.map(|p| (p.normal.dot(up) * p.normal.dot(p.position).signum(), p.luma)))
}
