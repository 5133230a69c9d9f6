//! What a prompt is understood as: its program, how sure that is, and what it asks for in vain.

use cinesplat_director::{Direction, SceneContext, StepCertainty, take_levels};
use cinesplat_language::{
    EffectMention, Group, Linked, effect_mentions, forbidding_words, frame_rate, is_foreign, tokenize,
};
use cinesplat_operator::{Framing, Look, Motion, Pass, Program, Step};
use cinesplat_trajectory::{Move, ReportLine};

use super::doubtful_rests;
use super::error::PipelineError;
use super::interpreter::Interpreter;
use super::stated;

/// Below this probability a step is not carried out, unless all others are less likely.
const LEAST_PROBABILITY: f64 = 0.03;
/// Below this probability a step is carried out with a warning: of one reading, of one that others contradict, and of one that all
/// agree with. Of 427 sentences that are read right (`cinesplat bench readings`) 41 get a warning, of 113 that are not 49; with the
/// first bound for all it was 80 and 46.
const SURE_PROBABILITY: f64 = 0.2;
const SURE_PROBABILITY_DISPUTED: f64 = 0.25;
const SURE_PROBABILITY_AGREED: f64 = 0.08;
/// Least agreement of readings that counts as all.
const ALL_AGREE: f64 = 0.99;

/// The interpretation of a prompt.
#[derive(Debug, Clone, PartialEq)]
pub struct Reading {
    /// The words, with their mentions of objects.
    pub linked: Linked,
    /// The program, the cameras that the network proposes, and the certainty of each step.
    pub direction: Direction,
    /// Effects that the prompt mentions.
    pub effects: Vec<EffectMention>,
    /// What the prompt asks for and the program does not contain.
    pub problems: Vec<Problem>,
}

/// A part of a prompt that the program does not contain.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Problem {
    /// Why.
    pub kind: ProblemKind,
    /// The words of the prompt.
    pub words: String,
    /// Their bytes of the prompt.
    pub span: [usize; 2],
    /// What the program would have done, or which names are near; may be empty.
    pub note: String,
}

/// Why a part of a prompt is not in the program.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[derive(strum::AsRefStr, strum::Display)]
#[strum(serialize_all = "kebab-case")]
pub enum ProblemKind {
    /// The scene has no such object.
    NotInScene,
    /// No camera can do it.
    CannotBeDone,
    /// It contradicts other words.
    Contradiction,
    /// Its meaning is not clear enough.
    NotUnderstood,
}

impl Problem {
    /// The line of the report.
    pub fn report_line(&self) -> ReportLine {
        let wanted = match self.kind {
            ProblemKind::NotInScene => "an object of the scene",
            ProblemKind::CannotBeDone => "something that a camera can do",
            ProblemKind::Contradiction => "no contradiction",
            ProblemKind::NotUnderstood => "words that are understood",
        };
        ReportLine {
            clause: self.words.clone(),
            wanted: wanted.to_owned(),
            got: 0.0,
            met: false,
            note: self.note.clone(),
        }
    }
}

impl Reading {
    /// The words of a step; empty for a step without words of its own.
    pub fn words_of<'a>(&self, step: &Step, prompt: &'a str) -> &'a str {
        step.words.and_then(|[start, end]| prompt.get(start..end)).unwrap_or_default()
    }

    /// Words of the prompt that no step, no effect and no problem accounts for, in order, without words that carry no
    /// request.
    pub fn unused_words<'a>(&self, prompt: &'a str) -> Vec<&'a str> {
        let of_steps = self.direction.program.steps.iter().filter_map(|step| step.words);
        let of_effects = self.effects.iter().map(|effect| effect_words(prompt, effect, &self.effects));
        let of_problems = self.problems.iter().map(|problem| problem.span);
        let of_rate = frame_rate(prompt).map(|rate| rate.bytes);
        let others: Vec<[usize; 2]> = of_effects.chain(of_problems).chain(of_rate).collect();
        let used: Vec<[usize; 2]> = of_steps.chain(others.iter().copied()).collect();
        let lies_in =
            |span: &[usize; 2], used: &[[usize; 2]]| used.iter().any(|used| used[0] <= span[0] && span[1] <= used[1]);
        // A number that no step uses is the length of the film, if that is stated.
        let has_length = self.direction.program.duration_secs.is_some();
        let is_length = |word: &str| has_length && word.starts_with("<qty-");
        // A mark that somebody dictated stands on the words for it.
        let is_word = |word: &str| word.contains(char::is_alphanumeric);
        let words = self.linked.tokens_text.split(' ').zip(&self.linked.spans).filter(|(word, _)| is_word(word));
        let mut spans: Vec<[usize; 2]> =
            words.filter(|(word, span)| !is_length(word) && !lies_in(span, &used)).map(|(_, span)| *span).collect();
        let scenery = self.linked.scenery.iter().flat_map(|&[start, end]| {
            let words = tokenize(prompt.get(start..end).unwrap_or_default());
            words.into_iter().map(move |word| word.span.map(|at| start + at))
        });
        spans.extend(scenery.filter(|span| !lies_in(span, &others)));
        spans.sort_unstable();
        // One word of the prompt may stand for several.
        spans.dedup();
        spans.into_iter().filter_map(|span| prompt.get(span[0]..span[1])).filter(|word| carries_request(word)).collect()
    }
}

