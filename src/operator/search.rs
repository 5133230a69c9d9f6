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
use super::motion::{MotionSegment, NUM_PARAMETERS, StepParameters};
use super::moves::{StepContext, build};
use super::program::Program;
use super::settings::{SolveLevel, SolveSettings};
use super::suggestion::{StepCameras, at_viewpoint, parameters_without_search};
use super::world::World;
use cinesplat_trajectory::CameraState;

/// Candidates per round of the local search. A round is evaluated in parallel.
const ROUND_SIZE: usize = 8;

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
    /// Candidates of the local search.
    local_samples: usize,
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
        }
    }
}

/// The candidate of least cost.
pub(super) fn best_candidate(problem: &SearchProblem, settings: &SolveSettings) -> Candidate {
    if settings.level == SolveLevel::Off {
        return only_candidate(problem);
    }
    let mut rng = Pcg64Mcg::seed_from_u64(settings.seed);
    let budget = Budget::of(settings);
    let mut beam = vec![Candidate::default()];
    for index in 0..problem.program.steps.len() {
        let starts_anew = index == 0 || problem.program.steps[index].cut;
        let count = if starts_anew { budget.first_samples } else { budget.step_samples };
        let mut jobs: Vec<(usize, StepParameters)> = Vec::new();
        for candidate in 0..beam.len() {
            let shares = if index == 0 { 1 } else { 1 + beam.len() * usize::from(count == budget.first_samples) };
            // The first sample is the midpoint of every parameter.
            jobs.extend(
                (0..count.div_ceil(shares))
                    .map(|i| (candidate, if i == 0 { [0.5; NUM_PARAMETERS] } else { sample_parameters(&mut rng) })),
            );
        }
        let mut candidates: Vec<Candidate> = jobs
            .into_par_iter()
            .map(|(candidate, parameters)| problem.extended(&beam[candidate], index, parameters))
            .collect();
        candidates.sort_by(|a, b| a.cost().total_cmp(&b.cost()));
        beam = distinct(problem.world, candidates, budget.beam_width);
    }
    let best = beam.into_iter().next().unwrap_or_default();
    locally_improved(problem, best, budget.local_samples, &mut rng)
}

/// The candidate of a film that is not searched.
fn only_candidate(problem: &SearchProblem) -> Candidate {
    let num_steps = problem.program.steps.len();
    let given = problem.suggestions.iter().take(num_steps).copied();
    let suggestions: Vec<StepCameras> =
        given.chain(iter::repeat_with(|| at_viewpoint(problem.world)).map_while(|c| c)).take(num_steps).collect();
    let parameters = |index| parameters_without_search(suggestions.get(index));
    let parameters: Vec<StepParameters> = (0..num_steps).map(parameters).collect();
    SearchProblem { suggestions: &suggestions, ..*problem }.rebuilt(&Candidate::default(), 0, &parameters)
}

fn sample_parameters(rng: &mut impl Rng) -> StepParameters {
    std::array::from_fn(|_| rng.random::<f64>())
}

impl SearchProblem<'_> {
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

/// Local search: each round perturbs one step per sample and keeps the best sample where it lowers the cost.
fn locally_improved(problem: &SearchProblem, mut best: Candidate, num_samples: usize, rng: &mut Pcg64Mcg) -> Candidate {
    for round in 0..num_samples / ROUND_SIZE {
        // The step size falls from a quarter of a parameter's range to a hundredth.
        let spread = 0.25 * 0.04_f64.powf(round as f64 * ROUND_SIZE as f64 / num_samples as f64);
        let samples: Vec<(usize, Vec<StepParameters>)> =
            (0..ROUND_SIZE).map(|_| perturbed(&best.parameters, spread, rng)).collect();
        let candidates: Vec<Candidate> =
            samples.par_iter().map(|(kept, parameters)| problem.rebuilt(&best, *kept, parameters)).collect();
        let better = candidates.into_iter().min_by(|a, b| a.cost().total_cmp(&b.cost()));
        best = better.filter(|better| better.cost() < best.cost() - 1e-9).unwrap_or(best);
    }
    best
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
