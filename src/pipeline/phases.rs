use std::time::{Duration, Instant};

use strum::Display;

/// A phase of the work from a scene and a sentence to a film.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Display)]
#[strum(serialize_all = "kebab-case")]
pub enum Phase {
    /// Reading the scene, its objects and the director's weights.
    Load,
    /// Turning words into a program.
    Direct,
    /// Making the sparse clouds of objects.
    Objects,
    /// Indexing the scene for the solver.
    World,
    /// Turning the program into keyframes.
    Solve,
    /// Looking at the films that the search finished.
    Judge,
    /// Forecasting cost and accuracy of the film.
    Predict,
    /// Rendering frames.
    Render,
    /// Keeping finished frames in the job folder.
    Keep,
    /// Encoding frames.
    Encode,
}

/// Wall time per phase of one run, in the order in which the phases ran first.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct PhaseTimes {
    phases: Vec<(Phase, Duration)>,
}

impl PhaseTimes {
    /// Runs `work` and adds its time to `phase`.
    pub fn measure<T>(&mut self, phase: Phase, work: impl FnOnce() -> T) -> T {
        let start = Instant::now();
        let result = work();
        self.add(phase, start.elapsed());
        result
    }

    /// Adds time to a phase.
    pub fn add(&mut self, phase: Phase, time: Duration) {
        match self.phases.iter_mut().find(|(known, _)| *known == phase) {
            Some((_, total)) => *total += time,
            None => self.phases.push((phase, time)),
        }
    }

    /// Adds the times of another run.
    pub fn extend(&mut self, other: &Self) {
        other.phases.iter().for_each(|(phase, time)| self.add(*phase, *time));
    }

    /// Phases and their times.
    pub fn iter(&self) -> impl Iterator<Item = (Phase, Duration)> {
        self.phases.iter().copied()
    }
}
