use std::path::Path;
use std::sync::OnceLock;

use cinesplat_export::shot_json;
use cinesplat_files::{Existing, FileError, Limits, file_checksum, json_excess, sha256_hex};
use cinesplat_render::RenderSettings;
use cinesplat_trajectory::{SceneRef, Shot};
use cinesplat_video::VideoSettings;
use serde_json::{Map, Value};

use super::error::JobError;

const FORMAT: &str = "cinesplat.job";
const VERSION: u64 = 1;
/// Digits of a hash that a message shows.
const SHOWN_DIGITS: usize = 12;

/// What a film is made from, as named values in a fixed order. Equal fingerprints give equal frames.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Fingerprint(Vec<(String, String)>);

impl Fingerprint {
    /// The fingerprint of a shot rendered and encoded with these settings.
    pub(crate) fn of(
        shot: &Shot,
        render: &RenderSettings,
        video: &VideoSettings,
        inputs: &[(&'static str, String)],
    ) -> Self {
        // Every field is named: one that is added does not compile until it is decided whether it counts.
        // Effects set the fog, and stand with the keyframes; the last three change no picture.
        let RenderSettings {
            quality,
            filter,
            near,
            background,
            fog: _,
            sort,
            color_clamp,
            accuracy,
            limits: _,
            instructions: _,
            reuses_order: _,
        } = render;
        let VideoSettings {
            width,
            height,
            rate_fps,
            crf,
            preset,
            first_frame,
            num_frames,
            existing: _,
            is_panorama: _,
            eyes: _,
            has_alpha: _,
        } = video;
        let own = [
            ("engine", engine()),
            ("size", format!("{width}x{height}")),
            ("fps", rate_fps.to_string()),
            ("frames", format!("{first_frame}..{}", first_frame + num_frames)),
            ("duration", shot.duration_secs.to_string()),
            ("keyframes", sha256_hex(path_of(shot).as_bytes())),
            ("quality", quality.as_ref().to_owned()),
            ("filter", format!("{filter:?}").to_lowercase()),
            ("near", near.to_string()),
            ("background", format!("{:?}", background.to_array())),
            ("sort", sort.as_ref().to_owned()),
            ("color-clamp", color_clamp.as_ref().to_owned()),
            ("accuracy", accuracy.map_or_else(String::new, |knobs| format!("{knobs:?}"))),
            ("crf", crf.to_string()),
            ("preset", preset.unwrap_or_default().as_ref().to_owned()),
        ];
        let given = inputs.iter().map(|(name, value)| ((*name).to_owned(), value.clone()));
        Self(given.chain(own.into_iter().map(|(name, value)| (name.to_owned(), value))).collect())
    }

    /// The fingerprint that a folder holds; `None` if it holds none.
    ///
    /// # Errors
    /// [`JobError::Unreadable`], [`JobError::File`].
    pub(crate) fn read(folder: &Path) -> Result<Option<Self>, JobError> {
        let path = folder.join("job.json");
        if !path.exists() {
            return Ok(None);
        }
        let bytes = cinesplat_files::read(&path, Limits::DEFAULT.text_bytes)?;
        let unreadable = |reason: &str| JobError::Unreadable { path: path.clone(), reason: reason.to_owned() };
        json_excess(&bytes, &Limits::DEFAULT).map_or(Ok(()), |excess| Err(unreadable(&excess)))?;
        let json: Value = serde_json::from_slice(&bytes).map_err(|error| unreadable(&error.to_string()))?;
        if json["format"] != FORMAT || json["version"] != VERSION {
            return Err(unreadable("another format or version"));
        }
        let fields = json["made_from"].as_object().ok_or_else(|| unreadable("no made_from"))?;
        let text = |value: &Value| value.as_str().unwrap_or_default().to_owned();
        Ok(Some(Self(fields.iter().map(|(name, value)| (name.clone(), text(value))).collect())))
    }

    /// The value of a field.
    pub(crate) fn value(&self, name: &str) -> Option<&str> {
        self.0.iter().find(|(known, _)| known == name).map(|(_, value)| value.as_str())
    }

    /// Writes the fingerprint into a folder that has none; compares it with that of a folder that has one.
    ///
    /// # Errors
    /// [`JobError::Mismatch`], [`JobError::Unreadable`], [`JobError::File`].
    pub(super) fn write_or_compare(&self, folder: &Path) -> Result<(), JobError> {
        if Self::read(folder)?.is_none() {
            match cinesplat_files::write(&folder.join("job.json"), self.to_json().as_bytes(), Existing::Keep) {
                // Another part of the same film was faster.
                Ok(()) | Err(FileError::Exists { .. }) => {}
                Err(error) => return Err(error.into()),
            }
        }
        let found = Self::read(folder)?.unwrap_or_else(|| self.clone());
        let differences = self.differences(&found);
        if differences.is_empty() {
            return Ok(());
        }
        Err(JobError::Mismatch { path: folder.to_owned(), differences })
    }

    /// One text per field that differs: its value in `earlier`, then the one here.
    fn differences(&self, earlier: &Self) -> Vec<String> {
        let names = self.0.iter().chain(earlier.0.iter().filter(|(name, _)| self.value(name).is_none()));
        names
            .filter(|(name, _)| self.value(name) != earlier.value(name))
            .map(|(name, _)| format!("{name} was {}, now {}", shown(earlier.value(name)), shown(self.value(name))))
            .collect()
    }

    fn to_json(&self) -> String {
        let fields: Map<String, Value> =
            self.0.iter().map(|(name, value)| (name.clone(), value.as_str().into())).collect();
        let json = serde_json::json!({"format": FORMAT, "version": VERSION, "made_from": fields});
        format!("{json:#}\n")
    }
}

/// The version of this program and the checksum of its file: two builds of one version may render different pictures. The
/// programs of a farm are one file. A file that the system does not let the program read counts as that of no build.
fn engine() -> String {
    static ENGINE: OnceLock<String> = OnceLock::new();
    let name = || {
        let version = env!("CARGO_PKG_VERSION");
        // Linux keeps the file of a running program under this name, whatever became of its path.
        let own = Path::new("/proc/self/exe");
        let file = if own.exists() { Ok(own.to_owned()) } else { std::env::current_exe() };
        let build = file.and_then(|file| file_checksum(&file));
        build.map_or_else(|_| version.to_owned(), |build| format!("{version} build {build:016x}"))
    };
    ENGINE.get_or_init(name).clone()
}

/// The camera's path as text: the shot without what no picture depends on, and without what has a field of its own.
fn path_of(shot: &Shot) -> String {
    let path = Shot::from_keyframes([1, 1], 1.0, shot.duration_secs, shot.keyframes.clone());
    let scene = SceneRef { up: shot.scene.up, ..SceneRef::default() };
    // Grain and shake are drawn with the seed.
    let seed = if shot.effects.is_empty() { path.seed } else { shot.seed };
    shot_json::write(&Shot { scene, seed, effects: shot.effects.clone(), ..path })
}

/// A value as a message shows it: hashes are cut.
fn shown(value: Option<&str>) -> String {
    match value {
        None | Some("") => "none".to_owned(),
        Some(hash) if hash.len() == 64 && hash.bytes().all(|c| c.is_ascii_hexdigit()) => {
            format!("{}..", &hash[..SHOWN_DIGITS])
        }
        Some(text) => text.to_owned(),
    }
}