/// Reads a prompt about a scene; `linked` are its words with their mentions
/// ([`Director::link`](cinesplat_director::Director::link)).
///
/// # Errors
/// [`PipelineError::Language`] when the embedded lexicon is malformed · [`PipelineError::Director`] when the network
/// fails · [`PipelineError::Reader`] when the language model fails.
pub fn read(
    prompt: &str,
    linked: Linked,
    interpreter: &Interpreter,
    scene: &SceneContext<'_>,
) -> Result<Reading, PipelineError> {
    let effects = effect_mentions(prompt, &linked)?;
    let mut direction = interpreter.direct(prompt, &linked, scene)?;
    if linked.slots.is_empty() && linked.quantities.is_empty() && effects.is_empty() && is_gibberish(&linked)? {
        direction = Direction::default();
    }
    if direction.program.limits.is_empty() {
        direction.program.limits.clone_from(&linked.limits);
    }
    take_levels(&linked, scene, &mut direction)?;
    let stays = stated::apply(prompt, linked.timeline.as_ref(), &mut direction.program);
    retain_steps(&mut direction, &stays);
    merge_holds(&linked, &mut direction);
    keep_held_pictures(&mut direction.program.steps);
    begin_turns(prompt, &mut direction.program.steps);
    doubtful_rests::approach(prompt, &mut direction);
    let mut problems = Vec::new();
    problems.extend(unmet(prompt, &direction, &effects));
    problems.extend(missing_aside(&linked, &mut direction.program));
    problems.extend(contradictions(prompt, &mut direction.program));
    problems.extend(uncertain(prompt, &mut direction));
    Ok(Reading { linked, direction, effects, problems })
}

/// Whether the words are of no language that is read, and none of them has a meaning for a camera.
fn is_gibberish(linked: &Linked) -> Result<bool, PipelineError> {
    let words = linked.texts_in([0, usize::MAX]);
    Ok(is_foreign(&words)? && linked.senses()?.iter().all(|senses| senses.is_empty()))
}

/// Makes one static step of two in a row that hold the same picture: `go low and look up at it, then stay there for
/// 5 s`.
fn merge_holds(linked: &Linked, direction: &mut Direction) {
    let mut nth = 1;
    while nth < direction.program.steps.len() {
        let steps = &mut direction.program.steps;
        let (before, after) = steps.split_at_mut(nth);
        let (first, second) = (&mut before[nth - 1], &after[0]);
        if !goes_on(first, second) {
            nth += 1;
            continue;
        }
        // Two steps with a length that the words state once are one hold; those that share the length of a part add up.
        let stated =
            |secs: f64| linked.quantities.iter().filter(move |quantity| quantity.value.to_bits() == secs.to_bits());
        let is_new = |secs: &f64| first.duration_secs != Some(*secs) || stated(*secs).count() != 1;
        let further = second.duration_secs.filter(is_new);
        first.duration_secs = first.duration_secs.into_iter().chain(further).reduce(|sum, secs| sum + secs);
        first.words = first.joint_words(second);
        direction.remove_step(nth);
    }
}

/// A hold on the subjects of the step before keeps its picture: `pull out until both are in, hold`.
fn keep_held_pictures(steps: &mut [Step]) {
    for nth in 1..steps.len() {
        let (before, after) = steps.split_at_mut(nth);
        let (first, second) = (&before[nth - 1], &mut after[0]);
        let plain = Framing { subjects: first.end.subjects.clone(), ..Framing::default() };
        let holds = second.movement == Move::Static && !second.cut && second.start == Framing::default();
        if holds && !plain.subjects.is_empty() && second.end == plain && first.end != plain {
            second.end = Framing::default();
        }
    }
}

