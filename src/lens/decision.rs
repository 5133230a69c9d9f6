//! Decisions on requested effects.

use std::fmt;

use super::effect::{Effect, EffectChoice};
use cinesplat_trajectory::{EffectRequest, ReportLine};

/// An effect, or another request that is not a camera move.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum EffectKind {
    /// An effect of the lens or the film stock.
    Known(Effect),
    /// Anything else, by its name, such as `music`.
    Other(String),
}

impl From<&str> for EffectKind {
    fn from(name: &str) -> Self {
        name.parse().map_or_else(|_| Self::Other(name.to_owned()), Self::Known)
    }
}

impl fmt::Display for EffectKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Known(effect) => effect.fmt(f),
            Self::Other(name) => name.fmt(f),
        }
    }
}

/// A request for an effect.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct EffectCall {
    /// The requested effect, or the name of the other request.
    pub kind: EffectKind,
    /// The words of the prompt, or the flag, that request it.
    pub because: String,
}

/// Reason why a requested effect is missing from the film.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// `--effects` excludes it.
    Disabled,
    /// The renderer does not implement it: the film is rendered without it.
    NotImplemented,
    /// The request is not an effect of the lens or the film stock.
    NotAnEffect,
}

/// A request and its verdict.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Decision {
    /// The request.
    pub call: EffectCall,
    /// The decision on it.
    pub verdict: Verdict,
}

/// Decides on every request of the prompt and then of `--effects`, in that order.
///
/// ```
/// use cinesplat::lens::{EffectCall, EffectChoice, Verdict, decide};
/// let call = EffectCall { kind: "depth-of-field".into(), because: "shallow focus".into() };
/// let decided = decide(&EffectChoice::Auto, std::slice::from_ref(&call));
/// assert_eq!(decided[0].verdict, Verdict::NotImplemented);
/// assert_eq!(decide(&EffectChoice::Off, &[call])[0].verdict, Verdict::Disabled);
/// ```
pub fn decide(choice: &EffectChoice, calls: &[EffectCall]) -> Vec<Decision> {
    let mut decisions: Vec<Decision> = Vec::new();
    let chosen = match choice {
        EffectChoice::These(effects) => effects.as_slice(),
        EffectChoice::Auto | EffectChoice::Off => &[],
    };
    for call in calls {
        let verdict = match (&call.kind, choice) {
            (EffectKind::Other(_), _) => Verdict::NotAnEffect,
            (EffectKind::Known(_), EffectChoice::Auto) => Verdict::NotImplemented,
            (EffectKind::Known(effect), _) if chosen.contains(effect) => Verdict::NotImplemented,
            (EffectKind::Known(_), _) => Verdict::Disabled,
        };
        decisions.push(Decision { call: call.clone(), verdict });
    }
    for &effect in chosen {
        let kind = EffectKind::Known(effect);
        if !decisions.iter().any(|decision| decision.call.kind == kind) {
            let call = EffectCall { kind, because: "--effects".to_owned() };
            decisions.push(Decision { call, verdict: Verdict::NotImplemented });
        }
    }
    decisions
}

impl Decision {
    /// The decision as one sentence.
    pub fn sentence(&self) -> String {
        let EffectCall { kind, because } = &self.call;
        let verdict = match self.verdict {
            Verdict::Disabled => "disabled by --effects",
            Verdict::NotImplemented => "not implemented, rendered without it",
            Verdict::NotAnEffect => "not an effect of the lens, rendered without it",
        };
        format!("{kind} requested by '{because}': {verdict}")
    }

    /// The effect as an entry of the shot; `None` where it is disabled or no effect.
    pub fn request(&self) -> Option<EffectRequest> {
        let EffectCall { kind, because } = &self.call;
        (self.verdict == Verdict::NotImplemented).then(|| EffectRequest {
            kind: kind.to_string(),
            because: because.clone(),
            settings: Vec::new(),
        })
    }

    /// The line of the shot's report; `None` for a disabled effect.
    pub fn report_line(&self) -> Option<ReportLine> {
        (self.verdict != Verdict::Disabled).then(|| ReportLine {
            clause: self.call.because.clone(),
            wanted: self.call.kind.to_string(),
            got: 0.0,
            met: false,
            note: self.sentence(),
        })
    }
}
