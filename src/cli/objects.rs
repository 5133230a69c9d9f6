use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use super::failure::{Exit, Failure};
use super::outputs::Overwrite;
use super::progress::FrameProgress;
use super::scene_args::{SceneArgs, print_up};
use super::{console, heading, masks, outputs, reproduce};
use cinesplat::objects::{self, EditError, FindSettings, Object, ObjectSet, Renaming, SheetSettings};
use cinesplat::pipeline;
use cinesplat::scene::Scene;
use cinesplat::video;
use cinesplat::vision::Dino;

/// Find or read the objects of a scene
///
/// Prints a table of the objects, parts indented under their whole. Without --labels, --masks and --objects they are
/// those of the scene itself, else those that a search finds.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cinesplat objects room.spz -o objects.json --sheet objects.html
  cinesplat objects room.spz --masks masks --cameras transforms.json -o objects.json
  cinesplat objects room.spz --objects objects.json --name 41=mug -o objects.json --overwrite
  cinesplat objects room.spz --dino dinov2-small -o objects.json
  cinesplat objects room.spz --objects objects.json --merge 3,7,8 --drop 41,42 -o objects.json --overwrite
A prompt can then say \"the mug\"; <obj-41> always works.")]
pub(super) struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    /// Objects file to write, with labels and clouds in files beside it
    #[arg(short, long, value_name = "OBJECTS.JSON", help_heading = heading::OUTPUT)]
    output: Option<PathBuf>,
    /// Read the objects from labels: one id per Gaussian
    ///
    /// A .npy file of u8, u16 or u32 in the order of the scene's file.
    #[arg(long, value_name = "LABELS.NPY", help_heading = heading::SCENE, conflicts_with = "objects")]
    labels: Option<PathBuf>,
    /// Read the objects from masks of posed images: a folder of PNG files of ids
    ///
    /// Gray, 8 or 16 bits; the value is the id, the same in every picture, and 0 is no object. Each has the name of its
    /// image. Pixels vote with the blending weights of the Gaussians that they show.
    #[arg(long, value_name = "DIR", help_heading = heading::SCENE, requires = "cameras")]
    #[arg(conflicts_with_all = ["labels", "objects", "detail"])]
    masks: Option<PathBuf>,
    /// Cameras of --masks: transforms.json, a COLMAP model or a cameras file
    #[arg(long, value_name = "CAMERAS", help_heading = heading::SCENE, requires = "masks")]
    cameras: Option<PathBuf>,
    /// Read the objects from an objects file
    #[arg(long, value_name = "OBJECTS.JSON", help_heading = heading::SCENE, conflicts_with = "detail")]
    objects: Option<PathBuf>,
    /// How far to divide things that are found into parts: 0, 1 or 2 [default: 1]
    ///
    /// 0 finds wholes alone; 1 also the parts of captures that show single things; 2 also the parts of a room's things.
    #[arg(long, value_name = "D", help_heading = heading::SCENE, value_parser = clap::value_parser!(u8).range(0..=2))]
    detail: Option<u8>,
    /// Name an object, such as 41=mug; may be repeated
    #[arg(long, value_name = "ID=NAME", help_heading = heading::OUTPUT, value_parser = parse_renaming)]
    name: Vec<Renaming>,
    /// Name the objects in a file with one ID=NAME per line
    #[arg(long, value_name = "NAMES.TXT", help_heading = heading::OUTPUT)]
    rename: Option<PathBuf>,
    /// Join objects into the first of them, such as 3,7,8; may be repeated
    ///
    /// The first keeps its id and name and gets the Gaussians and the parts of the others.
    #[arg(long, value_name = "ID,ID..", help_heading = heading::OUTPUT, value_parser = parse_ids)]
    merge: Vec<Ids>,
    /// Take out objects that are none, such as 41,42; may be repeated
    ///
    /// The Gaussians of a part go back to its whole; a whole leaves with its parts.
    #[arg(long, value_name = "ID,ID..", help_heading = heading::OUTPUT, value_parser = parse_ids)]
    drop: Vec<Ids>,
    /// Write a sheet of every object with its id, its surroundings dimmed: PNG or HTML
    #[arg(long, value_name = "SHEET", help_heading = heading::OUTPUT)]
    sheet: Option<PathBuf>,
    /// Store what a DINOv2 sees at the points of each object: a folder with its config.json and model.safetensors
    ///
    /// As `transformers` stores a `Dinov2Model`. The objects are rendered from all around; the features of each point are averaged
    /// over these pictures and stored as ID.dino beside its cloud, for other programs: the director was trained without them.
    #[arg(long, value_name = "DIR", help_heading = heading::OUTPUT, hide_short_help = true)]
    dino: Option<PathBuf>,
    /// Print one JSON list instead of a table
    #[arg(long, help_heading = heading::OUTPUT)]
    json: bool,
    #[command(flatten)]
    overwrite: Overwrite,
}

