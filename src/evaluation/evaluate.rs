//! Absolute and relative pose error of an estimate against a reference.

use super::error::{EvaluationError, SettingName};
use super::focal::focal_error;
use super::relation::Rigid;
use super::{
    Align, AlignSettings, Alignment, Convention, FocalError, FramingError, MatchSettings, Matches, Matching,
    PairSettings, Relation, Statistics, SubjectSphere, Trajectory, align, associate, framing_error, pairs,
};

/// The error to compute.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Metric {
    /// Absolute, per pose: E = estimate^-1 * reference.
    #[default]
    Ape,
    /// Relative, of the motion between two poses: E = (reference motion)^-1 * estimate motion.
    Rpe {
        /// Choice of the pairs of poses.
        pairs: PairSettings,
        /// Whether the pairs are chosen on the reference; otherwise on the aligned estimate.
        pairs_from_reference: bool,
    },
}

/// Settings of a comparison. By default paths are not aligned.
#[derive(Debug, Clone, PartialEq)]
pub struct EvalSettings {
    /// Absolute or relative error.
    pub metric: Metric,
    /// The measured part of the error pose.
    pub relation: Relation,
    /// Alignment before the error is computed.
    pub align: Align,
    /// Number of poses from the start that determine the alignment; `None` for all.
    pub align_poses: Option<usize>,
    /// Largest time difference of a match.
    pub max_diff_secs: f64,
    /// Added to the estimate's times before matching.
    pub estimate_offset_secs: f64,
    /// Method of matching poses.
    pub matching: Matching,
    /// Whose choices decide where this program and evo differ.
    pub convention: Convention,
    /// Diameter of the scene for the relative error; `None` for that of the reference path.
    pub scene_diameter: Option<f64>,
    /// Subject whose framing is compared.
    pub subject: Option<SubjectSphere>,
}

impl Default for EvalSettings {
    fn default() -> Self {
        Self {
            metric: Metric::Ape,
            relation: Relation::Trans,
            align: Align::None,
            align_poses: None,
            max_diff_secs: 0.01,
            estimate_offset_secs: 0.0,
            matching: Matching::Nearest,
            convention: Convention::Cinesplat,
            scene_diameter: None,
            subject: None,
        }
    }
}

/// The result of a comparison.
#[derive(Debug, Clone, PartialEq)]
pub struct Evaluation {
    /// The settings.
    pub settings: EvalSettings,
    /// Statistics of `errors`.
    pub statistics: Statistics,
    /// The errors in order of time, in the unit of the relation.
    pub errors: Vec<f64>,
    /// Time of each error on the reference's clock, of the later pose for a pair; pose indices without times.
    pub at_secs: Vec<f64>,
    /// Index of the matched pose of each error, of the later one for a pair.
    pub pose_idx: Vec<usize>,
    /// The alignment.
    pub alignment: Alignment,
    /// Matched poses, with the aligned estimate.
    pub matches: Matches,
    /// Error of the focal lengths; `None` if a file has no fields of view.
    pub focal: Option<FocalError>,
    /// Error of the subject's framing; `None` without a subject or if a file has no fields of view.
    pub framing: Option<FramingError>,
    /// Mean error over the diameter of the scene or reference path; `None` for errors that are not in scene units.
    pub relative_to_diameter: Option<f64>,
    /// Notes about matching and alignment, as text for the user.
    pub notes: Vec<String>,
}

/// Compares `estimate` with `reference`.
///
/// # Errors
/// [`EvaluationError::Empty`] for a path without poses, [`EvaluationError::NoMatches`] if no poses match,
/// [`EvaluationError::NoPairs`] if no pairs exist, [`EvaluationError::BadSetting`] for a setting out of range. The
/// shape of a path is never an error.
pub fn evaluate(
    reference: &Trajectory,
    estimate: &Trajectory,
    settings: &EvalSettings,
) -> Result<Evaluation, EvaluationError> {
    check(settings)?;
    let mut shifted = estimate.clone();
    if let Some(times) = &mut shifted.times_secs {
        for time in times {
            *time += settings.estimate_offset_secs;
        }
    }
    let EvalSettings { max_diff_secs, matching, convention, align: mode, align_poses: num_poses, .. } = *settings;
    let mut matches = associate(reference, &shifted, &MatchSettings { max_diff_secs, matching, convention })?;
    let how = AlignSettings { mode, num_poses, convention };
    let alignment = align(&matches.reference, &matches.estimate, &how)?;
    matches.estimate = alignment.apply(&matches.estimate);
    let mut notes = matches.notes.clone();
    notes.extend(alignment.note.clone());
    let (errors, ends) = match &settings.metric {
        Metric::Ape => (absolute_errors(&matches, settings.relation), (0..matches.reference.len()).collect()),
        Metric::Rpe { pairs: choice, pairs_from_reference } => {
            let path = if *pairs_from_reference { &matches.reference } else { &matches.estimate };
            relative_errors(&matches, &pairs(path, choice)?, settings.relation, &mut notes)
        }
    };
    let times = matches.reference.times_or_indices();
    let diameter = settings.scene_diameter.unwrap_or_else(|| matches.reference.diameter());
    let statistics = Statistics::of(&errors)?;
    let has_ratio = settings.relation.is_length() && diameter > 0.0;
    Ok(Evaluation {
        statistics,
        at_secs: ends.iter().filter_map(|idx: &usize| times.get(*idx).copied()).collect(),
        pose_idx: ends,
        errors,
        alignment,
        focal: focal_error(&matches.reference, &matches.estimate),
        framing: settings.subject.and_then(|s| framing_error(&matches.reference, &matches.estimate, &s)),
        relative_to_diameter: has_ratio.then(|| statistics.mean / diameter),
        matches,
        notes,
        settings: settings.clone(),
    })
}

