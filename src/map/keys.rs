//! Keys on the page: numbered marks with view cones. Keys at one place share a mark.

use cinesplat_trajectory::{CameraState, Keyframe};
use glam::{DVec2, DVec3};

use crate::cones;
use crate::labels::Labels;
use crate::panel::{Panel, View};
use crate::route::Route;
use crate::style::{CONE, INK, WHITE};
use cinesplat_plot::drawing::{Anchor, Mark, Stroke, TextStyle, text_width_px};

/// Keys nearer than this on the page share a mark, px.
const SAME_PLACE_PX: f64 = 17.0;
/// Most marks of a view; of more keys, those at even steps are shown.
const MAX_MARKS: usize = 24;
/// Depth of a view cone, px.
const CONE_PX: f64 = 62.0;
/// Angle between two view directions that get cones of their own, rad.
const SAME_VIEW_RAD: f64 = 0.07;
/// Ratio of fields of view that get cones of their own.
const SAME_LENS: f64 = 1.08;
const NUMBER_PX: f64 = 10.5;
const RADIUS_PX: f64 = 8.5;

/// Keys that share a mark.
struct Place {
    center_px: DVec2,
    /// Indices of the keys, ascending.
    keys: Vec<usize>,
}

/// Cones, behind everything else of the path.
pub(crate) fn cones(panel: &Panel, route: &Route, frame_size: [u32; 2]) -> Vec<Mark> {
    // From the side, the cones of a turning camera cover each other.
    let opacity = if panel.view == View::Plan { 0.13 } else { 0.06 };
    let depth = CONE_PX / panel.px_per_unit;
    let mut marks = Vec::new();
    for place in places(panel, &route.keys) {
        for key_idx in distinct_views(&route.keys, &place.keys) {
            let state = CameraState::from(&route.keys[key_idx]);
            let outline_px = panel.clipped(&cones::outline_px(panel, &state, frame_size, depth));
            if outline_px.len() > 2 {
                let border = Stroke::solid(CONE.with_opacity(0.75), 1.1);
                marks.push(Mark::Area { outline_px, fill: Some(CONE.with_opacity(opacity)), border: Some(border) });
            }
        }
    }
    marks
}

/// Numbered marks; the first key's is black and round, the last key's black and square.
pub(crate) fn marks(panel: &Panel, route: &Route, labels: &mut Labels) -> Vec<Mark> {
    let last = route.keys.len() - 1;
    let mut marks = Vec::new();
    for place in places(panel, &route.keys) {
        let text = numbers(&place.keys);
        let half = DVec2::new((text_width_px(&text, NUMBER_PX) / 2.0 + 4.5).max(RADIUS_PX), RADIUS_PX);
        let (is_first, is_last) = (place.keys.contains(&0), place.keys.contains(&last));
        let fill = Some(if is_first || is_last { INK } else { WHITE });
        let border = Some(Stroke::solid(if is_first || is_last { WHITE } else { INK }, 1.5));
        let is_square = is_last && !is_first;
        let outline_px = if is_square { box_px(place.center_px, half - 0.5) } else { pill_px(place.center_px, half) };
        marks.push(Mark::Area { outline_px, fill, border });
        let ink = if is_first || is_last { WHITE } else { INK };
        marks.push(number(place.center_px, text, ink));
        labels.take(place.center_px, half + 1.5);
    }
    marks
}

/// Numbers at the far ends of the cones of keys that share a place.
pub(crate) fn view_numbers(panel: &Panel, route: &Route, labels: &mut Labels) -> Vec<Mark> {
    let mut marks = Vec::new();
    // From the side, the numbers of a turning camera cover each other.
    for place in places(panel, &route.keys).into_iter().filter(|_| panel.view == View::Plan) {
        let views = distinct_views(&route.keys, &place.keys);
        for key_idx in views.iter().copied().filter(|_| views.len() > 1) {
            let pose = route.keys[key_idx].pose;
            let tip = pose.position + pose.rotation * DVec3::Z * (0.86 * CONE_PX / panel.px_per_unit);
            let at_px = panel.to_px(tip);
            if at_px.distance(place.center_px) > 2.5 * RADIUS_PX {
                let half = DVec2::new(text_width_px(&(key_idx + 1).to_string(), NUMBER_PX) / 2.0, NUMBER_PX / 2.0);
                labels.take(at_px, half);
                marks.push(number(at_px, (key_idx + 1).to_string(), CONE));
            }
        }
    }
    marks
}

fn number(center_px: DVec2, text: String, ink: cinesplat_plot::drawing::Ink) -> Mark {
    let style = TextStyle { size_px: NUMBER_PX, ink, anchor: Anchor::Middle, is_bold: true };
    Mark::Text { at_px: center_px + DVec2::new(0.0, 0.36 * NUMBER_PX), style, halo_px: 0.0, text }
}

/// Keys grouped by their place on the page.
fn places(panel: &Panel, keys: &[Keyframe]) -> Vec<Place> {
    let stride = keys.len().div_ceil(4 * MAX_MARKS).max(1);
    let mut places: Vec<Place> = Vec::new();
    for (key_idx, key) in keys.iter().enumerate().filter(|(i, _)| i % stride == 0 || i + 1 == keys.len()) {
        let center_px = panel.to_px(key.pose.position);
        match places.iter_mut().find(|place| place.center_px.distance(center_px) < SAME_PLACE_PX) {
            Some(place) => place.keys.push(key_idx),
            None => places.push(Place { center_px, keys: vec![key_idx] }),
        }
    }
    let stride = places.len().div_ceil(MAX_MARKS).max(1);
    let num = places.len();
    places.into_iter().enumerate().filter(|(i, _)| i % stride == 0 || i + 1 == num).map(|(_, place)| place).collect()
}

/// Of keys at one place, those whose view differs from that of the one before.
fn distinct_views(keys: &[Keyframe], at_place: &[usize]) -> Vec<usize> {
    let mut distinct: Vec<usize> = Vec::new();
    for &key_idx in at_place {
        let differs = |other: &usize| {
            let (a, b) = (&keys[key_idx], &keys[*other]);
            let angle = (a.pose.rotation * DVec3::Z).angle_between(b.pose.rotation * DVec3::Z);
            let lens = (a.fov_y_rad / b.fov_y_rad).max(b.fov_y_rad / a.fov_y_rad);
            angle > SAME_VIEW_RAD || lens > SAME_LENS
        };
        if distinct.iter().all(differs) {
            distinct.push(key_idx);
        }
    }
    distinct
}

/// Numbers of keys, counted from 1: `3`, `1–4` or `1, 5`.
fn numbers(keys: &[usize]) -> String {
    let (first, last) = (keys.first().map_or(0, |key| key + 1), keys.last().map_or(0, |key| key + 1));
    match keys.len() {
        1 => first.to_string(),
        num if last - first + 1 == num => format!("{first}\u{2013}{last}"),
        2 => format!("{first}, {last}"),
        _ => format!("{first}..{last}"),
    }
}

fn box_px(center: DVec2, half: DVec2) -> Vec<DVec2> {
    [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| center + half * DVec2::new(x, y)).to_vec()
}

/// A rectangle with round ends.
fn pill_px(center: DVec2, half: DVec2) -> Vec<DVec2> {
    let corner = |i: usize| {
        let direction = DVec2::from_angle(std::f64::consts::TAU * (i as f64 + 0.5) / 40.0);
        center + DVec2::new((half.x - half.y) * direction.x.signum(), 0.0) + direction * half.y
    };
    (0..40).map(corner).collect()
}
