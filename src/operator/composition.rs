//! The composition of a picture in numbers: places of the frame, lenses, and the sides of a subject.

use glam::{DVec2, DVec3};

use super::framing::{MANY, Target, frame_ray};
use super::program::{FramePlace, Framing, Lens, SubjectSide};
use super::wall_side::wall_behind;
use super::world::World;
use cinesplat_geometry::{LevelAngles, Pose, rotation};
use cinesplat_trajectory::CameraState;

/// Distance of a third from the frame's middle, over the frame's width or height.
const THIRD: f64 = 1.0 / 6.0;
/// Half the height of a full frame, millimeters.
const HALF_FULL_FRAME_MM: f64 = 12.0;
/// Focal lengths on full frame of a wide-angle lens and of a long one, millimeters.
const WIDE_MM: (f64, f64) = (16.0, 28.0);
const LONG_MM: (f64, f64) = (70.0, 135.0);
/// Distance of a subject from the middle of the scene, over the scene size, below which its front faces the best
/// viewpoint instead.
const MIDDLE_FRAC: f64 = 0.02;

/// A place of the frame as shares of its width and height from the middle; right and up positive. A third is the line
/// that divides the frame's outer third from its middle third.
pub(super) fn frame_place(place: FramePlace) -> DVec2 {
    let (x, y) = match place {
        FramePlace::AtLeft => (-THIRD, 0.0),
        FramePlace::AtRight => (THIRD, 0.0),
        FramePlace::AtUpper => (0.0, THIRD),
        FramePlace::AtLower => (0.0, -THIRD),
        FramePlace::AtUpperLeft => (-THIRD, THIRD),
        FramePlace::AtUpperRight => (THIRD, THIRD),
        FramePlace::AtLowerLeft => (-THIRD, -THIRD),
        FramePlace::AtLowerRight => (THIRD, -THIRD),
        FramePlace::AtCenter => (0.0, 0.0),
    };
    DVec2::new(x, y)
}

/// A place of the frame in words.
pub(super) fn place_words(place: FramePlace) -> &'static str {
    match place {
        FramePlace::AtLeft => "on the left third",
        FramePlace::AtRight => "on the right third",
        FramePlace::AtUpper => "on the upper third",
        FramePlace::AtLower => "on the lower third",
        FramePlace::AtUpperLeft => "in the upper left",
        FramePlace::AtUpperRight => "in the upper right",
        FramePlace::AtLowerLeft => "in the lower left",
        FramePlace::AtLowerRight => "in the lower right",
        FramePlace::AtCenter => "in the middle of the frame",
    }
}

/// The camera turned in place, with a level horizon, so that a point projects at a place of the frame: shares of its
/// width and height from the middle, right and up positive. Unchanged where the point is the camera's position.
///
/// In camera axes the point lies along the unit ray r. A level camera of pitch p sees it at the height
/// `r.z sin p - r.y cos p` above its horizon, which must be that of the direction to the point; then the yaw follows
/// from the azimuths of both.
pub(super) fn placed(world: &World, state: &CameraState, point: DVec3, at: DVec2) -> CameraState {
    let Some(direction) = (point - state.pose.position).try_normalize() else { return *state };
    let frame = &world.frame;
    let ray = frame_ray(world, state, at).normalize();
    let rise = (frame.height(direction) / ray.z.hypot(ray.y)).clamp(-1.0, 1.0).asin();
    let pitch_rad = rise - (-ray.y).atan2(ray.z);
    let (sin, cos) = pitch_rad.sin_cos();
    let yaw_rad = frame.azimuth(direction) - ray.x.atan2(ray.z * cos + ray.y * sin);
    let rotation = frame.rotation(LevelAngles { yaw_rad, pitch_rad, roll_rad: 0.0 });
    CameraState { pose: Pose { rotation, ..state.pose }, ..*state }
}

/// Range of the vertical field of view of a lens, degrees. A focal length f on full frame, 24 mm high, has the field
/// 2 atan(12 / f). A wide-angle lens has 16 to 28 mm, a long one 70 to 135 mm.
pub(super) fn lens_fov_deg(lens: Lens) -> (f64, f64) {
    let fov_deg = |focal_mm: f64| 2.0 * (HALF_FULL_FRAME_MM / focal_mm).atan().to_degrees();
    match lens {
        Lens::FocalMm(focal_mm) => (fov_deg(focal_mm.max(1.0)), fov_deg(focal_mm.max(1.0))),
        Lens::FovDeg(deg) => (deg.clamp(1.0, 150.0), deg.clamp(1.0, 150.0)),
        Lens::Wide => (fov_deg(WIDE_MM.1), fov_deg(WIDE_MM.0)),
        Lens::Long => (fov_deg(LONG_MM.1), fov_deg(LONG_MM.0)),
    }
}

