//! The camera moves of a path in order, from its poses alone.
//!
//! A camera that stands still long enough holds. Every path between cuts and holds is split into the fewest spans that each make one move with a name. The split is found by
//! dynamic programming over evenly spaced poses. A move may flow into the next one: a span also has a name if its middle
//! has one. A span without a name costs more than several spans with names, so it remains only where the camera does two
//! things at once.

use super::named_move::{NamedMove, extent, name_move};
use super::progress::{is_one_way, stray_share};
use super::svd::rotation_angle;
use super::{Reduction, Trajectory};
use cinesplat_trajectory::Move;

/// Most places where a span may end.
const MAX_PLACES: usize = 81;
/// Poses between two places, at most.
const POSES_PER_PLACE: usize = 4;
/// Shortest span, as a fraction of the time between cuts and holds.
const SHORTEST_FRAC: f64 = 0.04;
/// Shortest span, s.
const SHORTEST_SECS: f64 = 0.3;
/// Travel that counts as none, as a fraction of the extent of the whole path.
const STILL_FRAC: f64 = 0.01;
/// Shortest hold, s.
const SHORTEST_HOLD_SECS: f64 = 0.6;
/// Speed that counts as still, over the greatest of the path, and rates that always do: rad/s, and of the logarithm of the
/// focal length.
const STILL_SPEED_FRAC: f64 = 0.02;
const STILL_TURN_RAD_PER_SEC: f64 = 0.003;
const STILL_ZOOM_PER_SEC: f64 = 0.002;
/// Part of a span at each end into which another move may flow.
const BLEND_FRAC: f64 = 0.12;
/// Costs of a span: with a name, with a name of its middle alone, and without a name, plus that of its length.
const NAMED_COST: f64 = 1.0;
/// Added for a move that turns while it travels: a straight move with the beginning of a pan looks like a short arc.
const CURVED_COST: f64 = 0.05;
/// Added for a move that circles and rises as unevenly as is allowed: an arc ends where a crane begins.
const UNEVEN_COST: f64 = 0.05;
const BLENDED_COST: f64 = 2.0;
const UNNAMED_COST: f64 = 2.5;
const UNNAMED_COST_PER_WHOLE: f64 = 8.0;

/// One span of a path and its move.
#[derive(Debug, Clone, PartialEq)]
pub struct DescribedMove {
    /// Its first time, s from the start of the path.
    pub from_secs: f64,
    /// Its last time.
    pub to_secs: f64,
    /// The move; `None` for several at once.
    pub movement: Option<NamedMove>,
    /// The poses.
    pub path: Trajectory,
    /// Whether the camera jumps to its first pose.
    pub is_cut: bool,
}

/// The moves of a path. `cuts` holds the indices of the poses that the camera jumps to.
pub fn describe(path: &Trajectory, cuts: &[usize]) -> Vec<DescribedMove> {
    let whole = path.diameter();
    let start_secs = path.times_or_indices().first().copied().unwrap_or(0.0);
    let mut ends: Vec<usize> = cuts.iter().copied().filter(|idx| (1..path.len()).contains(idx)).collect();
    ends.push(path.len());
    ends.sort_unstable();
    ends.dedup();
    let mut found = Vec::new();
    let mut from = 0;
    for end in ends {
        let piece: Vec<usize> = (from..end).collect();
        let piece = path.select(&piece);
        let spans = still_and_moving(&piece);
        let moves = spans.into_iter().flat_map(|(is_still, from, to)| {
            let span = piece.select(&(from..=to).collect::<Vec<_>>());
            if is_still {
                vec![held(span, start_secs)]
            } else {
                moves_between_holds(&span, whole * STILL_FRAC, start_secs)
            }
        });
        let mut moves: Vec<DescribedMove> = moves.collect();
        if let Some(first) = moves.first_mut() {
            first.is_cut = from > 0;
        }
        found.extend(moves);
        from = end;
    }
    found
}

/// A span in which the camera holds still.
fn held(path: Trajectory, start_secs: f64) -> DescribedMove {
    let times = path.times_or_indices();
    let at = |time: Option<&f64>| time.copied().unwrap_or(start_secs) - start_secs;
    let movement = Some(NamedMove { name: Move::Static, amount: 0.0 });
    DescribedMove { from_secs: at(times.first()), to_secs: at(times.last()), movement, path, is_cut: false }
}

/// The spans of a path in which it stands still for long enough, and those between: whether it is still, first and last
/// pose.
fn still_and_moving(path: &Trajectory) -> Vec<(bool, usize, usize)> {
    let times = path.times_or_indices();
    let steps: Vec<[f64; 3]> = (1..path.len()).map(|idx| rates(path, idx, times[idx] - times[idx - 1])).collect();
    let fastest = steps.iter().fold([0.0_f64; 3], |most, rates| std::array::from_fn(|k| most[k].max(rates[k])));
    let floors = [1e-9, STILL_TURN_RAD_PER_SEC, STILL_ZOOM_PER_SEC];
    let is_still = |rates: &[f64; 3]| (0..3).all(|k| rates[k] <= (STILL_SPEED_FRAC * fastest[k]).max(floors[k]));
    let mut spans: Vec<(bool, usize, usize)> = Vec::new();
    for run in steps.iter().enumerate().collect::<Vec<_>>().chunk_by(|a, b| is_still(a.1) == is_still(b.1)) {
        let (from, to) = (run[0].0, run[run.len() - 1].0 + 1);
        let holds = is_still(run[0].1) && times[to] - times[from] >= SHORTEST_HOLD_SECS;
        match spans.last_mut() {
            Some(last) if last.0 == holds => last.2 = to,
            _ => spans.push((holds, from, to)),
        }
    }
    if spans.is_empty() && !path.is_empty() {
        spans.push((true, 0, 0));
    }
    spans
}

