//! How well found objects agree with true ones.
//!
//! Enters: found objects and true labels of the same Gaussians. Leaves: for every true object the found one that overlaps
//! it most. Gaussians count by their opacity; a whole has the Gaussians of its parts.

use std::collections::BTreeMap;

use cinesplat_scene::Gaussians;

use super::object::ObjectSet;

/// The found object that overlaps a true one most.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Agreement {
    /// Id of the true object.
    pub true_id: u32,
    /// Id of the found one; `None` where none shares a Gaussian with it.
    pub found_id: Option<u32>,
    /// Intersection over union, weighted by opacity, 0..=1.
    pub iou: f64,
}

/// The agreement of every true object, in order of id. `truth` has one id per Gaussian, 0 for none.
pub fn agreements(gaussians: &Gaussians, found: &ObjectSet, truth: &[u16]) -> Vec<Agreement> {
    let mut true_mass: BTreeMap<u32, f64> = BTreeMap::new();
    for (&label, &opacity) in truth.iter().zip(&gaussians.opacities).filter(|(label, _)| **label > 0) {
        *true_mass.entry(u32::from(label)).or_default() += f64::from(opacity);
    }
    let mut best: BTreeMap<u32, (f64, Option<u32>)> = true_mass.keys().map(|&id| (id, (0.0, None))).collect();
    for (found_id, members) in found.members() {
        let mut mass = 0.0;
        let mut shared: BTreeMap<u32, f64> = BTreeMap::new();
        for i in members {
            let opacity = f64::from(gaussians.opacities[i]);
            mass += opacity;
            *shared.entry(u32::from(truth.get(i).copied().unwrap_or(0))).or_default() += opacity;
        }
        for (true_id, both) in shared {
            let (Some(whole), Some(held)) = (true_mass.get(&true_id), best.get_mut(&true_id)) else { continue };
            let iou = both / (whole + mass - both);
            if iou > held.0 {
                *held = (iou, Some(found_id));
            }
        }
    }
    best.into_iter().map(|(true_id, (iou, found_id))| Agreement { true_id, found_id, iou }).collect()
}
