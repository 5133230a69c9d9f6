use glam::{DVec2, DVec3};

/// Floor plan of a box: a turned rectangle over an interval of heights.
#[derive(Debug, Clone, Copy)]
pub(super) struct Footprint {
    /// Middle, (x, z).
    pub(super) center: DVec2,
    /// Half extents along its own axes.
    pub(super) half: DVec2,
    /// Turn about the upright axis.
    pub(super) yaw_rad: f64,
    /// Lowest height.
    pub(super) low: f64,
    /// Highest height.
    pub(super) high: f64,
}

impl Footprint {
    /// Own axes in the plan: x and z of the object.
    fn axes(&self) -> [DVec2; 2] {
        let (sin, cos) = self.yaw_rad.sin_cos();
        [DVec2::new(cos, -sin), DVec2::new(sin, cos)]
    }

    /// Half of its extent along a direction.
    fn reach(&self, axis: DVec2) -> f64 {
        let [x, z] = self.axes();
        self.half.x * x.dot(axis).abs() + self.half.y * z.dot(axis).abs()
    }

    /// Half extents of the upright rectangle around it.
    pub(super) fn extent(&self) -> DVec2 {
        DVec2::new(self.reach(DVec2::X), self.reach(DVec2::Y))
    }

    /// Whether the two come closer than `gap` (separating axes; corners may be a little nearer than they count).
    pub(super) fn meets(&self, other: &Self, gap: f64) -> bool {
        if self.low >= other.high - 1e-4 || other.low >= self.high - 1e-4 {
            return false;
        }
        let offset = other.center - self.center;
        let apart = |axis: &DVec2| offset.dot(*axis).abs() > self.reach(*axis) + other.reach(*axis) + gap;
        !self.axes().iter().chain(&other.axes()).any(apart)
    }

    /// A box with a corner low and one high in the frame of an object at `at` turned by `yaw_rad`.
    pub(super) fn of(low: DVec3, high: DVec3, at: DVec3, yaw_rad: f64) -> Self {
        let middle = (low + high) / 2.0;
        let half = DVec2::new(high.x - low.x, high.z - low.z) / 2.0;
        let blank = Self { center: DVec2::ZERO, half, yaw_rad, low: at.y + low.y, high: at.y + high.y };
        let [x, z] = blank.axes();
        Self { center: DVec2::new(at.x, at.z) + x * middle.x + z * middle.z, ..blank }
    }
}
