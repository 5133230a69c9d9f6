//! Wishes added to the programs of sentences, where they fit.

use cinesplat_language::{program_from_notation, program_to_notation};
use cinesplat_operator::{Program, Step};
use cinesplat_trajectory::Move;

use super::modifiers::Wish;

/// Moves of the lens.
const LENS: [Move; 4] = [Move::ZoomIn, Move::ZoomOut, Move::DollyZoomIn, Move::DollyZoomOut];
/// Moves that change the height of the camera or how far it looks down.
const VERTICAL: [Move; 6] =
    [Move::PedestalUp, Move::PedestalDown, Move::CraneUp, Move::CraneDown, Move::TiltUp, Move::TiltDown];
/// Moves that turn the camera without moving it.
const TURNS: [Move; 7] =
    [Move::PanLeft, Move::PanRight, Move::TiltUp, Move::TiltDown, Move::RollCw, Move::RollCcw, Move::WhipPan];
/// Moves around a subject.
const CIRCLES: [Move; 4] = [Move::OrbitLeft, Move::OrbitRight, Move::ArcLeft, Move::ArcRight];
/// Moves along a path of their own.
const PATHS: [Move; 3] = [Move::Follow, Move::FlyThrough, Move::Reveal];

/// The program with the wish, whose objects `1` and `2` have the given ids; `None` where the two do not fit together.
pub(super) fn with_wish(program: &Program, wish: &Wish, ids: [u32; 2]) -> Option<Program> {
    if wish.film.contains("total=") && program.duration_secs.is_some()
        || wish.film.contains("no=") && !program.forbidden.is_empty()
        || wish.film.contains("no=") && program.steps.iter().any(|step| !allows(step, &wish.film))
    {
        return None;
    }
    let mut wished = program.clone();
    if !wish.step.is_empty() {
        let [step] = &mut wished.steps[..] else { return None };
        if !fits(step, &wish.step) {
            return None;
        }
        let alone = Program { steps: vec![step.clone()], ..Program::default() };
        let text = format!("{} {}", program_to_notation(&alone), addition(step, &wish.step, ids)?);
        let [new] = &program_from_notation(&text).ok()?.steps[..] else { return None };
        *step = Step { words: step.words, ..new.clone() };
    }
    if !wish.film.is_empty() {
        let film = program_from_notation(&format!("none | {}", wish.film)).ok()?;
        wished.duration_secs = wished.duration_secs.or(film.duration_secs);
        wished.forbidden.extend(film.forbidden);
    }
    Some(wished)
}

/// The tokens that a wish adds to a step, with its objects.
fn addition(step: &Step, wish: &str, [first, second]: [u32; 2]) -> Option<String> {
    if let Some(size) = wish.strip_prefix("start") {
        let subjects: Vec<String> = step.end.subjects.iter().map(ToString::to_string).collect();
        return (!subjects.is_empty()).then(|| format!("start={}{size}", subjects.join("+")));
    }
    let is_numbered =
        ["keep=", "avoid=", "past=", "over=", "between=", "look=1"].iter().any(|key| wish.starts_with(key));
    if !is_numbered {
        return Some(wish.to_owned());
    }
    let (key, ids) = wish.split_once('=')?;
    Some(if ids.contains('+') { format!("{key}={first}+{second}") } else { format!("{key}={first}") })
}

/// Whether the wish can be added to the step: it sets what the step leaves open and does not contradict the move.
fn fits(step: &Step, wish: &str) -> bool {
    let moves = || std::iter::once(step.movement).chain(step.with.iter().copied());
    let has = |list: &[Move]| moves().any(|movement| list.contains(&movement));
    let is_still = step.movement == Move::Static && step.with.is_empty();
    let travels = !is_still && !has(&TURNS) && !has(&LENS) && !has(&[Move::RackFocus]);
    let end = &step.end;
    let is_framed = !end.subjects.is_empty() && !end.hidden && end.subjects.iter().all(|id| !step.avoid.contains(id));
    let is_unsized = end.size.is_none() && end.height_frac.is_none() && end.distance.is_none();
    let is_unraised = end.angle.is_none() && end.elevation_deg.is_none() && end.height.is_none() && !has(&VERTICAL);
    let (key, value) = wish.split_once(['=', ':', '!']).unwrap_or((wish, ""));
    match key {
        "slow" | "fast" => !is_still && step.speed == <_>::default() && step.duration_secs.is_none(),
        "ease" => !is_still && step.easing.is_none(),
        "dur" => step.duration_secs.is_none(),
        "amount" => !is_still && !has(&PATHS) && step.amount.is_none() && step.start.subjects.is_empty() && is_unsized,
        "returns" => !is_still && !step.returns && step.start == <_>::default(),
        "keep" | "avoid" => true,
        "past" | "over" | "between" => {
            step.via.is_none() && has(&[Move::PushIn, Move::PullOut, Move::Follow, Move::FlyThrough])
        }
        "look" => travels && step.look.is_none() && !has(&CIRCLES),
        "with" => fits_beside(step, value),
        "start" => {
            is_framed && step.start == <_>::default() && !is_still && has(&[Move::PushIn]) != value.contains("close")
        }
        _ if !is_framed || has(&[Move::Reveal]) => false,
        _ if is_size(value) => is_unsized && size_fits(step, value),
        _ if is_height(value) => is_unraised,
        _ if value.ends_with("mm") || value.ends_with("lens") => end.lens.is_none() && !has(&LENS),
        _ if value.starts_with("from-") => end.side.is_none() && !has(&CIRCLES) && !has(&TURNS),
        _ if value.starts_with("at-") => end.place.is_none() && !has(&TURNS),
        "end" if value.is_empty() => !end.whole && is_unsized,
        "end" => end.part == <_>::default() && !end.whole && !has(&VERTICAL),
        _ => false,
    }
}

