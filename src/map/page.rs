//! The page: title, views above each other at one scale, and the legend beside them.

use cinesplat_geometry::LevelFrame;
use cinesplat_objects::{Object, ObjectSet};
use cinesplat_scene::Scene;
use cinesplat_trajectory::Shot;
use glam::{DVec2, DVec3};

use crate::error::MapError;
use crate::labels::Labels;
use crate::legend::{Column, text, wrapped};
use crate::panel::{Panel, View};
use crate::route::Route;
use crate::space::Space;
use crate::style::{GRAY, INK, PALE, WHITE, number};
use crate::{keys, matter, path_marks, things};
use cinesplat_plot::drawing::{Anchor, Drawing, Mark, Stroke, TextStyle};

/// Empty border of the page, px.
const MARGIN: f64 = 26.0;
/// Space beside the views for the marks of the cuts, px.
const CUT_MARGIN: f64 = 24.0;
/// Largest width of the views, and heights of plan and elevation, px.
const MAX_SIZE: (f64, f64, f64) = (800.0, 640.0, 380.0);
/// Least width of the views' column, px.
const MIN_WIDTH: f64 = 420.0;
const LEGEND_WIDTH: f64 = 250.0;
const GAP: f64 = 30.0;
const TITLE_PX: f64 = 17.0;
const MAX_TITLE_LINES: usize = 4;

/// Everything that is drawn.
struct Content<'a> {
    scene: &'a Scene,
    shot: &'a Shot,
    route: Route,
    space: Space,
    subjects: Vec<&'a Object>,
    others: Vec<&'a Object>,
}

/// Draws the map of a shot: the scene and the path from above and from the side.
///
/// The up axis is that of the shot, else that of the scene. Subjects are those that the keys name; their outlines are the
/// boxes in `objects`, which may be empty.
///
/// # Errors
/// [`MapError::Trajectory`] for keyframes that make no path, [`MapError::Render`] where the matter cannot be rendered.
pub fn draw(scene: &Scene, objects: &ObjectSet, shot: &Shot) -> Result<Drawing, MapError> {
    let route = Route::new(shot)?;
    let up = shot.scene.up.unwrap_or(scene.up);
    let frame = LevelFrame::new(up)?;
    let is_subject = |object: &&Object| {
        let intents = route.keys.iter().filter_map(|key| key.intent.as_ref());
        intents.flat_map(|intent| &intent.subjects).any(|id| *id == object.id)
    };
    let (subjects, others): (Vec<&Object>, Vec<&Object>) = objects.objects.iter().partition(is_subject);
    let space = Space::new(&scene.gaussians, &frame, &route, &subjects);
    let content = Content { scene, shot, route, space, subjects, others };
    content.page(objects)
}

