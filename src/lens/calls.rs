//! What calls for effects.

use cinesplat_trajectory::{EffectRequest, Keyframe, Move};

/// How much of an effect the words ask for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Degree {
    /// `a bit of`, `subtle`.
    Slight,
    /// No word about it.
    #[default]
    Medium,
    /// `heavy`, `a lot of`.
    Strong,
}

impl Degree {
    /// The value for this degree, of those for slight, medium and strong.
    pub fn of(self, [slight, medium, strong]: [f64; 3]) -> f64 {
        match self {
            Self::Slight => slight,
            Self::Medium => medium,
            Self::Strong => strong,
        }
    }
}

/// Where a call comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Source {
    /// Words of the prompt.
    Words,
    /// The list of `--effects`.
    Choice,
    /// The `effects` of a shot's file.
    File,
}

/// A call for one effect by name.
#[derive(Debug, Clone, PartialEq)]
pub struct Call {
    /// Name of the effect, or of something that is none, such as `music`.
    pub name: String,
    /// The words of the prompt, the flag, or the reason in the shot's file.
    pub because: String,
    /// Where it comes from.
    pub source: Source,
    /// How much of the effect.
    pub degree: Degree,
    /// Settings that the call states.
    pub settings: Vec<(String, f64)>,
}

impl Call {
    /// A call of medium degree without settings.
    pub fn new(name: &str, because: &str, source: Source) -> Self {
        let (name, because) = (name.to_owned(), because.to_owned());
        Self { name, because, source, degree: Degree::Medium, settings: Vec::new() }
    }

    /// The call of an effect in a shot's file.
    pub fn of_request(request: &EffectRequest) -> Self {
        Self { settings: request.settings.clone(), ..Self::new(&request.kind, &request.because, Source::File) }
    }

    /// The value of a setting that the call states; only a finite number counts.
    pub fn setting(&self, name: &str) -> Option<f64> {
        self.settings.iter().find(|(known, value)| known == name && value.is_finite()).map(|(_, value)| *value)
    }

    /// The value of a setting, or the one that suits the degree of the words.
    pub fn setting_or(&self, name: &str, by_degree: [f64; 3]) -> f64 {
        self.setting(name).unwrap_or_else(|| self.degree.of(by_degree))
    }
}

/// All that a shot says about effects.
#[derive(Debug, Clone, Copy)]
pub struct Calls<'a> {
    /// Calls by name, in order.
    pub calls: &'a [Call],
    /// Effects that the words forbid, by name, with the words.
    pub forbidden: &'a [(String, String)],
    /// The moves of the program, with those that are carried out at the same time.
    pub moves: &'a [Move],
    /// The keyframes; empty before the shot is solved.
    pub keyframes: &'a [Keyframe],
    /// Size of the scene, scene units: the scale of whatever has none of its own.
    pub scene_size: f64,
    /// Seed of the shot.
    pub seed: u64,
}

impl<'a> Calls<'a> {
    /// The first call with a name.
    pub fn named(&self, name: &str) -> Option<&'a Call> {
        self.calls.iter().find(|call| call.name == name)
    }

    /// A call that a move makes; `None` if the program lacks the move.
    pub fn of_move(&self, name: &str, movement: Move) -> Option<Call> {
        self.moves.contains(&movement).then(|| Call::new(name, &format!("the move {movement}"), Source::Words))
    }

    /// A call that a field of a keyframe makes; `None` if `has_field` holds for no keyframe.
    pub fn of_keyframes(&self, name: &str, field: &str, has_field: impl Fn(&Keyframe) -> bool) -> Option<Call> {
        let at = self.keyframes.iter().position(has_field)?;
        Some(Call::new(name, &format!("{field} of keyframe {at}"), Source::File))
    }

    /// The words that forbid an effect.
    pub fn forbids(&self, name: &str) -> Option<&'a str> {
        self.forbidden.iter().find(|(forbidden, _)| forbidden == name).map(|(_, words)| words.as_str())
    }
}
