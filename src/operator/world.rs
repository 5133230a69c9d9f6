//! A scene prepared for planning: subjects to frame, matter to avoid, occlusion, and the region that the capture
//! covers.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use glam::DVec3;

use super::capture_region::CaptureRegion;
use super::clearance::ClearanceIndex;
use super::facets::Facets;
use super::grid::Grid;
use super::lookout::{Lookout, Thing};
use super::opacity_grid::OpacityGrid;
use super::outline::{outline, splat_size};
use cinesplat_geometry::{GeometryError, LevelFrame};
use cinesplat_objects::{Object, ObjectSet};
use cinesplat_scene::{Bounds, Gaussians, SOLID_OPACITY};

/// Height of a standing person's eyes above the floor, over the scene size: 1.5 m in a room of 5 by 5 by 2.6 m.
const EYE_FRAC: f64 = 0.2;
/// The same over the height of a room, 1.55 m of 2.6 m, and the heights of rooms over the scene size that it holds for.
const EYE_OF_ROOM_FRAC: f64 = 0.6;
const ROOM_HEIGHT_FRACS: std::ops::Range<f64> = 0.25..0.6;
/// Default width over height of the frame.
const DEFAULT_ASPECT: f64 = 16.0 / 9.0;
/// Default of the camera's radius, over the scene size.
const DEFAULT_CAMERA_RADIUS_FRAC: f64 = 0.012;
/// The camera's radius in a scene without extent, scene units.
const MIN_CAMERA_RADIUS: f64 = 1e-6;
/// Distance from a box up to which matter does not hide the object, over the object's radius: boxes are drawn to the surface,
/// and splats lie on both sides of it.
const SKIN_FRAC: f64 = 0.05;
/// Share of a scene's solid Gaussians from which on a subject is all that there is: what little else there is does not count
/// as hiding it.
const ALONE_FRAC: f64 = 0.85;
/// Sample points per subject, for framing and visibility.
const SUBJECT_POINTS: usize = 48;

/// A scene prepared for planning shots.
pub struct World {
    /// The world's up with a reference heading.
    pub frame: LevelFrame,
    /// Extents of the scene, world.
    pub bounds: Bounds,
    /// Width over height of the film's frame: every view is planned, and every report measured, for it. Above 0; 16:9
    /// unless set.
    pub aspect: f64,
    /// The least distance that the path keeps from matter, scene units: the radius of the camera's ball, and how far
    /// effects take the camera from its path ([`World::add_reach`]). Above 0.
    pub camera_radius: f64,
    /// Radius of the camera's ball, and how far effects take it from the path, scene units.
    pub(super) ball: [f64; 2],
    subjects: BTreeMap<u32, Subject>,
    /// Azimuth of the front of the scene, seen from its middle, where it shows one thing that has a front.
    pub(super) front_rad: Option<f64>,
    matter: OpacityGrid,
    clearance: ClearanceIndex,
    region: CaptureRegion,
    /// Height along up of the floor, or of the bottom of the scene's core box.
    floor_height: f64,
    /// Height along up of the bottom of the scene's core box.
    bottom: f64,
    /// All objects of the scene.
    pub(super) things: Vec<Thing>,
    /// Places where people stand in a room, with what they look at. [`lookouts`](super::lookouts::lookouts) finds them
    /// where a program first needs them.
    pub(super) lookouts: OnceLock<Vec<Lookout>>,
    /// Free places at eye height in a room; [`standing_places`](super::lookouts::standing_places) finds them.
    pub(super) standing_places: OnceLock<Vec<DVec3>>,
}

/// Height of the top of what bears things, over that of a standing person's eyes, from which on it is a bookcase.
const TALL_BEARER: f64 = 0.85;

