//! Whether a thing stands on legs: a few thin pieces, wide apart, that go straight up from the ground.

use std::collections::VecDeque;

use super::sample::PatchSample;
use glam::DVec3;

/// Cells per scene size, and cells of a grid with a margin around every footprint.
const CELLS: f64 = 48.0;
const GRID: usize = 96;

/// Thickness of a slice, and the number of slices from the ground up, over the scene size.
const SLICE_FRAC: f64 = 0.03;
const NUM_SLICES: usize = 8;

/// Share of the patches below the ground: outliers.
const BELOW_FRAC: f64 = 0.004;

/// Numbers of legs.
const LEGS: std::ops::RangeInclusive<usize> = 3..=6;

/// Least share of a slice's patches in a leg, and in all of its legs.
const LEG_SHARE: f64 = 0.05;
const LEGS_SHARE: f64 = 0.9;

/// Most cells across a leg.
const LEG_CELLS: usize = 8;

/// Least distance between the outermost legs over that of the outermost patches of the whole thing.
const WIDE_FRAC: f64 = 0.4;

/// Most cells by which a leg moves from a slice to the next one.
const LEAN_CELLS: f64 = 3.0;

/// Slices up to which pieces are no legs: the tips of leaves and the corners of a frame are as wide apart.
const MIN_SLICES: usize = 3;

/// Share of the thing's lowest slices, beyond [`MIN_SLICES`], that show the same three or more legs, 0..=1.
pub(super) fn legs(sample: &PatchSample, up: DVec3) -> f64 {
    let east = up.any_orthonormal_vector();
    let north = up.cross(east);
    let points: Vec<(f64, [f64; 2])> = (sample.patches.iter())
        .map(|patch| (patch.position.dot(up), [east, north].map(|axis| patch.position.dot(axis) / sample.size)))
        .collect();
    let mut heights: Vec<f64> = points.iter().map(|(height, _)| *height).collect();
    let rank = (BELOW_FRAC * heights.len() as f64) as usize;
    if rank >= heights.len() {
        return 0.0;
    }
    let ground = *heights.select_nth_unstable_by(rank, f64::total_cmp).1;
    let width = breadth(points.iter().map(|(_, at)| *at));
    let mut below: Option<Vec<[f64; 2]>> = None;
    for slice in 0..NUM_SLICES {
        let from = ground + slice as f64 * SLICE_FRAC * sample.size;
        let within = from..from + SLICE_FRAC * sample.size;
        let slice_points: Vec<[f64; 2]> =
            points.iter().filter(|(height, _)| within.contains(height)).map(|(_, at)| *at).collect();
        let feet = feet(&slice_points, width);
        let stands = feet.filter(|feet| below.as_ref().is_none_or(|below| is_above(feet, below)));
        let Some(feet) = stands else {
            return slice.saturating_sub(MIN_SLICES) as f64 / (NUM_SLICES - MIN_SLICES) as f64;
        };
        below = Some(feet);
    }
    1.0
}

/// Longer side of the box around points, over the scene size.
fn breadth(points: impl Iterator<Item = [f64; 2]>) -> f64 {
    let empty = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];
    let [west, south, east, north] =
        points.fold(empty, |[west, south, east, north], [x, y]| [west.min(x), south.min(y), east.max(x), north.max(y)]);
    (east - west).max(north - south).max(0.0)
}

