//! Shots read from shards, as inputs of the network.

use std::fs::File;
use std::io::{BufRead, BufReader, Read, Take};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::{DQuat, DVec3, Vec3};
use rand::RngExt;
use rand::seq::SliceRandom;
use rand_pcg::Pcg64;

use super::error::DatasetError;
use super::record::{CameraRecord, FORMAT, Header, ObjectRecord, SceneRecord, ShotRecord, VERSION};
use cinesplat_director::SceneFrame;
use cinesplat_director::codes::{PoseCode, log_fov};
use cinesplat_director::inputs::{MAX_OTHER_OBJECTS, ObjectInput, object_input};
use cinesplat_files::{FileError, Limits};
use cinesplat_geometry::Pose;
use cinesplat_language::{Linked, NamedObject, NotationError, link, program_from_notation};
use cinesplat_objects::Object;
use cinesplat_operator::Program;

/// A scene of a shard.
#[derive(Debug, Clone)]
struct ShardScene {
    up: DVec3,
    center: DVec3,
    size: f64,
    objects: Vec<Object>,
}

/// One shot that the operator realized.
#[derive(Debug, Clone)]
pub(crate) struct RealizedShot {
    scene: Arc<ShardScene>,
    prompt: String,
    /// Meaning of the prompt.
    pub(crate) program: Program,
    cameras: Vec<CameraRecord>,
}

/// A shot as inputs of the network.
pub(crate) struct ShotInputs {
    /// Ids of the objects that the prompt does not name.
    pub(crate) others: Vec<u32>,
    /// The named objects, then the others.
    pub(crate) objects: Vec<ObjectInput>,
    /// One per key.
    pub(crate) poses: Vec<PoseCode>,
}

impl RealizedShot {
    /// The linked prompt.
    ///
    /// # Errors
    /// [`DatasetError::Language`].
    pub(crate) fn linked(&self) -> Result<Linked, DatasetError> {
        let named = |object: &Object| NamedObject { id: object.id, label: object.label.clone() };
        Ok(link(&self.prompt, &self.scene.objects.iter().map(named).collect::<Vec<_>>())?)
    }

    /// Objects and cameras in the scene's frame, with a random subset of the unnamed objects. The frame has a random
    /// heading if the prompt names no object.
    ///
    /// # Errors
    /// [`DatasetError::Director`] for a scene without extent or up direction.
    pub(crate) fn inputs(&self, linked: &Linked, rng: &mut Pcg64) -> Result<ShotInputs, DatasetError> {
        let scene = &*self.scene;
        let find = |id: u32| scene.objects.iter().find(|object| object.id == id);
        let anywhere =
            DVec3::new(rng.random_range(-1.0..1.0), rng.random_range(-1.0..1.0), rng.random_range(-1.0..1.0));
        let first = linked.slots.first().and_then(|id| find(*id)).map(|object| object.center);
        let toward = first.unwrap_or(scene.center + anywhere * scene.size);
        let frame = SceneFrame::new(scene.up, scene.center, scene.size, Some(toward)).map_err(Box::new)?;
        let mut others: Vec<u32> = scene.objects.iter().map(|o| o.id).filter(|id| !linked.slots.contains(id)).collect();
        others.shuffle(rng);
        others.truncate(rng.random_range(0..=MAX_OTHER_OBJECTS));
        let ids = linked.slots.iter().chain(&others);
        let objects = ids
            .enumerate()
            .map(|(place, id)| find(*id).map_or_else(ObjectInput::default, |o| object_input(o, place, &frame)));
        Ok(ShotInputs { objects: objects.collect(), others, poses: self.poses(&frame) })
    }

    fn poses(&self, frame: &SceneFrame) -> Vec<PoseCode> {
        let mut last_secs = 0.0;
        let code = |camera: &CameraRecord| {
            let rotation = DQuat::from_array(camera.rotation_xyzw.map(f64::from));
            let (position, rotation_6d) = frame.pose(&Pose::new(Vec3::from(camera.position).as_dvec3(), rotation));
            let wait_secs = (camera.time_secs - last_secs).max(0.0);
            last_secs = camera.time_secs;
            PoseCode {
                position: position.as_vec3().to_array(),
                rotation_6d: rotation_6d.map(|value| value as f32),
                log_fov: log_fov(f64::from(camera.fov_y_rad)),
                log_wait: wait_secs.ln_1p(),
            }
        };
        self.cameras.iter().map(code).collect()
    }
}

