//! Effects of the camera: what calls for them, where they run, what they do.

mod calls;
mod optics;
mod exposure;
mod focus;
mod pictures;
mod shake;
mod stand;
mod words;
