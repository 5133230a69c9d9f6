use std::fmt;
use std::path::PathBuf;

use glam::DVec3;

use super::bounds::Bounds;
use super::filter::SplatFilter;
use super::gaussians::Gaussians;
use super::up::{self, UpEstimate, UpPrior};

/// Source of the up direction of a scene.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum UpSource {
    /// The caller: [`LoadOptions::up`](super::LoadOptions::up).
    Flag,
    /// The objects file.
    ObjectsFile,
    /// The scene file, with the text that states it.
    File(String),
    /// An estimate from the scene's floor, with its confidence in percent, 0..=100.
    Estimated(u8),
}

impl fmt::Display for UpSource {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Flag => write!(f, "--up"),
            Self::ObjectsFile => write!(f, "the objects file"),
            Self::File(words) => write!(f, "the scene file: {words}"),
            Self::Estimated(percent) => write!(f, "estimated, {percent} % sure"),
        }
    }
}

/// A scene with the metadata of its file.
#[derive(Debug, Clone)]
pub struct Scene {
    /// Path that the scene was read from; the requested name if it is generated.
    pub path: PathBuf,
    /// SHA-256 of the file, in lower-case hexadecimal; empty for a generated scene. Of a scene in several files it is that of
    /// the list of their SHA-256, one a line.
    pub sha256: String,
    /// Name of the format, such as `spz v2`.
    pub format: String,
    /// The Gaussians.
    pub gaussians: Gaussians,
    /// Positions in the file of the dropped Gaussians, ascending.
    pub dropped: Vec<u32>,
    /// Filter that the file states; `None` if it states none.
    pub filter: Option<SplatFilter>,
    /// World up, unit.
    pub up: DVec3,
    /// Source of `up`.
    pub up_source: UpSource,
    /// Notes on dropped, repaired and ignored data, one line each, such as `3 dropped: position is not finite`.
    pub notes: Vec<String>,
}

impl Scene {
    /// Bounds of all Gaussians and of the scene's core.
    pub fn bounds(&self) -> Bounds {
        Bounds::of(&self.gaussians)
    }

    /// The directions that may be up if the file does not state one, at least 15 degrees apart, most likely first.
    pub fn up_candidates(&self) -> Vec<UpEstimate> {
        up::estimates(&self.gaussians, UpPrior::of_format(&self.format))
    }

    /// Number of Gaussians in the file, dropped ones included.
    pub fn num_in_file(&self) -> usize {
        self.gaussians.len() + self.dropped.len()
    }

    /// The entries of a column for the Gaussians that were kept. The column holds one entry per Gaussian in file order, such
    /// as labels; `None` if its length differs from [`Scene::num_in_file`].
    pub fn kept<T: Copy>(&self, file_order: &[T]) -> Option<Vec<T>> {
        if file_order.len() != self.num_in_file() {
            return None;
        }
        let mut dropped = self.dropped.iter().peekable();
        let is_kept = |file_idx: usize| dropped.next_if(|idx| **idx as usize == file_idx).is_none();
        let kept: Vec<bool> = (0..file_order.len()).map(is_kept).collect();
        Some(file_order.iter().zip(kept).filter_map(|(value, kept)| kept.then_some(*value)).collect())
    }
}
