//! A figure of the errors of one or several estimates: maps with the error as color, the error over time and along each
//! axis, its distribution, and the spread of relative errors over distances.

use glam::DVec3;

use super::evaluate::relative_errors;
use super::statistics::{quantile, root_mean_square};
use super::{Delta, Evaluation, Metric, PairSettings, Relation, pairs};
use cinesplat_geometry::LevelFrame;
use cinesplat_plot::drawing::Drawing;
use cinesplat_plot::{
    Axis, Bar, COLORS, Chart, ColorScale, ColoredLine, Figure, LegendEntry, LegendSymbol, Level, Series, Spread,
    significant,
};

const WIDTH: f64 = 1240.0;
const MARGIN: f64 = 16.0;
const HEADER: f64 = 64.0;
const GAP: f64 = 10.0;
/// Heights of the rows of charts, px.
const MAP_HEIGHT: f64 = 370.0;
const TIME_HEIGHT: f64 = 240.0;
const AXIS_HEIGHT: f64 = 215.0;
const SPREAD_HEIGHT: f64 = 260.0;
/// Width of the color bar with its values, px.
const COLOR_BAR_WIDTH: f64 = 110.0;
/// Width of the only map with its color bar, over that of the figure; the error over time is beside it.
const ONLY_MAP_FRAC: f64 = 0.47;
/// Most maps beside each other.
const MAX_COLUMNS: usize = 3;
/// Bars of the histogram.
const NUM_BARS: usize = 40;
/// Distances of relative errors over the length of the reference.
const DISTANCES: [f64; 5] = [0.1, 0.2, 0.3, 0.4, 0.5];
/// Most characters of a name beside the statistics along an axis.
const MAX_NAME_CHARS: usize = 34;
/// Digits of statistics in a figure.
const DIGITS: usize = 4;

/// A name and its comparison with the common reference.
type Named<'a> = (&'a str, &'a Evaluation);

/// The figure of the errors of estimates that were compared with one reference, with the same settings.
pub fn error_figure(reference_name: &str, estimates: &[Named]) -> Drawing {
    // The number of errors of each estimate is in the legend.
    let title = estimates
        .first()
        .map_or_else(String::new, |(_, first)| format!("{}, against {reference_name}", first.method()));
    let num_map_rows = estimates.len().div_ceil(MAX_COLUMNS);
    let is_absolute = estimates.iter().all(|(_, found)| found.settings.metric == Metric::Ape);
    let axis_height = if is_absolute { AXIS_HEIGHT } else { 0.0 };
    let is_alone = estimates.len() == 1;
    let time_height = if is_alone { 0.0 } else { TIME_HEIGHT };
    let height = HEADER + num_map_rows as f64 * MAP_HEIGHT + time_height + axis_height + SPREAD_HEIGHT;
    let mut figure = Figure::new([WIDTH, height], &title);
    figure.legend(&legend(reference_name, estimates));
    let maps_width = if is_alone { ONLY_MAP_FRAC * WIDTH } else { WIDTH };
    maps(&mut figure, estimates, maps_width);
    let mut top = HEADER + num_map_rows as f64 * MAP_HEIGHT;
    let time_area = if is_alone {
        [maps_width + GAP, HEADER, WIDTH - MARGIN - GAP - maps_width, MAP_HEIGHT]
    } else {
        [MARGIN, top, WIDTH - 2.0 * MARGIN, TIME_HEIGHT]
    };
    figure.chart(time_area, &over_time(estimates));
    top += time_height;
    if is_absolute {
        thirds(&mut figure, top, AXIS_HEIGHT, &along_axes(estimates));
        top += AXIS_HEIGHT;
    }
    let spreads = [
        histogram(estimates),
        over_distances("relative error of the position", Relation::Trans, estimates),
        over_distances("relative error of the rotation", Relation::AngleDeg, estimates),
    ];
    thirds(&mut figure, top, SPREAD_HEIGHT, &spreads);
    figure.into_drawing()
}

