//! Grids of light, by position and by the coordinate axis nearest to the surface normal.
//!
//! Enters: outgoing radiance or gathered irradiance of surfels. Leaves: area-weighted means around a point.

use glam::Vec3;

use super::bake_quality::BakeQuality;
use super::surfel::Surfel;

/// Edge of the radiance grid's cells at film quality, m.
const GRID_CELL: f32 = 0.14;

/// Edge of the cells over which bounced light is averaged, at film quality, m.
const SMOOTH_CELL: f32 = 0.27;

/// Minimum number of gathered rays for a reliable openness of a single surfel.
const OWN_OPENNESS_RAYS: u32 = 10;

/// Bounced light on a surfel.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct GatheredLight {
    /// Irradiance.
    pub(super) irradiance: Vec3,
    /// Mean openness of the hemisphere, 0..=1.
    pub(super) openness: f32,
}

/// Area-weighted mean radiance per cell and per direction: six directions, the signed axes nearest to the normal.
pub(super) struct RadianceGrid {
    cell: f32,
    low: Vec3,
    size: [usize; 3],
    cells: Vec<(Vec3, f32)>,
}

impl RadianceGrid {
    /// An empty grid around the surfels.
    pub(super) fn direct(surfels: &[Surfel], quality: BakeQuality) -> Self {
        Self::around(surfels, quality.grid_scale * GRID_CELL)
    }

    fn around(surfels: &[Surfel], cell: f32) -> Self {
        let inner = || surfels.iter().map(|s| s.mean.clamp(Vec3::splat(-12.0), Vec3::splat(12.0)));
        let low = inner().reduce(Vec3::min).unwrap_or(Vec3::ZERO);
        let high = inner().reduce(Vec3::max).unwrap_or(Vec3::ZERO);
        let size = ((high - low) / cell).to_array().map(|extent| extent as usize + 1);
        Self { cell, low, size, cells: vec![(Vec3::ZERO, 0.0); size.iter().product::<usize>() * 6] }
    }

    fn index(&self, at: Vec3, normal: Vec3) -> usize {
        let cell = ((at - self.low) / self.cell).to_array();
        let [x, y, z] = std::array::from_fn(|i| (cell[i].max(0.0) as usize).min(self.size[i] - 1));
        let axis = normal.abs().max_position();
        let side = 2 * axis + usize::from(normal[axis] > 0.0);
        ((z * self.size[1] + y) * self.size[0] + x) * 6 + side
    }

    /// Adds the radiance of a surfel, weighted by its area.
    pub(super) fn add(&mut self, surfel: &Surfel, radiance: Vec3) {
        let area = surfel.scale.x * surfel.scale.y;
        let index = self.index(surfel.mean, surfel.normal);
        self.cells[index].0 += radiance * area;
        self.cells[index].1 += area;
    }

    /// Mean radiance at a hit. Proxies lie up to several centimeters off the surface, so an empty cell falls back to its
    /// neighbors along the normal.
    pub(super) fn radiance(&self, at: Vec3, normal: Vec3) -> Vec3 {
        let (mut sum, mut weight) = (Vec3::ZERO, 0.0);
        for shift in [0.0, -0.6, 0.6] {
            let (radiance, area) = self.cells[self.index(at + normal * (shift * self.cell), normal)];
            sum += radiance;
            weight += area;
            if weight > 0.0 {
                return sum / weight;
            }
        }
        Vec3::ZERO
    }
}

/// Bounced light averaged over cells and interpolated between them, which removes the noise of single surfels. The surfel's
/// own openness restores contact shadows, which are finer than a cell.
pub(super) struct SmoothGrid {
    grid: RadianceGrid,
    openness: Vec<f32>,
    /// Whether the openness of single surfels is reliable.
    use_own_openness: bool,
}

impl SmoothGrid {
    /// Averages the gathered light of the surfels.
    pub(super) fn of(surfels: &[Surfel], gathered: &[GatheredLight], quality: BakeQuality) -> Self {
        let use_own_openness = quality.gather_rays >= OWN_OPENNESS_RAYS;
        let mut grid = RadianceGrid::around(surfels, quality.grid_scale * SMOOTH_CELL);
        let mut openness = vec![0.0; grid.cells.len()];
        for (surfel, lit) in surfels.iter().zip(gathered) {
            let area = surfel.scale.x * surfel.scale.y;
            openness[grid.index(surfel.mean, surfel.normal)] += lit.openness * area;
            grid.add(surfel, lit.irradiance);
        }
        Self { grid, openness, use_own_openness }
    }

    /// Trilinear mean of the non-empty cells among the eight around a surfel, scaled by the surfel's relative openness.
    pub(super) fn irradiance(&self, surfel: &Surfel, own: &GatheredLight) -> Vec3 {
        let at = (surfel.mean - self.grid.low) / self.grid.cell - 0.5;
        let frac = at - at.floor();
        let (mut sum, mut open, mut weight) = (Vec3::ZERO, 0.0, 0.0);
        for corner in 0..8_u32 {
            let bit = Vec3::new((corner & 1) as f32, (corner >> 1 & 1) as f32, (corner >> 2) as f32);
            let share = (Vec3::ONE - bit + (2.0 * bit - 1.0) * frac).element_product();
            let index = self.grid.index(surfel.mean + (bit - frac) * self.grid.cell, surfel.normal);
            let (radiance, area) = self.grid.cells[index];
            sum += radiance * share;
            open += self.openness[index] * share;
            weight += area * share;
        }
        if weight <= 0.0 || open <= 0.0 {
            return own.irradiance;
        }
        let relative = if self.use_own_openness { (own.openness * weight / open).min(1.6) } else { 1.0 };
        sum / weight * relative
    }
}
