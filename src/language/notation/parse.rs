use cinesplat_operator::{
    Amount, FramePlace, Framing, Lens, Level, Limit, Look, MAX_SECOND_MOVES, Motion, Pass, Program, Speed, Step,
    SubjectPart, SubjectSide, Via,
};
use cinesplat_trajectory::{Easing, Move, ShotAngle, ShotSize};
use strum::VariantArray;

use super::error::NotationError;
use super::print::NO_STEPS;

/// Object ids of a name in the notation; `None` for an unknown name.
type Resolve<'a> = dyn Fn(&str) -> Option<Vec<u32>> + 'a;

/// A direction in the name of a move.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[derive(strum::Display, strum::EnumString)]
#[derive(strum::VariantArray)]
#[strum(serialize_all = "kebab-case")]
enum Direction {
    // The default of each pair comes first: it is the direction where the text leaves the direction open.
    Right,
    Left,
    Up,
    Down,
    In,
    Out,
    Cw,
    Ccw,
}

/// One of the two framings of a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[derive(strum::AsRefStr)]
#[derive(strum::VariantArray)]
#[strum(serialize_all = "kebab-case")]
enum Side {
    Start,
    End,
}

/// A token that is one fixed word.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[derive(strum::EnumString)]
#[strum(serialize_all = "kebab-case")]
enum Flag {
    Cut,
    Returns,
    Either,
}

/// The program that `text` stands for; objects are their ids.
///
/// # Errors
/// The [`NotationError`] of the first token that is malformed or contradicts another one.
pub fn program_from_notation(text: &str) -> Result<Program, NotationError> {
    let (steps, rest) = text.split_once('|').unwrap_or((text, ""));
    let resolve = |name: &str| name.parse().ok().map(|id| vec![id]);
    let mut program = Program::default();
    for step in steps.split(" / ").filter(|step| step.trim() != NO_STEPS) {
        let tokens: Vec<&str> = step.split_whitespace().collect();
        program.steps.push(step_from_notation(&tokens, &resolve)?);
    }
    for token in rest.split_whitespace() {
        let unknown = || NotationError::UnknownToken { token: token.to_owned() };
        match token.split_once('=') {
            Some(("total", value)) => program.duration_secs = Some(seconds(value)?),
            Some(("no", value)) => program.forbidden = forbidden(value).ok_or_else(unknown)?,
            Some((name, value)) => program.limits.push(limit(name, value).ok_or_else(unknown)?),
            None => return Err(unknown()),
        }
    }
    Ok(program)
}

/// One step from its tokens. `resolve` gives the ids of the objects that a name stands for, `None` for an unknown name.
///
/// # Errors
/// The [`NotationError`] of the first token that is malformed or contradicts another one.
pub fn step_from_notation(tokens: &[&str], resolve: &dyn Fn(&str) -> Option<Vec<u32>>) -> Result<Step, NotationError> {
    let mut parser = StepParser::default();
    for token in tokens {
        parser.parse(token, resolve)?;
    }
    parser.finish()
}

/// A step while its tokens are read.
#[derive(Default)]
struct StepParser {
    /// Name of the move, perhaps without its direction.
    movement: Option<String>,
    direction: Option<Direction>,
    with: Vec<Move>,
    start: Framing,
    end: Framing,
    via: Option<Via>,
    look: Option<Look>,
    keep: Vec<u32>,
    avoid: Vec<u32>,
    amount: Option<Amount>,
    duration_secs: Option<f64>,
    speed: Option<Speed>,
    easing: Option<Easing>,
    cut: bool,
    returns: bool,
    either_way: bool,
}

/// Sets `place`, unless it holds a different value.
fn set_once<T: PartialEq>(place: &mut Option<T>, value: T, token: &str) -> Result<(), NotationError> {
    if place.as_ref().is_some_and(|known| *known != value) {
        return Err(NotationError::Contradiction { token: token.to_owned() });
    }
    *place = Some(value);
    Ok(())
}

impl StepParser {
    fn parse(&mut self, token: &str, resolve: &Resolve) -> Result<(), NotationError> {
        if let Some((key, value)) = token.split_once('=') {
            return self.parse_pair(key, value, resolve);
        }
        for side in Side::VARIANTS {
            let rest = token.strip_prefix(side.as_ref());
            if let Some(qualifiers) = rest.filter(|rest| rest.starts_with([':', '!', '+'])) {
                return add_to_framing(self.framing(*side), qualifiers, resolve);
            }
        }
        if let Ok(flag) = token.parse::<Flag>() {
            match flag {
                Flag::Cut => self.cut = true,
                Flag::Returns => self.returns = true,
                Flag::Either => self.either_way = true,
            }
            return Ok(());
        }
        if let Some(speed) = token.parse().ok().filter(|speed| *speed != Speed::Normal) {
            return set_once(&mut self.speed, speed, token);
        }
        match token.parse::<Direction>() {
            Ok(direction) => set_once(&mut self.direction, direction, token),
            Err(_) => set_once(&mut self.movement, token.to_owned(), token),
        }
    }

