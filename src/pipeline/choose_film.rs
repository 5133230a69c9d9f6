use cinesplat_critic::{Candidate, Critic, CriticSettings, Film, Subjects, Weights, ranked, report_lines};
use cinesplat_operator::{Program, Solution, SolveLevel, World};
use cinesplat_scene::Scene;

use super::error::PipelineError;

/// How the critic chooses among the films that the search finishes.
#[derive(Debug, Clone, PartialEq)]
pub struct FilmChoice {
    /// Number of films to keep that clearly differ, the best first.
    pub num_takes: usize,
    /// Films to finish and look at; `None` = 4 for [`SolveLevel::Full`], 2 for [`SolveLevel::Fast`].
    /// [`SolveLevel::Off`] finishes one, and nobody looks at it.
    pub num_finalists: Option<usize>,
    /// How closely the critic looks.
    pub critic: CriticSettings,
    /// Weights of its terms.
    pub weights: Weights,
}

impl Default for FilmChoice {
    fn default() -> Self {
        Self { num_takes: 1, num_finalists: None, critic: CriticSettings::default(), weights: Weights::default() }
    }
}

impl FilmChoice {
    /// Films to finish at a level of effort; at least the number of takes.
    pub fn num_finalists(&self, level: SolveLevel) -> usize {
        let num = self.num_finalists.unwrap_or(match level {
            SolveLevel::Off => 1,
            SolveLevel::Fast => 2,
            SolveLevel::Full => 4,
        });
        // Some finalists end alike after the local search: a few more than the takes.
        let for_takes = if self.num_takes > 1 { self.num_takes + self.num_takes / 2 } else { 1 };
        num.max(for_takes)
    }
}

/// What the critic said about the films that it chose from.
#[derive(Debug, Clone, PartialEq)]
pub struct Critique {
    /// What was said about each film, the best first.
    pub candidates: Vec<Candidate>,
    /// The films.
    pub films: Vec<Film>,
    /// Place of each of these films in the operator's own order, by cost, from 0.
    pub ranks: Vec<usize>,
}

/// Sorts the finished films of a program, the best first, and adds the critic's lines to their reports.
///
/// # Errors
/// [`PipelineError::Render`] when the pictures cannot be rendered.
pub(super) fn choose_film(
    (scene, world): (&Scene, &World),
    (program, subjects): (&Program, &Subjects),
    solutions: &mut Vec<Solution>,
    size_px: [u32; 2],
    choice: &FilmChoice,
) -> Result<Critique, PipelineError> {
    let critic = Critic::new((scene, &world.bounds), subjects, choice.critic);
    let films: Vec<Film> = solutions.iter().map(|solution| Film::new(world, program, solution, size_px)).collect();
    let mut candidates = Vec::new();
    for (solution, film) in solutions.iter().zip(&films) {
        let num_unmet = solution.report.iter().filter(|line| !line.met).count();
        candidates.push(Candidate { num_unmet, review: critic.glance(film)? });
    }
    let weights = &choice.weights;
    let mut ranks = ranked(&candidates, weights);
    // A closer look at those that come into question. More moments find more faults: the others stay behind them.
    let num_close = (choice.num_takes + 1).min(ranks.len());
    for &rank in &ranks[..num_close] {
        let review = critic.review(&films[rank], Some(&candidates[rank].review))?;
        candidates[rank].review = review;
    }
    let close: Vec<Candidate> = ranks[..num_close].iter().map(|&rank| candidates[rank].clone()).collect();
    let order: Vec<usize> = ranked(&close, weights).into_iter().map(|place| ranks[place]).collect();
    ranks[..num_close].copy_from_slice(&order);
    for (solution, candidate) in solutions.iter_mut().zip(&candidates) {
        solution.report.extend(report_lines(&candidate.review, size_px, candidates.len()));
    }
    *solutions = ranks.iter().map(|&rank| solutions[rank].clone()).collect();
    let films = ranks.iter().map(|&rank| films[rank].clone()).collect();
    let candidates = ranks.iter().map(|&rank| candidates[rank].clone()).collect();
    Ok(Critique { candidates, films, ranks })
}
