//! Camera files of ReCamMaster and its data set: per frame `frame0`, `frame1` .. and per camera `cam01`, `cam02` .. the rows of a
//! 4 x 4 matrix as text. The rows are forward, right, up and position in the left-handed, z-up world of Unreal Engine; y is
//! mirrored to make it right-handed. Lengths are the file's, centimeters in the data set. No times and no lens.

use glam::{DMat3, DMat4, DVec3};

use super::ExportError;
use super::json_read::{self, Node};
use super::track::{DEFAULT_FPS, PoseFrame, PoseTrack};
use super::which_camera::which;
use cinesplat_geometry::Pose;

/// The poses of a camera; without a name, of the first.
pub(super) fn read(text: &str, wanted: Option<&str>) -> Result<PoseTrack, ExportError> {
    let value = json_read::parse(text)?;
    let root = Node::root(&value);
    let mut frames: Vec<(usize, Node)> = root
        .fields()
        .into_iter()
        .filter_map(|(name, node)| Some((name.strip_prefix("frame")?.parse().ok()?, node)))
        .collect();
    frames.sort_by_key(|(number, _)| *number);
    let Some((_, first)) = frames.first() else { return Err(ExportError::NoPoses) };
    let mut names: Vec<&str> = first.fields().into_iter().map(|(name, _)| name).collect();
    names.sort_unstable();
    let (camera, others) = which(&names, wanted)?;
    let name = names[camera];
    let frame = |(idx, (_, node)): (usize, &(usize, Node))| {
        let rows = node.field(name, "4 rows of 4 numbers")?;
        Ok(PoseFrame::new(idx as f64 / DEFAULT_FPS, pose(&rows)?))
    };
    let poses = frames.iter().enumerate().map(frame).collect::<Result<Vec<_>, ExportError>>()?;
    Ok(PoseTrack { up: Some(DVec3::Z), unread: others.into_iter().collect(), ..PoseTrack::untimed(poses) })
}

fn pose(node: &Node) -> Result<Pose, ExportError> {
    let expected = || node.error("4 rows of 4 numbers");
    let words = node.text()?.replace(['[', ']', ','], " ");
    let numbers: Vec<f64> =
        words.split_whitespace().map(|word| word.parse().ok()).collect::<Option<_>>().ok_or_else(expected)?;
    let rows: [f64; 16] = numbers.try_into().map_err(|_| expected())?;
    let mirrored = |row: usize| DVec3::new(rows[4 * row], -rows[4 * row + 1], rows[4 * row + 2]);
    let axes = DMat3::from_cols(mirrored(1), -mirrored(2), mirrored(0));
    Pose::from_matrix(DMat4::from_mat3_translation(axes, mirrored(3)))
        .map_err(|error| node.error(format!("a rigid pose ({error})")))
}
