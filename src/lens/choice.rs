//! The effects that the user allows.

use std::str::FromStr;

use thiserror::Error;

use super::kinds;

/// The effects that the user allows.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum EffectChoice {
    /// The effects that the shot calls for.
    #[default]
    Auto,
    /// No effects, even if the shot calls for some.
    Off,
    /// Exactly these effects, by name. A call for one of them gives its settings, all other calls are ignored.
    These(Vec<String>),
}

/// A name in `--effects` that is not an effect.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("no effect is named {found:?}, expected auto, off, or a list of: {}", kinds::names().collect::<Vec<_>>().join(" "))]
pub struct UnknownEffect {
    /// The name.
    pub found: String,
}

impl EffectChoice {
    /// The names of a list; none for `auto` and `off`.
    pub fn listed(&self) -> &[String] {
        match self {
            Self::These(names) => names,
            Self::Auto | Self::Off => &[],
        }
    }
}

impl FromStr for EffectChoice {
    type Err = UnknownEffect;

    /// Parses `auto`, `off`, or a comma-separated list of names.
    fn from_str(text: &str) -> Result<Self, UnknownEffect> {
        let known = |name: &str| {
            let is_known = kinds::is_known(name);
            if is_known { Ok(name.to_owned()) } else { Err(UnknownEffect { found: name.to_owned() }) }
        };
        match text.trim() {
            "auto" => Ok(Self::Auto),
            "off" => Ok(Self::Off),
            names => names.split(',').map(|name| known(name.trim())).collect::<Result<_, _>>().map(Self::These),
        }
    }
}
