//! Pictures of lenses that are no pinhole, from pinhole pictures.
//!
//! Enters: the direction that each pixel looks in. Leaves: a picture sampled from one wide pinhole picture where all
//! directions are ahead, else from the faces of a cube around the camera. Faces overlap and are blended there: neighboring
//! faces draw a splat slightly differently, because each one flattens it in its own plane.

use cinesplat_geometry::{Camera, Intrinsics, Pose};
use cinesplat_render::{Frame, RenderError, RenderSettings, SortMode};
use glam::{DQuat, DVec3};
use rayon::prelude::*;

use super::effect::Next;
use super::light::Picture;
use super::moment::Moment;
use super::sampling::sampled;

/// Largest angle from the view axis, tangent, that one pinhole picture covers. Beyond it splats are drawn too coarsely.
const WIDEST: f64 = 2.2;
/// Half the angle of a face of the cube, tangent: 45 degrees and a margin that overlaps with the next face.
const FACE: f64 = 1.1;
/// Pixels between the places where directions are looked at first.
const STEP_PX: usize = 8;
/// Longest side of a picture that is sampled from.
const MAX_SIDE_PX: f64 = 8192.0;

/// The direction of each pixel position, in camera axes, any length; `None` where the lens shows nothing.
pub(super) type Directions<'a> = &'a (dyn Fn([f64; 2]) -> Option<DVec3> + Sync);

/// A pinhole picture around a direction.
struct Face {
    /// From the axes of the face to those of the camera.
    camera_from_face: DQuat,
    frame: Frame,
    focal_px: f64,
}

/// What a lens needs of its sources.
struct Needs {
    /// Largest tangents of its directions from the view axis.
    widest: [f64; 2],
    /// Focal length that is as fine as the lens, pixels: for one pinhole picture, and for faces of a cube.
    focal_px: [f64; 2],
}

/// The picture of a moment through a lens.
pub(super) fn through(moment: &Moment<'_>, directions: Directions<'_>, next: Next<'_>) -> Result<Picture, RenderError> {
    let Intrinsics { width, height, .. } = moment.camera.intrinsics;
    let needs = Needs::of([width, height], directions);
    let is_narrow = needs.widest.iter().all(|tangent| *tangent <= WIDEST);
    let faces = if is_narrow { vec![single(moment, &needs, next)?] } else { cube(moment, (&needs, directions), next)? };
    let mut frame = Frame { width, height, ..Frame::default() };
    let num_pixels = width as usize * height as usize;
    (frame.rgb, frame.transmittance) = (vec![0.0; 3 * num_pixels], vec![1.0; num_pixels]);
    let rows = frame.rgb.par_chunks_mut(3 * width as usize).zip(frame.transmittance.par_chunks_mut(width as usize));
    rows.enumerate().for_each(|(row, (rgb, transmittance))| {
        for (column, (rgb, rest)) in rgb.chunks_exact_mut(3).zip(transmittance).enumerate() {
            let Some(direction) = directions([column as f64 + 0.5, row as f64 + 0.5]) else { continue };
            let [red, green, blue, seen] = looked_up(&faces, direction);
            rgb.copy_from_slice(&[red, green, blue]);
            *rest = seen;
        }
    });
    Ok(Picture::of_display(frame))
}

impl Needs {
    fn of(size_px: [u32; 2], directions: Directions<'_>) -> Self {
        let mut needs = Self { widest: [0.0; 2], focal_px: [1.0; 2] };
        let places = |len: u32| (0..len as usize).step_by(STEP_PX).chain([len as usize - 1]);
        for (x, y) in places(size_px[1]).flat_map(|y| places(size_px[0]).map(move |x| (x as f64 + 0.5, y as f64 + 0.5)))
        {
            let unit = |at: [f64; 2]| directions(at).and_then(DVec3::try_normalize);
            let Some(direction) = unit([x, y]) else { continue };
            let ahead = direction.z.max(1e-9);
            needs.widest[0] =
                needs.widest[0].max(if direction.z > 0.0 { direction.x.abs() / ahead } else { f64::INFINITY });
            needs.widest[1] = needs.widest[1].max(direction.y.abs() / ahead);
            // The coarser direction counts: at the pole of a panorama a pixel is a sliver.
            let step = |to: [f64; 2]| unit(to).map_or(0.0, |other| direction.distance(other));
            let step = step([x + 1.0, y]).max(step([x, y + 1.0]));
            if step > 0.0 {
                // A pinhole picture is finer toward its border.
                needs.focal_px[0] = needs.focal_px[0].max(direction.z.max(0.0) / step);
                needs.focal_px[1] = needs.focal_px[1].max(1.0 / step);
            }
        }
        needs
    }
}

