//! Fewer poses of a path, before paths are matched: a span of time, those after enough motion, an even choice.

use super::svd::rotation_angle;
use super::{Convention, EvaluationError, Trajectory};

/// The motion from one kept pose to the next.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MotionFilter {
    /// Distance traveled since the last kept pose, along the path, scene units.
    pub distance: f64,
    /// Angle from the last kept pose, rad.
    pub angle_rad: f64,
}

/// What a path is in a comparison.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// What the others are compared with.
    Reference,
    /// What is compared.
    Estimate,
}

/// Which poses of a path are kept. The steps are taken in the order of the fields.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Reduction {
    /// First time that is kept, on the file's clock.
    pub start_secs: Option<f64>,
    /// Last time that is kept.
    pub end_secs: Option<f64>,
    /// Largest number of poses, evenly chosen by index, first and last included.
    pub max_poses: Option<usize>,
    /// Drops each pose that is below both bounds.
    pub motion: Option<MotionFilter>,
}

impl Reduction {
    /// The kept poses of a path.
    ///
    /// # Errors
    /// [`EvaluationError::NoTimes`] for a span of time of a path without times, [`EvaluationError::Empty`] if nothing is
    /// left.
    pub fn apply(&self, path: &Trajectory) -> Result<Trajectory, EvaluationError> {
        let mut kept: Vec<usize> = (0..path.len()).collect();
        if self.has_span() {
            let times = path.times_secs.as_ref().ok_or(EvaluationError::NoTimes { wanted: "a span of time" })?;
            let span = self.start_secs.unwrap_or(f64::NEG_INFINITY)..=self.end_secs.unwrap_or(f64::INFINITY);
            kept.retain(|idx| span.contains(&times[*idx]));
        }
        if let Some(max_poses) = self.max_poses {
            kept = evenly(&kept, max_poses);
        }
        let reduced = path.select(&kept);
        let reduced = match &self.motion {
            Some(filter) => reduced.select(&moved(&reduced, filter)),
            None => reduced,
        };
        if reduced.is_empty() { Err(EvaluationError::Empty { which: "rest of a path" }) } else { Ok(reduced) }
    }

    /// The kept poses of a path in a comparison.
    ///
    /// By evo's convention the span of time is the last step, and it is that of the reference alone: the estimate keeps its
    /// poses outside of it, which decides which path has fewer poses and so whose poses are matched with the nearest ones.
    ///
    /// # Errors
    /// Those of [`Self::apply`].
    pub fn apply_as(
        &self,
        path: &Trajectory,
        role: Role,
        convention: Convention,
    ) -> Result<Trajectory, EvaluationError> {
        if convention == Convention::Cinesplat || !self.has_span() {
            return self.apply(path);
        }
        let fewer = Self { start_secs: None, end_secs: None, ..*self }.apply(path)?;
        match role {
            Role::Estimate => Ok(fewer),
            Role::Reference => Self { max_poses: None, motion: None, ..*self }.apply(&fewer),
        }
    }

    /// Whether a span of time is kept.
    pub fn has_span(&self) -> bool {
        self.start_secs.is_some() || self.end_secs.is_some()
    }
}

impl Trajectory {
    /// One path of the poses of several, in order of time.
    ///
    /// # Errors
    /// [`EvaluationError::NoTimes`] for a path without times, [`EvaluationError::Empty`] without poses.
    pub fn merged(paths: &[Self]) -> Result<Self, EvaluationError> {
        let mut all = Self { times_secs: Some(Vec::new()), ..Self::default() };
        let mut times: Vec<f64> = Vec::new();
        for path in paths {
            times.extend(path.times_secs.as_ref().ok_or(EvaluationError::NoTimes { wanted: "a merge" })?);
            all.positions.extend(&path.positions);
            all.rotations.extend(&path.rotations);
            all.fov_y_rad.extend(&path.fov_y_rad);
            all.up = all.up.or(path.up);
        }
        if times.is_empty() {
            return Err(EvaluationError::Empty { which: "merged path" });
        }
        let mut order: Vec<usize> = (0..times.len()).collect();
        order.sort_by(|a, b| times[*a].total_cmp(&times[*b]));
        all.times_secs = Some(times);
        Ok(all.select(&order))
    }
}

/// At most `max` items, evenly spaced, with both ends.
fn evenly(items: &[usize], max: usize) -> Vec<usize> {
    let Some(last) = items.len().checked_sub(1).filter(|_| items.len() > max) else { return items.to_vec() };
    if max <= 1 {
        return items[..max].to_vec();
    }
    let step = last as f64 / (max - 1) as f64;
    let at = |k: usize| if k + 1 == max { last } else { (k as f64 * step) as usize };
    (0..max).map(|k| items[at(k)]).collect()
}

/// The first pose, and each that has moved or turned enough since the one kept before.
fn moved(path: &Trajectory, filter: &MotionFilter) -> Vec<usize> {
    let mut kept: Vec<usize> = vec![0; path.len().min(1)];
    let mut traveled = 0.0;
    for idx in 1..path.len() {
        let last = kept[kept.len() - 1];
        traveled += path.positions[idx].distance(path.positions[idx - 1]);
        let turned = rotation_angle(path.rotations[last].transpose() * path.rotations[idx]);
        if traveled >= filter.distance || turned >= filter.angle_rad {
            kept.push(idx);
            traveled = 0.0;
        }
    }
    kept
}
