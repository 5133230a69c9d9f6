//! Matching of the poses of two paths by time.

use std::collections::{BTreeMap, BTreeSet};

use super::{Convention, EvaluationError, Trajectory};

/// Number of earlier and of later candidates for each time stamp of the sparser path.
const NEAREST: usize = 8;

/// How poses are matched.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Matching {
    /// Poses at the nearest times.
    #[default]
    Nearest,
    /// The path with more poses interpolated to the times of the other, of paths of equal length the reference:
    /// positions linearly, rotations along the shorter arc.
    Interpolated,
}

/// Matched poses of both paths, the same number of each.
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

/// Settings of [`associate`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MatchSettings {
    /// Largest time difference of a match, s.
    pub max_diff_secs: f64,
    /// Method.
    pub matching: Matching,
    /// Whether one pose may be matched twice, and how times between two poses count.
    pub convention: Convention,
}

impl Default for MatchSettings {
    fn default() -> Self {
        Self { max_diff_secs: 0.01, matching: Matching::Nearest, convention: Convention::default() }
    }
}

/// Matches poses by time. If a path has no times: by the numbers of the frames if both paths have those, else by index.
///
/// Nearest, by the convention of this program: one to one and in order of the reference's times. Of all pairs of time
/// stamps at most `max_diff_secs` apart the closest is taken, then the closest of the rest that crosses no match, and so
/// on. Poses that share one time stamp share its match.
///
/// Nearest, by evo's convention: each pose of the path with fewer poses (of equal ones the estimate) is matched with the
/// pose nearest in time, in the order of the file, even if another has the same match.
///
/// Interpolated: the times of the path with fewer poses are kept. By evo's convention only those that have a pose of the
/// other path at most `max_diff_secs` away; by that of this program also every time between two poses.
///
/// # Errors
/// [`EvaluationError::Empty`] for a path without poses, [`EvaluationError::NoMatches`] without time stamps close
/// enough.
pub fn associate(
    reference: &Trajectory,
    estimate: &Trajectory,
    settings: &MatchSettings,
) -> Result<Matches, EvaluationError> {
    for (path, which) in [(reference, "reference"), (estimate, "estimate")] {
        if path.is_empty() {
            return Err(EvaluationError::Empty { which });
        }
    }
    let (Some(reference_secs), Some(estimate_secs)) = (&reference.times_secs, &estimate.times_secs) else {
        return Ok(by_number(reference, estimate).unwrap_or_else(|| by_index(reference, estimate)));
    };
    let stamps = Stamps::new(reference_secs, estimate_secs);
    let found = match settings.matching {
        Matching::Interpolated => stamps.interpolated([reference, estimate], settings),
        Matching::Nearest => stamps.nearest([reference, estimate], settings),
    };
    found.ok_or_else(|| no_matches(reference_secs, estimate_secs, settings.max_diff_secs))
}

/// The time stamps of two paths by their number.
struct Stamps<'a> {
    sparse: &'a [f64],
    dense: &'a [f64],
    /// Whether the reference is the sparser path.
    is_reference_sparse: bool,
}

impl<'a> Stamps<'a> {
    fn new(reference: &'a [f64], estimate: &'a [f64]) -> Self {
        if estimate.len() > reference.len() {
            Self { sparse: reference, dense: estimate, is_reference_sparse: true }
        } else {
            Self { sparse: estimate, dense: reference, is_reference_sparse: false }
        }
    }

    /// `[reference, estimate]` from `(sparse, dense)`.
    fn ordered<T>(&self, (sparse, dense): (T, T)) -> [T; 2] {
        if self.is_reference_sparse { [sparse, dense] } else { [dense, sparse] }
    }

