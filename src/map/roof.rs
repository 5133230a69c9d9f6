//! Finds a roof or ceiling that would hide a room in a view from above.

use glam::DVec3;

/// Cells along each side of the extent.
const NUM_CELLS: usize = 48;
/// Share of the cells with matter that a roof covers at least.
const MIN_COVER: f64 = 0.5;
/// Thickness of a roof over the height of the matter.
const THICKNESS_FRAC: f64 = 0.1;
/// Least height of a room over the height of the matter.
const MIN_ROOM_FRAC: f64 = 0.45;

/// A roof and the floor under it, heights along up.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Roof {
    pub(crate) height: f64,
    pub(crate) floor: f64,
}

/// Lowest and highest matter of a cell.
#[derive(Clone, Copy)]
struct Column {
    low: f64,
    high: f64,
}

/// The roof above the path; `None` where most of the extent is open to the sky, or the path runs above the roof.
/// Coordinates: right, ahead, up.
pub(crate) fn height(matter: &[DVec3], (low, high): (DVec3, DVec3), path: &[DVec3]) -> Option<Roof> {
    let mut columns: Vec<Option<Column>> = vec![None; NUM_CELLS * NUM_CELLS];
    let cell = |value: f64, axis: usize| {
        let share = (value - low[axis]) / (high[axis] - low[axis]);
        (0.0..1.0).contains(&share).then_some((share * NUM_CELLS as f64) as usize)
    };
    for point in matter.iter().filter(|point| (low.z..=high.z).contains(&point.z)) {
        let (Some(x), Some(y)) = (cell(point.x, 0), cell(point.y, 1)) else { continue };
        let column = columns[y * NUM_CELLS + x].get_or_insert(Column { low: point.z, high: point.z });
        *column = Column { low: column.low.min(point.z), high: column.high.max(point.z) };
    }
    let columns: Vec<Column> = columns.into_iter().flatten().collect();
    let floor = median(columns.iter().map(|column| column.low).collect())?;
    let top = columns.iter().map(|column| column.high).fold(f64::NEG_INFINITY, f64::max);
    let thickness = THICKNESS_FRAC * (top - floor);
    let roofed = |height: f64| {
        let below = |column: &&Column| (height - thickness..=height).contains(&column.high);
        columns.iter().filter(below).count()
    };
    let best = columns.iter().map(|column| column.high).max_by_key(|height| (roofed(*height), height.to_bits()))?;
    let is_roof = roofed(best) as f64 >= MIN_COVER * columns.len() as f64;
    let is_room = best - floor >= MIN_ROOM_FRAC * (top - floor) && top > floor;
    let lowest_camera = path.iter().map(|point| point.z).fold(f64::INFINITY, f64::min);
    let height = best - thickness;
    (is_roof && is_room && lowest_camera < height).then_some(Roof { height, floor })
}

fn median(mut values: Vec<f64>) -> Option<f64> {
    let middle = values.len() / 2;
    values.sort_unstable_by(f64::total_cmp);
    values.get(middle).copied()
}
