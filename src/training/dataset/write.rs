//! Shots made by the operator in generated scenes.

use std::path::PathBuf;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

use glam::{DQuat, DVec3};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

use super::DatasetError;
use super::record::{CameraRecord, FORMAT, Header, ObjectRecord, SceneRecord, ShotRecord, VERSION};
use crate::sampler::{LabeledPrompt, PromptSampler};
use cinesplat_director::ground::MAX_POINTS;
use cinesplat_director::keys::{MAX_KEYS, Next, keys_of};
use cinesplat_files::{Existing, FileError, create_folder, write};
use cinesplat_language::{NamedObject, program_to_notation};
use cinesplat_objects::{CloudSettings, Object, ObjectSet, fill_clouds};
use cinesplat_operator::{Program, Solution, SolveLevel, SolveSettings, World, realize};
use cinesplat_scene::{Scene, UpSource};
use cinesplat_synth::{SynthKind, SynthScene, SynthSettings, generate};
use cinesplat_trajectory::Keyframe;

/// Scenes of one shard.
const SCENES_A_SHARD: u64 = 8;
/// Solutions that cost as much did not find everything that was asked for; nothing is to be learned from them.
const MAX_COST: f64 = 3.0;

/// Which shots to make.
#[derive(Debug, Clone, PartialEq)]
pub struct DatasetSettings {
    /// Folder for the shards.
    pub out: PathBuf,
    /// Seed of scenes and prompts.
    pub seed: u64,
    /// Number of scenes.
    pub scenes: u64,
    /// Shots tried in each.
    pub shots: u64,
    /// Number of Gaussians relative to film quality.
    pub detail: f64,
    /// How long the operator looks for cameras.
    pub solve: SolveLevel,
    /// Threads that make shards side by side.
    pub threads: usize,
}

impl Default for DatasetSettings {
    fn default() -> Self {
        Self { out: PathBuf::new(), seed: 8, scenes: 256, shots: 24, detail: 0.05, solve: SolveLevel::Fast, threads: 2 }
    }
}

/// What was made.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct DatasetSummary {
    /// Scenes made now.
    pub scenes: u64,
    /// Shots written.
    pub shots: u64,
    /// Shots left out: the operator did not find all that was asked for, or they have too many keys.
    pub left_out: u64,
    /// Shards that were there already.
    pub shards_kept: u64,
}

/// Writes shards of realized shots; shards that are there already stay, so that a stopped run goes on. `report` hears of
/// every scene (scenes done, scenes in all).
///
/// # Errors
/// [`FileError::Write`] · [`DatasetError::Scene`] · [`DatasetError::Objects`].
pub fn write_dataset(
    settings: &DatasetSettings,
    report: &(dyn Fn(u64, u64) + Sync),
) -> Result<DatasetSummary, DatasetError> {
    create_folder(&settings.out)?;
    let next = AtomicU64::new(0);
    let done = AtomicU64::new(0);
    let total = Mutex::new(DatasetSummary::default());
    let num_shards = settings.scenes.div_ceil(SCENES_A_SHARD);
    let work = || -> Result<(), DatasetError> {
        loop {
            let shard = next.fetch_add(1, Ordering::Relaxed);
            if shard >= num_shards {
                return Ok(());
            }
            let made = write_shard(settings, shard, &|| {
                report(done.fetch_add(1, Ordering::Relaxed) + 1, settings.scenes);
            })?;
            let mut total = total.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
            total.scenes += made.scenes;
            total.shots += made.shots;
            total.left_out += made.left_out;
            total.shards_kept += made.shards_kept;
        }
    };
    std::thread::scope(|scope| {
        let others: Vec<_> = (1..settings.threads.max(1)).map(|_| scope.spawn(work)).collect();
        let mut result = work();
        for other in others {
            result = result.and(other.join().unwrap_or(Ok(())));
        }
        result
    })?;
    Ok(total.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner))
}

