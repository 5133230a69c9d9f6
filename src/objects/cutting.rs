//! Parts of a thing that a search has not found, cut from it by where such parts sit.

use cinesplat_geometry::LevelFrame;
use cinesplat_scene::{Gaussians, SOLID_OPACITY};
use glam::DVec3;

use super::boxes;
use super::object::{Object, ObjectSet};

/// Least number of Gaussians of a part.
const MIN_GAUSSIANS: usize = 40;

/// A region of a thing. Intervals are shares of the thing's extent along an axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Region {
    /// From the lower end, 0, to the upper end, 1.
    pub up: [f64; 2],
    /// A level direction, and the interval from the far end along it, 0, to the near end, 1. `None` for all of the thing.
    pub along: Option<(DVec3, [f64; 2])>,
}

impl ObjectSet {
    /// Makes the Gaussians of a thing in a region an object of its own, a part of the thing, and returns its id. The parts that a
    /// search has found lose what the new one takes. `None`, and nothing is changed, where only boxes are known, where the
    /// region holds next to nothing, and where no id is left.
    pub fn cut_part(
        &mut self,
        gaussians: &Gaussians,
        whole: u32,
        frame: &LevelFrame,
        region: &Region,
        label: &str,
    ) -> Option<u32> {
        let last = self.objects.iter().map(|object| object.id).max()?;
        let id = last.checked_add(1).filter(|id| u16::try_from(*id).is_ok())?;
        let own = self.members().remove(&whole)?;
        let is_solid = |i: &&usize| gaussians.opacities[**i] >= SOLID_OPACITY;
        let solid: Vec<usize> = own.iter().filter(is_solid).copied().collect();
        let mut members = if solid.len() < MIN_GAUSSIANS { own } else { solid };
        let sides = std::iter::once((frame.up, region.up)).chain(region.along);
        let kept: Vec<(DVec3, [f64; 2])> =
            sides.map(|(axis, shares)| (axis, interval(gaussians, &members, axis, shares))).collect();
        members.retain(|&i| {
            let place = gaussians.mean_world(i);
            kept.iter().all(|(axis, [low, high])| (*low..=*high).contains(&place.dot(*axis)))
        });
        if members.len() < MIN_GAUSSIANS {
            return None;
        }
        let fitted = boxes::fit(gaussians, &members, frame.up)?;
        members.iter().for_each(|&i| self.labels[i] = id as u16);
        self.objects.push(Object {
            num_gaussians: members.len(),
            parent: Some(whole),
            rotation: fitted.rotation,
            ..Object::from_box(id, label, fitted.center, fitted.half_extents)
        });
        Some(id)
    }
}

/// The coordinates along an axis between two shares of the extent of some Gaussians.
fn interval(gaussians: &Gaussians, members: &[usize], axis: DVec3, [from, to]: [f64; 2]) -> [f64; 2] {
    let (low, high) = boxes::trimmed(members.iter().map(|&i| gaussians.mean_world(i).dot(axis)).collect());
    // What lies beyond the extent belongs to its ends.
    let at = |share: f64| match share {
        _ if share <= 0.0 => f64::NEG_INFINITY,
        _ if share >= 1.0 => f64::INFINITY,
        _ => low + share * (high - low),
    };
    [at(from), at(to)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{Quat, Vec3};

    /// A post of 1000 Gaussians, 1 high, found as two halves.
    fn post() -> (Gaussians, ObjectSet) {
        let mut gaussians = Gaussians::default();
        let mut set = ObjectSet::default();
        for i in 0..1000 {
            let across = [i % 10, i / 10 % 10].map(|step| step as f32 / 50.0);
            gaussians.means.push(Vec3::new(across[0], (i / 100) as f32 / 9.0, across[1]));
            gaussians.opacities.push(1.0);
            gaussians.scales.push(Vec3::splat(0.01));
            gaussians.rotations.push(Quat::IDENTITY);
            gaussians.sh_dc.push(Vec3::ZERO);
            set.labels.push(if i < 500 { 2 } else { 3 });
        }
        let part = |id: u32, parent: Option<u32>| Object {
            parent,
            ..Object::from_box(id, "part", DVec3::Y * 0.5, DVec3::new(0.1, 0.5, 0.1))
        };
        set.objects = vec![part(1, None), part(2, Some(1)), part(3, Some(1))];
        (gaussians, set)
    }

    #[test]
    fn a_part_takes_what_lies_in_its_region() {
        let (gaussians, mut set) = post();
        let frame = LevelFrame::new(DVec3::Y).unwrap();
        let top = Region { up: [0.8, 1.0], along: None };
        assert_eq!(set.cut_part(&gaussians, 1, &frame, &top, "knob"), Some(4));
        let knob = set.get(4).unwrap();
        assert_eq!((knob.num_gaussians, knob.parent, knob.label.as_str()), (200, Some(1), "knob"));
        assert!((knob.span_along(DVec3::Y)[0] - 8.0 / 9.0).abs() < 1e-6);
        assert_eq!(set.labels_of(1).iter().filter(|label| **label == 1).count(), 1000);
        let half = Region { up: [0.0, 0.5], along: Some((DVec3::X, [0.5, 1.0])) };
        assert_eq!(set.cut_part(&gaussians, 1, &frame, &half, "side"), Some(5));
        assert!(set.get(5).unwrap().span_along(DVec3::X)[0] > 0.09);
    }

    #[test]
    fn nothing_is_cut_where_there_is_nothing() {
        let (gaussians, mut set) = post();
        let frame = LevelFrame::new(DVec3::Y).unwrap();
        let gap = Region { up: [0.12, 0.2], along: None };
        let before = set.clone();
        assert_eq!(set.cut_part(&gaussians, 1, &frame, &gap, "gap"), None);
        assert_eq!(set, before);
        set.labels.clear();
        assert_eq!(set.cut_part(&gaussians, 1, &frame, &Region { up: [0.0, 1.0], along: None }, "all"), None);
    }
}
