use std::fmt::Write as _;

use cinesplat::critic::{Limit, Picture, Review, TERMS, Weights};
use cinesplat::pipeline::Critique;
use cinesplat::trajectory::Shot;

/// What is measured on one film.
#[derive(Debug, Clone)]
pub(super) struct FilmRow {
    id: String,
    secs: f64,
    num_unmet: usize,
    /// Time of the solver and of the critic.
    times: [f64; 2],
    pub(super) critique: Critique,
}

/// Columns of the figures, with the figure.
type Figure = (&'static str, fn(&Review) -> f64);

/// Figures of a film beside its marks.
const FIGURES: [Figure; 11] = [
    ("worst_void", |review| worst(review, |picture| picture.void_frac)),
    ("mean_void", |review| mean(review, |picture| picture.void_frac)),
    ("worst_blocked", |review| worst(review, |picture| picture.blocked_frac)),
    ("worst_foreground", |review| worst(review, |picture| picture.foreground_frac)),
    ("lost", |review| limit(review, Limit::Lost)),
    ("black", |review| limit(review, Limit::Black)),
    ("least_seen", |review| review.pictures.iter().flat_map(|p| &p.sights).map(|s| s.seen_frac).fold(1.0, f64::min)),
    ("splat_px", |review| review.coarsest.map_or(f64::NAN, |(px, _)| px)),
    ("brightness", |review| mean(review, |picture| picture.brightness)),
    ("depth_ratio", |review| mean(review, |picture| picture.depth_ratio)),
    ("broken_limits", |review| review.num_broken() as f64),
];

impl FilmRow {
    pub(super) fn new(id: &str, shot: &Shot, critique: Critique, times: [f64; 2]) -> Self {
        let num_unmet = critique.candidates.first().map_or(0, |film| film.num_unmet);
        Self { id: id.to_owned(), secs: shot.duration_secs, num_unmet, times, critique }
    }

    fn review(&self) -> Option<&Review> {
        self.critique.candidates.first().map(|film| &film.review)
    }

    fn cells(&self) -> Vec<String> {
        let [solve, judge] = self.times;
        let films = &self.critique.candidates;
        let first = self.critique.ranks.first().map_or(0, |rank| rank + 1);
        let mut cells = vec![
            self.id.clone(),
            format!("{:.2}", self.secs),
            self.num_unmet.to_string(),
            films.len().to_string(),
            first.to_string(),
            format!("{solve:.3}"),
            format!("{judge:.3}"),
        ];
        let Some(review) = self.review() else { return cells };
        cells.push(format!("{:.4}", review.score(&Weights::default())));
        cells.extend(FIGURES.iter().map(|(_, figure)| format!("{:.4}", figure(review))));
        cells.extend(
            TERMS.iter().map(|row| review.value(row.term).map_or(String::new(), |value| format!("{value:.3}"))),
        );
        cells
    }

    pub(super) fn csv_line(&self) -> String {
        self.cells().join(",") + "\n"
    }
}

fn worst(review: &Review, of: fn(&Picture) -> f64) -> f64 {
    review.pictures.iter().map(of).fold(0.0, f64::max)
}

fn mean(review: &Review, of: fn(&Picture) -> f64) -> f64 {
    review.pictures.iter().map(of).sum::<f64>() / review.pictures.len().max(1) as f64
}

fn limit(review: &Review, limit: Limit) -> f64 {
    review.limits.iter().find(|check| check.limit == limit).map_or(0.0, |check| check.got)
}

fn columns() -> Vec<&'static str> {
    let first = ["film", "secs", "unmet", "finalists", "chosen", "solve_secs", "judge_secs", "score"];
    let terms = TERMS.iter().map(|row| row.term.into());
    first.into_iter().chain(FIGURES.iter().map(|(name, _)| *name)).chain(terms).collect()
}

pub(super) fn csv_header() -> String {
    columns().join(",") + "\n"
}

pub(super) fn to_csv(rows: &[FilmRow]) -> String {
    rows.iter().fold(csv_header(), |csv, row| csv + &row.csv_line())
}

/// The rows as a Markdown table.
pub(super) fn to_table(rows: &[FilmRow]) -> String {
    let columns = columns();
    let mut table = format!("| {} |\n|{}\n", columns.join(" | "), "---|".repeat(columns.len()));
    for row in rows {
        // Writing to a string cannot fail.
        let _ = writeln!(table, "| {} |", row.cells().join(" | "));
    }
    table
}

/// Medians, 90th percentiles and worst values over all films.
pub(super) fn summary(rows: &[FilmRow]) -> String {
    let num = rows.len();
    let unmet = rows.iter().filter(|row| row.num_unmet > 0).count();
    let switched = rows.iter().filter(|row| row.critique.ranks.first().is_some_and(|&rank| rank > 0)).count();
    let mut text =
        format!("{num} films, {unmet} with unmet requirements, {switched} where the critic overruled the cost\n\n");
    text.push_str("| figure | median | 90th percentile | worst |\n|---|---|---|---|\n");
    let mut line = |name: &str, mut values: Vec<f64>| {
        values.retain(|value| value.is_finite());
        values.sort_by(f64::total_cmp);
        let at = |share: f64| {
            values.get(((values.len().max(1) - 1) as f64 * share).round() as usize).copied().unwrap_or(0.0)
        };
        let _ = writeln!(text, "| {name} | {:.3} | {:.3} | {:.3} |", at(0.5), at(0.9), at(1.0));
    };
    for (name, figure) in FIGURES {
        line(name, rows.iter().filter_map(FilmRow::review).map(figure).collect());
    }
    line("score", rows.iter().filter_map(FilmRow::review).map(|review| review.score(&Weights::default())).collect());
    line("solve and judge, s", rows.iter().map(|row| row.times[0] + row.times[1]).collect());
    line("judge, s", rows.iter().map(|row| row.times[1]).collect());
    text
}
