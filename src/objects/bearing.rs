//! What stands on what: the things on a table.

use glam::DVec3;

use super::object::{Object, ObjectSet};

/// Distance of a thing's foot from the top of what bears it, over the thing's height and over the bearer's.
const FOOT_FRAC: f64 = 0.3;
const TOP_FRAC: f64 = 0.08;
/// Distance of a thing's middle from that of what bears it, over the bearer's half extents, both level.
const INSIDE: f64 = 1.02;
/// Height of a thing over that of what bears it from which on the two stand beside each other.
const MOST_HEIGHT: f64 = 4.0;

impl ObjectSet {
    /// The things that stand on an object or in it, by their boxes, in order of id; `up` is the world's up, of length 1.
    /// Parts of the object and parts of other things are none.
    pub fn things_on(&self, id: u32, up: DVec3) -> Vec<u32> {
        let Some(bearer) = self.get(id) else { return Vec::new() };
        self.borne(bearer, up).map(|(thing, _)| thing.id).collect()
    }

    /// Heights along up of the surface on which things stand that are on an object, and of the highest of them, scene
    /// units: the mean of their feet, and their top. `None` where nothing stands on top of it. `up` is the world's up, of
    /// length 1.
    pub fn borne_heights(&self, id: u32, up: DVec3) -> Option<[f64; 2]> {
        let bearer = self.get(id)?;
        let on_top = self.borne(bearer, up).filter(|(_, place)| *place == Where::OnTop);
        let heights: Vec<[f64; 2]> = on_top.map(|(thing, _)| thing.span_along(up)).collect();
        let foot = heights.iter().map(|[foot, _]| foot).sum::<f64>() / heights.len() as f64;
        let top = heights.iter().map(|[_, top]| *top).fold(foot, f64::max);
        (!heights.is_empty()).then_some([foot, top])
    }

    /// The things that stand on or in an object, and where; no parts.
    fn borne<'a>(&'a self, bearer: &'a Object, up: DVec3) -> impl Iterator<Item = (&'a Object, Where)> {
        let things = self.objects.iter().filter(|thing| thing.parent.is_none() && thing.id != bearer.id);
        things.filter_map(move |thing| Some((thing, stands(bearer, thing, up)?)))
    }

    /// The thing on which another one stands, the smallest of several. `up` is the world's up, of length 1.
    pub fn bearer_of(&self, id: u32, up: DVec3) -> Option<u32> {
        let thing = self.get(id).filter(|thing| thing.parent.is_none())?;
        let bears = |bearer: &&Object| bearer.id != id && stands(bearer, thing, up) == Some(Where::OnTop);
        let bearers = self.objects.iter().filter(bears);
        bearers.min_by(|a, b| a.radius().total_cmp(&b.radius())).map(|bearer| bearer.id)
    }
}

/// Where a thing stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Where {
    OnTop,
    Within,
}

/// Where a thing stands on or in another one; `None` where it stands elsewhere.
fn stands(bearer: &Object, thing: &Object, up: DVec3) -> Option<Where> {
    let ([foot, head], [bottom, top]) = (thing.span_along(up), bearer.span_along(up));
    let (height, bearer_height) = (head - foot, top - bottom);
    // In the bearer's own axes, without the way along up.
    let apart = thing.center - bearer.center;
    let level = bearer.rotation.conjugate() * (apart - up * apart.dot(up));
    let is_over = level.abs().cmple(bearer.half_extents * INSIDE + 1e-9).all();
    let is_smaller = thing.half_extents.max_element() < bearer.half_extents.max_element();
    if !is_over || !is_smaller || height > MOST_HEIGHT * bearer_height {
        return None;
    }
    if (foot - top).abs() <= FOOT_FRAC * height + TOP_FRAC * bearer_height {
        return Some(Where::OnTop);
    }
    let is_within = foot > bottom + TOP_FRAC * bearer_height && head < top + TOP_FRAC * bearer_height;
    is_within.then_some(Where::Within)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn set() -> ObjectSet {
        let boxed = |id, label, center: [f64; 3], half: [f64; 3]| {
            Object::from_box(id, label, DVec3::from_array(center), DVec3::from_array(half))
        };
        let objects = vec![
            boxed(1, "table", [0.0, 0.37, 0.0], [0.8, 0.37, 0.5]),
            boxed(2, "vase", [0.3, 0.9, 0.1], [0.08, 0.15, 0.08]),
            boxed(3, "mug", [-0.5, 0.8, 0.3], [0.05, 0.06, 0.05]),
            boxed(4, "rug", [0.0, 0.01, 0.0], [0.7, 0.01, 0.4]),
            boxed(5, "lamp over the table", [0.0, 1.8, 0.0], [0.2, 0.2, 0.2]),
            boxed(6, "chair", [1.2, 0.45, 0.0], [0.25, 0.45, 0.25]),
            Object { parent: Some(2), ..boxed(7, "stem", [0.3, 0.85, 0.1], [0.02, 0.1, 0.02]) },
            boxed(8, "drawer", [0.4, 0.45, 0.0], [0.2, 0.1, 0.3]),
        ];
        ObjectSet { objects, labels: Vec::new() }
    }

    #[test]
    fn things_on_a_table_stand_on_it_or_in_it() {
        assert_eq!(set().things_on(1, DVec3::Y), [2, 3, 8]);
        assert_eq!(set().things_on(6, DVec3::Y), Vec::<u32>::new());
        let heights = set().borne_heights(1, DVec3::Y);
        assert!(
            heights.is_some_and(|[foot, top]| (foot - 0.745).abs() < 1e-9 && (top - 1.05).abs() < 1e-9),
            "{heights:?}"
        );
        assert_eq!(set().borne_heights(2, DVec3::Y), None);
        assert_eq!([2, 3, 1, 7].map(|id| set().bearer_of(id, DVec3::Y)), [Some(1), Some(1), None, None]);
    }

    #[test]
    fn what_bears_what_does_not_depend_on_the_axes() {
        let turn = glam::DQuat::from_rotation_x(0.7) * glam::DQuat::from_rotation_z(1.9);
        let mut turned = set();
        for object in &mut turned.objects {
            object.center = turn * object.center;
            object.rotation = turn * object.rotation;
        }
        assert_eq!(turned.things_on(1, turn * DVec3::Y), set().things_on(1, DVec3::Y));
    }
}
