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
    /// Motions that the prompt forbids for the whole film, each once, in the order of [`Motion`].
    pub forbidden: Vec<Motion>,
    /// Limits that the prompt sets for the whole film, in the order of [`Limit`]'s kinds.
    pub limits: Vec<Limit>,
}

/// A limit for the camera of a whole film. Heights are above the bottom of the scene's core box, distances to the nearest
/// matter of a thing, both in scene units; what is measured may miss them by 0.2 % of the scene size, and a speed by 2 %.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Limit {
    /// The camera is never lower.
    Above(Level),
    /// The camera is never higher.
    Below(Level),
    /// The camera is never nearer to the object, or to any matter.
    Clear(Option<u32>, f64),
    /// The camera is never farther from the object.
    Within(u32, f64),
    /// It never travels faster, scene units a second. The film takes the time that this needs.
    Speed(f64),
    /// It never turns faster, degrees a second.
    TurnSpeed(f64),
}

/// A height that limits another one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Level {
    /// Scene units above the bottom of the scene's core box.
    Units(f64),
    /// That of an object's upper end; of its lower end where it hangs and the camera stays below it.
    Object(u32),
}

impl Limit {
    /// The object that the limit names.
    pub fn object(&self) -> Option<u32> {
        match *self {
            Self::Above(Level::Object(id)) | Self::Below(Level::Object(id)) | Self::Within(id, _) => Some(id),
            Self::Clear(id, _) => id,
            _ => None,
        }
    }

    /// Place of its kind in a program and in the notation.
    pub fn rank(&self) -> u8 {
        match self {
            Self::Above(_) => 0,
            Self::Below(_) => 1,
            Self::Clear(..) => 2,
            Self::Within(..) => 3,
            Self::Speed(_) => 4,
            Self::TurnSpeed(_) => 5,
        }
    }

    /// Whether it limits a speed, which no single camera has.
    pub fn is_speed(&self) -> bool {
        matches!(self, Self::Speed(_) | Self::TurnSpeed(_))
    }

    /// The same limit for another object.
    #[must_use]
    pub fn with_object(self, id: u32) -> Self {
        match self {
            Self::Above(Level::Object(_)) => Self::Above(Level::Object(id)),
            Self::Below(Level::Object(_)) => Self::Below(Level::Object(id)),
            Self::Clear(Some(_), units) => Self::Clear(Some(id), units),
            Self::Within(_, units) => Self::Within(id, units),
            other => other,
        }
    }
}

/// A kind of motion that a prompt can forbid.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[derive(strum::AsRefStr, strum::Display, strum::EnumString, strum::IntoStaticStr)]
#[derive(strum::VariantArray, strum::VariantNames)]
#[strum(serialize_all = "kebab-case")]
pub enum Motion {
    /// A change of the lens: the tangent of half the field of view stays constant within 0.5 % between two cuts.
    Zoom,
    /// A turn to the left or right: the yaw stays constant within 0.5 degrees between two cuts, in an orbit too.
    Pan,
    /// A turn up or down: the pitch stays constant within 0.5 degrees.
    Tilt,
    /// A turn about the view axis: the roll stays constant within 0.5 degrees, and with it a level horizon.
    Roll,
    /// Any turn: yaw, pitch and roll stay constant.
    Turn,
    /// Any change of the position beyond 0.1 % of the scene size.
    Travel,
    /// Hand-held shake: a handheld step, or one with a handheld camera.
    Shake,
    /// A cut.
    Cut,
    /// A rise or a descent: the height stays constant within 0.1 % of the scene size between two cuts.
    Rise,
}

impl Motion {
    /// The motion that a prompt rules out when it rules out a move.
    pub fn of(movement: Move) -> Option<Self> {
        match movement {
            Move::ZoomIn | Move::ZoomOut | Move::DollyZoomIn | Move::DollyZoomOut => Some(Self::Zoom),
            Move::PanLeft | Move::PanRight | Move::WhipPan => Some(Self::Pan),
            Move::TiltUp | Move::TiltDown => Some(Self::Tilt),
            Move::RollCw | Move::RollCcw => Some(Self::Roll),
            Move::CraneUp | Move::CraneDown | Move::PedestalUp | Move::PedestalDown => Some(Self::Rise),
            Move::Handheld => Some(Self::Shake),
            _ => None,
        }
    }
}

impl Program {
    /// Forbids a motion, once and in its place among the others.
    pub fn forbid(&mut self, motion: Motion) {
        if !self.forbidden.contains(&motion) {
            self.forbidden.push(motion);
            self.forbidden.sort_unstable();
        }
    }

