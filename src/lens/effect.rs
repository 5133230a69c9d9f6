use std::str::FromStr;

use thiserror::Error;

/// An effect of the lens or the film stock, by its name in `--effects` and in `shot.json`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Effect {
    /// What is out of focus blurs.
    DepthOfField,
    /// The focus travels from one subject to another.
    RackFocus,
    /// What moves during the exposure smears.
    MotionBlur,
    /// Small unsteady motion of the camera.
    Handheld,
    /// Rows of the picture are taken one after another.
    RollingShutter,
    /// Straight lines bend as in a real lens.
    LensDistortion,
    /// A very wide lens that maps angles to distances.
    Fisheye,
    /// All directions in one picture.
    Panorama,
    /// An oval, stretched look.
    Anamorphic,
    /// Only a thin slanted plane is sharp.
    TiltShift,
    /// Distance fades into haze.
    Fog,
    /// Noise of film stock.
    FilmGrain,
    /// Corners are darker.
    Vignette,
    /// Light sources throw ghosts.
    LensFlare,
    /// Bright parts glow.
    Bloom,
    /// Colors part toward the corners.
    ChromaticAberration,
}

impl Effect {
    /// Every effect, in the order of the help text.
    pub const ALL: [Self; 16] = [
        Self::DepthOfField,
        Self::RackFocus,
        Self::MotionBlur,
        Self::Handheld,
        Self::RollingShutter,
        Self::LensDistortion,
        Self::Fisheye,
        Self::Panorama,
        Self::Anamorphic,
        Self::TiltShift,
        Self::Fog,
        Self::FilmGrain,
        Self::Vignette,
        Self::LensFlare,
        Self::Bloom,
        Self::ChromaticAberration,
    ];

    /// The name in commands and files.
    pub fn name(self) -> &'static str {
        match self {
            Self::DepthOfField => "depth-of-field",
            Self::RackFocus => "rack-focus",
            Self::MotionBlur => "motion-blur",
            Self::Handheld => "handheld",
            Self::RollingShutter => "rolling-shutter",
            Self::LensDistortion => "lens-distortion",
            Self::Fisheye => "fisheye",
            Self::Panorama => "panorama",
            Self::Anamorphic => "anamorphic",
            Self::TiltShift => "tilt-shift",
            Self::Fog => "fog",
            Self::FilmGrain => "film-grain",
            Self::Vignette => "vignette",
            Self::LensFlare => "lens-flare",
            Self::Bloom => "bloom",
            Self::ChromaticAberration => "chromatic-aberration",
        }
    }

    /// The effect of that name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|effect| effect.name() == name)
    }
}

/// Which effects a person wants.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum EffectChoice {
    /// Those that the words call for.
    #[default]
    Auto,
    /// None, whatever the words say.
    Off,
    /// These and no others.
    These(Vec<Effect>),
}

/// A name in `--effects` that is no effect.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("no effect is named {found:?}, expected auto, off, or a list of: {}", Effect::ALL.map(Effect::name).join(" "))]
pub struct UnknownEffect {
    /// The name.
    pub found: String,
}

impl FromStr for EffectChoice {
    type Err = UnknownEffect;

    /// `auto`, `off`, or names with commas between them.
    fn from_str(text: &str) -> Result<Self, UnknownEffect> {
        match text.trim() {
            "auto" => Ok(Self::Auto),
            "off" => Ok(Self::Off),
            names => {
                let named = |name: &str| Effect::from_name(name).ok_or(UnknownEffect { found: name.to_owned() });
                names.split(',').map(|name| named(name.trim())).collect::<Result<_, _>>().map(Self::These)
            }
        }
    }
}
