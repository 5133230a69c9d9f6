//! Scenes of a bench with their cameras.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use glam::DVec2;

use crate::cli::console;
use crate::cli::failure::Failure;
use crate::cli::outputs::{self, BenchFolder};
use crate::cli::scene_args::{PictureArgs, SceneOptions};
use cinesplat::export::cameras_json::{self, StillCameras};
use cinesplat::geometry::{Camera, Intrinsics, LevelFrame, Pose};
use cinesplat::render::{Quality, RenderSettings};
use cinesplat::scene::Scene;

/// Scenes, each with a cameras file.
#[derive(Debug, clap::Args)]
pub(super) struct ScenesArgs {
    /// Scenes, named as for the other commands
    #[arg(value_name = "SCENE", required = true)]
    scenes: Vec<PathBuf>,
    #[command(flatten)]
    pub(super) options: SceneOptions,
    /// Cameras file per scene; auto: two views from outside, one from the middle
    ///
    /// The files are for the scenes in the same order; the last one is for all further scenes.
    #[arg(long, value_name = "CAMERAS.JSON", default_value = "auto")]
    cameras: Vec<PathBuf>,
}

impl ScenesArgs {
    /// Begins a bench: reads the cameras, makes room for its files and prints the header of its table.
    pub(super) fn begin(
        &self,
        (folder, names): (&BenchFolder, &[&str]),
        picture: &PictureArgs,
        header: &str,
    ) -> Result<Vec<(&Path, Option<StillCameras>)>, Failure> {
        let scenes = self.read_cameras()?;
        folder.prepare(names)?;
        picture.bound_threads()?;
        console::data(header)?;
        Ok(scenes)
    }

    /// Refuses two scenes whose rows would begin with the same name.
    pub(super) fn check_names(&self) -> Result<(), Failure> {
        let mut first_of = BTreeMap::new();
        for path in &self.scenes {
            if let Some(first) = first_of.insert(scene_name(path), path) {
                let found = format!("{} and {} have one name in the table", first.display(), path.display());
                return Err(Failure::usage(found, "give each scene once, or rename a file"));
            }
        }
        Ok(())
    }

    /// Every scene with its cameras, read before any work; `None` = the views of [`own_views`].
    pub(super) fn read_cameras(&self) -> Result<Vec<(&Path, Option<StillCameras>)>, Failure> {
        let files: Vec<_> = self.cameras.iter().map(|path| read_cameras(path)).collect::<Result<_, _>>()?;
        let file_of = |idx: usize| files.get(idx).or(files.last()).cloned().flatten();
        Ok(self.scenes.iter().enumerate().map(|(idx, scene)| (scene.as_path(), file_of(idx))).collect())
    }
}

/// Render settings for a scene with its cameras file.
pub(super) fn settings(
    picture: &PictureArgs,
    scene: &Scene,
    default: Quality,
    file: Option<&StillCameras>,
) -> RenderSettings {
    let (filter, near) = file.map_or((None, None), |file| (file.filter, file.near));
    picture.settings(scene, default, filter, near)
}

fn read_cameras(path: &Path) -> Result<Option<StillCameras>, Failure> {
    if path == Path::new("auto") {
        return Ok(None);
    }
    let text = outputs::read_text(path)?;
    let read = cameras_json::read(&text).map_err(|error| Failure::from(error).in_file(path))?;
    console::file_warnings(path, &read.notes);
    Ok(Some(read))
}

/// Name of a scene for a table: the file's stem. For `scene.*` and `meta.*` it is the folder's name; a stem that is only
/// the number of a level follows the folder's name.
pub(super) fn scene_name(path: &Path) -> String {
    let stem = |path: &Path| path.file_stem().unwrap_or(path.as_os_str()).to_string_lossy().into_owned();
    let parent = || path.parent().map(stem).filter(|name| !name.is_empty());
    let name = stem(path);
    let is_number = !name.is_empty() && name.chars().all(|c| c.is_ascii_digit() || c == '_');
    match parent() {
        Some(folder) if name == "scene" || name == "meta" => folder,
        Some(folder) if is_number => format!("{folder} {name}"),
        _ => name.replace(',', " "),
    }
}

/// The camera with another image size. The height sets the scale; the width is cropped or extended on both sides.
pub(super) fn resized(camera: &Camera, size: Option<[u32; 2]>) -> Camera {
    let Some([width, height]) = size else { return *camera };
    let given = camera.intrinsics;
    let scale = f64::from(height) / f64::from(given.height);
    let intrinsics = Intrinsics {
        width,
        height,
        fx_px: given.fx_px * scale,
        fy_px: given.fy_px * scale,
        cx_px: (given.cx_px - f64::from(given.width) / 2.0) * scale + f64::from(width) / 2.0,
        cy_px: given.cy_px * scale,
    };
    Camera { pose: camera.pose, intrinsics }
}

/// Number of cameras of [`own_views`].
pub(super) const NUM_OWN_VIEWS: usize = 3;

/// The views of a scene by name: those of its cameras file, or the program's own.
pub(super) fn views(scene: &Scene, file: Option<&StillCameras>) -> Result<Vec<(String, Camera)>, Failure> {
    match file {
        Some(file) => Ok(file.cameras.iter().map(|named| (named.name.clone(), named.camera)).collect()),
        None => own_views(scene),
    }
}

/// Where a film of a scene begins: at the first camera of its cameras file, or in the middle of the scene.
pub(super) fn film_view(scene: &Scene, file: Option<&StillCameras>) -> Result<Camera, Failure> {
    let views = views(scene, file)?;
    let view = if file.is_some() { views.first() } else { views.last() };
    view.map(|(_, camera)| *camera).ok_or_else(|| Failure::fault("no camera in the cameras file"))
}

/// One level view from the middle of the scene and two from outside, a quarter turn apart, 16:9 with 60 degrees.
fn own_views(scene: &Scene) -> Result<Vec<(String, Camera)>, Failure> {
    let level = LevelFrame::new(scene.up)?;
    let intrinsics = Intrinsics::from_fov_y(1280, 720, 60_f64.to_radians());
    let bounds = scene.bounds();
    let axis = level.up.any_orthonormal_vector();
    let view = |name: &str, heading: DVec2, distance: f64, rise: f64| {
        let outward = axis * heading.x + level.up.cross(axis) * heading.y;
        let eye = bounds.center() + (outward + level.up * rise) * distance * bounds.size();
        let forward = if distance > 0.0 { bounds.center() - eye } else { outward };
        (name.to_owned(), Camera { pose: Pose::facing(eye, forward, level.up, None), intrinsics })
    };
    Ok(vec![view("front", DVec2::X, 0.7, 0.2), view("side", DVec2::Y, 0.9, 0.4), view("middle", DVec2::X, 0.0, 0.0)])
}

/// Width and height; `None` = as given. The alias keeps clap from reading `Option` as "may be absent".
pub(super) type Size = Option<[u32; 2]>;

pub(super) fn parse_size(text: &str) -> Result<Option<[u32; 2]>, String> {
    if text == "given" {
        return Ok(None);
    }
    let number = |digits: &str| digits.parse::<u32>().ok().filter(|n| (16..=16384).contains(n));
    let size = text.split_once('x').and_then(|(width, height)| Some([number(width)?, number(height)?]));
    size.map(Some).ok_or_else(|| "expected WIDTHxHEIGHT in pixels such as 1280x720, or given".to_owned())
}