/// Azimuth, seen from the point, of the front of the subject there: the known one, or else away from the wall behind it, or else
/// that of the middle of the scene, or of the best viewpoint where the subject itself is in the middle.
pub(super) fn front_azimuth(world: &World, center: DVec3) -> f64 {
    let known = match world.subject_at(center) {
        Some(subject) => subject.front_rad.or(subject.facing_rad).or_else(|| wall_behind(world, subject)),
        None => world.front_rad,
    };
    if let Some(known) = known {
        return known;
    }
    let level = |to: DVec3| world.frame.horizontal(to - center);
    let to_middle = level(world.bounds.center());
    let near = to_middle.length() < MIDDLE_FRAC * world.bounds.size();
    let to_viewpoint = world.viewpoints().first().filter(|_| near).map(|&viewpoint| level(viewpoint));
    world.frame.azimuth(to_viewpoint.unwrap_or(to_middle))
}

/// Azimuths of a camera, seen from a subject's center, in the middle of a side of the subject. Left and right are those
/// of somebody who sees the front, and azimuths grow clockwise from above: the left is a quarter turn after the front.
pub(super) fn side_azimuths(world: &World, center: DVec3, side: SubjectSide) -> Vec<f64> {
    let front = front_azimuth(world, center);
    let quarter = std::f64::consts::FRAC_PI_2;
    match side {
        SubjectSide::FromFront => vec![front],
        SubjectSide::FromBack => vec![front + 2.0 * quarter],
        SubjectSide::FromLeft => vec![front + quarter],
        SubjectSide::FromRight => vec![front - quarter],
        SubjectSide::FromSide => vec![front + quarter, front - quarter],
        SubjectSide::FromFrontQuarter => vec![front + 0.5 * quarter, front - 0.5 * quarter],
        SubjectSide::FromBackQuarter => vec![front + 1.5 * quarter, front - 1.5 * quarter],
    }
}

/// As [`side_azimuths`] for a camera that is to stand there: square to the box of the target's first subject where that faces
/// about the same way, as the foot of a bed does.
pub(super) fn square_azimuths(world: &World, target: &Target, side: SubjectSide) -> Vec<f64> {
    let middles = side_azimuths(world, target.center, side);
    let is_between = matches!(side, SubjectSide::FromFrontQuarter | SubjectSide::FromBackQuarter);
    let subject = target.ids.first().and_then(|id| world.subject(*id));
    let Some(subject) = subject.filter(|_| !is_between && world.known_front(target.center).is_none()) else {
        return middles;
    };
    let [long, short] = subject.level_axes(world.frame.up);
    let ways: Vec<f64> = [long, -long, short, -short]
        .into_iter()
        .filter(|way| way.length() > 0.0)
        .map(|way| world.frame.azimuth(way))
        .collect();
    let square = |middle: f64| {
        let off = |way: &f64| rotation::short_turn(way - middle).abs();
        let nearest = ways.iter().copied().min_by(|a, b| off(a).total_cmp(&off(b)));
        nearest.filter(|way| off(way) < SQUARE_RAD).unwrap_or(middle)
    };
    middles.into_iter().map(square).collect()
}

/// Azimuths from which the camera stands where a framing says: on the stated side, or opposite the backdrop. `None` where it
/// says neither, and where the backdrop is straight above or below. The second value is how far beside them it may stand.
pub(super) fn stated_azimuths(world: &World, target: &Target, framing: &Framing) -> Option<(Vec<f64>, f64)> {
    if let Some(side) = framing.side {
        return Some((square_azimuths(world, target, side), BESIDE_SIDE_RAD));
    }
    let objects = framing.backdrop.iter().filter_map(|&id| world.subject(id));
    let ways: Vec<DVec3> = objects.map(|object| world.frame.horizontal(target.center - object.center)).collect();
    let way = ways.iter().map(|way| way.normalize_or_zero()).sum::<DVec3>();
    (way.length() > 1e-6).then(|| (vec![world.frame.azimuth(way)], BESIDE_BACKDROP_RAD))
}

