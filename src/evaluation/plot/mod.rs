//! A figure of paths as SVG: from above, from the side, and x y z roll pitch yaw over time.

mod chart;
mod curve;
mod ticks;

use std::fmt::Write as _;

use glam::DVec3;

use self::chart::{Chart, Series};
pub use self::curve::curve_svg;
use super::table::table_beside;
use super::{TableRow, Trajectory};
use crate::geometry::LevelFrame;

const WIDTH: f64 = 1240.0;
const HEIGHT: f64 = 1010.0;
const MARGIN: f64 = 24.0;
const HEADER: f64 = 64.0;
const VIEW_HEIGHT: f64 = 400.0;
const GAP: f64 = 18.0;
/// Colors that people with any kind of color vision tell apart (Okabe and Ito), the first for the reference.
const COLORS: [&str; 6] = ["#888888", "#d55e00", "#0072b2", "#009e73", "#cc79a7", "#e69f00"];

/// The figure as SVG text.
///
/// `paths` are drawn in this order with their labels; the first is the reference: its up and first heading give the side
/// view and the angles. `key_times_secs` are marked on the first path.
pub fn plot_svg(title: &str, paths: &[(&str, &Trajectory)], key_times_secs: &[f64]) -> String {
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{WIDTH}\" height=\"{HEIGHT}\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" \
         font-family=\"DejaVu Sans, Helvetica, Arial, sans-serif\" font-size=\"12\" fill=\"#222222\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
    );
    legend(&mut svg, title, paths);
    let Some((_, reference)) = paths.first() else { return svg + "</svg>\n" };
    let tables: Vec<Vec<TableRow>> = paths.iter().map(|(_, path)| table_beside(path, reference)).collect();
    if let Ok(level) = LevelFrame::new(reference.up_or_mean()) {
        views(&mut svg, &level, paths, key_times_secs);
    }
    time_charts(&mut svg, &tables, reference.times_secs.is_some(), key_times_secs);
    svg.push_str("</svg>\n");
    svg
}

fn legend(svg: &mut String, title: &str, paths: &[(&str, &Trajectory)]) {
    let _ =
        writeln!(svg, "<text x=\"{MARGIN}\" y=\"28\" font-size=\"17\" font-weight=\"bold\">{}</text>", escaped(title));
    let mut x = MARGIN;
    for ((label, path), color) in paths.iter().zip(COLORS.iter().cycle()) {
        let text = format!("{} ({} poses)", escaped(label), path.len());
        let _ = writeln!(
            svg,
            "<line x1=\"{x}\" y1=\"48\" x2=\"{}\" y2=\"48\" stroke=\"{color}\" stroke-width=\"3\"/>\
             <text x=\"{}\" y=\"52\">{text}</text>",
            x + 28.0,
            x + 34.0
        );
        x += 60.0 + 7.0 * text.chars().count() as f64;
    }
    let _ = writeln!(
        svg,
        "<circle cx=\"{x}\" cy=\"48\" r=\"4.5\" fill=\"white\" stroke=\"#222222\" stroke-width=\"1.5\"/><text x=\"{}\" y=\"52\">start</text>",
        x + 10.0
    );
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// From above and from the side, at one scale for both directions of each.
fn views(svg: &mut String, level: &LevelFrame, paths: &[(&str, &Trajectory)], key_times_secs: &[f64]) {
    let width = (WIDTH - 2.0 * MARGIN - GAP) / 2.0;
    let first = paths.first().and_then(|(_, path)| path.rotations.first()).map_or(DVec3::Z, |rotation| rotation.z_axis);
    let level = level.with_heading(first);
    // The side view looks across the level direction in which the paths reach farthest.
    let reach = |axis: DVec3| {
        let along = paths.iter().flat_map(|(_, path)| path.positions.iter().map(move |p| p.dot(axis)));
        let (low, high) = along.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
        high - low
    };
    let (side, side_name) = if reach(level.east) > reach(level.north) {
        (level.east, "right of the first view")
    } else {
        (level.north, "ahead of the first view")
    };
    let above = ("seen from above", level.east, "right of the first view", level.north, "ahead of the first view");
    let sideways = ("seen from the side", side, side_name, level.up, "height");
    for (idx, (title, across, across_name, up, up_name)) in [above, sideways].into_iter().enumerate() {
        let x = MARGIN + idx as f64 * (width + GAP);
        let mut chart = Chart::new([x, HEADER + 12.0, width, VIEW_HEIGHT], title);
        chart.equal_axes = true;
        across_name.clone_into(&mut chart.x_name);
        up_name.clone_into(&mut chart.y_name);
        for ((_, path), color) in paths.iter().zip(COLORS.iter().cycle()) {
            let points = path.positions.iter().map(|p| (p.dot(across), p.dot(up))).collect();
            let keys =
                if chart.series.is_empty() { nearest(&path.times_or_indices(), key_times_secs) } else { Vec::new() };
            chart.series.push(Series { points, color, keys, marks_start: true });
        }
        chart.draw(svg);
    }
}

/// Index of the pose nearest to each time.
fn nearest(times: &[f64], wanted: &[f64]) -> Vec<usize> {
    let closest =
        |time: &f64| (0..times.len()).min_by(|a, b| (times[*a] - time).abs().total_cmp(&(times[*b] - time).abs()));
    wanted.iter().filter_map(closest).collect()
}

/// Reads one value of a table row.
type Column = fn(&TableRow) -> f64;

fn time_charts(svg: &mut String, tables: &[Vec<TableRow>], timed: bool, key_times_secs: &[f64]) {
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
    let top = HEADER + VIEW_HEIGHT + 24.0;
    let height = (HEIGHT - top - MARGIN - GAP) / 2.0;
    for (idx, (title, value)) in columns.into_iter().enumerate() {
        let (column, row) = ((idx % 3) as f64, (idx / 3) as f64);
        let area = [MARGIN + column * (width + GAP), top + row * (height + GAP), width, height];
        let mut chart = Chart::new(area, title);
        if timed { "time, s" } else { "frame" }.clone_into(&mut chart.x_name);
        for (table, color) in tables.iter().zip(COLORS.iter().cycle()) {
            let points = table.iter().map(|row| (row.time_secs - start, value(row))).collect();
            let times: Vec<f64> = table.iter().map(|row| row.time_secs).collect();
            let keys = if chart.series.is_empty() { nearest(&times, key_times_secs) } else { Vec::new() };
            chart.series.push(Series { points, color, keys, marks_start: false });
        }
        chart.draw(svg);
    }
}
