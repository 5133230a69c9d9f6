//! Recordings of ROS: bags of ROS 1 (version 2.0) and MCAP files of either ROS.
//!
//! Enters: the bytes of a recording and the name of a topic. Leaves: the poses of its messages with the times of their
//! headers. The bodies of ROS have z up in the world; a body counts as a camera with OpenCV axes, which a note says.
//! References: <http://wiki.ros.org/Bags/Format/2.0>, <https://mcap.dev/spec>, REP 103.

mod bag;
mod lz4;
mod mcap;
mod message;
mod transforms;

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};

use cinesplat_files::Limits;
use glam::DVec3;

use super::ExportError;
use super::pose_lines::unit_pose;
use super::track::{PoseFrame, PoseTrack};
use message::{Kind, Stamped, Topic};
use transforms::{Asked, FRAMES_MARK, Links, frame_name};

/// Between the name of a recording and a topic.
const TOPIC_MARK: char = '#';

/// The name of a recording and of its topic in `NAME#TOPIC`.
pub(super) fn split_topic(name: &str) -> Option<(&str, &str)> {
    name.rsplit_once(TOPIC_MARK).filter(|(file, topic)| !file.is_empty() && !topic.is_empty())
}

/// Whether a file is a recording that is read.
pub(super) fn is_recording(bytes: &[u8]) -> bool {
    bytes.starts_with(bag::MAGIC) || bytes.starts_with(mcap::MAGIC)
}

/// A path of a recording: its topic, the frame that its poses are in, and the body where the messages name it.
type PathKey = (String, String, Option<String>);

/// The paths of a recording.
#[derive(Default)]
struct Found {
    paths: BTreeMap<PathKey, (Kind, Vec<PoseFrame>)>,
    num_poses: usize,
}

/// The poses of a topic; without a name those of the only topic with poses. A topic of transforms is named with two
/// frames, as `/tf:map.base_link`, and so is one that holds several bodies or frames. The frames of transforms may be
/// any two that links join, over static ones too.
///
/// # Errors
/// [`ExportError::WrongFormat`] for a file that is no recording, [`ExportError::BadField`] without such a topic, for a
/// pose that is none and for too many poses, [`ExportError::BadBytes`] for a damaged file,
/// [`ExportError::NotReadable`] for packed parts without a reader.
pub(super) fn read(bytes: &[u8], topic: Option<&str>) -> Result<PoseTrack, ExportError> {
    let is_of_topic = |name: &str| topic.is_none_or(|asked| is_asked(asked, name));
    let is_path = |key: &PathKey| topic.is_none_or(|asked| asked == key.0 || asked == long_name(key));
    let mut paths = visit(bytes, &is_of_topic, &is_path)?.by_name(topic);
    let mut unread = Vec::new();
    // Single poses are mounts of sensors, and no path.
    paths.retain(|name, (_, frames)| frames.len() > 1 || topic == Some(name.as_str()));
    let chosen = match topic {
        Some(name) => match paths.remove_entry(name) {
            None => joined(bytes, name)?.map(|(path, lines)| {
                unread = lines;
                path
            }),
            found => found,
        },
        None if paths.len() == 1 => paths.pop_first(),
        None => None,
    };
    let Some((name, (body, frames))) = chosen else { return Err(no_such_topic(bytes, topic, paths)) };
    let body = body.map_or_else(|| "the body".to_owned(), |name| format!("the body {name}"));
    let note = format!("{name}: the axes of {body} count as those of a camera: x right, y down, z forward");
    unread.push(note);
    Ok(PoseTrack { timed: true, up: Some(DVec3::Z), unread, ..PoseTrack::untimed(frames) })
}

/// The body and the poses of each path, by the name that asks for it.
type Named = BTreeMap<String, (Option<String>, Vec<PoseFrame>)>;

/// The error that lists the topics of a recording; `paths` are those of the topic that is asked for.
fn no_such_topic(bytes: &[u8], topic: Option<&str>, mut paths: Named) -> ExportError {
    if topic.is_some() && paths.is_empty() {
        paths = match visit(bytes, &|_| true, &|_| true) {
            Ok(found) => found.by_name(None),
            Err(error) => return error,
        };
        paths.retain(|_, (_, frames)| frames.len() > 1);
    }
    if paths.is_empty() {
        return ExportError::NoPoses;
    }
    let names: Vec<String> = paths.iter().map(|(name, (_, frames))| format!("{name} ({})", frames.len())).collect();
    ExportError::BadField {
        place: "topic (RECORDING#TOPIC)".to_owned(),
        found: topic.unwrap_or("none").to_owned(),
        expected: format!("one of {}", names.join(", ")),
    }
}

/// Whether a name asks for a topic, alone or with frames.
fn is_asked(asked: &str, topic: &str) -> bool {
    asked.strip_prefix(topic).is_some_and(|rest| rest.is_empty() || rest.starts_with(FRAMES_MARK))
}

/// A path with its name.
type NamedPath = (String, (Option<String>, Vec<PoseFrame>));

