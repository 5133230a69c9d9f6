//! Outlines of flat things, in the cells of the plane on which they lie.
//!
//! Enters: cells of a plane. Leaves: their components, their rectangle, and the outline that they fill.

use std::collections::{BTreeMap, BTreeSet};

/// Least share of a thing in the outline of several.
const HELD_FRAC: f32 = 0.8;

/// The first and the last cell along both axes.
pub(crate) type Rectangle = ([i32; 2], [i32; 2]);

pub(crate) fn sides((low, high): Rectangle) -> [f32; 2] {
    [0, 1].map(|axis| (high[axis] - low[axis] + 1) as f32)
}

pub(crate) fn area(rectangle: Rectangle) -> f32 {
    sides(rectangle).iter().product()
}

/// The cells in a rectangle that lie between others of their row and between others of their column: a ring becomes a
/// disc. The rim of a thing that stands on the floor is open below.
pub(crate) fn outline(keys: &[[i32; 2]], rectangle: Rectangle, stands: bool) -> Vec<[i32; 2]> {
    let spans = |axis: usize| {
        let mut spans: BTreeMap<i32, (i32, i32)> = BTreeMap::new();
        for key in keys.iter().filter(|key| is_in(**key, rectangle)) {
            let span = spans.entry(key[axis]).or_insert((key[1 - axis], key[1 - axis]));
            *span = (span.0.min(key[1 - axis]), span.1.max(key[1 - axis]));
        }
        spans
    };
    let (mut columns, rows) = (spans(0), spans(1));
    if stands {
        columns.values_mut().for_each(|span| span.0 = rectangle.0[1]);
    }
    let holds = |span: Option<&(i32, i32)>, value: i32| span.is_some_and(|span| (span.0..=span.1).contains(&value));
    let (low, high) = rectangle;
    let all = (low[0]..=high[0]).flat_map(|x| (low[1]..=high[1]).map(move |y| [x, y]));
    all.filter(|&[x, y]| holds(columns.get(&x), y) && holds(rows.get(&y), x)).collect()
}

/// Whether a cell lies in a rectangle.
pub(crate) fn is_in(key: [i32; 2], (low, high): Rectangle) -> bool {
    (0..2).all(|axis| (low[axis]..=high[axis]).contains(&key[axis]))
}

/// Whether an outline is that of several things beside each other, which cover at least `least_share` of it: the frames of
/// pictures have one color.
pub(crate) fn holds_several(outline: &[[i32; 2]], things: &[Vec<[i32; 2]>], least_share: f32) -> bool {
    let bounds = rectangle(outline);
    let is_held = |thing: &&Vec<[i32; 2]>| {
        let num_inside = thing.iter().filter(|key| is_in(**key, bounds)).count();
        num_inside as f32 >= HELD_FRAC * thing.len() as f32
    };
    let held: Vec<&Vec<[i32; 2]>> = things.iter().filter(is_held).collect();
    let of_held: BTreeSet<[i32; 2]> = held.iter().copied().flatten().copied().collect();
    let num_shared = outline.iter().filter(|key| of_held.contains(*key)).count();
    held.len() > 1 && num_shared as f32 >= least_share * outline.len() as f32
}

/// The components of some cells; those of one component are at most `reach` cells apart along both axes.
pub(crate) fn components_within(mut open: BTreeSet<[i32; 2]>, reach: i32) -> Vec<Vec<[i32; 2]>> {
    let mut components = Vec::new();
    while let Some(start) = open.pop_first() {
        let mut component = vec![start];
        let mut at = 0;
        while at < component.len() {
            let [x, y] = component[at];
            let steps = || -reach..=reach;
            let around = steps().flat_map(|dx| steps().map(move |dy| [x + dx, y + dy]));
            component.extend(around.filter(|key| open.remove(key)).collect::<Vec<_>>());
            at += 1;
        }
        components.push(component);
    }
    components
}

/// The rectangle of some cells without their outermost 2 % on every side.
pub(crate) fn rectangle(keys: &[[i32; 2]]) -> Rectangle {
    let ends = |axis: usize| {
        let mut values: Vec<i32> = keys.iter().map(|key| key[axis]).collect();
        values.sort_unstable();
        let cut = values.len() / 50;
        (values[cut], values[values.len() - 1 - cut])
    };
    let (x, y) = (ends(0), ends(1));
    ([x.0, y.0], [x.1, y.1])
}
