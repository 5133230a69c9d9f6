//! `shot.json`, version 1: the project's own format, which people may edit by hand.
//!
//! Enters: JSON text or a [`Shot`]. Leaves: a validated [`Shot`] or JSON text. Positions and rotations are
//! `world_from_camera` in the scene's world; angles are in degrees under keys that end in `_deg`. The reader notes
//! unknown keys and edited `euler_deg`, and rejects another `format` or `version`.

use cinesplat_files::UnknownKeys;
use glam::{DQuat, DVec3};

use super::ExportError;
use super::clearance_json;
use super::effects_json;
use super::euler_edits;
use super::json_read::{self, Node};
use super::json_write::{Json, object};
use super::lens_json;
use super::look_at;
pub use super::look_at::FindObject;
use cinesplat_geometry::{LevelAngles, LevelFrame, Pose};
use cinesplat_trajectory::Easing;
use cinesplat_trajectory::{Intent, KeyOptics, Keyframe, ModelRef, ReportLine, SceneRef, Shot};

/// Value of the `format` key.
pub(super) const FORMAT: &str = "cinesplat.shot";
const VERSION: u32 = 1;

/// Keys of the top level.
const TOP_KEYS: [&str; 14] = [
    "format",
    "version",
    "scene",
    "prompt",
    "seed",
    "model",
    "width",
    "height",
    "fps",
    "duration_secs",
    "keyframes",
    "effects",
    "report",
    "clearance",
];
const SCENE_KEYS: [&str; 3] = ["path", "sha256", "up"];
const MODEL_KEYS: [&str; 2] = ["name", "sha256"];
const KEYFRAME_KEYS: [&str; 13] = [
    "time_secs",
    "position",
    "rotation_xyzw",
    "euler_deg",
    "fov_y_deg",
    "focus_distance",
    "f_stop",
    "shutter_angle_deg",
    "lens",
    "easing",
    "cut",
    "intent",
    "look_at",
];
const EULER_KEYS: [&str; 3] = ["yaw", "pitch", "roll"];
const INTENT_KEYS: [&str; 6] = ["subjects", "size", "move", "angle", "words", "pivot"];
const REPORT_KEYS: [&str; 5] = ["clause", "wanted", "got", "met", "note"];

/// The content of a `shot.json`.
#[derive(Debug, Clone, PartialEq)]
pub struct ShotFile {
    /// The shot.
    pub shot: Shot,
    /// One line per unknown key and per edited `euler_deg`.
    pub notes: Vec<String>,
}

/// Reads a `shot.json`.
///
/// Required keys: `format`, `version`, `width`, `height`, `fps`, `duration_secs`, `keyframes`, and in a keyframe
/// `time_secs`, `position`, `rotation_xyzw`, `fov_y_deg`. `euler_deg` decides where it is more than 0.01 degrees from `rotation_xyzw`, because somebody edited it:
/// yaw about the scene's up, 0 at the first keyframe and positive to the operator's right, then pitch, positive up, then
/// roll, positive clockwise. Where the first keyframe of the file is not the one that the yaws were written for (it was
/// removed, or its quaternion replaced) and at least two keyframes agree on the old heading, yaw counts from that. An
/// unknown key becomes a note. `look_at` aims a keyframe at a point, or at the center of an object.
///
/// # Errors
/// [`ExportError::NotJson`], [`ExportError::WrongFormat`], [`ExportError::WrongVersion`]; [`ExportError::BadField`] and
/// [`ExportError::BadShot`] name the keyframe and the field.
pub fn read(text: &str) -> Result<ShotFile, ExportError> {
    read_in(text, &|_| {
        Err("a point (3 finite numbers), because no objects are given (`render` and `map` know them)".to_owned())
    })
}