    /// The program with every list of object ids replaced by `map` of it.
    #[must_use]
    pub fn with_ids(mut self, map: &dyn Fn(&[u32]) -> Vec<u32>) -> Self {
        for step in &mut self.steps {
            let Step { start, end, via, look, keep, avoid, .. } = step;
            let passed = via.as_mut().map(|via| &mut via.objects);
            let looked_at = match look {
                Some(Look::At(ids)) => Some(ids),
                _ => None,
            };
            let framings = [start, end].map(|Framing { subjects, backdrop, .. }| [Some(subjects), Some(backdrop)]);
            let lists = framings.into_iter().flatten().chain([passed, looked_at, Some(keep), Some(avoid)]);
            for ids in lists.flatten() {
                *ids = map(ids);
            }
        }
        let mapped = |limit: &Limit| match limit.object() {
            Some(id) => map(&[id]).into_iter().map(|id| limit.with_object(id)).collect(),
            None => vec![*limit],
        };
        self.limits = self.limits.iter().flat_map(mapped).collect();
        self
    }

    /// Ids of all objects that the steps frame or pass, or that a limit names, each once, ascending.
    pub fn object_ids(&self) -> Vec<u32> {
        let named = |step: &Step| [step.about(), step.avoid.clone()].concat();
        let limited = self.limits.iter().filter_map(Limit::object);
        let mut ids: Vec<u32> = self.steps.iter().flat_map(named).chain(limited).collect();
        ids.sort_unstable();
        ids.dedup();
        ids
    }
}

/// Most moves at the same time as the main one.
pub const MAX_SECOND_MOVES: usize = 2;

/// One step of a program: a move from a framing to a framing.
#[derive(Debug, Clone, PartialEq)]
pub struct Step {
    /// The move.
    pub movement: Move,
    /// Further moves at the same time, at most [`MAX_SECOND_MOVES`], as in `orbit while rising` or `a handheld push-in`.
    /// For [`Move::WhipPan`] and [`Move::Reveal`] the first gives their direction: `whip-pan` with `pan-left`, `reveal`
    /// with `pedestal-up`.
    pub with: Vec<Move>,
    /// The prompt leaves the direction open (`swing over to`, `drift around`): left and right, or in and out, may be
    /// swapped.
    pub either_way: bool,
    /// Framing at the start. Empty (default): the end framing of the step before, or one that the move requires.
    pub start: Framing,
    /// Framing at the end. Empty (default): the one that the move leads to.
    pub end: Framing,
    /// Objects that the camera passes.
    pub via: Option<Via>,
    /// What the camera looks at while it travels elsewhere. The path of the move stays; constraints of the move on what
    /// its pictures show give way.
    pub look: Option<Look>,
    /// Ids of objects besides the subjects that stay in view all the time: at least half of each in every frame, and half
    /// of that visible in 85 % of the frames.
    pub keep: Vec<u32>,
    /// Ids of objects that are never in view: at most 5 % of each is in the frame and visible.
    pub avoid: Vec<u32>,
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
    /// Ids of all things that the step ends on, starts from, passes, looks at or keeps in view, ascending.
    pub fn about(&self) -> Vec<u32> {
        let looked = match &self.look {
            Some(Look::At(ids)) => &ids[..],
            _ => &[],
        };
        let passed = self.via.as_ref().map_or(&[][..], |via| &via.objects);
        let ends = [&self.start, &self.end].map(|end| [&end.subjects[..], &end.backdrop[..]].concat()).concat();
        let mut ids = [&ends[..], passed, looked, &self.keep].concat();
        ids.sort_unstable();
        ids.dedup();
        ids
    }

    /// The words of this step and of another one, from the first to the last.
    pub fn joint_words(&self, other: &Self) -> Option<[usize; 2]> {
        match (self.words, other.words) {
            (Some([start, end]), Some([other_start, other_end])) => Some([start.min(other_start), end.max(other_end)]),
            (words, other) => words.or(other),
        }
    }

    /// A turn over the place, in either direction.
    pub fn look_around() -> Self {
        Self { either_way: true, ..Self::of(Move::PanRight) }
    }

