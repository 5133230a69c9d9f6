use std::ops::Range;
use std::str::FromStr;

use super::error::PipelineError;

/// A range of a film's frames, written `A..B`; B is one past the last frame. A and B may be left out.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct FrameRange {
    /// First frame, counting from 0.
    pub start: usize,
    /// One past the last frame; `None` = the end of the film.
    pub end: Option<usize>,
}

impl FrameRange {
    /// The range within a film of `num_frames` frames.
    ///
    /// # Errors
    /// [`PipelineError::NoSuchFrames`] for an empty range or one that exceeds the film.
    pub fn of_film(self, num_frames: usize) -> Result<Range<usize>, PipelineError> {
        let end = self.end.unwrap_or(num_frames);
        if self.start >= end || end > num_frames {
            return Err(PipelineError::NoSuchFrames { start: self.start, end, num_frames });
        }
        Ok(self.start..end)
    }
}

impl FromStr for FrameRange {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || format!("{text:?} is no range of frames, expected A..B such as 0..120");
        let (start, end) = text.split_once("..").ok_or_else(wrong)?;
        let number = |digits: &str| digits.trim().parse::<usize>().map_err(|_| wrong());
        let start = if start.trim().is_empty() { 0 } else { number(start)? };
        let end = if end.trim().is_empty() { None } else { Some(number(end)?) };
        Ok(Self { start, end })
    }
}