/// An object that a shot can frame.
pub(super) struct Subject {
    /// Name for reports.
    pub(super) label: String,
    /// Center of its box, world.
    pub(super) center: DVec3,
    /// Corners of its box, world.
    pub(super) corners: Vec<DVec3>,
    /// Half extents along the box's axes, world.
    pub(super) half_axes: [DVec3; 3],
    /// Half the diagonal of its box.
    pub(super) radius: f64,
    /// Sample points on it, world.
    pub(super) points: Vec<DVec3>,
    /// Middle of its matter.
    pub(super) body: DVec3,
    /// Size of its splats, as far as they are seen.
    pub(super) splat_size: f64,
    /// Its outermost points, world.
    pub(super) outline: Vec<DVec3>,
    /// Its surface as far as it was captured.
    pub(super) facets: Facets,
    /// Azimuth of its front, seen from its middle, where that is known.
    pub(super) front_rad: Option<f64>,
    /// Azimuth to which it faces people in a room, seen from its middle: a seat away from its back, a screen to who sits there.
    pub(super) facing_rad: Option<f64>,
    /// Heights along up of the surface on which other things stand and of the highest of them; `None` where nothing
    /// stands on it.
    pub(super) borne_heights: Option<[f64; 2]>,
    /// Id of the thing on which it stands.
    pub(super) bearer: Option<u32>,
    /// Azimuth of its free side, seen from its middle, where it stands at a wall. [`wall_side`](super::wall_side::wall_side)
    /// finds it where it is first needed.
    pub(super) wall_side_rad: OnceLock<Option<f64>>,
    /// Azimuth from which it is seen square to the wall behind it. [`wall_behind`](super::wall_side::wall_behind) finds it where
    /// it is first needed.
    pub(super) wall_behind_rad: OnceLock<Option<f64>>,
    /// Share of its points that the best place of a standing person sees.
    /// [`least_visible`](super::attainable::least_visible) finds it where it is first needed.
    pub(super) best_seen_frac: OnceLock<f64>,
    /// All Gaussians except its own: what can occlude it.
    others: OpacityGrid,
}

impl World {
    /// Prepares a scene and its objects whose ids are in `ids`. `up` is the world's up, of any length above 0.
    ///
    /// # Errors
    /// [`GeometryError::NoUpDirection`] where `up` has no length.
    pub fn new(gaussians: &Gaussians, up: DVec3, objects: &ObjectSet, ids: &[u32]) -> Result<Self, GeometryError> {
        let frame = LevelFrame::new(up)?;
        let bounds = Bounds::of(gaussians);
        let matter = OpacityGrid::of(Grid::around(&bounds, frame.up), gaussians, |_| true);
        let clearance = ClearanceIndex::new(gaussians);
        let surface = surface_points(gaussians, &bounds);
        let region = CaptureRegion::of(&matter, &clearance, &bounds, &frame, &objects.objects, &surface);
        let subjects = objects
            .objects
            .iter()
            .filter(|object| ids.contains(&object.id))
            .map(|object| {
                let borne_heights = objects.borne_heights(object.id, frame.up);
                let bearer = objects.bearer_of(object.id, frame.up);
                let subject = Subject::of(gaussians, object, &objects.labels_of(object.id), &matter.grid);
                (object.id, Subject { borne_heights, bearer, ..subject })
            })
            .collect();
        let camera_radius = default_camera_radius(&bounds);
        let things =
            objects.objects.iter().map(|object| Thing { center: object.center, radius: object.radius() }).collect();
        let bottom = frame.height(bounds.core_min).min(frame.height(bounds.core_max));
        let floor = if region.indoor { region.floor_height(&matter) } else { None };
        let floor_height = floor.map_or(bottom, |floor| floor.max(bottom));
        let mut world = Self {
            frame,
            bounds,
            floor_height,
            bottom,
            aspect: DEFAULT_ASPECT,
            camera_radius,
            ball: [camera_radius, 0.0],
            subjects,
            front_rad: None,
            matter,
            clearance,
            region,
            things,
            lookouts: OnceLock::new(),
            standing_places: OnceLock::new(),
        };
        world.leave_shelves();
        Ok(world)
    }

    /// Takes tall things for none that bear others: a bookcase is looked at, and not down on as a table is.
    fn leave_shelves(&mut self) {
        let tallest = TALL_BEARER * self.eye_height() + self.floor_height;
        for subject in self.subjects.values_mut() {
            let top = self.frame.height(subject.center) + subject.reach(self.frame.up);
            subject.borne_heights = subject.borne_heights.filter(|_| top < tallest);
        }
    }

