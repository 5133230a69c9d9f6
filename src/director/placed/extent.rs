//! Where objects are, and how their boxes lie to one another.

use cinesplat_objects::Object;
use glam::DVec3;

/// Where the objects of a scene are.
#[derive(Debug, Clone, Copy)]
pub struct Places<'a> {
    /// The objects.
    pub objects: &'a [Object],
    /// Up direction of the world.
    pub up: DVec3,
}

/// How a thing lies to the one that places it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Relation {
    Near,
    Under,
    Above,
    On,
}

/// The box of an object: two level axes and the one that points up.
#[derive(Debug, Clone, Copy)]
pub(super) struct Extent {
    low: [f64; 3],
    high: [f64; 3],
}

impl Extent {
    fn of(object: &Object, up: DVec3) -> Self {
        Self::of_points(object.corners(), up)
    }

    /// That of all objects together.
    fn of_all(places: Places<'_>) -> Self {
        Self::of_points(places.objects.iter().flat_map(Object::corners), places.up)
    }

    fn of_points(points: impl IntoIterator<Item = DVec3>, up: DVec3) -> Self {
        let (right, ahead) = up.any_orthonormal_pair();
        let mut extent = Self { low: [f64::INFINITY; 3], high: [f64::NEG_INFINITY; 3] };
        for corner in points {
            for (at, axis) in [right, ahead, up].into_iter().enumerate() {
                extent.low[at] = extent.low[at].min(corner.dot(axis));
                extent.high[at] = extent.high[at].max(corner.dot(axis));
            }
        }
        extent
    }

    fn middle(&self, axis: usize) -> f64 {
        f64::midpoint(self.low[axis], self.high[axis])
    }

    /// Distance of two boxes along some axes.
    fn gap(&self, other: &Self, axes: std::ops::Range<usize>) -> f64 {
        axes.map(|axis| (self.low[axis] - other.high[axis]).max(other.low[axis] - self.high[axis]).max(0.0).powi(2))
            .sum::<f64>()
            .sqrt()
    }

    /// Level distance of two middles.
    fn aside(&self, other: &Self) -> f64 {
        (0..2).map(|axis| (self.middle(axis) - other.middle(axis)).powi(2)).sum::<f64>().sqrt()
    }

    fn width(&self) -> f64 {
        (0..2).map(|axis| self.high[axis] - self.low[axis]).fold(0.0, f64::max)
    }

    /// How badly this box lies so to another one; `None` where it does not.
    fn misfit(&self, relation: Relation, other: &Self) -> Option<f64> {
        let is_higher = self.middle(2) > other.middle(2);
        match relation {
            Relation::Near => Some(self.gap(other, 0..3) + 0.01 * self.aside(other)),
            Relation::Under => (!is_higher).then(|| self.gap(other, 0..2) + 0.1 * self.aside(other)),
            Relation::Above => is_higher.then(|| self.gap(other, 0..2) + 0.1 * self.aside(other)),
            Relation::On => is_higher.then(|| self.gap(other, 0..3) + 0.01 * self.aside(other)),
        }
    }
}

/// Least distance of a thing above the place over which it hangs, over its height, and most beside it, over both radii.
const OVER_FRAC: f64 = -0.2;
const ASIDE_FRAC: f64 = 0.5;

/// Whether a thing hangs over another one.
pub(crate) fn hangs_over(places: Places<'_>, thing: u32, place: u32) -> bool {
    let find = |id: u32| places.objects.iter().find(|object| object.id == id);
    let (Some(thing), Some(place)) = (find(thing), find(place)) else { return false };
    let (own, other) = (Extent::of(thing, places.up), Extent::of(place, places.up));
    let is_above = own.low[2] - other.high[2] > OVER_FRAC * (own.high[2] - own.low[2]);
    is_above && own.aside(&other) < ASIDE_FRAC * (thing.radius() + place.radius())
}

/// The thing that is nearest to a corner of all that there is.
pub(super) fn cornermost(places: Places<'_>, ids: &[u32]) -> Option<u32> {
    let all = Extent::of_all(places);
    let to_corner = |id: &u32| {
        let extent = box_of(places, *id)?;
        let to_wall = |axis: usize| (extent.middle(axis) - all.low[axis]).min(all.high[axis] - extent.middle(axis));
        Some((to_wall(0).powi(2) + to_wall(1).powi(2), *id))
    };
    ids.iter().filter_map(to_corner).min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, id)| id)
}

/// The largest thing on the floor, or the one nearest to it.
pub(super) fn lowest(places: Places<'_>, ids: &[u32]) -> Option<u32> {
    let all = Extent::of_all(places);
    let boxes = ids.iter().filter_map(|id| Some((*id, box_of(places, *id)?)));
    let (on_floor, above): (Vec<_>, Vec<_>) =
        boxes.partition(|(_, own)| own.low[2] - all.low[2] < ON_FLOOR_FRAC * (all.high[2] - all.low[2]));
    let size = |own: &Extent| (0..3).map(|axis| own.high[axis] - own.low[axis]).sum::<f64>();
    let largest = on_floor.iter().max_by(|a, b| size(&a.1).total_cmp(&size(&b.1)));
    largest.or_else(|| above.iter().min_by(|a, b| a.1.low[2].total_cmp(&b.1.low[2]))).map(|(id, _)| *id)
}

/// Height of the foot of a thing on the floor, of that of the scene.
const ON_FLOOR_FRAC: f64 = 0.06;

/// How badly a thing lies so to the one of others to which it does best, and the width of that; `None` where it does not.
pub(super) fn fit(places: Places<'_>, id: u32, relation: Relation, others: &[Extent]) -> Option<(f64, f64)> {
    let own = box_of(places, id)?;
    let fits = others.iter().filter_map(|other| Some((own.misfit(relation, other)?, other.width())));
    fits.min_by(|a, b| a.0.total_cmp(&b.0))
}

/// The boxes of objects.
pub(super) fn boxes(places: Places<'_>, ids: &[u32]) -> Vec<Extent> {
    ids.iter().filter_map(|id| box_of(places, *id)).collect()
}

fn box_of(places: Places<'_>, id: u32) -> Option<Extent> {
    let object = places.objects.iter().find(|object| object.id == id)?;
    Some(Extent::of(object, places.up))
}
