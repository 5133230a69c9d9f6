//! What a shot is focused on.
//!
//! Enters: the keyframes of a shot with the subjects of their intents. Leaves: a focus that follows the subject, or
//! focus distances on keyframes where the subject changes. Distances are those of the surface that the camera sees.

use cinesplat_geometry::{Camera, Intrinsics};
use cinesplat_objects::{Object, ObjectSet};
use cinesplat_render::{RenderError, RenderSettings, Renderer};
use cinesplat_scene::Scene;
use cinesplat_trajectory::{Keyframe, Move, Shot};
use glam::DVec2;

/// Height of the pictures of depths, pixels.
const HEIGHT_PX: u32 = 180;
/// Margin about the box of a subject, as a fraction of its radius.
const MARGIN: f64 = 0.05;
/// Names of the effects that have a focus.
const FOCUSED: [&str; 2] = ["depth-of-field", "rack-focus"];

/// Focuses a shot whose effects have a focus. Shots without such effects, or without subjects, stay as they are.
///
/// # Errors
/// Those of the renderer.
pub(super) fn focus(scene: &Scene, objects: &ObjectSet, shot: &mut Shot) -> Result<(), RenderError> {
    if !shot.effects.iter().any(|effect| FOCUSED.contains(&effect.kind.as_str())) {
        return Ok(());
    }
    let seer = Seer { renderer: Renderer::new(&scene.gaussians), settings: RenderSettings::for_scene(scene) };
    let subject = |key: &Keyframe| key.intent.as_ref()?.subjects.first().and_then(|id| objects.get(*id));
    if shot.keyframes.iter().any(|key| key.focus_distance.is_some()) {
        return seer.refine(objects, shot);
    }
    let subjects: Vec<Option<&Object>> = shot.keyframes.iter().map(subject).collect();
    let Some(first) = subjects.iter().flatten().next() else { return Ok(()) };
    if subjects.iter().flatten().any(|other| other.id != first.id) {
        for (idx, subject) in subjects.iter().enumerate() {
            let Some(subject) = subject else { continue };
            let view = shot_camera(shot, &shot.keyframes[idx]);
            let distance = seer.on_surface(&view, subject, depth_of_center(&view, subject))?;
            shot.keyframes[idx].focus_distance = Some(distance).filter(|distance| *distance > 0.0);
        }
        return Ok(());
    }
    let mut nearer = Vec::new();
    for key in &shot.keyframes {
        nearer.extend(seer.nearer(&shot_camera(shot, key), first)?);
    }
    nearer.sort_by(f64::total_cmp);
    let nearer = nearer.get(nearer.len() / 2).copied().unwrap_or(0.0);
    let point = [first.center.x, first.center.y, first.center.z, nearer];
    let names = ["focus_x", "focus_y", "focus_z", "focus_nearer"].map(str::to_owned);
    for effect in shot.effects.iter_mut().filter(|effect| FOCUSED.contains(&effect.kind.as_str())) {
        effect.settings.extend(names.iter().cloned().zip(point));
    }
    Ok(())
}

fn shot_camera(shot: &Shot, key: &Keyframe) -> Camera {
    let width = (u64::from(HEIGHT_PX) * u64::from(shot.width) / u64::from(shot.height.max(1))).max(1) as u32;
    Camera { pose: key.pose, intrinsics: Intrinsics::from_fov_y(width, HEIGHT_PX, key.fov_y_rad) }
}

fn depth_of_center(view: &Camera, object: &Object) -> f64 {
    view.pose.to_camera(object.center).z
}

/// Sees how far away things are.
struct Seer<'a> {
    renderer: Renderer<'a>,
    settings: RenderSettings,
}

impl Seer<'_> {
    /// How much nearer than its center the visible surface of an object is: the median over its pixels. `None` where it is
    /// not seen.
    fn nearer(&self, view: &Camera, object: &Object) -> Result<Option<f64>, RenderError> {
        let map = self.renderer.depth(view, &self.settings)?;
        let forward = view.pose.forward();
        let mut depths: Vec<f64> = Vec::new();
        for (idx, &depth) in map.median.iter().enumerate().filter(|(_, depth)| depth.is_finite()) {
            let (column, row) = (idx % map.width as usize, idx / map.width as usize);
            let ray = view.ray(DVec2::new(column as f64 + 0.5, row as f64 + 0.5));
            let depth = f64::from(depth);
            if object.contains(view.pose.position + ray * (depth / ray.dot(forward)), MARGIN * object.radius()) {
                depths.push(depth);
            }
        }
        depths.sort_by(f64::total_cmp);
        let median = depths.get(depths.len() / 2);
        Ok(median.map(|median| depth_of_center(view, object) - median))
    }

    /// The depth of the visible surface of an object whose center is at a depth; that of the center where it is not seen.
    fn on_surface(&self, view: &Camera, object: &Object, center: f64) -> Result<f64, RenderError> {
        Ok(center - self.nearer(view, object)?.unwrap_or(0.0))
    }

    /// Moves the focus distances of rack focuses from the centers of objects to their surfaces. Before the first rack
    /// focus and after each one the focus follows the subject of the key, or the last one in focus where a key has none.
    fn refine(&self, objects: &ObjectSet, shot: &mut Shot) -> Result<(), RenderError> {
        let mut held: Option<&Object> = None;
        for idx in 0..shot.keyframes.len() {
            let key = &shot.keyframes[idx];
            let view = shot_camera(shot, key);
            let (object, center) = if is_racked(&shot.keyframes, idx) {
                let Some(distance) = key.focus_distance else { continue };
                let apart = |object: &&Object| (depth_of_center(&view, object) - distance).abs();
                let nearest = objects.objects.iter().min_by(|a, b| apart(a).total_cmp(&apart(b)));
                (nearest.filter(|object| apart(object) < 1e-3 * distance), distance)
            } else {
                let own = key.intent.as_ref().and_then(|intent| intent.subjects.first());
                let Some(object) = own.and_then(|id| objects.get(*id)).or(held) else { continue };
                (Some(object), depth_of_center(&view, object))
            };
            let Some(object) = object else { continue };
            held = Some(object);
            let distance = self.on_surface(&view, object, center)?;
            if center > 0.0 {
                shot.keyframes[idx].focus_distance = Some(distance.max(1e-3 * center));
            }
        }
        Ok(())
    }
}

/// Whether a rack focus begins or ends at a key.
fn is_racked(keys: &[Keyframe], idx: usize) -> bool {
    let racks = |key: &Keyframe| key.intent.as_ref().is_some_and(|intent| intent.movement == Some(Move::RackFocus));
    racks(&keys[idx]) || idx > 0 && racks(&keys[idx - 1])
}
