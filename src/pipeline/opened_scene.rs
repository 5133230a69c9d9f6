use std::path::Path;

use super::error::PipelineError;
use super::panic_point::panic_point;
use cinesplat_objects::{FindSettings, Object, ObjectSet};
use cinesplat_scene::{LoadOptions, Scene, UpSource};
use cinesplat_synth::{SynthKind, SynthScene, SynthSettings};

/// A scene with the objects that are known without a search.
#[derive(Debug, Clone)]
pub struct OpenedScene {
    /// The scene.
    pub scene: Scene,
    /// Exact objects of a generated scene; `None` for a scene from a file.
    pub objects: Option<ObjectSet>,
}

impl OpenedScene {
    /// Whether [`OpenedScene::with_objects`] has to search the scene, which takes seconds.
    pub fn needs_search(&self) -> bool {
        self.objects.is_none() && self.scene.gaussians.ids.is_empty()
    }

    /// The scene with its objects: those of an objects file, else those that come with the scene, else those that a
    /// search finds.
    ///
    /// The up axis of an objects file replaces that of the scene, unless [`LoadOptions::up`] gave one.
    ///
    /// Notes about the objects file are appended to [`Scene::notes`].
    ///
    /// # Errors
    /// [`PipelineError::Objects`] for an objects file that cannot be used.
    pub fn with_objects(self, file: Option<&Path>) -> Result<(Scene, ObjectSet), PipelineError> {
        let Self { mut scene, objects } = self;
        let set = match (file, objects) {
            (Some(file), _) => {
                let read = cinesplat_objects::read(file, &scene)?;
                if let Some(up) = read.up.filter(|_| scene.up_source != UpSource::Flag) {
                    (scene.up, scene.up_source) = (up, UpSource::ObjectsFile);
                }
                scene.notes.extend(read.notes.iter().map(|note| format!("{}: {note}", file.display())));
                read.set
            }
            (None, Some(known)) => known,
            (None, None) if !scene.gaussians.ids.is_empty() => {
                cinesplat_objects::from_labels(&scene, scene.gaussians.ids.clone())
            }
            (None, None) => cinesplat_objects::find(&scene, &FindSettings::default()),
        };
        Ok((scene, set))
    }
}

/// Opens a scene by name: a file, the folder of an unbundled SOG, or a generated scene (`synth:demo`, `synth:room:SEED`,
/// `synth:tabletop:SEED`).
///
/// # Errors
/// [`PipelineError::Scene`] when the file cannot be read, [`PipelineError::UnknownSynth`] for another name that starts
/// with `synth:`.
pub fn open_scene(name: &Path, options: &LoadOptions) -> Result<OpenedScene, PipelineError> {
    panic_point("load", 0);
    match name.to_str().and_then(|name| name.strip_prefix("synth:")) {
        Some(spec) => {
            let settings = synth_settings(spec).ok_or_else(|| unknown(name))?;
            Ok(generated(name, &settings, options))
        }
        None => Ok(OpenedScene { scene: cinesplat_scene::load(name, options)?, objects: None }),
    }
}

fn unknown(name: &Path) -> PipelineError {
    PipelineError::UnknownSynth { found: name.display().to_string() }
}

/// Parses `demo`, `room:7`, `tabletop:3`, or with the level of detail `room:7:0.5`.
fn synth_settings(spec: &str) -> Option<SynthSettings> {
    if spec == "demo" {
        return Some(SynthSettings::default());
    }
    let mut parts = spec.split(':');
    let kind: SynthKind = parts.next()?.parse().ok()?;
    let seed = parts.next()?.parse().ok()?;
    let detail = parts.next().map_or(Some(1.0), |text| text.parse().ok())?;
    let is_whole = parts.next().is_none() && SynthSettings::DETAIL_RANGE.contains(&detail);
    is_whole.then_some(SynthSettings { seed, kind, detail })
}

fn generated(name: &Path, settings: &SynthSettings, options: &LoadOptions) -> OpenedScene {
    let SynthScene { gaussians, objects, labels, up, .. } = cinesplat_synth::generate(settings);
    let (up, up_source) = match options.up.and_then(glam::DVec3::try_normalize) {
        Some(given) => (given, UpSource::Flag),
        None => (up, UpSource::File("generated with y up".to_owned())),
    };
    let mut counts = vec![0_usize; objects.len() + 1];
    for &label in &labels {
        if let Some(count) = counts.get_mut(usize::from(label)) {
            *count += 1;
        }
    }
    let object = |made: cinesplat_synth::SynthObject| Object {
        num_gaussians: counts.get(made.id as usize).copied().unwrap_or(0),
        rotation: made.rotation,
        ..Object::from_box(made.id, &made.label, made.center, made.half_extents)
    };
    let objects = ObjectSet { objects: objects.into_iter().map(object).collect(), labels };
    let scene = Scene {
        path: name.to_owned(),
        sha256: String::new(),
        format: "generated".to_owned(),
        gaussians,
        dropped: Vec::new(),
        filter: None,
        up,
        up_source,
        notes: Vec::new(),
    };
    OpenedScene { scene, objects: Some(objects) }
}
