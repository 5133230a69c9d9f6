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

/// One of several equal pieces of a range of frames, written `I/N` with I from 1 to N: where one of N programs begins that
/// render one film together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Piece {
    number: usize,
    of: usize,
}

impl Default for Piece {
    fn default() -> Self {
        Self { number: 1, of: 1 }
    }
}

impl Piece {
    /// All frames of the range: those of this piece and of the pieces after it, then those of the pieces before it.
    ///
    /// A program that takes the frames in this order is beside the others as long as there is work for all, and then helps
    /// those that are late.
    pub fn order(self, frames: Range<usize>) -> impl Iterator<Item = usize> {
        let begin = frames.start + frames.len() * (self.number - 1) / self.of;
        (begin..frames.end).chain(frames.start..begin)
    }
}

impl FromStr for Piece {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers = text.split_once('/').and_then(|(number, of)| Some((number.parse().ok()?, of.parse().ok()?)));
        let piece =
            numbers.map(|(number, of)| Self { number, of }).filter(|piece| (1..=piece.of).contains(&piece.number));
        piece.ok_or_else(|| format!("{text:?} is no piece, expected I/N such as 3/40"))
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
