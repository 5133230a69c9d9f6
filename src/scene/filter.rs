use strum::{AsRefStr, Display, EnumString, IntoStaticStr, VariantArray, VariantNames};

/// Antialiasing filter that a scene was trained with. The renderer dilates the 2D covariance of every splat; the filter
/// decides how far, and whether the opacity compensates for it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, AsRefStr, Display, EnumString, IntoStaticStr, VariantArray, VariantNames)]
#[strum(serialize_all = "kebab-case")]
pub enum SplatFilter {
    /// Dilation 0.3 px, opacity unchanged.
    Classic,
    /// Dilation 0.3 px, opacity times sqrt(determinant before / determinant after).
    Mip,
    /// As `Mip` with a dilation of 0.1 px, for files with the `filter_3D` property of Mip-Splatting.
    MipSmall,
}
