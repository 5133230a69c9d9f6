use std::fmt::Write as _;
use std::path::PathBuf;

use cinesplat::director::SceneContext;
use cinesplat::language::{EffectMention, Linked, NamedObject, QuantityKind, program_to_notation};
use cinesplat::lens::other_means;
use cinesplat::objects::{self, Object, ObjectSet};
use cinesplat::operator::Program;
use cinesplat::pipeline::{self, Interpreter, Reading};
use glam::DVec3;

use serde_json::{Value, json};

use super::failure::Failure;
use super::model_args::ModelArgs;
use super::{console, explain, heading};

/// Print what a sentence is understood as, without a scene
///
/// Prints the moves in order with how sure the program is of each, the mentions of objects, the words that it does not
/// use, and what it cannot do.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cinesplat read -p \"start close on the lamp, pull back, end wide\"
  cinesplat read -p \"circle the couch twice\" --objects objects.json --json
  cinesplat read -p \"circle the couch twice\" --names \"sofa,floor lamp\"
Without --objects and --names, every thing that the sentence names exists.")]
pub(super) struct Args {
    /// What the camera does, in words
    #[arg(short, long, value_name = "PROMPT", allow_hyphen_values = true, help_heading = heading::SHOT)]
    prompt: String,
    /// The scene's objects
    #[arg(long, value_name = "OBJECTS.JSON", help_heading = heading::SHOT, conflicts_with = "names")]
    objects: Option<PathBuf>,
    /// Names of the scene's objects, separated by commas; their ids are 1, 2 ..
    #[arg(long, value_name = "NAMES", value_delimiter = ',', help_heading = heading::SHOT)]
    names: Vec<String>,
    #[command(flatten)]
    models: ModelArgs,
    /// Print JSON
    #[arg(long, help_heading = heading::OUTPUT)]
    json: bool,
}

impl Args {
    pub(super) fn run(self) -> Result<(), Failure> {
        let interpreter = self.models.interpreter()?;
        let director = &interpreter.director;
        let mut names = self.objects()?;
        let mut linked = director.link(&self.prompt, &names)?;
        if self.objects.is_none() && self.names.is_empty() {
            // Every thing that the sentence names becomes an object.
            let named =
                (1..).zip(linked.missing_groups()).map(|(id, group)| NamedObject { id, label: group.name.clone() });
            names = named.collect();
            linked = director.link(&self.prompt, &names)?;
        }
        let (reading, objects) = read_linked(&interpreter, &self.prompt, linked, &names)?;
        if self.json {
            return console::data(&format!("{:#}\n", document(&self.prompt, &reading, &names)));
        }
        let missing = reading.linked.missing_groups();
        let missing = missing.map(|group| placeholder(0, &NamedObject { id: group.id, label: group.name.clone() }));
        let objects: Vec<Object> = objects.iter().cloned().chain(missing).collect();
        console::text(&text(&self.prompt, &reading, &ObjectSet { objects, labels: Vec::new() }))
    }

    fn objects(&self) -> Result<Vec<NamedObject>, Failure> {
        let Some(path) = &self.objects else {
            let named = (1..).zip(&self.names);
            return Ok(named.map(|(id, name)| NamedObject { id, label: name.trim().to_owned() }).collect());
        };
        let objects = objects::read_boxes(path)?;
        Ok(objects.into_iter().map(|object| NamedObject { id: object.id, label: object.label }).collect())
    }
}

/// Reads a prompt about things of which only the names are known, and the boxes that stand for them.
pub(super) fn read_linked(
    interpreter: &Interpreter,
    prompt: &str,
    linked: Linked,
    names: &[NamedObject],
) -> Result<(Reading, Vec<Object>), Failure> {
    let objects: Vec<Object> = names.iter().enumerate().map(|(idx, name)| placeholder(idx, name)).collect();
    let scene = SceneContext { objects: &objects, up: DVec3::Y, center: DVec3::ZERO, size: objects.len() as f64 + 2.0 };
    let reading = pipeline::read(prompt, linked, interpreter, &scene)?;
    Ok((reading, objects))
}

/// A box for an object of which only the name is known.
fn placeholder(idx: usize, name: &NamedObject) -> Object {
    let center = DVec3::new(idx as f64, 0.0, (idx % 3) as f64);
    Object::from_box(name.id, &name.label, center, DVec3::splat(0.3))
}