    /// A step of one move, with everything else unspecified.
    pub fn of(movement: Move) -> Self {
        Self {
            movement,
            with: Vec::new(),
            either_way: false,
            start: Framing::default(),
            end: Framing::default(),
            via: None,
            look: None,
            keep: Vec::new(),
            avoid: Vec::new(),
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
    /// Height of the projected box of the first subject over the height of the frame, as in `fills half the frame`; met
    /// within 15 % of itself.
    pub height_frac: Option<f64>,
    /// Angle above the horizontal from which the camera sees the center of the first subject, degrees; met within 6.
    pub elevation_deg: Option<f64>,
    /// Height of the camera above the bottom of the scene's core box, scene units; met within 10 % or 1 % of the scene
    /// size.
    pub height: Option<f64>,
    /// Distance from the camera to the center of the first subject's box, scene units; met within 10 %. The center, and
    /// not the nearest point of the box, because that is what a lens is focused on and what all moves measure.
    pub distance: Option<f64>,
    /// Lens.
    pub lens: Option<Lens>,
    /// Side of the first subject that the camera sees.
    pub side: Option<SubjectSide>,
    /// Place of the first subject in the frame.
    pub place: Option<FramePlace>,
    /// The subjects must not be visible: at most 10 % of each is in the frame and visible.
    pub hidden: bool,
    /// Ids of objects that are seen behind the first subject, as in `with the window behind it`: at least 40 % of each in
    /// the frame, half of that visible, its center farther away than the subject's and at most half of the frame beside it.
    pub backdrop: Vec<u32>,
}

/// A lens, as a prompt states it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Lens {
    /// A focal length on full frame (24 mm high), millimeters.
    FocalMm(f64),
    /// A vertical field of view, degrees.
    FovDeg(f64),
    /// A wide-angle lens: 16 to 28 mm on full frame.
    Wide,
    /// A long lens: 70 to 135 mm on full frame.
    Long,
}

/// Side of a subject from which the camera sees it. The front of a subject faces the middle of the scene (the best
/// viewpoint, where the subject itself is in the middle); left and right are those of somebody who sees the front. A camera
/// is on a side where its azimuth about the subject's center is within 40 degrees of the middle of that side, and between two
/// sides where it is within 35 degrees of 45 degrees from both.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[derive(strum::AsRefStr, strum::Display, strum::EnumString, strum::IntoStaticStr)]
#[derive(strum::VariantArray, strum::VariantNames)]
#[strum(serialize_all = "kebab-case")]
pub enum SubjectSide {
    /// From its front.
    FromFront,
    /// From behind it.
    FromBack,
    /// From its left.
    FromLeft,
    /// From its right.
    FromRight,
    /// In profile, from its left or right.
    FromSide,
    /// A three-quarter view: from half way between its front and a side.
    FromFrontQuarter,
    /// From half way between its back and a side.
    FromBackQuarter,
}

impl SubjectSide {
    /// The sides that the network reads; the others are read from the words.
    pub const READ: [Self; 5] = [Self::FromFront, Self::FromBack, Self::FromLeft, Self::FromRight, Self::FromSide];
}

/// Place in the frame of the point that the camera aims at: the subject's center, unless a part of it is named. Thirds are
/// a sixth of the frame's width or height from its middle; met within 4 % of the frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[derive(strum::AsRefStr, strum::Display, strum::EnumString, strum::IntoStaticStr)]
#[derive(strum::VariantArray, strum::VariantNames)]
#[strum(serialize_all = "kebab-case")]
pub enum FramePlace {
    /// Left third.
    AtLeft,
    /// Right third.
    AtRight,
    /// Upper third.
    AtUpper,
    /// Lower third.
    AtLower,
    /// Upper left.
    AtUpperLeft,
    /// Upper right.
    AtUpperRight,
    /// Lower left.
    AtLowerLeft,
    /// Lower right.
    AtLowerRight,
    /// The middle.
    AtCenter,
}

/// What the camera looks at while it travels elsewhere.
#[derive(Debug, Clone, PartialEq)]
pub enum Look {
    /// Objects, by id: the first one's center, or the common middle of several, is in the middle of every frame.
    At(Vec<u32>),
    /// The direction of travel. Where the step has an end target, the camera turns to it on the last 30 % of the path.
    /// On a path straight up or down this is no look of its own.
    Ahead,
    /// Against the direction of travel.
    Back,
    /// The middle of the scene.
    Room,
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
    /// Object ids: two for `Between`, one or more for the others. `Between` with one id means through that object.
    pub objects: Vec<u32>,
}

/// How a camera passes an object.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[derive(strum::AsRefStr, strum::Display, strum::EnumString, strum::IntoStaticStr)]
#[derive(strum::VariantArray, strum::VariantNames)]
#[strum(serialize_all = "kebab-case")]
pub enum Pass {
    /// Beside it, with it in view. A way to something else (`Follow`, `FlyThrough`) has it abeam at a level distance of at most 30 % of the
    /// scene size, and 40 % of it in the picture at some moment.
    Past,
    /// Between two objects.
    Between,
    /// Above it.
    Over,
    /// Below it: the path crosses the space below its box.
    Under,
    /// Through an opening of it, such as a door: the path crosses its box, along the shorter horizontal axis.
    Through,
    /// On its far side: the path comes within 60 degrees of the middle of its back ([`SubjectSide`]). A reveal starts
    /// where the object hides the subject.
    Behind,
    /// On its near side: the path comes within 60 degrees of the middle of its front.
    Front,
    /// Beside it, from one end of it to the other: along at least 80 % of its longer horizontal axis.
    Along,
    /// The camera stands at it where the step starts.
    From,
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
