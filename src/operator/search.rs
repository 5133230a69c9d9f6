//! The search for what a program leaves open: a beam over steps, then small changes to the best film found.
//!
//! Bounded and deterministic: the number of tries is fixed by the level, every random number comes from the seed in a
//! fixed order, and ties go to the earlier try. The best film so far is never lost.

use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use rayon::prelude::*;

use super::draft::{Genes, NUM_GENES, Part};
use super::judge::cost;
use super::moves::{Scenario, build};
use super::world::World;
use super::{Program, SolveLevel, SolveSettings, Suggestion};
use cinesplat_trajectory::CameraState;

/// A film up to some step: the choices made, the parts they give and what they cost, step by step.
#[derive(Debug, Clone, Default)]
pub(super) struct Film {
    genes: Vec<Genes>,
    pub(super) parts: Vec<Vec<Part>>,
    costs: Vec<f64>,
}

impl Film {
    /// Sum over steps.
    pub(super) fn cost(&self) -> f64 {
        self.costs.iter().sum()
    }

    fn last(&self) -> Option<CameraState> {
        self.parts.iter().rev().find_map(|parts| parts.last()).map(Part::last)
    }

    fn origin(&self) -> Option<CameraState> {
        self.parts.iter().flatten().next().map(|part| part.states[0])
    }
}

/// What a search is about.
pub(super) struct Task<'a> {
    pub(super) world: &'a World,
    pub(super) program: &'a Program,
    pub(super) suggestions: &'a [Suggestion],
}

/// Numbers of tries of a level: first step, tries a film and step after it, films kept, changes at the end.
fn budget(settings: &SolveSettings) -> (usize, usize, usize, usize) {
    let (first, each, width, changes) = match settings.level {
        SolveLevel::Off => return (1, 1, 1, 0),
        SolveLevel::Fast => (220.0, 24.0, 10.0, 80.0),
        SolveLevel::Full => (900.0, 64.0, 28.0, 420.0),
    };
    let count = |tries: f64, factor: f64| ((tries * factor).round() as usize).max(1);
    // Steps after the first are tried for every film kept: both share the factor.
    let (factor, root) = (settings.tries_factor, settings.tries_factor.sqrt());
    (count(first, factor), count(each, root), count(width, root), count(changes, factor))
}

/// The best film found.
pub(super) fn best_film(task: &Task, settings: &SolveSettings) -> Film {
    let mut rng = Pcg64Mcg::seed_from_u64(settings.seed);
    let (first_tries, tries, width, changes) = budget(settings);
    let mut beam = vec![Film::default()];
    for index in 0..task.program.steps.len() {
        let count = if index == 0 || task.program.steps[index].cut { first_tries } else { tries };
        let mut jobs: Vec<(usize, Genes)> = Vec::new();
        for film in 0..beam.len() {
            let draws = count.div_ceil(if index == 0 { 1 } else { 1 + beam.len() * usize::from(count == first_tries) });
            jobs.extend((0..draws).map(|draw| (film, if draw == 0 { [0.5; NUM_GENES] } else { draw_genes(&mut rng) })));
        }
        let mut films: Vec<Film> =
            jobs.into_par_iter().map(|(film, genes)| task.extended(&beam[film], index, genes)).collect();
        films.sort_by(|a, b| a.cost().total_cmp(&b.cost()));
        beam = diverse(task.world, films, width);
    }
    let best = beam.into_iter().next().unwrap_or_default();
    improved(task, best, changes, &mut rng)
}

fn draw_genes(rng: &mut impl Rng) -> Genes {
    std::array::from_fn(|_| rng.random::<f64>())
}

impl Task<'_> {
    /// A film with one more step.
    fn extended(&self, film: &Film, index: usize, genes: Genes) -> Film {
        let before = if self.program.steps[index].cut { None } else { film.last() };
        let suggestion = self.suggestions.get(index);
        let scenario = Scenario::new(self.world, (self.program, index), (before, film.origin()), suggestion, &genes);
        let parts = build(&scenario);
        let guess = suggestion.filter(|_| before.is_none()).map(|s| s.state);
        let own: f64 = parts.iter().map(|part| cost(self.world, part, guess.as_ref())).sum();
        let mut out = film.clone();
        out.genes.push(genes);
        out.parts.push(parts);
        out.costs.push(own);
        out
    }

    /// The film that a whole list of choices gives, keeping the first `kept` steps of `film`.
    fn rebuilt(&self, film: &Film, kept: usize, genes: &[Genes]) -> Film {
        let mut out = Film {
            genes: film.genes[..kept].to_vec(),
            parts: film.parts[..kept].to_vec(),
            costs: film.costs[..kept].to_vec(),
        };
        for (index, &genes) in genes.iter().enumerate().skip(kept) {
            out = self.extended(&out, index, genes);
        }
        out
    }
}

/// The best films, without those that end (nearly) where a better one ends.
fn diverse(world: &World, films: Vec<Film>, width: usize) -> Vec<Film> {
    let apart = 0.015 * world.bounds.size();
    let mut kept: Vec<Film> = Vec::with_capacity(width);
    for film in films {
        if kept.len() == width {
            break;
        }
        let same = |other: &Film| match (film.last(), other.last()) {
            (Some(a), Some(b)) => {
                a.pose.position.distance(b.pose.position) < apart
                    && a.pose.forward().dot(b.pose.forward()) > 0.999
                    && (a.fov_y_rad - b.fov_y_rad).abs() < 0.05
            }
            _ => false,
        };
        if !kept.iter().any(same) {
            kept.push(film);
        }
    }
    kept
}

/// Small changes to one step at a time, in rounds of eight tries at once; a change stays when the film gets better.
fn improved(task: &Task, mut film: Film, changes: usize, rng: &mut Pcg64Mcg) -> Film {
    const ROUND: usize = 8;
    for round in 0..changes / ROUND {
        // From a quarter of the range down to a hundredth.
        let spread = 0.25 * 0.04_f64.powf(round as f64 * ROUND as f64 / changes as f64);
        let tries: Vec<(usize, Vec<Genes>)> = (0..ROUND).map(|_| changed(&film.genes, spread, rng)).collect();
        let films: Vec<Film> = tries.par_iter().map(|(kept, genes)| task.rebuilt(&film, *kept, genes)).collect();
        let better = films.into_iter().min_by(|a, b| a.cost().total_cmp(&b.cost()));
        film = better.filter(|better| better.cost() < film.cost() - 1e-9).unwrap_or(film);
    }
    film
}

/// Choices with some of one step's moved by up to `spread`, and the index of that step.
fn changed(genes: &[Genes], spread: f64, rng: &mut impl Rng) -> (usize, Vec<Genes>) {
    let mut out = genes.to_vec();
    let step = rng.random_range(0..genes.len().max(1));
    for gene in &mut out[step] {
        let (on, by) = (rng.random::<f64>(), rng.random::<f64>());
        if on < 0.45 {
            *gene = (*gene + (by * 2.0 - 1.0) * spread).clamp(0.0, 1.0);
        }
    }
    (step, out)
}
