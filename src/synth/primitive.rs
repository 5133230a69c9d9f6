//! Primitives: the shapes that assets are made of.

use std::f64::consts::TAU;
use std::sync::Arc;

use glam::{DQuat, DVec2, DVec3};

use super::material::Material;
use super::placement::Placement;

/// A parametric surface over the unit square.
pub(super) type Surface = Arc<dyn Fn(f64, f64) -> DVec3 + Send + Sync>;

/// Geometry of a primitive in its own frame, m.
#[derive(Clone)]
pub(super) enum Shape {
    /// Box with rounded edges. Bit `2 * axis + (1 for the positive side)` of `faces` shows a face.
    Block { half: DVec3, round: f64, faces: u8 },
    /// Superellipsoid: power 2 is an ellipsoid, 4 a cushion.
    Superellipsoid { half: DVec3, power: f64 },
    /// Surface of revolution about y: a profile of (radius, height), from the bottom along the outside to the top.
    Lathe { profile: Vec<DVec2> },
    /// Tube along a polyline with a radius per point.
    Tube { points: Vec<DVec3>, radii: Vec<f64> },
    /// Parametric surface with its approximate size.
    Sheet { surface: Surface, size: DVec2 },
}

/// How a primitive takes part in the scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Visibility {
    /// Visible, casts shadows.
    Full,
    /// Visible, casts no shadow.
    NoShadow,
    /// Invisible, casts shadows.
    ShadowOnly,
}

/// A piece of an asset: shape, material, placement and resolution.
#[derive(Clone)]
pub(super) struct Primitive {
    /// Geometry.
    pub(super) shape: Shape,
    /// Material.
    pub(super) material: Material,
    /// Object from primitive.
    pub(super) object_from_primitive: Placement,
    /// Cell size relative to the scene's.
    pub(super) cell_scale: f64,
    /// Ratio of cell length to cell width, along the longest axis of a block.
    pub(super) cell_stretch: f64,
    /// Whether it is visible and casts shadows.
    pub(super) visibility: Visibility,
}

impl Primitive {
    /// Rotates it about an axis through its origin.
    pub(super) fn rotate(&mut self, axis: DVec3, angle_rad: f64) -> &mut Self {
        self.object_from_primitive.rotation =
            DQuat::from_axis_angle(axis, angle_rad) * self.object_from_primitive.rotation;
        self
    }

    /// Sets the cell size relative to the scene's.
    pub(super) fn cell_scale(&mut self, cell_scale: f64) -> &mut Self {
        self.cell_scale = cell_scale;
        self
    }

    /// Shows only some faces of a block.
    pub(super) fn only(&mut self, shown: u8) -> &mut Self {
        if let Shape::Block { faces, .. } = &mut self.shape {
            *faces = shown;
        }
        self
    }

    /// Casts no shadow.
    pub(super) fn no_shadow(&mut self) -> &mut Self {
        self.visibility = Visibility::NoShadow;
        self
    }

    /// Casts shadows but is invisible: one proxy for many primitives without shadows.
    pub(super) fn shadow_only(&mut self) -> &mut Self {
        self.visibility = Visibility::ShadowOnly;
        self
    }

    /// Sets the ratio of cell length to cell width, along the longest axis.
    pub(super) fn stretched(&mut self, stretch: f64) -> &mut Self {
        self.cell_stretch = stretch;
        self
    }

    /// Approximate half extents in the primitive's frame.
    pub(super) fn half_extents(&self) -> DVec3 {
        match &self.shape {
            Shape::Block { half, .. } | Shape::Superellipsoid { half, .. } => *half,
            Shape::Sheet { size, .. } => DVec3::new(size.x / 2.0, size.y / 2.0, 0.0),
            Shape::Lathe { .. } | Shape::Tube { .. } => DVec3::Y,
        }
    }

    /// Lowest and highest corner in an outer frame.
    pub(super) fn bounds(&self, outer_from_object: &Placement) -> (DVec3, DVec3) {
        let outer_from_primitive = outer_from_object.after(&self.object_from_primitive);
        let points: Vec<(DVec3, f64)> = match &self.shape {
            Shape::Block { half, .. } | Shape::Superellipsoid { half, .. } => corners(*half).map(|p| (p, 0.0)).to_vec(),
            Shape::Lathe { profile } => {
                let ring = |p: &DVec2, k: u8| {
                    let angle = TAU * f64::from(k) / 16.0;
                    (DVec3::new(p.x * angle.cos(), p.y, p.x * angle.sin()), 0.0)
                };
                profile.iter().flat_map(|p| (0..16).map(move |k| ring(p, k))).collect()
            }
            Shape::Tube { points, radii } => points.iter().copied().zip(radii.iter().copied()).collect(),
            Shape::Sheet { surface, .. } => {
                let at = |k: u32| surface(f64::from(k % 9) / 8.0, f64::from(k / 9) / 8.0);
                (0..81).map(|k| (at(k), 0.0)).collect()
            }
        };
        let start = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        points.iter().fold(start, |(low, high), (p, radius)| {
            let q = outer_from_primitive.apply(*p);
            (low.min(q - *radius), high.max(q + *radius))
        })
    }
}

fn corners(half: DVec3) -> [DVec3; 8] {
    std::array::from_fn(|i| half * DVec3::from_array(std::array::from_fn(|a| if i >> a & 1 == 1 { 1.0 } else { -1.0 })))
}
