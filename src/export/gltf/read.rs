use glam::{DAffine3, DQuat, DVec3};

use super::super::ExportError;
use super::super::json_read::{self, Node};
use super::super::opengl::{from_opengl_rotation, y_up_from_world};
use super::super::track::{PoseFrame, PoseTrack};
use super::super::which_camera::which;
use super::accessor::{item, size};
use super::channel::{Channel, blend, read_sampler, spline_fps, turn, with_times_between};
use super::constants::{BINARY_CHUNK, CUT_SECS, GLB_MAGIC, JSON_CHUNK, POINTER};
use super::nodes::{Moved, NodeTransform, chain_to, scene_up};
use super::rigid::{Bend, Rigid};
use cinesplat_files::{Limits, base64};
use cinesplat_geometry::rotation;

/// The track of the camera with a name, or of the first one, in a `.gltf` or `.glb`. `resolve` reads a file in the same
/// folder.
pub(crate) fn read(
    bytes: &[u8],
    wanted: Option<&str>,
    resolve: &dyn Fn(&str) -> Result<Vec<u8>, ExportError>,
) -> Result<PoseTrack, ExportError> {
    let (text, binary) = if bytes.starts_with(GLB_MAGIC) { chunks(bytes)? } else { (bytes, None) };
    let text = std::str::from_utf8(text).map_err(|error| ExportError::NotJson { reason: error.to_string() })?;
    let value = json_read::parse(text)?;
    let root = Node::root(&value);
    let buffers = buffers(&root, binary, resolve)?;
    let nodes = root.field("nodes", "a list of nodes")?.items()?;
    let (camera_node, others) = camera_node(&root, &nodes, wanted)?;
    let camera_idx = size(&nodes[camera_node], "camera", None)?;
    let camera = item(&root, "cameras", camera_idx)?;
    let lens = camera.field("perspective", "a perspective camera")?;
    let chain = chain_to(&nodes, camera_node);
    let channels = channels(&root, &buffers, &chain, camera_idx)?;
    let scene_up = scene_up(&nodes, &chain)?;
    let still = StaticCamera {
        nodes: chain.iter().map(|idx| NodeTransform::read(&nodes[*idx])).collect::<Result<_, _>>()?,
        fov_y_rad: lens.field("yfov", "rad")?.number()?,
        world: y_up_from_world(scene_up).conjugate(),
    };
    let up = scene_up.unwrap_or(DVec3::Y);
    let (frames, bend) = frames(&channels, &still).ok_or_else(|| nodes[camera_node].error("a scale that is not 0"))?;
    let mut unread: Vec<String> = others.into_iter().chain(bend.lines()).collect();
    if channels.num_further > 0 {
        let num = channels.num_further;
        unread.push(format!("only the first animation of a property is read (further ones of this camera: {num})"));
    }
    unread.extend(channels.spline_fps().map(|fps| format!("cubic splines are read at {fps} frames per second")));
    let aspect = lens.optional("aspectRatio").map(|aspect| aspect.number()).transpose()?.filter(|aspect| *aspect > 0.0);
    Ok(PoseTrack { stated_aspect: aspect, up: Some(up), timed: true, unread, ..PoseTrack::untimed(frames) })
}

/// The node of the camera with a name (its own or that of its lens), or of the first one, and a line about the others.
fn camera_node(root: &Node, nodes: &[Node], wanted: Option<&str>) -> Result<(usize, Option<String>), ExportError> {
    let cameras: Vec<usize> = (0..nodes.len()).filter(|idx| nodes[*idx].optional("camera").is_some()).collect();
    let name_of = |node: &Node| node.optional("name").and_then(|name| Some(name.text().ok()?.to_owned()));
    let name = |idx: &usize| name_of(&nodes[*idx]).unwrap_or_else(|| format!("node {idx}"));
    let has_lens_named = |idx: &usize| {
        let lens = size(&nodes[*idx], "camera", None).and_then(|lens| item(root, "cameras", lens));
        lens.ok().and_then(|lens| name_of(&lens)).as_deref() == wanted
    };
    let names: Vec<String> = cameras.iter().map(name).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let by_lens =
        wanted.filter(|wanted| !names.contains(wanted)).and_then(|_| cameras.iter().find(|idx| has_lens_named(idx)));
    if let Some(idx) = by_lens {
        return Ok((*idx, None));
    }
    let (place, others) = which(&names, wanted)?;
    Ok((cameras[place], others))
}

