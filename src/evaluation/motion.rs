//! The motion of one path, as JSON and as text: smoothness, motion tags and a table of poses.

use std::fmt::Write as _;

use super::table::{rows_json, table_text};
use super::{Description, Smoothness, Tagger, Trajectory, keyframe_table, smoothness};
use cinesplat_export::json_write::{Json, object};

/// The motion of a path: its moves, smoothness, the motion tags of both taggers, and a table of its poses.
pub(super) fn motion_value(path: &Trajectory) -> Json {
    let segments = |tagger: Tagger| {
        let segment = |s: &super::TagSegment| {
            object([("from", s.start.into()), ("to", s.end.into()), ("tag", s.tag.to_string().as_str().into())])
        };
        Json::list(tagger.segments(path).iter().map(segment))
    };
    let smooth = smoothness(path).map_or_else(Json::NULL, |found| {
        Json::Object(named(&found).into_iter().map(|(name, value)| (name.to_owned(), value.into())).collect())
    });
    object([
        ("poses", path.len().into()),
        ("path_length", path.path_length().into()),
        ("moves", Description::new(path, &[], None).sentence().as_str().into()),
        ("smoothness", smooth),
        ("tags_et", segments(Tagger::Et)),
        ("tags_gendop", segments(Tagger::Gendop)),
        ("table", rows_json(&keyframe_table(path))),
    ])
}

/// The motion of a path as text. The table of a long path has only every n-th pose.
pub fn motion_text(name: &str, path: &Trajectory) -> String {
    const MAX_ROWS: usize = 24;
    let mut out = format!("{name}: {} poses, length {:.4}\n", path.len(), path.path_length());
    let _ = writeln!(out, "  moves: {}", Description::new(path, &[], None).sentence());
    for (name, value) in smoothness(path).iter().flat_map(named) {
        let _ = writeln!(out, "  {name:<31} {}", value.map_or("-".to_owned(), |value| format!("{value:.6}")));
    }
    for (name, tagger) in [("E.T.", Tagger::Et), ("GenDoP", Tagger::Gendop)] {
        let tags: Vec<String> = tagger
            .segments(path)
            .iter()
            .map(|segment| format!("{}..{} {}", segment.start, segment.end, segment.tag))
            .collect();
        let _ = writeln!(out, "  tags of {name}: {}", tags.join("; "));
    }
    let rows = keyframe_table(path);
    let stride = rows.len().div_ceil(MAX_ROWS).max(1);
    let picked: Vec<_> = rows.iter().step_by(stride).copied().collect();
    out + &table_text(&picked)
}

/// Names and values of a smoothness.
fn named(found: &Smoothness) -> [(&'static str, Option<f64>); 11] {
    [
        ("jerk_rms", found.jerk_rms),
        ("jerk_max", found.jerk_max),
        ("angular_jerk_rms", found.angular_jerk_rms),
        ("angular_jerk_max", found.angular_jerk_max),
        ("spectral_arc_length", found.spectral_arc_length),
        ("angular_spectral_arc_length", found.angular_spectral_arc_length),
        ("log_dimensionless_jerk", found.log_dimensionless_jerk),
        ("angular_log_dimensionless_jerk", found.angular_log_dimensionless_jerk),
        ("speed_ripple", found.speed_ripple),
        ("angular_speed_ripple", found.angular_speed_ripple),
        ("num_reversals", Some(found.num_reversals as f64)),
    ]
}
