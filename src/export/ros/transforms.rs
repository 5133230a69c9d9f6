//! Transforms between two frames that several links join, as `/tf:map.camera` over map, odom, base and camera.
//!
//! Enters: the links of a topic of transforms and of its topic of static ones. Leaves: the child's poses in the parent,
//! at the times of the link with the most transforms. As in tf2, positions between two transforms lie on a line,
//! rotations turn at constant speed, and nothing is said of times before the first and after the last transform of a
//! link.

use std::collections::BTreeMap;

use cinesplat_geometry::Pose;
use glam::{DQuat, DVec3};

use crate::ExportError;
use crate::track::PoseFrame;

/// The topic of static transforms, unless another is named.
const STATIC_TOPIC: &str = "/tf_static";
/// Between the name of a topic and the two frames of a transform, and between these.
pub(super) const FRAMES_MARK: char = ':';
const CHILD_MARK: char = '.';
/// Most links between two frames.
const MAX_LINKS: usize = 1000;

/// Frames that are asked for: `TOPIC:PARENT.CHILD`, and `:STATIC_TOPIC` where that has another name than usual.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Asked<'a> {
    pub(super) topic: &'a str,
    pub(super) static_topic: &'a str,
    /// The frames; they may hold dots of their own.
    frames: &'a str,
}

impl<'a> Asked<'a> {
    /// The frames that a name asks for; `None` for the name of a topic alone.
    pub(super) fn new(name: &'a str) -> Option<Self> {
        let (topic, rest) = name.split_once(FRAMES_MARK)?;
        let named = rest.rsplit_once(FRAMES_MARK).filter(|(_, topic)| topic.starts_with('/'));
        let (frames, static_topic) = named.unwrap_or((rest, STATIC_TOPIC));
        Some(Self { topic, static_topic, frames })
    }
}

/// The name of a frame without a slash before it, as in tf2.
pub(super) fn frame_name(name: &str) -> &str {
    name.strip_prefix('/').unwrap_or(name)
}

/// The way between two frames: the links from the child up to the frame where both meet, and those from the parent.
pub(super) struct Way<'a> {
    pub(super) child: &'a str,
    up: Vec<&'a Link>,
    down: Vec<&'a Link>,
}

/// The poses of a frame in the one above it, in order of time. Static ones hold at all times.
struct Link {
    parent: String,
    child: String,
    is_static: bool,
    frames: Vec<PoseFrame>,
}

/// The links by the frame below them.
#[derive(Default)]
pub(super) struct Links(BTreeMap<String, Vec<Link>>);

impl Links {
    /// Adds the poses of a frame in the one above it.
    pub(super) fn add(&mut self, [parent, child]: [String; 2], is_static: bool, mut frames: Vec<PoseFrame>) {
        frames.sort_by(|a, b| a.time_secs.total_cmp(&b.time_secs));
        let links = self.0.entry(child.clone()).or_default();
        match links.iter_mut().find(|link| link.parent == parent) {
            // Of a link that is on both topics the transforms with times count.
            Some(link) if link.is_static => *link = Link { parent, child, is_static, frames },
            Some(_) => {}
            None => links.push(Link { parent, child, is_static, frames }),
        }
    }

