//! The profile of a thing: where its matter lies at every height.
//!
//! What people made to be used, and people themselves, are alike on both sides of an upright plane. At every height the
//! middle of their matter lies in that plane, and its way forward and back with height tells the front: backs of chairs
//! rise behind their seats, foreheads behind jaws, and what leans leans back.

use std::f64::consts::PI;

use cinesplat_render::RenderError;
use glam::{DVec2, DVec3};

use super::sides::{Side, Sides, solid_rows};

/// Pictures of a profile, over half a turn: from behind an outline is its mirror image.
const NUM_VIEWS: usize = 8;
/// Slices of a thing between its bottom and its top.
const NUM_SLICES: usize = 20;
/// Ratio of the spreads of the middles across the plane and along it from which a thing has no such plane.
const MOST_ACROSS: f64 = 0.5;

/// What the outlines of a thing tell. Lengths are over the thing's height.
pub(super) struct Profile {
    /// Level way from the middle of what is high to the middle of what is low.
    pub(super) lean: DVec3,
    /// Level way from the middle of what stands above the feet to the middle of the feet.
    pub(super) toes: DVec3,
    /// Level unit direction of the plane in which the middles of all heights lie, of either sign.
    pub(super) plane: DVec3,
    /// How well they lie in it, 0..=1.
    pub(super) planarity: f64,
    /// Largest width.
    pub(super) width: f64,
}

/// The matter of one height: its middle, level, and the pixels that show it.
#[derive(Clone, Copy, Default)]
struct Slice {
    middle: DVec3,
    area: f64,
}

impl Profile {
    /// The profile of a thing; `None` of what is not seen.
    pub(super) fn of(sides: &Sides<'_>) -> Result<Option<Self>, RenderError> {
        let mut views = Vec::with_capacity(NUM_VIEWS);
        for view in 0..NUM_VIEWS {
            views.extend(sides.profile_from(sides.frame.direction(PI * view as f64 / NUM_VIEWS as f64))?);
        }
        let Some(rows) = solid_rows(&views) else { return Ok(None) };
        let slices: Vec<Slice> = (0..NUM_SLICES).map(|i| slice(&views, slice_rows(rows, i), height(rows))).collect();
        let middle = |low: f64, high: f64| middle_of(&slices, low, high);
        let lean = (middle(0.3, 0.55) - middle(0.75, 1.0) + middle(0.0, 0.5) - middle(0.5, 1.0)) / 2.0;
        let toes = middle(0.0, 0.05) - middle(0.1, 0.15);
        let (direction, planarity) = plane(slices.iter().map(|slice| {
            let from = slice.middle - middle(0.0, 1.0);
            (DVec2::new(from.dot(sides.frame.north), from.dot(sides.frame.east)), slice.area)
        }));
        let plane = sides.frame.north * direction.x + sides.frame.east * direction.y;
        let widths = views.iter().map(|view| width_px(view, rows));
        let width = widths.max().unwrap_or(0) as f64 / height(rows);
        Ok(Some(Self { lean, toes, plane, planarity, width }))
    }
}

fn height([first, last]: [usize; 2]) -> f64 {
    (last + 1 - first) as f64
}

/// Rows of the slice of an index, from the bottom: at least one.
fn slice_rows([first, last]: [usize; 2], i: usize) -> std::ops::Range<usize> {
    let num_rows = last + 1 - first;
    let above = |slices: usize| last + 1 - (slices * num_rows + NUM_SLICES / 2) / NUM_SLICES;
    let start = above(i + 1).min(last);
    start..above(i).max(start + 1)
}

/// A column of a picture is a place along its right. Over directions all around, the mean of `(v . r) r` is `v / 2`.
fn slice(views: &[Side], rows: std::ops::Range<usize>, height: f64) -> Slice {
    let mut slice = Slice::default();
    for view in views {
        let columns = || rows.clone().flat_map(|y| view.solid_columns(y));
        let (sum, count) = columns().fold((0, 0), |(sum, count), x| (sum + x, count + 1));
        if count > 0 {
            let mean = sum as f64 / f64::from(count) + 0.5 - view.size()[1] as f64 / 2.0;
            slice.middle += view.right * (2.0 * mean / height / views.len() as f64);
            slice.area += f64::from(count);
        }
    }
    slice
}

/// Middle of the slices between two heights, 0..=1.
fn middle_of(slices: &[Slice], low: f64, high: f64) -> DVec3 {
    let index = |height: f64| (height * slices.len() as f64).round() as usize;
    let within = &slices[index(low)..index(high)];
    let area: f64 = within.iter().map(|slice| slice.area).sum();
    within.iter().map(|slice| slice.middle * slice.area).sum::<DVec3>() / area.max(1.0)
}

/// The direction along which weighted points about the origin spread the most, and how much less they spread across it: 1
/// for points on a line, 0 from [`MOST_ACROSS`] on.
fn plane(points: impl Iterator<Item = (DVec2, f64)>) -> (DVec2, f64) {
    let [mut xx, mut xy, mut yy] = [0.0; 3];
    for (point, weight) in points {
        xx += weight * point.x * point.x;
        xy += weight * point.x * point.y;
        yy += weight * point.y * point.y;
    }
    // Eigenvalues of the symmetric matrix (xx xy; xy yy).
    let (mean, apart) = (f64::midpoint(xx, yy), ((xx - yy) / 2.0).hypot(xy));
    let direction = DVec2::from_angle(0.5 * (2.0 * xy).atan2(xx - yy));
    let ratio = ((mean - apart).max(0.0) / (mean + apart).max(f64::MIN_POSITIVE)).sqrt();
    (direction, (1.0 - ratio / MOST_ACROSS).max(0.0))
}

/// Columns between the outermost ones that show the thing.
fn width_px(view: &Side, [first, last]: [usize; 2]) -> usize {
    let extent = |y: usize| Some(view.solid_columns(y).last()? + 1 - view.solid_columns(y).next()?);
    (first..=last).filter_map(extent).max().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_on_a_line_lie_in_a_plane_and_round_ones_in_none() {
        let way = DVec2::from_angle(0.7);
        let (direction, planarity) = plane([-2.0, 0.5, 1.0].into_iter().map(|t| (way * t, 1.0)));
        assert!(direction.perp_dot(way).abs() < 1e-6 && planarity > 0.999, "{direction} {planarity}");
        let round = (0..12).map(|i| (DVec2::from_angle(f64::from(i) * PI / 6.0), 1.0));
        assert!(plane(round).1 < 1e-6);
    }

    #[test]
    fn slices_cover_all_rows_from_the_bottom_up() {
        for rows in [[0, 95], [10, 40], [5, 9]] {
            assert_eq!(slice_rows(rows, 0).end, rows[1] + 1);
            assert_eq!(slice_rows(rows, NUM_SLICES - 1).start, rows[0]);
            assert!((0..NUM_SLICES).all(|i| !slice_rows(rows, i).is_empty()));
        }
    }
}