impl Content<'_> {
    fn page(&self, objects: &ObjectSet) -> Result<Drawing, MapError> {
        let extent = self.space.high - self.space.low;
        let px_per_unit = (MAX_SIZE.0 / extent.x).min(MAX_SIZE.1 / extent.y).min(MAX_SIZE.2 / extent.z);
        let column_width = (extent.x * px_per_unit).max(MIN_WIDTH);
        let legend_left = MARGIN + column_width + 2.0 * CUT_MARGIN + GAP;
        let width = legend_left + LEGEND_WIDTH + MARGIN;
        let (mut marks, top) = self.header(width - 2.0 * MARGIN);
        let left = MARGIN + CUT_MARGIN + (column_width - extent.x * px_per_unit) / 2.0;
        let plan = Panel::new(View::Plan, &self.space, DVec2::new(left, top + 24.0), px_per_unit);
        let below = DVec2::new(left, plan.end_px().y + 40.0);
        let elevation = Panel::new(View::Elevation, &self.space, below, px_per_unit);
        for panel in [&plan, &elevation] {
            marks.extend(self.view(panel)?);
        }
        marks.extend(self.cut_marks(&plan, &elevation));
        let bar_top = elevation.end_px().y + 22.0;
        marks.extend(scale_bar(DVec2::new(left, bar_top), px_per_unit));
        let mut legend = Column::new(DVec2::new(legend_left, top), LEGEND_WIDTH);
        legend.symbols(self.shot, &self.route);
        if !self.subjects.is_empty() {
            legend.subject_symbol();
        }
        legend.clearance(self.shot);
        legend.steps(self.shot, objects);
        legend.unmet(self.shot);
        let height = (bar_top + 24.0).max(legend.y) + MARGIN;
        marks.extend(legend.marks);
        let title = format!("Map of a camera path from above and from the side: {}", self.shot.prompt);
        Ok(Drawing { size_px: DVec2::new(width, height).ceil(), title, marks })
    }

    /// Prompt and facts of the film, and where the next line starts.
    fn header(&self, width: f64) -> (Vec<Mark>, f64) {
        let (shot, mut y) = (self.shot, MARGIN);
        let title = if shot.prompt.is_empty() { "Camera path without a prompt" } else { &shot.prompt };
        let mut lines = wrapped(title, width, TITLE_PX);
        if lines.len() > MAX_TITLE_LINES {
            lines.truncate(MAX_TITLE_LINES);
            if let Some(last) = lines.last_mut() {
                last.push_str(" ...");
            }
        }
        let mut marks = Vec::new();
        for line in lines {
            y += TITLE_PX;
            marks.push(text(DVec2::new(MARGIN, y), TITLE_PX, INK, true, &line));
            y += 6.0;
        }
        let num_keys = self.route.keys.len();
        let keys = if num_keys == 1 { "1 key".to_owned() } else { format!("{num_keys} keys") };
        let name = self.scene.path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
        let facts = format!(
            "{name} \u{b7} {:.1} s \u{b7} {} frames at {} fps \u{b7} {} \u{d7} {} \u{b7} {keys} \u{b7} path {} units",
            shot.duration_secs,
            shot.num_frames(),
            shot.fps,
            shot.width,
            shot.height,
            number(self.route.length())
        );
        for line in wrapped(&facts, width, 11.5) {
            y += 14.0;
            marks.push(text(DVec2::new(MARGIN, y), 11.5, GRAY, false, &line));
            y += 3.0;
        }
        (marks, y + 8.0)
    }

    fn view(&self, panel: &Panel) -> Result<Vec<Mark>, MapError> {
        let (space, route) = (&self.space, &self.route);
        let words = match (panel.view, space.has_roof) {
            (View::Plan, true) => "From above, cut below the ceiling at B",
            (View::Plan, false) => "From above",
            (View::Elevation, _) => "From the side, cut at A",
        };
        let picture = matter::picture(self.scene, space, panel)?;
        let (corner_px, end_px) = (panel.corner_px, panel.end_px());
        let mut marks = vec![text(corner_px - DVec2::new(0.0, 7.0), 12.0, INK, true, words)];
        marks.push(Mark::Picture { corner_px, size_px: panel.size_px(), picture });
        let mut labels = Labels::inside((corner_px, end_px));
        marks.extend(things::outlines(panel, &self.subjects));
        marks.extend(keys::cones(panel, route, [self.shot.width, self.shot.height]));
        let numbered = keys::marks(panel, route, &mut labels);
        marks.extend(path_marks::line(panel, route, &mut labels));
        let view_numbers = keys::view_numbers(panel, route, &mut labels);
        let path_px: Vec<DVec2> = route.samples().map(|sample| panel.to_px(sample.state.pose.position)).collect();
        let axes = axes(panel, &path_px, &mut labels);
        let proof = self.shot.clearance.as_ref();
        let mut texts =
            proof.map_or(Vec::new(), |proof| things::clearance(panel, route, (self.scene, proof), &mut labels));
        texts.extend(path_marks::ends(panel, route, &mut labels));
        texts.extend(things::names(panel, &self.subjects, &mut labels));
        let (ticks, tick_texts) = path_marks::ticks(panel, route, &mut labels);
        texts.extend(tick_texts);
        if panel.view == View::Plan {
            texts.extend(things::other_names(panel, space, &self.others, &mut labels));
        }
        for group in [ticks, numbered, view_numbers, axes, texts] {
            marks.extend(group);
        }
        let outline_px = vec![corner_px, DVec2::new(end_px.x, corner_px.y), end_px, DVec2::new(corner_px.x, end_px.y)];
        marks.push(Mark::Area { outline_px, fill: None, border: Some(Stroke::solid(PALE, 1.0)) });
        Ok(marks)
    }

    /// Where each view cuts the other: arrows beside it that point the way the cut is looked at.
    fn cut_marks(&self, plan: &Panel, elevation: &Panel) -> Vec<Mark> {
        let (space, mut marks) = (&self.space, Vec::new());
        let mut both = |panel: &Panel, y: f64, look: f64, letter: &str| {
            if y < panel.corner_px.y - 1.0 || y > panel.end_px().y + 1.0 {
                return;
            }
            for (x, side) in [(panel.corner_px.x, -1.0), (panel.end_px().x, 1.0)] {
                marks.extend(cut_mark(DVec2::new(x + 4.0 * side, y), side, look, letter));
            }
        };
        let front = plan.to_px(space.ahead * space.cut_ahead).y;
        both(plan, front.clamp(plan.corner_px.y, plan.end_px().y), -1.0, "A");
        if space.has_roof {
            both(elevation, elevation.to_px(space.up * space.cut_height).y, 1.0, "B");
        }
        marks
    }
}

