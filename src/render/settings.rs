use glam::Vec3;

use super::{Fog, InstructionSet, RenderError, spec};
use cinesplat_scene::{Scene, SplatFilter};

/// Preset of accuracy against time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[derive(strum::AsRefStr, strum::Display, strum::EnumString, strum::IntoStaticStr)]
#[derive(strum::VariantArray, strum::VariantNames)]
#[strum(serialize_all = "kebab-case")]
pub enum Quality {
    /// For previews: a coarse alpha cut, and blending stops early.
    Draft,
    /// Blending stops a little early; opacities are approximate.
    Standard,
    /// The constants of the spec image in `f32`.
    Final,
    /// The spec image itself, in `f64`.
    Reference,
}

impl Quality {
    /// The accuracy knobs of this preset.
    ///
    /// Chosen on the golden cameras of the kitchen scene at 1280x720 (`bench render` measures each knob alone). All
    /// figures in dB are PSNR against the spec image.
    ///
    /// - [`Precision::Quick`] saves the most time per decibel: `standard` takes a third less time than `final`, at 68
    ///   dB. An alpha cut of 1/128 saves less at 53 dB, a per-pixel stop at 3e-3 saves less at 47 dB.
    /// - A stop per block loses less than a stop per pixel. On fifteen golden cameras a stop at 4e-3 blends up to 5 %
    ///   fewer splats than one at 1e-3. It costs at most 3 dB, and nothing on the worst camera, which has 62 dB. A stop
    ///   at 8e-3 blends 8 % fewer and costs 8 dB.
    /// - For `draft`, an alpha cut of 1/64 and a stop at 3e-2 save a fifth to a third of the time at 44 dB. Half the
    ///   resolution saves little more at 37 dB, and takes more time in small scenes.
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

/// The knobs that trade accuracy for time. Accuracy is PSNR against the spec image.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Accuracy {
    /// A splat is skipped in pixels where its opacity is below this, 1e-6..0.9.
    pub alpha_cut: f64,
    /// Blending stops before the transmittance of a pixel would fall below this, above 0 and below 1.
    pub transmittance_stop: f64,
    /// Side length of the rendered picture divided by that of the returned picture, above 0 and up to 1. Below 1, the
    /// rendered picture is enlarged.
    pub resolution_frac: f64,
    /// Precision of the blending loop.
    pub precision: Precision,
}

/// Precision of the blending loop.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[derive(strum::AsRefStr, strum::Display, strum::EnumString, strum::IntoStaticStr)]
#[derive(strum::VariantArray, strum::VariantNames)]
#[strum(serialize_all = "kebab-case")]
pub enum Precision {
    /// Relative error of opacities below 2.5e-5. Each pixel stops on its own, as in the spec image.
    Exact,
    /// Relative error of opacities up to 0.8 %. A block of 8 x 4 pixels stops when all of its pixels may stop.
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

/// Which depth orders the splats.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[derive(strum::AsRefStr, strum::Display, strum::EnumString, strum::IntoStaticStr)]
#[derive(strum::VariantArray, strum::VariantNames)]
#[strum(serialize_all = "kebab-case")]
pub enum SortMode {
    /// Depth along the view axis, as in the spec image. Turning the camera may swap overlapping splats.
    #[default]
    Z,
    /// Distance from the camera center. Turning the camera swaps no splats.
    Ray,
}

/// Where colors are clamped.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[derive(strum::AsRefStr, strum::Display, strum::EnumString, strum::IntoStaticStr)]
#[derive(strum::VariantArray, strum::VariantNames)]
#[strum(serialize_all = "kebab-case")]
pub enum ColorClamp {
    /// A Gaussian's color is clamped to 0 from below, and the blended picture to 1 from above, on conversion to 8 bits:
    /// as scenes are trained, and as in the spec image.
    #[default]
    Trained,
    /// A Gaussian's color is clamped to 0..=1, as the glTF extension `KHR_gaussian_splatting` specifies.
    Khr,
}

impl ColorClamp {
    /// Upper bound of a Gaussian's color.
    pub(super) fn max_color(self) -> f32 {
        match self {
            Self::Trained => f32::INFINITY,
            Self::Khr => 1.0,
        }
    }
}

/// Limits on the memory and the work of one picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// Bytes that the renderer may hold beyond the loaded scene: its own copy of the Gaussians, work lists, buffers,
    /// the picture and other outputs.
    pub max_memory_bytes: u64,
    /// Number of splat-tile pairs (a splat that overlaps n tiles makes n pairs).
    pub max_pairs: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Self { max_memory_bytes: 4 << 30, max_pairs: 1 << 30 }
    }
}

/// Everything besides scene and camera that a picture depends on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RenderSettings {
    /// Accuracy preset; [`Quality::Reference`] renders in `f64`, all others in `f32`.
    pub quality: Quality,
    /// Dilation of splats, and whether their opacity is reduced to compensate.
    pub filter: SplatFilter,
    /// Near plane: Gaussians with a mean at this depth or nearer are not drawn. Scene units, 0 or more.
    pub near: f64,
    /// Background color, in the colors of the trained scene.
    pub background: Vec3,
    /// Fog between the camera and the scene; `None` = none.
    pub fog: Option<Fog>,
    /// Depth that orders the splats.
    pub sort: SortMode,
    /// Where colors are clamped.
    pub color_clamp: ColorClamp,
    /// Accuracy knobs that replace those of the preset. [`Quality::Reference`] ignores `resolution_frac` and
    /// `precision`.
    pub accuracy: Option<Accuracy>,
    /// Limits on memory and work.
    pub limits: Limits,
    /// Instruction set to use. Changes no bit of a picture.
    pub instructions: InstructionSet,
    /// Whether to start from the depth order of the previous picture, which saves time while the camera keeps its
    /// direction. Changes no bit of a picture.
    pub reuses_order: bool,
}

impl Default for RenderSettings {
    fn default() -> Self {
        Self {
            quality: Quality::Standard,
            filter: SplatFilter::Classic,
            near: 0.2,
            background: Vec3::ZERO,
            fog: None,
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

    /// The accuracy knobs in effect.
    pub(super) fn effective_accuracy(&self) -> Accuracy {
        self.accuracy.unwrap_or_else(|| self.quality.accuracy())
    }

    /// The background as it is seen: nothing but fog, if there is fog.
    pub(super) fn visible_background(&self) -> Vec3 {
        self.fog.filter(|fog| fog.density > 0.0).map_or(self.background, |fog| fog.color)
    }

    /// Dilation: added to both diagonal entries of a splat's covariance, pixels squared.
    pub fn dilation_px2(&self) -> f64 {
        match self.filter {
            SplatFilter::Classic | SplatFilter::Mip => 0.3,
            SplatFilter::MipSmall => 0.1,
        }
    }

    /// Whether the opacity is reduced to compensate for the dilation.
    pub(super) fn is_compensated(&self) -> bool {
        self.filter != SplatFilter::Classic
    }

    /// Checks every range; rejects NaN.
    ///
    /// # Errors
    /// [`RenderError::Setting`].
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
            (
                "fog",
                self.fog.map_or(0.0, |fog| fog.density),
                self.fog.is_none_or(|fog| fog.density >= 0.0 && fog.density.is_finite() && fog.color.is_finite()),
                "a color, and a finite density of 0 or more",
            ),
        ];
        match ranges.into_iter().find(|(_, _, good, _)| !good) {
            Some((name, found, _, expected)) => Err(RenderError::Setting { name, found, expected }),
            None => Ok(()),
        }
    }
}
