use std::fmt::Write as _;

use glam::{DQuat, DVec3};

use super::super::columns::joined;
use super::super::opengl::{opengl_rotation, y_up_from_world};
use super::super::track::{DEFAULT_FPS, DEFAULT_SIZE_PX, PoseFrame, PoseTrack, fov_y_or_default};
use cinesplat_geometry::rotation;

/// Time from the sample that holds the pose before a cut to the cut, time codes.
pub(super) const HOLD_CODES: f64 = 1e-3;
/// Height of the film back, tenths of a scene unit: 24 mm, full frame.
const FILM_HEIGHT: f64 = 0.24;

/// Frames with their time codes.
type Samples<'a> = Vec<(f64, &'a PoseFrame)>;

pub(crate) fn write(track: &PoseTrack) -> String {
    let fps = track.fps.unwrap_or(DEFAULT_FPS);
    let (width, height) = track.size_px.unwrap_or(DEFAULT_SIZE_PX);
    let samples = samples_with_holds(track, fps);
    let end = (track.duration_secs() * fps - 1.0).max(samples.last().map_or(0.0, |(code, _)| *code));
    let [x, y, z, w] = y_up_from_world(track.up).to_array();
    let up = track.up.map_or_else(String::new, |up| {
        format!("    customLayerData = {{\n        double3 cinesplat_world_up = {}\n    }}\n", vector(up))
    });
    let film_width = FILM_HEIGHT * track.aspect();
    let camera = camera_samples(&samples);
    format!(
        r#"#usda 1.0
(
{up}    defaultPrim = "World"
    metersPerUnit = 1
    upAxis = "Y"
    startTimeCode = 0
    endTimeCode = {end}
    timeCodesPerSecond = {fps}
    framesPerSecond = {fps}
)

def Xform "World"
{{
    quatd xformOp:orient = ({w}, {x}, {y}, {z})
    uniform token[] xformOpOrder = ["xformOp:orient"]

    def Camera "Camera"
    {{
        token projection = "perspective"
        float2 clippingRange = (0.001, 100000)
        float horizontalAperture = {film_width}
        float verticalAperture = {FILM_HEIGHT}
{camera}        uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:orient"]
    }}
}}

def Scope "Render"
{{
    def RenderSettings "Settings"
    {{
        rel camera = </World/Camera>
        int2 resolution = ({width}, {height})
    }}
}}
"#
    )
}

fn camera_samples(samples: &Samples) -> String {
    let turns: Vec<DQuat> = samples.iter().map(|(_, frame)| opengl_rotation(&frame.pose)).collect();
    let turns = rotation::aligned(&turns);
    let mut out = String::new();
    let mut attribute = |name: &str, values: Vec<(f64, String)>| {
        if !values.is_empty() {
            let _ = writeln!(out, "        {name}.timeSamples = {{");
            for (code, value) in values {
                let _ = writeln!(out, "            {code}: {value},");
            }
            out.push_str("        }\n");
        }
    };
    let focal = |frame: &PoseFrame| FILM_HEIGHT / 2.0 / (fov_y_or_default(frame) / 2.0).tan();
    attribute("float focalLength", samples.iter().map(|(code, frame)| (*code, focal(frame).to_string())).collect());
    let focus = samples.iter().filter_map(|(code, frame)| Some((*code, frame.focus_distance?.to_string())));
    attribute("float focusDistance", focus.collect());
    let positions = samples.iter().map(|(code, frame)| (*code, vector(frame.pose.position)));
    attribute("double3 xformOp:translate", positions.collect());
    let quaternion = |turn: &DQuat| format!("({})", joined([turn.w, turn.x, turn.y, turn.z], ", "));
    let turns = samples.iter().zip(&turns).map(|((code, _), turn)| (*code, quaternion(turn)));
    attribute("quatd xformOp:orient", turns.collect());
    out
}

fn vector(v: DVec3) -> String {
    format!("({})", joined(v.to_array(), ", "))
}

/// Frames with their time codes, plus a sample just before each cut that holds the pose up to it.
fn samples_with_holds(track: &PoseTrack, fps: f64) -> Samples<'_> {
    let mut samples: Samples = Vec::with_capacity(track.frames.len());
    for (secs, frame) in track.since_start() {
        // Frames of a film are at whole time codes, which k / fps * fps may miss by an ulp.
        let code = secs * fps;
        let code = if (code - code.round()).abs() < 1e-9 { code.round() } else { code };
        if let Some((_, before)) = samples.last().copied().filter(|_| frame.cut) {
            samples.push((code - HOLD_CODES, before));
        }
        samples.push((code, frame));
    }
    samples
}
