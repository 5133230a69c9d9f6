//! Effects of the camera: what calls for them, where they run, what they do.

mod calls;
mod exposure;
mod focus;
mod optics;
mod pictures;
mod shake;
mod stand;
mod words;
