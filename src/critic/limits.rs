//! What no film may do, unless its words ask for it.

use super::film::Film;
use super::picture::{Picture, Sight};

/// Largest share of a frame without matter, in rooms.
const MAX_VOID: f64 = 0.25;
/// Largest share of a frame with matter against the lens.
const MAX_BLOCKED: f64 = 0.2;
/// Largest share of a subject's frames on which it is lost.
const MAX_LOST: f64 = 0.05;
/// Share of a frame that is black from which the whole frame counts as black.
const BLACK_FRAME: f64 = 0.97;
/// A subject is lost where less of it is visible, or where it covers less of the frame.
const LOST_SEEN_FRAC: f64 = 0.15;
const LOST_AREA_FRAC: f64 = 1e-4;

/// A hard limit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[derive(strum::AsRefStr, strum::Display, strum::EnumString, strum::IntoStaticStr)]
#[derive(strum::VariantArray, strum::VariantNames)]
#[strum(serialize_all = "kebab-case")]
pub enum Limit {
    /// Worst share of a frame without matter; rooms only.
    Void,
    /// Worst share of a frame with matter against the lens, where the words do not ask for it.
    Blocked,
    /// Share of its frames on which a subject is lost; the worst subject.
    Lost,
    /// Share of the frames that are black.
    Black,
}

/// A limit checked on a film.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LimitCheck {
    /// The limit.
    pub limit: Limit,
    /// The measured share.
    pub got: f64,
    /// The largest share that is allowed.
    pub most: f64,
    /// Time of the worst moment, where there is one.
    pub at_secs: Option<f64>,
}

impl LimitCheck {
    /// Whether the film keeps the limit.
    pub fn is_kept(&self) -> bool {
        self.got <= self.most
    }
}

/// The limits that apply to a film.
pub(super) fn checks(film: &Film, pictures: &[Picture]) -> Vec<LimitCheck> {
    let worst = |limit, most, of: &dyn Fn(&Picture) -> f64| {
        let picture = pictures.iter().max_by(|a, b| of(a).total_cmp(&of(b)))?;
        Some(LimitCheck { limit, most, got: of(picture), at_secs: Some(picture.time_secs) })
    };
    let blocked = |picture: &Picture| if film.wants_foreground(picture.time_secs) { 0.0 } else { picture.blocked_frac };
    let is_black = |picture: &&Picture| picture.black_frac >= BLACK_FRAME;
    let void = worst(Limit::Void, MAX_VOID, &|picture| picture.void_frac).filter(|_| film.is_indoor);
    let black = LimitCheck {
        limit: Limit::Black,
        most: 0.0,
        got: pictures.iter().filter(is_black).count() as f64 / pictures.len().max(1) as f64,
        at_secs: pictures.iter().find(is_black).map(|picture| picture.time_secs),
    };
    let lost = lost(film, pictures);
    [void, worst(Limit::Blocked, MAX_BLOCKED, &blocked), lost, Some(black)].into_iter().flatten().collect()
}

/// The subject that is lost most often. `None` without subjects.
fn lost(film: &Film, pictures: &[Picture]) -> Option<LimitCheck> {
    let mut objects: Vec<u32> = film.sightings.iter().map(|sighting| sighting.object).collect();
    objects.sort_unstable();
    objects.dedup();
    let check = |object: u32| {
        let due: Vec<(f64, bool)> = due_sights(film, pictures)
            .filter(|(_, sight)| sight.object == object)
            .map(|(picture, sight)| (picture.time_secs, is_lost(sight)))
            .collect();
        let gone: Vec<f64> = due.iter().filter(|(_, is_lost)| *is_lost).map(|(time, _)| *time).collect();
        let got = gone.len() as f64 / due.len().max(1) as f64;
        LimitCheck { limit: Limit::Lost, most: MAX_LOST, got, at_secs: gone.first().copied() }
    };
    objects.into_iter().map(check).max_by(|a, b| a.got.total_cmp(&b.got))
}

/// Every picture with every subject that should be seen in it.
pub(super) fn due_sights<'a>(
    film: &'a Film,
    pictures: &'a [Picture],
) -> impl Iterator<Item = (&'a Picture, &'a Sight)> {
    // Moments are told apart down to a millisecond.
    let is_due = |time: f64, sight: &Sight| {
        film.sightings
            .iter()
            .any(|due| due.object == sight.object && time >= due.from_secs - 2e-3 && time <= due.to_secs + 2e-3)
    };
    pictures.iter().flat_map(move |picture| {
        let due = move |sight: &&Sight| is_due(picture.time_secs, sight);
        picture.sights.iter().filter(due).map(move |sight| (picture, sight))
    })
}

pub(super) fn is_lost(sight: &Sight) -> bool {
    sight.area_frac < LOST_AREA_FRAC || sight.seen_frac < LOST_SEEN_FRAC
}
