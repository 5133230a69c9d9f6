//! `cameras.json`: named still cameras, each with its own pose, image size and focal lengths.

use strum::{AsRefStr, Display, EnumString, IntoStaticStr, VariantArray, VariantNames};

use super::ExportError;
use super::inria;
use super::json_read::{self, Node};
use super::json_write::{Json, matrix_rows, object};
pub use super::named_camera::NamedCamera;
use super::track::{DEFAULT_SIZE_PX, PoseTrack, fov_y_or_default};
use cinesplat_files::UnknownKeys;
use cinesplat_geometry::{Camera, Intrinsics, Pose};
use cinesplat_trajectory::Shot;

/// The splat filter that a file or caller requests.
#[derive(
    Debug,
    Clone,
    Copy,
    PartialEq,
    Eq,
    Default,
    AsRefStr,
    Display,
    EnumString,
    IntoStaticStr,
    VariantArray,
    VariantNames
)]
#[strum(serialize_all = "kebab-case")]
pub enum FilterChoice {
    /// The filter that the scene's file names, else classic.
    #[default]
    Auto,
    /// Dilation alone.
    Classic,
    /// Dilation with compensated opacity.
    Mip,
}

/// The content of a `cameras.json`.
#[derive(Debug, Clone, PartialEq)]
pub struct StillCameras {
    /// Path of the scene as written in the file, relative to it.
    pub scene: Option<String>,
    /// Splat filter.
    pub filter: Option<FilterChoice>,
    /// Distance of the near plane, scene units.
    pub near: Option<f64>,
    /// The cameras in file order, at least one.
    pub cameras: Vec<NamedCamera>,
    /// One line per key that the reader does not know.
    pub notes: Vec<String>,
}

/// Keys of the top level.
const TOP_KEYS: [&str; 5] = ["version", "scene", "filter", "near", "cameras"];
/// Keys of a camera.
const CAMERA_KEYS: [&str; 8] = ["name", "width", "height", "fx", "fy", "cx", "cy", "world_from_camera"];

/// Reads a `cameras.json`. An unknown key becomes a note. The format has one version, which a file need not state.
///
/// # Errors
/// [`ExportError::NotJson`] for text that is not JSON, [`ExportError::WrongVersion`] for a `version` other than 1,
/// [`ExportError::NoPoses`] without cameras, [`ExportError::BadField`] naming the camera and the field.
///
/// A list in place of an object is INRIA's file of the same name: cameras without a scene, filter or near plane.
pub fn read(text: &str) -> Result<StillCameras, ExportError> {
    let value = json_read::parse(text)?;
    let root = Node::root(&value);
    if value.is_array() {
        let cameras = inria::read_cameras(&root)?;
        return Ok(StillCameras { scene: None, filter: None, near: None, cameras, notes: Vec::new() });
    }
    if let Some(found) =
        root.optional("version").map(|version| version.number()).transpose()?.filter(|v| !v.total_cmp(&1.0).is_eq())
    {
        return Err(ExportError::WrongVersion { format: "cameras.json", found: found.to_string(), expected: "1" });
    }
    let mut unknown = UnknownKeys::default();
    root.note_unknown(&TOP_KEYS, &mut unknown);
    let string = |name| root.optional(name).map(|node| node.text().map(str::to_owned)).transpose();
    let cameras = root.field("cameras", "a list of cameras")?.items()?;
    cameras.iter().for_each(|camera| camera.note_unknown(&CAMERA_KEYS, &mut unknown));
    let cameras = cameras.iter().map(read_camera).collect::<Result<Vec<_>, _>>()?;
    if cameras.is_empty() {
        return Err(ExportError::NoPoses);
    }
    let (filter, near) = (read_filter(&root)?, read_near(&root)?);
    Ok(StillCameras { scene: string("scene")?, filter, near, cameras, notes: unknown.into_notes() })
}

/// The poses of a track as cameras named by their number.
pub(super) fn write(shot: &Shot, track: &PoseTrack) -> String {
    let (width, height) = track.size_px.unwrap_or(DEFAULT_SIZE_PX);
    let cameras = track.frames.iter().enumerate().map(|(idx, frame)| {
        let lens = Intrinsics::from_fov_y(width, height, fov_y_or_default(frame));
        object([
            ("name", format!("{idx:05}").as_str().into()),
            ("width", width.into()),
            ("height", height.into()),
            ("fx", lens.fx_px.into()),
            ("fy", lens.fy_px.into()),
            ("cx", lens.cx_px.into()),
            ("cy", lens.cy_px.into()),
            ("world_from_camera", matrix_rows(frame.pose.world_from_camera())),
        ])
    });
    let scene = (!shot.scene.path.is_empty()).then(|| ("scene".to_owned(), shot.scene.path.as_str().into()));
    let fields = scene.into_iter().chain([("cameras".to_owned(), Json::list(cameras))]);
    Json::Object(fields.collect()).pretty()
}

fn read_filter(root: &Node) -> Result<Option<FilterChoice>, ExportError> {
    let Some(node) = root.optional("filter") else { return Ok(None) };
    node.text()?.parse().map(Some).map_err(|_| node.error("auto, classic or mip"))
}

fn read_near(root: &Node) -> Result<Option<f64>, ExportError> {
    let Some(node) = root.optional("near") else { return Ok(None) };
    let near = node.number()?;
    if near > 0.0 { Ok(Some(near)) } else { Err(node.error("a distance above 0")) }
}

fn read_camera(node: &Node) -> Result<NamedCamera, ExportError> {
    let name_node = node.field("name", "the name of its image")?;
    let name = name_node.text()?;
    if name.is_empty() || name.starts_with('.') || name.contains(['/', '\\', '\0']) {
        return Err(name_node.error("a file name without folders"));
    }
    let pixels = |field| node.field(field, "a number of pixels")?.pixels();
    let length = |field| node.field(field, "pixels")?.number();
    let intrinsics = Intrinsics {
        width: pixels("width")?,
        height: pixels("height")?,
        fx_px: length("fx")?,
        fy_px: length("fy")?,
        cx_px: length("cx")?,
        cy_px: length("cy")?,
    };
    let intrinsics = intrinsics.validated().map_err(|_| node.error("width, height, fx and fy above 0"))?;
    let matrix = node.field("world_from_camera", "a 4 x 4 matrix, row-major")?;
    let pose = Pose::from_matrix(matrix.matrix()?).map_err(|error| matrix.error(format!("a rigid pose ({error})")))?;
    Ok(NamedCamera { name: name.to_owned(), camera: Camera { pose, intrinsics } })
}
