use glam::{DMat3, DQuat, DVec2, DVec3};

use super::intervals::ParamInterval;
use super::material::Material;
use super::noise;
use super::placement::Placement;
use super::surface_point::SurfacePoint;
use super::surfel::Surfel;
use super::texture;

/// Emits the surfels of one primitive.
pub(super) struct SurfelEmitter<'a> {
    /// World from primitive.
    pub(super) world_from_primitive: Placement,
    /// Material.
    pub(super) material: &'a Material,
    /// Longest axis of the primitive, 0..=2: the direction of wood grain.
    pub(super) grain: usize,
    /// Object id.
    pub(super) object: u16,
    /// Surfels emitted so far.
    pub(super) out: Vec<Surfel>,
}

/// A cell of a surface, in the primitive's frame, m.
pub(super) struct SurfaceCell {
    /// Middle.
    pub(super) middle: DVec3,
    /// Vector from side to side along the first surface direction.
    pub(super) across: DVec3,
    /// The same along the second surface direction.
    pub(super) along: DVec3,
    /// Standard deviations divided by the lengths of the two vectors.
    pub(super) sigma_frac: DVec2,
    /// Texture coordinates of the middle.
    pub(super) point: SurfacePoint,
}

impl SurfelEmitter<'_> {
    /// Emits one surfel that covers a cell; skips a cell without area.
    pub(super) fn emit(&mut self, cell: &SurfaceCell) {
        let (width, height) = (cell.across.length(), cell.along.length());
        let Some(normal) = cell.across.cross(cell.along).try_normalize() else { return };
        let second = normal.cross(cell.across / width);
        let frame = DQuat::from_mat3(&DMat3::from_cols(cell.across / width, second, normal));
        let sigma = DVec2::new(width, height) * cell.sigma_frac;
        let thickness = (0.1 * sigma.min_element()).clamp(3e-4, 2e-3);
        let rotation = (self.world_from_primitive.rotation * frame).normalize();
        let mean = self.world_from_primitive.apply(cell.middle).as_vec3();
        let bits = mean.to_array().map(f32::to_bits);
        let variation = 0.97 + 0.06 * noise::unit_hash(bits[0] as i32, bits[1] as i32, bits[2]) as f32;
        self.out.push(Surfel {
            mean,
            rotation: rotation.as_quat(),
            scale: DVec3::new(sigma.x.max(thickness), sigma.y.max(thickness), thickness).as_vec3(),
            normal: (self.world_from_primitive.rotation * normal).as_vec3(),
            albedo: texture::albedo(self.material, &cell.point, self.grain) * variation,
            emission: self.material.emission,
            opacity: self.material.opacity,
            gloss: self.material.gloss,
            two_sided: self.material.two_sided,
            object: self.object,
        });
    }

    /// Emits a surfel per cell of a parameter grid. The cross product of the two surface directions must point outward;
    /// `size` is the approximate extent of the surface, m.
    pub(super) fn emit_grid(&mut self, cells: [&[ParamInterval]; 2], size: DVec2, surface: impl Fn(f64, f64) -> DVec3) {
        for v in cells[1] {
            for u in cells[0] {
                let middle = surface(u.middle, v.middle);
                let frac = DVec2::new(u.frac, v.frac);
                self.emit(&SurfaceCell {
                    middle,
                    across: surface(u.high, v.middle) - surface(u.low, v.middle),
                    along: surface(u.middle, v.high) - surface(u.middle, v.low),
                    sigma_frac: DVec2::new(u.sigma_frac, v.sigma_frac),
                    point: SurfacePoint { along: frac * size, frac, local: middle },
                });
            }
        }
    }
}
