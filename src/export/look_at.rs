//! `look_at` on keyframes of a `shot.json`: what the camera looks at, whatever else was edited.
//!
//! It is a point (`[x, y, z]`), the name of an object (`"<obj-3>"`, `"mug"`), or both
//! (`{"object": .., "point": .., "point_of": ..}`), as the writer leaves it. The point counts while `point_of` is the
//! name in `object`: who writes another name, or leaves the point out, has it found anew.

use cinesplat_geometry::{LevelAngles, LevelFrame};
use cinesplat_trajectory::{Keyframe, LookAt};
use glam::{DQuat, DVec3};

use super::ExportError;
use super::json_read::Node;
use super::json_write::{Json, object};

/// Keys of a `look_at` with an object.
pub(super) const KEYS: [&str; 3] = ["object", "point", "point_of"];

/// The center of the object of a name, world, or what was expected instead.
pub type FindObject<'a> = dyn Fn(&str) -> Result<DVec3, String> + 'a;

/// Whether a `look_at` names an object without its place.
pub(super) fn is_name(node: &Node) -> bool {
    node.text().is_ok() || node.optional("object").is_some_and(|name| own_point(node, &name).is_none())
}

/// The point of a `look_at`, if it is that of the object of this name.
fn own_point<'a>(node: &Node<'a>, name: &Node<'a>) -> Option<Node<'a>> {
    let is_own = node.optional("point_of").is_some_and(|of| of.text().ok() == name.text().ok());
    node.optional("point").filter(|_| is_own)
}

/// Reads a `look_at` of the camera at `position`.
pub(super) fn read(node: &Node, position: DVec3, find: &FindObject<'_>) -> Result<LookAt, ExportError> {
    let found = |name: &Node| find(name.text()?).map_err(|expected| name.error(&expected));
    let (point, name) = if node.text().is_ok() {
        (found(node)?, Some(node.text()?))
    } else if let Some(name) = node.optional("object") {
        let point = own_point(node, &name).map_or_else(|| found(&name), |point| point.vector())?;
        (point, Some(name.text()?))
    } else {
        let expected = "a point (3 finite numbers) or the name of an object (\"<obj-3>\")";
        (node.vector().map_err(|_| node.error(expected))?, None)
    };
    if !(point.distance(position) > 0.0) {
        return Err(node.error("a point other than the key's own position"));
    }
    Ok(LookAt { point, object: name.map(str::to_owned) })
}

/// A `look_at` as JSON.
pub(super) fn write(look_at: &LookAt) -> Json {
    match &look_at.object {
        Some(name) => object([
            ("object", name.as_str().into()),
            ("point", look_at.point.into()),
            ("point_of", name.as_str().into()),
        ]),
        None => look_at.point.into(),
    }
}

/// Largest angle between the view axis and the direction to the point that needs no new aim, degrees.
const TOLERANCE_DEG: f64 = 0.01;

/// Aims every keyframe with a `look_at` at its point, and returns one line per keyframe that was turned. The roll about the
/// view axis stays; without `up` the camera turns by the smallest angle.
pub(super) fn apply(keys: &mut [Keyframe], up: Option<DVec3>) -> Vec<String> {
    let level = up.and_then(|up| LevelFrame::new(up).ok());
    let mut notes = Vec::new();
    for (idx, key) in keys.iter_mut().enumerate() {
        let point = key.intent.as_ref().and_then(|intent| Some(intent.look_at.as_ref()?.point));
        let Some(toward) = point.and_then(|point| (point - key.pose.position).try_normalize()) else { continue };
        let off_deg = key.pose.forward().angle_between(toward).to_degrees();
        if off_deg > TOLERANCE_DEG {
            key.pose.rotation = aimed(key.pose.rotation, toward, level.as_ref());
            notes.push(format!("keyframes[{idx}].look_at: the camera is turned by {off_deg:.2} degrees to look at it"));
        }
    }
    notes
}

fn aimed(rotation: DQuat, toward: DVec3, level: Option<&LevelFrame>) -> DQuat {
    match level {
        Some(level) => level.rotation(LevelAngles {
            yaw_rad: level.azimuth(toward),
            pitch_rad: toward.dot(level.up).clamp(-1.0, 1.0).asin(),
            roll_rad: level.angles(rotation).roll_rad,
        }),
        None => (DQuat::from_rotation_arc(rotation * DVec3::Z, toward) * rotation).normalize(),
    }
}