/// As [`read`], with the objects that a `look_at` may name.
///
/// # Errors
/// Those of [`read`], and [`ExportError::BadField`] for the name of an object that is not found.
pub fn read_in(text: &str, find: &FindObject<'_>) -> Result<ShotFile, ExportError> {
    let value = json_read::parse(text)?;
    let root = Node::root(&value);
    check_header(&root)?;
    let keys = root.field("keyframes", "a list of keyframes")?.items()?;
    let shot = Shot {
        scene: root.optional("scene").map_or_else(|| Ok(SceneRef::default()), |node| read_scene(&node))?,
        prompt: text_or_empty(&root, "prompt")?,
        seed: root.optional("seed").map_or(Ok(0), |node| node.whole(u64::MAX))?,
        model: root.optional("model").map(|node| read_model(&node)).transpose()?,
        width: root.field("width", "a number of pixels")?.pixels()?,
        height: root.field("height", "a number of pixels")?.pixels()?,
        fps: root.field("fps", "frames per second")?.number()?,
        duration_secs: root.field("duration_secs", "seconds")?.number()?,
        keyframes: keys.iter().map(|key| read_keyframe(key, find)).collect::<Result<_, _>>()?,
        effects: root.optional("effects").map_or_else(|| Ok(Vec::new()), |node| list_of(&node, effects_json::read))?,
        report: root.optional("report").map_or_else(|| Ok(Vec::new()), |node| list_of(&node, read_report_line))?,
        clearance: None,
    };
    let mut shot = shot.validated()?;
    if let Some(node) = root.optional("clearance") {
        shot.clearance = clearance_json::read(&node, &shot)?;
    }
    for key in &mut shot.keyframes {
        // A quaternion typed with a few digits is not of unit length. One written by this program keeps its bits.
        if (key.pose.rotation.length() - 1.0).abs() > 1e-12 {
            key.pose.rotation = key.pose.rotation.normalize();
        }
    }
    let angles = keys.iter().map(read_euler).collect::<Result<Vec<_>, _>>()?;
    let mut notes = unknown_keys(&root, &keys).into_notes();
    notes.extend(euler_edits::apply(&mut shot.keyframes, &angles, shot.scene.up));
    let effects = root.optional("effects").and_then(|effects| effects.items().ok());
    notes.extend(effects.iter().flatten().flat_map(effects_json::notes));
    notes.extend(look_at::apply(&mut shot.keyframes, shot.scene.up));
    Ok(ShotFile { shot, notes })
}

/// Whether a keyframe of a `shot.json` looks at an object whose place the file does not state; `false` for another
/// text.
pub fn names_objects(text: &str) -> bool {
    let Ok(value) = json_read::parse(text) else { return false };
    let keys = Node::root(&value).optional("keyframes").and_then(|keys| keys.items().ok()).unwrap_or_default();
    keys.iter().filter_map(|key| key.optional("look_at")).any(|look_at| look_at::is_name(&look_at))
}

/// The keys that no version 1 file has. The settings of effects are free.
fn unknown_keys(root: &Node, keyframes: &[Node]) -> UnknownKeys {
    let mut unknown = UnknownKeys::default();
    root.note_unknown(&TOP_KEYS, &mut unknown);
    let clearance = root.optional("clearance");
    let failure = clearance.as_ref().and_then(|clearance| clearance.optional("fails"));
    let parts: [(Option<Node>, &[&str]); 4] = [
        (root.optional("scene"), &SCENE_KEYS),
        (root.optional("model"), &MODEL_KEYS),
        (clearance, &clearance_json::KEYS),
        (failure, &clearance_json::FAILURE_KEYS),
    ];
    for (node, known) in parts {
        node.iter().for_each(|node| node.note_unknown(known, &mut unknown));
    }
    for node in keyframes {
        node.note_unknown(&KEYFRAME_KEYS, &mut unknown);
        node.optional("lens").iter().for_each(|lens| lens.note_unknown(&lens_json::KEYS, &mut unknown));
        node.optional("euler_deg").iter().for_each(|euler| euler.note_unknown(&EULER_KEYS, &mut unknown));
        let look_at = node.optional("look_at").filter(|look_at| look_at.text().is_err() && look_at.items().is_err());
        look_at.iter().for_each(|look_at| look_at.note_unknown(&look_at::KEYS, &mut unknown));
        node.optional("intent").iter().for_each(|intent| intent.note_unknown(&INTENT_KEYS, &mut unknown));
    }
    let report = root.optional("report").and_then(|report| report.items().ok());
    report.iter().flatten().for_each(|line| line.note_unknown(&REPORT_KEYS, &mut unknown));
    unknown
}

/// The angles beside the quaternion of a keyframe.
fn read_euler(keyframe: &Node) -> Result<Option<LevelAngles>, ExportError> {
    let Some(euler) = keyframe.optional("euler_deg") else { return Ok(None) };
    let angle_rad = |name: &str| euler.field(name, "degrees")?.number().map(f64::to_radians);
    Ok(Some(LevelAngles { yaw_rad: angle_rad("yaw")?, pitch_rad: angle_rad("pitch")?, roll_rad: angle_rad("roll")? }))
}

fn check_header(root: &Node) -> Result<(), ExportError> {
    let format = root.field("format", "\"cinesplat.shot\"")?.text()?;
    if format != FORMAT {
        let expected = format!("\"{FORMAT}\"");
        return Err(ExportError::WrongFormat { found: format!("format \"{}\"", json_read::quoted(format)), expected });
    }
    let version = root.field("version", "1")?.number()?;
    if !version.total_cmp(&f64::from(VERSION)).is_eq() {
        return Err(ExportError::WrongVersion { format: FORMAT, found: version.to_string(), expected: "1" });
    }
    Ok(())
}

