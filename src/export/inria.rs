//! `cameras.json` of INRIA's 3D Gaussian splatting: a list of images with `position`, `rotation` (3 x 3, row-major), `fx`, `fy`,
//! `width` and `height`. Poses are `world_from_camera` with OpenCV camera axes in the scene's world; the principal point is the
//! image's center. The file has no times: poses are in the order of the file.

use glam::{DMat3, DMat4, DVec3};

use super::ExportError;
use super::json_read::{self, Node};
use super::named_camera::{self, NamedCamera};
use super::track::PoseTrack;
use cinesplat_geometry::{Camera, Intrinsics, Pose};

pub(super) fn read(text: &str) -> Result<PoseTrack, ExportError> {
    let value = json_read::parse(text)?;
    named_camera::track(&read_cameras(&Node::root(&value))?)
}

/// The cameras of the list, each named after its image.
pub(super) fn read_cameras(root: &Node) -> Result<Vec<NamedCamera>, ExportError> {
    let nodes = root.items()?;
    let cameras = nodes.iter().enumerate().map(|(idx, node)| read_camera(idx, node)).collect::<Result<Vec<_>, _>>()?;
    if cameras.is_empty() { Err(ExportError::NoPoses) } else { Ok(cameras) }
}

fn read_camera(idx: usize, node: &Node) -> Result<NamedCamera, ExportError> {
    let pixels = |name| node.field(name, "a number of pixels")?.pixels();
    let length = |name| node.field(name, "pixels")?.number();
    let (width, height) = (pixels("width")?, pixels("height")?);
    let intrinsics = Intrinsics {
        width,
        height,
        fx_px: length("fx")?,
        fy_px: length("fy")?,
        cx_px: f64::from(width) / 2.0,
        cy_px: f64::from(height) / 2.0,
    };
    let intrinsics = intrinsics.validated().map_err(|_| node.error("width, height, fx and fy above 0"))?;
    let rotation_node = node.field("rotation", "a 3 x 3 matrix, row-major")?;
    let rows = rotation_node.items()?;
    let [x, y, z] = &rows[..] else { return Err(rotation_node.error("a 3 x 3 matrix, row-major")) };
    let rotation = DMat3::from_cols(x.vector()?, y.vector()?, z.vector()?).transpose();
    let position: DVec3 = node.field("position", "3 numbers")?.vector()?;
    let matrix = DMat4::from_mat3_translation(rotation, position);
    let pose = Pose::from_matrix(matrix).map_err(|error| rotation_node.error(format!("a rotation ({error})")))?;
    let image = node.optional("img_name").map(|name| name.text()).transpose()?.filter(|name| !name.is_empty());
    // The name becomes that of a file.
    let name =
        image.map_or_else(|| format!("{idx:05}"), |name| name.trim_start_matches('.').replace(['/', '\\', '\0'], "_"));
    Ok(NamedCamera { name, camera: Camera { pose, intrinsics } })
}