    /// The way between the frames; `None` where no links join them.
    ///
    /// # Errors
    /// [`ExportError::BadField`] for a frame on the way with several frames above it.
    pub(super) fn between<'a>(&'a self, asked: Asked<'a>) -> Result<Option<Way<'a>>, ExportError> {
        for (dot, _) in asked.frames.match_indices(CHILD_MARK) {
            let (parent, child) = (frame_name(&asked.frames[..dot]), frame_name(&asked.frames[dot + 1..]));
            let (up_from_child, up_from_parent) = (self.upwards(child)?, self.upwards(parent)?);
            let tops = up_from_child.iter().position(|(frame, _)| up_from_parent.iter().any(|(top, _)| top == frame));
            let Some(num_up) = tops else { continue };
            let top = up_from_child[num_up].0;
            let below = |way: &[(&str, Option<&'_ Link>)]| way.iter().take_while(|(frame, _)| *frame != top).count();
            let num_down = below(&up_from_parent);
            let up: Vec<&Link> = up_from_child[..num_up].iter().filter_map(|(_, link)| *link).collect();
            let down: Vec<&Link> = up_from_parent[..num_down].iter().filter_map(|(_, link)| *link).collect();
            if up.len() + down.len() > 0 {
                return Ok(Some(Way { child, up, down }));
            }
        }
        Ok(None)
    }

    /// A frame and those above it, each with the link to the next.
    fn upwards<'a>(&'a self, frame: &'a str) -> Result<Vec<(&'a str, Option<&'a Link>)>, ExportError> {
        let (mut way, mut at) = (Vec::new(), frame);
        while let Some(links) = self.0.get(at) {
            let [link] = links.as_slice() else {
                let parents: Vec<&str> = links.iter().map(|link| link.parent.as_str()).collect();
                let (place, found) = (format!("the frame {at}"), format!("it below {}", parents.join(", ")));
                return Err(ExportError::BadField { place, found, expected: "one frame above it".to_owned() });
            };
            if way.len() > MAX_LINKS {
                let (place, found) = (format!("the frame {frame}"), format!("over {MAX_LINKS} frames above it"));
                return Err(ExportError::BadField { place, found, expected: "transforms without a circle".to_owned() });
            }
            way.push((at, Some(link)));
            at = &link.parent;
        }
        way.push((at, None));
        Ok(way)
    }
}

impl Way<'_> {
    /// The frames of each link: the one above, and the one below.
    pub(super) fn links(&self) -> impl Iterator<Item = (&str, &str)> {
        self.up.iter().chain(&self.down).map(|link| (link.parent.as_str(), link.child.as_str()))
    }

    /// The poses of the child in the parent, and a line per link that is not known at all times.
    ///
    /// # Errors
    /// [`ExportError::BadField`] at `name` without a time at which all links are known.
    pub(super) fn poses(&self, name: &str) -> Result<(Vec<PoseFrame>, Vec<String>), ExportError> {
        let links = || self.up.iter().chain(&self.down);
        // The first of those with the most transforms.
        let busiest = links().filter(|link| !link.is_static).rev().max_by_key(|link| link.frames.len());
        let busiest = busiest.or_else(|| links().next());
        let times: Vec<f64> = busiest.iter().flat_map(|link| &link.frames).map(|frame| frame.time_secs).collect();
        let (mut frames, mut num_lost) = (Vec::new(), vec![0_usize; links().count()]);
        for time_secs in times.iter().copied() {
            if let Some(lost) = links().position(|link| link.at(time_secs).is_none()) {
                num_lost[lost] += 1;
            } else if let (Some(child), Some(parent)) = (top_from(&self.up, time_secs), top_from(&self.down, time_secs))
            {
                frames.push(PoseFrame::new(time_secs, parent.inverse().compose(&child)));
            }
        }
        let lost = links().zip(num_lost).filter(|(_, num)| *num > 0);
        let lines: Vec<String> =
            lost.map(|(link, num)| format!("{num} of {} poses left out: {}", times.len(), link.coverage())).collect();
        if frames.is_empty() {
            let expected = "times at which all transforms on the way are known".to_owned();
            return Err(ExportError::BadField { place: name.to_owned(), found: lines.join(", "), expected });
        }
        Ok((frames, lines))
    }
}

/// The pose of the frame at the foot of links in the one above them all; `None` at a time that one is not known at.
fn top_from(links: &[&Link], time_secs: f64) -> Option<Pose> {
    let start = Pose::new(DVec3::ZERO, DQuat::IDENTITY);
    links.iter().try_fold(start, |pose, link| Some(link.at(time_secs)?.compose(&pose)))
}

impl Link {
    /// The times that it is known at.
    fn coverage(&self) -> String {
        let [first, last] = [self.frames.first(), self.frames.last()].map(|f| f.map_or(0.0, |f| f.time_secs));
        format!("{} <- {} is known from {first} to {last} s only", self.parent, self.child)
    }

    /// The pose at a time; `None` before the first and after the last.
    fn at(&self, time_secs: f64) -> Option<Pose> {
        if self.is_static {
            return self.frames.last().map(|frame| frame.pose);
        }
        let after = self.frames.partition_point(|frame| frame.time_secs <= time_secs);
        let from = self.frames.get(after.checked_sub(1)?)?;
        let Some(to) = self.frames.get(after) else {
            return (from.time_secs >= time_secs).then_some(from.pose);
        };
        let t = (time_secs - from.time_secs) / (to.time_secs - from.time_secs);
        Some(from.pose.between(&to.pose, t))
    }
}
