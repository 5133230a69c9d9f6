//! Where a region of a wall is cut into two things: along valleys, through which the wall is seen, and at steps of its outline.
//!
//! Enters: the cells of a region of a wall, and how far each stands out from it. Leaves: the two sides of its deepest straight
//! valley, or of the line that leaves two rectangles, as a page is cut along its white lines (recursive XY cut, Nagy and Seth 1984).

use std::collections::BTreeMap;

use super::outlines::{area, rectangle, sides};

/// Least share of its rectangle that a region saves where it is cut into two, and the same where both sides fill their own
/// rectangles: two pictures that touch. A disc saves .04 at most, and no side fills its own.
const MIN_SAVED: f32 = 0.14;
const MIN_SAVED_BY_RECTANGLES: f32 = 0.04;
const RECTANGLE_FILL: f32 = 0.93;

/// Least width of a side of the cut, cells.
const MIN_SIDE: f32 = 4.0;

/// The two sides of a region with a straight valley across, in which it stands out from the wall far less than on
/// both sides: at most `max_valley` times as far as on the lower side. `low` and `high` are the first and the last cell along
/// both axes.
pub(crate) fn cut(
    keys: &[[i32; 2]],
    (low, high): ([i32; 2], [i32; 2]),
    heights: &BTreeMap<[i32; 2], f32>,
    max_valley: f32,
) -> Option<[Vec<[i32; 2]>; 2]> {
    let lowest_of = |axis: usize| {
        // Lines without voxels have the height of the line before.
        let mut profile: Vec<f32> = Vec::new();
        for line in low[axis]..=high[axis] {
            let key = |at: i32| if axis == 0 { [line, at] } else { [at, line] };
            let across = low[1 - axis]..=high[1 - axis];
            let present: Vec<f32> = across.clone().filter_map(|at| heights.get(&key(at))).copied().collect();
            let is_full = present.len() * 2 >= across.count();
            let mean = present.iter().sum::<f32>() / present.len().max(1) as f32;
            profile.push(if is_full { mean } else { profile.last().copied().unwrap_or(0.0).max(mean) });
        }
        let mut highest_after = profile.clone();
        for i in (1..profile.len()).rev() {
            highest_after[i - 1] = highest_after[i - 1].max(highest_after[i]);
        }
        let mut before = 0.0_f32;
        let depths = profile.iter().zip(&highest_after).enumerate().map(|(i, (&height, &after))| {
            before = before.max(height);
            (height / before.min(after).max(f32::MIN_POSITIVE), axis, low[axis] + i as i32)
        });
        depths.min_by(|a, b| a.0.total_cmp(&b.0).then(a.2.cmp(&b.2)))
    };
    let lowest = (0..2).filter_map(lowest_of).min_by(|a, b| a.0.total_cmp(&b.0));
    let (_, axis, line) = lowest.filter(|&(depth, ..)| depth <= max_valley)?;
    let apart = keys.iter().copied().filter(|key| key[axis] != line);
    let (one, two): (Vec<_>, Vec<_>) = apart.partition(|key| key[axis] < line);
    Some([one, two])
}

/// The two sides of an outline that is no rectangle, but nearly two of them, at the line that leaves the smallest ones.
pub(crate) fn cut_at_step(outline: &[[i32; 2]], (low, high): ([i32; 2], [i32; 2])) -> Option<[Vec<[i32; 2]>; 2]> {
    let at = |axis: usize, line: i32| -> [Vec<[i32; 2]>; 2] {
        let (one, two): (Vec<_>, Vec<_>) = outline.iter().copied().partition(|key| key[axis] < line);
        [one, two]
    };
    let whole = area((low, high));
    let saved = |(axis, line): (usize, i32)| {
        let parts = at(axis, line);
        if parts.iter().any(Vec::is_empty) {
            return None;
        }
        let bounds = [rectangle(&parts[0]), rectangle(&parts[1])];
        let is_wide = bounds.iter().all(|&bounds| sides(bounds).into_iter().all(|side| side >= MIN_SIDE));
        let saved = 1.0 - (area(bounds[0]) + area(bounds[1])) / whole;
        let is_full = (0..2).all(|part| parts[part].len() as f32 >= RECTANGLE_FILL * area(bounds[part]));
        let least = if is_full { MIN_SAVED_BY_RECTANGLES } else { MIN_SAVED };
        (is_wide && saved >= least).then_some((saved, axis, line))
    };
    let lines = (0..2).flat_map(|axis| (low[axis] + 1..=high[axis]).map(move |line| (axis, line)));
    let best = lines.filter_map(saved).max_by(|a, b| a.0.total_cmp(&b.0).then((b.1, b.2).cmp(&(a.1, a.2))))?;
    Some(at(best.1, best.2))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The cells of a rectangle, from its first corner up to but without its second.
    fn filled([x, y]: [i32; 2], [end_x, end_y]: [i32; 2]) -> Vec<[i32; 2]> {
        (x..end_x).flat_map(|x| (y..end_y).map(move |y| [x, y])).collect()
    }

    /// Two pictures whose frames touch were one thing.
    #[test]
    fn two_rectangles_that_touch_are_cut_and_a_disc_is_not() {
        let mut pictures = filled([0, 0], [40, 26]);
        pictures.extend(filled([40, 4], [60, 22]));
        let [one, two] = cut_at_step(&pictures, rectangle(&pictures)).unwrap();
        // Rectangles leave out their outermost cells, so that the line may lie one cell beside the frames.
        assert!(one.len().abs_diff(40 * 26) <= 26 && two.len().abs_diff(20 * 18) <= 26, "{} {}", one.len(), two.len());
        let disc: Vec<[i32; 2]> =
            filled([-14, -14], [15, 15]).into_iter().filter(|[x, y]| x * x + y * y <= 196).collect();
        assert_eq!(cut_at_step(&disc, rectangle(&disc)), None);
        let door = filled([0, 0], [30, 70]);
        assert_eq!(cut_at_step(&door, rectangle(&door)), None);
    }
}