/// The middles of the legs in a slice; `None` where it is no slice through legs.
fn feet(points: &[[f64; 2]], width: f64) -> Option<Vec<[f64; 2]>> {
    let cell = |along: f64| (along * CELLS + GRID as f64 / 2.0).clamp(0.0, GRID as f64 - 1.0) as usize;
    let cell_of = |at: &[f64; 2]| cell(at[0]) * GRID + cell(at[1]);
    let mut counts = vec![0_usize; GRID * GRID];
    points.iter().for_each(|at| counts[cell_of(at)] += 1);
    let mut feet = Vec::new();
    let mut held = 0;
    for start in 0..counts.len() {
        if counts[start] == 0 {
            continue;
        }
        let piece = take_piece(&mut counts, start);
        if (piece.count as f64) < LEG_SHARE * points.len() as f64 {
            continue;
        }
        if piece.longest() > LEG_CELLS {
            return None;
        }
        held += piece.count;
        feet.push(piece.middle());
    }
    let is_all = held as f64 >= LEGS_SHARE * points.len() as f64;
    let is_wide = breadth(feet.iter().map(|foot| foot.map(|along| along / CELLS))) >= WIDE_FRAC * width;
    (LEGS.contains(&feet.len()) && is_all && is_wide && !points.is_empty()).then_some(feet)
}

/// Occupied cells that touch.
struct Piece {
    count: usize,
    sum: [f64; 2],
    low: [usize; 2],
    high: [usize; 2],
}

impl Piece {
    fn longest(&self) -> usize {
        (self.high[0] - self.low[0]).max(self.high[1] - self.low[1]) + 1
    }

    /// In cells.
    fn middle(&self) -> [f64; 2] {
        self.sum.map(|sum| sum / self.count.max(1) as f64)
    }
}

/// The cells that hang together with `start`; they are emptied.
fn take_piece(counts: &mut [usize], start: usize) -> Piece {
    let mut piece = Piece { count: 0, sum: [0.0; 2], low: [GRID; 2], high: [0; 2] };
    let mut open = VecDeque::from([start]);
    while let Some(at) = open.pop_front() {
        let count = std::mem::take(&mut counts[at]);
        if count == 0 {
            continue;
        }
        let place = [at / GRID, at % GRID];
        piece.count += count;
        for (axis, along) in place.into_iter().enumerate() {
            piece.sum[axis] += (count * along) as f64;
            piece.low[axis] = piece.low[axis].min(along);
            piece.high[axis] = piece.high[axis].max(along);
        }
        for x in place[0].saturating_sub(1)..(place[0] + 2).min(GRID) {
            open.extend((place[1].saturating_sub(1)..(place[1] + 2).min(GRID)).map(|y| x * GRID + y));
        }
    }
    piece
}

/// Whether at least three legs go on from the slice below.
fn is_above(feet: &[[f64; 2]], below: &[[f64; 2]]) -> bool {
    let near = |a: &[f64; 2], b: &[f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]) <= LEAN_CELLS;
    feet.iter().filter(|foot| below.iter().any(|other| near(foot, other))).count() >= *LEGS.start()
}

#[cfg(test)]
mod tests {
    use super::super::sample::Patch;
    use super::*;

    /// A chair of points: four legs half as long as it is high, a seat, and a back as large as the seat.
    fn chair() -> PatchSample {
        let steps = |count: i32| (0..count).map(move |i| f64::from(i) / f64::from(count - 1));
        let mut points = Vec::new();
        for (x, z) in [(0.0, 0.0), (0.0, 0.5), (0.5, 0.0), (0.5, 0.5)] {
            points.extend(steps(60).map(|t| DVec3::new(x, 0.5 * t, z)));
        }
        for (a, b) in steps(30).flat_map(|a| steps(30).map(move |b| (a, b))) {
            points.push(DVec3::new(0.5 * a, 0.5, 0.5 * b));
            points.push(DVec3::new(0.5 * a, 0.5 + 0.5 * b, 0.0));
        }
        let patches = points.into_iter().map(|position| Patch { position, normal: DVec3::ZERO, luma: 0.5 }).collect();
        PatchSample { patches, size: 1.2 }
    }

    #[test]
    fn a_chair_has_legs_only_below() {
        assert!(legs(&chair(), DVec3::Y) > 0.9);
        for other in [DVec3::NEG_Y, DVec3::X, DVec3::NEG_X, DVec3::Z, DVec3::NEG_Z] {
            assert!(legs(&chair(), other) < 0.1, "{other}");
        }
    }
}
