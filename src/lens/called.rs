//! Which effects a shot calls for.

use std::mem;
use std::sync::Arc;

use super::calls::{Call, Calls, Source};
use super::choice::EffectChoice;
use super::effect::Effect;
use super::kinds::{KINDS, Kind, is_known};

/// The effects that a shot calls for.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Called {
    /// The effects, outermost layer first.
    pub effects: Vec<CalledEffect>,
    /// Calls that lead to no effect.
    pub unmet: Vec<Unmet>,
}

/// An effect and the reason for it.
#[derive(Debug, Clone)]
pub struct CalledEffect {
    /// Its name.
    pub name: &'static str,
    /// The effect.
    pub effect: Arc<dyn Effect>,
    /// The words, the flag, the move or the keyframe that calls for it.
    pub because: String,
    /// Where the call comes from.
    pub source: Source,
}

impl PartialEq for CalledEffect {
    /// Equal names, settings and reasons.
    fn eq(&self, other: &Self) -> bool {
        let parts = |called: &Self| (called.name, called.effect.settings(), called.because.clone());
        parts(self) == parts(other)
    }
}

/// A call that leads to no effect.
#[derive(Debug, Clone, PartialEq)]
pub struct Unmet {
    /// The call.
    pub call: Call,
    /// Why.
    pub reason: UnmetReason,
}

/// Why a call leads to no effect.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum UnmetReason {
    /// `--effects` excludes it.
    Disabled,
    /// These words of the prompt forbid it.
    Forbidden(String),
    /// Its settings make it do nothing.
    DoesNothing,
    /// Another effect, named here, takes its place, for this reason.
    Replaced(&'static str, &'static str),
    /// The request is not an effect of the camera.
    NotAnEffect,
    /// Something else than an effect does it, in these words.
    OtherMeans(&'static str),
}

/// Requests that no effect meets, each with what does.
const OTHER_MEANS: [(&str, &str); 2] = [
    ("exr", "the name of the output asks for it: -o frames/%05d.exr"),
    ("dither", "pictures with soft light are dithered in any case"),
];

/// What meets a request that is no effect of the camera, such as `exr`.
pub fn other_means(name: &str) -> Option<&'static str> {
    OTHER_MEANS.iter().find(|(known, _)| *known == name).map(|(_, means)| *means)
}

impl Called {
    /// The effects that a shot calls for and the user allows.
    pub fn of(choice: &EffectChoice, calls: &Calls<'_>) -> Self {
        let mut called = Self::default();
        for kind in KINDS {
            called.add(kind, choice, calls);
        }
        called.settle();
        let others = calls.calls.iter().filter(|call| !is_known(&call.name));
        let reason = |call: &Call| other_means(&call.name).map_or(UnmetReason::NotAnEffect, UnmetReason::OtherMeans);
        called.unmet.extend(others.map(|call| Unmet { call: call.clone(), reason: reason(call) }));
        called
    }

    /// Leaves out the effects whose place another one takes.
    fn settle(&mut self) {
        let names: Vec<&str> = self.effects.iter().map(|called| called.name).collect();
        let replaced = |called: &CalledEffect| {
            let kind = KINDS.iter().find(|kind| kind.name == called.name)?;
            kind.yields_to.iter().find(|(by, _)| names.contains(by)).copied()
        };
        let (kept, left): (Vec<_>, Vec<_>) =
            mem::take(&mut self.effects).into_iter().partition(|called| replaced(called).is_none());
        self.effects = kept;
        self.unmet.extend(left.iter().filter_map(|called| {
            let (by, why) = replaced(called)?;
            let call = Call::new(called.name, &called.because, called.source);
            Some(Unmet { call, reason: UnmetReason::Replaced(by, why) })
        }));
    }

    fn add(&mut self, kind: &'static Kind, choice: &EffectChoice, calls: &Calls<'_>) {
        let asked = (kind.call)(calls);
        let listed = choice.listed().iter().find(|name| kind.is_named(name));
        let (call, reason) = match (choice, asked, listed) {
            (EffectChoice::Auto, Some(call), _) => {
                let forbidden = calls.forbids(kind.name).filter(|_| call.source == Source::Words);
                (call, forbidden.map(|words| UnmetReason::Forbidden(words.to_owned())))
            }
            (EffectChoice::These(_), asked, Some(name)) => {
                (asked.unwrap_or_else(|| Call::new(name, "--effects", Source::Choice)), None)
            }
            (_, Some(call), _) => (call, Some(UnmetReason::Disabled)),
            (_, None, _) => return,
        };
        match (reason, (kind.make)(&call, calls)) {
            (None, Some(effect)) => {
                let (name, source) = (kind.name, call.source);
                self.effects.push(CalledEffect { name, effect, because: call.because, source });
            }
            (reason, _) => self.unmet.push(Unmet { call, reason: reason.unwrap_or(UnmetReason::DoesNothing) }),
        }
    }
}

impl Unmet {
    /// The call and its fate as one sentence.
    pub fn sentence(&self) -> String {
        let Call { name, because, .. } = &self.call;
        let reason = match &self.reason {
            UnmetReason::Disabled => "disabled by --effects".to_owned(),
            UnmetReason::Forbidden(words) => format!("left out, the words '{words}' forbid it"),
            UnmetReason::Replaced(by, why) => format!("left out, {by} takes its place: {why}"),
            UnmetReason::DoesNothing => "left out, its settings do nothing".to_owned(),
            UnmetReason::NotAnEffect => "not an effect of the camera, rendered without it".to_owned(),
            UnmetReason::OtherMeans(means) => format!("no effect, {means}"),
        };
        format!("{name} requested by '{because}': {reason}")
    }

    /// Whether the film lacks something that somebody asked for.
    pub fn is_missing(&self) -> bool {
        matches!(self.reason, UnmetReason::NotAnEffect | UnmetReason::Replaced(..))
    }
}
