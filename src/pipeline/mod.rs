//! The stages in a row, as a library: a scene and a sentence to a shot, a shot to a film.
//!
//! Enters: paths, prompts, settings. Leaves: shots, films, stills and how long each stage took. Progress goes to a
//! callback, nothing is printed. The one invariant: a file that bears its name is whole.

mod clearance;
mod direct;
mod error;
mod film;
mod forecast;
mod frames;
mod source;
mod stage_times;
mod stills;

pub use clearance::prove_clearance;
pub use direct::{DirectSettings, Directed, StepReading, direct, prepare_objects, shot_of};
pub use error::PipelineError;
pub use film::{FilmReport, FilmSettings, Flow, Progress, camera_at, film, video_of};
pub use forecast::{FilmCost, Forecast, Spent, Wish, checked_psnr_db, choose, forecast, num_cores};
pub use frames::FrameRange;
pub use source::{Source, open_scene};
pub use stage_times::StageTimes;
pub use stills::{Still, StillOutputs, still};
