use std::collections::BTreeMap;
use std::fmt::Write as _;

use cinesplat::critic::{Candidate, Picture, Review, Weights, ranked};
use cinesplat::pipeline::{Critique, Phase, PhaseTimes};

/// Numbers of finalists to compare, and the one of the run that the scores come from.
pub(super) const FINALISTS: [usize; 6] = [1, 2, 3, 4, 6, 8];
pub(super) const MOST_FINALISTS: usize = 8;
/// Numbers of moments to compare, each one more than a divisor of the most less one.
const MOMENTS: [usize; 4] = [5, 9, 17, 33];
/// Moments that the scores are measured at.
pub(super) const MOST_MOMENTS: usize = 33;

/// Score against the number of finalists and of moments, and time against the number of finalists.
#[derive(Debug, Default)]
pub(super) struct Curve {
    /// Sum of scores, broken limits and films per finalists and moments.
    scores: BTreeMap<(usize, usize), (f64, usize, usize)>,
    /// Times of solver and critic per number of finalists.
    times: BTreeMap<usize, Vec<[f64; 2]>>,
}

impl Curve {
    /// Chooses among the first finalists at fewer moments, and scores the choice at all of them.
    pub(super) fn add(&mut self, critique: &Critique) {
        for &num in &FINALISTS {
            for &moments in &MOMENTS {
                let Some((score, broken)) = chosen(critique, num, moments) else { continue };
                let entry = self.scores.entry((num, moments)).or_default();
                *entry = (entry.0 + score, entry.1 + broken, entry.2 + 1);
            }
        }
    }

    pub(super) fn add_times(&mut self, num_finalists: usize, times: &PhaseTimes) {
        let of = |phase| times.iter().find(|(known, _)| *known == phase).map_or(0.0, |(_, time)| time.as_secs_f64());
        self.times.entry(num_finalists).or_default().push([of(Phase::Solve), of(Phase::Judge)]);
    }

    pub(super) fn to_csv(&self) -> String {
        let mut csv =
            "finalists,moments,mean_score,broken_limits,median_solve_secs,median_judge_secs,worst_secs\n".to_owned();
        for ((num, moments), (score, broken, films)) in &self.scores {
            let times = self.times.get(num).map_or(&[][..], Vec::as_slice);
            let median = |idx: usize| {
                let mut values: Vec<f64> = times.iter().map(|time| time[idx]).collect();
                values.sort_by(f64::total_cmp);
                values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
            };
            let worst = times.iter().map(|[solve, judge]| solve + judge).fold(0.0, f64::max);
            let mean = score / (*films).max(1) as f64;
            // Writing to a string cannot fail.
            let _ = writeln!(csv, "{num},{moments},{mean:.4},{broken},{:.3},{:.3},{worst:.3}", median(0), median(1));
        }
        csv
    }
}

/// Score and broken limits, at all moments, of the film that is chosen from the operator's first `num` at `moments` moments.
fn chosen(critique: &Critique, num: usize, moments: usize) -> Option<(f64, usize)> {
    let weights = Weights::default();
    let places: Vec<usize> = (0..critique.ranks.len()).filter(|&place| critique.ranks[place] < num).collect();
    let coarse = |&place: &usize| {
        let (film, candidate) = (&critique.films[place], &critique.candidates[place]);
        let pictures = thinned(&candidate.review.pictures, moments);
        Candidate { num_unmet: candidate.num_unmet, review: Review::new(film, pictures) }
    };
    let seen: Vec<Candidate> = places.iter().map(coarse).collect();
    let best = places[*ranked(&seen, &weights).first()?];
    let review = &critique.candidates[best].review;
    Some((review.score(&weights), review.num_broken()))
}

/// Some of the pictures, at even places.
fn thinned(pictures: &[Picture], moments: usize) -> Vec<Picture> {
    let last = pictures.len().saturating_sub(1);
    let mut places: Vec<usize> = (0..moments).map(|i| i * last / (moments - 1)).collect();
    places.dedup();
    places.into_iter().filter_map(|place| pictures.get(place).cloned()).collect()
}