/// A turn in place from an object begins at its picture: `from the vase look up to the clock`. Where somebody stands at
/// the object, he says so.
fn begin_turns(prompt: &str, steps: &mut [Step]) {
    const STANDS: [&str; 10] =
        ["stand", "standing", "beside", "next", "near", "by", "sit", "sitting", "position", "viewpoint"];
    const TURNS: [&str; 12] =
        ["pan", "pans", "look", "looks", "turn", "turns", "tilt", "swing", "whip", "sweep", "swivel", "panning"];
    let says = |step: &Step, list: &[&str]| {
        let words = step.words.and_then(|[from, to]| prompt.get(from..to)).unwrap_or_default().to_lowercase();
        words.split(|c: char| !c.is_alphanumeric()).any(|word| list.contains(&word))
    };
    let stands = |step: &Step| says(step, &STANDS);
    let turns = |step: &Step| says(step, &TURNS);
    // `You just lie there. From the bed.` is no turn from it.
    let is_goalless = |step: &Step| step.end == Framing::default() && !turns(step);
    let begins = |step: &&mut Step| {
        step.movement.looks_elsewhere() && step.start.subjects.is_empty() && !stands(step) && !is_goalless(step)
    };
    for step in steps.iter_mut().filter(begins) {
        if let Some(via) = step.via.take_if(|via| via.how == Pass::From) {
            step.start.subjects = via.objects;
        }
    }
}

/// Whether a static step only goes on with the picture of the static step before.
fn goes_on(first: &Step, second: &Step) -> bool {
    let plain = Step {
        end: Framing { subjects: second.end.subjects.clone(), ..Framing::default() },
        duration_secs: second.duration_secs,
        words: second.words,
        speed: second.speed,
        ..Step::of(Move::Static)
    };
    let same = second.end.subjects.is_empty() || second.end.subjects == first.end.subjects;
    first.movement == Move::Static && first.with.is_empty() && *second == plain && same
}

/// Words that the notation cannot say and that are no effect.
fn unmet(prompt: &str, direction: &Direction, effects: &[EffectMention]) -> Vec<Problem> {
    let overlaps = |a: &[usize; 2], b: &[usize; 2]| a[0] < b[1] && b[0] < a[1];
    let of_effects: Vec<_> = effects.iter().map(|effect| effect_words(prompt, effect, effects)).collect();
    let spans = direction.unmet.iter().filter(|span| !of_effects.iter().any(|effect| overlaps(effect, span)));
    let spans = spans.filter(|[start, end]| prompt.get(*start..*end).is_some_and(carries_request));
    // The film has the stated frame rate.
    let rate = frame_rate(prompt).map(|rate| rate.bytes);
    let spans = spans.filter(|span| !rate.is_some_and(|rate| overlaps(&rate, span)));
    let problem = |span: &[usize; 2]| problem(prompt, ProblemKind::CannotBeDone, *span, String::new());
    spans.map(problem).collect()
}

/// The bytes of the words that mention an effect, with the negation before them.
fn effect_words(prompt: &str, mention: &EffectMention, mentions: &[EffectMention]) -> [usize; 2] {
    let [start, _] = forbidding_words(prompt, mention, mentions);
    [start, mention.span[1]]
}

fn problem(prompt: &str, kind: ProblemKind, span: [usize; 2], note: String) -> Problem {
    let words = prompt.get(span[0]..span[1]).unwrap_or_default().to_owned();
    Problem { kind, words, span, note }
}

/// Removes what the scene lacks from where a step only passes, looks at, keeps or avoids it. A step about something
/// that the scene lacks keeps it: callers refuse such a prompt.
fn missing_aside(linked: &Linked, program: &mut Program) -> Vec<Problem> {
    let mut problems = Vec::new();
    for step in &mut program.steps {
        let span = step.words.unwrap_or_default();
        let mut keep_known = |ids: &mut Vec<u32>| {
            ids.retain(|id| {
                let Some(group) = linked.missing(*id) else { return true };
                problems.push(not_in_scene(group, span));
                false
            });
        };
        if let Some(via) = &mut step.via {
            keep_known(&mut via.objects);
        }
        if let Some(Look::At(ids)) = &mut step.look {
            keep_known(ids);
        }
        keep_known(&mut step.keep);
        keep_known(&mut step.avoid);
        step.via = step.via.take().filter(|via| !via.objects.is_empty());
        step.look = step.look.take().filter(|look| *look != Look::At(Vec::new()));
    }
    program.limits.retain(|limit| {
        let Some(group) = limit.object().and_then(|id| linked.missing(id)) else { return true };
        problems.push(not_in_scene(group, [0, 0]));
        false
    });
    problems
}

/// Something that words name and the scene lacks.
fn not_in_scene(group: &Group, span: [usize; 2]) -> Problem {
    let note = format!("no such object; nearest: {}", group.nearest.join(", "));
    Problem { kind: ProblemKind::NotInScene, words: group.name.clone(), span, note }
}

