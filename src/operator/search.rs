//! The search over a program's open parameters: a beam search over the steps, then a local search on the best
//! candidate.
//!
//! The search is bounded and deterministic: the level fixes the number of candidates, every random number comes from
//! the seed in a fixed order, and ties go to the earlier candidate. The best candidate so far is always kept.

use std::iter;

use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use rayon::prelude::*;

use super::cost::cost;
use super::distinct::clearly_differ;
use super::motion::{MotionSegment, NUM_PARAMETERS, StepParameters};
use super::moves::{StepContext, build};
use super::program::Program;
use super::settings::{SolveLevel, SolveSettings};
use super::suggestion::{StepCameras, at_viewpoint, parameters_without_search};
use super::world::World;
use cinesplat_trajectory::CameraState;

/// Candidates per round of the local search. A round is evaluated in parallel.
const ROUND_SIZE: usize = 8;
/// Samples of the local search on another finalist, over those on the best one.
const OTHER_SHARE: f64 = 0.15;
/// Alternatives that are carried along, over those that are wanted: some end close to a better one.
const SPARE: usize = 2;
/// Spreads of the local search: of the best film, of the others, which keep to their own side, and of the last samples.
const WIDE_SPREAD: f64 = 0.25;
const NARROW_SPREAD: f64 = 0.12;
const LAST_SPREAD: f64 = 0.01;
/// Cost above the best candidate's from which a film is no alternative: that of one violated constraint.
const MAX_EXCESS: f64 = 3.0;
/// Changes the seed for the random numbers of the alternatives.
const OTHER_STREAM: u64 = 0x9e37_79b9_7f4a_7c15;

/// A candidate film up to some step: parameters, segments and cost of each step.
#[derive(Debug, Clone, Default)]
pub(super) struct Candidate {
    parameters: Vec<StepParameters>,
    pub(super) segments: Vec<Vec<MotionSegment>>,
    costs: Vec<f64>,
}

impl Candidate {
    /// Sum over the steps.
    pub(super) fn cost(&self) -> f64 {
        self.costs.iter().sum()
    }

    fn last(&self) -> Option<CameraState> {
        self.segments.iter().rev().find_map(|segments| segments.last()).map(MotionSegment::last)
    }

    fn origin(&self) -> Option<CameraState> {
        self.segments.iter().flatten().next().map(|segment| segment.states[0])
    }
}

/// The inputs of the search.
pub(super) struct SearchProblem<'a> {
    pub(super) world: &'a World,
    pub(super) program: &'a Program,
    pub(super) suggestions: &'a [StepCameras],
}

/// Number of candidates per phase.
struct Budget {
    /// Samples of the first step, and of a step after a cut.
    first_samples: usize,
    /// Samples of any other step, per candidate in the beam.
    step_samples: usize,
    /// Candidates kept after each step.
    beam_width: usize,
    /// Candidates of the local search on the best film.
    local_samples: usize,
    /// Candidates of the local search on each other finalist.
    other_samples: usize,
}

impl Budget {
    fn of(settings: &SolveSettings) -> Self {
        let (first, each, width, local) = match settings.level {
            SolveLevel::Off => (1.0, 1.0, 1.0, 0.0),
            SolveLevel::Fast => (220.0, 24.0, 10.0, 80.0),
            SolveLevel::Full => (900.0, 64.0, 28.0, 420.0),
        };
        let count = |samples: f64, factor: f64| ((samples * factor).round() as usize).max(1);
        // A later step is sampled for every candidate in the beam: samples and width share the factor.
        let (factor, root) = (settings.tries_factor, settings.tries_factor.sqrt());
        Self {
            first_samples: count(first, factor),
            step_samples: count(each, root),
            beam_width: count(width, root),
            local_samples: count(local, factor),
            other_samples: count(local * OTHER_SHARE, factor),
        }
    }
}

