use std::fmt;
use std::path::PathBuf;

use glam::DVec3;

use super::bounds::Bounds;
use super::filter::SplatFilter;
use super::gaussians::Gaussians;

/// Where the up direction of a scene comes from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum UpSource {
    /// Given on the command line.
    Flag,
    /// Said by the objects file.
    ObjectsFile,
    /// Said by the scene file: the words it used.
    File(String),
    /// Estimated from floor and upright planes; 0..=100 how sure.
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

/// A scene with what its file says about itself.
#[derive(Debug, Clone)]
pub struct Scene {
    /// Where it was read from; empty for a generated one.
    pub path: PathBuf,
    /// SHA-256 of the file (of `meta.json` for unbundled SOG) in hex; empty for a generated one.
    pub sha256: String,
    /// Human name of the format, such as `spz v2`.
    pub format: String,
    /// The Gaussians.
    pub gaussians: Gaussians,
    /// Positions in the file of the Gaussians that were dropped on reading, ascending.
    pub dropped: Vec<u32>,
    /// Filter that the file asks for; `None` when it does not say.
    pub filter: Option<SplatFilter>,
    /// World up, unit.
    pub up: DVec3,
    /// Where `up` comes from.
    pub up_source: UpSource,
    /// What was dropped or repaired on reading and why, one line each, such as `3 dropped: position is not finite`.
    pub notes: Vec<String>,
}

impl Scene {
    /// Bounds of the solid Gaussians.
    pub fn bounds(&self) -> Bounds {
        Bounds::of(&self.gaussians)
    }

    /// Number of Gaussians in the file, those that were dropped included.
    pub fn num_in_file(&self) -> usize {
        self.gaussians.len() + self.dropped.len()
    }

    /// The entries of a column in file order (one a Gaussian of the file, such as labels) that belong to the Gaussians
    /// that were kept; `None` when the column has another length than the file.
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