/// One pinhole picture that covers all directions.
fn single(moment: &Moment<'_>, needs: &Needs, next: Next<'_>) -> Result<Face, RenderError> {
    // One pixel more, for the curve between pixels.
    let extent = needs.widest.map(|tangent| tangent + 2.0 / needs.focal_px[0]);
    face(moment, (DQuat::IDENTITY, extent, needs.focal_px[0]), &moment.render, next)
}

/// The faces of the cube that the directions need.
fn cube(
    moment: &Moment<'_>,
    (needs, directions): (&Needs, Directions<'_>),
    next: Next<'_>,
) -> Result<Vec<Face>, RenderError> {
    use std::f64::consts::{FRAC_PI_2, PI};
    let around = [0.0, FRAC_PI_2, PI, -FRAC_PI_2].map(DQuat::from_rotation_y);
    let turns = around.into_iter().chain([FRAC_PI_2, -FRAC_PI_2].map(DQuat::from_rotation_x));
    let Intrinsics { width, height, .. } = moment.camera.intrinsics;
    let places =
        || (0..height).step_by(2).flat_map(|y| (0..width).step_by(2).map(move |x| [f64::from(x), f64::from(y)]));
    let is_used =
        |turn: &DQuat| places().filter_map(directions).any(|direction| weight(turn.conjugate() * direction) > 0.0);
    // The order of depths along the axis would change from face to face.
    let render = RenderSettings { sort: SortMode::Ray, ..moment.render };
    let used: Vec<DQuat> = turns.filter(is_used).collect();
    used.into_iter().map(|turn| face(moment, (turn, [FACE; 2], needs.focal_px[1]), &render, &mut *next)).collect()
}

fn face(
    moment: &Moment<'_>,
    (camera_from_face, extent, focal_px): (DQuat, [f64; 2], f64),
    render: &RenderSettings,
    next: Next<'_>,
) -> Result<Face, RenderError> {
    let longest = 2.0 * extent[0].max(extent[1]) * focal_px;
    let focal_px = focal_px * (MAX_SIDE_PX / longest).min(1.0);
    let [width, height] = extent.map(|extent| (2.0 * extent * focal_px).ceil().max(1.0) as u32);
    let (cx_px, cy_px) = (f64::from(width) / 2.0, f64::from(height) / 2.0);
    let intrinsics = Intrinsics { width, height, fx_px: focal_px, fy_px: focal_px, cx_px, cy_px };
    let pose = Pose::new(moment.camera.pose.position, moment.camera.pose.rotation * camera_from_face);
    let asked = Moment { render: *render, ..moment.with_camera(Camera { pose, intrinsics }) };
    let mut picture = next(&asked)?;
    Ok(Face { camera_from_face, frame: std::mem::take(picture.display()), focal_px })
}

/// How much a face of the cube counts in a direction (face axes): 1 in its middle, falling to 0 in the margin.
fn weight(direction: DVec3) -> f64 {
    if !(direction.z > 0.0) {
        return 0.0;
    }
    let reach = (direction.x.abs().max(direction.y.abs())) / direction.z;
    // Two pixels of margin are left for the curve between pixels.
    ((FACE - 0.02 - reach) / (2.0 * (FACE - 0.02 - 1.0))).clamp(0.0, 1.0)
}

/// Color and transmittance in a direction (camera axes).
fn looked_up(faces: &[Face], direction: DVec3) -> [f32; 4] {
    let (mut sum, mut total) = ([0.0; 4], 0.0);
    for face in faces {
        let local = face.camera_from_face.conjugate() * direction;
        let share = if faces.len() == 1 { 1.0 } else { weight(local) as f32 };
        if share > 0.0 && local.z > 0.0 {
            let (x, y) = (local.x / local.z * face.focal_px, local.y / local.z * face.focal_px);
            let middle = [f64::from(face.frame.width) / 2.0, f64::from(face.frame.height) / 2.0];
            let value = sampled(&face.frame, [middle[0] + x, middle[1] + y]);
            (0..4).for_each(|part| sum[part] += share * value[part]);
            total += share;
        }
    }
    if total > 0.0 { sum.map(|part| part / total) } else { [0.0, 0.0, 0.0, 1.0] }
}
