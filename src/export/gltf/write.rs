use glam::DQuat;

use super::super::json_write::{Json, object};
use super::super::opengl::{opengl_rotation, y_up_from_world};
use super::super::track::{PoseFrame, PoseTrack, fov_y_or_default};
use super::accessor::{ElementType, FLOAT};
use super::constants::{BINARY_CHUNK, GLB_MAGIC, JSON_CHUNK, POINTER};
use cinesplat_files::base64;
use cinesplat_geometry::rotation;

/// Near and far plane over the largest distance of the path from the origin.
const CLIP_FACTORS: (f64, f64) = (1e-3, 1e3);

/// The `.gltf` text, with its numbers as a data URI.
pub(crate) fn write_text(track: &PoseTrack) -> String {
    document(track, |bytes| Some(format!("data:application/octet-stream;base64,{}", base64::encode(bytes)))).0
}

/// The `.glb` bytes.
pub(crate) fn write_binary(track: &PoseTrack) -> Vec<u8> {
    let (document, bytes) = document(track, |_| None);
    let mut json = document.into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let binary_len = if bytes.is_empty() { 0 } else { 8 + bytes.len() };
    let mut out = GLB_MAGIC.to_vec();
    out.extend(2_u32.to_le_bytes());
    out.extend(((12 + 8 + json.len() + binary_len) as u32).to_le_bytes());
    for (kind, chunk) in [(JSON_CHUNK, &json), (BINARY_CHUNK, &bytes)] {
        if !chunk.is_empty() {
            out.extend((chunk.len() as u32).to_le_bytes());
            out.extend(kind);
            out.extend(chunk);
        }
    }
    out
}

/// The JSON document and the bytes of its only buffer: a multiple of 4, none for a still camera.
fn document(track: &PoseTrack, uri: impl Fn(&[u8]) -> Option<String>) -> (String, Vec<u8>) {
    let mut buffer = Buffer::default();
    let animation = (track.frames.len() > 1).then(|| animation(track, &mut buffer));
    let zooms = animation.as_ref().is_some_and(|(_, zooms)| *zooms);
    let mut fields = vec![("asset", object([("version", "2.0".into()), ("generator", "cinesplat".into())]))];
    if zooms {
        fields.push(("extensionsUsed", Json::list([POINTER])));
    }
    fields.extend([
        ("scene", 0_u32.into()),
        ("scenes", Json::list([object([("nodes", Json::list([0_u32]))])])),
        ("nodes", Json::list([world_node(track), camera_node(track)])),
        ("cameras", Json::list([camera(track)])),
    ]);
    if let Some((animation, _)) = animation {
        let mut fields_of_buffer = vec![("byteLength".to_owned(), buffer.bytes.len().into())];
        fields_of_buffer.extend(uri(&buffer.bytes).map(|uri| ("uri".to_owned(), uri.as_str().into())));
        fields.extend([
            ("animations", Json::list([animation])),
            ("accessors", Json::List(buffer.accessors)),
            ("bufferViews", Json::List(buffer.views)),
            ("buffers", Json::list([Json::Object(fields_of_buffer)])),
        ]);
    }
    let fields = fields.into_iter().map(|(name, value)| (name.to_owned(), value)).collect();
    (Json::Object(fields).pretty(), buffer.bytes)
}

/// The node that rotates the scene's world to +y up.
fn world_node(track: &PoseTrack) -> Json {
    let mut fields = vec![
        ("name".to_owned(), "scene".into()),
        ("rotation".to_owned(), y_up_from_world(track.up).into()),
        ("children".to_owned(), Json::list([1_u32])),
    ];
    if let Some(up) = track.up {
        fields.push(("extras".to_owned(), object([("cinesplat_world_up", up.into())])));
    }
    Json::Object(fields)
}

fn camera_node(track: &PoseTrack) -> Json {
    let mut fields = vec![("name".to_owned(), "camera".into()), ("camera".to_owned(), 0_u32.into())];
    if let Some(first) = track.frames.first() {
        fields.push(("translation".to_owned(), first.pose.position.into()));
        fields.push(("rotation".to_owned(), opengl_rotation(&first.pose).into()));
    }
    Json::Object(fields)
}

fn camera(track: &PoseTrack) -> Json {
    let extent = track.frames.iter().map(|frame| frame.pose.position.length()).fold(1.0, f64::max);
    let perspective = object([
        ("yfov", track.frames.first().map_or(1.0, fov_y_or_default).into()),
        ("aspectRatio", track.aspect().into()),
        ("znear", (extent * CLIP_FACTORS.0).into()),
        ("zfar", (extent * CLIP_FACTORS.1).into()),
    ]);
    object([("name", "camera".into()), ("type", "perspective".into()), ("perspective", perspective)])
}

