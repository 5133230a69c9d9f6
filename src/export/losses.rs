//! Warnings about properties of a track that a format cannot hold.

use glam::DVec3;

use super::format::Format;
use super::track::{PoseFrame, PoseTrack};
use super::{lichtfeld, opengl, supersplat};
use cinesplat_geometry::LevelFrame;
use cinesplat_trajectory::Easing;

/// Largest number of keys in a camera animation of SuperSplat's editor.
const SUPERSPLAT_MAX_KEYS: usize = 1000;
/// Roll below which a camera counts as level, rad.
const LEVEL_RAD: f64 = 1e-3;

/// One line per property of `track` that `format` cannot hold.
pub(super) fn losses(format: Format, track: &PoseTrack) -> Vec<String> {
    let holds = format.holds();
    let mut lines = Vec::new();
    let mut lost = |is_lost: bool, what: String| {
        if is_lost {
            lines.push(format!("{format} {what}"));
        }
    };
    let any = |test: fn(&PoseFrame) -> bool| track.frames.iter().any(test);
    let start = track.frames.first().map_or(0.0, |first| first.time_secs);
    lost(track.timed && !holds.times, "holds no times: only the order of the frames is kept".into());
    lost(holds.times && !holds.clock && start != 0.0, format!("counts times from 0: {start} s is subtracted"));
    lost(
        !holds.fov && any(|f| f.fov_y_rad.is_some()),
        format!("holds no field of view: {} are lost", fov_range(track)),
    );
    lost(!holds.size && track.size_px.is_some(), "holds no image size".into());
    lost(!holds.focus && any(|f| f.focus_distance.is_some()), "holds no focus distance".into());
    lost(!holds.easing && any(|f| f.easing != Easing::Linear), "holds no easing".into());
    lost(!holds.cuts && any(|f| f.cut), "holds no cuts: other programs may interpolate across them".into());
    let roll = if holds.roll { 0.0 } else { largest_roll_rad(track, DVec3::NEG_Y) };
    lost(
        roll > LEVEL_RAD,
        format!("holds no roll: up to {:.1} degrees relative to its up (-y) are lost", roll.to_degrees()),
    );
    if format == Format::Gltf && fov_changes(track) {
        lines.push(format!(
            "gltf animates the field of view by KHR_animation_pointer, which three.js and others ignore: there it stays \
             that of the first frame, of {}",
            fov_range(track)
        ));
    }
    lines.extend(out_of_range(format, track));
    if format == Format::Supersplat {
        lines.extend(supersplat::beyond_editors(track));
    }
    lines
}

/// A line about values that the format can hold but the program rejects or clamps.
fn out_of_range(format: Format, track: &PoseTrack) -> Option<String> {
    match format {
        Format::Lichtfeld => {
            let (low, high) = lichtfeld::FOCAL_RANGE_MM;
            let focal = |frame: &PoseFrame| frame.fov_y_rad.map(lichtfeld::focal_mm);
            let outside = track.frames.iter().filter_map(focal).any(|mm| !(low..=high).contains(&mm));
            outside.then(|| format!("lichtfeld takes focal lengths of {low} to {high} mm and clamps the others"))
        }
        Format::Supersplat if track.frames.len() > SUPERSPLAT_MAX_KEYS => {
            Some(format!("supersplat's editor takes at most {SUPERSPLAT_MAX_KEYS} keys: export at a lower frame rate"))
        }
        Format::Gltf | Format::Usd => opengl::unknown_up(format, track.up),
        Format::Blender if track.up.is_none() => Some("blender takes +z as up: the scene's up is not known".into()),
        _ => None,
    }
}

fn fov_changes(track: &PoseTrack) -> bool {
    let mut fovs = track.frames.iter().filter_map(|frame| frame.fov_y_rad);
    fovs.next().is_some_and(|first| fovs.any(|fov| (fov - first).abs() > 1e-6))
}

fn fov_range(track: &PoseTrack) -> String {
    let degrees = track.frames.iter().filter_map(|frame| frame.fov_y_rad).map(f64::to_degrees);
    let (low, high) = degrees.fold((f64::INFINITY, 0.0_f64), |(low, high), v| (low.min(v), high.max(v)));
    if high - low < 1e-6 { format!("{low:.3} degrees") } else { format!("{low:.3} to {high:.3} degrees") }
}

fn largest_roll_rad(track: &PoseTrack, up: DVec3) -> f64 {
    let Ok(level) = LevelFrame::new(up) else { return 0.0 };
    track.frames.iter().map(|frame| level.roll_rad(&frame.pose).abs()).fold(0.0, f64::max)
}