fn color(idx: usize) -> &'static str {
    COLORS[1 + idx % (COLORS.len() - 1)]
}

fn legend(reference_name: &str, estimates: &[Named]) -> Vec<LegendEntry> {
    let entry = |name: String, color| LegendEntry { name, color, symbol: LegendSymbol::Line };
    let of_estimate =
        |(idx, (name, found)): (usize, &Named)| entry(format!("{name} ({} errors)", found.errors.len()), color(idx));
    let reference = entry(reference_name.to_owned(), COLORS[0]);
    std::iter::once(reference).chain(estimates.iter().enumerate().map(of_estimate)).collect()
}

fn thirds(figure: &mut Figure, top: f64, height: f64, charts: &[Chart; 3]) {
    let width = (WIDTH - 2.0 * MARGIN - 2.0 * GAP) / 3.0;
    for (idx, chart) in charts.iter().enumerate() {
        figure.chart([MARGIN + idx as f64 * (width + GAP), top, width, height], chart);
    }
}

/// Horizontal directions of the map with their names: from above where up is known, else the two axes along which the
/// reference extends most.
fn map_axes(found: &Evaluation) -> [(DVec3, String); 2] {
    let reference = &found.matches.reference;
    if let Some(level) = reference.up.and_then(|up| LevelFrame::new(up).ok()) {
        let first = reference.rotations.first().map_or(DVec3::Z, |rotation| rotation.z_axis);
        let level = level.with_heading(first);
        let name = |what: &str| format!("{what} of the first view, scene units");
        return [(level.east, name("right")), (level.north, name("ahead"))];
    }
    let extent = |axis: DVec3| {
        let along = reference.positions.iter().map(|p| p.dot(axis));
        let (low, high) = along.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
        high - low
    };
    let mut axes = [(DVec3::X, "x"), (DVec3::Y, "y"), (DVec3::Z, "z")];
    axes.sort_by(|a, b| extent(b.0).total_cmp(&extent(a.0)));
    let mut largest = [axes[0], axes[1]];
    largest.sort_by(|a, b| a.1.cmp(b.1));
    largest.map(|(axis, name)| (axis, format!("{name}, scene units")))
}

/// Draws a map per estimate and the color bar, in the left part of the figure of this width.
fn maps(figure: &mut Figure, estimates: &[Named], total_width: f64) {
    let errors = || estimates.iter().flat_map(|(_, found)| found.errors.iter().copied());
    let range = errors().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), e| (low.min(e), high.max(e)));
    let Some((_, first)) = estimates.first() else { return };
    let scale = ColorScale { range };
    let columns = estimates.len().clamp(1, MAX_COLUMNS) as f64;
    let width = (total_width - 2.0 * MARGIN - COLOR_BAR_WIDTH - GAP * columns) / columns;
    let [across, up] = map_axes(first);
    for (idx, (name, found)) in estimates.iter().enumerate() {
        let mut chart = Chart::new(name, Axis::linear(&across.1), Axis::linear(&up.1));
        chart.has_equal_units = true;
        let flat = |p: &DVec3| (p.dot(across.0), p.dot(up.0));
        let matches = &found.matches;
        let points = matches.reference.positions.iter().map(flat).collect();
        chart.series.push(Series { points, color: COLORS[0], line_px: 1.2, markers: Vec::new() });
        let (points, values) = located_errors(found).map(|(at, error)| (flat(&at), error)).unzip();
        chart.colored.push(ColoredLine { points, values, scale, line_px: 3.0 });
        let (column, row) = ((idx % MAX_COLUMNS) as f64, (idx / MAX_COLUMNS) as f64);
        let corner = [MARGIN + column * (width + GAP), HEADER + row * MAP_HEIGHT];
        figure.chart([corner[0], corner[1], width, MAP_HEIGHT], &chart);
    }
    let area = [total_width - MARGIN - COLOR_BAR_WIDTH + 20.0, HEADER + 24.0, 16.0, MAP_HEIGHT - 64.0];
    figure.color_bar(area, first.settings.relation.name_with_unit(), &scale);
}

