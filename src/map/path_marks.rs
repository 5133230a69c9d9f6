//! The path on the page: a line colored by speed, a tick per second, an arrow, start and end.

use glam::DVec2;

use crate::labels::{Label, Labels};
use crate::panel::{Panel, View};
use crate::route::{Route, Sample};
use crate::style::{GRAY, INK, WHITE, speed_ink};
use cinesplat_plot::drawing::{Mark, Stroke};

/// Widths of the line and of the dark line behind it, px.
const LINE_PX: f64 = 3.4;
const CASING_PX: f64 = 6.4;
/// Number of the brightest color of the line; the darkest is 0.
const LAST_COLOR: f64 = 15.0;
/// Least length of a piece of one color, px.
const MIN_PIECE_PX: f64 = 3.0;
/// Half the length of a tick, px.
const TICK_PX: f64 = 7.0;
/// Least distance of two ticks, px.
const TICK_GAP_PX: f64 = 9.0;
/// Motion around a tick below which the camera stays in place, px.
const MIN_STEP_PX: f64 = 1e-3;
/// Most ticks of a film.
const MAX_TICKS: f64 = 24.0;
/// Length on the page from which a path gets an arrow, px.
const ARROW_FROM_PX: f64 = 50.0;

/// The line with its ticks and arrows.
pub(crate) fn line(panel: &Panel, route: &Route, labels: &mut Labels) -> Vec<Mark> {
    let mut marks = Vec::new();
    let fastest = route.speeds().1;
    let color = |sample: &Sample| (sample.speed / fastest.max(1e-300) * LAST_COLOR).round() as u32;
    for run in &route.runs {
        let points_px: Vec<DVec2> = run.iter().map(|sample| panel.to_px(sample.state.pose.position)).collect();
        labels.avoid(spaced(&points_px, 4.0).into_iter());
        marks.push(Mark::Line { points_px: spaced(&points_px, 0.4), stroke: Stroke::solid(WHITE, CASING_PX + 2.4) });
        marks.push(Mark::Line { points_px: spaced(&points_px, 0.4), stroke: Stroke::solid(INK, CASING_PX) });
        let mut start = 0;
        for i in 1..run.len() {
            let is_long = points_px[i].distance(points_px[start]) > MIN_PIECE_PX;
            if i + 1 == run.len() || (is_long && color(&run[i]) != color(&run[start])) {
                let ink = speed_ink(f64::from(color(&run[start])) / LAST_COLOR);
                let points_px = spaced(&points_px[start..=i], 0.4);
                marks.push(Mark::Line { points_px, stroke: Stroke::solid(ink, LINE_PX) });
                start = i;
            }
        }
        marks.extend(arrow(&points_px, labels));
    }
    marks
}

/// Ticks at even times, with their labels in seconds.
pub(crate) fn ticks(panel: &Panel, route: &Route, labels: &mut Labels) -> (Vec<Mark>, Vec<Mark>) {
    let step = tick_secs(route.duration_secs);
    let (mut marks, mut texts) = (Vec::new(), Vec::new());
    let mut last: Option<DVec2> = None;
    let num = (route.duration_secs / step + 1e-9).floor() as usize;
    for secs in (1..=num).map(|i| i as f64 * step).filter(|secs| *secs < route.duration_secs - 0.05 * step) {
        let at = |secs: f64| panel.to_px(route.at(secs).pose.position);
        let at_px = at(secs);
        let along = at(secs + 0.02) - at(secs - 0.02);
        let is_near = last.is_some_and(|last| last.distance(at_px) < TICK_GAP_PX);
        let moves = along.length() > MIN_STEP_PX && !is_near;
        let Some(along) = along.try_normalize().filter(|_| moves) else { continue };
        last = Some(at_px);
        let ends = vec![at_px - along.perp() * TICK_PX, at_px + along.perp() * TICK_PX];
        marks.push(Mark::Line { points_px: ends.clone(), stroke: Stroke::solid(WHITE, 3.4) });
        marks.push(Mark::Line { points_px: ends, stroke: Stroke::solid(INK, 1.7) });
        let text = format!("{secs} s");
        let label =
            Label { text: &text, at_px, half_px: DVec2::splat(TICK_PX - 4.0), size_px: 9.5, ink: GRAY, is_bold: false };
        if panel.view == View::Plan {
            texts.extend(labels.place(&label));
        }
    }
    (marks, texts)
}

/// Time between two ticks, seconds: 1, 2 or 5 times a power of ten, at least one second.
pub(crate) fn tick_secs(duration_secs: f64) -> f64 {
    let steps = (0..6).flat_map(|power| [1.0, 2.0, 5.0].map(|step| step * 10_f64.powi(power)));
    steps.into_iter().find(|step| duration_secs / step <= MAX_TICKS).unwrap_or(1e5)
}

/// The words at both ends.
pub(crate) fn ends(panel: &Panel, route: &Route, labels: &mut Labels) -> Vec<Mark> {
    let (start, end) = (panel.to_px(route.first().pose.position), panel.to_px(route.last().pose.position));
    let mut word = |text: &str, at_px: DVec2| {
        labels.place(&Label { text, at_px, half_px: DVec2::splat(10.0), size_px: 12.0, ink: INK, is_bold: true })
    };
    if start.distance(end) < 12.0 {
        return word("start and end", start);
    }
    [word("start", start), word("end", end)].concat()
}

/// An arrow head near the middle of a line, away from keys.
fn arrow(points_px: &[DVec2], labels: &Labels) -> Option<Mark> {
    let length: f64 = points_px.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
    if length < ARROW_FROM_PX {
        return None;
    }
    let at_share = |share: f64| {
        let mut left = share * length;
        points_px.windows(2).find(|pair| {
            left -= pair[0].distance(pair[1]);
            left <= 0.0 && pair[0] != pair[1]
        })
    };
    let places = [0.55, 0.45, 0.65, 0.35, 0.75, 0.25].into_iter().filter_map(at_share);
    let pair = places.into_iter().find(|pair| labels.is_free(pair[1], 9.0))?;
    let (at, along) = (pair[1], (pair[1] - pair[0]).try_normalize()?);
    let outline_px =
        vec![at + along * 10.0, at - along * 6.0 + along.perp() * 7.0, at - along * 6.0 - along.perp() * 7.0];
    Some(Mark::Area { outline_px, fill: Some(WHITE), border: Some(Stroke::solid(INK, 1.6)) })
}

/// The points of a line without those nearer than `gap_px` to the one before; keeps the last.
fn spaced(points_px: &[DVec2], gap_px: f64) -> Vec<DVec2> {
    let mut kept: Vec<DVec2> = Vec::new();
    for (i, point) in points_px.iter().enumerate() {
        let is_far = kept.last().is_none_or(|last| last.distance(*point) >= gap_px);
        if is_far || i + 1 == points_px.len() {
            kept.push(*point);
        }
    }
    kept
}
