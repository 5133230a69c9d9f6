//! Where things are: what is small, what stands together, and in which order to visit it.

use cinesplat_language::is_listed;
use cinesplat_objects::{Object, only_whole};
use glam::DVec3;

/// Largest radius of a small thing, of the size of the scene.
const SMALL: f64 = 0.05;
/// Largest gap within a group that is one picture, and between two things that are one.
const GROUP_GAP: f64 = 0.28;
const PAIR_GAP: f64 = 0.09;

/// The things of a scene.
pub(super) struct Things<'a> {
    objects: &'a [Object],
    size: f64,
}

impl<'a> Things<'a> {
    pub(super) fn new(objects: &'a [Object]) -> Self {
        let low = objects.iter().flat_map(Object::corners).reduce(DVec3::min).unwrap_or_default();
        let high = objects.iter().flat_map(Object::corners).reduce(DVec3::max).unwrap_or_default();
        Self { objects, size: (high - low).length().max(1e-9) }
    }

    pub(super) fn get(&self, id: u32) -> Option<&'a Object> {
        self.objects.iter().find(|object| object.id == id)
    }

    /// Whether all of some things are small, such as a cup.
    pub(super) fn are_small(&self, ids: &[u32]) -> bool {
        let is_small = |id: &u32| self.get(*id).is_some_and(|object| object.radius() < SMALL * self.size);
        !ids.is_empty() && ids.iter().all(is_small)
    }

    /// Distance between the boxes of two things, as balls, of the size of the scene.
    fn gap(&self, first: u32, second: u32) -> f64 {
        let (Some(first), Some(second)) = (self.get(first), self.get(second)) else { return f64::INFINITY };
        let between = (first.center - second.center).length() - first.radius() - second.radius();
        between.max(0.0) / self.size
    }

    /// Whether two pictures are one: each of a few small things, next to each other.
    pub(super) fn are_one_picture(&self, first: &[u32], second: &[u32]) -> bool {
        let is_near = first.iter().all(|id| second.iter().any(|other| self.gap(*id, *other) < PAIR_GAP));
        is_near && self.are_small(first) && self.are_small(second)
    }

    /// What stands beside some things: others, or where these are far away the one of their kind that is nearest.
    pub(super) fn beside(&self, shown: &[u32], others: &[u32]) -> Vec<u32> {
        let is_near = |id: &u32| shown.iter().any(|of| self.gap(*id, *of) < GROUP_GAP);
        let near: Vec<u32> = others.iter().copied().filter(is_near).collect();
        if !near.is_empty() {
            return near;
        }
        let kind = others
            .first()
            .and_then(|id| self.get(*id))
            .and_then(|object| object.label.split(' ').rfind(|word| !word.chars().all(|c| c.is_ascii_digit())));
        let of_kind = kind.map(|kind| self.labelled(kind)).unwrap_or_default();
        let nearest = shown.first().and_then(|of| self.nearest(&of_kind, *of));
        nearest.into_iter().filter(|id| is_near(id) && !shown.contains(id)).collect()
    }

    /// Up to three small things that stand near one, each nearer to another.
    pub(super) fn on_the_way(&self, from: u32, to: u32) -> Vec<u32> {
        let is_near = |object: &&Object| {
            object.id != from && object.id != to && self.gap(object.id, from) < PAIR_GAP && self.are_small(&[object.id])
        };
        let mut near: Vec<u32> = self.objects.iter().filter(is_near).map(|object| object.id).collect();
        near.sort_by(|a, b| self.gap_of_centers(*b, to).total_cmp(&self.gap_of_centers(*a, to)));
        near.truncate(3);
        near
    }

    /// Total size of some things.
    pub(super) fn radius(&self, ids: &[u32]) -> f64 {
        ids.iter().filter_map(|id| self.get(*id)).map(Object::radius).sum()
    }

    /// The most of some things that stand together.
    pub(super) fn together(&self, ids: &[u32]) -> Vec<u32> {
        let mut best: Vec<u32> = Vec::new();
        for seed in ids {
            let mut cluster = vec![*seed];
            let mut nth = 0;
            while let Some(&of) = cluster.get(nth) {
                let near = |id: &&u32| !cluster.contains(id) && self.gap(of, **id) < GROUP_GAP;
                let found: Vec<u32> = ids.iter().filter(near).copied().collect();
                cluster.extend(found);
                nth += 1;
            }
            if cluster.len() > best.len() {
                best = ids.iter().filter(|id| cluster.contains(id)).copied().collect();
            }
        }
        best
    }

    /// Of some things the one nearest to another.
    pub(super) fn nearest(&self, ids: &[u32], to: u32) -> Option<u32> {
        ids.iter().copied().min_by(|a, b| self.gap_of_centers(*a, to).total_cmp(&self.gap_of_centers(*b, to)))
    }

    fn gap_of_centers(&self, first: u32, second: u32) -> f64 {
        match (self.get(first), self.get(second)) {
            (Some(first), Some(second)) => (first.center - second.center).length(),
            _ => f64::INFINITY,
        }
    }

    /// Some things one by one, each followed by the nearest that is left; from the one nearest to `from`, or else from an end of
    /// the row.
    pub(super) fn in_turn(&self, ids: &[u32], from: Option<u32>) -> Vec<u32> {
        let reach = |id: &u32| ids.iter().map(|other| self.gap_of_centers(*id, *other)).fold(0.0, f64::max);
        let end = || ids.iter().copied().max_by(|a, b| reach(a).total_cmp(&reach(b)));
        let mut left = ids.to_vec();
        let mut order: Vec<u32> = Vec::new();
        let mut next = from.and_then(|from| self.nearest(ids, from)).or_else(end);
        while let Some(id) = next {
            left.retain(|other| *other != id);
            order.push(id);
            next = self.nearest(&left, id);
        }
        order
    }

    /// The things with a label that ends in one of some words.
    pub(super) fn labelled(&self, kinds: &str) -> Vec<u32> {
        let is_kind = |object: &&Object| {
            let mut words = object.label.split(' ').filter(|word| !word.chars().all(|c| c.is_ascii_digit()));
            words.any(|word| is_listed(kinds, word)) && object.parent.is_none()
        };
        self.objects.iter().filter(is_kind).map(|object| object.id).collect()
    }

    /// Of two lists the two things that are nearest to each other.
    pub(super) fn nearest_pair(&self, first: &[u32], second: &[u32]) -> Option<[u32; 2]> {
        let pairs = first.iter().flat_map(|a| second.iter().map(move |b| [*a, *b])).filter(|[a, b]| a != b);
        pairs.min_by(|a, b| self.gap_of_centers(a[0], a[1]).total_cmp(&self.gap_of_centers(b[0], b[1])))
    }

    /// The one thing of a scan.
    pub(super) fn lone(&self) -> Option<&'a Object> {
        only_whole(self.objects)
    }

    /// The part of a thing with a label of some words.
    pub(super) fn part(&self, of: u32, kinds: &str) -> Option<u32> {
        let is_part = |object: &&Object| object.parent == Some(of) && is_listed(kinds, &object.label);
        self.objects.iter().find(is_part).map(|object| object.id)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row() -> Vec<Object> {
        let at =
            |id: u32, x: f64, half: f64| Object::from_box(id, "easel", DVec3::new(x, 0.0, 0.0), DVec3::splat(half));
        vec![at(1, 0.0, 0.4), at(2, 4.0, 0.4), at(3, 2.0, 0.4), at(4, 10.0, 0.05), at(5, 10.3, 0.05)]
    }

    #[test]
    fn a_row_is_visited_from_end_to_end() {
        let objects = row();
        let things = Things::new(&objects);
        assert_eq!(things.in_turn(&[1, 2, 3], Some(4)), [2, 3, 1]);
        assert_eq!(things.in_turn(&[3, 1, 2], None).len(), 3);
        assert_ne!(things.in_turn(&[3, 1, 2], None)[0], 3);
    }

    #[test]
    fn what_is_seen_with_a_thing_stands_beside_it() {
        let at = |id: u32, label: &str, x: f64| Object::from_box(id, label, DVec3::new(x, 0.0, 0.0), DVec3::splat(0.1));
        let objects = [at(1, "armchair", 0.0), at(2, "desk lamp", 9.0), at(3, "table lamp", 0.5), at(4, "mug", 9.5)];
        let things = Things::new(&objects);
        assert_eq!(things.beside(&[1], &[2]), [3]);
        assert_eq!(things.beside(&[4], &[2]), [2]);
        assert_eq!(things.beside(&[1], &[4]), [0; 0]);
    }

    #[test]
    fn only_what_stands_together_is_one_picture() {
        let objects = row();
        let things = Things::new(&objects);
        assert_eq!(things.together(&[1, 2, 3, 4]), [1, 2, 3]);
        assert!(things.are_one_picture(&[4], &[5]));
        assert!(!things.are_one_picture(&[1], &[3]));
        assert!(things.are_small(&[4, 5]) && !things.are_small(&[1]));
    }
}
