use super::outputs::Overwrite;
use std::fmt::Write as _;
use std::path::PathBuf;

use serde_json::{Value, json};

use super::failure::Failure;
use super::scene_args::{SceneArgs, print_up};
use super::{console, heading, outputs, reproduce};
use cinesplat::objects::{self, Object, ObjectSet, SheetSettings};
use cinesplat::{pipeline, video};

/// Find or read the objects of a scene
///
/// Prints a table of the objects. Without --labels and --objects they are those of the scene itself, else those that a
/// search finds.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cinesplat objects room.spz -o objects.json --sheet objects.png
  cinesplat objects room.spz --labels labels.npy -o objects.json
Name objects in objects.json (\"label\": \"lamp\") so that a prompt can say \"the lamp\"; <obj-ID> always works.")]
pub(super) struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    /// Objects file to write, with the labels in a file beside it
    #[arg(short, long, value_name = "OBJECTS.JSON", help_heading = heading::OUTPUT)]
    output: Option<PathBuf>,
    /// Read the objects from labels: one id per Gaussian
    ///
    /// A .npy file of u8, u16 or u32 in the order of the scene's file.
    #[arg(long, value_name = "LABELS.NPY", help_heading = heading::SCENE, conflicts_with = "objects")]
    labels: Option<PathBuf>,
    /// Read the objects from an objects file
    #[arg(long, value_name = "OBJECTS.JSON", help_heading = heading::SCENE)]
    objects: Option<PathBuf>,
    /// Write a picture of every object with its id
    #[arg(long, value_name = "SHEET.PNG", help_heading = heading::OUTPUT)]
    sheet: Option<PathBuf>,
    /// Print one JSON list instead of a table
    #[arg(long, help_heading = heading::OUTPUT)]
    json: bool,
    #[command(flatten)]
    overwrite: Overwrite,
}

impl Args {
    pub(super) fn run(self) -> Result<(), Failure> {
        for path in self.output.iter().chain(&self.sheet) {
            self.overwrite.check(path)?;
        }
        let labels = self.output.as_deref().filter(|path| !outputs::is_stdout(path)).map(objects::labels_path);
        if let Some(labels) = &labels {
            self.overwrite.check(labels)?;
        }
        let named = [("--output", self.output.as_deref()), ("--sheet", self.sheet.as_deref())];
        let named = named.into_iter().chain([("the labels of --output", labels.as_deref())]);
        outputs::check_distinct(named.filter_map(|(flag, path)| Some((flag, path?))))?;
        let (scene, mut set) = match &self.labels {
            Some(labels) => {
                let scene = self.scene.open()?.scene;
                print_up(&scene);
                let set = objects::from_labels(&scene, objects::read_labels(labels, &scene)?);
                (scene, set)
            }
            None => self.scene.open_with_objects(self.objects.as_deref())?,
        };
        if let Some(path) = &self.sheet {
            let picture = objects::sheet(&scene, &set, &SheetSettings::default())?;
            video::write_png(path, &picture, [picture.width(), picture.height()], self.overwrite.existing())?;
            console::note(&format!("{}: picture of every object", path.display()));
        }
        if let Some(path) = &self.output {
            pipeline::prepare_objects(&scene, &mut set)?;
            if outputs::is_stdout(path) {
                console::data(&objects::to_json(path, &set, &scene, None))?;
            } else {
                objects::write(path, &set, &scene, self.overwrite.existing())?;
            }
            console::note(&format!("{}: {} objects", path.display(), set.objects.len()));
        }
        if self.output.as_deref().is_some_and(outputs::is_stdout) {
            return Ok(());
        }
        if self.json {
            console::data(&format!("{:#}\n", as_json(&set)))?;
        } else {
            console::text(&table(&set))?;
        }
        reproduce::print(&[]);
        Ok(())
    }
}

fn as_json(set: &ObjectSet) -> Value {
    let entry = |object: &Object| {
        json!({
            "id": object.id,
            "label": object.label,
            "center": object.center.to_array(),
            "half_extents": object.half_extents.to_array(),
            "rotation_xyzw": object.rotation.to_array(),
            "num_gaussians": object.num_gaussians,
        })
    };
    set.objects.iter().map(entry).collect()
}

fn table(set: &ObjectSet) -> String {
    let widest = set.objects.iter().map(|object| object.label.chars().count()).max().unwrap_or(0).max(5);
    let mut text = format!("{:>5}  {:<widest$}  {:>9}  {:<25}  size\n", "id", "label", "gaussians", "center");
    for object in &set.objects {
        let vector = |v: glam::DVec3| format!("{:.3} {:.3} {:.3}", v.x, v.y, v.z);
        let (center, size) = (vector(object.center), vector(object.half_extents * 2.0));
        let (id, label, count) = (object.id, console::one_line(&object.label), object.num_gaussians);
        let _ = writeln!(text, "{id:>5}  {label:<widest$}  {count:>9}  {center:<25}  {size}");
    }
    text
}
