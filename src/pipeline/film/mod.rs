//! A shot becomes a film: one thread renders frames in order while others keep and encode them.
//!
//! Enters: a renderer, a shot, settings. Leaves: a film or a picture sequence under its final name, complete. With a job
//! folder ([`super::job`]) every finished frame is kept until then, and a later run goes on from there: its film has the
//! same bytes as that of a run that nothing disturbed.

mod cameras;
mod compared;
mod effects;
mod encoding;
mod form;
mod keeping;
mod making;
mod part;
mod report;
mod settings;
mod watch;
mod whole;

pub use cameras::camera_at;
pub(super) use compared::{Compared, Found};
pub(super) use effects::{Filmed, MovingFrames};
pub use effects::{called_effects, complete_effects, plan_effects};
pub use part::film_part;
pub use report::{FilmProgress, FilmReport};
pub use settings::{FilmSettings, suited_preset, video_of};
pub(super) use whole::QUEUE_FRAMES;
pub use whole::{film, film_planned};
