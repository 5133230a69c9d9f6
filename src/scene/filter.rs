use strum::{AsRefStr, Display, EnumString, IntoStaticStr, VariantArray, VariantNames};

/// How the renderer compensates opacity for the dilation of a splat; see the contract "Rendering, exactly".
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, AsRefStr, Display, EnumString, IntoStaticStr, VariantArray, VariantNames,
)]
#[strum(serialize_all = "kebab-case")]
pub enum SplatFilter {
    /// 0.3 px dilation, opacity unchanged.
    Classic,
    /// 0.3 px dilation, opacity times sqrt(det before / det after).
    Mip,
    /// As `Mip` with 0.1 px: for files with Mip-Splatting's own `filter_3D` property.
    MipSmall,
}