/// Speed, angular speed and rate of the logarithm of the focal length from the pose before to a pose, per second.
fn rates(path: &Trajectory, idx: usize, secs: f64) -> [f64; 3] {
    let turned = rotation_angle(path.rotations[idx - 1].transpose() * path.rotations[idx]);
    let moved = path.positions[idx].distance(path.positions[idx - 1]);
    let focal = |idx: usize| path.fov_y_rad.get(idx).copied().flatten().map_or(0.0, |fov| (fov / 2.0).tan().ln());
    [moved, turned, (focal(idx) - focal(idx - 1)).abs()].map(|amount| if secs > 0.0 { amount / secs } else { 0.0 })
}

/// A move of a span and the cost of the span.
type Priced = (Option<NamedMove>, f64);

fn moves_between_holds(path: &Trajectory, still_distance: f64, start_secs: f64) -> Vec<DescribedMove> {
    let max_poses = Some(MAX_PLACES.saturating_sub(1) * POSES_PER_PLACE + 1);
    let Ok(path) = (Reduction { max_poses, ..Reduction::default() }).apply(path) else { return Vec::new() };
    let times = path.times_or_indices();
    let num_places = MAX_PLACES.min(path.len());
    let pose_of = |place: usize| place * (path.len() - 1) / (num_places - 1).max(1);
    let time_of = |place: usize| times[pose_of(place)];
    let length_secs = time_of(num_places - 1) - time_of(0);
    let shortest_secs = (SHORTEST_FRAC * length_secs).max(SHORTEST_SECS.min(length_secs / 2.0));
    let span = |from: usize, to: usize| path.select(&(pose_of(from)..=pose_of(to)).collect::<Vec<_>>());
    // The cheapest split up to each place: its cost, the place before, and the last span's move.
    let mut best: Vec<(f64, usize, Option<NamedMove>)> = vec![(0.0, 0, None)];
    for to in 1..num_places {
        let mut cheapest = (f64::INFINITY, 0, None);
        for (from, (before, ..)) in best.iter().enumerate() {
            let secs = time_of(to) - time_of(from);
            if secs < shortest_secs && from > 0 || *before >= cheapest.0 {
                continue;
            }
            let share = if length_secs > 0.0 { secs / length_secs } else { 1.0 };
            let (movement, cost) = priced(&span(from, to), still_distance, share);
            if before + cost < cheapest.0 - 1e-9 {
                cheapest = (before + cost, from, movement);
            }
        }
        best.push(cheapest);
    }
    let mut places = Vec::new();
    let mut to = num_places - 1;
    while to > 0 {
        places.push((best[to].1, to, best[to].2));
        to = best[to].1;
    }
    if places.is_empty() {
        places.push((0, 0, name_move(&path, still_distance)));
    }
    let described = |(from, to, movement): (usize, usize, Option<NamedMove>)| DescribedMove {
        from_secs: time_of(from) - start_secs,
        to_secs: time_of(to) - start_secs,
        movement,
        path: span(from, to),
        is_cut: false,
    };
    places.into_iter().rev().map(described).collect()
}

/// The move of a span that takes `share` of the time, and the cost of the span.
fn priced(span: &Trajectory, still_distance: f64, share: f64) -> Priced {
    // Among equal splits the one with even spans is cheapest.
    let evenness = 1e-3 * share * share;
    if let Some(found) = name_move(span, still_distance).filter(|found| is_one_way(span, found.name, still_distance)) {
        let uneven_cost = UNEVEN_COST * stray_share(span, found.name).powi(2);
        return (Some(found), NAMED_COST + curved_cost(found.name) + uneven_cost + evenness);
    }
    let ends = (BLEND_FRAC * span.len() as f64) as usize;
    let middle = span.select(&(ends..span.len() - ends).collect::<Vec<_>>());
    let is_move = |found: &NamedMove| found.name != Move::Static && is_one_way(&middle, found.name, still_distance);
    let inside = name_move(&middle, still_distance).filter(is_move);
    let blended = inside.and_then(|found| Some(NamedMove { amount: extent(span, found.name)?, ..found }));
    match blended {
        Some(found) => (Some(found), BLENDED_COST + evenness),
        None => (None, UNNAMED_COST + UNNAMED_COST_PER_WHOLE * share),
    }
}

fn curved_cost(name: Move) -> f64 {
    use Move as M;
    let is_curved = matches!(name, M::ArcLeft | M::ArcRight | M::OrbitLeft | M::OrbitRight | M::CraneUp | M::CraneDown);
    if is_curved { CURVED_COST } else { 0.0 }
}
