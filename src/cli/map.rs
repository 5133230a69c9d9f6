use std::path::{Path, PathBuf};

use super::failure::Failure;
use super::outputs::Overwrite;
use super::scene_args::SceneArgs;
use super::{figures, heading, outputs, reproduce, shot_args};
use cinesplat::map;
use cinesplat::objects::ObjectSet;
use cinesplat::pipeline;
use cinesplat::scene::Scene;
use cinesplat::trajectory::{Shot, retimed};

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
    /// Map to write (.svg, .png or .pdf)
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
        figures::check(&self.output, self.overwrite)?;
        let inputs = [
            ("the scene", Some(self.scene.scene.as_path())),
            ("the shot", Some(&self.shot)),
            ("the objects", self.objects.as_deref()),
        ];
        outputs::check_not_inputs([("--output", self.output.as_path())], inputs)?;
        // A shot that cannot be read is refused before its scene is loaded; one that names objects needs them first.
        let is_complete = !shot_args::names_objects(&self.shot)?;
        let early = is_complete.then(|| shot_args::read_file(&self.shot, &[])).transpose()?;
        let (scene, objects) = self.scene.open_with_objects(self.objects.as_deref())?;
        let shot = early.map_or_else(|| shot_args::read_file(&self.shot, &objects.objects), Ok)?;
        shot_args::print_warnings(&shot);
        let mut shot = if self.retime { retimed(&shot) } else { shot };
        shot_args::print_other_scene(&self.shot, &shot, &scene);
        shot.clearance = Some(pipeline::prove_clearance(&scene, &shot)?);
        write(&self.output, (&scene, &objects), &shot, self.overwrite)?;
        reproduce::print(&[]);
        Ok(())
    }
}

/// Draws the map of a shot and writes it.
pub(super) fn write(
    path: &Path,
    (scene, objects): (&Scene, &ObjectSet),
    shot: &Shot,
    overwrite: Overwrite,
) -> Result<(), Failure> {
    figures::write(path, &map::draw(scene, objects, shot)?, "map of the shot", overwrite)
}
