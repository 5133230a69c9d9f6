//! Writes the shards of realized shots that do not exist yet.

use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

use super::error::DatasetError;
use super::realized::read_header;
use super::record::Header;
use super::scene_shots::shoot_scene;
use super::settings::DatasetSettings;
use crate::workers::run_on_threads;
use cinesplat_files::{Existing, FileError, create_folder, write};
use cinesplat_synth::SynthSettings;

/// Scenes of one shard.
const SCENES_PER_SHARD: u64 = 8;

/// Counts of a written dataset.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct DatasetSummary {
    /// Scenes made by this call.
    pub num_scenes: u64,
    /// Shots written by this call.
    pub num_shots: u64,
    /// Shots dropped: they violate a constraint of their prompt, or have too many keys.
    pub num_dropped: u64,
    /// Shards that existed already.
    pub num_shards_kept: u64,
}

impl DatasetSummary {
    fn add(&mut self, other: Self) {
        self.num_scenes += other.num_scenes;
        self.num_shots += other.num_shots;
        self.num_dropped += other.num_dropped;
        self.num_shards_kept += other.num_shards_kept;
    }
}

/// Writes shards of realized shots to the folder `out`. Existing shards of the same settings are kept, so that a
/// repeated call resumes after an interruption. After every scene `report` is called, on any thread, with the
/// numbers of finished scenes and of all scenes.
///
/// # Errors
/// [`DatasetError::BadSetting`] for a level of detail out of range, before any work ·
/// [`DatasetError::OtherSettings`] for an existing shard of other settings, before any work · [`DatasetError::BadLine`]
/// for one without a header · [`DatasetError::File`] · [`DatasetError::Scene`] · [`DatasetError::Objects`] ·
/// [`DatasetError::Language`].
///
/// # Panics
/// A panic on a worker thread resumes in the caller.
pub fn write_dataset(
    settings: &DatasetSettings,
    out: &Path,
    report: &(dyn Fn(u64, u64) + Sync),
) -> Result<DatasetSummary, DatasetError> {
    check_settings(settings)?;
    create_folder(out)?;
    let next = AtomicU64::new(0);
    let done = AtomicU64::new(0);
    let num_shards = settings.num_scenes.div_ceil(SCENES_PER_SHARD);
    (0..num_shards).try_for_each(|shard| check_existing(settings, out, shard))?;
    let scene_done = || report(done.fetch_add(1, Ordering::Relaxed) + 1, settings.num_scenes);
    let work = |_thread: usize| -> Result<DatasetSummary, DatasetError> {
        let mut summary = DatasetSummary::default();
        loop {
            let shard = next.fetch_add(1, Ordering::Relaxed);
            if shard >= num_shards {
                return Ok(summary);
            }
            summary.add(write_shard(settings, out, shard, &scene_done)?);
        }
    };
    let mut total = DatasetSummary::default();
    for summary in run_on_threads(settings.threads, work) {
        total.add(summary?);
    }
    Ok(total)
}

/// Checks that scenes can be generated with these settings.
fn check_settings(settings: &DatasetSettings) -> Result<(), DatasetError> {
    let range = SynthSettings::DETAIL_RANGE;
    // NaN is in no range.
    if range.contains(&settings.detail) {
        return Ok(());
    }
    let expected = format!("{} to {}", range.start(), range.end());
    Err(DatasetError::BadSetting { setting: "detail", found: settings.detail.to_string(), expected })
}

/// Path, scenes and header of a shard.
fn layout(settings: &DatasetSettings, out: &Path, shard: u64) -> (PathBuf, Range<u64>, Header) {
    let scenes = (shard * SCENES_PER_SHARD)..((shard + 1) * SCENES_PER_SHARD).min(settings.num_scenes);
    let header = Header::new(settings, scenes.end - scenes.start);
    (out.join(format!("shots-{shard:05}.jsonl")), scenes, header)
}

/// Checks that a shard has the requested settings, if it exists.
fn check_existing(settings: &DatasetSettings, out: &Path, shard: u64) -> Result<(), DatasetError> {
    let (path, _, expected) = layout(settings, out, shard);
    if !path.exists() {
        return Ok(());
    }
    match read_header(&path)?.difference(&expected) {
        Some([found, expected]) => Err(DatasetError::OtherSettings { path, found, expected }),
        None => Ok(()),
    }
}

/// Writes one shard, unless it exists.
fn write_shard(
    settings: &DatasetSettings,
    out: &Path,
    shard: u64,
    scene_done: &dyn Fn(),
) -> Result<DatasetSummary, DatasetError> {
    let (path, scenes, header) = layout(settings, out, shard);
    if path.exists() {
        scenes.for_each(|_| scene_done());
        return Ok(DatasetSummary { num_shards_kept: 1, ..DatasetSummary::default() });
    }
    let bad = |error: serde_json::Error| FileError::Write { path: path.clone(), source: error.into() };
    let mut text = serde_json::to_string(&header).map_err(bad)? + "\n";
    let mut summary = DatasetSummary::default();
    for scene_idx in scenes {
        let scene = shoot_scene(settings, scene_idx)?;
        let num_shots = scene.shots.len() as u64;
        summary.add(DatasetSummary {
            num_scenes: 1,
            num_shots,
            num_dropped: settings.shots_per_scene - num_shots,
            num_shards_kept: 0,
        });
        text += &(serde_json::to_string(&scene).map_err(bad)? + "\n");
        scene_done();
    }
    write(&path, text.as_bytes(), Existing::Replace)?;
    Ok(summary)
}