/// Each error with the position of its (later) pose on the aligned estimate.
fn located_errors(found: &Evaluation) -> impl Iterator<Item = (DVec3, f64)> {
    let of_pose = |(pose, error): (&usize, &f64)| Some((*found.matches.estimate.positions.get(*pose)?, *error));
    found.pose_idx.iter().zip(&found.errors).filter_map(of_pose)
}

/// Seconds since the first pose of the reference, or indices of poses.
fn since_start(found: &Evaluation, times: &[f64]) -> Vec<f64> {
    let start = found.matches.reference.times_or_indices().first().copied().unwrap_or(0.0);
    times.iter().map(|time| time - start).collect()
}

fn time_axis(estimates: &[Named]) -> Axis {
    let timed = estimates.iter().all(|(_, found)| found.matches.reference.times_secs.is_some());
    Axis { margin_frac: 0.0, ..Axis::linear(if timed { "time, s" } else { "pose" }) }
}

fn over_time(estimates: &[Named]) -> Chart {
    let unit = estimates.first().map_or("", |(_, first)| first.settings.relation.name_with_unit());
    let mut chart = Chart::new("error over time", time_axis(estimates), Axis::linear(unit));
    for (idx, (name, found)) in estimates.iter().enumerate() {
        let points = since_start(found, &found.at_secs).into_iter().zip(found.errors.iter().copied()).collect();
        chart.series.push(Series { points, color: color(idx), line_px: 1.4, markers: Vec::new() });
        let show = |value: f64| significant(value, DIGITS);
        let s = &found.statistics;
        let numbers = [("rmse", s.rmse), ("mean", s.mean), ("median", s.median), ("std", s.std), ("max", s.max)];
        let numbers = numbers.map(|(name, value)| format!("{name} {}", show(value))).join(", ");
        chart.notes.push(if estimates.len() == 1 { numbers } else { format!("{name}: {numbers}") });
        if estimates.len() == 1 {
            for (name, y, color, other) in
                [("rmse", s.rmse, COLORS[7], s.median), ("median", s.median, COLORS[2], s.rmse)]
            {
                chart.levels.push(Level { y, name: name.to_owned(), is_name_below: y < other, color });
            }
        }
    }
    chart
}

/// The signed errors of the position along each axis, over time.
fn along_axes(estimates: &[Named]) -> [Chart; 3] {
    let up = estimates.first().and_then(|(_, first)| first.matches.reference.up);
    let axes: [(DVec3, &str); 3] = match up.and_then(|up| LevelFrame::new(up).ok()).zip(estimates.first()) {
        Some((level, (_, first))) => {
            let view = first.matches.reference.rotations.first().map_or(DVec3::Z, |rotation| rotation.z_axis);
            let level = level.with_heading(view);
            [(level.east, "error to the right"), (level.north, "error ahead"), (level.up, "error of the height")]
        }
        None => [(DVec3::X, "error of x"), (DVec3::Y, "error of y"), (DVec3::Z, "error of z")],
    };
    axes.map(|(axis, name)| {
        let mut chart = Chart::new(name, time_axis(estimates), Axis::linear("scene units"));
        for (idx, (name, found)) in estimates.iter().enumerate() {
            let (reference, estimate) = (&found.matches.reference, &found.matches.estimate);
            let off = reference.positions.iter().zip(&estimate.positions).map(|(a, b)| (*b - *a).dot(axis));
            let off: Vec<f64> = off.collect();
            let rmse = root_mean_square(&off);
            let mean = off.iter().sum::<f64>() / off.len() as f64;
            // An alignment makes the mean 0 up to rounding.
            let mean = if mean.abs() < 1e-9 * rmse { 0.0 } else { mean };
            let numbers = format!("rmse {}, mean {}", significant(rmse, 3), significant(mean, 3));
            chart.notes.push(if estimates.len() == 1 { numbers } else { format!("{}: {numbers}", shortened(name)) });
            let points = since_start(found, &reference.times_or_indices()).into_iter().zip(off).collect();
            chart.series.push(Series { points, color: color(idx), line_px: 1.2, markers: Vec::new() });
        }
        chart.levels.push(Level { y: 0.0, name: String::new(), is_name_below: false, color: COLORS[0] });
        chart
    })
}