fn list_of<'a, T>(
    node: &Node<'a>,
    read_item: impl Fn(&Node<'a>) -> Result<T, ExportError>,
) -> Result<Vec<T>, ExportError> {
    node.items()?.iter().map(read_item).collect()
}

fn text_or_empty(node: &Node, name: &str) -> Result<String, ExportError> {
    node.optional(name).map_or(Ok(String::new()), |text| text.text().map(str::to_owned))
}

fn read_scene(node: &Node) -> Result<SceneRef, ExportError> {
    let up = node.optional("up").map(|up| {
        let unit = up.vector()?.try_normalize();
        unit.ok_or_else(|| up.error("three numbers, not all 0"))
    });
    Ok(SceneRef { path: text_or_empty(node, "path")?, sha256: text_or_empty(node, "sha256")?, up: up.transpose()? })
}

fn read_model(node: &Node) -> Result<ModelRef, ExportError> {
    Ok(ModelRef { name: text_or_empty(node, "name")?, sha256: text_or_empty(node, "sha256")? })
}

fn read_keyframe(node: &Node, find: &FindObject<'_>) -> Result<Keyframe, ExportError> {
    let rotation = DQuat::from_array(node.field("rotation_xyzw", "4 finite numbers")?.numbers()?);
    let position = node.field("position", "3 finite numbers")?.vector()?;
    Ok(Keyframe {
        time_secs: node.field("time_secs", "seconds")?.number()?,
        pose: Pose { position, rotation },
        fov_y_rad: node.field("fov_y_deg", "degrees")?.number()?.to_radians(),
        focus_distance: node.optional("focus_distance").map(|d| d.number()).transpose()?,
        optics: KeyOptics {
            f_stop: node.optional("f_stop").map(|f_stop| f_stop.number()).transpose()?,
            shutter_angle_rad: node.optional("shutter_angle_deg").map(|a| a.number()).transpose()?.map(f64::to_radians),
            lens: node.optional("lens").map(|lens| lens_json::read(&lens)).transpose()?,
        },
        easing: node.optional("easing").map_or(Ok(Easing::Smooth), |easing| easing.choice())?,
        cut: node.optional("cut").map_or(Ok(false), |cut| cut.flag())?,
        intent: read_intents(node, position, find)?,
    })
}

/// The intent of a keyframe, with what it looks at.
fn read_intents(keyframe: &Node, position: DVec3, find: &FindObject<'_>) -> Result<Option<Intent>, ExportError> {
    let intent = keyframe.optional("intent").map(|intent| read_intent(&intent)).transpose()?;
    let Some(node) = keyframe.optional("look_at") else { return Ok(intent) };
    let look_at = Some(look_at::read(&node, position, find)?);
    Ok(Some(Intent { look_at, ..intent.unwrap_or_default() }))
}

fn read_intent(node: &Node) -> Result<Intent, ExportError> {
    let subjects = node.optional("subjects").map_or_else(|| Ok(Vec::new()), |list| list_of(&list, Node::pixels))?;
    let words = node.optional("words").map(|words| -> Result<[usize; 2], ExportError> {
        let range = list_of(&words, |end| end.whole(u64::from(u32::MAX)))?;
        match range[..] {
            [from, to] if from <= to => Ok([from as usize, to as usize]),
            _ => Err(words.error("[first, end] byte offsets into the prompt")),
        }
    });
    Ok(Intent {
        subjects,
        size: node.optional("size").map(|size| size.choice()).transpose()?,
        movement: node.optional("move").map(|movement| movement.choice()).transpose()?,
        angle: node.optional("angle").map(|angle| angle.choice()).transpose()?,
        words: words.transpose()?,
        pivot: node.optional("pivot").map(|pivot| pivot.vector()).transpose()?,
        look_at: None,
    })
}

fn read_report_line(node: &Node) -> Result<ReportLine, ExportError> {
    Ok(ReportLine {
        clause: text_or_empty(node, "clause")?,
        wanted: text_or_empty(node, "wanted")?,
        // A value that was not measured is written as null.
        got: node.optional("got").map_or(Ok(f64::NAN), |got| got.number())?,
        met: node.optional("met").map_or(Ok(false), |met| met.flag())?,
        note: text_or_empty(node, "note")?,
    })
}

