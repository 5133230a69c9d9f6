//! A figure of paths: views from above and from the side, and x, y, z, roll, pitch and yaw over time.

use glam::DVec3;

use super::table::table_relative_to;
use super::{Evaluation, Matches, TableRow, Trajectory};
use cinesplat_geometry::LevelFrame;
use cinesplat_plot::drawing::Drawing;
use cinesplat_plot::{Axis, COLORS, Chart, Figure, LegendEntry, LegendSymbol, Marker, Series};

const WIDTH: f64 = 1240.0;
const HEIGHT: f64 = 1010.0;
const MARGIN: f64 = 16.0;
const HEADER: f64 = 64.0;
const VIEW_HEIGHT: f64 = 410.0;
const GAP: f64 = 10.0;
const RIGHT: &str = "right of the first view, scene units";
const AHEAD: &str = "ahead of the first view, scene units";

/// The figure of paths.
///
/// `paths` are pairs of a label and a path, drawn in order. The first is the reference: its up and its first heading
/// define the views and the angles. Markers on it show the poses at `key_times_secs`.
pub fn path_figure(title: &str, paths: &[(&str, &Trajectory)], key_times_secs: &[f64]) -> Drawing {
    let mut figure = Figure::new([WIDTH, HEIGHT], title);
    figure.legend(&legend(paths));
    let Some((_, reference)) = paths.first() else { return figure.into_drawing() };
    let mut tables: Vec<Vec<TableRow>> = paths.iter().map(|(_, path)| table_relative_to(path, reference)).collect();
    unwrap_together(&mut tables);
    if let Ok(level) = LevelFrame::new(reference.up_or_mean()) {
        views(&mut figure, &level, paths, key_times_secs);
    }
    time_charts(&mut figure, &tables, reference.times_secs.is_some(), key_times_secs);
    figure.into_drawing()
}

/// The figure of the matched paths of estimates that were compared with one reference, with the same settings.
///
/// Every path stands at the times of the reference, also where a file has no times or another clock. The reference has
/// every pose that some estimate is matched with.
pub fn compared_figure(reference_name: &str, estimates: &[(&str, &Evaluation)]) -> Drawing {
    let method = match estimates {
        [(_, only)] => only.title(),
        _ => estimates.first().map_or_else(String::new, |(_, first)| first.method()),
    };
    let matches: Vec<&Matches> = estimates.iter().map(|(_, found)| &found.matches).collect();
    let reference = whole_reference(&matches);
    let shown: Vec<Trajectory> = matches.iter().map(|found| on_clock_of_reference(found)).collect();
    let estimates = estimates.iter().zip(&shown).map(|((name, _), path)| (*name, path));
    let paths: Vec<(&str, &Trajectory)> = std::iter::once((reference_name, &reference)).chain(estimates).collect();
    path_figure(&format!("{method}, against {reference_name}"), &paths, &[])
}

/// The poses of the reference that are matched with a pose of any estimate, in order of time.
fn whole_reference(matches: &[&Matches]) -> Trajectory {
    let references: Vec<Trajectory> = matches.iter().map(|found| found.reference.clone()).collect();
    // Poses without times are matched from the first on, so that the longest match has those of the others.
    let Ok(merged) = Trajectory::merged(&references) else {
        return references.into_iter().max_by_key(Trajectory::len).unwrap_or_default();
    };
    let times = merged.times_or_indices();
    let is_new = |idx: &usize| idx.checked_sub(1).is_none_or(|before| times[before] < times[*idx]);
    merged.select(&(0..times.len()).filter(is_new).collect::<Vec<_>>())
}

/// The matched estimate at the times of the reference, if one of both has no times.
fn on_clock_of_reference(matches: &Matches) -> Trajectory {
    let Matches { reference, estimate, .. } = matches;
    let have_times = reference.times_secs.is_some() && estimate.times_secs.is_some();
    let times_secs = if have_times { estimate.times_secs.clone() } else { reference.times_secs.clone() };
    Trajectory { times_secs, ..estimate.clone() }
}

/// Turns yaws and rolls by whole turns: the middle of the reference's range comes next to 0, and every other path next to
/// the reference at the nearest time, so that a turn that one path misses in a gap does not part them for good.
fn unwrap_together(tables: &mut [Vec<TableRow>]) {
    let angles: [Angle; 2] = [|row| &mut row.yaw_deg, |row| &mut row.roll_deg];
    angles.into_iter().for_each(|angle| unwrap_angle(tables, angle));
}

/// One angle of a table row.
type Angle = fn(&mut TableRow) -> &mut f64;

fn unwrap_angle(tables: &mut [Vec<TableRow>], angle: Angle) {
    let Some((reference, others)) = tables.split_first_mut() else { return };
    let angles = reference.iter_mut().map(|row| *angle(row));
    let (low, high) = angles.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
    let whole_turns = |degrees: f64| 360.0 * (degrees / 360.0).round();
    if low <= high {
        reference.iter_mut().for_each(|row| *angle(row) -= whole_turns(f64::midpoint(low, high)));
    }
    for row in others.iter_mut().flatten() {
        let after = reference.partition_point(|other| other.time_secs < row.time_secs);
        let around = [after.checked_sub(1), Some(after)].into_iter().flatten().filter_map(|idx| reference.get(idx));
        let off = |other: &&TableRow| (other.time_secs - row.time_secs).abs();
        let Some(nearest) = around.min_by(|a, b| off(a).total_cmp(&off(b))).copied() else { continue };
        let beside = *angle(&mut nearest.clone());
        *angle(row) -= whole_turns(*angle(row) - beside);
    }
}