fn is_size(value: &str) -> bool {
    matches!(value, "close-up" | "extreme-close-up" | "medium" | "long")
        || value.ends_with('%')
        || value.starts_with('d') && value.ends_with('u')
}

fn is_height(value: &str) -> bool {
    matches!(value, "overhead" | "high" | "low" | "eye-level" | "worm")
        || value.ends_with("deg")
        || value.starts_with('h') && value.ends_with('u')
}

/// A move toward its subject does not end far from it, one away from it not near it.
fn size_fits(step: &Step, value: &str) -> bool {
    match step.movement {
        Move::PushIn | Move::ZoomIn => !step.end.whole && value != "long",
        Move::PullOut | Move::ZoomOut => !value.ends_with("close-up"),
        _ => !(step.end.whole && value.ends_with("close-up")),
    }
}

/// Whether a second move can go on at the same time.
fn fits_beside(step: &Step, tokens: &str) -> bool {
    let is_open = tokens.ends_with("either");
    let name = tokens.trim_end_matches(" either");
    let name = if is_open { format!("{name}-right") } else { name.to_owned() };
    let second = name.parse::<Move>().or_else(|_| name.replace("-right", "-cw").parse::<Move>());
    let Ok(second) = second else { return false };
    let is_same_kind = |list: &[Move]| list.contains(&second) && list.contains(&step.movement);
    let goes = [Move::PushIn, Move::PullOut];
    let rises = [Move::PedestalUp, Move::PedestalDown, Move::CraneUp, Move::CraneDown];
    let lone = [Move::Static, Move::WhipPan, Move::RackFocus, Move::Handheld, Move::Reveal];
    step.with.is_empty()
        && !lone.contains(&step.movement)
        && !(is_open && step.movement.opposite().is_some())
        && step.movement != second
        && step.movement.opposite() != Some(second)
        && ![&LENS[..], &VERTICAL, &CIRCLES, &goes, &rises].into_iter().any(is_same_kind)
        && (second == Move::Handheld
            || !TURNS.contains(&step.movement)
            || TURNS.contains(&second)
            || LENS.contains(&second))
}

/// Whether a step does nothing that the film's ban forbids.
fn allows(step: &Step, film: &str) -> bool {
    let moves = || std::iter::once(step.movement).chain(step.with.iter().copied());
    let has = |list: &[Move]| moves().any(|movement| list.contains(&movement));
    let Some(bans) = film.split_once("no=").and_then(|(_, rest)| rest.split(' ').next()) else { return true };
    let turns_aside = [Move::PanLeft, Move::PanRight, Move::WhipPan, Move::Handheld];
    let is_turned = has(&turns_aside) || has(&CIRCLES) || has(&PATHS);
    let is_tilted = has(&VERTICAL) || has(&PATHS) || has(&[Move::Handheld]);
    let is_rolled = has(&[Move::RollCw, Move::RollCcw, Move::Handheld]);
    bans.split('+').all(|ban| match ban {
        "zoom" => !has(&LENS) && step.start.lens.is_none(),
        "pan" => !is_turned,
        "tilt" => !is_tilted,
        "roll" => !is_rolled,
        "turn" => !is_turned && !is_tilted && !is_rolled,
        "travel" => has(&[Move::Static, Move::ZoomIn, Move::ZoomOut]) || has(&TURNS),
        "shake" => !has(&[Move::Handheld]),
        "cut" => !step.cut,
        _ => false,
    })
}