/// Up to `num` candidates that clearly differ, the others in order of cost. Without a search there is one.
///
/// The first is the same for every `num`. The local search spends its samples on the first, and a share of them on each of
/// the others, one of which may end below it.
pub(super) fn best_candidates(problem: &SearchProblem, settings: &SolveSettings, num: usize) -> Vec<Candidate> {
    if settings.level == SolveLevel::Off {
        return vec![only_candidate(problem)];
    }
    let mut rng = Pcg64Mcg::seed_from_u64(settings.seed);
    // The alternatives draw from numbers of their own, so that the best film does not depend on how many there are.
    let mut other_rng = Pcg64Mcg::seed_from_u64(settings.seed ^ OTHER_STREAM);
    let budget = Budget::of(settings);
    let mut beam = vec![Candidate::default()];
    let mut others: Vec<Candidate> = Vec::new();
    for index in 0..problem.program.steps.len() {
        let starts_anew = index == 0 || problem.program.steps[index].cut;
        let count = if starts_anew { budget.first_samples } else { budget.step_samples };
        let shares = if index == 0 { 1 } else { 1 + beam.len() * usize::from(count == budget.first_samples) };
        let mut candidates = problem.sampled(&beam, index, count.div_ceil(shares), &mut rng);
        candidates.extend(problem.sampled(
            &others,
            index,
            count.div_ceil(shares).min(budget.step_samples),
            &mut other_rng,
        ));
        candidates.sort_by(|a, b| a.cost().total_cmp(&b.cost()));
        others = clearly_distinct(problem.world, &candidates, if num > 1 { SPARE * num } else { 0 });
        beam = distinct(problem.world, candidates, budget.beam_width);
        others.retain(|other| !beam.iter().any(|kept| kept.parameters == other.parameters));
    }
    beam.extend(others);
    beam.sort_by(|a, b| a.cost().total_cmp(&b.cost()));
    let first = beam.first().cloned().unwrap_or_default();
    let local = LocalSearch { num_samples: budget.local_samples, spread: WIDE_SPREAD, apart_from: &[] };
    let best = local.improved(problem, first, &mut rng);
    beam.insert(0, best.clone());
    let mut improved = vec![best];
    for other in clearly_distinct(problem.world, &beam, SPARE * num).into_iter().skip(1) {
        if improved.len() == num.max(1) {
            break;
        }
        let local = LocalSearch { num_samples: budget.other_samples, spread: NARROW_SPREAD, apart_from: &improved };
        let other = local.improved(problem, other, &mut other_rng);
        if local.is_apart(problem.world, &other) {
            improved.push(other);
        }
    }
    improved[1..].sort_by(|a, b| a.cost().total_cmp(&b.cost()));
    improved
}

/// The candidate of a film that is not searched.
fn only_candidate(problem: &SearchProblem) -> Candidate {
    let num_steps = problem.program.steps.len();
    let given = problem.suggestions.iter().take(num_steps).copied();
    let suggestions: Vec<StepCameras> =
        given.chain(iter::repeat_with(|| at_viewpoint(problem.world)).map_while(|c| c)).take(num_steps).collect();
    let names_objects = |index: usize| {
        let mut named = problem.program.steps[..=index].iter().flat_map(|step| [&step.start, &step.end]);
        named.any(|framing| framing.subjects.iter().any(|&id| problem.world.subject(id).is_some()))
    };
    let parameters = |index| parameters_without_search(suggestions.get(index), names_objects(index));
    let parameters: Vec<StepParameters> = (0..num_steps).map(parameters).collect();
    SearchProblem { suggestions: &suggestions, ..*problem }.rebuilt(&Candidate::default(), 0, &parameters)
}

fn sample_parameters(rng: &mut impl Rng) -> StepParameters {
    std::array::from_fn(|_| rng.random::<f64>())
}

impl SearchProblem<'_> {
    /// `num` samples of one more step for each of some candidates. The first sample is the midpoint of every parameter.
    fn sampled(&self, before: &[Candidate], index: usize, num: usize, rng: &mut impl Rng) -> Vec<Candidate> {
        let mut jobs: Vec<(usize, StepParameters)> = Vec::new();
        for candidate in 0..before.len() {
            let sample = |i| if i == 0 { [0.5; NUM_PARAMETERS] } else { sample_parameters(rng) };
            jobs.extend((0..num).map(sample).map(|parameters| (candidate, parameters)));
        }
        let extended =
            |(candidate, parameters): (usize, StepParameters)| self.extended(&before[candidate], index, parameters);
        jobs.into_par_iter().map(extended).collect()
    }

    /// A candidate with one more step.
    fn extended(&self, candidate: &Candidate, index: usize, parameters: StepParameters) -> Candidate {
        let before = if self.program.steps[index].cut { None } else { candidate.last() };
        let suggestion = self.suggestions.get(index);
        let context =
            StepContext::new(self.world, (self.program, index), (before, candidate.origin()), suggestion, &parameters);
        let segments = build(&context);
        // Without a subject the camera stands where people stand, whatever the director proposes.
        let proposed = suggestion.filter(|_| before.is_none() && context.names_objects()).map(|cameras| cameras.start);
        let own: f64 = segments.iter().map(|segment| cost(self.world, segment, proposed.as_ref())).sum();
        let mut out = candidate.clone();
        out.parameters.push(parameters);
        out.segments.push(segments);
        out.costs.push(own);
        out
    }

    /// The candidate of a full list of parameters. Its first `kept` steps are copied from `candidate`.
    fn rebuilt(&self, candidate: &Candidate, kept: usize, parameters: &[StepParameters]) -> Candidate {
        let mut out = Candidate {
            parameters: candidate.parameters[..kept].to_vec(),
            segments: candidate.segments[..kept].to_vec(),
            costs: candidate.costs[..kept].to_vec(),
        };
        for (index, &parameters) in parameters.iter().enumerate().skip(kept) {
            out = self.extended(&out, index, parameters);
        }
        out
    }
}

