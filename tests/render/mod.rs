//! Tests of the renderer: golden pictures, hard cases, equal bits for any partition of the work.

mod bands;
mod bench;
mod blur;
mod goldens;
mod hard_cases;
mod oracle;
mod payloads;
mod per_ray;
mod pictures;
mod repeatable;
pub(crate) mod scenes;
mod settings;
mod sort_modes;
mod sweep;
