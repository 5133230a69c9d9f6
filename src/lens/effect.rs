//! The effects, and the choice among them.

use std::str::FromStr;

use thiserror::Error;

/// An effect of the lens or the film stock. Its name is the same in `--effects` and in `shot.json`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[derive(strum::AsRefStr, strum::Display, strum::EnumString, strum::IntoStaticStr)]
#[derive(strum::VariantArray, strum::VariantNames)]
#[strum(serialize_all = "kebab-case")]
pub enum Effect {
    /// Blur outside the focus distance.
    DepthOfField,
    /// The focus distance moves from one subject to another.
    RackFocus,
    /// Blur of motion during the exposure.
    MotionBlur,
    /// Small, unsteady motion of the camera.
    Handheld,
    /// The rows of a picture are exposed one after another.
    RollingShutter,
    /// Radial distortion of a lens.
    LensDistortion,
    /// A very wide lens that maps angles to distances in the picture.
    Fisheye,
    /// All directions in one picture.
    Panorama,
    /// Horizontally squeezed optics: oval bokeh, streaked flares.
    Anamorphic,
    /// A tilted focal plane.
    TiltShift,
    /// Haze that grows with the distance.
    Fog,
    /// Noise of film stock.
    FilmGrain,
    /// Darker corners.
    Vignette,
    /// Ghosts of light sources.
    LensFlare,
    /// Glow around bright areas.
    Bloom,
    /// Color fringes toward the corners.
    ChromaticAberration,
}

/// The effects that the user allows.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum EffectChoice {
    /// The effects that the prompt requests.
    #[default]
    Auto,
    /// No effects, even if the prompt requests some.
    Off,
    /// Exactly these effects. The requests of the prompt are ignored.
    These(Vec<Effect>),
}

/// A name in `--effects` that is not an effect.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("no effect is named {found:?}, expected auto, off, or a list of: {}", <Effect as strum::VariantNames>::VARIANTS.join(" "))]
pub struct UnknownEffect {
    /// The name.
    pub found: String,
}

impl FromStr for EffectChoice {
    type Err = UnknownEffect;

    /// Parses `auto`, `off`, or a comma-separated list of names.
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
