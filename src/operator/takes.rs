//! Samples of a finished film between its cuts, on which what it must not do is measured.

use super::world::World;
use cinesplat_trajectory::{CameraPath, CameraState, Keyframe};

/// A camera and its time, seconds.
pub(super) type Sample = (f64, CameraState);

/// Samples of the stretches of the film between cuts: `count` from each keyframe to the next, and the last keyframe.
pub(super) fn takes(world: &World, keys: &[Keyframe], count: usize) -> Vec<Vec<Sample>> {
    let path = CameraPath::fine(keys.to_vec(), world.frame);
    let mut takes: Vec<Vec<Sample>> = Vec::new();
    for (i, key) in keys.iter().enumerate() {
        if i == 0 || key.cut {
            takes.push(Vec::new());
        }
        let next = keys.get(i + 1).filter(|next| !next.cut);
        let end = next.map_or(key.time_secs, |next| next.time_secs);
        let at = |j: usize| key.time_secs + (end - key.time_secs) * j as f64 / count as f64;
        let num = if next.is_some() { count } else { 1 };
        if let Some(take) = takes.last_mut() {
            take.extend((0..num).map(|j| (at(j), path.sample(at(j)))));
        }
    }
    takes
}
