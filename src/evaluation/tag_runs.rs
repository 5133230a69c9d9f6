//! Runs of equal motion classes: the mode filter and the removal of short runs of the published taggers, in time that
//! grows with the length of the path and not with that of the filter.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Consecutive motions of one class.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Run {
    pub(super) start: usize,
    pub(super) end: usize,
    pub(super) class: usize,
}

impl Run {
    fn len(&self) -> usize {
        self.end - self.start
    }
}

/// The classes after a mode filter; unchanged if there are fewer than the window is long. Of equally frequent classes the
/// smallest wins.
pub(super) fn smoothed(classes: &[usize], window: usize) -> Vec<usize> {
    let (len, half) = (classes.len(), window / 2);
    if len < window {
        return classes.to_vec();
    }
    let mut counts = ClassCounts::new(classes.iter().copied().max().map_or(0, |largest| largest + 1));
    classes[..half.min(len)].iter().for_each(|class| counts.add(*class));
    let mode_at = |idx: usize| {
        let entering = classes.get(idx + half).copied();
        let leaving = idx.checked_sub(half + 1).map(|at| classes[at]);
        if entering != leaving {
            entering.iter().for_each(|class| counts.add(*class));
            leaving.iter().for_each(|class| counts.remove(*class));
        }
        counts.mode()
    };
    (0..len).map(mode_at).collect()
}

/// How often each class is in a window.
struct ClassCounts {
    counts: Vec<usize>,
    /// Number of classes with each count.
    num_with: Vec<usize>,
    highest: usize,
    /// The smallest class with the highest count, while it is known.
    mode: Option<usize>,
}

impl ClassCounts {
    fn new(num_classes: usize) -> Self {
        Self { counts: vec![0; num_classes], num_with: vec![num_classes], highest: 0, mode: Some(0) }
    }

    fn add(&mut self, class: usize) {
        let count = self.change(class, 1);
        if count > self.highest {
            (self.highest, self.mode) = (count, Some(class));
        } else if count == self.highest {
            self.mode = self.mode.map(|mode| mode.min(class));
        }
    }

    fn remove(&mut self, class: usize) {
        let count = self.change(class, -1);
        if count + 1 == self.highest {
            if self.num_with[self.highest] == 0 {
                (self.highest, self.mode) = (count, None);
            } else if self.mode == Some(class) {
                self.mode = None;
            }
        }
    }

    /// Changes the count of a class by `by`, and returns it.
    fn change(&mut self, class: usize, by: isize) -> usize {
        let before = self.counts[class];
        let after = before.saturating_add_signed(by);
        self.counts[class] = after;
        self.num_with[before] -= 1;
        if self.num_with.len() <= after {
            self.num_with.push(0);
        }
        self.num_with[after] += 1;
        after
    }

    fn mode(&mut self) -> usize {
        let found = self.mode.or_else(|| self.counts.iter().position(|count| *count == self.highest));
        self.mode = found;
        found.unwrap_or(0)
    }
}

fn runs_of(classes: &[usize]) -> Vec<Run> {
    let mut found: Vec<Run> = Vec::new();
    for (idx, class) in classes.iter().enumerate() {
        match found.last_mut() {
            Some(last) if last.class == *class => last.end = idx + 1,
            _ => found.push(Run { start: idx, end: idx + 1, class: *class }),
        }
    }
    found
}

/// The runs after those shorter than `shortest` are given to their neighbors, the shortest first and of equal ones the
/// first.
///
/// A run at an end goes to its only neighbor. A run between two is split in half, with the odd motion in the first
/// half. As in both published systems, two neighbors of one class stay two runs until the end: each may still be too
/// short by itself.
pub(super) fn without_short_runs(classes: &[usize], shortest: usize) -> Vec<Run> {
    let runs = runs_of(classes);
    // The links of a removed run are not used again; its entries in the queue are known by their length.
    let mut links: Vec<[Option<usize>; 2]> =
        (0..runs.len()).map(|idx| [idx.checked_sub(1), Some(idx + 1).filter(|next| *next < runs.len())]).collect();
    let mut runs: Vec<Option<Run>> = runs.into_iter().map(Some).collect();
    let mut num_left = runs.len();
    let too_short = |(idx, run): (usize, &Option<Run>)| {
        run.map(|run| run.len()).filter(|len| *len < shortest).map(|len| Reverse((len, idx)))
    };
    let mut queue: BinaryHeap<Reverse<(usize, usize)>> = runs.iter().enumerate().filter_map(too_short).collect();
    while num_left > 1 {
        let Some(Reverse((len, idx))) = queue.pop() else { break };
        let Some(Run { start, end, .. }) = runs[idx].filter(|run| run.len() == len) else { continue };
        let [before, after] = links[idx];
        let split = match (before, after) {
            (Some(_), Some(_)) => start + (end - start).div_ceil(2),
            (Some(_), None) => end,
            _ => start,
        };
        runs[idx] = None;
        num_left -= 1;
        for (neighbor, side, sides_end) in [(before, 1, true), (after, 0, false)] {
            let Some(at) = neighbor else { continue };
            links[at][side] = if sides_end { after } else { before };
            if let Some(run) = &mut runs[at] {
                if sides_end { run.end = split } else { run.start = split }
            }
            queue.extend(too_short((at, &runs[at])));
        }
    }
    joined(runs.into_iter().flatten())
}

/// The runs with neighbors of one class joined.
fn joined(runs: impl Iterator<Item = Run>) -> Vec<Run> {
    let mut found: Vec<Run> = Vec::new();
    for run in runs {
        match found.last_mut() {
            Some(last) if last.class == run.class => last.end = run.end,
            _ => found.push(run),
        }
    }
    found
}