    /// The subject with an object id.
    pub(super) fn subject(&self, id: u32) -> Option<&Subject> {
        self.subjects.get(&id)
    }

    /// Makes room for effects that take the camera from its path, such as a shaking hand, by up to `reach`, scene units.
    pub fn add_reach(&mut self, reach: f64) {
        let [radius, before] = self.ball;
        self.ball = [radius, before + reach];
        self.camera_radius = radius + self.ball[1];
    }

    /// All subjects, in order of id.
    pub(super) fn subjects(&self) -> impl Iterator<Item = &Subject> {
        self.subjects.values()
    }

    /// Says which way the front of a subject faces, by a direction from its middle.
    pub fn set_front(&mut self, id: u32, direction: DVec3) {
        let azimuth = self.frame.azimuth(direction);
        if let Some(subject) = self.subjects.get_mut(&id) {
            subject.front_rad = Some(azimuth);
        }
    }

    /// Says which way a subject in a room faces people, by a direction from its middle: a guess that views prefer.
    pub fn set_facing(&mut self, id: u32, direction: DVec3) {
        let azimuth = self.frame.azimuth(direction);
        if let Some(subject) = self.subjects.get_mut(&id) {
            subject.facing_rad = Some(azimuth);
        }
    }

    /// Azimuth to which the subject with this middle faces people, where that is known.
    pub(super) fn facing(&self, center: DVec3) -> Option<f64> {
        self.subject_at(center)?.facing_rad
    }

    /// Says which way the front of the only thing of a scan faces, by a direction from its middle: it is the front of the
    /// scene and of the thing and its parts, by their `ids`.
    pub fn set_front_of_whole(&mut self, ids: &[u32], direction: DVec3) {
        self.front_rad = Some(self.frame.azimuth(direction));
        ids.iter().for_each(|id| self.set_front(*id, direction));
    }

    /// The subject with this middle.
    pub(super) fn subject_at(&self, center: DVec3) -> Option<&Subject> {
        let tolerance = 1e-6 * self.bounds.size();
        self.subjects.values().find(|subject| subject.center.distance(center) <= tolerance)
    }

    /// Azimuth of the front of the subject with this middle, or of the scene as a whole, where it is known.
    pub(super) fn known_front(&self, center: DVec3) -> Option<f64> {
        self.subject_at(center).map_or(self.front_rad, |subject| subject.front_rad)
    }

    /// Distance from a world point to the nearest matter, scene units; 0 inside. At most a little more than twice the
    /// scene size.
    pub fn clearance(&self, point: DVec3) -> f64 {
        let far = 2.0 * self.bounds.size() + self.camera_radius;
        self.clearance.nearest_within(point, far).map_or(far, |nearest| nearest.distance)
    }

    /// The scene's matter as ellipsoids.
    pub(super) fn ellipsoids(&self) -> &ClearanceIndex {
        &self.clearance
    }

    /// Whether a world point lies in the region from which the scene was captured, as estimated from the matter.
    pub fn in_capture_region(&self, point: DVec3) -> bool {
        self.region.contains(&self.matter, point)
    }

    /// Share of the scene's surfaces that a world point sees, over what the best place sees, 0..=1.
    pub(super) fn seen_of_best_frac(&self, point: DVec3) -> f64 {
        self.region.seen_of_best_frac(&self.matter, point)
    }

    /// Whether a camera at a world point sees surfaces from the side that was captured.
    pub fn sees_front_faces(&self, point: DVec3) -> bool {
        self.region.sees_front_faces(&self.matter, point)
    }

    /// Height along up of the floor of a room, or of the foot of an object: the bottom of the scene's core box.
    pub(super) fn floor_height(&self) -> f64 {
        self.floor_height
    }

    /// Height of a standing person's eyes above the floor. A scene with ground outside reaches farther down, and is larger for
    /// it.
    pub(super) fn eye_height(&self) -> f64 {
        let size = self.bounds.size();
        let heights = [self.bounds.core_min, self.bounds.core_max].map(|corner| self.height_above_floor(corner));
        let height = heights[0].max(heights[1]);
        if self.is_indoor() && ROOM_HEIGHT_FRACS.contains(&(height / size)) {
            return EYE_OF_ROOM_FRAC * height;
        }
        let eye = EYE_FRAC * size;
        (eye - (self.floor_height - self.bottom)).max(0.5 * eye)
    }