/// Steps that contradict themselves or the motions that the film forbids. Of two opposite moves at once the first
/// stays; a forbidden move stays too, because the prompt names it.
fn contradictions(prompt: &str, program: &mut Program) -> Vec<Problem> {
    let mut problems = Vec::new();
    for step in &mut program.steps {
        let span = step.words.unwrap_or([0, prompt.len()]);
        let movement = step.movement;
        step.with.retain(|second| {
            let is_possible = movement.opposite() != Some(*second);
            if !is_possible {
                let note = format!("{movement} and {second} at the same time: carried out as {movement}");
                problems.push(problem(prompt, ProblemKind::Contradiction, span, note));
            }
            is_possible
        });
        let moves = std::iter::once(&movement).chain(&step.with);
        let forbidden = moves.filter_map(|movement| Some((movement, Motion::of(*movement)?)));
        for (movement, motion) in forbidden.filter(|(_, motion)| program.forbidden.contains(motion)) {
            let note = format!("{movement}, although the prompt rules out \"{motion}\"");
            problems.push(problem(prompt, ProblemKind::Contradiction, span, note));
        }
    }
    problems
}

/// Removes the steps that are too unlikely, unless they are all; tells of them and of doubtful ones.
fn uncertain(prompt: &str, direction: &mut Direction) -> Vec<Problem> {
    let most = direction.certainty.iter().map(|certainty| certainty.probability).fold(0.0, f64::max);
    let mut problems = Vec::new();
    // A clause about things of the scene that no other step has is carried out as well as it is understood.
    let steps = &direction.program.steps;
    let is_own = |nth: usize| {
        let Some([from, to]) = steps.get(nth).filter(|step| !step.end.subjects.is_empty()).and_then(|step| step.words)
        else {
            return false;
        };
        let mut others = steps.iter().enumerate().filter(|(other, _)| *other != nth).filter_map(|(_, step)| step.words);
        others.all(|[start, end]| end <= from || to <= start)
    };
    let is_likely = |(nth, certainty): (usize, &StepCertainty)| {
        certainty.probability >= LEAST_PROBABILITY || certainty.probability >= most || is_own(nth)
    };
    let is_kept: Vec<bool> = direction.certainty.iter().enumerate().map(is_likely).collect();
    for ((certainty, step), is_kept) in direction.certainty.iter().zip(&direction.program.steps).zip(&is_kept) {
        if is_sure(certainty) {
            continue;
        }
        let sure = 100.0 * certainty.probability;
        let otherwise = certainty.voices.and_then(|voices| voices.otherwise);
        let perhaps = otherwise.map_or_else(String::new, |movement| format!(", perhaps {movement}"));
        let read_as = format!("read as {}, {sure:.0} % sure{perhaps}", step.movement);
        let note = if *is_kept { read_as } else { format!("left out; {read_as}") };
        let span = certainty.words.unwrap_or([0, prompt.len()]);
        problems.push(problem(prompt, ProblemKind::NotUnderstood, span, note));
    }
    retain_steps(direction, &is_kept);
    problems
}

/// Whether a step needs no warning.
fn is_sure(certainty: &StepCertainty) -> bool {
    let least = match certainty.voices {
        None => SURE_PROBABILITY,
        Some(voices) if voices.agreement >= ALL_AGREE => SURE_PROBABILITY_AGREED,
        Some(_) => SURE_PROBABILITY_DISPUTED,
    };
    certainty.probability >= least
}

/// Removes the steps that are not marked, with their cameras.
fn retain_steps(direction: &mut Direction, marks: &[bool]) {
    retain_marked(&mut direction.program.steps, marks);
    retain_marked(&mut direction.certainty, marks);
    retain_marked(&mut direction.step_cameras, marks);
}

/// Removes the items that are not marked; items beyond the marks stay.
fn retain_marked<T>(items: &mut Vec<T>, marks: &[bool]) {
    let mut marks = marks.iter();
    items.retain(|_| marks.next().copied().unwrap_or(true));
}

/// Whether a word or phrase may ask for something: it has letters or digits and is no word of courtesy or grammar.
fn carries_request(words: &str) -> bool {
    const EMPTY: [&str; 61] = [
        "a", "an", "the", "and", "then", "please", "thanks", "thank", "you", "i", "we", "me", "my", "us", "our", "it",
        "its", "is", "are", "be", "to", "of", "on", "in", "at", "so", "ok", "okay", "um", "uh", "well", "just", "like",
        "that", "this", "there", "can", "could", "would", "want", "need", "let", "lets", "let's", "s", "d", "ll",
        "with", "for", "as", "but", "or", "total", "camera", "cam", "shot", "video", "film", "hi", "hey", "here",
    ];
    let mut words = words.split(|c: char| !c.is_alphanumeric() && c != '\'').filter(|word| !word.is_empty());
    words.any(|word| !EMPTY.contains(&word.to_lowercase().as_str()))
}
