//! Tests of the renderer: golden pictures, hard cases, equal results however the work is cut.

mod bands;
mod bench;
mod goldens;
mod hard_cases;
mod oracle;
mod payloads;
mod per_ray;
mod pictures;
mod repeatable;
mod scenes;
mod sort_modes;
