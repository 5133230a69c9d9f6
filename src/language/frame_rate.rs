//! The frame rate where a prompt states it: `at 24 fps`, `60 frames per second`.

use super::tokenizer::{span_of, tokenize};

/// A stated frame rate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrameRate {
    /// Frames per second.
    pub fps: f64,
    /// Bytes of the prompt that state it.
    pub bytes: [usize; 2],
}

/// Rates of films. A camera that records more frames wants slow motion, which no move is.
const RATES_FPS: std::ops::RangeInclusive<f64> = 12.0..=60.0;
/// Words of frames per second, behind their number.
const PER_SECOND: [&[&str]; 5] = [
    &["fps"],
    &["frames", "per", "second"],
    &["frames", "a", "second"],
    &["frames", "/", "second"],
    &["frames", "/", "s"],
];

/// The first frame rate that a prompt states.
pub fn frame_rate(prompt: &str) -> Option<FrameRate> {
    let words = tokenize(prompt);
    (1..words.len()).find_map(|at| {
        let is_said = |phrase: &&&[&str]| {
            phrase.iter().enumerate().all(|(nth, word)| words.get(at + nth).is_some_and(|own| own.text == *word))
        };
        let phrase = PER_SECOND.iter().find(is_said)?;
        let fps: f64 = words[at - 1].text.parse().ok().filter(|fps| RATES_FPS.contains(fps))?;
        Some(FrameRate { fps, bytes: span_of(&words[at - 1..at + phrase.len()]) })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rate_is_a_number_of_frames_per_second() {
        let fps = |prompt: &str| frame_rate(prompt).map(|rate| rate.fps);
        assert_eq!(fps("orbit the lamp; 60 fps; 4s"), Some(60.0));
        assert_eq!(fps("push in, 24fps"), Some(24.0));
        assert_eq!(fps("25 frames per second please"), Some(25.0));
        assert_eq!(fps("slow motion, 240 fps"), None, "no film has so many");
        assert_eq!(fps("4 frames on the wall"), None);
        let rate = frame_rate("push in at 24 fps").unwrap();
        assert_eq!(rate.bytes, [11, 17]);
    }
}
