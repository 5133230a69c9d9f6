//! Descriptive names of objects by their size, shape and color.

use glam::{DVec3, Vec3};

use super::boxes::UprightBox;
use super::color;
use super::object::Object;
use super::seen_colors::seen_colors;
use super::structure;
use cinesplat_scene::{Gaussians, Scene};

/// Distance from the middle of a box, over half of its extent, from which a Gaussian is on a face.
const FACE_FRAC: f64 = 0.8;

/// Least shares of the Gaussians of a box on one face or more, and on two or more. The faces of a cube have 1 and 0.36
/// of them; a ball has 0.6 and none, a disc
/// 0.21 and a can 0.18 of the latter.
const MIN_ON_FACES: f64 = 0.75;
const MIN_ON_EDGES: f64 = 0.28;

/// A description such as `floor`, `large turquoise object` or `tall brown box`.
///
/// `setting` is the scene size, and whether the object is only a level surface. An object is large from a quarter of
/// the scene size on, and small up to a tenth of it.
pub(crate) fn describe(scene: &Scene, members: &[usize], fitted: &UprightBox, setting: (f64, bool)) -> String {
    if let Some(name) = structure::name(scene, members, fitted, setting.0) {
        return name.to_owned();
    }
    let gaussians = &scene.gaussians;
    let (scene_size, is_surface) = setting;
    let share = 2.0 * fitted.half_extents.length() / scene_size;
    let size = if share >= 0.25 {
        "large "
    } else if share <= 0.1 {
        "small "
    } else {
        ""
    };
    let (shape, noun) = if is_surface { ("", "surface") } else { form(gaussians, members, fitted) };
    format!("{size}{shape}{} {noun}", color_name(gaussians, members, fitted))
}

/// Adjective and noun for the proportions of a box and for how its Gaussians fill it.
fn form(gaussians: &Gaussians, members: &[usize], fitted: &UprightBox) -> (&'static str, &'static str) {
    let half = fitted.half_extents;
    let (thin, wide) = (half.x.min(half.z), half.x.max(half.z));
    if thin < 0.2 * wide && thin < 0.2 * half.y {
        return ("", "panel");
    }
    let noun = if is_box(gaussians, members, fitted) { "box" } else { "object" };
    if half.y > 2.2 * wide {
        ("tall ", noun)
    } else if half.y < 0.3 * wide {
        ("flat ", noun)
    } else if wide > 3.0 * thin {
        ("long ", noun)
    } else {
        ("", noun)
    }
}

/// Whether the Gaussians lie on the faces of their box, up to its edges.
fn is_box(gaussians: &Gaussians, members: &[usize], fitted: &UprightBox) -> bool {
    let local_from_world = fitted.rotation.conjugate();
    let half = fitted.half_extents.max(DVec3::splat(f64::MIN_POSITIVE));
    let num_faces = |i: &usize| {
        let local = local_from_world * (gaussians.mean_world(*i) - fitted.center) / half;
        local.to_array().into_iter().filter(|along| along.abs() > FACE_FRAC).count()
    };
    let share =
        |least: usize| members.iter().filter(|i| num_faces(i) >= least).count() as f64 / members.len().max(1) as f64;
    share(1) >= MIN_ON_FACES && share(2) >= MIN_ON_EDGES
}

/// The color by which people call a thing.
fn color_name(gaussians: &Gaussians, members: &[usize], fitted: &UprightBox) -> &'static str {
    let seen = seen_colors(gaussians, members, fitted);
    if seen.is_empty() { color::name(typical_color(gaussians, members)) } else { color::dominant(&seen) }
}

/// Median color, CIE Lab, of the more opaque half of the Gaussians.
fn typical_color(gaussians: &Gaussians, members: &[usize]) -> Vec3 {
    let mut solid: Vec<usize> = members.to_vec();
    solid.sort_by(|&a, &b| gaussians.opacities[b].total_cmp(&gaussians.opacities[a]));
    solid.truncate(members.len().div_ceil(2));
    let colors: Vec<Vec3> = solid.iter().map(|&i| color::lab(gaussians.base_color(i))).collect();
    color::median(&colors)
}

/// Whether a label is a description by size, shape and color, as a search gives it, and not a name.
pub fn is_description(label: &str) -> bool {
    let unnumbered = label.trim_end_matches(|letter: char| letter.is_ascii_digit() || letter == ' ');
    let last = unnumbered.rsplit(' ').next().unwrap_or_default();
    ["object", "box", "panel", "surface"].contains(&last)
}

/// Makes equal labels unique: numbers all except the first one from 2 on, in order of id.
pub(crate) fn make_unique(objects: &mut [Object]) {
    let labels: Vec<String> = objects.iter().map(|object| object.label.clone()).collect();
    for (i, object) in objects.iter_mut().enumerate() {
        let earlier = labels[..i].iter().filter(|label| **label == labels[i]).count();
        if earlier > 0 {
            object.label = format!("{} {}", labels[i], earlier + 1);
        }
    }
}
