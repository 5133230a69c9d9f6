//! The only thing of a scan.

use super::naming;
use super::object::{Object, ObjectSet};

/// Share of the Gaussians of all objects from which on one object is what a scan shows.
const WHOLE_FRAC: f64 = 0.6;
/// Size of the others, of its own, up to which a thing is the only one where nobody has counted Gaussians.
const SMALL_FRAC: f64 = 0.5;
/// Most other things with a name of their own: a table with many things on it is none of its own.
const MOST_NAMED: usize = 2;

/// The thing that a scan of one thing shows: what holds most of the Gaussians, or is far larger than all others. What else there
/// is are its parts, crumbs of its ground, and at most two things with a name. `None` for rooms and for several things.
pub fn only_whole(objects: &[Object]) -> Option<&Object> {
    let roots = || objects.iter().filter(|object| object.parent.is_none());
    let total: usize = roots().map(|object| object.num_gaussians).sum();
    let whole = if total > 0 {
        let most = roots().max_by_key(|object| object.num_gaussians)?;
        Some(most).filter(|most| most.num_gaussians as f64 >= WHOLE_FRAC * total as f64)
    } else {
        let largest = roots().max_by(|a, b| a.radius().total_cmp(&b.radius()))?;
        let is_far_smaller = |other: &Object| other.id == largest.id || other.radius() < SMALL_FRAC * largest.radius();
        Some(largest).filter(|_| roots().all(is_far_smaller))
    }?;
    let is_named = |other: &&Object| other.id != whole.id && !naming::is_description(&other.label);
    (roots().filter(is_named).count() <= MOST_NAMED).then_some(whole)
}

impl ObjectSet {
    /// The thing that a scan of one thing shows, where nobody has named it yet: the only object of its size, with a
    /// description for a label. `None` for rooms, for several things, and for a thing with a name.
    pub fn unnamed_whole(&self) -> Option<&Object> {
        self.only_whole().filter(|whole| naming::is_description(&whole.label))
    }

    /// The only thing of a scan ([`only_whole`]).
    pub fn only_whole(&self) -> Option<&Object> {
        only_whole(&self.objects)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    fn set(labels: &[(&str, Option<u32>, usize)]) -> ObjectSet {
        let object = |(i, (label, parent, count)): (usize, &(&str, Option<u32>, usize))| Object {
            parent: *parent,
            num_gaussians: *count,
            ..Object::from_box(i as u32 + 1, label, DVec3::ZERO, DVec3::ONE)
        };
        ObjectSet { objects: labels.iter().enumerate().map(object).collect(), labels: Vec::new() }
    }

    #[test]
    fn one_thing_without_a_name_is_the_whole() {
        let found = |labels: &[(&str, Option<u32>, usize)]| set(labels).unnamed_whole().map(|object| object.id);
        assert_eq!(found(&[("large brown object", None, 90), ("base", Some(1), 60), ("top", Some(1), 30)]), Some(1));
        assert_eq!(found(&[("large brown object", None, 74), ("gray object", None, 26)]), Some(1));
        assert_eq!(found(&[("skull", None, 90), ("base", Some(1), 10)]), None);
        assert_eq!(found(&[("large brown object 2", None, 50), ("gray panel", None, 50)]), None);
    }

    #[test]
    fn a_table_with_named_things_on_it_is_not_the_only_thing() {
        let found = |labels: &[(&str, Option<u32>, usize)]| set(labels).only_whole().map(|object| object.id);
        assert_eq!(found(&[("table", None, 90), ("mug", None, 4), ("lamp", None, 4), ("book", None, 2)]), None);
        assert_eq!(found(&[("statue", None, 90), ("plinth", None, 6), ("sign", None, 4)]), Some(1));
        // Where nobody has counted Gaussians, sizes tell.
        assert_eq!(found(&[("statue", None, 0), ("lamp", None, 0)]), None);
    }
}