fn write_shard(settings: &DatasetSettings, shard: u64, scene_done: &dyn Fn()) -> Result<DatasetSummary, DatasetError> {
    let path = settings.out.join(format!("shots-{shard:05}.jsonl"));
    let scenes = (shard * SCENES_A_SHARD)..((shard + 1) * SCENES_A_SHARD).min(settings.scenes);
    if path.exists() {
        scenes.for_each(|_| scene_done());
        return Ok(DatasetSummary { shards_kept: 1, ..DatasetSummary::default() });
    }
    let bad = |error: serde_json::Error| FileError::Write { path: path.clone(), source: error.into() };
    let header = Header { format: FORMAT.into(), version: VERSION, seed: settings.seed };
    let mut text = serde_json::to_string(&header).map_err(bad)? + "\n";
    let mut summary = DatasetSummary::default();
    for scene_idx in scenes {
        let scene = shoot_scene(settings, scene_idx)?;
        summary.scenes += 1;
        summary.shots += scene.shots.len() as u64;
        summary.left_out += settings.shots - scene.shots.len() as u64;
        text += &(serde_json::to_string(&scene).map_err(bad)? + "\n");
        scene_done();
    }
    write(&path, text.as_bytes(), Existing::Replace)?;
    Ok(summary)
}

/// One generated scene with its shots. Two of three scenes are rooms.
fn shoot_scene(settings: &DatasetSettings, scene_idx: u64) -> Result<SceneRecord, DatasetError> {
    let seed = settings.seed.wrapping_mul(1_000_003).wrapping_add(scene_idx);
    let kind = if scene_idx % 3 == 2 { SynthKind::Tabletop } else { SynthKind::Room };
    let made = generate(&SynthSettings { seed, kind, detail: settings.detail });
    let (scene, objects) = prepared(made)?;
    let bounds = scene.bounds();
    let ids: Vec<u32> = objects.objects.iter().map(|object| object.id).collect();
    let world = World::new(&scene.gaussians, scene.up, &objects, &ids)
        .map_err(|source| DatasetError::Scene { seed, source })?;
    let phrasebook = PromptSampler::embedded()?;
    let mut rng = Pcg64::seed_from_u64(seed);
    let named: Vec<NamedObject> =
        objects.objects.iter().map(|object| NamedObject { id: object.id, label: object.label.clone() }).collect();
    let mut shots = Vec::new();
    for _ in 0..settings.shots {
        let LabeledPrompt { prompt, program } = phrasebook.sample(&named, &mut rng);
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

/// The scene as if it had been read, and its objects with clouds.
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
        id: object.id,
        label: object.label,
        center: object.center,
        half_extents: object.half_extents,
        rotation: object.rotation,
        num_gaussians: made.labels.iter().filter(|label| u32::from(**label) == object.id).count(),
        points: Vec::new(),
        shape_radius: 0.0,
        mask_iou: 0.0,
    });
    let mut objects = ObjectSet { objects: objects.collect(), labels: made.labels };
    // Fewer views than for a film: the network sees 64 points of each object.
    let settings = CloudSettings {
        num_azimuths: 4,
        elevations_rad: vec![0.4],
        mask_size_px: 48,
        search_budget: 6,
        max_points: MAX_POINTS,
        ..CloudSettings::default()
    };
    fill_clouds(&scene, &mut objects, &settings).map_err(Box::new)?;
    Ok((scene, objects))
}

/// A solved shot as a line; `None` where it did not turn out as asked.
fn shot_record(prompt: String, program: &Program, solution: &Solution) -> Option<ShotRecord> {
    let keys = keys_of(program);
    // Written so that NaN is left out.
    if keys.len() > MAX_KEYS || !(solution.cost < MAX_COST) {
        return None;
    }
    let mut step_idx = 0;
    let mut cameras = Vec::with_capacity(keys.len());
    for key in &keys {
        let starts_at = *solution.step_keys.get(step_idx)?;
        let key_idx = match key.next {
            // The key that a step ends at before a cut is the one before the next step's first.
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

/// To a tenth of a thousandth: a scene is some units large, and the line stays short.
fn round(value: f64) -> f32 {
    ((value * 1e4).round() / 1e4) as f32
}

fn rounded(point: DVec3) -> [f32; 3] {
    point.to_array().map(round)
}

fn rounded_rotation(rotation: DQuat) -> [f32; 4] {
    rotation.to_array().map(round)
}
