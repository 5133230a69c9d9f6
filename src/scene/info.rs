use super::bounds::Bounds;
use super::filter::SplatFilter;
use super::scene::{Scene, UpSource};

/// Summary of a scene, as `info` prints it.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneInfo {
    /// Name of the format, such as `spz v2`.
    pub format: String,
    /// SHA-256 of the file in lower-case hexadecimal; empty for a generated scene.
    pub sha256: String,
    /// Number of Gaussians to render.
    pub num_gaussians: usize,
    /// Number of Gaussians that the reader dropped.
    pub num_dropped: usize,
    /// Degree of the spherical harmonics, 0..=3.
    pub sh_degree: u8,
    /// Bounds of all means and of the scene's core.
    pub bounds: Bounds,
    /// Scene size: the diagonal of the core, scene units.
    pub size: f64,
    /// Filter to render with: the one that the file states, else [`SplatFilter::Classic`].
    pub filter: SplatFilter,
    /// Whether the file states it.
    pub filter_is_stated: bool,
    /// World up, unit.
    pub up: [f64; 3],
    /// Source of `up`.
    pub up_source: UpSource,
    /// Number of distinct object ids in the file, 0 not counted.
    pub num_objects: usize,
    /// Notes on dropped, repaired and ignored data, one line each.
    pub notes: Vec<String>,
}

impl Scene {
    /// Summary of the scene.
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
