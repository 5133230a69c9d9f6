//! Subjects, other objects and the least clearance on the page.

use cinesplat_objects::Object;
use cinesplat_scene::Scene;
use cinesplat_trajectory::ClearanceProof;
use glam::DVec2;

use crate::cones::hull;
use crate::labels::{Label, Labels};
use crate::panel::Panel;
use crate::route::Route;
use crate::space::Space;
use crate::style::{CLEARANCE, GRAY, SUBJECT, WHITE, number};
use cinesplat_plot::drawing::{Mark, Stroke};

/// Most other objects with a name.
const MAX_NAMES: usize = 12;
/// Longest side of an object over that of the view, above which it is part of the building.
const BUILDING_FRAC: f64 = 0.55;
/// Radius of the clearance on the page beyond which no circle is drawn, px.
const MAX_CIRCLE_PX: f64 = 190.0;

/// Outlines of the subjects' boxes.
pub(crate) fn outlines(panel: &Panel, subjects: &[&Object]) -> Vec<Mark> {
    let mut marks = Vec::new();
    for object in subjects {
        let outline_px = panel.clipped(&box_px(panel, object));
        let border = |ink, width_px| Some(Stroke::dashed(ink, width_px, [7.0, 4.0]));
        let back = Some(Stroke::solid(WHITE.with_opacity(0.8), 4.2));
        marks.push(Mark::Area { outline_px: outline_px.clone(), fill: Some(SUBJECT.with_opacity(0.10)), border: back });
        marks.push(Mark::Area { outline_px, fill: None, border: border(SUBJECT, 2.0) });
    }
    marks
}

/// Names of the subjects.
pub(crate) fn names(panel: &Panel, subjects: &[&Object], labels: &mut Labels) -> Vec<Mark> {
    let of = |object: &&Object| {
        let outline = panel.clipped(&box_px(panel, object));
        let (low, high) = bounds(&outline)?;
        let text = name(object);
        let (at_px, half_px) = ((low + high) / 2.0, (high - low) / 2.0);
        let label = Label { text: &text, at_px, half_px, size_px: 12.5, ink: SUBJECT, is_bold: true };
        Some(labels.place(&label))
    };
    subjects.iter().filter_map(of).flatten().collect()
}

/// Label and id of an object.
pub(crate) fn name(object: &Object) -> String {
    if object.label.is_empty() {
        format!("<obj-{}>", object.id)
    } else {
        format!("{} <obj-{}>", object.label, object.id)
    }
}

/// Names of the largest other objects in the plan, where they fit.
pub(crate) fn other_names(panel: &Panel, space: &Space, others: &[&Object], labels: &mut Labels) -> Vec<Mark> {
    let size = panel.size_px();
    let boxed = |object: &&Object| {
        let (low, high) = bounds(&box_px(panel, object))?;
        let middle = (low + high) / 2.0;
        let is_inside = middle.cmpge(panel.corner_px).all() && middle.cmple(panel.end_px()).all();
        let is_building = (high - low).cmpgt(size * BUILDING_FRAC).any();
        let is_shown = space.along(object.center).z < space.cut_height;
        let has_name = !object.label.is_empty();
        (is_inside && !is_building && is_shown && has_name).then_some((middle, high - low, object.label.clone()))
    };
    let mut found: Vec<(DVec2, DVec2, String)> = others.iter().filter_map(boxed).collect();
    found.sort_by(|a, b| b.1.element_product().total_cmp(&a.1.element_product()));
    let mut marks = Vec::new();
    for (at_px, _, text) in found.iter().take(MAX_NAMES).filter(|(_, size, _)| size.min_element() > 12.0) {
        let label = Label { text, at_px: *at_px, half_px: DVec2::ZERO, size_px: 10.0, ink: GRAY, is_bold: false };
        let placed = labels.place(&label);
        // A name with a line to its object says less than it hides.
        marks.extend(placed.into_iter().filter(|mark| matches!(mark, Mark::Text { .. })));
    }
    marks
}

/// The least clearance: a circle that reaches the nearest matter, with its value and moment.
pub(crate) fn clearance(
    panel: &Panel,
    route: &Route,
    (scene, proof): (&Scene, &ClearanceProof),
    labels: &mut Labels,
) -> Vec<Mark> {
    if !proof.min_distance.is_finite() {
        return Vec::new();
    }
    let position = route.at(proof.at_secs).pose.position;
    let center_px = panel.to_px(position);
    let radius_px = proof.min_distance * panel.px_per_unit;
    let mut marks = Vec::new();
    if (3.0..MAX_CIRCLE_PX).contains(&radius_px) {
        let corner = |i: u32| center_px + DVec2::from_angle(std::f64::consts::TAU * f64::from(i) / 120.0) * radius_px;
        for points_px in panel.pieces_inside((0..=120).map(corner)) {
            let back = Stroke::solid(WHITE.with_opacity(0.7), 3.4);
            marks.push(Mark::Line { points_px: points_px.clone(), stroke: back });
            marks.push(Mark::Line { points_px, stroke: Stroke::dashed(CLEARANCE, 1.5, [3.0, 3.5]) });
        }
    }
    let nearest = proof.gaussian_idx.and_then(|file_idx| {
        let kept = file_idx - scene.dropped.partition_point(|dropped| (*dropped as usize) < file_idx);
        (kept < scene.gaussians.len()).then(|| scene.gaussians.mean_world(kept))
    });
    let toward = nearest.and_then(|mean| (mean - position).try_normalize());
    if let Some(toward) = toward {
        let end = panel.to_px(position + toward * proof.min_distance);
        let line = (0..=200).map(|i| center_px.lerp(end, f64::from(i) / 200.0));
        let stroke = Stroke::solid(CLEARANCE, 1.6);
        marks.extend(panel.pieces_inside(line).into_iter().map(|points_px| Mark::Line { points_px, stroke }));
        if panel.is_inside(end) {
            let border = Some(Stroke::solid(WHITE, 1.0));
            marks.push(Mark::Circle { center_px: end, radius_px: 3.0, fill: Some(CLEARANCE), border });
            labels.take(end, DVec2::splat(3.0));
        }
    }
    let text = format!("clearance {} at {:.1} s", number(proof.min_distance), proof.at_secs);
    let end = toward.map(|toward| panel.to_px(position + toward * proof.min_distance));
    let at_px = end.filter(|end| panel.is_inside(*end)).unwrap_or(center_px);
    let label = Label { text: &text, at_px, half_px: DVec2::splat(4.0), size_px: 10.5, ink: CLEARANCE, is_bold: true };
    marks.extend(labels.place(&label));
    marks
}

/// Outline of an object's box on the page, px.
fn box_px(panel: &Panel, object: &Object) -> Vec<DVec2> {
    hull(object.corners().map(|corner| panel.to_px(corner)).to_vec())
}

fn bounds(points: &[DVec2]) -> Option<(DVec2, DVec2)> {
    Some((points.iter().copied().reduce(DVec2::min)?, points.iter().copied().reduce(DVec2::max)?))
}
