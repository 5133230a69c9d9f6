//! Names for objects nobody has named, of what can be measured: size, shape, color.

use glam::Vec3;

use super::boxes::UprightBox;
use super::{Object, color};
use cinesplat_scene::Gaussians;

/// A description such as `large turquoise object` or `tall brown panel`.
///
/// `setting` is the scene's size and whether the object is nothing but a level surface. Large is a quarter of the
/// scene's size and more, small a tenth and less.
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

/// Adjective and noun for a box's proportions.
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

/// The color name's color: the median, channel by channel of CIE Lab, of the more solid half of the Gaussians.
fn typical_color(gaussians: &Gaussians, members: &[usize]) -> Vec3 {
    let mut solid: Vec<usize> = members.to_vec();
    solid.sort_by(|&a, &b| gaussians.opacities[b].total_cmp(&gaussians.opacities[a]));
    solid.truncate(members.len().div_ceil(2));
    let colors: Vec<Vec3> = solid.iter().map(|&i| color::lab(gaussians.base_color(i))).collect();
    let median = |channel: usize| {
        let mut values: Vec<f32> = colors.iter().map(|lab| lab[channel]).collect();
        let middle = values.len() / 2;
        if values.is_empty() { 0.0 } else { *values.select_nth_unstable_by(middle, f32::total_cmp).1 }
    };
    Vec3::new(median(0), median(1), median(2))
}

/// Numbers all but the first of several equal labels from 2 on, in order of id.
pub(crate) fn make_unique(objects: &mut [Object]) {
    let labels: Vec<String> = objects.iter().map(|object| object.label.clone()).collect();
    for (i, object) in objects.iter_mut().enumerate() {
        let earlier = labels[..i].iter().filter(|label| **label == labels[i]).count();
        if earlier > 0 {
            object.label = format!("{} {}", labels[i], earlier + 1);
        }
    }
}

/// The labels nearest to a name by edit distance (Levenshtein, letters' case ignored), at most `count`, nearest first.
pub fn nearest_labels<'a>(name: &str, objects: &'a [Object], count: usize) -> Vec<&'a str> {
    let wanted: Vec<char> = name.to_lowercase().chars().collect();
    let mut near: Vec<(usize, &str)> = objects
        .iter()
        .filter(|object| !object.label.is_empty())
        .map(|object| (edit_distance(&wanted, &object.label.to_lowercase()), object.label.as_str()))
        .collect();
    near.sort_unstable();
    near.dedup();
    near.into_iter().take(count).map(|(_, label)| label).collect()
}

fn edit_distance(a: &[char], b: &str) -> usize {
    let mut row: Vec<usize> = (0..=a.len()).collect();
    for (i, letter) in b.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for j in 1..row.len() {
            let substituted = diagonal + usize::from(a[j - 1] != letter);
            diagonal = row[j];
            row[j] = substituted.min(row[j] + 1).min(row[j - 1] + 1);
        }
    }
    row[a.len()]
}
