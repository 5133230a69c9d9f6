use std::time::{Duration, Instant};

/// Wall time of the stages of one run, in the order in which they ran.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct StageTimes {
    stages: Vec<(&'static str, Duration)>,
}

impl StageTimes {
    /// Runs one stage and remembers how long it took.
    pub fn measure<T>(&mut self, stage: &'static str, work: impl FnOnce() -> T) -> T {
        let start = Instant::now();
        let result = work();
        self.add(stage, start.elapsed());
        result
    }

    /// Adds time to a stage.
    pub fn add(&mut self, stage: &'static str, time: Duration) {
        match self.stages.iter_mut().find(|(name, _)| *name == stage) {
            Some((_, total)) => *total += time,
            None => self.stages.push((stage, time)),
        }
    }

    /// Adds the stages of another run.
    pub fn extend(&mut self, other: &Self) {
        other.stages.iter().for_each(|(stage, time)| self.add(stage, *time));
    }

    /// Stages and their times.
    pub fn iter(&self) -> impl Iterator<Item = (&'static str, Duration)> {
        self.stages.iter().copied()
    }
}
