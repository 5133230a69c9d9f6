//! Camera-trajectory generation for video: a Gaussian-splat scene and a sentence become a camera move, filmed.

pub mod cli;
pub mod director;
pub mod evaluation;
pub mod export;
pub mod geometry;
pub mod lens;
pub mod objects;
pub mod operator;
pub mod pipeline;
pub mod render;
pub mod scene;
pub mod trajectory;
pub mod video;