/// All shots of the shards (`*.jsonl`) of a folder, in order of file names.
///
/// # Errors
/// [`DatasetError::File`] · [`DatasetError::BadLine`] naming the first malformed line.
pub(crate) fn read_shards(folder: &Path) -> Result<Vec<RealizedShot>, DatasetError> {
    let failed = |source| FileError::Read { path: folder.to_owned(), source };
    let entries = std::fs::read_dir(folder).map_err(failed)?.collect::<Result<Vec<_>, _>>().map_err(failed)?;
    let mut paths: Vec<PathBuf> = entries.into_iter().map(|entry| entry.path()).collect();
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "jsonl"));
    paths.sort();
    let mut shots = Vec::new();
    for path in paths {
        read_shard(&path, &mut shots)?;
    }
    Ok(shots)
}

/// The first line of a shard.
///
/// # Errors
/// [`DatasetError::File`] · [`DatasetError::BadLine`].
pub(super) fn read_header(path: &Path) -> Result<Header, DatasetError> {
    let failed = |source| FileError::Read { path: path.to_owned(), source };
    let mut line = String::new();
    BufReader::new(open(path)?).read_line(&mut line).map_err(failed)?;
    header_of(path, &line)
}

/// A shard, of the bytes that a scene may have. Opening a pipe would wait for a writer.
fn open(path: &Path) -> Result<Take<File>, FileError> {
    let failed = |source| FileError::Read { path: path.to_owned(), source };
    if !std::fs::metadata(path).map_err(failed)?.is_file() {
        return Err(FileError::NotAFile { path: path.to_owned(), found: "a folder, pipe or device" });
    }
    Ok(File::open(path).map_err(failed)?.take(Limits::DEFAULT.scene_bytes))
}

fn header_of(path: &Path, line: &str) -> Result<Header, DatasetError> {
    let bad = |found: String, expected| DatasetError::BadLine { path: path.to_owned(), line: 1, found, expected };
    let header: Header = serde_json::from_str(line).map_err(|error| bad(error.to_string(), "a header"))?;
    if header.format != FORMAT || header.version != VERSION {
        return Err(bad(format!("{} {}", header.format, header.version), "cinesplat.shots version 1"));
    }
    Ok(header)
}

fn read_shard(path: &Path, shots: &mut Vec<RealizedShot>) -> Result<(), DatasetError> {
    let failed = |source| FileError::Read { path: path.to_owned(), source };
    for (line_idx, line) in BufReader::new(open(path)?).lines().enumerate() {
        let line = line.map_err(failed)?;
        if line_idx == 0 {
            header_of(path, &line)?;
            continue;
        }
        let bad = |found: String, expected| DatasetError::BadLine {
            path: path.to_owned(),
            line: line_idx + 1,
            found,
            expected,
        };
        let scene: SceneRecord = serde_json::from_str(&line).map_err(|error| bad(error.to_string(), "a scene"))?;
        shots.extend(shots_of(scene).map_err(|found| bad(found.to_string(), "a program in the notation"))?);
    }
    Ok(())
}

fn shots_of(scene: SceneRecord) -> Result<Vec<RealizedShot>, NotationError> {
    let shared = Arc::new(ShardScene {
        up: DVec3::from(scene.up),
        center: DVec3::from(scene.center),
        size: scene.size,
        objects: scene.objects.into_iter().map(object_of).collect(),
    });
    let shot = |record: ShotRecord| {
        let mut program = program_from_notation(&record.program)?;
        for (step, words) in program.steps.iter_mut().zip(&record.words) {
            step.words = *words;
        }
        Ok(RealizedShot { scene: shared.clone(), prompt: record.prompt, program, cameras: record.cameras })
    };
    scene.shots.into_iter().map(shot).collect()
}

fn object_of(record: ObjectRecord) -> Object {
    let [x, y, z, w] = record.rotation_xyzw.map(f64::from);
    let [center, half_extents] = [record.center, record.half_extents].map(|values| Vec3::from(values).as_dvec3());
    Object {
        rotation: DQuat::from_xyzw(x, y, z, w).normalize(),
        points: record.points.into_iter().map(|point| Vec3::from(point).as_dvec3()).collect(),
        ..Object::from_box(record.id, &record.label, center, half_extents)
    }
}
