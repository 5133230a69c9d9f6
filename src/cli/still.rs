use super::outputs::Overwrite;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::failure::{Exit, Failure};
use super::scene_args::{PictureArgs, SceneArgs, print_up};
use super::{console, heading, outputs};
use cinesplat::export::cameras_json::{self, StillCameras};
use cinesplat::files::{self, Limits, npy};
use cinesplat::objects;
use cinesplat::pipeline::{self, Still, StillOutputs};
use cinesplat::render::{PixelWeight, Quality};
use cinesplat::scene::Scene;
use cinesplat::video;

/// Render still pictures from given cameras
///
/// Writes one NAME.png per camera, and further files NAME.*.npy on request.
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Example:\n  cinesplat still room.spz --cameras cameras.json -o stills --quality reference --npy"
)]
#[allow(clippy::struct_excessive_bools, reason = "flags of a command line")]
pub(super) struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    /// Cameras file: per camera name, image size, focal lengths, `world_from_camera`; or the cameras.json of INRIA
    #[arg(long, value_name = "CAMERAS.JSON")]
    cameras: PathBuf,
    /// Folder for NAME.png, one per camera
    #[arg(short, long, value_name = "DIR", help_heading = heading::OUTPUT)]
    output: PathBuf,
    #[command(flatten)]
    picture: PictureArgs,
    /// Write colors (NAME.npy) and final transmittance (NAME.T.npy) as numbers
    ///
    /// float32, H x W x 3 and H x W. Colors are not clamped from above.
    #[arg(long, help_heading = heading::OUTPUT)]
    npy: bool,
    /// Write expected depth (NAME.depth.npy) and median depth (NAME.median.npy)
    ///
    /// float32, H x W, along the view axis in scene units; NaN where there is no Gaussian.
    #[arg(long, help_heading = heading::OUTPUT)]
    depth: bool,
    /// Write the object id of each pixel (NAME.ids.npy) [labels: the scene's own]
    ///
    /// uint16, H x W. The file holds one label per Gaussian in file order.
    #[arg(long, help_heading = heading::OUTPUT, value_name = "LABELS.NPY", num_args = 0..=1)]
    #[allow(clippy::option_option, reason = "not given, given without a file, given with one")]
    ids: Option<Option<PathBuf>>,
    /// Write features blended like colors (NAME.features.npy)
    ///
    /// The file holds one row of N features per Gaussian, float32; the output is float32, H x W x N.
    #[arg(long, help_heading = heading::OUTPUT, value_name = "FILE.NPY")]
    features: Option<PathBuf>,
    /// Write the weight of every splat in every pixel (NAME.weights.npy)
    ///
    /// Records of pixel, Gaussian and weight; the file is large.
    #[arg(long, help_heading = heading::OUTPUT)]
    weights: bool,
    #[command(flatten)]
    overwrite: Overwrite,
}

impl Args {
    pub(super) fn run(self) -> Result<(), Failure> {
        let text = outputs::read_text(&self.cameras)?;
        let cameras = cameras_json::read(&text).map_err(|error| Failure::from(error).in_file(&self.cameras))?;
        console::file_warnings(&self.cameras, &cameras.notes);
        self.check_outputs(&cameras)?;
        self.picture.bound_threads()?;
        let scene = self.scene.open()?.scene;
        print_up(&scene);
        let settings = self.picture.settings(&scene, Quality::Final, cameras.filter, cameras.near);
        let outputs = self.outputs(&scene)?;
        pipeline::still(&scene, &cameras.cameras, &settings, &outputs, &mut |still| self.write(&still))
    }

    /// Reads the inputs of the optional outputs.
    fn outputs(&self, scene: &Scene) -> Result<StillOutputs, Failure> {
        let bad = |path: &Path, found: String, expected: &str| {
            let message = format!("{}: {found}, expected {expected}", path.display());
            Failure::new("NPY", message, "write it with numpy.save, one row per Gaussian in file order", Exit::BadData)
        };
        let labels = match &self.ids {
            None => None,
            Some(None) if scene.gaussians.ids.is_empty() => {
                return Err(Failure::usage(
                    "--ids without a file: the scene has no labels",
                    "name a file: --ids LABELS.NPY",
                ));
            }
            Some(None) => Some(scene.gaussians.ids.clone()),
            Some(Some(path)) => Some(objects::read_labels(path, scene)?),
        };
        let rows = |path: &PathBuf| {
            let not_rows = |found: String| bad(path, found, "float32 with two axes");
            let bytes = files::read(path, Limits::DEFAULT.array_bytes)?;
            let array = npy::Array::parse(&bytes).map_err(|error| not_rows(error.to_string()))?;
            let &[num_rows, num_channels] = array.shape.as_slice() else {
                return Err(not_rows(format!("an array of shape {:?}", array.shape)));
            };
            let values = array.to_f32().map_err(|error| not_rows(error.to_string()))?;
            // Drop the rows of Gaussians that were dropped on reading.
            let kept = scene.kept(&(0..num_rows).collect::<Vec<_>>());
            let kept = kept.ok_or_else(|| bad(path, format!("{num_rows} rows"), "one per Gaussian of the file"))?;
            let row = |idx: usize| values[idx * num_channels..][..num_channels].iter().copied();
            Ok::<_, Failure>((kept.into_iter().flat_map(row).collect(), num_channels))
        };
        let features = self.features.as_ref().map(rows).transpose()?;
        Ok(StillOutputs { depth: self.depth, labels, features, weights: self.weights })
    }

