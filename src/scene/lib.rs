//! Scenes of 3D Gaussians: readers, up axis, bounds, and procedural scenes with known objects.
//!
//! Enters: a file or folder of any supported format, or a seed. Leaves: [`Scene`]. The world stays the file's own: no
//! axis is flipped, nothing is scaled. What cannot be drawn is dropped, counted and said in [`Scene::notes`]; nothing
//! that a file claims is believed before the bytes for it are seen.

mod bounds;
mod decoded;
mod error;
mod filter;
mod gaussians;
mod info;
mod intake;
mod load;
mod options;
mod ply;
mod scene;
mod sniff;
mod sog;
mod source_file;
mod splat;
mod spz;
mod up;

pub use bounds::Bounds;
pub use error::SceneError;
pub use filter::SplatFilter;
pub use gaussians::{Gaussians, NUM_SH_REST, SOLID_OPACITY};
pub use info::SceneInfo;
pub use load::{load, load_bytes};
pub use options::LoadOptions;
pub use ply::write_ply;
pub use scene::{Scene, UpSource};
pub use up::{UpEstimate, UpPrior, estimate as estimate_up};
