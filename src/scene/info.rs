use super::{Bounds, Scene, SplatFilter, UpSource};

/// What `info` prints about a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneInfo {
    /// Human name of the format.
    pub format: String,
    /// SHA-256 of the file in hex.
    pub sha256: String,
    /// Gaussians that are there to draw.
    pub num_gaussians: usize,
    /// Gaussians that were dropped on reading.
    pub num_dropped: usize,
    /// Degree of the spherical harmonics, 0..=3.
    pub sh_degree: u8,
    /// Extent of all means and of the scene's core.
    pub bounds: Bounds,
    /// Scene size: diagonal of the core, scene units.
    pub size: f64,
    /// `classic`, `mip` or `mip-small`: what `auto` picks.
    pub filter: &'static str,
    /// Whether the file itself asks for that filter.
    pub filter_is_stated: bool,
    /// World up, unit.
    pub up: [f64; 3],
    /// Where it comes from, in words.
    pub up_source: String,
    /// Object ids in the file, 0 not counted.
    pub num_objects: usize,
    /// What was dropped or repaired and why, one line each.
    pub notes: Vec<String>,
}

impl Scene {
    /// What there is to say about this scene.
    pub fn info(&self) -> SceneInfo {
        let bounds = self.bounds();
        let mut ids = self.gaussians.ids.clone();
        ids.retain(|id| *id != 0);
        ids.sort_unstable();
        ids.dedup();
        SceneInfo {
            format: self.format.clone(),
            sha256: self.sha256.clone(),
            num_gaussians: self.gaussians.len(),
            num_dropped: self.dropped.len(),
            sh_degree: self.gaussians.sh_degree,
            bounds,
            size: bounds.size(),
            filter: self.filter.unwrap_or(SplatFilter::Classic).into(),
            filter_is_stated: self.filter.is_some(),
            up: self.up.to_array(),
            up_source: self.up_source.to_string(),
            num_objects: ids.len(),
            notes: self.notes.clone(),
        }
    }
}

impl std::fmt::Display for UpSource {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Flag => write!(f, "--up"),
            Self::ObjectsFile => write!(f, "the objects file"),
            Self::File(words) => write!(f, "the scene file: {words}"),
            Self::Estimated(percent) => write!(f, "estimated, {percent} % sure"),
        }
    }
}
