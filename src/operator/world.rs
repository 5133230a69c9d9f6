//! A scene as the operator sees it: subjects to frame, matter to avoid and to look past, space to stand in.

use std::collections::BTreeMap;

use glam::DVec3;

use super::clearance::{ClearanceIndex, SIGMA_LEVEL};
use super::grid::{Grid, OpacityGrid};
use super::support::Support;
use cinesplat_geometry::{GeometryError, LevelFrame};
use cinesplat_objects::{Object, ObjectSet};
use cinesplat_scene::{Bounds, Gaussians, SOLID_OPACITY};

/// Least distance from the lens to solid matter, over the scene size, unless asked for otherwise.
pub const DEFAULT_CAMERA_RADIUS_FRAC: f64 = 0.012;
/// The camera's radius in a scene without extent, scene units.
const SMALLEST_CAMERA_RADIUS: f64 = 1e-6;
/// Points that stand for a subject when it is framed and looked for.
const SUBJECT_POINTS: usize = 48;

/// A scene prepared for planning shots.
pub struct World {
    /// The world's up with a reference heading.
    pub frame: LevelFrame,
    /// Extents of the scene.
    pub bounds: Bounds,
    /// Least distance from the lens to solid matter, scene units.
    pub camera_radius: f64,
    subjects: BTreeMap<u32, Subject>,
    matter: OpacityGrid,
    clearance: ClearanceIndex,
    support: Support,
}

/// Something a shot can be about.
pub struct Subject {
    /// Object id; 0 for the scene as a whole.
    pub id: u32,
    /// Name for reports.
    pub label: String,
    /// Box center, world.
    pub center: DVec3,
    /// Box corners, world.
    pub corners: Vec<DVec3>,
    /// Half the box's diagonal.
    pub radius: f64,
    /// Points on it, world.
    pub points: Vec<DVec3>,
    /// Everything but this subject, for looking at it.
    others: OpacityGrid,
}

impl World {
    /// Prepares a scene and those of its objects that `ids` names; `up` is the world's up.
    ///
    /// # Errors
    /// [`GeometryError::NoUpDirection`] when `up` has no length.
    pub fn new(gaussians: &Gaussians, up: DVec3, objects: &ObjectSet, ids: &[u32]) -> Result<Self, GeometryError> {
        let frame = LevelFrame::new(up)?;
        let bounds = Bounds::of(gaussians);
        let matter = OpacityGrid::of(Grid::around(&bounds, frame.up), gaussians, |_| true);
        let clearance = ClearanceIndex::new(gaussians, SOLID_OPACITY, SIGMA_LEVEL);
        let support = Support::of(&matter, &clearance, &bounds, &frame, &objects.objects);
        let subjects = objects
            .objects
            .iter()
            .filter(|object| ids.contains(&object.id))
            .map(|object| (object.id, Subject::of(gaussians, object, &objects.labels, &matter.grid)))
            .collect();
        let camera_radius = default_camera_radius(&bounds);
        Ok(Self { frame, bounds, camera_radius, subjects, matter, clearance, support })
    }

    /// A subject by object id.
    pub fn subject(&self, id: u32) -> Option<&Subject> {
        self.subjects.get(&id)
    }

    /// Distance from a point to the nearest matter, scene units; that to the far end of the scene where there is less.
    pub fn clearance(&self, point: DVec3) -> f64 {
        let far = 2.0 * self.bounds.size() + self.camera_radius;
        self.clearance.nearest_within(point, far).map_or(far, |nearest| nearest.distance)
    }

    /// The matter of the scene as ellipsoids.
    pub fn ellipsoids(&self) -> &ClearanceIndex {
        &self.clearance
    }

    /// Whether the capture shows its good side from a point.
    pub fn supports(&self, point: DVec3) -> bool {
        self.support.holds(&self.matter, point)
    }

    /// Height along up of the lowest matter, but for the lowest 2 %: the floor of a room, the foot of a thing.
    pub fn floor_height(&self) -> f64 {
        self.frame.height(self.bounds.core_min).min(self.frame.height(self.bounds.core_max))
    }

    /// How far a point is below the height of a camera lying on the floor, over the scene size; 0 above.
    pub fn sunk_frac(&self, point: DVec3) -> f64 {
        (self.floor_height() + self.camera_radius - self.frame.height(point)).max(0.0) / self.bounds.size()
    }

    /// How far a point lies outside the box of the middle 96 % of the solid Gaussians, over the scene size; 0 inside.
    pub fn outside_frac(&self, point: DVec3) -> f64 {
        let inside = point.clamp(self.bounds.core_min, self.bounds.core_max);
        inside.distance(point) / self.bounds.size()
    }

    /// Whether what is seen from a point is seen from the side that the capture shows.
    pub fn is_good_side(&self, point: DVec3) -> bool {
        self.support.is_good_side(&self.matter, point)
    }

    /// Free places with a good view of the scene, the best first.
    pub fn hubs(&self) -> &[DVec3] {
        &self.support.hubs
    }

    /// Whether the scene surrounds the camera (a room) rather than being looked at from outside (a thing).
    pub fn is_indoor(&self) -> bool {
        self.support.indoor
    }

    /// Distance to what a ray meets, if it meets anything.
    pub fn hit_distance(&self, eye: DVec3, direction: DVec3) -> Option<f64> {
        self.matter.hit_distance(eye, direction, 1.6 * self.bounds.size())
    }
}

/// The camera's radius unless asked for otherwise; never 0.
pub fn default_camera_radius(bounds: &Bounds) -> f64 {
    let radius = DEFAULT_CAMERA_RADIUS_FRAC * bounds.size();
    if radius > 0.0 { radius } else { SMALLEST_CAMERA_RADIUS }
}

impl Subject {
    fn of(gaussians: &Gaussians, object: &Object, labels: &[u16], grid: &Grid) -> Self {
        let labelled = labels.iter().any(|&label| u32::from(label) == object.id);
        let belongs = |i: usize| {
            if labelled { u32::from(labels[i]) == object.id } else { object.contains(gaussians.mean_world(i), 0.0) }
        };
        let own: Vec<bool> = (0..gaussians.len()).map(belongs).collect();
        let solid: Vec<usize> =
            (0..gaussians.len()).filter(|&i| own[i] && gaussians.opacities[i] >= SOLID_OPACITY).collect();
        let corners = object.corners().to_vec();
        let stride = (solid.len() / SUBJECT_POINTS).max(1);
        let points = if solid.len() >= 20 {
            solid.iter().step_by(stride).map(|&i| gaussians.mean_world(i)).collect()
        } else {
            corners.clone()
        };
        let others = OpacityGrid::of(grid.clone(), gaussians, |i| !own[i]);
        let label = if object.label.is_empty() { format!("<obj-{}>", object.id) } else { object.label.clone() };
        Self { id: object.id, label, center: object.center, corners, radius: object.radius(), points, others }
    }

    /// Share of light that reaches `eye` from a point of the subject, past everything but the subject.
    pub fn transmittance(&self, eye: DVec3, point: DVec3) -> f64 {
        self.others.transmittance(eye, point)
    }
}
