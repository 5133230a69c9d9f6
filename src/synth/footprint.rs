use glam::{DVec2, DVec3};

/// Footprint of an object: a rotated rectangle in the floor plan over an interval of heights, m.
#[derive(Debug, Clone, Copy)]
pub(super) struct Footprint {
    /// Center, (x, z).
    pub(super) center: DVec2,
    /// Half extents along the object's x and z axes.
    pub(super) half: DVec2,
    /// Rotation about the up axis.
    pub(super) yaw_rad: f64,
    /// Lowest height.
    pub(super) low: f64,
    /// Highest height.
    pub(super) high: f64,
}

impl Footprint {
    /// The object's x and z axes in the floor plan.
    fn axes(&self) -> [DVec2; 2] {
        let (sin, cos) = self.yaw_rad.sin_cos();
        [DVec2::new(cos, -sin), DVec2::new(sin, cos)]
    }

    /// Half of the extent along a unit direction.
    fn half_extent_along(&self, axis: DVec2) -> f64 {
        let [x, z] = self.axes();
        self.half.x * x.dot(axis).abs() + self.half.y * z.dot(axis).abs()
    }

    /// Half extents of its axis-aligned bounding rectangle, (x, z).
    pub(super) fn half_extents(&self) -> DVec2 {
        DVec2::new(self.half_extent_along(DVec2::X), self.half_extent_along(DVec2::Y))
    }

    /// Whether the two are closer than `gap`, by the separating-axis test. Between two corners the test underestimates
    /// the distance slightly.
    pub(super) fn overlaps(&self, other: &Self, gap: f64) -> bool {
        if self.low >= other.high - 1e-4 || other.low >= self.high - 1e-4 {
            return false;
        }
        let offset = other.center - self.center;
        let apart = |axis: &DVec2| {
            offset.dot(*axis).abs() > self.half_extent_along(*axis) + other.half_extent_along(*axis) + gap
        };
        !self.axes().iter().chain(&other.axes()).any(apart)
    }

    /// Footprint of the box `low..high` in the frame of an object at `at` with a yaw of `yaw_rad`.
    pub(super) fn of_box([low, high]: [DVec3; 2], at: DVec3, yaw_rad: f64) -> Self {
        let middle = (low + high) / 2.0;
        let half = DVec2::new(high.x - low.x, high.z - low.z) / 2.0;
        let blank = Self { center: DVec2::ZERO, half, yaw_rad, low: at.y + low.y, high: at.y + high.y };
        let [x, z] = blank.axes();
        Self { center: DVec2::new(at.x, at.z) + x * middle.x + z * middle.z, ..blank }
    }
}
