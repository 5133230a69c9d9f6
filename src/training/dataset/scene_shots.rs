//! Shots that the operator makes in one generated scene.

use std::path::PathBuf;

use glam::{DQuat, DVec3};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

use super::error::DatasetError;
use super::record::{CameraRecord, ObjectRecord, SceneRecord, ShotRecord};
use super::settings::DatasetSettings;
use crate::sampler::{LabeledPrompt, PromptSampler};
use cinesplat_director::inputs::MAX_POINTS;
use cinesplat_director::keys::{MAX_KEYS, Next, keys_of};
use cinesplat_language::{NamedObject, program_to_notation};
use cinesplat_objects::{CloudSettings, Object, ObjectSet, fill_clouds};
use cinesplat_operator::{Program, Solution, SolveSettings, World, realize};
use cinesplat_scene::{Scene, UpSource};
use cinesplat_synth::{SynthKind, SynthScene, SynthSettings, generate};
use cinesplat_trajectory::Keyframe;

/// Shots of this cost or more are dropped: they violate a constraint of their prompt.
const MAX_COST: f64 = 3.0;

/// A generated scene with its shots. Two of three scenes are rooms, the third is a tabletop.
///
/// # Errors
/// [`DatasetError::Scene`] · [`DatasetError::Objects`] · [`DatasetError::Language`].
pub(super) fn shoot_scene(settings: &DatasetSettings, scene_idx: u64) -> Result<SceneRecord, DatasetError> {
    let seed = settings.seed.wrapping_mul(1_000_003).wrapping_add(scene_idx);
    let kind = if scene_idx % 3 == 2 { SynthKind::Tabletop } else { SynthKind::Room };
    let made = generate(&SynthSettings { seed, kind, detail: settings.detail });
    let (scene, objects) = prepared(made)?;
    let bounds = scene.bounds();
    let ids: Vec<u32> = objects.objects.iter().map(|object| object.id).collect();
    let world = World::new(&scene.gaussians, scene.up, &objects, &ids)
        .map_err(|source| DatasetError::Scene { seed, source })?;
    let prompts = PromptSampler::embedded()?;
    let mut rng = Pcg64::seed_from_u64(seed);
    let named: Vec<NamedObject> =
        objects.objects.iter().map(|object| NamedObject { id: object.id, label: object.label.clone() }).collect();
    let mut shots = Vec::new();
    for _ in 0..settings.shots_per_scene {
        let LabeledPrompt { prompt, program } = prompts.sample(&named, &mut rng);
        let solve = SolveSettings { level: settings.solve, seed: rng.random(), ..SolveSettings::default() };
        let solution = realize(&world, &program, &prompt, &[], &solve);
        shots.extend(shot_record(prompt, &program, &solution));
    }
    Ok(SceneRecord {
        seed,
        up: scene.up.to_array(),
        center: bounds.center().to_array(),
        size: bounds.size(),
        objects: objects.objects.iter().map(object_record).collect(),
        shots,
    })
}

/// The generated scene as a loaded one, and its objects with clouds.
fn prepared(made: SynthScene) -> Result<(Scene, ObjectSet), DatasetError> {
    let scene = Scene {
        path: PathBuf::new(),
        sha256: String::new(),
        format: "generated".into(),
        gaussians: made.gaussians,
        dropped: Vec::new(),
        filter: None,
        up: made.up,
        up_source: UpSource::File("generated".into()),
        notes: Vec::new(),
    };
    let objects = made.objects.into_iter().map(|object| Object {
        rotation: object.rotation,
        num_gaussians: made.labels.iter().filter(|label| u32::from(**label) == object.id).count(),
        ..Object::from_box(object.id, &object.label, object.center, object.half_extents)
    });
    let mut objects = ObjectSet { objects: objects.collect(), labels: made.labels };
    // Fewer views than for a film, because the network sees only 64 points per object.
    let settings = CloudSettings {
        num_azimuths: 4,
        elevations_rad: vec![0.4],
        mask_size_px: 48,
        points: MAX_POINTS,
        ..CloudSettings::default()
    };
    fill_clouds(&scene, &mut objects, &settings).map_err(Box::new)?;
    Ok((scene, objects))
}

/// A solved shot as a record; `None` when it has too many keys, or violates a constraint of its prompt.
fn shot_record(prompt: String, program: &Program, solution: &Solution) -> Option<ShotRecord> {
    let keys = keys_of(program);
    // A shot of cost NaN is dropped too.
    if keys.len() > MAX_KEYS || !(solution.cost < MAX_COST) {
        return None;
    }
    let mut step_idx = 0;
    let mut cameras = Vec::with_capacity(keys.len());
    for key in &keys {
        let starts_at = *solution.step_keys.get(step_idx)?;
        let key_idx = match key.next {
            // Before a cut, the key at which a step ends is the one before the first key of the next step.
            Next::Cut => starts_at.checked_sub(1)?,
            Next::Segment(_) | Next::Stop => starts_at,
        };
        step_idx += usize::from(matches!(key.next, Next::Segment(_)));
        cameras.push(camera_record(solution.keyframes.get(key_idx)?));
    }
    Some(ShotRecord {
        prompt,
        program: program_to_notation(program),
        words: program.steps.iter().map(|step| step.words).collect(),
        cameras,
    })
}

fn camera_record(key: &Keyframe) -> CameraRecord {
    CameraRecord {
        position: rounded(key.pose.position),
        rotation_xyzw: rounded_rotation(key.pose.rotation),
        fov_y_rad: round(key.fov_y_rad),
        time_secs: round(key.time_secs),
    }
}

fn object_record(object: &Object) -> ObjectRecord {
    ObjectRecord {
        id: object.id,
        label: object.label.clone(),
        center: rounded(object.center),
        half_extents: rounded(object.half_extents),
        rotation_xyzw: rounded_rotation(object.rotation),
        points: object.points.iter().map(|point| rounded(*point)).collect(),
    }
}

/// Rounded to 1e-4: precise enough for a scene of some units, and the line stays short.
fn round(value: f64) -> f32 {
    ((value * 1e4).round() / 1e4) as f32
}

fn rounded(point: DVec3) -> [f32; 3] {
    point.to_array().map(round)
}

fn rounded_rotation(rotation: DQuat) -> [f32; 4] {
    rotation.to_array().map(round)
}
