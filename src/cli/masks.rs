//! Masks of posed images: a folder of PNG files beside the cameras of the images.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::failure::{Exit, Failure};
use super::{console, outputs};
use cinesplat::export::{self, Format, PoseTrack, cameras_json};
use cinesplat::geometry::{Camera, Intrinsics};
use cinesplat::objects::{self, PosedMask};

/// The masks of a folder with the cameras of a file: each mask has the name of its image, with the extension `png`.
pub(super) fn read(folder: &Path, cameras: &Path) -> Result<Vec<PosedMask>, Failure> {
    let cameras = named_cameras(cameras)?;
    let mut masks = Vec::new();
    for (name, camera) in &cameras {
        let Some(path) = mask_path(folder, name) else { continue };
        let (width, height, ids) = objects::read_mask(&path)?;
        let intrinsics = match camera.intrinsics {
            Some(given) => resized(given, [width, height]),
            None => Intrinsics::from_fov_y(width, height, camera.fov_y_rad),
        };
        masks.push(PosedMask { camera: Camera { pose: camera.pose, intrinsics }, ids });
    }
    if masks.is_empty() {
        let found = format!("{}: no mask for any of {} cameras", folder.display(), cameras.len());
        let help = "a mask has the name of its image, such as 0001.png for images/0001.jpg";
        return Err(Failure::new("OBJ-MASKS", found, help, Exit::BadData));
    }
    console::note(&format!("masks: {} of {} cameras have one", masks.len(), cameras.len()));
    Ok(masks)
}

/// The mask of an image: with its name, with its stem, or with its name and `.png` after it.
fn mask_path(folder: &Path, image: &str) -> Option<PathBuf> {
    let file = Path::new(image).file_name()?.to_string_lossy().into_owned();
    let stem = Path::new(&file).file_stem()?.to_string_lossy().into_owned();
    let names = [format!("{stem}.png"), format!("{file}.png"), format!("{stem}.ids.png")];
    names.into_iter().map(|name| folder.join(name)).find(|path| path.is_file())
}

/// A camera of the file.
struct ImageCamera {
    pose: cinesplat::geometry::Pose,
    /// Known for a cameras file.
    intrinsics: Option<Intrinsics>,
    fov_y_rad: f64,
}

/// The cameras by the names of their images.
fn named_cameras(path: &Path) -> Result<BTreeMap<String, ImageCamera>, Failure> {
    let imported = export::read(path, None).map_err(|error| Failure::from(error).in_file(path))?;
    if imported.format == Format::Cameras {
        let cameras = cameras_json::read(&outputs::read_text(path)?);
        let cameras = cameras.map_err(|error| Failure::from(error).in_file(path))?.cameras;
        let entry = |named: cameras_json::NamedCamera| {
            let Camera { pose, intrinsics } = named.camera;
            // The stem of a name ends at its last point, which a name without extension may hold.
            (
                format!("{}.png", named.name),
                ImageCamera { pose, intrinsics: Some(intrinsics), fov_y_rad: intrinsics.fov_y_rad() },
            )
        };
        return Ok(cameras.into_iter().map(entry).collect());
    }
    let PoseTrack { frames, images, unread, .. } = imported.track;
    console::file_warnings(path, &unread);
    if images.len() != frames.len() {
        let found = format!("{}: cameras without the names of their images", path.display());
        let help = "give transforms.json with `file_path`, a COLMAP model, or a cameras file";
        return Err(Failure::new("OBJ-MASKS", found, help, Exit::BadData));
    }
    let mut cameras = BTreeMap::new();
    for (frame, image) in frames.into_iter().zip(images) {
        let Some(fov_y_rad) = frame.fov_y_rad else {
            let found = format!("{}: no field of view for {image}", path.display());
            let help = "transforms.json needs `fl_y` or `camera_angle_x`; a COLMAP model needs its cameras beside it";
            return Err(Failure::new("OBJ-MASKS", found, help, Exit::BadData));
        };
        cameras.insert(image, ImageCamera { pose: frame.pose, intrinsics: None, fov_y_rad });
    }
    Ok(cameras)
}

/// Intrinsics for a mask of another size than the image.
fn resized(given: Intrinsics, [width, height]: [u32; 2]) -> Intrinsics {
    let (x, y) = (f64::from(width) / f64::from(given.width), f64::from(height) / f64::from(given.height));
    Intrinsics {
        width,
        height,
        fx_px: given.fx_px * x,
        fy_px: given.fy_px * y,
        cx_px: given.cx_px * x,
        cy_px: given.cy_px * y,
    }
}
