//! What the director makes of a prompt.

use cinesplat_operator::{Program, Step, StepCameras};
use cinesplat_trajectory::Move;

/// Certainty of a step of the program.
#[derive(Debug, Clone, PartialEq)]
pub struct StepCertainty {
    /// Probability that the step is what the prompt requests, 0..=1: the product of the probabilities of all its
    /// choices, calibrated on sentences that training has not seen.
    pub probability: f64,
    /// The name of the choice of the lowest probability ([`Choice`](crate::Choice)), and that probability.
    pub weakest: (&'static str, f64),
    /// Byte range of the prompt that the step comes from.
    pub words: Option<[usize; 2]>,
    /// What several readings of the prompt say of the step; `None` for a prompt that is read once.
    pub voices: Option<Voices>,
}

/// What several readings of a prompt say of a step of the one that counts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Voices {
    /// Share of the readings that have the step, each by its certainty and by how like its step is, 0..=1.
    pub agreement: f64,
    /// What most of those that read the words as another move take them for.
    pub otherwise: Option<Move>,
}

impl StepCertainty {
    /// A step of which no choice stands out.
    pub fn of(probability: f64, words: Option<[usize; 2]>) -> Self {
        Self { probability, weakest: ("move", probability), words, voices: None }
    }
}

/// Certainty of a film of which the words say what is seen, and leave the moves open.
const OPEN_PROBABILITY: f64 = 0.25;

/// The director's output for a prompt.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Direction {
    /// The program that the prompt requests.
    pub program: Program,
    /// Cameras that the network proposes, one pair per step, in the world.
    pub step_cameras: Vec<StepCameras>,
    /// Certainty of each step.
    pub certainty: Vec<StepCertainty>,
    /// Bytes of the prompt that ask for something that no program can say.
    pub unmet: Vec<[usize; 2]>,
}

impl Direction {
    /// A program that nobody had to guess.
    pub fn of(program: Program) -> Self {
        Self { program, ..Self::default() }
    }

    /// Geometric mean of the certainties of the steps; 0 without a step.
    pub(crate) fn mean_certainty(&self) -> f64 {
        let sum: f64 = self.certainty.iter().map(|step| step.probability.max(1e-9).ln()).sum();
        if self.certainty.is_empty() { 0.0 } else { (sum / self.certainty.len() as f64).exp() }
    }

    /// Puts one step in the place of two: step `nth` and the one before it.
    pub(crate) fn join_steps(&mut self, nth: usize, one: Step) {
        if let Some(certainty) = self.certainty.get_mut(nth - 1) {
            certainty.words = one.words;
        }
        self.program.steps[nth - 1] = one;
        self.remove_step(nth);
    }

    /// Puts one step in the place of every two in a row for which `joined` makes one.
    pub(crate) fn join_pairs(&mut self, joined: impl Fn(&Step, &Step) -> Option<Step>) {
        let mut nth = 1;
        while nth < self.program.steps.len() {
            match joined(&self.program.steps[nth - 1], &self.program.steps[nth]) {
                Some(one) => self.join_steps(nth, one),
                None => nth += 1,
            }
        }
    }

    /// The words of all steps, from the first to the last.
    pub(crate) fn span(&self) -> Option<[usize; 2]> {
        let words = || self.program.steps.iter().filter_map(|step| step.words);
        let (from, to) = (words().map(|[from, _]| from).min(), words().map(|[_, to]| to).max());
        from.zip(to).map(|(from, to)| [from, to])
    }

    /// Films other steps than the network has read, which are as good as the words leave it open.
    pub(crate) fn replace_steps(&mut self, steps: Vec<Step>) {
        let certainty = |step: &Step| StepCertainty::of(OPEN_PROBABILITY, step.words);
        self.certainty = steps.iter().map(certainty).collect();
        // The network's cameras belong to other steps.
        self.step_cameras.clear();
        self.program.steps = steps;
    }

    /// Inserts a step that rests where step `nth` begins, with its certainty.
    pub(crate) fn insert_rest(&mut self, nth: usize, rest: Step) {
        if let Some(cameras) = self.step_cameras.get(nth) {
            let camera = cameras.start;
            self.step_cameras.insert(nth, StepCameras { start: camera, end: camera, secs: 1.0 });
        } else if let Some(cameras) = self.step_cameras.last().filter(|_| nth == self.program.steps.len()) {
            let camera = cameras.end;
            self.step_cameras.push(StepCameras { start: camera, end: camera, secs: 1.0 });
        }
        if let Some(certainty) = self.certainty.get(nth).or(self.certainty.last()).cloned() {
            self.certainty.insert(nth.min(self.certainty.len()), certainty);
        }
        self.program.steps.insert(nth, rest);
    }

    /// Inserts all of another direction before step `nth`.
    pub(crate) fn insert_all(&mut self, nth: usize, other: Self) {
        let count = other.program.steps.len();
        let mut cameras = other.step_cameras;
        if cameras.len() < count {
            let last = cameras.last().or(self.step_cameras.last()).map(|cameras| cameras.end);
            cameras.extend(last.map(|camera| StepCameras { start: camera, end: camera, secs: 1.0 }));
        }
        if self.step_cameras.len() >= nth && cameras.len() == count {
            self.step_cameras.splice(nth..nth, cameras);
        } else {
            // Cameras that belong to no step are worth nothing.
            self.step_cameras.clear();
        }
        let at = nth.min(self.certainty.len());
        self.certainty.splice(at..at, other.certainty);
        self.program.steps.splice(nth..nth, other.program.steps);
        self.unmet.extend(other.unmet);
        self.program.duration_secs = self.program.duration_secs.or(other.program.duration_secs);
    }

    /// Moves the first steps behind all others. The network's cameras, which belong to another order, are dropped.
    pub(crate) fn move_to_end(&mut self, count: usize) {
        self.program.steps.rotate_left(count);
        if self.certainty.len() == self.program.steps.len() {
            self.certainty.rotate_left(count);
        }
        self.step_cameras.clear();
    }

    /// Removes a step with its cameras and its certainty.
    pub fn remove_step(&mut self, nth: usize) {
        fn remove<T>(list: &mut Vec<T>, nth: usize) {
            if nth < list.len() {
                list.remove(nth);
            }
        }
        remove(&mut self.program.steps, nth);
        remove(&mut self.step_cameras, nth);
        remove(&mut self.certainty, nth);
    }
}