fn text(prompt: &str, reading: &Reading, objects: &ObjectSet) -> String {
    let mut text = String::new();
    let program = &reading.direction.program;
    for ((number, step), certainty) in (1..).zip(&program.steps).zip(&reading.direction.certainty) {
        let (sure, weakest) = (100.0 * certainty.probability, 100.0 * certainty.weakest.1);
        let words = reading.words_of(step, prompt);
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{number}. \"{words}\"\n   {}", explain::sentence(step, objects));
        let agreed = certainty.voices.map_or_else(String::new, |voices| {
            let perhaps = voices.otherwise.map_or_else(String::new, |movement| format!(", others read {movement}"));
            format!("; {:.0} % of the readings agree{perhaps}", 100.0 * voices.agreement)
        });
        let _ = writeln!(text, "   {sure:.0} % sure, least sure of {} ({weakest:.0} %){agreed}", certainty.weakest.0);
    }
    if program.steps.is_empty() {
        text.push_str("nothing that a camera could do\n");
    }
    for line in explain::of_whole_film(program, objects) {
        let _ = writeln!(text, "{line}");
    }
    for effect in &reading.effects {
        let forbidden = if effect.is_forbidden { ", forbidden" } else { "" };
        let means = other_means(&effect.call.name).map_or_else(String::new, |means| format!(": {means}"));
        let _ = writeln!(text, "effect: {} (\"{}\"){forbidden}{means}", effect.call.name, effect.call.because);
    }
    for problem in &reading.problems {
        let note = if problem.note.is_empty() { String::new() } else { format!(": {}", problem.note) };
        let _ = writeln!(text, "{}: \"{}\"{note}", problem.kind, problem.words);
    }
    for group in reading.linked.missing_groups() {
        let _ = writeln!(text, "not in the scene: \"{}\"", group.name);
    }
    let unused = reading.unused_words(prompt);
    if !unused.is_empty() {
        let _ = writeln!(text, "words without a meaning for the camera: {}", unused.join(", "));
    }
    text
}

fn document(prompt: &str, reading: &Reading, names: &[NamedObject]) -> Value {
    let program = &reading.direction.program;
    let steps: Vec<Value> = program
        .steps
        .iter()
        .zip(&reading.direction.certainty)
        .map(|(step, certainty)| {
            let alone = Program { steps: vec![step.clone()], ..Program::default() };
            json!({
                "program": program_to_notation(&alone),
                "move": step.movement.as_ref(),
                "either": step.either_way,
                "with": step.with.iter().map(AsRef::<str>::as_ref).collect::<Vec<&str>>(),
                "words": step.words,
                "text": reading.words_of(step, prompt),
                "probability": certainty.probability,
                "agreement": certainty.voices.map(|voices| voices.agreement),
                "least_sure_of": certainty.weakest.0,
            })
        })
        .collect();
    let problems: Vec<Value> = reading
        .problems
        .iter()
        .map(|problem| {
            json!({"kind": problem.kind.as_ref(), "text": problem.words, "words": problem.span, "note": problem.note})
        })
        .collect();
    let kind = |kind: QuantityKind| format!("{kind:?}").to_lowercase();
    let quantities: Vec<Value> =
        reading.linked.quantities.iter().map(|q| json!({"kind": kind(q.kind), "value": q.value})).collect();
    let missing = reading.linked.missing_groups();
    json!({
        "prompt": prompt,
        "tokens": reading.linked.tokens_text,
        "program": program_to_notation(program),
        "steps": steps,
        "duration_secs": program.duration_secs,
        "no": program.forbidden.iter().map(AsRef::<str>::as_ref).collect::<Vec<&str>>(),
        "objects": names.iter().map(|name| json!({"id": name.id, "label": name.label})).collect::<Vec<_>>(),
        "missing": missing.map(|group| json!({"name": group.name, "nearest": group.nearest})).collect::<Vec<_>>(),
        "quantities": quantities,
        "effects": reading.effects.iter().map(effect_json).collect::<Vec<_>>(),
        "problems": problems,
        "unused_words": reading.unused_words(prompt),
    })
}

fn effect_json(mention: &EffectMention) -> Value {
    let call = &mention.call;
    let settings: serde_json::Map<String, Value> =
        call.settings.iter().map(|(name, value)| (name.clone(), json!(value))).collect();
    json!({"kind": call.name, "text": call.because, "forbidden": mention.is_forbidden, "settings": settings})
}