/// A name without its middle if it is long: the names of several estimates often begin alike.
fn shortened(name: &str) -> String {
    let num_chars = name.chars().count();
    if num_chars <= MAX_NAME_CHARS {
        return name.to_owned();
    }
    let kept = (MAX_NAME_CHARS - 2) / 2;
    let (head, tail) = (name.chars().take(kept), name.chars().skip(num_chars - kept));
    head.chain("..".chars()).chain(tail).collect()
}

fn histogram(estimates: &[Named]) -> Chart {
    let unit = estimates.first().map_or("", |(_, first)| first.settings.relation.name_with_unit());
    let mut chart = Chart::new("distribution", Axis::linear(unit), Axis::linear("% of the errors"));
    let highest = estimates.iter().map(|(_, found)| found.statistics.max).fold(0.0, f64::max);
    let width = if highest > 0.0 { highest / NUM_BARS as f64 } else { 1.0 };
    for (idx, (_, found)) in estimates.iter().enumerate() {
        let mut counts = [0_usize; NUM_BARS];
        for error in &found.errors {
            counts[((error / width) as usize).min(NUM_BARS - 1)] += 1;
        }
        let bar = |(at, count): (usize, usize)| Bar {
            sides: (at as f64 * width, (at + 1) as f64 * width),
            height: 100.0 * count as f64 / found.errors.len() as f64,
            color: color(idx),
        };
        chart.bars.extend(counts.into_iter().enumerate().filter(|(_, count)| *count > 0).map(bar));
    }
    chart
}

/// The spread of relative errors over distances along the reference: the same distances for all estimates, of which the
/// one that covers the shortest part of the reference has the longest.
fn over_distances(title: &str, relation: Relation, estimates: &[Named]) -> Chart {
    let x = Axis::linear("distance along the reference, scene units (box 25-75 %, whiskers 5-95 %)");
    let mut chart = Chart::new(title, x, Axis::linear(relation.unit()));
    let shift = |idx: usize| (idx as f64 + 0.5) / estimates.len() as f64 - 0.5;
    let lengths = estimates.iter().map(|(_, found)| found.matches.reference.path_length());
    let length = lengths.filter(|length| *length > 0.0).fold(f64::INFINITY, f64::min);
    let slot = 0.07 * length;
    for (idx, (_, found)) in estimates.iter().enumerate() {
        for share in DISTANCES.into_iter().filter(|_| length.is_finite()) {
            let choice =
                PairSettings { delta: Delta::Distance(share * length), all_pairs: true, ..PairSettings::default() };
            // A path without pairs at this distance has no box.
            let Ok(found_pairs) = pairs(&found.matches.reference, &choice) else { continue };
            let (mut errors, _) = relative_errors(&found.matches, &found_pairs, relation, &mut Vec::new());
            errors.sort_by(f64::total_cmp);
            chart.spreads.push(Spread {
                x: share * length + shift(idx) * slot,
                width: 0.8 * slot / estimates.len() as f64,
                quartiles: [0.05, 0.25, 0.5, 0.75, 0.95].map(|fraction| quantile(&errors, fraction)),
                color: color(idx),
            });
        }
    }
    if chart.spreads.is_empty() {
        chart.notes.push("the reference is stationary".to_owned());
    }
    chart
}
