//! Effects of the camera: what calls for them, where they run, what they do.

mod calls;
mod exposure;
mod focus;
mod hard_cases;
mod optics;
mod own_lens;
mod pictures;
mod shake;
mod stand;
mod words;