    fn check_outputs(&self, cameras: &StillCameras) -> Result<(), Failure> {
        let place = self.output.display();
        if self.output.exists() && !self.output.is_dir() {
            return Err(Failure::new(
                "OUTPUT-CREATE",
                format!("{place}: a file, expected a folder"),
                "name a folder",
                Exit::CannotCreate,
            ));
        }
        self.check_names(cameras)?;
        outputs::create_folder(&self.output)?;
        let mut names = cameras.cameras.iter().flat_map(|camera| self.files(&camera.name));
        names.try_for_each(|path| self.overwrite.check(&path))?;
        self.check_not_inputs(cameras)
    }

    fn check_not_inputs(&self, cameras: &StillCameras) -> Result<(), Failure> {
        let files: Vec<PathBuf> = cameras.cameras.iter().flat_map(|camera| self.files(&camera.name)).collect();
        let inputs = [
            ("the scene", Some(self.scene.scene.as_path())),
            ("the cameras", Some(&self.cameras)),
            ("the labels", self.ids.as_ref().and_then(Option::as_deref)),
            ("the features", self.features.as_deref()),
        ];
        outputs::check_not_inputs(files.iter().map(|path| ("--output", path.as_path())), inputs)
    }

    /// Refuses two cameras that would write the same file.
    fn check_names(&self, cameras: &StillCameras) -> Result<(), Failure> {
        let mut camera_of_file = BTreeMap::new();
        for (idx, camera) in cameras.cameras.iter().enumerate() {
            for path in self.files(&camera.name) {
                if let Some(first) = camera_of_file.insert(path.clone(), idx) {
                    let found = format!(
                        "{}: cameras[{first}] and cameras[{idx}] both write {}, expected one name per camera",
                        self.cameras.display(),
                        path.display()
                    );
                    return Err(Failure::new("CAMERA-NAMES", found, "give each camera its own name", Exit::BadData));
                }
            }
        }
        Ok(())
    }

    fn files(&self, name: &str) -> Vec<PathBuf> {
        let wanted = [
            (true, "png"),
            (self.npy, "npy"),
            (self.npy, "T.npy"),
            (self.depth, "depth.npy"),
            (self.depth, "median.npy"),
            (self.ids.is_some(), "ids.npy"),
            (self.features.is_some(), "features.npy"),
            (self.weights, "weights.npy"),
        ];
        let endings = wanted.iter().filter(|(is_wanted, _)| *is_wanted);
        endings.map(|(_, ending)| self.file(name, ending)).collect()
    }

    fn file(&self, name: &str, ending: &str) -> PathBuf {
        self.output.join(Path::new(&format!("{name}.{ending}")))
    }

    fn write(&self, still: &Still) -> Result<(), Failure> {
        let (name, frame) = (still.name, &still.frame);
        let (width, height) = (frame.width, frame.height);
        video::write_png(&self.file(name, "png"), &frame.to_rgb8(), [width, height], self.overwrite.existing())?;
        if self.npy {
            self.overwrite
                .write(&self.file(name, "npy"), &npy::encode_f32(&[height as usize, width as usize, 3], &frame.rgb))?;
            self.overwrite.write(
                &self.file(name, "T.npy"),
                &npy::encode_f32(&[height as usize, width as usize], &frame.transmittance),
            )?;
        }
        self.write_outputs(still, [height as usize, width as usize])?;
        let milliseconds = frame.stats.times.total().as_secs_f64() * 1e3;
        console::note(&format!("{}: {width}x{height}, {milliseconds:.0} ms", self.file(name, "png").display()));
        Ok(())
    }

    fn write_outputs(&self, still: &Still, shape: [usize; 2]) -> Result<(), Failure> {
        let write = |ending: &str, bytes: Vec<u8>| self.overwrite.write(&self.file(still.name, ending), &bytes);
        if let Some(depth) = &still.depth {
            write("depth.npy", npy::encode_f32(&shape, &depth.expected))?;
            write("median.npy", npy::encode_f32(&shape, &depth.median))?;
        }
        if let Some(ids) = &still.ids {
            write("ids.npy", npy::encode_u16(&shape, &ids.ids))?;
        }
        if let Some(map) = &still.features {
            let shape = [shape[0], shape[1], map.num_channels];
            write("features.npy", npy::encode_f32(&shape, &map.values))?;
        }
        if let Some(weights) = &still.weights {
            let descr = "[('pixel', '<u4'), ('gaussian', '<u4'), ('weight', '<f4')]";
            let bytes =
                |w: &PixelWeight| [w.pixel_idx.to_le_bytes(), w.gaussian_idx.to_le_bytes(), w.weight.to_le_bytes()];
            let data = weights.iter().flat_map(bytes).flatten();
            write("weights.npy", npy::encode(descr, &[weights.len()], data))?;
        }
        Ok(())
    }
}
