//! Poses, rotations and level frames.

mod level;
mod rotation;
