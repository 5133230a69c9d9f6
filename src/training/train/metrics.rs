//! Metrics of a director: understood programs compared with the intended ones.

use cinesplat_operator::{Amount, FramePlace, Program, Step};
use cinesplat_trajectory::{Move, ShotSize};
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

    /// Adds the items of another tally.
    pub(super) fn extend(&mut self, other: Self) {
        self.correct += other.correct;
        self.total += other.total;
    }

    pub(crate) fn add(&mut self, is_correct: bool) {
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
    /// What the camera looks at while it travels elsewhere.
    Look,
    /// Objects that stay in view, and objects that are never in view.
    #[strum(serialize = "keep, avoid")]
    KeepAndAvoid,
    /// Sides, places in the frame and visibility of the subjects at both ends.
    #[strum(serialize = "sides, places")]
    Places,
    /// Lenses at both ends.
    Lenses,
    /// Heights, distances, elevations and shares of the frame at both ends.
    Measures,
    /// Whether the step begins with a cut, and whether it returns to the start.
    #[strum(serialize = "cut, return")]
    CutAndReturn,
}

impl StepField {
    /// Whether the field is equal in two steps.
    fn is_equal(self, a: &Step, b: &Step) -> bool {
        let ends = [(&a.start, &b.start), (&a.end, &b.end)];
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
            Self::Amount => match (a.amount, b.amount) {
                (Some(Amount::Degrees(a)), Some(Amount::Degrees(b)))
                | (Some(Amount::Units(a)), Some(Amount::Units(b)))
                | (Some(Amount::Factor(a)), Some(Amount::Factor(b))) => are_close(Some(a), Some(b)),
                (a, b) => a == b,
            },
            Self::Duration => are_close(a.duration_secs, b.duration_secs),
            Self::Look => a.look == b.look,
            Self::KeepAndAvoid => a.keep == b.keep && a.avoid == b.avoid,
            Self::Places => ends.iter().all(|(a, b)| (a.side, a.place, a.hidden) == (b.side, b.place, b.hidden)),
            Self::Lenses => ends.iter().all(|(a, b)| a.lens == b.lens),
            Self::Measures => ends.iter().all(|(a, b)| {
                are_close(a.height_frac, b.height_frac)
                    && are_close(a.elevation_deg.map(f64::abs), b.elevation_deg.map(f64::abs))
                    && are_close(a.height, b.height)
                    && are_close(a.distance, b.distance)
            }),
            Self::Speed => a.speed == b.speed,
            Self::Easing => a.easing == b.easing,
            Self::CutAndReturn => a.cut == b.cut && a.returns == b.returns,
        }
    }
}

/// Whether two values differ by at most 2 %, or both are missing.
fn are_close(a: Option<f64>, b: Option<f64>) -> bool {
    match (a, b) {
        (Some(a), Some(b)) => (a - b).abs() <= 0.02 * a.abs().max(b.abs()),
        (a, b) => a.is_none() && b.is_none(),
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
    /// The forbidden motions differ.
    #[strum(serialize = "forbidden motions")]
    Forbidden,
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
    /// Adds the prompts of other metrics.
    pub(super) fn extend(&mut self, other: Self) {
        self.programs.extend(other.programs);
        self.steps.extend(other.steps);
        self.fields.iter_mut().zip(other.fields).for_each(|((_, own), (_, tally))| own.extend(tally));
        self.error_cases.extend(other.error_cases);
    }

    /// Adds one prompt with the programs that its readers have given it.
    pub(super) fn add(&mut self, prompt: String, readings: &[Program], understood: Program) {
        // Of several readings the one counts that the understood program equals, else the first.
        let is_equal = |reading: &&Program| canonical(reading) == canonical(&understood);
        let Some(intended) = readings.iter().find(is_equal).or(readings.first()).cloned() else { return };
        let mut mistakes = Vec::new();
        let (meant, found) = (canonical(&intended), canonical(&understood));
        if meant.forbidden != found.forbidden {
            mistakes.push(Mistake::Forbidden);
        }
        if intended.steps.len() != understood.steps.len() {
            mistakes.push(Mistake::NumSteps);
        }
        if !are_close(meant.duration_secs, found.duration_secs) {
            mistakes.push(Mistake::FilmLength);
        }
        for (step_idx, step) in meant.steps.iter().enumerate() {
            let is_correct = found.steps.get(step_idx).is_some_and(|other| {
                let wrong = self.add_step(step, other);
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

/// Whether two programs differ only in what has no meaning.
pub(super) fn are_equal(a: &Program, b: &Program) -> bool {
    canonical(a) == canonical(b)
}

/// For each understood step, whether it equals the intended one at the same index, in the best of several readings.
pub(super) fn right_steps(readings: &[Program], understood: &Program) -> Vec<bool> {
    let right = readings.iter().map(|reading| equal_steps(reading, understood));
    right.max_by_key(|right| right.iter().filter(|is_right| **is_right).count()).unwrap_or_default()
}

fn equal_steps(intended: &Program, understood: &Program) -> Vec<bool> {
    let (intended, understood) = (canonical(intended), canonical(understood));
    let is_right = |(step_idx, step): (usize, &Step)| {
        let meant = intended.steps.get(step_idx);
        meant.is_some_and(|meant| StepField::VARIANTS.iter().all(|field| field.is_equal(meant, step)))
    };
    understood.steps.iter().enumerate().map(is_right).collect()
}

/// The program without the differences that have no meaning: the order of subjects that are wholly in the frame, of
/// further moves and of passed objects; subjects that a step repeats from the step before; an open direction of a move
/// that has none; whether the length of the only step is that of the step or of the film. And without those between two
/// ways to say one thing, in which readers differ: an orbit and an arc; a rise with and without the aim on the subject as a
/// further move; a subject in the middle of the frame, where it stands anyway; the whole room and a long shot of it.
fn canonical(program: &Program) -> Program {
    let mut program = program.clone();
    if let [step] = &mut program.steps[..]
        && program.duration_secs.is_none()
    {
        program.duration_secs = step.duration_secs.take();
    }
    let mut current: Vec<u32> = Vec::new();
    for step in &mut program.steps {
        step.movement = plain(step.movement);
        step.with.iter_mut().for_each(|movement| *movement = level(*movement));
        step.with.sort_by_key(|movement| *movement as usize);
        step.either_way &= step.movement.opposite().is_some();
        if let Some(via) = &mut step.via {
            via.objects.sort_unstable();
        }
        let before = current.clone();
        for framing in [&mut step.start, &mut step.end] {
            framing.place = framing.place.filter(|place| *place != FramePlace::AtCenter);
            if framing.subjects.is_empty() && framing.whole {
                framing.whole = false;
                framing.size = framing.size.or(Some(ShotSize::Long));
            }
            if framing.whole || framing.subjects.len() > 1 {
                framing.subjects.sort_unstable();
            }
            if !framing.subjects.is_empty() {
                current.clone_from(&framing.subjects);
            }
        }
        if !before.is_empty() && step.start.subjects == before {
            step.start.subjects.clear();
        }
        if !before.is_empty() && step.end.subjects == before {
            step.end.subjects.clear();
        }
    }
    program
}

/// An arc as the orbit that it is a part of.
fn plain(movement: Move) -> Move {
    match movement {
        Move::ArcLeft => Move::OrbitLeft,
        Move::ArcRight => Move::OrbitRight,
        other => other,
    }
}

/// A crane as a pedestal.
fn level(movement: Move) -> Move {
    match plain(movement) {
        Move::CraneUp => Move::PedestalUp,
        Move::CraneDown => Move::PedestalDown,
        other => other,
    }
}
