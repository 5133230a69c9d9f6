use std::fs;
use std::path::{Path, PathBuf};

use super::failure::Failure;
use super::scene_args::{PictureArgs, SceneArgs, print_up};
use super::{console, npy, outputs};
use crate::export::cameras_json::{self, StillCameras};
use crate::pipeline::{self, Still};
use crate::render::Quality;
use crate::video;

/// Takes still pictures from given cameras.
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Example:\n  cinesplat still room.spz --cameras cameras.json -o stills --quality reference --npy"
)]
pub(super) struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    /// Cameras, each with a name, image size, focal lengths and `world_from_camera`
    #[arg(long, value_name = "CAMERAS.JSON")]
    cameras: PathBuf,
    /// Folder for NAME.png, one a camera
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
    #[command(flatten)]
    picture: PictureArgs,
    /// Writes NAME.npy too, float32 H x W x 3 not clamped from above, and NAME.T.npy, the final transmittance
    #[arg(long)]
    npy: bool,
    /// Replaces pictures that are already there
    #[arg(long)]
    overwrite: bool,
}

impl Args {
    pub(super) fn run(self) -> Result<(), Failure> {
        let text = outputs::read_text(&self.cameras)?;
        let cameras = cameras_json::read(&text).map_err(|error| Failure::from(error).in_file(&self.cameras))?;
        self.check_outputs(&cameras)?;
        self.picture.bound_threads()?;
        let scene = self.scene.open()?.scene;
        print_up(&scene);
        let settings = self.picture.settings(&scene, Quality::Final, cameras.filter.as_deref(), cameras.near);
        pipeline::still(&scene, &cameras.cameras, &settings, &mut |still| self.write(&still))
    }

    fn check_outputs(&self, cameras: &StillCameras) -> Result<(), Failure> {
        let place = self.output.display();
        if self.output.exists() && !self.output.is_dir() {
            return Err(Failure::new(
                "OUTPUT-CREATE",
                format!("{place}: a file, expected a folder"),
                "name a folder",
                73,
            ));
        }
        fs::create_dir_all(&self.output).map_err(|error| Failure::io(&place.to_string(), &error))?;
        let mut names = cameras.cameras.iter().flat_map(|camera| self.files(&camera.name));
        names.try_for_each(|path| outputs::check_new(&path, self.overwrite))
    }

    fn files(&self, name: &str) -> Vec<PathBuf> {
        let endings: &[&str] = if self.npy { &["png", "npy", "T.npy"] } else { &["png"] };
        endings.iter().map(|ending| self.file(name, ending)).collect()
    }

    fn file(&self, name: &str, ending: &str) -> PathBuf {
        self.output.join(Path::new(&format!("{name}.{ending}")))
    }

    fn write(&self, still: &Still) -> Result<(), Failure> {
        let (name, frame) = (still.name, &still.frame);
        let (width, height) = (frame.width, frame.height);
        video::write_png(&self.file(name, "png"), &frame.to_rgb8(), width, height)?;
        if self.npy {
            outputs::write(&self.file(name, "npy"), &npy::encode_f32(&[height, width, 3], &frame.rgb))?;
            outputs::write(&self.file(name, "T.npy"), &npy::encode_f32(&[height, width], &frame.transmittance))?;
        }
        let milliseconds = frame.stats.times.total().as_secs_f64() * 1e3;
        console::note(&format!("{}: {width}x{height}, {milliseconds:.0} ms", self.file(name, "png").display()));
        Ok(())
    }
}
