//! Masks of posed images: a folder of PNG files beside the cameras of the images.

use std::collections::BTreeMap;
use std::path::{Component, Path, PathBuf};

use super::failure::{Exit, Failure};
use super::progress::FrameProgress;
use super::{console, outputs};
use cinesplat::export::{self, ExportError, Format, ImageLens, PoseTrack, cameras_json};
use cinesplat::geometry::{Camera, Intrinsics, Pose};
use cinesplat::objects::{self, ObjectSet, PosedMask};
use cinesplat::scene::Scene;

/// Largest relative difference of the aspects of a mask and its camera.
const MAX_ASPECT_DIFFERENCE: f64 = 0.01;

/// Largest side of a mask, px: of larger ones every n-th pixel votes.
const MAX_SIDE_PX: u32 = 1024;

/// Least share of the Gaussians that cameras in the frame of the scene see.
const MIN_SEEN_SHARE: f64 = 0.05;

/// The objects that masks give.
pub(super) fn lift(scene: &Scene, masks: &[PosedMask]) -> Result<ObjectSet, Failure> {
    let mut progress = FrameProgress::of_masks();
    let lifted = objects::lift_masks(scene, masks, &mut |done, total| progress.show(done, total));
    progress.finish();
    let lifted = lifted?;
    let percent = 100.0 * lifted.seen_share;
    if lifted.seen_share < MIN_SEEN_SHARE {
        let found =
            format!("the cameras see {percent:.1} % of the scene: poses and scene are in different frames or units");
        let help = "give the cameras that the scene was trained with, in its frame and units";
        return Err(bad(found, help));
    }
    let set = objects::from_labels(scene, lifted.labels);
    console::note(&format!("masks: {} objects, {percent:.0} % of the Gaussians seen", set.objects.len()));
    Ok(set)
}

/// The masks of a folder with the cameras of a file: each mask has the name of its image, with the extension `png`.
pub(super) fn read(folder: &Path, cameras: &Path) -> Result<Vec<PosedMask>, Failure> {
    if !folder.is_dir() {
        let found = format!("{}: no such folder, expected one with a PNG file of ids per image", folder.display());
        return Err(bad(found, "give the folder of the masks with --masks"));
    }
    let cameras = named_cameras(cameras)?;
    let mut masks = Vec::new();
    let mut image_of: BTreeMap<PathBuf, &str> = BTreeMap::new();
    for (name, camera) in &cameras {
        let Some(path) = mask_path(folder, name) else { continue };
        if let Some(other) = image_of.insert(path.clone(), name) {
            let found = format!("{}: the mask of two images, {other} and {name}", path.display());
            return Err(bad(found, "keep the masks in the folders of their images, such as masks/left/0001.png"));
        }
        let (width, height, ids) = objects::read_mask(&path)?;
        let intrinsics = camera
            .lens
            .for_mask([width, height])
            .map_err(|(found, help)| bad(format!("{}: {found}", path.display()), help))?;
        masks.push(sampled(Camera { pose: camera.pose, intrinsics }, ids));
    }
    if masks.is_empty() {
        let found = format!("{}: no mask for any of {} cameras", folder.display(), cameras.len());
        return Err(bad(found, "a mask has the name of its image, such as 0001.png for images/0001.jpg"));
    }
    console::note(&format!("masks: {} of {} cameras have one", masks.len(), cameras.len()));
    Ok(masks)
}

fn bad(found: String, help: &str) -> Failure {
    Failure::new("OBJ-MASKS", found, help, Exit::BadData)
}

/// The mask of an image: at its path in the folder, or with its bare name; with `.png` after it or in place of its
/// extension.
fn mask_path(folder: &Path, image: &str) -> Option<PathBuf> {
    // Only the folders below: a path such as `../images/1.png` leads to the image itself.
    let is_below = |part: &Component| matches!(part, Component::Normal(_));
    let path: PathBuf = Path::new(image).components().filter(is_below).collect();
    let bare = PathBuf::from(path.file_name()?);
    let names = [path.clone(), bare].into_iter().flat_map(|name| {
        let mut longer = name.as_os_str().to_owned();
        longer.push(".png");
        [PathBuf::from(longer), name.with_extension("png"), name.with_extension("ids.png")]
    });
    names.map(|name| folder.join(name)).find(|path| path.is_file())
}