/// How far beside the middle of a stated side a view is sought, and beside that before a backdrop, which the subject hides in
/// the middle; radians.
const BESIDE_SIDE_RAD: f64 = 0.21;
const BESIDE_BACKDROP_RAD: f64 = 0.65;

/// Largest angle between the middle of a side and the box's own side for which the camera stands before that, radians.
const SQUARE_RAD: f64 = 0.56;

/// Angle about a subject's center between a camera position and the nearest middle of a side, degrees.
pub(super) fn off_side_deg(world: &World, center: DVec3, position: DVec3, side: SubjectSide) -> f64 {
    let azimuth = world.frame.azimuth(position - center);
    let off = |middle: f64| rotation::short_turn(azimuth - middle).abs().to_degrees();
    side_azimuths(world, center, side).into_iter().map(off).fold(f64::INFINITY, f64::min)
}

/// Range of the elevation from which a person sees a target, degrees. Flat things are looked down on, compact ones on the
/// floor and on tables less so, and tall ones, hanging ones and pictures are seen from their own level. Of nothing is the
/// underside seen.
pub(super) fn natural_elevation_deg(world: &World, target: &Target) -> (f64, f64) {
    let heights: Vec<f64> = target.corners.iter().map(|&c| world.height_above_floor(c)).collect();
    let (bottom, top) = span(heights.iter().copied());
    let (narrow, wide) = widths(world, &target.corners);
    let (height, eye) = (top - bottom, world.eye_height());
    let is_flat = height < FLAT_FRAC * narrow;
    let is_thin = narrow < FLAT_FRAC * height;
    let is_level = |at: f64| at > 0.75 * eye;
    let bears = target.borne_heights(world).is_some_and(|[surface, _]| {
        let height = surface - world.floor_height();
        BEARING_HEIGHTS.contains(&(height / eye))
    });
    if target.ids.len() >= MANY && world.is_indoor() && bottom < 0.8 * eye {
        return MANY_ELEVATION_DEG;
    }
    let is_sheet = narrow < SHEET_FRAC * height.min(wide) && SHEET_HEIGHTS.contains(&(bottom.midpoint(top) / eye));
    match (is_flat, world.is_indoor()) {
        (true, _) => (28.0, 42.0),
        (false, true) if is_sheet => (-2.0, 2.0),
        (false, true) if bears => (12.0, 26.0),
        (false, true) if bottom > 0.85 * eye => (-6.0, 6.0),
        (false, true) if is_level(bottom.midpoint(top)) || (is_thin && is_level(top)) => (-2.0, 8.0),
        (false, true) if top > 0.8 * eye => (1.0, 11.0),
        (false, true) if top < 0.4 * eye => (16.0, 32.0),
        (false, true) => (10.0, 25.0),
        (false, false) if height > 1.2 * wide => (1.0, 12.0),
        (false, false) => (7.0, 22.0),
    }
}

/// Elevation from which each of many things is told from the others, degrees.
const MANY_ELEVATION_DEG: (f64, f64) = (18.0, 38.0);
/// Height of a surface with things on it, over that of a standing person's eyes, at which it is looked down on: a table or
/// a desk, and no bed.
const BEARING_HEIGHTS: std::ops::Range<f64> = 0.38..0.7;
/// Thickness of pictures, windows and boards over their other extents, and the heights of their middles, over that of a standing
/// person's eyes, at which they are seen from their own level: from above or below they are trapezoids.
const SHEET_FRAC: f64 = 0.15;
const SHEET_HEIGHTS: std::ops::Range<f64> = 0.6..1.3;
/// Thickness of a flat thing over its other extents.
const FLAT_FRAC: f64 = 0.3;

/// The least and the largest horizontal extent of points: of 36 directions, the least and the one across it.
fn widths(world: &World, points: &[DVec3]) -> (f64, f64) {
    let extent = |azimuth: f64| {
        let along = world.frame.direction(azimuth);
        let (low, high) = span(points.iter().map(|p| p.dot(along)));
        high - low
    };
    let half_turn = (0..36).map(|i| f64::from(i) * std::f64::consts::PI / 36.0);
    let thinnest = half_turn.min_by(|a, b| extent(*a).total_cmp(&extent(*b))).unwrap_or(0.0);
    (extent(thinnest), extent(thinnest + std::f64::consts::FRAC_PI_2))
}

/// The least and the largest of some values.
pub(super) fn span(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)))
}
