//! The program: the camera moves that a prompt requests, as data. The director produces it, the dataset stores it, the
//! operator solves it.

use cinesplat_trajectory::{Easing, Move, ShotAngle, ShotSize};

/// A camera program: consecutive steps.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Program {
    /// The steps in order. An empty program means a static view of the scene.
    pub steps: Vec<Step>,
    /// Length of the film where the prompt states it.
    pub duration_secs: Option<f64>,
}

impl Program {
    /// Ids of all objects that the steps frame or pass, each once, ascending.
    pub fn object_ids(&self) -> Vec<u32> {
        let passed = |step: &Step| step.via.iter().flat_map(|via| via.objects.clone()).collect::<Vec<u32>>();
        let named = |step: &Step| [&step.start.subjects[..], &step.end.subjects[..], &passed(step)[..]].concat();
        let mut ids: Vec<u32> = self.steps.iter().flat_map(named).collect();
        ids.sort_unstable();
        ids.dedup();
        ids
    }
}

/// One step of a program: a move from a framing to a framing.
#[derive(Debug, Clone, PartialEq)]
pub struct Step {
    /// The move.
    pub movement: Move,
    /// A second move at the same time, as in `orbit while rising` or `a handheld push-in`. For [`Move::WhipPan`] and
    /// [`Move::Reveal`] it gives their direction: `whip-pan` with `pan-left`, `reveal` with `pedestal-up`.
    pub with: Option<Move>,
    /// The prompt leaves the direction open (`swing over to`, `drift around`): left and right, or in and out, may be
    /// swapped.
    pub either_way: bool,
    /// Framing at the start. Empty (default): the end framing of the step before, or one that the move requires.
    pub start: Framing,
    /// Framing at the end. Empty (default): the one that the move leads to.
    pub end: Framing,
    /// Objects that the camera passes.
    pub via: Option<Via>,
    /// Extent of the move, where the prompt states it.
    pub amount: Option<Amount>,
    /// Duration, where the prompt states it for this step.
    pub duration_secs: Option<f64>,
    /// Speed.
    pub speed: Speed,
    /// Speed profile, where the prompt states it.
    pub easing: Option<Easing>,
    /// The step begins with a cut from the one before.
    pub cut: bool,
    /// The step ends where the whole shot began.
    pub returns: bool,
    /// Byte range `[start, end]` of the prompt that the step comes from.
    pub words: Option<[usize; 2]>,
}

impl Step {
    /// A step of one move, with everything else unspecified.
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

/// The subjects in the frame at one end of a step, and how they are framed.
///
/// The default is unspecified. A size without subjects frames the room: `end wide on the room` is `long` without
/// subjects.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Framing {
    /// Object ids. The first one is centered; with several and `whole`, their common middle is.
    pub subjects: Vec<u32>,
    /// Shot size of the first subject.
    pub size: Option<ShotSize>,
    /// Height of the camera relative to it.
    pub angle: Option<ShotAngle>,
    /// Part of the first subject that the camera aims at.
    pub part: SubjectPart,
    /// All subjects must be wholly in the frame.
    pub whole: bool,
}

/// Part of a subject, as in `from its base to its top`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[derive(strum::AsRefStr, strum::Display, strum::EnumString, strum::IntoStaticStr)]
#[derive(strum::VariantArray, strum::VariantNames)]
#[strum(serialize_all = "kebab-case")]
pub enum SubjectPart {
    /// The whole subject; the camera aims at its middle.
    #[default]
    Middle,
    /// Its upper end.
    Top,
    /// Its lower end.
    Bottom,
    /// Its left end, as the camera sees it.
    Left,
    /// Its right end, as the camera sees it.
    Right,
}

/// Objects that a step passes.
#[derive(Debug, Clone, PartialEq)]
pub struct Via {
    /// How the camera passes them.
    pub how: Pass,
    /// Object ids: one or more for `Past` and `Over`, two for `Between`. `Between` with one id means through that
    /// object.
    pub objects: Vec<u32>,
}

/// How a camera passes an object.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[derive(strum::AsRefStr, strum::Display, strum::EnumString, strum::IntoStaticStr)]
#[derive(strum::VariantArray, strum::VariantNames)]
#[strum(serialize_all = "kebab-case")]
pub enum Pass {
    /// Beside it, with it in view.
    Past,
    /// Between two objects.
    Between,
    /// Above it.
    Over,
}

/// Extent of a move.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Amount {
    /// An angle in degrees, for orbits, arcs, pans, tilts and rolls.
    Degrees(f64),
    /// A length in scene units, as in `2 meters`.
    Units(f64),
    /// A factor on the distance or the focal length: `twice as close` is 0.5 of the distance.
    Factor(f64),
    /// Small, as in `slightly`.
    Slight,
    /// Large, as in `all the way`.
    Large,
}

/// Speed of a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[derive(strum::AsRefStr, strum::Display, strum::EnumString, strum::IntoStaticStr)]
#[derive(strum::VariantArray, strum::VariantNames)]
#[strum(serialize_all = "kebab-case")]
pub enum Speed {
    /// Slowly, gently.
    Slow,
    /// Unspecified.
    #[default]
    Normal,
    /// Fast, quickly.
    Fast,
}
