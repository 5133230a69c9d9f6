use super::{Effect, EffectChoice};
use cinesplat_trajectory::{EffectRequest, ReportLine};

/// Something beside the camera's path that is called for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Call {
    /// Name of the effect, or of a thing that no camera can do (`music`).
    pub kind: String,
    /// Whose words call for it.
    pub because: String,
}

/// What becomes of a call.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// `--effects` leaves it out.
    LeftOut,
    /// An effect of the lens that this program does not have yet: the picture is without it.
    NotBuilt,
    /// Nothing that a camera can do.
    NotOfTheLens,
}

/// A call and what becomes of it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Decision {
    /// The call.
    pub call: Call,
    /// What becomes of it.
    pub outcome: Outcome,
}

/// Decides on every call of the words and of `--effects`, in that order, one decision a kind.
///
/// ```
/// use cinesplat::lens::{Call, EffectChoice, Outcome, decide};
/// let call = Call { kind: "depth-of-field".into(), because: "shallow focus".into() };
/// let decided = decide(&EffectChoice::Auto, std::slice::from_ref(&call));
/// assert_eq!(decided[0].outcome, Outcome::NotBuilt);
/// assert_eq!(decide(&EffectChoice::Off, &[call])[0].outcome, Outcome::LeftOut);
/// ```
pub fn decide(choice: &EffectChoice, calls: &[Call]) -> Vec<Decision> {
    let mut decisions: Vec<Decision> = Vec::new();
    let chosen = match choice {
        EffectChoice::These(effects) => effects.as_slice(),
        EffectChoice::Auto | EffectChoice::Off => &[],
    };
    for call in calls {
        let outcome = match (call.kind.parse::<Effect>().ok(), choice) {
            (None, _) => Outcome::NotOfTheLens,
            (Some(_), EffectChoice::Auto) => Outcome::NotBuilt,
            (Some(effect), _) if chosen.contains(&effect) => Outcome::NotBuilt,
            (Some(_), _) => Outcome::LeftOut,
        };
        decisions.push(Decision { call: call.clone(), outcome });
    }
    for effect in chosen {
        if !decisions.iter().any(|decision| decision.call.kind == effect.as_ref()) {
            let call = Call { kind: effect.as_ref().to_owned(), because: "--effects".to_owned() };
            decisions.push(Decision { call, outcome: Outcome::NotBuilt });
        }
    }
    decisions
}

impl Decision {
    /// One sentence for a person.
    pub fn sentence(&self) -> String {
        let Call { kind, because } = &self.call;
        match self.outcome {
            Outcome::LeftOut => format!("{kind} is called for by '{because}' but left out by --effects"),
            Outcome::NotBuilt => format!("{kind} is called for by '{because}' but not built: absent"),
            Outcome::NotOfTheLens => format!("{kind} is called for by '{because}' but no camera does that: absent"),
        }
    }

    /// The effect as a value of the shot, where it is one of the lens and wanted.
    pub fn request(&self) -> Option<EffectRequest> {
        let Call { kind, because } = self.call.clone();
        (self.outcome == Outcome::NotBuilt).then(|| EffectRequest { kind, because, settings: Vec::new() })
    }

    /// The line of the shot's report; none for what a person left out.
    pub fn report_line(&self) -> Option<ReportLine> {
        (self.outcome != Outcome::LeftOut).then(|| ReportLine {
            clause: self.call.because.clone(),
            wanted: self.call.kind.clone(),
            got: 0.0,
            met: false,
            note: self.sentence(),
        })
    }
}
