use std::path::Path;

use serde_json::Value;

/// The file formats of camera paths.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[derive(strum::AsRefStr, strum::Display, strum::EnumMessage, strum::EnumString, strum::IntoStaticStr)]
#[derive(strum::VariantArray, strum::VariantNames)]
#[strum(serialize_all = "kebab-case")]
pub enum Format {
    /// TUM RGB-D: seconds, position and quaternion per line.
    Tum,
    /// KITTI odometry: one 3 x 4 matrix per line, without times.
    Kitti,
    /// EuRoC MAV ground truth: CSV with times in nanoseconds.
    Euroc,
    /// nerfstudio's `camera_path.json`.
    Nerfstudio,
    /// NeRF's and nerfstudio's `transforms.json`.
    Transforms,
    /// COLMAP sparse model, text or binary.
    Colmap,
    /// SuperSplat viewer settings, version 2; also reads `.ssproj`.
    Supersplat,
    /// LichtFeld Studio timeline, version 4.
    Lichtfeld,
    /// glTF 2.0 with an animated camera.
    Gltf,
    /// USD, text form.
    Usd,
    /// A Python script for Blender.
    Blender,
    /// A table with all values, one line per frame.
    Csv,
    /// Redwood and Open3D trajectory log: 4 x 4 matrices.
    Log,
    /// A `shot.json` of cinesplat.
    Shot,
}

/// What a format can hold besides positions and rotations.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[expect(clippy::struct_excessive_bools, reason = "one row of a table of capabilities")]
pub(super) struct Holds {
    /// Times of the frames.
    pub(super) times: bool,
    /// Times that do not start at 0.
    pub(super) clock: bool,
    /// Fields of view.
    pub(super) fov: bool,
    /// The image size.
    pub(super) size: bool,
    /// Focus distances.
    pub(super) focus: bool,
    /// Easings.
    pub(super) easing: bool,
    /// Cuts.
    pub(super) cuts: bool,
    /// Roll of the camera.
    pub(super) roll: bool,
}

impl Format {
    /// The format of a path by its name; `None` if the name is ambiguous.
    ///
    /// The whole name decides first (`transforms.json`, `camera_path.json`, `images.bin`), then a part before the
    /// extension (`move.shot.json`, `move.kitti.txt`), then the extension. Plain `.json` and `.txt` are ambiguous.
    pub fn from_path(path: &Path) -> Option<Self> {
        let name = path.file_name()?.to_str()?.to_ascii_lowercase();
        match name.as_str() {
            "camera_path.json" => return Some(Self::Nerfstudio),
            "images.txt" | "images.bin" | "cameras.bin" | "cameras.txt" => return Some(Self::Colmap),
            "settings.json" => return Some(Self::Supersplat),
            "trajectory.log" => return Some(Self::Log),
            _ => {}
        }
        let (stem, extension) = name.rsplit_once('.')?;
        if stem.starts_with("transforms") && extension == "json" {
            return Some(Self::Transforms);
        }
        let inner = stem.rsplit(['.', '_']).next().and_then(|name| name.parse().ok());
        match extension {
            "json" | "txt" => match stem {
                _ if stem == "shot" => Some(Self::Shot),
                _ if stem.ends_with("camera_path")
                    || stem.rsplit_once('.').is_some_and(|(_, inner)| inner == "path") =>
                {
                    Some(Self::Nerfstudio)
                }
                _ => inner,
            },
            "csv" => inner.or(Some(Self::Csv)),
            "tum" => Some(Self::Tum),
            "kitti" => Some(Self::Kitti),
            "gltf" | "glb" => Some(Self::Gltf),
            "usda" => Some(Self::Usd),
            "py" => Some(Self::Blender),
            "log" => Some(Self::Log),
            _ => None,
        }
    }

    /// The format of a file by its content; `None` for an unknown one.
    pub fn detect(bytes: &[u8]) -> Option<Self> {
        if bytes.starts_with(b"glTF") {
            return Some(Self::Gltf);
        }
        if bytes.starts_with(b"PK\x03\x04") {
            return Some(Self::Supersplat);
        }
        if bytes.starts_with(b"#usda") || bytes.starts_with(b"PXR-USDC") {
            return Some(Self::Usd);
        }
        let text = std::str::from_utf8(bytes).ok()?.trim_start_matches('\u{feff}');
        match text.trim_start().chars().next()? {
            '{' | '[' => detect_json(&super::json_read::parse(text).ok()?),
            _ if text.contains("import bpy") => Some(Self::Blender),
            _ => detect_columns(text),
        }
    }

    /// What files of the format can hold.
    pub(super) fn holds(self) -> Holds {
        let none = Holds {
            times: false,
            clock: false,
            fov: false,
            size: false,
            focus: false,
            easing: false,
            cuts: false,
            roll: true,
        };
        let timed = Holds { times: true, ..none };
        match self {
            Self::Tum | Self::Euroc => Holds { clock: true, ..timed },
            Self::Kitti | Self::Log => none,
            Self::Nerfstudio => Holds { fov: true, size: true, ..timed },
            Self::Transforms | Self::Colmap => Holds { fov: true, size: true, ..none },
            Self::Supersplat => Holds { fov: true, roll: false, ..timed },
            Self::Lichtfeld => Holds { fov: true, easing: true, ..timed },
            Self::Gltf => Holds { fov: true, cuts: true, ..timed },
            Self::Usd | Self::Blender => Holds { fov: true, size: true, focus: true, cuts: true, ..timed },
            Self::Csv => Holds { clock: true, fov: true, focus: true, cuts: true, easing: true, ..timed },
            Self::Shot => Holds {
                times: true,
                clock: false,
                fov: true,
                size: true,
                focus: true,
                easing: true,
                cuts: true,
                roll: true,
            },
        }
    }
}

fn detect_json(value: &Value) -> Option<Format> {
    let has = |name: &str| value.get(name).is_some();
    match value {
        _ if value.get("format").and_then(Value::as_str) == Some(super::shot_json::FORMAT) => Some(Format::Shot),
        _ if has("camera_path") || (has("keyframes") && has("render_width")) => Some(Format::Nerfstudio),
        _ if has("asset") && (has("nodes") || has("scenes")) => Some(Format::Gltf),
        _ if has("animTracks") || has("poseSets") => Some(Format::Supersplat),
        _ if has("clip_duration") || value.pointer("/keyframes/0/focal_length_mm").is_some() => Some(Format::Lichtfeld),
        _ if value.pointer("/frames/0/transform_matrix").is_some() => Some(Format::Transforms),
        _ => None,
    }
}

/// The line-based format of a text, by its first line with data.
fn detect_columns(text: &str) -> Option<Format> {
    let header = text.lines().next()?;
    if header.contains("time_secs") && header.contains(',') {
        return Some(Format::Csv);
    }
    let line = text.lines().map(str::trim).find(|line| !line.is_empty() && !line.starts_with('#'))?;
    let commas = line.split(',').count();
    if commas >= 8 {
        return Some(Format::Euroc);
    }
    let columns: Vec<&str> = line.split_whitespace().collect();
    let numeric = columns.iter().filter(|column| column.parse::<f64>().is_ok()).count();
    match (columns.len(), numeric) {
        (8, 8) => Some(Format::Tum),
        (12, 12) => Some(Format::Kitti),
        (3, 3) => Some(Format::Log),
        (10, 9) => Some(Format::Colmap),
        (len, numeric)
            if len >= 5 && numeric == len - 1 && columns[1].chars().all(|c| c.is_ascii_uppercase() || c == '_') =>
        {
            Some(Format::Colmap)
        }
        _ => None,
    }
}
