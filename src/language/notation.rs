//! Programs as short text, for the grammar, the exam and people.
//!
//! `push-in end=3:close-up dur=2s / orbit-left end=3 amount=45deg | total=8s`: steps parted by ` / `, the film's length
//! after `|`. A step is a move and, in any order:
//! - `start=` and `end=`: objects joined by `+`, then `:SIZE`, `:ANGLE`, `:top` (a part), `!` for all wholly in frame;
//!   `room` for no object. `end:low`, `end!` and `end+5` add to what stands there.
//! - `past=2`, `over=2`, `between=2+3`; `amount=90deg`, `amount=2u`, `amount=0.5x`, `amount=slight`, `amount=large`.
//! - `dur=2s`, `slow`, `fast`, `ease=ease-in`, `with=tilt-up`, `cut`, `returns`, `either`.
//!
//! A move may stand without its direction (`pan`, `orbit`), given by `left right up down in out cw ccw` elsewhere in the
//! step; without one it is `either` with the first direction of: right, up, in, cw.

use cinesplat_operator::{Amount, Framing, Pass, Program, Speed, Step, SubjectPart, Via};
use cinesplat_trajectory::{Easing, Move, ShotAngle, ShotSize};

/// Turns a name in the notation into object ids; `None` where it means nothing.
pub type Resolve<'a> = dyn Fn(&str) -> Option<Vec<u32>> + 'a;

const HEADINGS: [&str; 8] = ["left", "right", "up", "down", "in", "out", "cw", "ccw"];
const FAMILIES: [(&str, &str); 10] = [
    ("pan", "right"),
    ("tilt", "up"),
    ("roll", "cw"),
    ("truck", "right"),
    ("pedestal", "up"),
    ("crane", "up"),
    ("orbit", "right"),
    ("arc", "right"),
    ("zoom", "in"),
    ("dolly-zoom", "in"),
];

/// The program that `text` means.
///
/// # Errors
/// A sentence naming the part that means nothing or is said twice.
pub fn program_from_notation(text: &str) -> Result<Program, String> {
    let (steps, rest) = text.split_once('|').unwrap_or((text, ""));
    let resolve = |name: &str| name.parse().ok().map(|id| vec![id]);
    let mut program = Program::default();
    for step in steps.split(" / ") {
        let tokens: Vec<&str> = step.split_whitespace().collect();
        program.steps.push(step_from_tokens(&tokens, &resolve)?);
    }
    for token in rest.split_whitespace() {
        let total = token.strip_prefix("total=").ok_or_else(|| format!("\"{token}\" after |"))?;
        program.duration_secs = Some(seconds(total)?);
    }
    Ok(program)
}

/// One step from its tokens.
pub fn step_from_tokens(tokens: &[&str], resolve: &Resolve) -> Result<Step, String> {
    let mut draft = Draft::default();
    for token in tokens {
        draft.take(token, resolve)?;
    }
    draft.finish()
}

/// A step while its tokens come in: what has been said so far.
#[derive(Default)]
struct Draft {
    movement: Option<String>,
    heading: Option<String>,
    with: Option<Move>,
    start: Framing,
    end: Framing,
    via: Option<Via>,
    amount: Option<Amount>,
    duration_secs: Option<f64>,
    speed: Option<Speed>,
    easing: Option<Easing>,
    flags: Vec<String>,
}

/// Sets a place once; a second, different value is a contradiction.
fn once<T: PartialEq>(place: &mut Option<T>, value: T, token: &str) -> Result<(), String> {
    if place.as_ref().is_some_and(|known| *known != value) {
        return Err(format!("\"{token}\" contradicts what was said"));
    }
    *place = Some(value);
    Ok(())
}

impl Draft {
    fn take(&mut self, token: &str, resolve: &Resolve) -> Result<(), String> {
        if let Some((key, value)) = token.split_once('=') {
            return self.take_pair(key, value, resolve);
        }
        for side in ["start", "end"] {
            if let Some(more) = token.strip_prefix(side).filter(|more| more.starts_with([':', '!', '+'])) {
                let framing = if side == "start" { &mut self.start } else { &mut self.end };
                return add_to_framing(framing, more, resolve);
            }
        }
        match token {
            "slow" => once(&mut self.speed, Speed::Slow, token),
            "fast" => once(&mut self.speed, Speed::Fast, token),
            "cut" | "returns" | "either" => {
                self.flags.push(token.to_owned());
                Ok(())
            }
            _ if HEADINGS.contains(&token) => once(&mut self.heading, token.to_owned(), token),
            _ => once(&mut self.movement, token.to_owned(), token),
        }
    }

    fn take_pair(&mut self, key: &str, value: &str, resolve: &Resolve) -> Result<(), String> {
        let unknown = || format!("\"{key}={value}\" means nothing");
        match key {
            "start" => set_framing(&mut self.start, value, resolve),
            "end" => set_framing(&mut self.end, value, resolve),
            "past" => once(&mut self.via, via(Pass::Past, value, resolve)?, value),
            "between" => once(&mut self.via, via(Pass::Between, value, resolve)?, value),
            "over" => once(&mut self.via, via(Pass::Over, value, resolve)?, value),
            // Even the same amount twice is one too many: the sentence would repeat itself.
            "amount" if self.amount.is_some() => Err(unknown()),
            "amount" => once(&mut self.amount, amount(value).ok_or_else(unknown)?, value),
            "dur" if self.duration_secs.is_some() => Err(unknown()),
            "dur" => once(&mut self.duration_secs, seconds(value)?, value),
            "ease" => once(&mut self.easing, value.parse::<Easing>().map_err(|_| unknown())?, value),
            "with" => once(&mut self.with, value.parse::<Move>().map_err(|_| unknown())?, value),
            _ => Err(unknown()),
        }
    }