fn legend(paths: &[(&str, &Trajectory)]) -> Vec<LegendEntry> {
    let of_path = |((label, path), color): (&(&str, &Trajectory), &&'static str)| LegendEntry {
        name: format!("{label} ({} poses)", path.len()),
        color,
        symbol: LegendSymbol::Line,
    };
    let start = LegendEntry { name: "start".to_owned(), color: "#222222", symbol: LegendSymbol::Ring };
    paths.iter().zip(COLORS.iter().cycle()).map(of_path).chain([start]).collect()
}

/// The line of one path. That of the reference is broader, so that it stays visible under an estimate on top of it.
fn path_series(path_idx: usize, points: Vec<(f64, f64)>, keys: &[usize]) -> Series {
    let markers = if path_idx == 0 { keys.iter().map(|key| Marker::dot(*key, 3.2)).collect() } else { Vec::new() };
    let line_px = if path_idx == 0 { 3.0 } else { 1.5 };
    Series { points, color: COLORS[path_idx % COLORS.len()], line_px, markers }
}

/// The views from above and from the side, each with equal units on both axes.
fn views(figure: &mut Figure, level: &LevelFrame, paths: &[(&str, &Trajectory)], key_times_secs: &[f64]) {
    let width = (WIDTH - 2.0 * MARGIN - GAP) / 2.0;
    let first = paths.first().and_then(|(_, path)| path.rotations.first()).map_or(DVec3::Z, |rotation| rotation.z_axis);
    let level = level.with_heading(first);
    // The side view shows the horizontal direction with the larger extent.
    let reach = |axis: DVec3| {
        let along = paths.iter().flat_map(|(_, path)| path.positions.iter().map(move |p| p.dot(axis)));
        let (low, high) = along.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
        high - low
    };
    let (side, side_name) =
        if reach(level.east) > reach(level.north) { (level.east, RIGHT) } else { (level.north, AHEAD) };
    let above = ("seen from above", level.east, RIGHT, level.north, AHEAD);
    let sideways = ("seen from the side", side, side_name, level.up, "height, scene units");
    for (idx, (title, across, across_name, up, up_name)) in [above, sideways].into_iter().enumerate() {
        let x = MARGIN + idx as f64 * (width + GAP);
        let mut chart = Chart::new(title, Axis::linear(across_name), Axis::linear(up_name));
        chart.has_equal_units = true;
        for (path_idx, (_, path)) in paths.iter().enumerate() {
            let points = path.positions.iter().map(|p| (p.dot(across), p.dot(up))).collect();
            let keys = nearest(&path.times_or_indices(), key_times_secs);
            let mut series = path_series(path_idx, points, &keys);
            series.markers.push(Marker { is_hollow: true, ..Marker::dot(0, 4.5) });
            chart.series.push(series);
        }
        figure.chart([x, HEADER, width, VIEW_HEIGHT], &chart);
    }
}

/// Index of the pose nearest in time to each wanted time.
fn nearest(times: &[f64], wanted: &[f64]) -> Vec<usize> {
    let closest =
        |time: &f64| (0..times.len()).min_by(|a, b| (times[*a] - time).abs().total_cmp(&(times[*b] - time).abs()));
    wanted.iter().filter_map(closest).collect()
}

/// Reads one column of a table row.
type Column = fn(&TableRow) -> f64;

fn time_charts(figure: &mut Figure, tables: &[Vec<TableRow>], timed: bool, key_times_secs: &[f64]) {
    let columns: [(&str, Column); 6] = [
        ("x, scene units", |row| row.position.x),
        ("y, scene units", |row| row.position.y),
        ("z, scene units", |row| row.position.z),
        ("roll, degrees", |row| row.roll_deg),
        ("pitch, degrees", |row| row.pitch_deg),
        ("yaw, degrees", |row| row.yaw_deg),
    ];
    let start = tables.iter().filter_map(|table| table.first()).map(|row| row.time_secs).fold(f64::INFINITY, f64::min);
    let width = (WIDTH - 2.0 * MARGIN - 2.0 * GAP) / 3.0;
    let top = HEADER + VIEW_HEIGHT + GAP;
    let height = (HEIGHT - top - GAP) / 2.0;
    for (idx, (title, value)) in columns.into_iter().enumerate() {
        let (column, row) = ((idx % 3) as f64, (idx / 3) as f64);
        // The time axis has no margins.
        let time = Axis { margin_frac: 0.0, ..Axis::linear(if timed { "time, s" } else { "frame" }) };
        let mut chart = Chart::new(title, time, Axis::linear(""));
        for (path_idx, table) in tables.iter().enumerate() {
            let points = table.iter().map(|row| (row.time_secs - start, value(row))).collect();
            let times: Vec<f64> = table.iter().map(|row| row.time_secs).collect();
            chart.series.push(path_series(path_idx, points, &nearest(&times, key_times_secs)));
        }
        figure.chart([MARGIN + column * (width + GAP), top + row * height, width, height], &chart);
    }
}
