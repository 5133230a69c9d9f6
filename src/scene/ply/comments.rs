//! What header comments say about the scene: `Vertical Axis: z` (nerfstudio, Brush), `SplatRenderMode: mip` (Brush),
//! `antialiased 1` (Postshot). Upper and lower case, colons and equal signs do not matter.

use glam::DVec3;

use crate::filter::SplatFilter;

/// The filter that the comments ask for; the last one that says so counts.
pub(super) fn filter(comments: &[String]) -> Option<SplatFilter> {
    comments.iter().rev().find_map(|comment| {
        let (key, value) = key_and_value(comment)?;
        match (key.as_str(), value.as_str()) {
            ("splatrendermode", "mip") | ("antialiased" | "antialias", "1" | "true") => Some(SplatFilter::Mip),
            ("splatrendermode", "default") | ("antialiased" | "antialias", "0" | "false") => Some(SplatFilter::Classic),
            _ => None,
        }
    })
}

/// World up that the comments state, with their words; the last one that says so counts.
///
/// The letter names the file's vertical axis. A sign is taken as written; without one the writers' own convention
/// holds, which is up along +z for `z` and, since their y axes point down as in every PLY of splats, -y for `y`.
pub(super) fn up(comments: &[String]) -> Option<(DVec3, String)> {
    comments.iter().rev().find_map(|comment| {
        let (key, value) = key_and_value(comment)?;
        let up = match value.as_str() {
            "x" | "+x" => DVec3::X,
            "-x" => DVec3::NEG_X,
            "+y" => DVec3::Y,
            "y" | "-y" => DVec3::NEG_Y,
            "z" | "+z" => DVec3::Z,
            "-z" => DVec3::NEG_Z,
            _ => return None,
        };
        matches!(key.as_str(), "vertical axis" | "verticalaxis" | "up axis" | "upaxis").then(|| (up, comment.clone()))
    })
}

/// A comment's words before its last and the last, in lower case and without the sign between them.
fn key_and_value(comment: &str) -> Option<(String, String)> {
    let plain = comment.to_ascii_lowercase().replace([':', '=', '_'], " ");
    let words: Vec<&str> = plain.split_whitespace().collect();
    let (value, key) = words.split_last()?;
    Some((key.join(" "), (*value).to_owned()))
}
