use cinesplat_operator::{Amount, Framing, Program, Speed, Step, SubjectPart};

/// `program` in the notation. [`program_from_notation`](super::program_from_notation) reads the program back,
/// except the steps' `words`, which the notation omits.
pub fn program_to_notation(program: &Program) -> String {
    let steps: Vec<String> = program.steps.iter().map(step_to_notation).collect();
    let total = program.duration_secs.map(|secs| format!(" | total={secs}s")).unwrap_or_default();
    format!("{}{total}", steps.join(" / "))
}

fn step_to_notation(step: &Step) -> String {
    let mut tokens = vec![step.movement.to_string()];
    tokens.extend(step.with.map(|with| format!("with={with}")));
    tokens.extend(framing_to_notation(&step.start).map(|text| format!("start={text}")));
    tokens.extend(framing_to_notation(&step.end).map(|text| format!("end={text}")));
    tokens.extend(step.via.as_ref().map(|via| format!("{}={}", via.how, joined(&via.objects))));
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
