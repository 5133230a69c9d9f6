//! Matching of the poses of two paths by time.

use super::{EvaluationError, Trajectory};

/// Number of earlier and of later candidates for each time stamp of the shorter path.
const NEAREST: usize = 8;

/// How poses are matched.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Matching {
    /// Poses at the nearest times, each used at most once.
    #[default]
    Nearest,
    /// The estimate interpolated to the reference's times: positions linearly, rotations along the shorter arc.
    Interpolated,
}

/// Matched poses of both paths, the same number of each, in order of the reference's times.
#[derive(Debug, Clone, PartialEq)]
pub struct Matches {
    /// Poses of the reference.
    pub reference: Trajectory,
    /// Poses of the estimate.
    pub estimate: Trajectory,
    /// Number of poses of the reference without a match.
    pub dropped_reference: usize,
    /// Number of poses of the estimate without a match.
    pub dropped_estimate: usize,
    /// Largest time difference of a match; 0 without times.
    pub largest_diff_secs: f64,
    /// Notes about the matching, as text for the user.
    pub notes: Vec<String>,
}

/// Matches poses by time, one to one and in order; by index if a path has no times.
///
/// The matching is greedy: of all pairs of time stamps at most `max_diff_secs` apart it takes the closest, then the
/// closest of the rest that crosses no match, and so on. Where nearest neighbors are one to one the result is the
/// nearest neighbors, as in evo. Where two time stamps share a nearest neighbor, evo uses that pose twice; this
/// function does not.
///
/// # Errors
/// [`EvaluationError::Empty`] for a path without poses, [`EvaluationError::NoMatches`] without time stamps close
/// enough.
pub fn associate(
    reference: &Trajectory,
    estimate: &Trajectory,
    max_diff_secs: f64,
    matching: Matching,
) -> Result<Matches, EvaluationError> {
    for (path, which) in [(reference, "reference"), (estimate, "estimate")] {
        if path.is_empty() {
            return Err(EvaluationError::Empty { which });
        }
    }
    let (Some(reference_secs), Some(estimate_secs)) = (&reference.times_secs, &estimate.times_secs) else {
        return Ok(by_index(reference, estimate));
    };
    if matching == Matching::Interpolated {
        return interpolated(reference, estimate, reference_secs, estimate_secs, max_diff_secs);
    }
    let swapped = estimate_secs.len() > reference_secs.len();
    let (short, long) = if swapped { (reference_secs, estimate_secs) } else { (estimate_secs, reference_secs) };
    let pairs = one_to_one(short, long, max_diff_secs);
    let mut pairs: Vec<(usize, usize)> =
        pairs.into_iter().map(|(short, long)| if swapped { (short, long) } else { (long, short) }).collect();
    if pairs.is_empty() {
        return Err(no_matches(reference_secs, estimate_secs, max_diff_secs));
    }
    pairs.sort_by(|a, b| reference_secs[a.0].total_cmp(&reference_secs[b.0]));
    let diffs = pairs.iter().map(|(a, b)| (reference_secs[*a] - estimate_secs[*b]).abs());
    let (from_reference, from_estimate): (Vec<usize>, Vec<usize>) = pairs.iter().copied().unzip();
    Ok(Matches {
        largest_diff_secs: diffs.fold(0.0, f64::max),
        reference: reference.select(&from_reference),
        estimate: estimate.select(&from_estimate),
        dropped_reference: reference.len() - pairs.len(),
        dropped_estimate: estimate.len() - pairs.len(),
        notes: Vec::new(),
    })
}

fn by_index(reference: &Trajectory, estimate: &Trajectory) -> Matches {
    let len = reference.len().min(estimate.len());
    let indices: Vec<usize> = (0..len).collect();
    Matches {
        reference: reference.select(&indices),
        estimate: estimate.select(&indices),
        dropped_reference: reference.len() - len,
        dropped_estimate: estimate.len() - len,
        largest_diff_secs: 0.0,
        notes: vec!["a file has no times: poses are matched by index".into()],
    }
}

fn no_matches(reference_secs: &[f64], estimate_secs: &[f64], max_diff_secs: f64) -> EvaluationError {
    let ends = |secs: &[f64]| {
        let bounds = (f64::INFINITY, f64::NEG_INFINITY);
        let (low, high) = secs.iter().fold(bounds, |(low, high), t| (low.min(*t), high.max(*t)));
        [low, high]
    };
    let sorted = by_time(reference_secs);
    let nearest = |time: f64| {
        let after = sorted.partition_point(|idx| reference_secs[*idx] < time);
        let around = [after.checked_sub(1), Some(after)].into_iter().flatten().filter_map(|at| sorted.get(at));
        around.map(|idx| (reference_secs[*idx] - time).abs()).fold(f64::INFINITY, f64::min)
    };
    EvaluationError::NoMatches {
        nearest_secs: estimate_secs.iter().map(|time| nearest(*time)).fold(f64::INFINITY, f64::min),
        max_diff_secs,
        reference_secs: ends(reference_secs),
        estimate_secs: ends(estimate_secs),
    }
}

