//! What a person corrects about objects that were found: pieces of one thing joined, crumbs taken out.
//!
//! Ids stay: those of the others never change, and the joined thing keeps the id that is named first.

use std::collections::BTreeSet;

use thiserror::Error;

use super::boxes;
use super::object::{Object, ObjectSet, PointFeatures};
use cinesplat_scene::Scene;

/// Why objects cannot be joined or taken out.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum EditError {
    /// No object has the id.
    #[error("no object has the id {0}")]
    Unknown(u32),
    /// A whole cannot become a part of its own part.
    #[error("object {part} is a part of object {whole}")]
    PartOf {
        /// The object that would take in the other.
        part: u32,
        /// The whole that it belongs to.
        whole: u32,
    },
}

/// Joins objects into the first of them, which keeps its id, name and whole, and gets their Gaussians, parts, and a new box; its
/// cloud is made anew when needed. Ids that are named twice count once.
///
/// # Errors
/// [`EditError::Unknown`] · [`EditError::PartOf`] where the first is a part of one of the others. The set is unchanged then.
pub fn merge(scene: &Scene, set: &mut ObjectSet, ids: &[u32]) -> Result<(), EditError> {
    let Some((&into, rest)) = ids.split_first() else { return Ok(()) };
    check_known(set, ids)?;
    let joined: BTreeSet<u32> = rest.iter().copied().filter(|id| *id != into).collect();
    if let Some(&whole) = joined.iter().find(|id| set.parts_of(**id).contains(&into)) {
        return Err(EditError::PartOf { part: into, whole });
    }
    let corners = set.objects.iter().filter(|object| object.id == into || joined.contains(&object.id));
    let corners: Vec<_> = corners.flat_map(Object::corners).collect();
    for label in set.labels.iter_mut().filter(|label| joined.contains(&u32::from(**label))) {
        *label = into as u16;
    }
    set.objects.retain(|object| !joined.contains(&object.id));
    for part in set.objects.iter_mut().filter(|object| object.parent.is_some_and(|whole| joined.contains(&whole))) {
        part.parent = Some(into).filter(|whole| *whole != part.id);
    }
    let members = set.members().remove(&into).unwrap_or_default();
    let fitted = boxes::fit(&scene.gaussians, &members, scene.up).or_else(|| boxes::fit_points(&corners, scene.up));
    if let (Some(object), Some(fitted)) = (set.objects.iter_mut().find(|object| object.id == into), fitted) {
        object.take_box(&fitted);
        object.num_gaussians = members.len();
        object.points.clear();
        object.features = PointFeatures::default();
        (object.shape_radius, object.mask_iou) = (0.0, 0.0);
    }
    Ok(())
}

/// Takes objects out of the set. The Gaussians of a part go back to its whole; a whole leaves with its parts, and its Gaussians
/// belong to no object then.
///
/// # Errors
/// [`EditError::Unknown`]. The set is unchanged then.
pub fn remove(set: &mut ObjectSet, ids: &[u32]) -> Result<(), EditError> {
    check_known(set, ids)?;
    for &id in ids {
        // A part may have left with its whole.
        let Some(object) = set.get(id) else { continue };
        let heir = object.parent.unwrap_or(0) as u16;
        let gone: BTreeSet<u32> = std::iter::once(id).chain(set.parts_of(id)).collect();
        for label in set.labels.iter_mut().filter(|label| gone.contains(&u32::from(**label))) {
            *label = heir;
        }
        set.objects.retain(|object| !gone.contains(&object.id));
    }
    Ok(())
}

fn check_known(set: &ObjectSet, ids: &[u32]) -> Result<(), EditError> {
    ids.iter().find(|id| set.get(**id).is_none()).map_or(Ok(()), |id| Err(EditError::Unknown(*id)))
}
