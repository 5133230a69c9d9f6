use glam::Vec3;

use super::{InstructionSet, RenderError, spec};
use cinesplat_scene::{Scene, SplatFilter};

/// How much accuracy is traded for time.
#[derive(
    Debug,
    Clone,
    Copy,
    PartialEq,
    Eq,
    strum::AsRefStr,
    strum::Display,
    strum::EnumString,
    strum::IntoStaticStr,
    strum::VariantArray,
    strum::VariantNames,
)]
#[strum(serialize_all = "kebab-case")]
pub enum Quality {
    /// A coarse alpha cut, blending stops early: for previews.
    Draft,
    /// Full resolution, blending stops a little early.
    Standard,
    /// The constants of the spec image in `f32`.
    Final,
    /// The spec image itself, in `f64`.
    Reference,
}

impl Quality {
    /// What this preset sets.
    ///
    /// Chosen on the kitchen's golden cameras at 1280x720 (`bench render` measures all knobs alone). Of all knobs the
    /// precision pays best: `standard` takes a third less time than `final` at 68 dB, while a cut of 1/128 would leave 53
    /// dB and a stop at 3e-3, each pixel by itself, 47 dB for less time saved. Pixels that stop in blocks lose less: on
    /// fifteen golden cameras a stop at 4e-3 blends up to 5 % less than one at 1e-3 for at most 3 dB (none in the worst,
    /// 62 dB); at 8e-3 it is 8 % and 8 dB. For `draft` a cut of 1/64 and a stop at 3e-2 save a fifth to a third at 44 dB;
    /// half the size, enlarged, saves little more at 37 dB, and in small scenes costs more than it saves.
    pub fn accuracy(self) -> Accuracy {
        match self {
            Self::Draft => Accuracy {
                alpha_cut: 1.0 / 64.0,
                transmittance_stop: 3e-2,
                precision: Precision::Quick,
                ..Accuracy::SPEC
            },
            Self::Standard => Accuracy { transmittance_stop: 4e-3, precision: Precision::Quick, ..Accuracy::SPEC },
            Self::Final | Self::Reference => Accuracy::SPEC,
        }
    }
}

/// The knobs that cost decibels, each against the spec image.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Accuracy {
    /// Below this opacity a splat leaves a pixel alone, 0..1.
    pub alpha_cut: f64,
    /// Blending stops before the transmittance of a pixel would fall below this, 0..1.
    pub transmittance_stop: f64,
    /// Side length of the picture rendered over that of the picture returned, above 0 and up to 1.
    pub resolution_frac: f64,
    /// Precision of the blending loop.
    pub precision: Precision,
}

/// Precision of the blending loop.
#[derive(
    Debug,
    Clone,
    Copy,
    PartialEq,
    Eq,
    strum::AsRefStr,
    strum::Display,
    strum::EnumString,
    strum::IntoStaticStr,
    strum::VariantArray,
    strum::VariantNames,
)]
#[strum(serialize_all = "kebab-case")]
pub enum Precision {
    /// Opacities within 2.5e-5 of themselves; each pixel stops on its own, as in the spec image.
    Exact,
    /// Opacities within 0.8 % of themselves; pixels stop in blocks of 8 x 4, when the last of them may.
    Quick,
}

impl Accuracy {
    /// The constants of the spec image.
    pub const SPEC: Self = Self {
        alpha_cut: spec::ALPHA_CUT,
        transmittance_stop: spec::TRANSMITTANCE_STOP,
        resolution_frac: 1.0,
        precision: Precision::Exact,
    };
}

/// What decides which of two splats is in front.
#[derive(
    Debug,
    Clone,
    Copy,
    PartialEq,
    Eq,
    Default,
    strum::AsRefStr,
    strum::Display,
    strum::EnumString,
    strum::IntoStaticStr,
    strum::VariantArray,
    strum::VariantNames,
)]
#[strum(serialize_all = "kebab-case")]
pub enum SortMode {
    /// Depth along the view axis, as the spec image: turning the camera may exchange overlapping splats.
    #[default]
    Z,
    /// Distance from the camera center: turning the camera exchanges nothing.
    Ray,
}

/// Where colors are held to their range.
#[derive(
    Debug,
    Clone,
    Copy,
    PartialEq,
    Eq,
    Default,
    strum::AsRefStr,
    strum::Display,
    strum::EnumString,
    strum::IntoStaticStr,
    strum::VariantArray,
    strum::VariantNames,
)]
#[strum(serialize_all = "kebab-case")]
pub enum ColorClamp {
    /// A Gaussian's color at 0 from below, the blended picture at 1 from above: as scenes are trained, and the spec image.
    #[default]
    Trained,
    /// A Gaussian's color at both 0 and 1, as the glTF extension `KHR_gaussian_splatting` has it: one brighter than
    /// white counts as white.
    Khr,
}

