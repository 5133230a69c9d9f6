use std::str::FromStr;

use thiserror::Error;

/// An effect of the lens or the film stock, by its name in `--effects` and in `shot.json`.
#[derive(
    Debug,
    Clone,
    Copy,
    PartialEq,
    Eq,
    Hash,
    PartialOrd,
    Ord,
    strum::AsRefStr,
    strum::Display,
    strum::EnumString,
    strum::IntoStaticStr,
    strum::VariantArray,
    strum::VariantNames,
)]
#[strum(serialize_all = "kebab-case")]
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
#[error("no effect is named {found:?}, expected auto, off, or a list of: {}", <Effect as strum::VariantNames>::VARIANTS.join(" "))]
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
                let named = |name: &str| name.parse::<Effect>().ok().ok_or(UnknownEffect { found: name.to_owned() });
                names.split(',').map(|name| named(name.trim())).collect::<Result<_, _>>().map(Self::These)
            }
        }
    }
}
