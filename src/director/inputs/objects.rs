//! Scene objects as inputs of the network.

use cinesplat_objects::Object;
use glam::DVec3;

use super::vocabulary::object_token;
use crate::frame::SceneFrame;

/// Limit on the points per object that are inputs of the network.
pub const MAX_POINTS: usize = 64;
/// Limit on the unnamed objects that are inputs of the network.
pub const MAX_OTHER_OBJECTS: usize = 12;

/// Distance and half extent of objects nowhere, in scene sizes. The readings hardly depend on them.
const PLACE_STEP: f64 = 0.07;
const PLACE_EXTENT: f64 = 0.02;

/// One object as input of the network.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ObjectInput {
    /// Token id of its slot.
    pub slot_token: u32,
    /// Center of its box, in scene sizes.
    pub center: DVec3,
    /// Half extents along the frame's axes, in scene sizes.
    pub half_extents: DVec3,
    /// Points of its cloud relative to their centroid, in units of the box's half diagonal.
    pub points: Vec<[f32; 3]>,
}

/// An object in `frame` with the identifier of `slot`. Of a larger cloud every n-th point is kept, at most
/// [`MAX_POINTS`].
pub fn object_input(object: &Object, slot: usize, frame: &SceneFrame) -> ObjectInput {
    let half_extents = frame.half_extents(object.half_extents, object.rotation);
    let stride = object.points.len().div_ceil(MAX_POINTS).max(1);
    let points: Vec<DVec3> = object.points.iter().step_by(stride).map(|point| frame.point(*point)).collect();
    let centroid = points.iter().sum::<DVec3>() / points.len().max(1) as f64;
    let scale = half_extents.length().max(1e-9).recip();
    ObjectInput {
        slot_token: object_token(slot),
        center: frame.point(object.center),
        half_extents,
        points: points
            .iter()
            .map(|point| ((*point - centroid) * scale).clamp_length_max(4.0).as_vec3().to_array())
            .collect(),
    }
}

/// An object of which only the slot is known: it has a place of its own, in a row, and no cloud.
pub(super) fn object_nowhere(slot: usize) -> ObjectInput {
    ObjectInput {
        slot_token: object_token(slot),
        center: DVec3::new(0.0, 0.0, -PLACE_STEP * slot as f64),
        half_extents: DVec3::splat(PLACE_EXTENT),
        points: Vec::new(),
    }
}

/// Ids of up to [`MAX_OTHER_OBJECTS`] objects that the text does not name: those nearest to the first named object, or
/// the largest when none is named.
pub(crate) fn other_objects(objects: &[Object], named: &[u32]) -> Vec<u32> {
    let about = named.first().and_then(|id| objects.iter().find(|object| object.id == *id)).map(|object| object.center);
    let rank = |object: &Object| about.map_or(-object.radius(), |about| object.center.distance(about));
    let mut others: Vec<(f64, u32)> =
        objects.iter().filter(|object| !named.contains(&object.id)).map(|object| (rank(object), object.id)).collect();
    others.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    others.into_iter().take(MAX_OTHER_OBJECTS).map(|(_, id)| id).collect()
}