impl Evaluation {
    /// What was compared and how: metric, relation, alignment, number of errors.
    pub fn title(&self) -> String {
        format!("{}, {} errors", self.method(), self.errors.len())
    }

    /// How it was compared: metric, for relative errors over which distance, relation, alignment. Comparisons with the
    /// same settings have the same text.
    pub fn method(&self) -> String {
        let settings = &self.settings;
        let metric = match &settings.metric {
            Metric::Ape => "absolute pose error".to_owned(),
            Metric::Rpe { pairs, pairs_from_reference } => {
                let (delta, unit) = pairs.delta.named();
                let of = if *pairs_from_reference { " of the reference" } else { "" };
                let all = if pairs.all_pairs { ", all pairs" } else { "" };
                format!("relative pose error over {delta} {}{of}{all}", singular(unit, delta))
            }
        };
        let (relation, align) = (settings.relation.as_ref(), settings.align.as_ref());
        format!("{metric}, {relation}, align {align}")
    }

    /// How it was compared, and the unit of the errors.
    pub(super) fn measure(&self) -> String {
        match self.settings.relation.unit() {
            "" => self.method(),
            unit => format!("{}, in {unit}", self.method()),
        }
    }
}

/// The name of a unit behind a number: `1 frame`, `5 frames`.
fn singular(unit: &str, number: f64) -> &str {
    if (number - 1.0).abs() < f64::EPSILON { unit.strip_suffix('s').unwrap_or(unit) } else { unit }
}

fn check(settings: &EvalSettings) -> Result<(), EvaluationError> {
    let bad = |setting, found: f64, expected| {
        Err(EvaluationError::BadSetting { setting, found: found.to_string(), expected })
    };
    if !(settings.max_diff_secs >= 0.0) {
        return bad(SettingName::MaxDiff, settings.max_diff_secs, "0 or more seconds");
    }
    if !settings.estimate_offset_secs.is_finite() {
        return bad(SettingName::TimeOffset, settings.estimate_offset_secs, "a finite number of seconds");
    }
    if settings.scene_diameter.is_some_and(|diameter| !(diameter > 0.0)) {
        return bad(SettingName::Diameter, settings.scene_diameter.unwrap_or(0.0), "above 0");
    }
    if settings.relation == Relation::PointDistanceRatio && settings.metric == Metric::Ape {
        let (setting, found) = (SettingName::Relation, settings.relation.as_ref().to_owned());
        return Err(EvaluationError::BadSetting { setting, found, expected: "a relation of absolute errors" });
    }
    Ok(())
}

fn rigid(path: &Trajectory, idx: usize) -> Rigid {
    Rigid { rotation: path.rotations[idx], translation: path.positions[idx] }
}

fn absolute_errors(matches: &Matches, relation: Relation) -> Vec<f64> {
    let (reference, estimate) = (&matches.reference, &matches.estimate);
    let error = |idx: usize| match relation {
        Relation::Trans | Relation::PointDistance => reference.positions[idx].distance(estimate.positions[idx]),
        _ => rigid(estimate, idx).to(rigid(reference, idx)).error(relation),
    };
    (0..reference.len()).map(error).collect()
}

/// Error of each pair and the index of its later pose.
pub(super) fn relative_errors(
    matches: &Matches,
    pairs: &[(usize, usize)],
    relation: Relation,
    notes: &mut Vec<String>,
) -> (Vec<f64>, Vec<usize>) {
    let (reference, estimate) = (&matches.reference, &matches.estimate);
    let moved = |path: &Trajectory, a: usize, b: usize| path.positions[a].distance(path.positions[b]);
    let motion = |path: &Trajectory, a: usize, b: usize| rigid(path, a).to(rigid(path, b));
    let error = |(a, b): (usize, usize)| match relation {
        Relation::PointDistance => Some((moved(reference, a, b) - moved(estimate, a, b)).abs()),
        Relation::PointDistanceRatio => {
            let wanted = moved(reference, a, b);
            (wanted != 0.0).then(|| 100.0 * (wanted - moved(estimate, a, b)).abs() / wanted)
        }
        _ => Some(motion(reference, a, b).to(motion(estimate, a, b)).error(relation)),
    };
    let kept: Vec<(f64, usize)> = pairs.iter().filter_map(|pair| Some((error(*pair)?, pair.1))).collect();
    let standing = pairs.len() - kept.len();
    if standing > 0 {
        notes.push(format!("{standing} pairs are omitted: the reference is stationary, so they have no ratio"));
    }
    kept.into_iter().unzip()
}