impl ColorClamp {
    /// The largest value that a Gaussian's color may have.
    pub(super) fn max_color(self) -> f32 {
        match self {
            Self::Trained => f32::INFINITY,
            Self::Khr => 1.0,
        }
    }
}

/// Bounds on what one picture may take.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// Bytes that the renderer may hold beyond the loaded scene: its own copy of the Gaussians, work lists, buffers,
    /// the picture and outputs beside it.
    pub max_memory_bytes: u64,
    /// Overlaps between splats and tiles.
    pub max_pairs: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Self { max_memory_bytes: 4 << 30, max_pairs: 1 << 30 }
    }
}

/// Everything that decides a picture besides scene and camera.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RenderSettings {
    /// Preset; also decides between `f32` and `f64`.
    pub quality: Quality,
    /// Dilation and its compensation.
    pub filter: SplatFilter,
    /// Gaussians whose mean is not farther than this along the view axis are left out, scene units.
    pub near: f64,
    /// What shows through, as-trained color.
    pub background: Vec3,
    /// Order of blending.
    pub sort: SortMode,
    /// Where colors are held to their range.
    pub color_clamp: ColorClamp,
    /// Knobs in place of the preset's.
    pub accuracy: Option<Accuracy>,
    /// Caps on memory and work.
    pub limits: Limits,
    /// The widest instructions that may be used; changes no picture.
    pub instructions: InstructionSet,
    /// Whether the depth order of the picture before may help, as it does while the camera keeps its direction; changes
    /// no picture.
    pub reuses_order: bool,
}

impl Default for RenderSettings {
    fn default() -> Self {
        Self {
            quality: Quality::Standard,
            filter: SplatFilter::Classic,
            near: 0.2,
            background: Vec3::ZERO,
            sort: SortMode::default(),
            color_clamp: ColorClamp::default(),
            accuracy: None,
            limits: Limits::default(),
            instructions: InstructionSet::default(),
            reuses_order: true,
        }
    }
}

impl RenderSettings {
    /// The defaults for a scene: the filter that its file states (else [`SplatFilter::Classic`]) and a near plane that
    /// suits its size ([`cinesplat_scene::Bounds::default_near`]). All other fields are those of
    /// [`RenderSettings::default`].
    pub fn for_scene(scene: &Scene) -> Self {
        Self {
            filter: scene.filter.unwrap_or(SplatFilter::Classic),
            near: scene.bounds().default_near(),
            ..Self::default()
        }
    }

    /// The knobs in force.
    pub(super) fn effective_accuracy(&self) -> Accuracy {
        self.accuracy.unwrap_or_else(|| self.quality.accuracy())
    }

    /// Pixels squared added to both diagonal entries of a splat's covariance.
    pub(super) fn dilation_px2(&self) -> f64 {
        match self.filter {
            SplatFilter::Classic | SplatFilter::Mip => 0.3,
            SplatFilter::MipSmall => 0.1,
        }
    }

    /// Whether the opacity makes up for the dilation.
    pub(super) fn is_compensated(&self) -> bool {
        self.filter != SplatFilter::Classic
    }

    /// Checks every range; NaN fails.
    pub(super) fn check(&self) -> Result<(), RenderError> {
        let accuracy = self.effective_accuracy();
        let ranges = [
            ("near", self.near, self.near >= 0.0 && self.near.is_finite(), "a finite distance, 0 or more"),
            ("alpha_cut", accuracy.alpha_cut, accuracy.alpha_cut >= 1e-6 && accuracy.alpha_cut < 0.9, "1e-6..0.9"),
            (
                "transmittance_stop",
                accuracy.transmittance_stop,
                accuracy.transmittance_stop > 0.0 && accuracy.transmittance_stop < 1.0,
                "above 0 and below 1",
            ),
            (
                "resolution_frac",
                accuracy.resolution_frac,
                accuracy.resolution_frac > 0.0 && accuracy.resolution_frac <= 1.0,
                "above 0 and up to 1",
            ),
            ("background", f64::from(self.background.length()), self.background.is_finite(), "three finite numbers"),
        ];
        match ranges.into_iter().find(|(_, _, good, _)| !good) {
            Some((name, found, _, expected)) => Err(RenderError::Setting { name, found, expected }),
            None => Ok(()),
        }
    }
}