/// The poses between two frames that several transforms join, with lines on those left out; `None` without a way. Only
/// the links on the way are read.
fn joined(bytes: &[u8], name: &str) -> Result<Option<(NamedPath, Vec<String>)>, ExportError> {
    let Some(asked) = Asked::new(name) else { return Ok(None) };
    let is_of_topics = |topic: &str| topic == asked.topic || topic == asked.static_topic;
    let keys = RefCell::new(BTreeSet::new());
    let note = |key: &PathKey| {
        if let Some(pair) = frames_of(key) {
            keys.borrow_mut().insert((pair, key.0 == asked.static_topic));
        }
        false
    };
    visit(bytes, &is_of_topics, &note)?;
    let mut all = Links::default();
    keys.take().into_iter().for_each(|(pair, is_static)| all.add(pair, is_static, Vec::new()));
    let Some(way) = all.between(asked)? else { return Ok(None) };
    let on_way: BTreeSet<(&str, &str)> = way.links().collect();
    let is_on_way =
        |key: &PathKey| key.2.as_ref().is_some_and(|child| on_way.contains(&(frame_name(&key.1), frame_name(child))));
    let mut links = Links::default();
    for (key, (kind, frames)) in visit(bytes, &is_of_topics, &is_on_way)?.paths {
        if let (Kind::Transforms, Some(pair)) = (kind, frames_of(&key)) {
            links.add(pair, key.0 == asked.static_topic, frames);
        }
    }
    let Some(way) = links.between(asked)? else { return Ok(None) };
    let (frames, lines) = way.poses(name)?;
    Ok(Some(((name.to_owned(), (Some(way.child.to_owned()), frames)), lines)))
}

/// The frames of a path with a body: the one above and the one below.
fn frames_of((_, frame, child): &PathKey) -> Option<[String; 2]> {
    Some([frame_name(frame).to_owned(), frame_name(child.as_ref()?).to_owned()])
}

/// Whether a path is read.
type IsPath<'a> = dyn Fn(&PathKey) -> bool + 'a;

/// The paths of the topics that `is_read` chooses; of them those that `is_path` chooses.
fn visit(bytes: &[u8], is_read: &dyn Fn(&str) -> bool, is_path: &IsPath<'_>) -> Result<Found, ExportError> {
    let mut found = Found::default();
    let mut take = |topic: &Topic, message: &[u8]| {
        if !is_read(&topic.name) {
            return Ok(());
        }
        let in_topic = |error| ExportError::InFile { name: topic.name.clone(), error: Box::new(error) };
        let poses = message::read(topic.kind, topic.encoding, message).map_err(in_topic)?;
        poses.into_iter().try_for_each(|pose| found.add(topic, pose, is_path))
    };
    if bytes.starts_with(bag::MAGIC) {
        bag::visit(bytes, &mut take)?;
    } else if bytes.starts_with(mcap::MAGIC) {
        mcap::visit(bytes, &mut take)?;
    } else {
        let expected = "a bag of ROS 1 (version 2.0) or an MCAP file".to_owned();
        return Err(ExportError::WrongFormat { found: "no recording of ROS".to_owned(), expected });
    }
    Ok(found)
}

impl Found {
    /// Adds a pose. One that is none is an error, unless other frames of its topic are asked for.
    fn add(&mut self, topic: &Topic, stamped: Stamped, is_path: &IsPath<'_>) -> Result<(), ExportError> {
        let Stamped { time_secs, frame, child, position, rotation } = stamped;
        let key = (topic.name.clone(), frame, child);
        if !is_path(&key) {
            return Ok(());
        }
        let pose = unit_pose(position, rotation).filter(|pose| pose.position.is_finite());
        let pose = pose.ok_or_else(|| ExportError::BadField {
            place: format!("{} at {time_secs} s", topic.name),
            found: format!("the pose {position}, {rotation}"),
            expected: "finite numbers and a unit quaternion".to_owned(),
        })?;
        self.num_poses += 1;
        let limit = Limits::DEFAULT.poses;
        if self.num_poses > limit {
            let (found, expected) = ("more".to_owned(), format!("at most {limit}"));
            return Err(ExportError::BadField { place: "camera poses".to_owned(), found, expected });
        }
        let (_, frames) = self.paths.entry(key).or_insert_with(|| (topic.kind, Vec::new()));
        frames.push(PoseFrame::new(time_secs, pose));
        Ok(())
    }

    /// The paths by name: transforms, paths that share a topic, and one that is `asked` for so with their frames.
    fn by_name(self, asked: Option<&str>) -> Named {
        let mut num_paths = BTreeMap::<String, usize>::new();
        for (topic, ..) in self.paths.keys() {
            *num_paths.entry(topic.clone()).or_default() += 1;
        }
        let named = |(key, (kind, frames)): (PathKey, (Kind, Vec<PoseFrame>))| {
            let long = long_name(&key);
            let is_alone = kind != Kind::Transforms && num_paths.get(&key.0) == Some(&1);
            let name = if is_alone && asked != Some(long.as_str()) { key.0.clone() } else { long };
            (name, (key.2, frames))
        };
        self.paths.into_iter().map(named).collect()
    }
}

/// The name of a path with its frames.
fn long_name((topic, frame, child): &PathKey) -> String {
    let child = child.as_ref().map_or_else(String::new, |child| format!(".{child}"));
    format!("{topic}{FRAMES_MARK}{frame}{child}")
}