    fn parse_pair(&mut self, key: &str, value: &str, resolve: &Resolve) -> Result<(), NotationError> {
        let token = || format!("{key}={value}");
        let unknown = || NotationError::UnknownToken { token: token() };
        if let Some(side) = Side::VARIANTS.iter().find(|side| side.as_ref() == key) {
            return set_framing(self.framing(*side), value, resolve);
        }
        if let Ok(how) = key.parse::<Pass>() {
            let via = Via { how, objects: objects(value, resolve)? };
            return set_once(&mut self.via, via, &token());
        }
        match key {
            // Even an equal amount or duration is an error: the sentence of such a step would repeat itself.
            "amount" if self.amount.is_some() => Err(NotationError::Contradiction { token: token() }),
            "dur" if self.duration_secs.is_some() => Err(NotationError::Contradiction { token: token() }),
            "amount" => set_once(&mut self.amount, amount(value).ok_or_else(unknown)?, value),
            "dur" => set_once(&mut self.duration_secs, seconds(value)?, value),
            "ease" => set_once(&mut self.easing, value.parse().map_err(|_| unknown())?, value),
            "look" => set_once(&mut self.look, look(value, resolve)?, &token()),
            "keep" => {
                self.keep.extend(objects(value, resolve)?);
                Ok(())
            }
            "avoid" => {
                self.avoid.extend(objects(value, resolve)?);
                Ok(())
            }
            "with" => {
                for name in value.split('+') {
                    self.with.push(move_from_name(name, None)?.0);
                }
                if self.with.len() > MAX_SECOND_MOVES { Err(unknown()) } else { Ok(()) }
            }
            _ => Err(unknown()),
        }
    }

    fn framing(&mut self, side: Side) -> &mut Framing {
        match side {
            Side::Start => &mut self.start,
            Side::End => &mut self.end,
        }
    }

    fn finish(self) -> Result<Step, NotationError> {
        let name = self.movement.ok_or(NotationError::NoMove)?;
        let (movement, is_open) = move_from_name(&name, self.direction)?;
        Ok(Step {
            with: self.with,
            either_way: is_open || self.either_way,
            start: self.start,
            end: self.end,
            via: self.via,
            look: self.look,
            keep: self.keep,
            avoid: self.avoid,
            amount: self.amount,
            duration_secs: self.duration_secs,
            speed: self.speed.unwrap_or_default(),
            easing: self.easing,
            cut: self.cut,
            returns: self.returns,
            ..Step::of(movement)
        })
    }
}

/// The move of a name, with or without its direction, and whether the text leaves the direction open.
fn move_from_name(name: &str, direction: Option<Direction>) -> Result<(Move, bool), NotationError> {
    if let Some(first) = first_direction(name) {
        let full = format!("{name}-{}", direction.unwrap_or(first));
        let movement = full.parse().map_err(|_| NotationError::UnknownMove { name: full })?;
        return Ok((movement, direction.is_none()));
    }
    let movement: Move = name.parse().map_err(|_| NotationError::UnknownMove { name: name.to_owned() })?;
    match direction {
        Some(direction) if !name.ends_with(&format!("-{direction}")) => {
            Err(NotationError::WrongDirection { movement, direction: direction.to_string() })
        }
        _ => Ok((movement, false)),
    }
}

/// The first direction of a pair in which moves of this name exist, such as `right` of `pan`; `None` for the name of a
/// single move.
fn first_direction(name: &str) -> Option<Direction> {
    let is_move = |direction: &Direction| format!("{name}-{direction}").parse::<Move>().is_ok();
    let pairs = Direction::VARIANTS.chunks_exact(2);
    pairs.into_iter().find(|pair| pair.iter().all(is_move)).and_then(|pair| pair.first().copied())
}

fn set_framing(framing: &mut Framing, value: &str, resolve: &Resolve) -> Result<(), NotationError> {
    let end = value.find([':', '!']).unwrap_or(value.len());
    let (names, qualifiers) = value.split_at(end);
    framing.subjects = objects(names, resolve)?;
    add_to_framing(framing, qualifiers, resolve)
}

/// Adds any number of qualifiers: `:low`, `!`, `+5`.
fn add_to_framing(framing: &mut Framing, qualifiers: &str, resolve: &Resolve) -> Result<(), NotationError> {
    let mut rest = qualifiers;
    while let Some(mark) = rest.chars().next() {
        let body = rest.get(1..).unwrap_or_default();
        let end = body.find([':', '!', '+']).unwrap_or(body.len());
        let (value, after) = body.split_at(end);
        match mark {
            '!' => framing.whole = true,
            '+' => framing.subjects.extend(objects(value, resolve)?),
            _ => match value.strip_prefix("before-") {
                Some(names) => framing.backdrop.extend(objects(names, resolve)?),
                None => qualify(framing, value)?,
            },
        }
        rest = after;
    }
    Ok(())
}

