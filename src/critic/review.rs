//! What the critic says about one film.

use strum::VariantArray;

use super::film::Film;
use super::limits::{self, LimitCheck};
use super::marks;
use super::picture::Picture;
use super::terms::{Term, Weights};

/// The mark of one term.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mark {
    /// The term.
    pub term: Term,
    /// 0..=1, 1 is best; `None` where the term says nothing about the film.
    pub value: Option<f64>,
}

/// A film judged on its pictures.
#[derive(Debug, Clone, PartialEq)]
pub struct Review {
    /// One mark per term, in the order of the table.
    pub marks: Vec<Mark>,
    /// The limits that apply.
    pub limits: Vec<LimitCheck>,
    /// What was measured, in order of time.
    pub pictures: Vec<Picture>,
    /// The largest median size of a subject's splats at a moment at which it should be seen, pixels of the film, with the
    /// height of the subject over the frame's. Without subjects the whole picture's, without a height.
    pub coarsest: Option<(f64, Option<f64>)>,
}

impl Review {
    /// Marks a film by its pictures, which are in order of time.
    pub fn new(film: &Film, pictures: Vec<Picture>) -> Self {
        let mark = |&term: &Term| Mark { term, value: marks::value(term, film, &pictures) };
        Self {
            marks: Term::VARIANTS.iter().map(mark).collect(),
            limits: limits::checks(film, &pictures),
            coarsest: coarsest(film, &pictures),
            pictures,
        }
    }

    /// Weighted mean of the marks, 0..=1.
    pub fn score(&self, weights: &Weights) -> f64 {
        let rated = || self.marks.iter().filter_map(|mark| Some((weights.of(mark.term), mark.value?)));
        let total: f64 = rated().map(|(weight, _)| weight).sum();
        if total > 0.0 { rated().map(|(weight, value)| weight * value).sum::<f64>() / total } else { 0.0 }
    }

    /// Number of limits that the film breaks.
    pub fn num_broken(&self) -> usize {
        self.limits.iter().filter(|check| !check.is_kept()).count()
    }

    /// The mark of a term.
    pub fn value(&self, term: Term) -> Option<f64> {
        self.marks.iter().find(|mark| mark.term == term)?.value
    }
}

fn coarsest(film: &Film, pictures: &[Picture]) -> Option<(f64, Option<f64>)> {
    let of_subjects =
        limits::due_sights(film, pictures).filter_map(|(_, sight)| Some((sight.splat_px?, sight.height_frac)));
    let of_pictures = pictures.iter().map(|picture| (picture.splat_px, None));
    let larger = |a: &(f64, Option<f64>), b: &(f64, Option<f64>)| a.0.total_cmp(&b.0);
    of_subjects.max_by(larger).or_else(|| of_pictures.max_by(larger))
}
