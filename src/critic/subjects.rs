//! The Gaussians of the objects that a film is about.

use glam::DVec3;

use super::painted::Painted;
use super::thinned::{MAX_BACKGROUND, thinned};
use cinesplat_objects::{Object, ObjectSet};
use cinesplat_scene::{Gaussians, SOLID_OPACITY};

/// Facets per subject from which the critic tells how its surfaces face the camera.
const MAX_FACETS: usize = 256;
/// Opacity below which a Gaussian is not seen.
const LEAST_OPACITY: f32 = 0.05;

/// A Gaussian that is not solid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ThinMatter {
    pub(super) mean: DVec3,
    /// Opacity times the area of its two longer axes at one standard deviation.
    pub(super) cover: f64,
}

/// The objects of a scene that films are about, and the scene prepared for looking at them.
#[derive(Debug, Clone, PartialEq)]
pub struct Subjects {
    /// The scene as small pictures show it, without view-dependent color.
    pub(super) scene: Gaussians,
    /// The same painted with what the critic wants to know.
    pub(super) painted: Painted,
    /// Gaussians too thin to be solid.
    pub(super) thin: Vec<ThinMatter>,
    /// In the order of the ids that they were made from.
    pub(super) subjects: Vec<Subject>,
}

/// One object.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Subject {
    pub(super) id: u32,
    pub(super) name: String,
    pub(super) center: DVec3,
    pub(super) radius: f64,
    /// Corners of its box, world.
    pub(super) corners: [DVec3; 8],
    /// Its own Gaussians.
    pub(super) cloud: Gaussians,
    pub(super) facets: Vec<Facet>,
}

/// A flat Gaussian: where it is, which way it lies and how large it is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Facet {
    pub(super) mean: DVec3,
    /// Unit normal of either sign.
    pub(super) normal: DVec3,
    pub(super) area: f64,
}

impl Subjects {
    /// The objects with these ids. An object has the Gaussians with its label, or else those in its box; a Gaussian of two
    /// objects belongs to the first, and one of a part to its whole as well. Unknown ids are left out.
    pub fn new(gaussians: &Gaussians, objects: &ObjectSet, ids: &[u32]) -> Self {
        let mut labels = vec![0_u16; gaussians.len()];
        let mut subjects: Vec<Subject> = Vec::new();
        let mut members: Vec<Vec<usize>> = Vec::new();
        for object in ids.iter().filter_map(|&id| objects.get(id)) {
            if subjects.len() >= usize::from(u16::MAX) || subjects.iter().any(|known| known.id == object.id) {
                continue;
            }
            let own = gaussians_of(gaussians, object, &objects.labels_of(object.id));
            subjects.push(Subject::new(gaussians, object, &own));
            members.push(own);
        }
        let parts: Vec<Vec<u32>> = subjects.iter().map(|subject| objects.parts_of(subject.id)).collect();
        let wholes_of = |part: &Subject| (0..parts.len()).filter(|whole| parts[*whole].contains(&part.id)).collect();
        let wholes: Vec<Vec<usize>> = subjects.iter().map(wholes_of).collect();
        // What a part of a part has is none of the whole's own.
        let mut order: Vec<usize> = (0..subjects.len()).collect();
        order.sort_by_key(|subject| std::cmp::Reverse(wholes[*subject].len()));
        for subject in order {
            for &i in &members[subject] {
                if labels[i] == 0 {
                    labels[i] = subject as u16 + 1;
                }
            }
        }
        let (kept, growth) = thinned(gaussians, &labels, MAX_BACKGROUND);
        let sizes: Vec<f32> = kept.iter().map(|&i| size(gaussians, i)).collect();
        let kept_labels: Vec<u16> = kept.iter().map(|&i| labels[i]).collect();
        let mut scene = gaussians.plain_subset(&kept);
        let background = scene.scales.iter_mut().zip(&kept_labels).filter(|(_, label)| **label == 0);
        background.for_each(|(scale, _)| *scale *= growth);
        let painted = Painted::new(&scene, &sizes, &kept_labels, &wholes);
        Self { scene, painted, thin: thin_matter(gaussians), subjects }
    }
}

impl Subject {
    fn new(gaussians: &Gaussians, object: &Object, own: &[usize]) -> Self {
        let name = if object.label.is_empty() { format!("<obj-{}>", object.id) } else { object.label.clone() };
        let flat: Vec<Facet> = own.iter().filter_map(|&i| facet(gaussians, i)).collect();
        let facets = flat.iter().step_by(flat.len().div_ceil(MAX_FACETS).max(1)).copied().collect();
        Self {
            id: object.id,
            name,
            center: object.center,
            radius: object.radius(),
            corners: object.corners(),
            cloud: gaussians.plain_subset(own),
            facets,
        }
    }

    /// Mean cosine between the normals of the facets and the directions to a camera, by area, 0..=1; about 0.5 for round
    /// things. `None` where no facet is known.
    pub(super) fn facing(&self, eye: DVec3) -> Option<f64> {
        let total: f64 = self.facets.iter().map(|facet| facet.area).sum();
        let cosine = |facet: &Facet| facet.normal.dot((eye - facet.mean).normalize_or_zero()).abs() * facet.area;
        (total > 0.0).then(|| self.facets.iter().map(cosine).sum::<f64>() / total)
    }
}

fn gaussians_of(gaussians: &Gaussians, object: &Object, labels: &[u16]) -> Vec<usize> {
    let owns = object.owns(labels, 0.0);
    (0..gaussians.len()).filter(|&i| owns(i, gaussians.mean_world(i))).collect()
}

/// Gaussians between invisible and solid.
fn thin_matter(gaussians: &Gaussians) -> Vec<ThinMatter> {
    let is_thin = |i: &usize| (LEAST_OPACITY..SOLID_OPACITY).contains(&gaussians.opacities[*i]);
    let cover = |i: usize| {
        let mut scale = gaussians.scales[i].to_array();
        scale.sort_by(f32::total_cmp);
        f64::from(gaussians.opacities[i] * scale[1] * scale[2]) * std::f64::consts::PI
    };
    (0..gaussians.len())
        .filter(is_thin)
        .map(|i| ThinMatter { mean: gaussians.mean_world(i), cover: cover(i) })
        .collect()
}

fn facet(gaussians: &Gaussians, i: usize) -> Option<Facet> {
    let (normal, area) = gaussians.facet(i).filter(|_| gaussians.opacities[i] >= SOLID_OPACITY)?;
    Some(Facet { mean: gaussians.mean_world(i), normal, area })
}

/// Size of the detail that a Gaussian can carry, scene units, above 0: twice its middle standard deviation. That is the
/// shorter side of a flat one, and the width of a needle.
fn size(gaussians: &Gaussians, i: usize) -> f32 {
    let mut scale = gaussians.scales[i].to_array();
    scale.sort_by(f32::total_cmp);
    (2.0 * scale[1]).max(f32::MIN_POSITIVE)
}