    fn nearest(&self, paths: [&Trajectory; 2], settings: &MatchSettings) -> Option<Matches> {
        let as_evo = nearest_reused(self.sparse, self.dense, settings.max_diff_secs);
        let mut notes = Vec::new();
        let mut pairs: Vec<[usize; 2]> = match settings.convention {
            Convention::Evo => as_evo.into_iter().map(|pair| self.ordered(pair)).collect(),
            Convention::Cinesplat => {
                let own = one_to_one(self.sparse, self.dense, settings.max_diff_secs);
                let shared: BTreeSet<(usize, usize)> = as_evo.iter().copied().collect();
                let num_other = own.iter().filter(|pair| !shared.contains(*pair)).count();
                if own.len() != as_evo.len() || num_other > 0 {
                    notes.push(format!(
                        "{} pairs, {num_other} of them other than in the convention of evo, which has {} pairs because \
                         it may use a pose twice",
                        own.len(),
                        as_evo.len()
                    ));
                }
                own.into_iter().map(|pair| self.ordered(pair)).collect()
            }
        };
        if pairs.is_empty() {
            return None;
        }
        if 2 * pairs.len() < self.sparse.len() {
            let (num, max_diff) = (self.sparse.len(), settings.max_diff_secs);
            notes.push(format!("only {} of {num} poses have a partner within {max_diff} s", pairs.len()));
        }
        let [reference_secs, estimate_secs] = self.ordered((self.sparse, self.dense));
        if settings.convention == Convention::Cinesplat {
            pairs.sort_by(|a, b| reference_secs[a[0]].total_cmp(&reference_secs[b[0]]));
        }
        let diffs = pairs.iter().map(|[a, b]| (reference_secs[*a] - estimate_secs[*b]).abs());
        let largest_diff_secs = diffs.fold(0.0, f64::max);
        let of = |side: usize| pairs.iter().map(|pair| pair[side]).collect::<Vec<usize>>();
        let unused = |side: usize| paths[side].len() - of(side).into_iter().collect::<BTreeSet<_>>().len();
        Some(Matches {
            largest_diff_secs,
            reference: paths[0].select(&of(0)),
            estimate: paths[1].select(&of(1)),
            dropped_reference: unused(0),
            dropped_estimate: unused(1),
            notes,
        })
    }

    /// The denser path at the times of the sparser one.
    fn interpolated(&self, paths: [&Trajectory; 2], settings: &MatchSettings) -> Option<Matches> {
        let [sparse_path, dense_path] = if self.is_reference_sparse { paths } else { [paths[1], paths[0]] };
        let order = by_time(self.dense);
        let mut resampled = Trajectory { times_secs: Some(Vec::new()), up: dense_path.up, ..Trajectory::default() };
        let mut kept = Vec::new();
        for (idx, time) in self.sparse.iter().enumerate() {
            let after = order.partition_point(|at| self.dense[*at] <= *time);
            let ends = (after.checked_sub(1).map(|rank| order[rank]), order.get(after).copied());
            let is_near = |at: usize| (self.dense[at] - time).abs() <= settings.max_diff_secs;
            let (a, b) = match ends {
                (Some(a), Some(b)) if settings.convention == Convention::Cinesplat || is_near(a) || is_near(b) => {
                    (a, b)
                }
                (Some(end), None) | (None, Some(end)) if is_near(end) => (end, end),
                _ => continue,
            };
            let span = self.dense[b] - self.dense[a];
            let t = if span > 0.0 { (time - self.dense[a]) / span } else { 0.0 };
            resampled.push_between(dense_path, a, b, t, *time);
            kept.push(idx);
        }
        if kept.is_empty() {
            return None;
        }
        let dropped = sparse_path.len() - kept.len();
        let [reference, estimate] = self.ordered((sparse_path.select(&kept), resampled));
        let [dropped_reference, dropped_estimate] = self.ordered((dropped, 0));
        let [from, to] = self.ordered(("estimate", "reference"));
        let note = format!("the {from} is interpolated to the times of the {to}");
        Some(Matches {
            reference,
            estimate,
            dropped_reference,
            dropped_estimate,
            largest_diff_secs: 0.0,
            notes: vec![note],
        })
    }
}

