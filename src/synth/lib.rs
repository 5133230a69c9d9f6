//! Procedural scenes: furnished rooms and still lifes made of Gaussians, with exact objects.
//!
//! Enters: [`SynthSettings`] with a seed. Leaves: [`SynthScene`]. Invariant: equal settings give equal bytes on every
//! machine and with every number of threads. World: y up, lengths in m, floor at y = 0, the main furniture at -z, a
//! free aisle in the middle.
//!
//! Stages of [`generate`]:
//! 1. `rooms` draws the proportions of a room and places assets (`assets`, `scene_builder`) in it.
//! 2. An asset is a list of primitives (`primitive`) with materials (`material`).
//! 3. `tessellate` covers each primitive with surfels: flat Gaussians (`surfel`).
//! 4. `bake` casts rays at proxies of the primitives (`occluder`, `bvh`) for the light of windows, sun and lamps.
//! 5. `tone_map` exposes the radiance and writes it as spherical harmonics.

mod artwork;
mod asset;
mod assets;
mod bake;
mod bake_quality;
mod bvh;
mod color;
mod faces;
mod flooring;
mod footprint;
mod generate;
mod intervals;
mod lights;
mod material;
mod naming;
mod noise;
mod occluder;
mod placement;
mod primitive;
mod proxies;
mod radiance;
mod rng;
mod rooms;
mod scene;
mod scene_builder;
mod settings;
mod shell;
mod structure;
mod surface_point;
mod surfel;
mod surfel_emitter;
mod tessellate;
mod texture;
mod tone_map;

pub use generate::generate;
pub use scene::{SynthObject, SynthScene};
pub use settings::{SynthKind, SynthSettings};
