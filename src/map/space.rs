//! What the map shows: the axes of the page, the extent, and where matter is cut away.

use cinesplat_geometry::LevelFrame;
use cinesplat_objects::Object;
use cinesplat_scene::{Gaussians, SOLID_OPACITY};
use glam::{DVec2, DVec3};

use crate::roof;
use crate::route::Route;
use crate::walls;

/// Most points of matter that extent and cuts are computed from.
const MAX_POINTS: usize = 300_000;
/// Share of the points that is trimmed at both ends of each axis: floaters.
const TRIM_FRAC: f64 = 0.004;
/// How far the map reaches beyond path and subjects, over their extent and over the scene size.
const REACH: (f64, f64) = (1.3, 0.16);
/// Share of the matter that the map shows at least: a camera far outside looks back at the scene.
const MIN_MATTER_FRAC: f64 = 0.25;
/// Width of an empty stripe, over the extent, beyond which matter is something apart from the scene, such as a backdrop.
const GAP_FRAC: f64 = 0.05;
/// Stripes across the extent in which matter is counted.
const NUM_STRIPES: usize = 240;
/// Share of the points below which a stripe counts as empty, and above which matter apart is shown nevertheless.
const EMPTY_FRAC: f64 = 0.0002;
const APART_FRAC: f64 = 0.3;
/// Empty border around matter, over the extent of the map.
const BORDER_FRAC: f64 = 0.025;
/// Height of the cut between floor and roof, as a fraction: above doors and tables, below lamps and shelves.
const CUT_FRAC: f64 = 0.72;
/// Travel over the scene size below which a path counts as staying in place.
const STILL_FRAC: f64 = 0.01;

/// Axes, extent and cuts. Coordinates are along the axes: to the right of the page, ahead (up the page of the plan), up.
#[derive(Debug, Clone)]
pub(crate) struct Space {
    pub(crate) right: DVec3,
    pub(crate) ahead: DVec3,
    pub(crate) up: DVec3,
    /// Corners of the extent.
    pub(crate) low: DVec3,
    pub(crate) high: DVec3,
    /// The plan leaves out matter above this height.
    pub(crate) cut_height: f64,
    /// Whether the plan is cut below a roof.
    pub(crate) has_roof: bool,
    /// The elevation leaves out matter in front of this.
    pub(crate) cut_ahead: f64,
}

impl Space {
    pub(crate) fn new(gaussians: &Gaussians, frame: &LevelFrame, route: &Route, subjects: &[&Object]) -> Self {
        let matter = solid_points(gaussians);
        let size = spread(&matter);
        let right = page_right(&matter, frame, route, size);
        let ahead = frame.up.cross(right);
        let along = |point: DVec3| DVec3::new(point.dot(right), point.dot(ahead), point.dot(frame.up));
        let matter: Vec<DVec3> = matter.into_iter().map(along).collect();
        let path: Vec<DVec3> = route.samples().map(|sample| along(sample.state.pose.position)).collect();
        let centers: Vec<DVec3> = subjects.iter().map(|object| along(object.center)).collect();
        let corners = subjects.iter().flat_map(|object| object.corners()).map(along);
        let wanted: Vec<DVec3> = path.iter().copied().chain(corners).collect();
        let (low, high) = extent(&matter, &wanted, size);
        let roof = roof::height(&matter, (low, high), &path);
        let (path_top, margin) = (most(&path, |p| p.z), 0.004 * (high - low).max_element());
        let cut_height = match roof {
            Some(roof) => (roof.floor + CUT_FRAC * (roof.height - roof.floor)).max(path_top + margin),
            None => high.z.max(path_top) + margin,
        };
        let front = -most(&path, |p| -p.y).max(most(&centers, |p| -p.y));
        let cut_ahead = front - margin;
        Self { right, ahead, up: frame.up, low, high, cut_height, has_roof: roof.is_some(), cut_ahead }
    }

    /// Coordinates of a world point along the axes.
    pub(crate) fn along(&self, point: DVec3) -> DVec3 {
        DVec3::new(point.dot(self.right), point.dot(self.ahead), point.dot(self.up))
    }
}

fn most(points: &[DVec3], value: impl Fn(DVec3) -> f64) -> f64 {
    points.iter().map(|point| value(*point)).fold(f64::NEG_INFINITY, f64::max)
}

/// Means of the solid Gaussians, of all where none is solid; a part of them in large scenes.
fn solid_points(gaussians: &Gaussians) -> Vec<DVec3> {
    let solid: Vec<usize> = (0..gaussians.len()).filter(|&i| gaussians.opacities[i] >= SOLID_OPACITY).collect();
    let chosen = if solid.is_empty() { (0..gaussians.len()).collect() } else { solid };
    let stride = chosen.len().div_ceil(MAX_POINTS).max(1);
    chosen.into_iter().step_by(stride).map(|i| gaussians.mean_world(i)).collect()
}

/// Diagonal of the box of the trimmed points; 0 for at most one.
fn spread(points: &[DVec3]) -> f64 {
    let (low, high) = trimmed_box(points);
    (high - low).length()
}

/// Box of points without the outermost at both ends of each axis.
fn trimmed_box(points: &[DVec3]) -> (DVec3, DVec3) {
    let axis = |axis: usize| {
        let mut values: Vec<f64> = points.iter().map(|point| point[axis]).collect();
        values.sort_unstable_by(f64::total_cmp);
        let cut = (values.len() as f64 * TRIM_FRAC) as usize;
        match (values.get(cut), values.len().checked_sub(cut + 1).and_then(|last| values.get(last))) {
            (Some(low), Some(high)) => (*low, *high),
            _ => (0.0, 0.0),
        }
    };
    let (x, y, z) = (axis(0), axis(1), axis(2));
    (DVec3::new(x.0, y.0, z.0), DVec3::new(x.1, y.1, z.1))
}