    /// Height of a point above the floor of a room, or above the bottom of the core box of an object.
    pub(super) fn height_above_floor(&self, point: DVec3) -> f64 {
        self.frame.height(point) - self.floor_height()
    }

    /// Height of the upper end of a subject's box above the floor.
    pub(super) fn top_above_floor(&self, subject: &Subject) -> f64 {
        self.height_above_floor(subject.center) + subject.reach(self.frame.up)
    }

    /// How far a point is below the height of a camera that lies on the floor, over the scene size; 0 above that
    /// height.
    pub(super) fn sunk_frac(&self, point: DVec3) -> f64 {
        (self.floor_height() + self.camera_radius - self.frame.height(point)).max(0.0) / self.bounds.size()
    }

    /// The way to a point from the nearest one of the scene's core box (of the middle 96 % of the solid Gaussians).
    fn away_from_core(&self, point: DVec3) -> DVec3 {
        point - point.clamp(self.bounds.core_min, self.bounds.core_max)
    }

    /// Level and upright distance from a point to the scene's core box over the scene size; 0 inside.
    pub(super) fn outside_fracs(&self, point: DVec3) -> [f64; 2] {
        let away = self.away_from_core(point);
        [self.frame.horizontal(away).length(), self.frame.height(away).abs()].map(|part| part / self.bounds.size())
    }

    /// Distance from a point to the scene's core box over the scene size; 0 inside.
    pub(super) fn outside_frac(&self, point: DVec3) -> f64 {
        self.away_from_core(point).length() / self.bounds.size()
    }

    /// How far a point lies outside the scene's core box along both horizontal axes at once: the smaller distance over
    /// the scene size. A room is often captured through an open side. The camera may stand in front of that side, but
    /// beyond the planes of the walls next to it, it would see their back faces.
    pub(super) fn beyond_corner_frac(&self, point: DVec3) -> f64 {
        let bounds = &self.bounds;
        let outside = (bounds.core_min - point).max(point - bounds.core_max).max(DVec3::ZERO);
        let mut level = outside;
        // The vertical axis does not count.
        level[self.frame.up.abs().max_position()] = f64::INFINITY;
        level.min_element() / bounds.size()
    }

    /// Free places with a wide view of the scene, the best one first; world.
    pub(super) fn viewpoints(&self) -> &[DVec3] {
        &self.region.viewpoints
    }

    /// Whether the scene surrounds the camera (a room); otherwise the camera looks at it from outside (an object).
    pub fn is_indoor(&self) -> bool {
        self.region.indoor
    }

    /// Distance to the first surface that a ray of unit `direction` meets; `None` where it meets none.
    pub(super) fn hit_distance(&self, eye: DVec3, direction: DVec3) -> Option<f64> {
        self.matter.hit_distance(eye, direction, 1.6 * self.bounds.size())
    }
}

/// Number of points on the surfaces of a scene whose visibility is tested.
const NUM_SURFACE_POINTS: usize = 500;

/// Means of solid Gaussians in the core of a scene.
fn surface_points(gaussians: &Gaussians, bounds: &Bounds) -> Vec<DVec3> {
    let is_in = |mean: &DVec3| mean.cmpge(bounds.core_min).all() && mean.cmple(bounds.core_max).all();
    let solid = (0..gaussians.len()).filter(|&i| gaussians.opacities[i] >= SOLID_OPACITY);
    let means: Vec<DVec3> = solid.map(|i| gaussians.mean_world(i)).filter(is_in).collect();
    means.iter().step_by(means.len().div_ceil(NUM_SURFACE_POINTS).max(1)).copied().collect()
}

/// The default of the camera's radius, scene units; above 0.
pub(super) fn default_camera_radius(bounds: &Bounds) -> f64 {
    let radius = DEFAULT_CAMERA_RADIUS_FRAC * bounds.size();
    if radius > 0.0 { radius } else { MIN_CAMERA_RADIUS }
}

