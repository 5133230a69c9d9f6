use std::fmt::Write as _;

use super::console;
use cinesplat::critic::{Candidate, TERMS, Weights, trade};
use cinesplat::lens::{EffectPlan, Unmet};
use cinesplat::objects::ObjectSet;
use cinesplat::operator::{Amount, Framing, Lens, Level, Limit, Look, Program, Speed, Step, SubjectPart};
use cinesplat::pipeline::{Critique, Directed};
use cinesplat::trajectory::ClearanceProof;

/// Explains a shot: the meaning of each clause of its prompt, the report of requested and achieved values, the clearance proof
/// and the plan of effects.
pub(super) fn explanation(directed: &Directed, plan: &EffectPlan, objects: &ObjectSet) -> String {
    let mut text = format!("prompt: {}\n\nunderstood as\n", directed.shot.prompt);
    for (number, reading) in directed.steps.iter().enumerate() {
        let words = if reading.words.is_empty() { "(no words)" } else { &reading.words };
        let (weakest, weakest_sure) = reading.weakest;
        let (sure, weakest_sure) = (100.0 * reading.probability, 100.0 * weakest_sure);
        let _ = writeln!(text, "  {}. \"{words}\"", number + 1);
        let _ = writeln!(text, "     {}", sentence(&reading.step, objects));
        let _ = writeln!(text, "     {sure:.0} % sure, least sure of {weakest} ({weakest_sure:.0} %)");
    }
    for line in of_whole_film(&directed.program, objects) {
        let _ = writeln!(text, "  {line}");
    }
    text.push_str("\nwanted and got\n");
    for line in &directed.shot.report {
        let verdict = if line.met { "met    " } else { "NOT MET" };
        let note = if line.note.is_empty() { String::new() } else { format!(" ({})", line.note) };
        let _ = writeln!(text, "  {verdict} {}: wanted {}, got {:.3}{note}", line.clause, line.wanted, line.got);
    }
    text.extend(directed.critique.as_ref().map(pictures));
    text.push_str("\nclearance\n");
    text.extend(directed.shot.clearance.as_ref().map(clearance));
    text.push_str("\neffects\n");
    for line in plan.sentences().into_iter().chain(directed.effects.unmet.iter().map(Unmet::sentence)) {
        let _ = writeln!(text, "  {line}");
    }
    text
}

/// What the critic said about the film and about the runner-up, and what the choice traded.
fn pictures(critique: &Critique) -> String {
    let weights = Weights::default();
    let Some(chosen) = critique.candidates.first() else { return String::new() };
    let other = critique.candidates.get(1);
    let num = critique.candidates.len();
    let moments = chosen.review.pictures.len();
    let mut text = format!("\npictures: {num} films that clearly differ, each seen at {moments} moments\n");
    let _ = writeln!(text, "  {:10} {:>6} {:>6} {:>9}  what lowers the mark", "term", "weight", "film", "runner-up");
    let cell = |value: Option<f64>| value.map_or_else(|| "-".to_owned(), |value| format!("{value:.2}"));
    for row in &TERMS {
        let value = |candidate: &Candidate| candidate.review.value(row.term);
        let (ours, theirs) = (cell(value(chosen)), cell(other.and_then(value)));
        let name = row.term.as_ref();
        let _ = writeln!(text, "  {name:10} {:6.1} {ours:>6} {theirs:>9}  {}", row.weight, row.punishes);
    }
    let score = |candidate: &Candidate| candidate.review.score(&weights);
    let (ours, theirs) = (cell(Some(score(chosen))), cell(other.map(score)));
    let _ = writeln!(text, "  {:10} {:6} {ours:>6} {theirs:>9}", "all", "");
    let _ = match other {
        Some(other) => writeln!(text, "  {}", trade(chosen, other, &weights)),
        None => writeln!(text, "  No other film that clearly differs meets the words as well."),
    };
    text
}

/// The clearance proof in words.
fn clearance(proof: &ClearanceProof) -> String {
    let (radius, parts) = (proof.camera_radius, proof.num_intervals);
    let matter = format!("Gaussians of opacity {} or more, up to {} sigma", proof.opacity_floor, proof.sigma_level);
    let nearest = proof.gaussian_idx.map_or_else(String::new, |idx| format!(", to Gaussian {idx}"));
    let found = match &proof.failure {
        None => format!(
            "proved: distance at least {:.4}, reached at about {:.2} s{nearest}",
            proof.min_distance, proof.at_secs
        ),
        Some(failure) => format!(
            "NOT CLEAR from {:.2} to {:.2} s: {:.4} from Gaussian {}",
            failure.from_secs, failure.to_secs, failure.distance, failure.gaussian_idx
        ),
    };
    format!("  {found}\n  camera radius {radius:.4}, {matter}; {parts} parts of the path checked\n")
}

/// What a program says of the whole film, one line each.
pub(super) fn of_whole_film(program: &Program, objects: &ObjectSet) -> Vec<String> {
    let length = program.duration_secs.map(|secs| format!("length of the film: {secs} s"));
    let ruled_out = program.forbidden.iter().map(|motion| format!("ruled out: {motion}"));
    let limits = program.limits.iter().map(|limit| format!("limit: {}", limit_words(limit, objects)));
    length.into_iter().chain(ruled_out).chain(limits).collect()
}

