use std::path::Path;

use super::choices::{KeyCertainty, WordRules};
use super::codes::{self, Field, KeyCode, NEXT_SEGMENT};
use super::decode::{Decoded, decode, level_rotation};
use super::frame::SceneFrame;
use super::ground::{Ground, ground, object_input, others, prompt};
use super::keys::{boundaries_of, steps_of};
use super::model::{PoseCode, PromptBatch};
use super::weights::{Model, ModelFiles, embedded};
use super::{DirectorError, codes::Grounding};
use cinesplat_language::Linked;
use cinesplat_objects::Object;
use cinesplat_operator::{Program, StepCameras};
use cinesplat_trajectory::{CameraState, ModelRef};
use glam::DVec3;

/// Field of view of pose code 0, rad.
const BASE_FOV_RAD: f64 = 50.0 * std::f64::consts::PI / 180.0;

/// How sure the network is of a step of the program.
#[derive(Debug, Clone, PartialEq)]
pub struct StepCertainty {
    /// Probability of all choices of the step together, 0..=1.
    pub probability: f64,
    /// The least sure choice and its probability.
    pub weakest: (&'static str, f64),
    /// Byte range of the prompt that the step comes from.
    pub words: Option<[usize; 2]>,
}

/// What the director makes of a prompt.
#[derive(Debug, Clone, PartialEq)]
pub struct Direction {
    /// What the words ask for.
    pub program: Program,
    /// The cameras that the network proposes for each step.
    pub step_cameras: Vec<StepCameras>,
    /// One a step.
    pub certainty: Vec<StepCertainty>,
}

/// What the director has to know of a scene.
#[derive(Debug, Clone, Copy)]
pub struct Stage<'a> {
    /// Its objects, clouds filled where they are known.
    pub objects: &'a [Object],
    /// World up.
    pub up: DVec3,
    /// Middle of the scene, world.
    pub center: DVec3,
    /// Scene size.
    pub size: f64,
}

/// The trained network: words and objects to keys.
#[derive(Debug, Clone)]
pub struct Director {
    model: Model,
}

impl Director {
    /// The director whose weights are part of the program.
    ///
    /// # Errors
    /// [`DirectorError::BadModel`] when the built-in files do not fit together.
    pub fn embedded() -> Result<Self, DirectorError> {
        Ok(Self { model: Model::load(&embedded())? })
    }

    /// A director from files: a folder, or the `director.json` in it.
    ///
    /// # Errors
    /// [`DirectorError::Read`] · [`DirectorError::BadModel`] when a file is damaged, of another version, or does not
    /// fit the others.
    pub fn load(path: &Path) -> Result<Self, DirectorError> {
        Ok(Self { model: Model::load(&ModelFiles::read(path)?)? })
    }

    /// A director from a model in memory.
    pub fn of(model: Model) -> Self {
        Self { model }
    }

    /// Name and hash of the weights, as shots carry them.
    pub fn model_ref(&self) -> ModelRef {
        ModelRef { name: self.model.manifest.name.clone(), sha256: self.model.manifest.weights_sha256.clone() }
    }

    /// Ids of the objects that the network looks at for a prompt: those that it names, then the nearest of the others.
    pub fn looks_at(linked: &Linked, objects: &[Object]) -> Vec<u32> {
        linked.slots.iter().copied().chain(others(objects, &linked.slots)).collect()
    }

    /// What the words ask for, and where the cameras could stand. The same input gives the same output.
    ///
    /// # Errors
    /// [`DirectorError::PromptTooLong`] · [`DirectorError::EmptyPrompt`] · [`DirectorError::BadScene`].
    pub fn direct(&self, linked: &Linked, stage: &Stage<'_>) -> Result<Direction, DirectorError> {
        let others = others(stage.objects, &linked.slots);
        let (tokens, ground) = ground(linked, &others, &self.model.vocabulary)?;
        let places = || ground.ids.iter().map(|id| stage.objects.iter().find(|object| object.id == *id));
        let frame = SceneFrame::new(stage.up, stage.center, stage.size, places().next().flatten().map(|o| o.center))?;
        let objects = places().enumerate().map(|(place, object)| object.map(|o| object_input(o, place, &frame)));
        let objects = objects.map(Option::unwrap_or_default).collect();
        let prompt = prompt(tokens, objects, &ground, linked.slots.len());
        let batch = PromptBatch::new(&[&prompt], &self.model.manifest.config)?;
        let rules = WordRules { is_time: ground.is_time(), is_move: ground.is_move(&linked.tokens_text) };
        let decoded = decode(&self.model.network, &prompt, &batch, &rules)?;
        direction(&decoded, &ground, &frame)
    }
}

