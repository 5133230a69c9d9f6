//! The one list of effects.

use std::sync::Arc;

use super::anamorphic::Anamorphic;
use super::background::Background;
use super::bloom::Bloom;
use super::calls::{Call, Calls};
use super::chromatic_aberration::ChromaticAberration;
use super::depth_of_field::DepthOfField;
use super::effect::{Effect, EffectKind};
use super::exposure::Exposure;
use super::film_grain::FilmGrain;
use super::fisheye::Fisheye;
use super::fog::Fog;
use super::handheld::Handheld;
use super::lens_distortion::LensDistortion;
use super::lens_flare::LensFlare;
use super::motion_blur::MotionBlur;
use super::panorama::Panorama;
use super::rack_focus::RackFocus;
use super::rolling_shutter::RollingShutter;
use super::stereo::Stereo;
use super::tilt_shift::TiltShift;
use super::vignette::Vignette;
use cinesplat_files::{UnknownKeys, misspelling};
use cinesplat_trajectory::EffectRequest;

/// All effects, the outermost layer first: a frame passes through them from the end of the list to its
/// front.
pub const KINDS: &[Kind] = &[
    // The film.
    Kind::of::<FilmGrain>(),
    Kind::of::<Bloom>(),
    Kind::of::<Exposure>(),
    // The pair of cameras.
    Kind::of::<Stereo>(),
    // The lens.
    Kind::of::<LensFlare>(),
    Kind::of::<Anamorphic>(),
    Kind::of::<TiltShift>(),
    Kind::of::<Vignette>(),
    Kind::of::<ChromaticAberration>(),
    Kind::of::<LensDistortion>(),
    Kind::of::<Fisheye>(),
    Kind::of::<Panorama>(),
    // The shutter.
    Kind::of::<RollingShutter>(),
    Kind::of::<MotionBlur>(),
    // The aperture.
    Kind::of::<RackFocus>(),
    Kind::of::<DepthOfField>(),
    // What is in front of the lens, and the hand that holds it.
    Kind::of::<Fog>(),
    Kind::of::<Background>(),
    Kind::of::<Handheld>(),
];

/// A kind of effect.
#[derive(Debug, Clone, Copy)]
pub struct Kind {
    /// Name, as in `--effects`.
    pub name: &'static str,
    /// Other names that ask for it.
    pub also: &'static [&'static str],
    /// Names of its settings.
    pub settings: &'static [&'static str],
    /// The call that asks for it.
    pub(super) call: fn(&Calls<'_>) -> Option<Call>,
    /// The effect as a call asks for it.
    pub(super) make: fn(&Call, &Calls<'_>) -> Option<Arc<dyn Effect>>,
    /// Effects that take its place, each with the reason.
    pub(super) yields_to: &'static [(&'static str, &'static str)],
}

impl Kind {
    const fn of<E: EffectKind + 'static>() -> Self {
        Self {
            name: E::NAME,
            also: E::ALSO,
            settings: E::SETTINGS,
            call: E::call,
            make: make::<E>,
            yields_to: E::YIELDS_TO,
        }
    }

    pub(super) fn is_named(&self, name: &str) -> bool {
        self.name == name || self.also.contains(&name)
    }
}

fn make<E: EffectKind + 'static>(call: &Call, calls: &Calls<'_>) -> Option<Arc<dyn Effect>> {
    Some(Arc::new(E::called_for(call, calls)?))
}

/// Names of all effects.
pub fn names() -> impl Iterator<Item = &'static str> {
    KINDS.iter().flat_map(|kind| std::iter::once(kind.name).chain(kind.also.iter().copied()))
}

/// Whether an effect has this name.
pub fn is_known(name: &str) -> bool {
    names().any(|known| known == name)
}

/// One line per effect and setting of a shot's file that no effect has, with the nearest name.
pub fn unknown_names(requests: &[EffectRequest]) -> Vec<String> {
    let known_names: Vec<&str> = names().collect();
    let mut notes = Vec::new();
    let mut settings = UnknownKeys::default();
    for (idx, request) in requests.iter().enumerate() {
        let place = format!("effects[{idx}]");
        if let Some(kind) = KINDS.iter().find(|kind| kind.is_named(&request.kind)) {
            settings.check(&place, request.settings.iter().map(|(name, _)| name.as_str()), kind.settings);
        } else {
            let near = misspelling(&request.kind, known_names.iter().copied());
            let near = near.map_or_else(String::new, |name| format!(", the nearest known effect is {name}"));
            notes.push(format!("{place}.kind: unknown effect{near}"));
        }
    }
    notes.extend(settings.into_notes());
    notes
}