/// The JSON and the binary chunk of a `.glb`.
fn chunks(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), ExportError> {
    let (mut offset, mut json, mut binary) = (12, None, None);
    while let Some(head) = bytes.get(offset..offset + 8) {
        let len = head.first_chunk().map_or(0, |len| u32::from_le_bytes(*len)) as usize;
        let chunk = bytes.get(offset + 8..).and_then(|rest| rest.get(..len)).ok_or_else(|| ExportError::BadBytes {
            offset,
            found: format!("a chunk of {len} bytes"),
            expected: "one that ends inside the file".into(),
        })?;
        match &head[4..] {
            kind if kind == JSON_CHUNK => json = json.or(Some(chunk)),
            kind if kind == BINARY_CHUNK => binary = binary.or(Some(chunk)),
            _ => {}
        }
        offset += 8 + len;
    }
    let missing = || ExportError::BadBytes { offset: 12, found: "no JSON chunk".into(), expected: "one".into() };
    Ok((json.ok_or_else(missing)?, binary))
}

/// The buffers in order. The binary chunk is the first one without an address; no other may lack one.
fn buffers(
    root: &Node,
    binary: Option<&[u8]>,
    resolve: &dyn Fn(&str) -> Result<Vec<u8>, ExportError>,
) -> Result<Vec<Vec<u8>>, ExportError> {
    let Some(list) = root.optional("buffers") else { return Ok(Vec::new()) };
    // The binary chunk is the first buffer; another one without a uri holds nothing. Many buffers may name one file.
    let (mut found, mut num_bytes) = (Vec::new(), 0);
    for (idx, node) in list.items()?.iter().enumerate() {
        let content = match node.optional("uri") {
            Some(uri) => buffer_at(&uri, resolve)?,
            None => binary.filter(|_| idx == 0).unwrap_or_default().to_vec(),
        };
        num_bytes += content.len() as u64;
        if num_bytes > Limits::DEFAULT.array_bytes {
            return Err(node.error(format!("buffers of at most {} bytes together", Limits::DEFAULT.array_bytes)));
        }
        found.push(content);
    }
    Ok(found)
}

fn buffer_at(uri: &Node, resolve: &dyn Fn(&str) -> Result<Vec<u8>, ExportError>) -> Result<Vec<u8>, ExportError> {
    let text = uri.text()?;
    match text.strip_prefix("data:").and_then(|rest| rest.split_once(";base64,")) {
        Some((_, data)) => base64::decode(data).ok_or_else(|| uri.error("base64 data")),
        None => resolve(text),
    }
}

#[derive(Default)]
struct NodeChannels {
    translation: Option<Channel>,
    rotation: Option<Channel>,
    scale: Option<Channel>,
}

impl NodeChannels {
    fn all(&self) -> impl Iterator<Item = &Channel> {
        [&self.translation, &self.rotation, &self.scale].into_iter().flatten()
    }

    /// The animated values at a time.
    fn at(&self, time: f64) -> Moved {
        let vector = |channel: &Option<Channel>| {
            channel.as_ref().and_then(|c| c.at(time, blend)).and_then(|v| v.try_into().ok().map(DVec3::from_array))
        };
        let slerp = |a: &[f64], b: &[f64], t: f64| rotation::slerp(turn(a), turn(b), t).to_array().to_vec();
        Moved {
            position: vector(&self.translation),
            rotation: self.rotation.as_ref().and_then(|c| c.at(time, slerp)).map(|values| turn(&values)),
            scale: vector(&self.scale),
        }
    }
}

struct Channels {
    /// Those of each node from the root to the camera's.
    nodes: Vec<NodeChannels>,
    fov: Option<Channel>,
    /// Number of channels of properties that an earlier channel animates.
    num_further: usize,
}

impl Channels {
    fn all(&self) -> impl Iterator<Item = &Channel> {
        self.nodes.iter().flat_map(NodeChannels::all).chain(&self.fov)
    }

