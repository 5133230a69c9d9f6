use cinesplat_operator::{Amount, Framing, Lens, Level, Limit, Look, Program, Speed, Step, SubjectPart};

/// The text of a program without steps.
pub(super) const NO_STEPS: &str = "none";

/// `program` in the notation. [`program_from_notation`](super::program_from_notation) reads the program back,
/// except the steps' `words`, which the notation omits.
pub fn program_to_notation(program: &Program) -> String {
    let steps: Vec<String> = program.steps.iter().map(step_to_notation).collect();
    let steps = if steps.is_empty() { NO_STEPS.to_owned() } else { steps.join(" / ") };
    let total = program.duration_secs.map(|secs| format!("total={secs}s"));
    let forbidden = (!program.forbidden.is_empty()).then(|| format!("no={}", joined(&program.forbidden)));
    let limits = program.limits.iter().map(limit_to_notation);
    let film: Vec<String> = total.into_iter().chain(forbidden).chain(limits).collect();
    if film.is_empty() { steps } else { format!("{steps} | {}", film.join(" ")) }
}

fn limit_to_notation(limit: &Limit) -> String {
    let height = |level: Level| match level {
        Level::Units(units) => format!("{units}u"),
        Level::Object(id) => id.to_string(),
    };
    match *limit {
        Limit::Above(level) => format!("above={}", height(level)),
        Limit::Below(level) => format!("below={}", height(level)),
        Limit::Clear(None, units) => format!("clear={units}u"),
        Limit::Clear(Some(id), units) => format!("clear={id}:{units}u"),
        Limit::Within(id, units) => format!("within={id}:{units}u"),
        Limit::Speed(units) => format!("speed={units}u"),
        Limit::TurnSpeed(degrees) => format!("speed={degrees}deg"),
    }
}

fn step_to_notation(step: &Step) -> String {
    let mut tokens = vec![step.movement.to_string()];
    tokens.extend((!step.with.is_empty()).then(|| format!("with={}", joined(&step.with))));
    tokens.extend(framing_to_notation(&step.start).map(|text| format!("start={text}")));
    tokens.extend(framing_to_notation(&step.end).map(|text| format!("end={text}")));
    tokens.extend(step.via.as_ref().map(|via| format!("{}={}", via.how, joined(&via.objects))));
    tokens.extend(step.look.as_ref().map(|look| match look {
        Look::At(ids) => format!("look={}", joined(ids)),
        Look::Ahead => "look=ahead".to_owned(),
        Look::Back => "look=back".to_owned(),
        Look::Room => "look=room".to_owned(),
    }));
    for (name, ids) in [("keep", &step.keep), ("avoid", &step.avoid)] {
        tokens.extend((!ids.is_empty()).then(|| format!("{name}={}", joined(ids))));
    }
    tokens.extend(step.amount.map(|amount| match amount {
        Amount::Degrees(value) => format!("amount={value}deg"),
        Amount::Units(value) => format!("amount={value}u"),
        Amount::Factor(value) => format!("amount={value}x"),
        Amount::Slight => "amount=slight".to_owned(),
        Amount::Large => "amount=large".to_owned(),
    }));
    tokens.extend(step.duration_secs.map(|secs| format!("dur={secs}s")));
    tokens.extend((step.speed != Speed::Normal).then(|| step.speed.to_string()));
    tokens.extend(step.easing.map(|easing| format!("ease={easing}")));
    for (is_set, flag) in [(step.cut, "cut"), (step.returns, "returns"), (step.either_way, "either")] {
        tokens.extend(is_set.then(|| flag.to_owned()));
    }
    tokens.join(" ")
}

fn joined<T: ToString>(items: &[T]) -> String {
    items.iter().map(T::to_string).collect::<Vec<_>>().join("+")
}

fn framing_to_notation(framing: &Framing) -> Option<String> {
    if *framing == Framing::default() {
        return None;
    }
    let mut text = if framing.subjects.is_empty() { "room".to_owned() } else { joined(&framing.subjects) };
    let name = |name: Option<&'static str>| name.map(str::to_owned);
    let qualifiers = [
        name(framing.size.map(<&str>::from)),
        framing.height_frac.map(|frac| format!("{}%", percent(frac))),
        name(framing.angle.map(<&str>::from)),
        framing.elevation_deg.map(|degrees| format!("{degrees}deg")),
        framing.height.map(|height| format!("h{height}u")),
        framing.distance.map(|distance| format!("d{distance}u")),
        framing.lens.map(|lens| match lens {
            Lens::FocalMm(focal_mm) => format!("{focal_mm}mm"),
            Lens::FovDeg(fov_deg) => format!("{fov_deg}fov"),
            Lens::Wide => "wide-lens".to_owned(),
            Lens::Long => "long-lens".to_owned(),
        }),
        name((framing.part != SubjectPart::Middle).then(|| framing.part.into())),
        name(framing.side.map(<&str>::from)),
        name(framing.place.map(<&str>::from)),
        name(framing.hidden.then_some("hidden")),
    ];
    let backdrop = framing.backdrop.iter().map(|id| format!("before-{id}"));
    for qualifier in qualifiers.into_iter().flatten().chain(backdrop) {
        text.push(':');
        text.push_str(&qualifier);
    }
    if framing.whole {
        text.push('!');
    }
    Some(text)
}

/// A share of the frame in percent, without the rounding error of its fraction.
fn percent(frac: f64) -> f64 {
    (frac * 1e8).round() / 1e6
}