/// Indices sorted by time.
fn by_time(secs: &[f64]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..secs.len()).collect();
    order.sort_by(|a, b| secs[*a].total_cmp(&secs[*b]));
    order
}

/// Matches as indices into `short` and `long`, in order of time.
fn one_to_one(short: &[f64], long: &[f64], max_diff_secs: f64) -> Vec<(usize, usize)> {
    let (short_order, long_order) = (by_time(short), by_time(long));
    // Candidates hold ranks in time: two matches cross if their ranks are in opposite order.
    let mut candidates: Vec<(f64, usize, usize)> = Vec::new();
    for (short_rank, idx) in short_order.iter().enumerate() {
        let time = short[*idx];
        let middle = long_order.partition_point(|at| long[*at] < time);
        let around = middle.saturating_sub(NEAREST)..(middle + NEAREST).min(long_order.len());
        let with_diff = around.map(|long_rank| ((long[long_order[long_rank]] - time).abs(), short_rank, long_rank));
        candidates.extend(with_diff.filter(|(diff, ..)| *diff <= max_diff_secs));
    }
    candidates.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)).then(a.2.cmp(&b.2)));
    let mut partner: std::collections::BTreeMap<usize, usize> = std::collections::BTreeMap::new();
    for (_, short_rank, long_rank) in candidates {
        let before = partner.range(..=short_rank).next_back();
        let after = partner.range(short_rank..).next();
        let fits = before.is_none_or(|(rank, at)| *rank < short_rank && *at < long_rank)
            && after.is_none_or(|(rank, at)| *rank > short_rank && *at > long_rank);
        if fits {
            partner.insert(short_rank, long_rank);
        }
    }
    partner.into_iter().map(|(short_rank, long_rank)| (short_order[short_rank], long_order[long_rank])).collect()
}

/// The estimate interpolated to every time of the reference between its first and last pose, or at most `max_diff_secs`
/// outside.
fn interpolated(
    reference: &Trajectory,
    estimate: &Trajectory,
    reference_secs: &[f64],
    estimate_secs: &[f64],
    max_diff_secs: f64,
) -> Result<Matches, EvaluationError> {
    let order = by_time(estimate_secs);
    let mut resampled = Trajectory { times_secs: Some(Vec::new()), up: estimate.up, ..Trajectory::default() };
    let mut kept = Vec::new();
    for (idx, time) in reference_secs.iter().enumerate() {
        let after = order.partition_point(|at| estimate_secs[*at] <= *time);
        let ends = (after.checked_sub(1).map(|rank| order[rank]), order.get(after).copied());
        let (a, b) = match ends {
            (Some(a), Some(b)) => (a, b),
            (Some(end), None) | (None, Some(end)) if (estimate_secs[end] - time).abs() <= max_diff_secs => (end, end),
            _ => continue,
        };
        let span = estimate_secs[b] - estimate_secs[a];
        let t = if span > 0.0 { (time - estimate_secs[a]) / span } else { 0.0 };
        resampled.push_between(estimate, a, b, t, *time);
        kept.push(idx);
    }
    if kept.is_empty() {
        return Err(no_matches(reference_secs, estimate_secs, max_diff_secs));
    }
    Ok(Matches {
        reference: reference.select(&kept),
        estimate: resampled,
        dropped_reference: reference.len() - kept.len(),
        dropped_estimate: 0,
        largest_diff_secs: 0.0,
        notes: vec!["the estimate is interpolated to the reference's times".into()],
    })
}

impl Trajectory {
    /// Appends the pose at a fraction `t` from pose `a` to pose `b` of another path.
    fn push_between(&mut self, path: &Self, a: usize, b: usize, t: f64, time_secs: f64) {
        use cinesplat_geometry::rotation::slerp;
        use glam::{DMat3, DQuat};
        let turn = |idx: usize| DQuat::from_mat3(&path.rotations[idx]).normalize();
        let exact = if t <= 0.0 { Some(a) } else { (t >= 1.0).then_some(b) };
        let fov = path.fov_y_rad[a].zip(path.fov_y_rad[b]).map(|(a, b)| a + (b - a) * t);
        self.times_secs.get_or_insert_default().push(time_secs);
        self.positions.push(path.positions[a].lerp(path.positions[b], t));
        let between = || DMat3::from_quat(slerp(turn(a), turn(b), t));
        self.rotations.push(exact.map_or_else(between, |idx| path.rotations[idx]));
        self.fov_y_rad.push(fov);
    }
}
