//! The job folder `OUT.job/` beside an output: finished frames survive whatever ends the program.
//!
//! Enters: pictures with their frame numbers. Leaves: the same pictures in a later run. Contents:
//!
//! ```text
//! job.json          what the film is made from, field by field (its fingerprint)
//! frames/000012.yuv one frame as the encoders take it: planes of luma, blue, red
//! done.log          one line per frame: number, checksum of its file
//! lock              locked while a program works on the folder; the system unlocks it when that program ends
//! claims/000012     locked while one of several programs renders that frame
//! holders/          a file per program that works on the folder: a disk may have no locks
//! tasks/            scripts and logs of the tasks that a cluster runs
//! film.mp4          the film, between the moment it is whole and the moment it gets its own name
//! placed            which file that film is: once the output is that file, the rest of the folder is not needed
//! ```
//!
//! The pictures of a sequence are their own frames: they lie under their final names and only `done.log` is here.
//!
//! The one invariant: a frame is trusted if and only if its file has the checksum that `done.log` holds for it. A line
//! is written after the bytes of its file and before the file gets its name. So neither a line without a file nor a torn
//! line nor a damaged file does harm: that frame is rendered again. Data goes to the disk every second on a thread of its
//! own: what a loss of power takes is about a second of work.
//!
//! A film that goes on is encoded from its first frame: an encoder's state (rate control, references, lookahead) cannot be
//! saved, and a film of pieces that are encoded apart would have other bytes, a keyframe per piece and worse rate control.
//! Encoding frames that are there costs no rendering and runs at the speed of the encoder alone.
//!
//! Locks save work and nothing depends on them: programs that render one frame twice write the same bytes.

mod access;
mod claims;
mod cleanup;
mod done_log;
mod error;
mod fingerprint;
mod flusher;
mod folder;
mod frame_files;
mod holders;
mod keeper;
mod lock;
mod outside;
mod picture;
mod process;
mod settings;

pub(crate) use access::Access;
pub use error::JobError;
pub(crate) use fingerprint::Fingerprint;
pub(crate) use folder::Job;
pub(crate) use frame_files::Kept;
pub(crate) use keeper::Keeper;
pub use outside::{
    check_job, check_shared_job, clear_job, has_job, job_field, job_folder, job_progress, remove_leftover,
    remove_tasks_folder, tasks_folder,
};
pub(crate) use picture::Picture;
pub use settings::{JobSettings, JobStart};