/// The animation and whether it changes the field of view.
fn animation(track: &PoseTrack, buffer: &mut Buffer) -> (Json, bool) {
    let keys = keys_with_holds(track);
    let rotations: Vec<DQuat> = keys.iter().map(|(_, frame)| opengl_rotation(&frame.pose)).collect();
    let times = buffer.push(ElementType::Scalar, keys.iter().map(|(secs, _)| *secs), true);
    let positions = keys.iter().flat_map(|(_, frame)| frame.pose.position.as_vec3().to_array());
    let translation = buffer.push(ElementType::Vec3, positions, false);
    let turns = rotation::aligned(&rotations).into_iter().flat_map(|turn| turn.as_quat().normalize().to_array());
    let rotation = buffer.push(ElementType::Vec4, turns, false);
    let fov = |(_, frame): &(f32, &PoseFrame)| fov_y_or_default(frame) as f32;
    let zooms = keys.windows(2).any(|pair| fov(&pair[0]).to_bits() != fov(&pair[1]).to_bits());
    let mut outputs = vec![(translation, Property::Translation), (rotation, Property::Rotation)];
    if zooms {
        outputs.push((buffer.push(ElementType::Scalar, keys.iter().map(fov), false), Property::FieldOfView));
    }
    let sampler = |output: usize| {
        object([("input", times.into()), ("interpolation", "LINEAR".into()), ("output", output.into())])
    };
    let samplers = Json::list(outputs.iter().map(|(output, _)| sampler(*output)));
    let channels = outputs.iter().enumerate().map(|(idx, (_, property))| channel(idx, *property));
    (object([("name", "camera".into()), ("samplers", samplers), ("channels", Json::list(channels))]), zooms)
}

/// An animated property of the camera.
#[derive(Debug, Clone, Copy)]
enum Property {
    Translation,
    Rotation,
    FieldOfView,
}

fn channel(sampler: usize, property: Property) -> Json {
    let of_node = |path: &str| object([("node", 1_u32.into()), ("path", path.into())]);
    let target = match property {
        Property::Translation => of_node("translation"),
        Property::Rotation => of_node("rotation"),
        Property::FieldOfView => {
            let pointer = object([("pointer", "/cameras/0/perspective/yfov".into())]);
            object([("path", "pointer".into()), ("extensions", object([(POINTER, pointer)]))])
        }
    };
    object([("sampler", sampler.into()), ("target", target)])
}

/// Keys with strictly increasing f32 times, plus a key just before each cut that holds the pose up to it.
fn keys_with_holds(track: &PoseTrack) -> Vec<(f32, &PoseFrame)> {
    let mut keys: Vec<(f32, &PoseFrame)> = Vec::with_capacity(track.frames.len());
    for (secs, frame) in track.since_start() {
        let mut time = secs as f32;
        if let Some((last, before)) = keys.last().copied() {
            if frame.cut {
                time = time.max(last.next_up().next_up());
                keys.push((time.next_down(), before));
            } else {
                time = time.max(last.next_up());
            }
        }
        keys.push((time, frame));
    }
    keys
}

/// The bytes of a buffer, with its views and accessors.
#[derive(Default)]
struct Buffer {
    bytes: Vec<u8>,
    views: Vec<Json>,
    accessors: Vec<Json>,
}

impl Buffer {
    /// Appends values and returns the index of their accessor. Key times require bounds.
    fn push(&mut self, element_type: ElementType, values: impl Iterator<Item = f32>, with_bounds: bool) -> usize {
        let (start, view) = (self.bytes.len(), self.views.len());
        let (mut low, mut high) = (f32::INFINITY, f32::NEG_INFINITY);
        for value in values {
            (low, high) = (low.min(value), high.max(value));
            self.bytes.extend(value.to_le_bytes());
        }
        let len = self.bytes.len() - start;
        self.views.push(object([("buffer", 0_u32.into()), ("byteOffset", start.into()), ("byteLength", len.into())]));
        let mut fields = vec![
            ("bufferView".to_owned(), view.into()),
            ("componentType".to_owned(), FLOAT.into()),
            ("count".to_owned(), (len / 4 / element_type.width()).into()),
            ("type".to_owned(), <&str>::from(element_type).into()),
        ];
        if with_bounds {
            fields.push(("min".to_owned(), Json::list([f64::from(low)])));
            fields.push(("max".to_owned(), Json::list([f64::from(high)])));
        }
        self.accessors.push(Json::Object(fields));
        self.accessors.len() - 1
    }
}