fn cut_mark(at: DVec2, side: f64, look: f64, letter: &str) -> Vec<Mark> {
    let end = at + DVec2::new(13.0 * side, 0.0);
    let tip = end + DVec2::new(0.0, 11.0 * look);
    let head = [DVec2::new(0.0, 3.0 * look), DVec2::new(-3.4, -3.5 * look), DVec2::new(3.4, -3.5 * look)];
    let style = TextStyle { size_px: 11.0, ink: INK, anchor: Anchor::Middle, is_bold: true };
    let base = end + DVec2::new(0.0, if look > 0.0 { -4.0 } else { 13.0 });
    vec![
        Mark::Line { points_px: vec![at, end, tip], stroke: Stroke::solid(INK, 1.4) },
        Mark::Area { outline_px: head.map(|point| tip + point).to_vec(), fill: Some(INK), border: None },
        Mark::Text { at_px: base, style, halo_px: 0.0, text: letter.to_owned() },
    ]
}

/// A bar of a round length, scene units.
fn scale_bar(left_px: DVec2, px_per_unit: f64) -> Vec<Mark> {
    let length = bar_length(px_per_unit);
    let end = left_px + DVec2::new(length * px_per_unit, 0.0);
    let half = left_px + DVec2::new(length * px_per_unit / 2.0, 0.0);
    let block = |from: DVec2, to: DVec2, fill| {
        let down = DVec2::new(0.0, 6.0);
        let border = Some(Stroke::solid(INK, 1.0));
        Mark::Area { outline_px: vec![from, to, to + down, from + down], fill: Some(fill), border }
    };
    let number = number_of(length);
    let words = format!("{number} scene {}", if number == "1" { "unit" } else { "units" });
    let label = text(end + DVec2::new(9.0, 7.0), 11.0, INK, false, &words);
    vec![block(left_px, half, INK), block(half, end, WHITE), label]
}

/// The longest of 1, 2 or 5 times a power of ten that takes at most 150 px, scene units.
fn bar_length(px_per_unit: f64) -> f64 {
    let most = 150.0 / px_per_unit;
    let power = 10_f64.powf(most.log10().floor());
    [5.0, 2.0].into_iter().map(|step| step * power).find(|length| *length <= most).unwrap_or(power)
}

/// A round number without trailing zeros.
fn number_of(value: f64) -> String {
    if (1e-3..1e5).contains(&value) { format!("{}", (value * 1e6).round() / 1e6) } else { format!("{value:.0e}") }
}

/// The world's axes in a corner of a view, for people who edit keys.
fn axes(panel: &Panel, path_px: &[DVec2], labels: &mut Labels) -> Vec<Mark> {
    let (low, high) = (panel.corner_px + 36.0, panel.end_px() - 36.0);
    let corners = [DVec2::new(low.x, high.y), high, low, DVec2::new(high.x, low.y)];
    let is_free = |corner: &DVec2| path_px.iter().all(|point| point.distance(*corner) > 70.0);
    let origin = corners.into_iter().find(is_free).unwrap_or(corners[0]);
    labels.take(origin, DVec2::splat(36.0));
    let arms = [(DVec3::X, "x"), (DVec3::Y, "y"), (DVec3::Z, "z")]
        .map(|(axis, name)| (DVec2::new(axis.dot(panel.right), -axis.dot(panel.upward)), name));
    let mut marks = Vec::new();
    for (arm, name) in arms.into_iter().filter(|(arm, _)| arm.length() > 0.25) {
        let tip = origin + arm * 20.0;
        marks.push(Mark::Line { points_px: vec![origin, tip], stroke: Stroke::solid(WHITE, 4.0) });
        marks.push(Mark::Line { points_px: vec![origin, tip], stroke: Stroke::solid(INK, 1.4) });
        let style = TextStyle { size_px: 10.0, ink: INK, anchor: Anchor::Middle, is_bold: false };
        let at_px = tip + arm.normalize() * 8.0 + DVec2::new(0.0, 3.0);
        marks.push(Mark::Text { at_px, style, halo_px: 2.0, text: name.to_owned() });
    }
    marks
}