    /// The rate at which splines are read, frames per second; `None` without splines.
    fn spline_fps(&self) -> Option<f64> {
        self.all().any(Channel::is_spline).then(|| spline_fps(self.all().flat_map(Channel::times)))
    }
}

/// The first channel of each property of the camera and of the nodes above it.
fn channels(root: &Node, buffers: &[Vec<u8>], chain: &[usize], camera: usize) -> Result<Channels, ExportError> {
    let mut found =
        Channels { nodes: chain.iter().map(|_| NodeChannels::default()).collect(), fov: None, num_further: 0 };
    let Some(animations) = root.optional("animations") else { return Ok(found) };
    let pointer = format!("/cameras/{camera}/perspective/yfov");
    for animation in animations.items()? {
        let samplers = animation.field("samplers", "a list")?.items()?;
        for channel in animation.field("channels", "a list")?.items()? {
            let target = channel.field("target", "an animation target")?;
            let node = target.optional("node").and_then(|idx| idx.whole(u64::MAX).ok());
            let place = node.and_then(|node| chain.iter().position(|idx| *idx as u64 == node));
            let extension = target.optional("extensions").and_then(|extensions| extensions.optional(POINTER));
            let pointed = extension.and_then(|extension| extension.optional("pointer"));
            let path = target.field("path", "an animated property")?.text()?;
            let slot = match (path, place.and_then(|place| found.nodes.get_mut(place))) {
                ("translation", Some(node)) => &mut node.translation,
                ("rotation", Some(node)) => &mut node.rotation,
                ("scale", Some(node)) => &mut node.scale,
                ("pointer", _) if pointed.is_some_and(|text| text.text().is_ok_and(|text| text == pointer)) => {
                    &mut found.fov
                }
                _ => continue,
            };
            if slot.is_some() {
                found.num_further += 1;
                continue;
            }
            let idx = size(&channel, "sampler", None)?;
            let sampler = samplers.get(idx).ok_or_else(|| channel.error("a sampler that exists"))?;
            let keys = read_sampler(root, buffers, sampler)?;
            keys.check(path, sampler)?;
            *slot = Some(keys);
        }
    }
    Ok(found)
}

/// The camera without animation.
struct StaticCamera {
    /// The nodes from the root to the camera's.
    nodes: Vec<NodeTransform>,
    fov_y_rad: f64,
    /// The scene's own world from that of the file.
    world: DQuat,
}

/// One frame per key time of any channel, one frame without animation, and what no camera can show of its nodes;
/// `None` where the nodes shrink the camera to nothing.
fn frames(channels: &Channels, still: &StaticCamera) -> Option<(Vec<PoseFrame>, Bend)> {
    let mut times: Vec<f64> = channels.all().flat_map(Channel::times).collect();
    times.sort_by(f64::total_cmp);
    times.dedup();
    if let Some(fps) = channels.spline_fps() {
        times = with_times_between(&times, fps);
    }
    if times.is_empty() {
        times.push(0.0);
    }
    let mut bend = Bend::default();
    let mut frame = |time: f64| {
        let world = DAffine3::from_quat(still.world);
        let nodes = still.nodes.iter().zip(&channels.nodes);
        let placed = nodes.fold(world, |placed, (node, channels)| placed * node.affine(&channels.at(time)));
        let fov = channels.fov.as_ref().and_then(|c| c.at(time, blend)).and_then(|values| values.first().copied());
        let rigid = Rigid::of(placed)?;
        bend = bend.worse(rigid.bend);
        let pose = from_opengl_rotation(placed.translation, rigid.rotation);
        Some(PoseFrame { fov_y_rad: Some(fov.unwrap_or(still.fov_y_rad)), ..PoseFrame::new(time, pose) })
    };
    let mut frames: Vec<PoseFrame> = Vec::with_capacity(times.len());
    for time in times {
        // A key just before this one only holds the pose up to a cut.
        let cut = frames.pop_if(|held| time - held.time_secs < CUT_SECS).is_some();
        frames.push(PoseFrame { cut, ..frame(time)? });
    }
    Some((frames, bend))
}
