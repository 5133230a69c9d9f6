//! Valleys between things on a wall, through which the wall is seen.
//!
//! Enters: the cells of a region of a wall, and how far each stands out from it. Leaves: the two sides of its deepest straight
//! valley, as a page is cut along its white lines (recursive XY cut, Nagy and Seth 1984).

use std::collections::BTreeMap;

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