/// The program and cameras of decoded keys.
fn direction(decoded: &Decoded, ground: &Ground, frame: &SceneFrame) -> Result<Direction, DirectorError> {
    let keys: Vec<_> = decoded.keys.iter().map(|code| codes::decode(code, ground)).collect();
    let program = Program {
        steps: steps_of(&keys),
        duration_secs: decoded.film.and_then(|place| ground.seconds(place)),
        unmet: Vec::new(),
    };
    let step_keys = boundaries_of(&keys);
    let certainty = step_keys
        .iter()
        .zip(&program.steps)
        .map(|([start, end], step)| certainty(&decoded.keys, &decoded.certainties, [*start, *end], step.words))
        .collect();
    let cameras = cameras(&decoded.poses, frame)?;
    let ends = step_keys.iter().map_while(|&[start, end]| cameras.get(start).zip(cameras.get(end)));
    let step_cameras = ends
        .map(|((start_secs, start), (end_secs, end))| StepCameras {
            start: *start,
            end: *end,
            secs: end_secs - start_secs,
        })
        .collect();
    Ok(Direction { program, step_cameras, certainty })
}

/// Cameras of pose codes in the world, each with its time from the start of the film. A degenerate rotation falls back to
/// the one before it.
fn cameras(poses: &[PoseCode], frame: &SceneFrame) -> Result<Vec<(f64, CameraState)>, DirectorError> {
    let mut fallback = level_rotation();
    let mut time_secs = 0.0;
    let mut out = Vec::with_capacity(poses.len());
    for code in poses {
        let pose =
            frame.world_pose(glam::Vec3::from(code.position).as_dvec3(), code.rotation_6d.map(f64::from), fallback);
        if !pose.position.is_finite() {
            return Err(DirectorError::NotFinite { field: "position", found: code.position[0] });
        }
        if !out.is_empty() {
            time_secs += f64::from(code.log_wait).exp_m1();
        }
        fallback = frame.turn(pose.rotation);
        let fov_y_rad = fov_rad(code.log_fov);
        out.push((time_secs, CameraState { pose, fov_y_rad, focus_distance: None }));
    }
    Ok(out)
}

/// Field of view of its code.
fn fov_rad(log_fov: f32) -> f64 {
    (BASE_FOV_RAD * f64::from(log_fov).exp()).clamp(0.05, 2.5)
}

/// Code of a field of view.
pub fn log_fov(fov_y_rad: f64) -> f32 {
    (fov_y_rad / BASE_FOV_RAD).ln() as f32
}

/// A step is its departure's choices and its end's arrival.
fn certainty(
    keys: &[KeyCode],
    certainties: &[KeyCertainty],
    [start, end]: [usize; 2],
    words: Option<[usize; 2]>,
) -> StepCertainty {
    let departs = |name: &str| !name.starts_with("end ");
    let of = |key_idx: usize| certainties.get(key_idx).map_or(&[][..], |certainty| &certainty.choices);
    let starts = of(start).iter().filter(|(name, _)| departs(name));
    let ends = of(end).iter().filter(|(name, _)| name.starts_with("end "));
    let mut out = StepCertainty { probability: 1.0, weakest: ("next", 1.0), words };
    if keys.get(start).is_none_or(|key| key.class(Field::Next) != NEXT_SEGMENT) {
        out.probability = 0.0;
    }
    for (name, probability) in starts.chain(ends) {
        out.probability *= probability;
        if *probability < out.weakest.1 {
            out.weakest = (name, *probability);
        }
    }
    out
}