fn limit_words(limit: &Limit, objects: &ObjectSet) -> String {
    let name = |id: u32| names(&[id], objects);
    let level = |level: Level| match level {
        Level::Units(units) => format!("{units} units"),
        Level::Object(id) => name(id),
    };
    match *limit {
        Limit::Above(least) => format!("camera never lower than {}", level(least)),
        Limit::Below(most) => format!("camera never higher than {}", level(most)),
        Limit::Clear(None, units) => format!("never nearer than {units} units to anything"),
        Limit::Clear(Some(id), units) => format!("never nearer than {units} units to {}", name(id)),
        Limit::Within(id, units) => format!("never farther than {units} units from {}", name(id)),
        Limit::Speed(units) => format!("never faster than {units} units a second"),
        Limit::TurnSpeed(degrees) => format!("no turn faster than {degrees} degrees a second"),
    }
}

/// A step in words.
pub(super) fn sentence(step: &Step, objects: &ObjectSet) -> String {
    let mut parts = vec![step.movement.as_ref().to_owned()];
    if step.either_way {
        parts.push("in either direction".to_owned());
    }
    parts.extend(step.with.iter().map(|second| format!("with {second}")));
    parts.extend(step.amount.map(amount));
    parts.extend(framing("from", &step.start, objects));
    parts.extend(framing("to", &step.end, objects));
    if let Some(via) = &step.via {
        parts.push(format!("{} {}", via.how, names(&via.objects, objects)));
    }
    parts.extend(step.look.as_ref().map(|look| match look {
        Look::At(ids) => format!("looking at {}", names(ids, objects)),
        Look::Ahead => "looking ahead".to_owned(),
        Look::Back => "looking back".to_owned(),
        Look::Room => "looking at the room".to_owned(),
    }));
    for (what, ids) in [("keeping in view", &step.keep), ("never showing", &step.avoid)] {
        parts.extend((!ids.is_empty()).then(|| format!("{what} {}", names(ids, objects))));
    }
    parts.extend((step.speed != Speed::Normal).then(|| step.speed.to_string()));
    parts.extend(step.duration_secs.map(|secs| format!("{secs} s")));
    parts.extend(step.easing.map(|easing| easing.as_ref().to_owned()));
    if step.cut {
        parts.push("after a cut".to_owned());
    }
    if step.returns {
        parts.push("back to its start".to_owned());
    }
    parts.join(", ")
}

fn amount(amount: Amount) -> String {
    match amount {
        Amount::Degrees(degrees) => format!("{degrees} degrees"),
        Amount::Units(units) => format!("{units} units"),
        Amount::Factor(factor) => format!("factor {factor}"),
        Amount::Slight => "a little".to_owned(),
        Amount::Large => "a lot".to_owned(),
    }
}

/// The framing at one end of a step; `None` if the step does not define it.
fn framing(preposition: &str, framing: &Framing, objects: &ObjectSet) -> Option<String> {
    if *framing == Framing::default() {
        return None;
    }
    let mut parts = Vec::new();
    parts.extend(framing.angle.map(|angle| angle.as_ref().to_owned()));
    parts.extend(framing.size.map(|size| size.as_ref().to_owned()));
    let part = match framing.part {
        SubjectPart::Middle => "",
        SubjectPart::Top => "the top of ",
        SubjectPart::Bottom => "the bottom of ",
        SubjectPart::Left => "the left end of ",
        SubjectPart::Right => "the right end of ",
    };
    if !framing.subjects.is_empty() {
        let whole = if framing.whole { " whole" } else { "" };
        parts.push(format!("{part}{}{whole}", names(&framing.subjects, objects)));
    } else if framing.whole {
        parts.push("the whole room".to_owned());
    }
    parts.extend(framing.side.map(spaced));
    parts.extend(framing.place.map(spaced));
    parts.extend(framing.height_frac.map(|frac| format!("{:.0} % of the frame high", 100.0 * frac)));
    parts.extend(framing.elevation_deg.map(|degrees| format!("seen from {degrees} degrees above")));
    parts.extend(framing.height.map(|height| format!("camera {height} units above the floor")));
    parts.extend(framing.distance.map(|distance| format!("{distance} units away")));
    parts.extend(framing.lens.map(|lens| match lens {
        Lens::FocalMm(focal_mm) => format!("{focal_mm} mm"),
        Lens::FovDeg(fov_deg) => format!("{fov_deg} degrees of view"),
        Lens::Wide => "wide-angle lens".to_owned(),
        Lens::Long => "long lens".to_owned(),
    }));
    parts.extend(framing.hidden.then(|| "hidden".to_owned()));
    if !framing.backdrop.is_empty() {
        parts.push(format!("with {} behind it", names(&framing.backdrop, objects)));
    }
    Some(format!("{preposition} {}", parts.join(" ")))
}

/// A name in kebab case as words.
fn spaced(name: impl AsRef<str>) -> String {
    name.as_ref().replace('-', " ")
}

fn names(ids: &[u32], objects: &ObjectSet) -> String {
    let name = |id: &u32| match objects.get(*id) {
        // What the scene lacks has no id that a prompt could say.
        Some(object) if *id > u32::from(u16::MAX) => format!("{} (not in the scene)", console::one_line(&object.label)),
        Some(object) if !object.label.is_empty() => format!("{} <obj-{id}>", console::one_line(&object.label)),
        _ => format!("<obj-{id}>"),
    };
    ids.iter().map(name).collect::<Vec<_>>().join(" and ")
}
