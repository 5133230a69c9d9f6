//! Scenes of 3D Gaussians: readers for PLY, SPZ, SOG, `.splat`, `.ksplat`, glTF and PCD, the up axis and bounds.
//!
//! Enters: a file or folder of a supported format. Leaves: [`Scene`]. The world is the file's own: readers flip no axis and
//! scale nothing. They drop Gaussians that cannot be rendered, and [`Scene::notes`] reports how many and why. Invariant:
//! readers check every size that a file claims against the bytes that are present before they allocate for it.

mod bounds;
mod decoded;
mod error;
mod filter;
mod gaussians;
mod gltf;
mod info;
mod intake;
mod ksplat;
mod load;
mod options;
mod pcd;
mod ply;
mod scene;
mod sniff;
mod sog;
mod source_file;
mod splat;
mod spz;
mod up;

pub use bounds::Bounds;
pub use cinesplat_files::Limits;
pub use error::SceneError;
pub use filter::SplatFilter;
pub use gaussians::{Gaussians, NUM_SH_REST, SOLID_OPACITY};
pub use info::SceneInfo;
pub use load::{load, load_bytes};
pub use options::LoadOptions;
pub use ply::write_ply;
pub use scene::{Scene, UpSource};
pub use up::{SURE_PERCENT, UpEstimate, UpPrior, estimate as estimate_up, estimates as up_estimates, up_flag};
