//! Camera poses of MotionCtrl: a JSON list of 3 x 4 matrices `camera_from_world`, row-major and flat, with OpenCV camera axes; no
//! times and no lens.

use super::ExportError;
use super::json_read::{self, Node};
use super::track::{DEFAULT_FPS, PoseFrame, PoseTrack};
use cinesplat_geometry::Pose;

pub(super) fn read(text: &str) -> Result<PoseTrack, ExportError> {
    let value = json_read::parse(text)?;
    let nodes = Node::root(&value).items()?;
    let frame = |(idx, node): (usize, &Node)| {
        let camera_from_world = node.matrix()?;
        let inverse =
            Pose::from_matrix(camera_from_world).map_err(|error| node.error(format!("a rigid pose ({error})")))?;
        Ok(PoseFrame::new(idx as f64 / DEFAULT_FPS, inverse.inverse()))
    };
    Ok(PoseTrack::untimed(nodes.iter().enumerate().map(frame).collect::<Result<_, ExportError>>()?))
}