fn qualify(framing: &mut Framing, value: &str) -> Result<(), NotationError> {
    if let Ok(size) = value.parse::<ShotSize>() {
        return set_once(&mut framing.size, size, value);
    }
    if let Ok(angle) = value.parse::<ShotAngle>() {
        return set_once(&mut framing.angle, angle, value);
    }
    if let Ok(side) = value.parse::<SubjectSide>() {
        return set_once(&mut framing.side, side, value);
    }
    if let Ok(place) = value.parse::<FramePlace>() {
        return set_once(&mut framing.place, place, value);
    }
    if let Some(lens) = lens(value) {
        return set_once(&mut framing.lens, lens, value);
    }
    if let Ok(part) = value.parse::<SubjectPart>() {
        framing.part = part;
        return Ok(());
    }
    if value == "hidden" {
        framing.hidden = true;
        return Ok(());
    }
    let unknown = || NotationError::UnknownFraming { qualifier: value.to_owned() };
    if let Some(percent) = measure(value, "", "%") {
        return set_once(&mut framing.height_frac, percent / 100.0, value);
    }
    if let Some(degrees) = measure(value, "", "deg") {
        return set_once(&mut framing.elevation_deg, degrees, value);
    }
    if let Some(height) = measure(value, "h", "u") {
        return set_once(&mut framing.height, height, value);
    }
    set_once(&mut framing.distance, measure(value, "d", "u").ok_or_else(unknown)?, value)
}

/// The number between a prefix and a unit.
fn measure(value: &str, prefix: &str, unit: &str) -> Option<f64> {
    let number: f64 = value.strip_prefix(prefix)?.strip_suffix(unit)?.parse().ok()?;
    number.is_finite().then_some(number)
}

fn lens(value: &str) -> Option<Lens> {
    match value {
        "wide-lens" => Some(Lens::Wide),
        "long-lens" => Some(Lens::Long),
        _ => measure(value, "", "mm").map(Lens::FocalMm).or_else(|| measure(value, "", "fov").map(Lens::FovDeg)),
    }
}

fn look(value: &str, resolve: &Resolve) -> Result<Look, NotationError> {
    match value {
        "ahead" => Ok(Look::Ahead),
        "back" => Ok(Look::Back),
        "room" => Ok(Look::Room),
        names => Ok(Look::At(objects(names, resolve)?)),
    }
}

/// The forbidden motions of a list, each once, in the order of [`Motion`].
fn forbidden(list: &str) -> Option<Vec<Motion>> {
    let mut motions: Vec<Motion> = list.split('+').map(|name| name.parse().ok()).collect::<Option<_>>()?;
    motions.sort_unstable();
    motions.dedup();
    Some(motions)
}

/// The limit of a token; objects are their ids.
fn limit(name: &str, value: &str) -> Option<Limit> {
    let units = |value: &str| measure(value, "", "u");
    let of_object = |value: &str| {
        let (id, distance) = value.split_once(':')?;
        Some((id.parse::<u32>().ok()?, units(distance)?))
    };
    let level = || units(value).map(Level::Units).or_else(|| value.parse().ok().map(Level::Object));
    match name {
        "above" => level().map(Limit::Above),
        "below" => level().map(Limit::Below),
        "clear" => match of_object(value) {
            Some((id, distance)) => Some(Limit::Clear(Some(id), distance)),
            None => units(value).map(|distance| Limit::Clear(None, distance)),
        },
        "within" => of_object(value).map(|(id, distance)| Limit::Within(id, distance)),
        "speed" => units(value).map(Limit::Speed).or_else(|| measure(value, "", "deg").map(Limit::TurnSpeed)),
        _ => None,
    }
}

fn objects(names: &str, resolve: &Resolve) -> Result<Vec<u32>, NotationError> {
    let mut ids = Vec::new();
    for name in names.split('+').filter(|name| !name.is_empty() && *name != "room") {
        ids.extend(resolve(name).ok_or_else(|| NotationError::UnknownObject { name: name.to_owned() })?);
    }
    Ok(ids)
}

fn amount(value: &str) -> Option<Amount> {
    let number = |unit: &str| value.strip_suffix(unit).and_then(|v| v.parse::<f64>().ok());
    match value {
        "slight" => Some(Amount::Slight),
        "large" => Some(Amount::Large),
        _ => number("deg")
            .map(Amount::Degrees)
            .or_else(|| number("u").map(Amount::Units))
            .or_else(|| number("x").map(Amount::Factor)),
    }
}

fn seconds(value: &str) -> Result<f64, NotationError> {
    let bad = || NotationError::BadDuration { found: value.to_owned() };
    value.strip_suffix('s').and_then(|v| v.parse().ok()).ok_or_else(bad)
}
