use super::bounds::Bounds;
use super::filter::SplatFilter;
use super::scene::{Scene, UpSource};

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
    /// Filter that `auto` picks.
    pub filter: SplatFilter,
    /// Whether the file itself asks for that filter.
    pub filter_is_stated: bool,
    /// World up, unit.
    pub up: [f64; 3],
    /// SourceFile of the up direction.
    pub up_source: UpSource,
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
            filter: self.filter.unwrap_or(SplatFilter::Classic),
            filter_is_stated: self.filter.is_some(),
            up: self.up.to_array(),
            up_source: self.up_source.clone(),
            num_objects: ids.len(),
            notes: self.notes.clone(),
        }
    }
}
