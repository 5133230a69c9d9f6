//! Descriptive names of objects by their size, shape and color.

use glam::Vec3;

use super::boxes::UprightBox;
use super::color;
use super::object::Object;
use cinesplat_scene::Gaussians;

/// A description such as `large turquoise object` or `tall brown panel`.
///
/// `setting` is the scene size, and whether the object is only a level surface. An object is large from a quarter of
/// the scene size on, and small up to a tenth of it.
pub(crate) fn describe(gaussians: &Gaussians, members: &[usize], fitted: &UprightBox, setting: (f64, bool)) -> String {
    let (scene_size, is_surface) = setting;
    let share = 2.0 * fitted.half_extents.length() / scene_size;
    let size = if share >= 0.25 {
        "large "
    } else if share <= 0.1 {
        "small "
    } else {
        ""
    };
    let (shape, noun) = if is_surface { ("", "surface") } else { form(fitted) };
    format!("{size}{shape}{} {noun}", color::name(typical_color(gaussians, members)))
}

/// Adjective and noun for the proportions of a box.
fn form(fitted: &UprightBox) -> (&'static str, &'static str) {
    let half = fitted.half_extents;
    let (thin, wide) = (half.x.min(half.z), half.x.max(half.z));
    if thin < 0.2 * wide && thin < 0.2 * half.y {
        ("", "panel")
    } else if half.y > 2.2 * wide {
        ("tall ", "object")
    } else if half.y < 0.3 * wide {
        ("flat ", "object")
    } else if wide > 3.0 * thin {
        ("long ", "object")
    } else {
        ("", "object")
    }
}

/// Median color, CIE Lab, of the more opaque half of the Gaussians.
fn typical_color(gaussians: &Gaussians, members: &[usize]) -> Vec3 {
    let mut solid: Vec<usize> = members.to_vec();
    solid.sort_by(|&a, &b| gaussians.opacities[b].total_cmp(&gaussians.opacities[a]));
    solid.truncate(members.len().div_ceil(2));
    let colors: Vec<Vec3> = solid.iter().map(|&i| color::lab(gaussians.base_color(i))).collect();
    color::median(&colors)
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
