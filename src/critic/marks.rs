//! The mark of each term.

use super::film::Film;
use super::limits::{due_sights, is_lost};
use super::picture::{Picture, Sight};
use super::resolution::MAX_SPLAT_FRAC;
use super::terms::Term;

/// Cost of a step up to which every requirement was met during the search; the mark of the margin is 0 there.
const WORST_COST: f64 = 3.0;
/// Splat size, over the size that the picture still holds, from which a picture is soup; and that at which it is sharp.
const SOUP: f64 = 4.0;
const CRISP: f64 = 0.5;
/// Share of a subject that is seen from which on all of it is.
const FULLY_SEEN: f64 = 0.9;
/// Mean cosine of a subject's surfaces at which it is seen edge-on, and that of a three-quarter view.
const EDGE_ON: f64 = 0.1;
const OPEN_FACED: f64 = 0.45;
/// Share of the frame from which a subject is large.
const LARGE: f64 = 0.08;
/// Ratio of far to near depth of a deep picture.
const DEEP: f64 = 4.0;
/// Distance of the detail's middle from the frame's middle, over its width, at which a picture falls to one side.
const LOPSIDED: f64 = 0.2;
/// Share of the cells with detail of a rich picture.
const RICH: f64 = 0.7;

/// The mark of a term, 0..=1; `None` where it says nothing about the film.
pub(super) fn value(term: Term, film: &Film, pictures: &[Picture]) -> Option<f64> {
    let over = |of: &dyn Fn(&Picture) -> f64| pictures.iter().map(of).collect::<Vec<f64>>();
    let due = |of: &dyn Fn(&Sight) -> Option<f64>| -> Option<f64> {
        mean(&due_sights(film, pictures).filter_map(|(_, sight)| of(sight)).collect::<Vec<f64>>())
    };
    let clear = |picture: &Picture, share: f64| if film.wants_foreground(picture.time_secs) { 0.0 } else { share };
    let value = match term {
        Term::Void => fault(&over(&|picture| picture.void_frac), 0.5).filter(|_| film.is_indoor),
        Term::Blocked => fault(&over(&|picture| clear(picture, picture.blocked_frac)), 0.4),
        Term::Haze => fault(&over(&|picture| clear(picture, picture.haze)), 0.3),
        Term::Wipe => wipe(&over(&|picture| clear(picture, picture.foreground_frac))),
        Term::Visible => visible(film, pictures),
        Term::Kept => due(&|sight| Some(f64::from(u8::from(is_lost(sight))))).map(|lost| 1.0 - lost / 0.2),
        Term::Sharp => sharpness(film, pictures),
        Term::Facing => due(&|sight| Some((sight.facing? - EDGE_ON) / (OPEN_FACED - EDGE_ON))),
        Term::Presence => due(&|sight| Some((sight.area_frac / LARGE).min(1.0).sqrt())),
        Term::Exposure => mean(&over(&exposure)),
        Term::Depth => mean(&over(&|picture| (picture.depth_ratio.ln() / DEEP.ln()).min(1.0))),
        Term::Balance => lasting(&over(&|picture| 1.0 - (picture.balance.x.abs() / LOPSIDED).min(1.0))),
        Term::Interest => lasting(&over(&|picture| (picture.interest_frac / RICH).min(1.0))),
        Term::Margin => Some(1.0 - film.cost_per_step / WORST_COST),
    };
    value.map(|value| value.clamp(0.0, 1.0))
}

/// The mean over the pictures, halfway to the worst of them: one moment behind a vase is what people remember.
fn visible(film: &Film, pictures: &[Picture]) -> Option<f64> {
    let seen = |(picture, sight): (&Picture, &Sight)| {
        let crowded = if film.wants_foreground(picture.time_secs) { 0.0 } else { sight.crowded_frac };
        (sight.seen_frac / FULLY_SEEN).min(1.0) * (1.0 - crowded)
    };
    let shares: Vec<f64> = due_sights(film, pictures).map(seen).collect();
    let least = shares.iter().copied().fold(1.0, f64::min);
    mean(&shares).map(|mean| f64::midpoint(mean, least))
}

/// 1 without a fault, 0 where the mean of average and worst share reaches `worst`.
fn fault(shares: &[f64], worst: f64) -> Option<f64> {
    let largest = shares.iter().copied().fold(0.0, f64::max);
    mean(shares).map(|mean| 1.0 - f64::midpoint(mean, largest) / worst)
}

/// Share of a frame that foreground covers without harm: a frame within the frame; and more than that which leaves the
/// subject no room.
const FREE_FOREGROUND: f64 = 0.15;
const FULL_FOREGROUND: f64 = 0.35;

/// 1 where the foreground never covers much more than it usually does and leaves most of the frame free, 0 where it covers
/// 40 % more than usual or half of the frame.
fn wipe(shares: &[f64]) -> Option<f64> {
    let mut sorted = shares.to_vec();
    sorted.sort_by(f64::total_cmp);
    let (middle, largest) = (sorted.get(sorted.len() / 2)?, sorted.last()?);
    let sweep = (largest - middle) / 0.4;
    Some(1.0 - sweep.max((largest - FREE_FOREGROUND) / FULL_FOREGROUND))
}

/// Mean over the pictures, on a logarithmic scale between crisp and soup: of the subjects that should be seen, or else of
/// the whole picture.
fn sharpness(film: &Film, pictures: &[Picture]) -> Option<f64> {
    let holds_px = MAX_SPLAT_FRAC * f64::from(film.size_px[1]);
    let mark = |px: f64| (1.0 - (px / holds_px / CRISP).ln() / (SOUP / CRISP).ln()).clamp(0.0, 1.0);
    let subjects: Vec<f64> = due_sights(film, pictures).filter_map(|(_, sight)| sight.splat_px.map(mark)).collect();
    // Without a subject all of the picture is looked at, and where a part of it is soup it is that part.
    let whole = |picture: &Picture| mark(picture.splat_px).midpoint(mark(picture.coarse_px));
    mean(&subjects).or_else(|| lasting(&pictures.iter().map(whole).collect::<Vec<_>>()))
}

/// 1 for a picture of middling brightness without clipped parts.
fn exposure(picture: &Picture) -> f64 {
    let dark = (0.15 - picture.brightness).max(0.0) / 0.15;
    let bright = (picture.brightness - 0.8).max(0.0) / 0.2;
    (1.0 - picture.clipped_frac / 0.3 - dark - bright).clamp(0.0, 1.0)
}

/// Weight of the last picture, where people stay, over that of all of them.
const OF_LAST: f64 = 0.3;

/// The mean over the pictures, with more weight on the last one.
fn lasting(values: &[f64]) -> Option<f64> {
    let last = *values.last()?;
    mean(values).map(|mean| mean + OF_LAST * (last - mean))
}

fn mean(values: &[f64]) -> Option<f64> {
    (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
}