/// The extent: path and subjects, and the matter within reach of them.
fn extent(matter: &[DVec3], wanted: &[DVec3], size: f64) -> (DVec3, DVec3) {
    let low = wanted.iter().copied().reduce(DVec3::min).unwrap_or_default();
    let high = wanted.iter().copied().reduce(DVec3::max).unwrap_or_default();
    let mut reach = (REACH.0 * (high - low).max_element()).max(REACH.1 * size);
    let within = |reach: f64| {
        let is_near = |point: &&DVec3| point.cmpge(low - reach).all() && point.cmple(high + reach).all();
        matter.iter().filter(is_near).copied().collect::<Vec<DVec3>>()
    };
    let mut near = within(reach);
    while (near.len() as f64) < MIN_MATTER_FRAC * matter.len() as f64 && reach < 1e3 * size {
        reach *= 1.4;
        near = within(reach);
    }
    for axis in [0, 1, 2, 0, 1, 2] {
        let (from, to) = without_backdrops(&near, axis, (low[axis], high[axis]));
        near.retain(|point| (from..=to).contains(&point[axis]));
    }
    let (core_low, core_high) = if near.is_empty() { (low, high) } else { trimmed_box(&near) };
    let (low, high) = (low.min(core_low), high.max(core_high));
    // A scene without extent still needs a page.
    let longest = (high - low).max_element();
    let longest = if longest > 0.0 { longest } else { low.abs().max_element().max(1.0) * 1e-3 };
    let flat = ((high - low) * -0.5 + 0.12 * longest).max(DVec3::ZERO);
    let border = flat + BORDER_FRAC * longest;
    (low - border, high + border)
}

/// The range along an axis of the matter that belongs to the scene: what is connected to `wanted` or large, without
/// what lies apart beyond an empty stripe.
fn without_backdrops(points: &[DVec3], axis: usize, wanted: (f64, f64)) -> (f64, f64) {
    let (low, high) = trimmed_box(points);
    let (low, high) = (low[axis], high[axis]);
    let width = (high - low) / NUM_STRIPES as f64;
    if !(width > 0.0) {
        return (low, high);
    }
    let mut counts = [0_usize; NUM_STRIPES];
    for value in points.iter().map(|point| point[axis]).filter(|value| (low..=high).contains(value)) {
        counts[(((value - low) / width) as usize).min(NUM_STRIPES - 1)] += 1;
    }
    let is_empty = |stripe: usize| (counts[stripe] as f64) < EMPTY_FRAC * points.len() as f64;
    let most_empty = (GAP_FRAC * NUM_STRIPES as f64) as usize;
    // Runs of stripes without a wide gap: first and last stripe, number of points.
    let mut runs: Vec<(usize, usize, usize)> = Vec::new();
    for stripe in (0..NUM_STRIPES).filter(|stripe| !is_empty(*stripe)) {
        match runs.last_mut().filter(|run| stripe - run.1 <= most_empty) {
            Some(run) => *run = (run.0, stripe, run.2 + counts[stripe]),
            None => runs.push((stripe, stripe, counts[stripe])),
        }
    }
    let edge = |stripe: usize| low + stripe as f64 * width;
    let belongs = |run: &&(usize, usize, usize)| {
        let is_wanted = edge(run.0) <= wanted.1 && edge(run.1 + 1) >= wanted.0;
        is_wanted || run.2 as f64 >= APART_FRAC * points.len() as f64
    };
    let kept: Vec<_> = runs.iter().filter(belongs).collect();
    match (kept.first(), kept.last()) {
        (Some(first), Some(last)) => (edge(first.0), edge(last.1 + 1)),
        _ => (low, high),
    }
}

/// The direction to the right of the page. Walls lie along the page where the scene has walls; the path runs from left to
/// right, and a camera that stays in place looks to the right.
fn page_right(matter: &[DVec3], frame: &LevelFrame, route: &Route, size: f64) -> DVec3 {
    let flat = |v: DVec3| DVec2::new(v.dot(frame.north), v.dot(frame.east));
    let start = route.first().pose;
    let places: Vec<DVec2> = route.samples().map(|sample| flat(sample.state.pose.position - start.position)).collect();
    let low = places.iter().copied().reduce(DVec2::min).unwrap_or_default();
    let high = places.iter().copied().reduce(DVec2::max).unwrap_or_default();
    let view = flat(start.rotation * DVec3::Z);
    let travels = (high - low).length() > STILL_FRAC * size.max(1e-12);
    let travel = flat(route.last().pose.position - start.position);
    let along = match (travels, travel.length() > 0.25 * (high - low).length()) {
        (true, true) => travel,
        (true, false) => farthest(&places),
        (false, _) => view,
    };
    let azimuth = if along.length() > 1e-12 { along.y.atan2(along.x) } else { 0.0 };
    let (low, high) = trimmed_box(matter);
    let inside = matter.iter().filter(|point| point.cmpge(low).all() && point.cmple(high).all());
    let footprint: Vec<DVec2> = inside.map(|point| flat(*point)).collect();
    let Some(wall) = walls::azimuth_rad(&footprint) else { return frame.direction(azimuth) };
    let quarter = std::f64::consts::FRAC_PI_2;
    frame.direction(wall + ((azimuth - wall) / quarter).round() * quarter)
}

/// The place farthest from the first.
fn farthest(places: &[DVec2]) -> DVec2 {
    places.iter().copied().max_by(|a, b| a.length_squared().total_cmp(&b.length_squared())).unwrap_or_default()
}