/// The text of a `shot.json`; ends with a line feed.
///
/// Numbers read back to the same bits, angles to within the rounding of degrees. `euler_deg` is written if the scene's
/// up is known, with a yaw of -180..180.
pub fn write(shot: &Shot) -> String {
    let eulers = euler_angles(shot);
    let keyframes = shot.keyframes.iter().zip(eulers).map(|(key, euler)| keyframe_json(key, euler));
    let mut fields = vec![
        ("format", FORMAT.into()),
        ("version", VERSION.into()),
        ("scene", scene_json(&shot.scene)),
        ("prompt", shot.prompt.as_str().into()),
        ("seed", shot.seed.into()),
    ];
    if let Some(model) = &shot.model {
        fields
            .push(("model", object([("name", model.name.as_str().into()), ("sha256", model.sha256.as_str().into())])));
    }
    fields.extend([
        ("width", shot.width.into()),
        ("height", shot.height.into()),
        ("fps", shot.fps.into()),
        ("duration_secs", shot.duration_secs.into()),
        ("keyframes", Json::list(keyframes)),
        ("effects", Json::list(shot.effects.iter().map(effects_json::write))),
        ("report", Json::list(shot.report.iter().map(report_json))),
    ]);
    fields.extend(shot.clearance.as_ref().map(|proof| ("clearance", clearance_json::write(proof, shot))));
    Json::Object(fields.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()).pretty()
}

/// Yaw (0 at the first key), pitch and roll of every key; `None` for all without an up.
fn euler_angles(shot: &Shot) -> Vec<Option<LevelAngles>> {
    let level = shot.scene.up.and_then(|up| LevelFrame::new(up).ok());
    let Some(level) = level else { return vec![None; shot.keyframes.len()] };
    level_angles(&level, shot.keyframes.iter().map(|key| key.pose.rotation)).into_iter().map(Some).collect()
}

/// Angles of rotations in a level frame, with yaw relative to the first and in -pi..pi.
pub(crate) fn level_angles(level: &LevelFrame, rotations: impl Iterator<Item = DQuat>) -> Vec<LevelAngles> {
    let mut angles: Vec<LevelAngles> = rotations.map(|rotation| level.angles(rotation)).collect();
    let start = angles.first().map_or(0.0, |first| first.yaw_rad);
    for angle in &mut angles {
        let (sin, cos) = (angle.yaw_rad - start).sin_cos();
        angle.yaw_rad = sin.atan2(cos);
    }
    angles
}

fn scene_json(scene: &SceneRef) -> Json {
    let up = scene.up.map(Json::from);
    object([("path", scene.path.as_str().into()), ("sha256", scene.sha256.as_str().into()), ("up", up.into())])
}

fn keyframe_json(key: &Keyframe, euler: Option<LevelAngles>) -> Json {
    let mut fields = vec![
        ("time_secs", key.time_secs.into()),
        ("position", key.pose.position.into()),
        ("rotation_xyzw", key.pose.rotation.into()),
    ];
    if let Some(angles) = euler {
        let degrees = |rad: f64| Json::from((rad.to_degrees() * 1e4).round() / 1e4 + 0.0);
        let euler = [("yaw", angles.yaw_rad), ("pitch", angles.pitch_rad), ("roll", angles.roll_rad)];
        fields.push(("euler_deg", object(euler.map(|(name, rad)| (name, degrees(rad))))));
    }
    fields.extend([("fov_y_deg", key.fov_y_rad.to_degrees().into()), ("focus_distance", key.focus_distance.into())]);
    fields.extend(key.optics.f_stop.map(|f_stop| ("f_stop", f_stop.into())));
    fields.extend(key.optics.shutter_angle_rad.map(|angle| ("shutter_angle_deg", angle.to_degrees().into())));
    fields.extend(key.optics.lens.map(|lens| ("lens", lens_json::write(&lens))));
    fields.extend([("easing", key.easing.as_ref().into()), ("cut", key.cut.into())]);
    if let Some(intent) = &key.intent {
        fields.extend(intent.look_at.as_ref().map(|target| ("look_at", look_at::write(target))));
        if *intent != (Intent { look_at: intent.look_at.clone(), ..Intent::default() }) {
            fields.push(("intent", intent_json(intent)));
        }
    }
    Json::Object(fields.into_iter().map(|(name, value)| (name.to_owned(), value)).collect())
}

fn intent_json(intent: &Intent) -> Json {
    let mut fields = vec![("subjects".to_owned(), Json::list(intent.subjects.iter().copied()))];
    let names = [
        ("size", intent.size.map(<&str>::from)),
        ("move", intent.movement.map(<&str>::from)),
        ("angle", intent.angle.map(<&str>::from)),
    ];
    fields.extend(names.into_iter().filter_map(|(field, name)| Some((field.to_owned(), name?.into()))));
    fields.extend(intent.words.map(|words| ("words".to_owned(), Json::list(words))));
    fields.extend(intent.pivot.map(|pivot| ("pivot".to_owned(), pivot.into())));
    Json::Object(fields)
}

fn report_json(line: &ReportLine) -> Json {
    object([
        ("clause", line.clause.as_str().into()),
        ("wanted", line.wanted.as_str().into()),
        ("got", line.got.into()),
        ("met", line.met.into()),
        ("note", line.note.as_str().into()),
    ])
}