/// The poses of equal numbers; `None` for a path without numbers, and for paths that share none.
fn by_number(reference: &Trajectory, estimate: &Trajectory) -> Option<Matches> {
    let (of_reference, of_estimate) = (reference.frame_numbers.as_ref()?, estimate.frame_numbers.as_ref()?);
    let found: BTreeMap<u64, usize> =
        of_estimate.iter().enumerate().map(|(idx, number)| (*number as u64, idx)).collect();
    let numbers = of_reference.iter().enumerate();
    let pairs: Vec<(usize, usize)> =
        numbers.filter_map(|(idx, number)| Some((idx, *found.get(&(*number as u64))?))).collect();
    let (in_reference, in_estimate): (Vec<usize>, Vec<usize>) = pairs.iter().copied().unzip();
    (!pairs.is_empty()).then(|| Matches {
        reference: reference.select(&in_reference),
        estimate: estimate.select(&in_estimate),
        dropped_reference: reference.len() - pairs.len(),
        dropped_estimate: estimate.len() - pairs.len(),
        largest_diff_secs: 0.0,
        notes: vec!["the files have no times: poses are matched by the numbers of their frames".into()],
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

/// For each stamp of `sparse` the nearest of `dense`, of equally near ones the earlier: as indices into both, in the
/// order of `sparse`.
///
/// Among equal stamps of `dense` evo takes the last if all stamps are sorted and the first if they are not.
fn nearest_reused(sparse: &[f64], dense: &[f64], max_diff_secs: f64) -> Vec<(usize, usize)> {
    let is_sorted = dense.is_sorted();
    let order = by_time(dense);
    let nearest = |time: f64| {
        let after = order.partition_point(|at| dense[*at] <= time);
        let diff = |rank: usize| (dense[order[rank]] - time).abs();
        let ranks = [after.checked_sub(1), (after < order.len()).then_some(after)];
        let rank = ranks.into_iter().flatten().min_by(|a, b| diff(*a).total_cmp(&diff(*b)))?;
        let stamp = dense[order[rank]];
        let first = order.partition_point(|at| dense[*at] < stamp);
        let chosen = if is_sorted { rank } else { first };
        (diff(chosen) <= max_diff_secs).then(|| order[chosen])
    };
    sparse.iter().enumerate().filter_map(|(idx, time)| Some((idx, nearest(*time)?))).collect()
}

/// Matches of distinct stamps one to one, as indices into `sparse` and `dense`. Of poses with one stamp the k-th is
/// matched with the k-th of the other path at its partner's stamp, or with the first if there are fewer.
fn one_to_one(sparse: &[f64], dense: &[f64], max_diff_secs: f64) -> Vec<(usize, usize)> {
    let (sparse_groups, dense_groups) = (groups(sparse), groups(dense));
    let sparse_secs: Vec<f64> = sparse_groups.iter().map(|group| sparse[group[0]]).collect();
    let dense_secs: Vec<f64> = dense_groups.iter().map(|group| dense[group[0]]).collect();
    let ranks = one_to_one_sorted(&sparse_secs, &dense_secs, max_diff_secs);
    let mut pairs = Vec::new();
    for (sparse_rank, dense_rank) in ranks {
        let partners = &dense_groups[dense_rank];
        let partner = |k: usize| partners.get(k).copied().unwrap_or(partners[0]);
        pairs.extend(sparse_groups[sparse_rank].iter().enumerate().map(|(k, idx)| (*idx, partner(k))));
    }
    pairs
}

/// The indices of each distinct stamp, in order of time.
fn groups(secs: &[f64]) -> Vec<Vec<usize>> {
    let order = by_time(secs);
    order.chunk_by(|a, b| secs[*a].total_cmp(&secs[*b]).is_eq()).map(<[usize]>::to_vec).collect()
}

/// Matches of two lists of increasing stamps, as indices into both, in order of time.
fn one_to_one_sorted(sparse: &[f64], dense: &[f64], max_diff_secs: f64) -> Vec<(usize, usize)> {
    let mut candidates: Vec<(f64, usize, usize)> = Vec::new();
    for (sparse_rank, time) in sparse.iter().enumerate() {
        let middle = dense.partition_point(|at| at < time);
        let around = middle.saturating_sub(NEAREST)..(middle + NEAREST).min(dense.len());
        let with_diff = around.map(|dense_rank| ((dense[dense_rank] - time).abs(), sparse_rank, dense_rank));
        candidates.extend(with_diff.filter(|(diff, ..)| *diff <= max_diff_secs));
    }
    candidates.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)).then(a.2.cmp(&b.2)));
    let mut partner: BTreeMap<usize, usize> = BTreeMap::new();
    for (_, sparse_rank, dense_rank) in candidates {
        let before = partner.range(..=sparse_rank).next_back();
        let after = partner.range(sparse_rank..).next();
        // Two matches cross if their ranks are in opposite order.
        let fits = before.is_none_or(|(rank, at)| *rank < sparse_rank && *at < dense_rank)
            && after.is_none_or(|(rank, at)| *rank > sparse_rank && *at > dense_rank);
        if fits {
            partner.insert(sparse_rank, dense_rank);
        }
    }
    partner.into_iter().collect()
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