impl Subject {
    /// Whether a point lies in its box, which a margin, over its radius, makes larger.
    pub(super) fn has_in_box(&self, point: DVec3, margin: f64) -> bool {
        let offset = point - self.center;
        let spare = margin * self.radius;
        self.half_axes.iter().all(|axis| offset.dot(axis.normalize_or_zero()).abs() <= axis.length() + spare)
    }

    fn of(gaussians: &Gaussians, object: &Object, labels: &[u16], grid: &Grid) -> Self {
        let within = |margin: f64| -> Vec<bool> {
            let owns = object.owns(labels, margin);
            (0..gaussians.len()).map(|i| owns(i, gaussians.mean_world(i))).collect()
        };
        let (own, near) = (within(0.0), within(SKIN_FRAC * object.radius()));
        let all_solid = || (0..gaussians.len()).filter(|&i| gaussians.opacities[i] >= SOLID_OPACITY);
        let solid: Vec<usize> = all_solid().filter(|&i| own[i]).collect();
        let (num_near, sum) = all_solid()
            .filter(|&i| near[i])
            .fold((0_u32, DVec3::ZERO), |(count, sum), i| (count + 1, sum + gaussians.mean_world(i)));
        let is_alone = num_near > 0 && f64::from(num_near) >= ALONE_FRAC * all_solid().count() as f64;
        let corners = object.corners().to_vec();
        let stride = (solid.len() / SUBJECT_POINTS).max(1);
        let (points, outline) = if solid.len() >= 20 {
            let points = solid.iter().step_by(stride).map(|&i| gaussians.mean_world(i)).collect();
            (points, outline(gaussians, &solid))
        } else {
            (corners.clone(), corners.clone())
        };
        let facets = Facets::of(gaussians, &solid, object.center, object.radius());
        let others = OpacityGrid::of(grid.clone(), gaussians, |i| !is_alone && !near[i]);
        let label = if object.label.is_empty() { format!("<obj-{}>", object.id) } else { object.label.clone() };
        Self {
            label,
            center: object.center,
            corners,
            half_axes: object.half_axes(),
            radius: object.radius(),
            points,
            body: if num_near > 0 { sum / f64::from(num_near) } else { object.center },
            splat_size: splat_size(gaussians, &solid),
            outline,
            facets,
            front_rad: None,
            facing_rad: None,
            borne_heights: None,
            bearer: None,
            wall_side_rad: OnceLock::new(),
            wall_behind_rad: OnceLock::new(),
            best_seen_frac: OnceLock::new(),
            others,
        }
    }

    /// A point in the axes of the box, over its half extents: inside where no component is beyond 1.
    pub(super) fn in_box(&self, point: DVec3) -> DVec3 {
        let along = |axis: DVec3| (point - self.center).dot(axis) / axis.length_squared().max(1e-18);
        DVec3::from_array(self.half_axes.map(along))
    }

    /// Half the extent of the box along a unit direction, from its center.
    pub(super) fn reach(&self, direction: DVec3) -> f64 {
        self.half_axes.iter().map(|axis| axis.dot(direction).abs()).sum()
    }

    /// Index of the box's axis that is nearest to a unit direction.
    pub(super) fn axis_along(&self, direction: DVec3) -> usize {
        let along = |i: &usize| self.half_axes[*i].normalize_or_zero().dot(direction).abs();
        (0..3).max_by(|a, b| along(a).total_cmp(&along(b))).unwrap_or(0)
    }

    /// The horizontal axes of the box, half extents along them: the longer one first.
    pub(super) fn level_axes(&self, up: DVec3) -> [DVec3; 2] {
        let upright = self.axis_along(up);
        let flat = |i: usize| self.half_axes[i] - up * self.half_axes[i].dot(up);
        let (a, b) = (flat((upright + 1) % 3), flat((upright + 2) % 3));
        if a.length() >= b.length() { [a, b] } else { [b, a] }
    }

    /// Transmittance from a point of the subject to `eye` through all matter except the subject, 0..1.
    pub(super) fn transmittance(&self, eye: DVec3, point: DVec3) -> f64 {
        self.others.transmittance(eye, point)
    }
}
