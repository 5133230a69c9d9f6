//! Runs the stages in order: scene and sentence to shot, shot to film.
//!
//! Enters: paths, prompts, settings. Leaves: shots, films, stills and the time per phase. Progress goes to a callback;
//! nothing is printed. The one invariant: a file under its final name is complete. A film's finished frames outlive the
//! program that rendered them.

mod accuracy;
mod choose_film;
mod clearance;
mod direct;
mod doubtful_rests;
mod error;
mod facing;
mod few_things;
mod film;
mod film_pictures;
mod focus;
mod forecast;
mod frames;
mod guessed_names;
mod guessed_things;
mod interpreter;
mod job;
mod lone_thing;
mod opened_scene;
mod other_kinds;
mod panic_point;
mod phases;
mod point_features;
mod promise;
mod reading;
mod said_parts;
mod slant;
mod stated;
mod stills;
mod takes_sheet;

pub use choose_film::{Critique, FilmChoice};
pub use clearance::{certify, prove_clearance};
pub use direct::{
    DirectSettings, Directed, StepReading, direct, direct_program, prepare_objects, shot_of, stated_rate, stated_size,
};
pub use error::PipelineError;
pub use film::{
    FilmProgress, FilmReport, FilmSettings, called_effects, camera_at, complete_effects, film, film_part, film_planned,
    plan_effects, suited_preset, video_of,
};
pub use film_pictures::film_pictures;
pub use forecast::{
    FilmCost, Forecast, Promised, Requirements, TimeCost, checked_psnr_db, choose, forecast, num_cores, promised,
};
pub use frames::{FrameRange, Piece};
pub use interpreter::Interpreter;
pub use job::{
    JobError, JobSettings, JobStart, check_job, check_shared_job, clear_job, has_job, job_field, job_folder,
    job_progress, remove_leftover, remove_tasks_folder, tasks_folder,
};
pub use opened_scene::{OpenedScene, open_scene};
pub use phases::{Phase, PhaseTimes};
pub use point_features::describe_points;
pub use promise::{Pace, PathProfile, Promise};
pub use reading::{Problem, ProblemKind, Reading, read};
pub use stills::{Still, StillOutputs, still};
pub use takes_sheet::takes_sheet;
