//! Metrics of a director: understood programs compared with the intended ones.

use cinesplat_operator::{Framing, Program, Step};
use strum::VariantArray;

/// Correct items out of all items.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Tally {
    /// Number of correct items.
    pub correct: usize,
    /// Number of items.
    pub total: usize,
}

impl Tally {
    /// Fraction of correct items, 0..=1; 0 without any item.
    pub fn correct_frac(self) -> f64 {
        self.correct as f64 / self.total.max(1) as f64
    }

    fn add(&mut self, is_correct: bool) {
        self.correct += usize::from(is_correct);
        self.total += 1;
    }
}

/// A field of a step, compared on its own. Its text is its name in reports.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[derive(strum::Display, strum::IntoStaticStr)]
#[derive(strum::VariantArray)]
#[strum(serialize_all = "lowercase")]
pub enum StepField {
    /// The move. If the direction is open in both steps, either direction is correct.
    Move,
    /// The second move.
    #[strum(serialize = "second move")]
    SecondMove,
    /// Whether the direction is open.
    #[strum(serialize = "either way")]
    EitherWay,
    /// Subjects at the start.
    #[strum(serialize = "start subjects")]
    StartSubjects,
    /// Subjects at the end.
    #[strum(serialize = "end subjects")]
    EndSubjects,
    /// Shot size at the start.
    #[strum(serialize = "start size")]
    StartSize,
    /// Shot size at the end.
    #[strum(serialize = "end size")]
    EndSize,
    /// Shot angles at both ends.
    Angles,
    /// Parts of the subjects at both ends.
    Parts,
    /// Whether the subjects are wholly in the frame, at both ends.
    Whole,
    /// Objects that the camera passes, and how.
    Via,
    /// The amount.
    Amount,
    /// The duration.
    Duration,
    /// The speed.
    Speed,
    /// The easing.
    Easing,
    /// Whether the step begins with a cut, and whether it returns to the start.
    #[strum(serialize = "cut, return")]
    CutAndReturn,
}

impl StepField {
    /// Whether the field is equal in two steps.
    fn is_equal(self, a: &Step, b: &Step) -> bool {
        match self {
            Self::Move => a.movement == b.movement || (a.either_way && b.either_way && are_opposite(a, b)),
            Self::SecondMove => a.with == b.with,
            Self::EitherWay => a.either_way == b.either_way,
            Self::StartSubjects => a.start.subjects == b.start.subjects,
            Self::EndSubjects => a.end.subjects == b.end.subjects,
            Self::StartSize => a.start.size == b.start.size,
            Self::EndSize => a.end.size == b.end.size,
            Self::Angles => a.start.angle == b.start.angle && a.end.angle == b.end.angle,
            Self::Parts => a.start.part == b.start.part && a.end.part == b.end.part,
            Self::Whole => a.start.whole == b.start.whole && a.end.whole == b.end.whole,
            Self::Via => a.via == b.via,
            Self::Amount => a.amount == b.amount,
            Self::Duration => a.duration_secs == b.duration_secs,
            Self::Speed => a.speed == b.speed,
            Self::Easing => a.easing == b.easing,
            Self::CutAndReturn => a.cut == b.cut && a.returns == b.returns,
        }
    }
}

/// Whether two steps have the two directions of one move.
fn are_opposite(a: &Step, b: &Step) -> bool {
    let stem = |step: &Step| <&str>::from(step.movement).rsplit_once('-').map(|(stem, _)| stem);
    stem(a).is_some() && stem(a) == stem(b)
}

/// A difference between an understood program and the intended one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[derive(strum::Display)]
pub enum Mistake {
    /// The number of steps differs.
    #[strum(serialize = "number of steps")]
    NumSteps,
    /// The length of the film differs.
    #[strum(serialize = "film length")]
    FilmLength,
    /// A field of some step differs.
    #[strum(transparent)]
    Field(StepField),
}

/// A prompt that was misunderstood.
#[derive(Debug, Clone, PartialEq)]
pub struct ErrorCase {
    /// The prompt.
    pub prompt: String,
    /// The intended program.
    pub intended: Program,
    /// The program that the director understood.
    pub understood: Program,
    /// The differences, each once.
    pub mistakes: Vec<Mistake>,
}

/// Metrics over a set of prompts.
#[derive(Debug, Clone, PartialEq)]
pub struct ProgramMetrics {
    /// Prompts whose whole program is correct.
    pub programs: Tally,
    /// Intended steps of which every field is correct. A step that the understood program lacks is wrong.
    pub steps: Tally,
    /// Per field, over the steps that both programs have at the same index.
    pub fields: Vec<(StepField, Tally)>,
    /// The misunderstood prompts.
    pub error_cases: Vec<ErrorCase>,
}

impl Default for ProgramMetrics {
    fn default() -> Self {
        Self {
            programs: Tally::default(),
            steps: Tally::default(),
            fields: StepField::VARIANTS.iter().map(|field| (*field, Tally::default())).collect(),
            error_cases: Vec::new(),
        }
    }
}

impl ProgramMetrics {
    /// Adds one prompt.
    pub(super) fn add(&mut self, prompt: String, intended: Program, understood: Program) {
        let mut mistakes = Vec::new();
        if intended.steps.len() != understood.steps.len() {
            mistakes.push(Mistake::NumSteps);
        }
        if intended.duration_secs != understood.duration_secs {
            mistakes.push(Mistake::FilmLength);
        }
        for (step_idx, step) in intended.steps.iter().enumerate() {
            let is_correct = understood.steps.get(step_idx).is_some_and(|other| {
                let wrong = self.add_step(&canonical(step), &canonical(other));
                for mistake in wrong.iter().copied().map(Mistake::Field) {
                    if !mistakes.contains(&mistake) {
                        mistakes.push(mistake);
                    }
                }
                wrong.is_empty()
            });
            self.steps.add(is_correct);
        }
        self.programs.add(mistakes.is_empty());
        if !mistakes.is_empty() {
            self.error_cases.push(ErrorCase { prompt, intended, understood, mistakes });
        }
    }

    /// Adds the fields of one step, and returns those that differ.
    fn add_step(&mut self, intended: &Step, understood: &Step) -> Vec<StepField> {
        let mut wrong = Vec::new();
        for (field, tally) in &mut self.fields {
            let is_equal = field.is_equal(intended, understood);
            tally.add(is_equal);
            if !is_equal {
                wrong.push(*field);
            }
        }
        wrong
    }
}

/// The step with sorted subjects where all of them are wholly in the frame, because their order has no meaning then.
fn canonical(step: &Step) -> Step {
    let canonical = |framing: &Framing| {
        let mut framing = framing.clone();
        if framing.whole {
            framing.subjects.sort_unstable();
        }
        framing
    };
    Step { start: canonical(&step.start), end: canonical(&step.end), ..step.clone() }
}