impl Args {
    pub(super) fn run(self) -> Result<(), Failure> {
        self.check_outputs()?;
        let names = self.names()?;
        self.check_kept()?;
        let dino = self.dino.as_deref().map(Dino::load).transpose()?;
        let (scene, mut set) = self.open()?;
        self.edit(&scene, &mut set)?;
        objects::rename(&mut set, &names).map_err(|id| no_such_object(id, &set))?;
        warn_of_twins(&set, &names);
        if set.objects.is_empty() {
            console::warnings([format!("{}: no objects", self.source().display())]);
        }
        if let Some(path) = &self.sheet {
            self.write_sheet(path, &scene, &set)?;
        }
        if let Some(path) = &self.output {
            match &dino {
                Some(dino) => describe_points(&scene, &mut set, dino)?,
                None => pipeline::prepare_objects(&scene, &mut set)?,
            }
            if outputs::is_stdout(path) {
                console::data(&objects::to_json(path, &set, &scene, objects::Sidecars::default()))?;
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

    fn check_outputs(&self) -> Result<(), Failure> {
        let files = self.output.as_deref().filter(|path| !outputs::is_stdout(path));
        let (labels, clouds) = (files.map(objects::labels_path), files.map(objects::clouds_path));
        let named = [
            ("--output", self.output.as_deref()),
            ("--sheet", self.sheet.as_deref()),
            ("the labels of --output", labels.as_deref()),
            ("the clouds of --output", clouds.as_deref()),
        ];
        let named = || named.into_iter().filter_map(|(flag, path)| Some((flag, path?)));
        self.sheet.as_deref().map_or(Ok(()), check_sheet_name)?;
        named().try_for_each(|(_, path)| self.overwrite.check(path))?;
        outputs::check_distinct(named())?;
        // The objects file and its labels are not among them: writing new names over the old ones is what people mean.
        let inputs = [
            ("the scene", Some(self.scene.scene.as_path())),
            ("the masks", self.masks.as_deref()),
            ("the cameras", self.cameras.as_deref()),
            ("the names", self.rename.as_deref()),
        ];
        outputs::check_not_inputs(named(), inputs)
    }

    /// Refuses names and corrections that no file would keep.
    fn check_kept(&self) -> Result<(), Failure> {
        let edits = [
            ("--name", !self.name.is_empty()),
            ("--rename", self.rename.is_some()),
            ("--merge", !self.merge.is_empty()),
            ("--drop", !self.drop.is_empty()),
        ];
        if self.dino.is_some() && self.output.as_deref().is_none_or(outputs::is_stdout) {
            let found = "--dino without a file to write, expected -o OBJECTS.JSON".to_owned();
            return Err(Failure::usage(
                found,
                "add -o objects.json: features are stored in the file of clouds beside it",
            ));
        }
        let is_kept = self.output.is_some() || self.sheet.is_some() || self.json;
        match edits.iter().find(|(_, is_given)| *is_given && !is_kept) {
            Some((flag, _)) => {
                let found = format!("{flag} without a file to write, expected -o OBJECTS.JSON");
                Err(Failure::usage(found, "add -o objects.json (and --overwrite, where that is the file of --objects)"))
            }
            None => Ok(()),
        }
    }

    /// Joins and takes out what --merge and --drop say.
    fn edit(&self, scene: &Scene, set: &mut ObjectSet) -> Result<(), Failure> {
        let failed = |error: EditError, set: &ObjectSet| match error {
            EditError::Unknown(id) => no_such_object(id, set),
            EditError::PartOf { part, whole } => {
                let found = format!("--merge {part},{whole}: {error}, expected the whole first");
                Failure::new("OBJ-MERGE", found, format!("--merge {whole},{part}"), Exit::BadData)
            }
        };
        for Ids(ids) in &self.merge {
            objects::merge(scene, set, ids).map_err(|error| failed(error, set))?;
        }
        for Ids(ids) in &self.drop {
            objects::remove(set, ids).map_err(|error| failed(error, set))?;
        }
        Ok(())
    }

    /// The file that the objects come from.
    fn source(&self) -> &Path {
        let files = [self.objects.as_deref(), self.masks.as_deref(), self.labels.as_deref()];
        files.into_iter().flatten().next().unwrap_or(&self.scene.scene)
    }

    /// The names of --rename and --name; the latter win.
    fn names(&self) -> Result<Vec<Renaming>, Failure> {
        let mut names = Vec::new();
        if let Some(path) = &self.rename {
            let bad = |found| {
                let found = format!("{}: {found}", path.display());
                Failure::new("OBJ-NAMES", found, "one line per object, such as 41=mug", Exit::BadData)
            };
            names = Renaming::parse_lines(&outputs::read_text(path)?).map_err(bad)?;
        }
        names.extend(self.name.iter().cloned());
        Ok(names)
    }

    fn open(&self) -> Result<(Scene, ObjectSet), Failure> {
        if let Some(labels) = &self.labels {
            let scene = self.scene.open()?.scene;
            print_up(&scene);
            let set = objects::from_labels(&scene, objects::read_labels(labels, &scene)?);
            return Ok((scene, set));
        }
        if let (Some(folder), Some(cameras)) = (&self.masks, &self.cameras) {
            let masks = masks::read(folder, cameras)?;
            let scene = self.scene.open()?.scene;
            print_up(&scene);
            let set = masks::lift(&scene, &masks)?;
            return Ok((scene, set));
        }
        match self.detail.filter(|_| self.objects.is_none()) {
            Some(detail) => {
                let scene = self.scene.open()?.scene;
                print_up(&scene);
                let set = objects::find(&scene, &FindSettings { detail, ..FindSettings::default() });
                Ok((scene, set))
            }
            None => self.scene.open_with_objects(self.objects.as_deref()),
        }
    }

    fn write_sheet(&self, path: &Path, scene: &Scene, set: &ObjectSet) -> Result<(), Failure> {
        let settings = SheetSettings::default();
        let sheet = objects::sheet(scene, set, &settings)?;
        if path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("html")) {
            let title = scene.path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
            self.overwrite.write(path, sheet.html(&format!("Objects of {title}"))?.as_bytes())?;
        } else {
            let picture = sheet.page(&settings);
            video::write_png(path, &picture, [picture.width(), picture.height()], self.overwrite.existing())?;
        }
        console::note(&format!("{}: picture of every object", path.display()));
        Ok(())
    }
}

/// Gives the points of all objects their features, with progress.
fn describe_points(scene: &Scene, set: &mut ObjectSet, dino: &Dino) -> Result<(), Failure> {
    let mut progress = FrameProgress::of_objects();
    let described = pipeline::describe_points(scene, set, dino, &mut |done, total| progress.show(done, total));
    progress.finish();
    Ok(described?)
}

/// A sheet is a picture or a page; another name would hold bytes that its programs do not read.
fn check_sheet_name(path: &Path) -> Result<(), Failure> {
    let extension = path.extension().map(|extension| extension.to_string_lossy().to_lowercase());
    if let Some("png" | "html") = extension.as_deref() {
        Ok(())
    } else {
        let found = format!("{}: a sheet is a picture or a page, expected .png or .html", path.display());
        Err(Failure::usage(found, "name the sheet something such as sheet.png or sheet.html"))
    }
}

/// Ids of objects, as a flag lists them.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Ids(Vec<u32>);

fn parse_ids(text: &str) -> Result<Ids, String> {
    let expected = || format!("expected ids such as 3,7,8, found `{text}`");
    text.split(',').map(objects::typed_id).collect::<Option<_>>().map(Ids).ok_or_else(expected)
}

/// Says which new names several objects have: a prompt with such a name means one of them.
fn warn_of_twins(set: &ObjectSet, names: &[Renaming]) {
    let mut told: Vec<&str> = Vec::new();
    for Renaming { name, .. } in names {
        let called: Vec<String> = set
            .objects
            .iter()
            .filter(|object| object.label.eq_ignore_ascii_case(name))
            .map(|object| format!("<obj-{}>", object.id))
            .collect();
        if called.len() > 1 && !told.contains(&name.as_str()) {
            told.push(name);
            let which = called.join(" and ");
            let told = format!("{which} are both called \"{name}\": a prompt tells them apart by their ids alone");
            console::warnings([told]);
        }
    }
}

fn parse_renaming(text: &str) -> Result<Renaming, String> {
    text.parse()
}

fn no_such_object(id: u32, set: &ObjectSet) -> Failure {
    let last = set.objects.last().map_or(0, |object| object.id);
    let found = format!("no object has the id {id}, expected one of {} objects up to {last}", set.objects.len());
    Failure::new("OBJ-UNKNOWN", found, "--sheet shows every object with its id", Exit::BadData)
}

fn as_json(set: &ObjectSet) -> Value {
    let entry = |object: &Object| {
        json!({
            "id": object.id,
            "label": object.label,
            "parent": object.parent,
            "center": object.center.to_array(),
            "half_extents": object.half_extents.to_array(),
            "rotation_xyzw": object.rotation.to_array(),
            "num_gaussians": object.num_gaussians,
        })
    };
    set.objects.iter().map(entry).collect()
}

fn table(set: &ObjectSet) -> String {
    let ordered = set.with_parts();
    let name = |object: &Object, depth: usize| format!("{}{}", "  ".repeat(depth), console::one_line(&object.label));
    let widest = ordered.iter().map(|(object, depth)| name(object, *depth).chars().count()).max().unwrap_or(0).max(5);
    let mut text = format!("{:>5}  {:<widest$}  {:>9}  {:<25}  size\n", "id", "label", "gaussians", "center");
    for (object, depth) in ordered {
        let vector = |v: glam::DVec3| format!("{:.3} {:.3} {:.3}", v.x, v.y, v.z);
        let (center, size) = (vector(object.center), vector(object.half_extents * 2.0));
        let (id, label, count) = (object.id, name(object, depth), object.num_gaussians);
        let _ = writeln!(text, "{id:>5}  {label:<widest$}  {count:>9}  {center:<25}  {size}");
    }
    text
}
