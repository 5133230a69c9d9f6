//! What a sentence asks for, as data: the language between the director, the dataset and the solver.

use cinesplat_trajectory::{Easing, Move, ShotAngle, ShotSize};

/// A whole request: steps one after the other.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Program {
    /// The steps in order; at least one.
    pub steps: Vec<Step>,
    /// Length of the whole film where the words give it.
    pub duration_secs: Option<f64>,
    /// What the words ask for that nobody here can do, in their own words: `(words, why)`.
    pub unmet: Vec<(String, String)>,
}

impl Program {
    /// Ids of all objects that the steps are about or pass, each once, in order of id.
    pub fn object_ids(&self) -> Vec<u32> {
        let passed = |step: &Step| step.via.iter().flat_map(|via| via.objects.clone()).collect::<Vec<u32>>();
        let named = |step: &Step| [&step.start.subjects[..], &step.end.subjects[..], &passed(step)[..]].concat();
        let mut ids: Vec<u32> = self.steps.iter().flat_map(named).collect();
        ids.sort_unstable();
        ids.dedup();
        ids
    }
}

/// One stretch of the film: from a framing, by a move, to a framing.
#[derive(Debug, Clone, PartialEq)]
pub struct Step {
    /// What the camera does.
    pub movement: Move,
    /// A second move at the same time: `orbit while rising`, `a handheld push-in`; with [`Move::WhipPan`] and
    /// [`Move::Reveal`] the way it goes (`whip-pan` with `pan-left`, `reveal` with `pedestal-up`).
    pub with: Option<Move>,
    /// The words leave the direction open (`swing over to`, `drift around`): left or right, in or out may be swapped.
    pub either_way: bool,
    /// How the step begins. Empty (default) = as the step before ends, or as the move needs it.
    pub start: Framing,
    /// How the step ends. Empty (default) = as the move makes it.
    pub end: Framing,
    /// Objects that the camera passes on the way.
    pub via: Option<Via>,
    /// How far, where the words say it.
    pub amount: Option<Amount>,
    /// How long, where the words say it of this step.
    pub duration_secs: Option<f64>,
    /// How fast.
    pub speed: Speed,
    /// How the speed changes, where the words say it.
    pub easing: Option<Easing>,
    /// The step begins with a cut from the one before.
    pub cut: bool,
    /// The step ends where the whole shot began.
    pub returns: bool,
    /// Byte range of the prompt.
    pub words: Option<[usize; 2]>,
}

impl Step {
    /// A step of one move with everything else left open.
    pub fn of(movement: Move) -> Self {
        Self {
            movement,
            with: None,
            either_way: false,
            start: Framing::default(),
            end: Framing::default(),
            via: None,
            amount: None,
            duration_secs: None,
            speed: Speed::Normal,
            easing: None,
            cut: false,
            returns: false,
            words: None,
        }
    }
}

/// What the picture shows at one end of a step.
///
/// All empty = not said. No subjects but a size = the room: `end wide on the room` is `long` with no subjects.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Framing {
    /// Object ids, the one to be centered first. With several and `whole`, their common middle is centered.
    pub subjects: Vec<u32>,
    /// How large the first subject is.
    pub size: Option<ShotSize>,
    /// From how high it is seen.
    pub angle: Option<ShotAngle>,
    /// Which part of the subject the camera aims at.
    pub part: SubjectPart,
    /// All subjects have to be wholly in the frame.
    pub whole: bool,
}

/// Part of an object, for `from its base to its top`.
#[derive(
    Debug,
    Clone,
    Copy,
    PartialEq,
    Eq,
    Hash,
    Default,
    strum::AsRefStr,
    strum::Display,
    strum::EnumString,
    strum::IntoStaticStr,
    strum::VariantArray,
    strum::VariantNames,
)]
#[strum(serialize_all = "kebab-case")]
pub enum SubjectPart {
    /// All of it: its middle.
    #[default]
    Middle,
    /// Its upper end.
    Top,
    /// Its lower end.
    Bottom,
    /// Its left end as the camera sees it.
    Left,
    /// Its right end as the camera sees it.
    Right,
}

/// Objects on the way of a step.
#[derive(Debug, Clone, PartialEq)]
pub struct Via {
    /// How the camera passes them.
    pub how: Pass,
    /// Object ids: one for `Past` and `Over` (or more, in turn), two for `Between`; `Between` with one = through it.
    pub objects: Vec<u32>,
}

/// How a camera passes an object.
#[derive(
    Debug,
    Clone,
    Copy,
    PartialEq,
    Eq,
    Hash,
    strum::AsRefStr,
    strum::Display,
    strum::EnumString,
    strum::IntoStaticStr,
    strum::VariantArray,
    strum::VariantNames,
)]
#[strum(serialize_all = "kebab-case")]
pub enum Pass {
    /// Beside it, seeing it on the way.
    Past,
    /// Between two objects.
    Between,
    /// Above it.
    Over,
}

/// How far a step goes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Amount {
    /// An angle in degrees: orbits, arcs, pans, tilts, rolls.
    Degrees(f64),
    /// A length in scene units (`2 meters`).
    Units(f64),
    /// A factor on the distance or the focal length (`twice as close` = 0.5 of the distance).
    Factor(f64),
    /// A little, as in `slightly`.
    Slight,
    /// A lot, as in `all the way`.
    Large,
}

/// How fast a step is.
#[derive(
    Debug,
    Clone,
    Copy,
    PartialEq,
    Eq,
    Hash,
    Default,
    strum::AsRefStr,
    strum::Display,
    strum::EnumString,
    strum::IntoStaticStr,
    strum::VariantArray,
    strum::VariantNames,
)]
#[strum(serialize_all = "kebab-case")]
pub enum Speed {
    /// Slowly, gently.
    Slow,
    /// Nothing said.
    #[default]
    Normal,
    /// Fast, quickly.
    Fast,
}