    fn finish(self) -> Result<Step, String> {
        let name = self.movement.ok_or("no move")?;
        let default = FAMILIES.iter().find(|(family, _)| *family == name).map(|(_, heading)| *heading);
        let full = match (default, &self.heading) {
            (Some(default), heading) => format!("{name}-{}", heading.as_deref().unwrap_or(default)),
            (None, None) => name,
            (None, Some(heading)) if name.ends_with(&format!("-{heading}")) => name,
            (None, Some(heading)) => return Err(format!("\"{name}\" does not go {heading}")),
        };
        let open = default.is_some() && self.heading.is_none();
        let has = |flag: &str| self.flags.iter().any(|f| f == flag);
        Ok(Step {
            with: self.with,
            either_way: open || has("either"),
            start: self.start,
            end: self.end,
            via: self.via,
            amount: self.amount,
            duration_secs: self.duration_secs,
            speed: self.speed.unwrap_or_default(),
            easing: self.easing,
            cut: has("cut"),
            returns: has("returns"),
            ..Step::of(full.parse::<Move>().map_err(|_| format!("no move \"{full}\""))?)
        })
    }
}

fn set_framing(framing: &mut Framing, value: &str, resolve: &Resolve) -> Result<(), String> {
    let end = value.find([':', '!']).unwrap_or(value.len());
    let (names, more) = value.split_at(end);
    framing.subjects = objects(names, resolve)?;
    add_to_framing(framing, more, resolve)
}

/// `:low`, `!`, `+5` in any number.
fn add_to_framing(framing: &mut Framing, more: &str, resolve: &Resolve) -> Result<(), String> {
    let mut rest = more;
    while let Some(mark) = rest.chars().next() {
        let body = rest.get(1..).unwrap_or_default();
        let end = body.find([':', '!', '+']).unwrap_or(body.len());
        let (value, after) = body.split_at(end);
        match mark {
            '!' => framing.whole = true,
            '+' => framing.subjects.extend(objects(value, resolve)?),
            _ => qualify(framing, value)?,
        }
        rest = after;
    }
    Ok(())
}

fn qualify(framing: &mut Framing, value: &str) -> Result<(), String> {
    if let Some(size) = value.parse::<ShotSize>().ok() {
        return once(&mut framing.size, size, value);
    }
    if let Some(angle) = value.parse::<ShotAngle>().ok() {
        return once(&mut framing.angle, angle, value);
    }
    framing.part = value.parse::<SubjectPart>().map_err(|_| format!("framing \"{value}\""))?;
    Ok(())
}

fn objects(names: &str, resolve: &Resolve) -> Result<Vec<u32>, String> {
    let mut ids = Vec::new();
    for name in names.split('+').filter(|name| !name.is_empty() && *name != "room") {
        ids.extend(resolve(name).ok_or_else(|| format!("object \"{name}\""))?);
    }
    Ok(ids)
}

fn via(how: Pass, names: &str, resolve: &Resolve) -> Result<Via, String> {
    Ok(Via { how, objects: objects(names, resolve)? })
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

fn seconds(value: &str) -> Result<f64, String> {
    value.strip_suffix('s').and_then(|v| v.parse().ok()).ok_or_else(|| format!("\"{value}\" is no time"))
}

/// `program` in the notation; reading it back gives the program without its word spans and unmet requests.
pub fn program_to_notation(program: &Program) -> String {
    let steps: Vec<String> = program.steps.iter().map(step_to_notation).collect();
    let total = program.duration_secs.map(|secs| format!(" | total={secs}s")).unwrap_or_default();
    format!("{}{total}", steps.join(" / "))
}

fn step_to_notation(step: &Step) -> String {
    let mut parts = vec![step.movement.as_ref().to_owned()];
    parts.extend(step.with.map(|with| format!("with={}", with.as_ref())));
    parts.extend(framing_to_notation(&step.start).map(|text| format!("start={text}")));
    parts.extend(framing_to_notation(&step.end).map(|text| format!("end={text}")));
    if let Some(via) = &step.via {
        parts.push(format!("{}={}", via.how, joined(&via.objects)));
    }
    parts.extend(step.amount.map(|amount| match amount {
        Amount::Degrees(value) => format!("amount={value}deg"),
        Amount::Units(value) => format!("amount={value}u"),
        Amount::Factor(value) => format!("amount={value}x"),
        Amount::Slight => "amount=slight".to_owned(),
        Amount::Large => "amount=large".to_owned(),
    }));
    parts.extend(step.duration_secs.map(|secs| format!("dur={secs}s")));
    parts.extend((step.speed != Speed::Normal).then(|| step.speed.to_string()));
    parts.extend(step.easing.map(|easing| format!("ease={}", easing.as_ref())));
    for (flag, name) in [(step.cut, "cut"), (step.returns, "returns"), (step.either_way, "either")] {
        parts.extend(flag.then(|| name.to_owned()));
    }
    parts.join(" ")
}

fn joined(ids: &[u32]) -> String {
    ids.iter().map(u32::to_string).collect::<Vec<_>>().join("+")
}

fn framing_to_notation(framing: &Framing) -> Option<String> {
    if *framing == Framing::default() {
        return None;
    }
    let mut text = if framing.subjects.is_empty() { "room".to_owned() } else { joined(&framing.subjects) };
    let size = framing.size.map(<&str>::from);
    let angle = framing.angle.map(<&str>::from);
    let part = (framing.part != SubjectPart::Middle).then(|| <&str>::from(framing.part));
    for name in [size, angle, part].into_iter().flatten() {
        text.push(':');
        text.push_str(name);
    }
    if framing.whole {
        text.push('!');
    }
    Some(text)
}
