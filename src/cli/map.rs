use std::path::{Path, PathBuf};

use super::failure::Failure;
use super::outputs::Overwrite;
use super::scene_args::SceneArgs;
use super::{console, heading, reproduce, shot_args};
use cinesplat::map;
use cinesplat::objects::ObjectSet;
use cinesplat::pipeline;
use cinesplat::scene::Scene;
use cinesplat::trajectory::{Shot, retimed};

/// Pixels of a PNG per px of the SVG.
const PNG_SCALE: f64 = 2.0;

/// Draw a shot in its scene, from above and from the side
///
/// The map shows the path with a tick per second, the keys with their view cones, the subjects and the least distance to
/// matter. `plan` and `render` write one with --map.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cinesplat map room.spz --shot shot.json -o map.svg
  cinesplat map room.spz --shot shot.json --objects objects.json -o map.png --overwrite")]
pub(super) struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    /// Shot to draw
    #[arg(long, value_name = "SHOT.JSON", help_heading = heading::SHOT)]
    shot: PathBuf,
    /// Objects file [default: the scene's own objects, else a search]
    #[arg(long, value_name = "OBJECTS.JSON", help_heading = heading::SCENE)]
    objects: Option<PathBuf>,
    /// Map to write (.svg or .png)
    #[arg(short, long, value_name = "MAP", help_heading = heading::OUTPUT)]
    output: PathBuf,
    /// Move the inner keys in time so that the camera's speed is constant
    #[arg(long, help_heading = heading::SHOT)]
    retime: bool,
    #[command(flatten)]
    overwrite: Overwrite,
}

impl Args {
    pub(super) fn run(self) -> Result<(), Failure> {
        check(&self.output, self.overwrite)?;
        let shot = shot_args::read_file(&self.shot)?;
        shot_args::print_warnings(&shot);
        let mut shot = if self.retime { retimed(&shot) } else { shot };
        let (scene, objects) = self.scene.open_with_objects(self.objects.as_deref())?;
        shot_args::print_other_scene(&self.shot, &shot, &scene);
        shot.clearance = Some(pipeline::prove_clearance(&scene, &shot)?);
        write(&self.output, (&scene, &objects), &shot, self.overwrite)?;
        reproduce::print(&[]);
        Ok(())
    }
}

/// Checks before any work that the name determines a format.
pub(super) fn check_name(path: &Path) -> Result<(), Failure> {
    format_of(path).map(|_| ())
}

/// Checks before any work that a map can be written.
pub(super) fn check(path: &Path, overwrite: Overwrite) -> Result<(), Failure> {
    format_of(path)?;
    overwrite.check(path)
}

/// Draws the map of a shot and writes it.
pub(super) fn write(
    path: &Path,
    (scene, objects): (&Scene, &ObjectSet),
    shot: &Shot,
    overwrite: Overwrite,
) -> Result<(), Failure> {
    let drawing = map::draw(scene, objects, shot)?;
    let bytes = match format_of(path)? {
        MapFormat::Svg => drawing.to_svg()?.into_bytes(),
        MapFormat::Png => drawing.to_png(PNG_SCALE)?,
    };
    overwrite.write_once(path, &bytes)?;
    console::note(&format!("{}: map of the shot", path.display()));
    Ok(())
}

/// What a map is written as.
#[derive(Clone, Copy)]
enum MapFormat {
    Svg,
    Png,
}

/// The format that the name of a map decides.
fn format_of(path: &Path) -> Result<MapFormat, Failure> {
    let extension = path.extension().map(|extension| extension.to_string_lossy().to_lowercase());
    match extension.as_deref() {
        Some("svg") => Ok(MapFormat::Svg),
        Some("png") => Ok(MapFormat::Png),
        _ => {
            let found =
                format!("{}: the name does not determine the format of the map, expected .svg or .png", path.display());
            Err(Failure::usage(found, "name the map something such as map.svg"))
        }
    }
}
