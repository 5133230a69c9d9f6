//! Quantities of a prompt: times, angles, lengths, factors, shares of the frame and focal lengths.
//!
//! Enters: words. Leaves: a value with its kind. A turn is 360 degrees, `around it to the other side` 180. `a couple` is
//! 2, `a few` 3, a beat 1 s. `0:02-0:05` is one duration of 3 s. Lengths are in scene units, taken as meters; feet,
//! inches, yards and centimeters are converted. `twice as close` is the factor 0.5 on the distance, `twice as far` 2,
//! `halfway` 0.5. `twice as big` is 0.5 on the distance, or 2 on the focal length in a sentence about a zoom. `half the
//! frame` is 50 percent. `35 mm` and `on a 35` are focal lengths. A number that belongs to something else (`scene 12`,
//! `4k`, `16:9`, `2 m/s`) is no quantity.

mod angle;
mod around;
mod belonging;
mod clock;
mod context;
mod ellipsis;
mod factor;
mod kind;
mod length;
mod lens;
mod lookalike;
mod measure;
mod second;
mod share;
mod time;
mod topic;
mod turn;
mod unit;

use super::tokenizer::{Word, word_at};
use context::HEDGES;
use kind::Found;

pub(crate) use clock::{Instant, InstantForm, frames_per_sec, instant_at, link_at, rate_of};
pub(crate) use context::is_joined;
pub use kind::{Quantity, QuantityKind};
pub(super) use unit::is_unread_number;
pub(crate) use unit::unit;

/// Reads the quantity that begins at a word.
type Reader = fn(&[Word], usize) -> Option<Found>;

/// The readers in order: the first that finds a quantity decides.
const READERS: [Reader; 12] = [
    clock::clock_at,
    second::second_at,
    time::time_at,
    share::share_at,
    turn::turn_at,
    around::way_around_at,
    factor::factor_at,
    measure::measure_at,
    lens::lens_at,
    length::length_at,
    ellipsis::ellipsis_at,
    angle::bare_angle_at,
];

/// The quantity that begins at word `i`, with the number of words it takes.
pub(crate) fn quantity_at(words: &[Word], i: usize) -> Option<(usize, Quantity)> {
    let is_hedge = HEDGES.contains(&word_at(words, i));
    let read_at = |start: usize| READERS.iter().find_map(|read| read(words, start));
    let hedged = read_at(i + 1).filter(|_| is_hedge).map(|found| (1, found));
    let (hedge, (len, quantity)) = hedged.or_else(|| Some((0, read_at(i)?)))?;
    // `around` and `some` before a factor are prepositions, not hedges.
    let is_preposition =
        hedge == 1 && matches!(word_at(words, i), "around" | "some") && quantity.kind == QuantityKind::Factor;
    let is_possible = match quantity.kind {
        QuantityKind::Percent => quantity.value <= 100.0,
        _ => true,
    };
    (quantity.value > 0.0 && is_possible && !is_preposition).then_some((len + hedge, quantity))
}
