//! The only thing of a scan.

use super::naming;
use super::object::{Object, ObjectSet};

/// Share of the Gaussians of all objects from which on one object is what a scan shows.
const WHOLE_FRAC: f64 = 0.6;

impl ObjectSet {
    /// The thing that a scan of one thing shows, where nobody has named it yet: the only object of its size, with a
    /// description for a label. `None` for rooms, for several things, and for a thing with a name.
    pub fn unnamed_whole(&self) -> Option<&Object> {
        self.only_whole().filter(|whole| naming::is_description(&whole.label))
    }

    /// The object that holds most of the Gaussians of all objects; `None` where no one does.
    pub fn only_whole(&self) -> Option<&Object> {
        let members = self.members();
        let count = |object: &Object| members.get(&object.id).map_or(0, Vec::len);
        let labeled = self.labels.iter().filter(|label| **label > 0).count();
        let whole = self.objects.iter().filter(|object| object.parent.is_none()).max_by_key(|object| count(object))?;
        (labeled > 0 && count(whole) as f64 >= WHOLE_FRAC * labeled as f64).then_some(whole)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    fn set(labels: &[(&str, Option<u32>, usize)]) -> ObjectSet {
        let object = |(i, (label, parent, _)): (usize, &(&str, Option<u32>, usize))| Object {
            parent: *parent,
            ..Object::from_box(i as u32 + 1, label, DVec3::ZERO, DVec3::ONE)
        };
        let of = |(i, (_, _, count)): (usize, &(&str, Option<u32>, usize))| vec![i as u16 + 1; *count];
        let objects = labels.iter().enumerate().map(object).collect();
        ObjectSet { objects, labels: labels.iter().enumerate().flat_map(of).collect() }
    }

    #[test]
    fn one_thing_without_a_name_is_the_whole() {
        let found = |labels: &[(&str, Option<u32>, usize)]| set(labels).unnamed_whole().map(|object| object.id);
        assert_eq!(found(&[("large brown object", None, 10), ("base", Some(1), 60), ("top", Some(1), 30)]), Some(1));
        assert_eq!(found(&[("skull", None, 90), ("base", Some(1), 10)]), None);
        assert_eq!(found(&[("large brown object 2", None, 50), ("gray panel", None, 50)]), None);
        assert_eq!(found(&[("gray panel", None, 0)]), None);
    }
}