/// Every n-th pixel of a mask, so that no side is longer than [`MAX_SIDE_PX`].
fn sampled(camera: Camera, ids: Vec<u16>) -> PosedMask {
    let given = camera.intrinsics;
    let step = given.width.max(given.height).div_ceil(MAX_SIDE_PX).max(1);
    if step == 1 {
        return PosedMask { camera, ids };
    }
    let (width, height) = (given.width.div_ceil(step), given.height.div_ceil(step));
    let at = |i: u32, side: u32| (i * step + step / 2).min(side - 1) as usize;
    let row = |y: u32| at(y, given.height) * given.width as usize;
    let mut sampled = Vec::with_capacity(width as usize * height as usize);
    for y in 0..height {
        sampled.extend((0..width).map(|x| ids[row(y) + at(x, given.width)]));
    }
    let px = f64::from(step);
    let intrinsics = Intrinsics {
        width,
        height,
        fx_px: given.fx_px / px,
        fy_px: given.fy_px / px,
        cx_px: given.cx_px / px,
        cy_px: given.cy_px / px,
    };
    PosedMask { camera: Camera { intrinsics, ..camera }, ids: sampled }
}

/// A camera of the file.
struct ImageCamera {
    pose: Pose,
    lens: MaskLens,
}

/// What the file states of a lens.
enum MaskLens {
    Image(ImageLens),
    /// The vertical field of view alone, rad.
    UpwardRad(f64),
}

impl MaskLens {
    /// The intrinsics of a mask, or what is wrong and what to do.
    fn for_mask(&self, [width, height]: [u32; 2]) -> Result<Intrinsics, (String, &'static str)> {
        match *self {
            Self::Image(ImageLens::Pixels(given)) => {
                let resized = given.resized(width, height);
                if (resized.aspect() / given.aspect() - 1.0).abs() <= MAX_ASPECT_DIFFERENCE {
                    return Ok(resized);
                }
                let found = format!(
                    "the mask has {width} x {height} px, its camera {} x {}: other proportions",
                    given.width, given.height
                );
                Err((found, "a mask shows the whole image, uncropped and not turned"))
            }
            Self::Image(ImageLens::AcrossRad(angle)) => {
                let square = Intrinsics::from_fov_y(width, height, 1.0);
                let focal_px = f64::from(width) / 2.0 / (angle / 2.0).tan();
                Ok(Intrinsics { fx_px: focal_px, fy_px: focal_px, ..square })
            }
            Self::UpwardRad(angle) => Ok(Intrinsics::from_fov_y(width, height, angle)),
            Self::Image(ImageLens::Unknown) => Err((
                "the file of cameras has no field of view for its image".to_owned(),
                "transforms.json needs `w`, `h` and `fl_x`, or `camera_angle_x`, or `camera_angle_y`; a COLMAP model its cameras",
            )),
        }
    }
}

/// The cameras by the names of their images.
fn named_cameras(path: &Path) -> Result<BTreeMap<String, ImageCamera>, Failure> {
    let imported = export::read(path, None).map_err(|error| match error {
        ExportError::WrongFormat { .. } => {
            let found = format!("{}: {error}", path.display());
            bad(found, "give the cameras of the images: transforms.json, a COLMAP model or a cameras file")
        }
        error => Failure::from(error).in_file(path),
    })?;
    if imported.format == Format::Cameras {
        let cameras = cameras_json::read(&outputs::read_text(path)?);
        let cameras = cameras.map_err(|error| Failure::from(error).in_file(path))?.cameras;
        let entry = |named: cameras_json::NamedCamera| {
            let Camera { pose, intrinsics } = named.camera;
            (named.name, ImageCamera { pose, lens: MaskLens::Image(ImageLens::Pixels(intrinsics)) })
        };
        return Ok(cameras.into_iter().map(entry).collect());
    }
    // What a path of cameras leaves out of the lenses is read here.
    let PoseTrack { frames, images, lenses, is_distorted, .. } = imported.track;
    if images.len() != frames.len() || lenses.len() != frames.len() {
        let found = format!("{}: cameras without the names of their images", path.display());
        return Err(bad(found, "give transforms.json with `file_path`, a COLMAP model, or a cameras file"));
    }
    if is_distorted {
        let found = format!("{}: the lenses are distorted, and masks need pinhole cameras", path.display());
        return Err(bad(found, "undistort images and masks first, such as with `colmap image_undistorter`"));
    }
    let mut cameras = BTreeMap::new();
    for ((frame, image), lens) in frames.into_iter().zip(images).zip(lenses) {
        let lens = match (lens, frame.fov_y_rad) {
            (ImageLens::Unknown, Some(angle)) => MaskLens::UpwardRad(angle),
            (lens, _) => MaskLens::Image(lens),
        };
        cameras.insert(image, ImageCamera { pose: frame.pose, lens });
    }
    Ok(cameras)
}
