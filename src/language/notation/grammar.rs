//! The canonical notation as a pattern: the programs that [`program_to_notation`](super::program_to_notation) prints, so
//! that a program can be written token by token and always parses.
//!
//! Tokens and qualifiers stand in the order in which they are printed, each at most once. Numbers have at most
//! four digits before the point and two after it, lists of objects at most [`MAX_LISTED`] ids.

use cinesplat_operator::{FramePlace, MAX_SECOND_MOVES, Motion, Pass, Speed, SubjectPart, SubjectSide};
use cinesplat_trajectory::{Easing, Move, ShotAngle, ShotSize};
use strum::VariantArray;

use super::pattern::Pattern;
use super::print::NO_STEPS;

/// Most steps of a program in the pattern.
pub const MAX_STEPS: usize = 16;
/// Most objects of one list in the pattern.
pub const MAX_LISTED: usize = 12;

/// The programs over some objects. `before_step` stands before each step; a pattern of the empty text gives the notation
/// itself.
pub fn program_pattern(ids: &[u32], before_step: &Pattern) -> Pattern {
    let step = sequence([before_step.clone(), step_pattern(ids)]);
    let motions = ordered(Motion::VARIANTS.iter().map(|motion| (*motion).into()), "+");
    let length = sequence([Pattern::text("total="), number(), Pattern::text("s")]);
    let ruled_out = after("no=", motions);
    let film = any_in_order(&[vec![length, ruled_out], limits(ids)].concat(), " ");
    sequence([
        Pattern::Choice(vec![Pattern::text(NO_STEPS), step.list(" / ", MAX_STEPS)]),
        after(" | ", film).optional(),
    ])
}

/// The limits of a film over some objects, in the order of their kinds.
fn limits(ids: &[u32]) -> Vec<Pattern> {
    let units = || sequence([positive_number(), Pattern::text("u")]);
    let object = || Pattern::one_of(ids.iter().map(u32::to_string));
    let level = || Pattern::Choice(vec![units(), object()]);
    let of_object = || sequence([object(), Pattern::text(":"), units()]);
    let turn = sequence([positive_number(), Pattern::text("deg")]);
    vec![
        after("above=", level()),
        after("below=", level()),
        after("clear=", Pattern::Choice(vec![units(), of_object()])).list(" ", MAX_LISTED),
        after("within=", of_object()).list(" ", MAX_LISTED),
        after("speed=", units()),
        after("speed=", turn),
    ]
}

/// The steps over some objects.
fn step_pattern(ids: &[u32]) -> Pattern {
    let moves = || Pattern::one_of(Move::VARIANTS);
    let objects = || Pattern::one_of(ids.iter().map(u32::to_string)).list("+", MAX_LISTED);
    let amount = sequence([number(), Pattern::one_of(["deg", "u", "x"])]);
    let amount = Pattern::Choice(vec![amount, Pattern::one_of(["slight", "large"])]);
    let look = Pattern::Choice(vec![objects(), Pattern::one_of(["ahead", "back", "room"])]);
    let via = sequence([Pattern::one_of(Pass::VARIANTS), Pattern::text("="), objects()]);
    let tokens = [
        after("with=", moves().list("+", MAX_SECOND_MOVES)),
        after("start=", framing(&objects(), ids)),
        after("end=", framing(&objects(), ids)),
        via,
        after("look=", look),
        after("keep=", objects()),
        after("avoid=", objects()),
        after("amount=", amount),
        sequence([Pattern::text("dur="), number(), Pattern::text("s")]),
        Pattern::one_of(Speed::VARIANTS.iter().filter(|speed| **speed != Speed::Normal)),
        after("ease=", Pattern::one_of(Easing::VARIANTS)),
        Pattern::text("cut"),
        Pattern::text("returns"),
        Pattern::text("either"),
    ];
    let tokens = tokens.into_iter().map(|token| after(" ", token).optional());
    Pattern::Sequence(std::iter::once(moves()).chain(tokens).collect())
}

/// Objects with any qualifiers, or the room with at least one: without any it would be no framing.
fn framing(objects: &Pattern, ids: &[u32]) -> Pattern {
    let measured = |before: &str, unit: &str| sequence([Pattern::text(before), number(), Pattern::text(unit)]);
    let elevation = Pattern::Choice(vec![number(), after("-", positive_number())]);
    let lens = [measured("", "mm"), measured("", "fov"), Pattern::one_of(["wide-lens", "long-lens"])];
    let qualifiers = [
        Pattern::one_of(ShotSize::VARIANTS),
        measured("", "%"),
        Pattern::one_of(ShotAngle::VARIANTS),
        sequence([elevation, Pattern::text("deg")]),
        measured("h", "u"),
        measured("d", "u"),
        Pattern::Choice(lens.to_vec()),
        Pattern::one_of(SubjectPart::VARIANTS.iter().filter(|part| **part != SubjectPart::Middle)),
        Pattern::one_of(SubjectSide::VARIANTS),
        Pattern::one_of(FramePlace::VARIANTS),
        Pattern::text("hidden"),
        after("before-", Pattern::one_of(ids.iter().map(u32::to_string))).list(":", MAX_LISTED),
    ];
    let marked = qualifiers.into_iter().map(|qualifier| after(":", qualifier));
    let marked: Vec<Pattern> = marked.chain([Pattern::text("!")]).collect();
    let any = any_in_order(&marked, "");
    Pattern::Choice(vec![sequence([objects.clone(), any.clone().optional()]), after("room", any)])
}

/// A number that is printed as it is written: without leading zeros, and without zeros at the end of the decimals.
fn number() -> Pattern {
    Pattern::Choice(vec![positive_number(), Pattern::text("0")])
}

fn positive_number() -> Pattern {
    let nonzero = || Pattern::one_of(('1'..='9').map(String::from));
    let digit = || Pattern::one_of(('0'..='9').map(String::from));
    let decimals = || sequence([Pattern::text("."), Pattern::Choice(vec![nonzero(), sequence([digit(), nonzero()])])]);
    let whole = sequence([nonzero(), digit().up_to(3), decimals().optional()]);
    Pattern::Choice(vec![whole, sequence([Pattern::text("0"), decimals()])])
}

fn sequence<const N: usize>(parts: [Pattern; N]) -> Pattern {
    Pattern::Sequence(parts.into())
}

fn after(text: &str, pattern: Pattern) -> Pattern {
    sequence([Pattern::text(text), pattern])
}

/// One or more of some texts, in their order, with a separator between them.
fn ordered(texts: impl Iterator<Item = &'static str>, separator: &str) -> Pattern {
    any_in_order(&texts.map(Pattern::text).collect::<Vec<_>>(), separator)
}

/// One or more of some patterns, each at most once and in their order, with a separator between them.
fn any_in_order(patterns: &[Pattern], separator: &str) -> Pattern {
    let from = |first: usize| {
        let further = patterns.iter().skip(first + 1).map(|pattern| after(separator, pattern.clone()).optional());
        Pattern::Sequence(patterns.iter().skip(first).take(1).cloned().chain(further).collect())
    };
    Pattern::Choice((0..patterns.len()).map(from).collect())
}
