//! Metadata in header comments: `Vertical Axis: z` (nerfstudio, Brush), `SplatRenderMode: mip` (Brush), `antialiased 1`
//! (Postshot). Matching ignores case, colons, equal signs and underscores.

use glam::DVec3;

use crate::filter::SplatFilter;

/// The filter of the last comment that states one.
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

/// World up of the last comment that states one, with the comment.
///
/// The letter names the vertical axis. A sign gives the direction of up; without a sign the convention of the writing
/// programs applies: +z for `z`, and -y for `y`, because the y axis of their PLY files points down.
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

/// The words of a comment before the last word, and the last word; in lower case.
fn key_and_value(comment: &str) -> Option<(String, String)> {
    let plain = comment.to_ascii_lowercase().replace([':', '=', '_'], " ");
    let words: Vec<&str> = plain.split_whitespace().collect();
    let (value, key) = words.split_last()?;
    Some((key.join(" "), (*value).to_owned()))
}