/// The first `num` of candidates in order of cost that clearly differ from every better one. Candidates that violate more
/// than the best one are no alternatives.
fn clearly_distinct(world: &World, candidates: &[Candidate], num: usize) -> Vec<Candidate> {
    let mut kept: Vec<Candidate> = Vec::new();
    for candidate in candidates {
        let is_worse = kept.first().is_some_and(|best| candidate.cost() > best.cost() + MAX_EXCESS);
        if kept.len() >= num || is_worse {
            break;
        }
        let differs = |other: &Candidate| clearly_differ(world.bounds.size(), &candidate.segments, &other.segments);
        if kept.iter().all(differs) {
            kept.push(candidate.clone());
        }
    }
    kept
}

/// The first `width` candidates that do not end close to where a better one ends.
fn distinct(world: &World, candidates: Vec<Candidate>, width: usize) -> Vec<Candidate> {
    let apart = 0.015 * world.bounds.size();
    let mut kept: Vec<Candidate> = Vec::with_capacity(width);
    for candidate in candidates {
        if kept.len() == width {
            break;
        }
        let ends_alike = |other: &Candidate| match (candidate.last(), other.last()) {
            (Some(a), Some(b)) => {
                a.pose.position.distance(b.pose.position) < apart
                    && a.pose.forward().dot(b.pose.forward()) > 0.999
                    && (a.fov_y_rad - b.fov_y_rad).abs() < 0.05
            }
            _ => false,
        };
        if !kept.iter().any(ends_alike) {
            kept.push(candidate);
        }
    }
    kept
}

/// A local search: each round perturbs one step per sample and keeps the best sample where it lowers the cost.
struct LocalSearch<'a> {
    num_samples: usize,
    /// Share of a parameter's range that the first samples span. The last ones span a hundredth of the range.
    spread: f64,
    /// Films from which the result must clearly differ.
    apart_from: &'a [Candidate],
}

impl LocalSearch<'_> {
    fn improved(&self, problem: &SearchProblem, mut best: Candidate, rng: &mut Pcg64Mcg) -> Candidate {
        for round in 0..self.num_samples / ROUND_SIZE {
            let progress = round as f64 * ROUND_SIZE as f64 / self.num_samples as f64;
            let spread = self.spread * (LAST_SPREAD / self.spread).powf(progress);
            let samples: Vec<(usize, Vec<StepParameters>)> =
                (0..ROUND_SIZE).map(|_| perturbed(&best.parameters, spread, rng)).collect();
            let candidates: Vec<Candidate> =
                samples.par_iter().map(|(kept, parameters)| problem.rebuilt(&best, *kept, parameters)).collect();
            let apart = candidates.into_iter().filter(|candidate| self.is_apart(problem.world, candidate));
            let better = apart.min_by(|a, b| a.cost().total_cmp(&b.cost()));
            best = better.filter(|better| better.cost() < best.cost() - 1e-9).unwrap_or(best);
        }
        best
    }

    fn is_apart(&self, world: &World, candidate: &Candidate) -> bool {
        let size = world.bounds.size();
        self.apart_from.iter().all(|other| clearly_differ(size, &candidate.segments, &other.segments))
    }
}

/// The parameters with some of one step changed by up to `spread`, and the index of that step.
fn perturbed(parameters: &[StepParameters], spread: f64, rng: &mut impl Rng) -> (usize, Vec<StepParameters>) {
    let mut out = parameters.to_vec();
    let step = rng.random_range(0..parameters.len().max(1));
    for parameter in &mut out[step] {
        let (on, by) = (rng.random::<f64>(), rng.random::<f64>());
        if on < 0.45 {
            *parameter = (*parameter + (by * 2.0 - 1.0) * spread).clamp(0.0, 1.0);
        }
    }
    (step, out)
}
