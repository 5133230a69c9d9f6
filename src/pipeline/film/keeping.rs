use std::sync::Arc;
use std::sync::mpsc::Receiver;
use std::time::{Duration, Instant};

use crate::pipeline::error::PipelineError;
use crate::pipeline::job::{Keeper, Picture};
use crate::pipeline::panic_point::panic_point;

/// A frame on its way to the job folder.
pub(super) struct Finished {
    /// Its number in the shot.
    pub(super) frame_idx: usize,
    pub(super) picture: Arc<Picture>,
    /// Whether it is the picture of the frame before.
    pub(super) is_repeated: bool,
}

/// Keeps the frames of a film on a thread of its own, because the disk is waited for.
pub(super) struct Keeping<'a> {
    pub(super) keeper: &'a mut Keeper,
    pub(super) busy: Duration,
}

impl Keeping<'_> {
    /// Keeps frames until the channel is closed. Returns the time that it took.
    pub(super) fn run(mut self, frames: &Receiver<Finished>) -> Result<Duration, PipelineError> {
        for finished in frames {
            self.keep(&finished)?;
        }
        Ok(self.busy)
    }

    /// Keeps one frame.
    pub(super) fn keep(
        &mut self,
        Finished { frame_idx, picture, is_repeated }: &Finished,
    ) -> Result<(), PipelineError> {
        panic_point("keep", *frame_idx);
        let start = Instant::now();
        if *is_repeated {
            self.keeper.keep_again(*frame_idx, picture)?;
        } else {
            self.keeper.keep(*frame_idx, picture)?;
        }
        self.busy += start.elapsed();
        Ok(())
    }
}
