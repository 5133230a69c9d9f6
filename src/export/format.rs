use std::path::Path;

use glam::DVec3;
use serde_json::Value;

use super::columns::{cells, data_lines};
use super::line_layout::{self, EUROC_COLUMNS, FoundLayout, LineLayout, UNIT_TOLERANCE};
use super::stamp_unit::StampUnit;

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
    /// USD: written as text; the binary form and packages are read too.
    Usd,
    /// A Python script for Blender.
    Blender,
    /// A table with all values, one line per frame.
    Csv,
    /// Redwood and Open3D trajectory log: 4 x 4 matrices.
    Log,
    /// `cameras.json` of `still`: named cameras, each with its own lens.
    Cameras,
    /// `cameras.json` of INRIA's 3D Gaussian splatting; read only.
    Inria,
    /// RealEstate10K and CameraCtrl; read only.
    Re10k,
    /// Project Aria's closed-loop trajectory, CSV; read only.
    Aria,
    /// A folder of 7-Scenes with one matrix per frame; read only.
    #[strum(serialize = "7scenes")]
    SevenScenes,
    /// DPVO and others: as TUM, with times in nanoseconds; read only.
    Dpvo,
    /// MotionCtrl's list of matrices; read only.
    #[strum(serialize = "motionctrl")]
    MotionCtrl,
    /// ReCamMaster's cameras; read only.
    #[strum(serialize = "recammaster")]
    ReCamMaster,
    /// A topic of a recording of ROS: a bag or MCAP; read only.
    Ros,
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
            "cameras.json" => return Some(Self::Cameras),
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
        detect_with_layout(bytes).map(|(format, _)| format)
    }

    /// Whether files of the format can be written. Every format can be read.
    pub fn is_written(self) -> bool {
        !matches!(
            self,
            Self::Inria
                | Self::Re10k
                | Self::Aria
                | Self::SevenScenes
                | Self::Dpvo
                | Self::MotionCtrl
                | Self::ReCamMaster
                | Self::Ros
        )
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
            Self::Tum | Self::Euroc | Self::Dpvo | Self::Aria | Self::Ros => Holds { clock: true, ..timed },
            Self::Kitti | Self::Log | Self::SevenScenes | Self::MotionCtrl | Self::ReCamMaster => none,
            Self::Re10k => Holds { clock: true, fov: true, ..timed },
            Self::Nerfstudio => Holds { fov: true, size: true, ..timed },
            Self::Transforms | Self::Colmap | Self::Inria | Self::Cameras => Holds { fov: true, size: true, ..none },
            Self::Supersplat => Holds { fov: true, roll: false, cuts: true, ..timed },
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

/// As [`Format::detect`], with the layout of the lines of TUM and EuRoC.
pub(super) fn detect_with_layout(bytes: &[u8]) -> Option<(Format, Option<FoundLayout>)> {
    if bytes.starts_with(b"glTF") {
        return Some((Format::Gltf, None));
    }
    if super::ros::is_recording(bytes) {
        return Some((Format::Ros, None));
    }
    if bytes.starts_with(b"PK\x03\x04") {
        let format = if super::usd::is_package(bytes) { Format::Usd } else { Format::Supersplat };
        return Some((format, None));
    }
    if bytes.starts_with(b"#usda") || bytes.starts_with(b"PXR-USDC") {
        return Some((Format::Usd, None));
    }
    let text = std::str::from_utf8(bytes).ok()?.trim_start_matches('\u{feff}');
    match text.trim_start().chars().next()? {
        '{' | '[' => Some((detect_json(&super::json_read::parse(text).ok()?)?, None)),
        _ if text.contains("import bpy") => Some((Format::Blender, None)),
        _ => detect_columns(text),
    }
}

/// A reading of lines of poses that their content does not settle.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Doubt {
    /// The reading: format, number of columns, unit of the times, order of the quaternion.
    pub read_as: String,
    /// The format that reads the lines in the other way.
    pub other: Format,
    /// The reading of `other`.
    pub other_reading: String,
}

impl Doubt {
    /// The doubt about a layout; `None` for one that is certain and the format's own.
    pub(super) fn new(format: Format, found: &FoundLayout) -> Option<Self> {
        let FoundLayout { layout, num_columns, shown_unit, is_unit_certain, is_order_certain, .. } = *found;
        let own = match format {
            Format::Tum => LineLayout::TUM,
            Format::Dpvo => LineLayout::DPVO,
            _ => LineLayout::EUROC,
        };
        if is_unit_certain && is_order_certain && layout == own {
            return None;
        }
        // A format that is named decides the order; the text still decides the unit where it shows one.
        let named =
            [(Format::Dpvo, LineLayout::DPVO), (Format::Tum, LineLayout::TUM), (Format::Euroc, LineLayout::EUROC)];
        let resolved = |named: LineLayout| LineLayout { unit: shown_unit.unwrap_or(named.unit), ..named };
        let is_other = |(_, named): &&(Format, LineLayout)| {
            let reads = resolved(*named);
            if is_order_certain { reads.unit != layout.unit } else { reads.order != layout.order }
        };
        let differs = |(_, named): &&(Format, LineLayout)| resolved(*named) != layout;
        let is_at_home = |row: &&(Format, LineLayout)| row.1 == resolved(row.1);
        let mut others = named.iter().filter(is_at_home).chain(&named);
        // A note says that the unit is in doubt, where every format reads the same one.
        let is_noted = shown_unit.is_some() && is_order_certain && layout == own;
        let found_other = others.clone().find(is_other).or(others.find(differs)).filter(|_| !is_noted);
        let (other, other_layout) = found_other.map(|(format, named)| (*format, resolved(*named)))?;
        let reading = |layout: LineLayout| format!("{}, quaternion {}", layout.unit, layout.order);
        Some(Self {
            read_as: format!("{format} ({num_columns} columns, {})", reading(layout)),
            other,
            other_reading: reading(other_layout),
        })
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
        _ if value.pointer("/cameras/0/world_from_camera").is_some() => Some(Format::Cameras),
        _ if value.pointer("/0/rotation").is_some() && value.pointer("/0/position").is_some() => Some(Format::Inria),
        _ if value.pointer("/0/0").is_some() => Some(Format::MotionCtrl),
        _ if has("frame0") => Some(Format::ReCamMaster),
        _ => None,
    }
}

/// The line-based format of a text. Lines of a time, a position and a quaternion come with their layout.
fn detect_columns(text: &str) -> Option<(Format, Option<FoundLayout>)> {
    // RealEstate10K starts with the address of the film.
    let line = data_lines(text).map(|(_, line)| line).find(|line| !line.starts_with("http"))?;
    let columns = cells(line);
    if columns.contains(&super::aria::TIME) {
        return Some((Format::Aria, None));
    }
    if columns.contains(&"time_secs") {
        return Some((Format::Csv, None));
    }
    let numbers: Vec<f64> = columns.iter().filter_map(|column| column.parse().ok()).collect();
    let format = match (columns.len(), numbers.len()) {
        (12, 12) if are_orthonormal_rows(&numbers) => Some(Format::Kitti),
        (13, 13) if are_orthonormal_rows(&numbers[1..]) => Some(Format::Kitti),
        (16, 16)
            if are_orthonormal_rows(&numbers[..12])
                && super::kitti::is_last_row([12, 13, 14, 15].map(|at| numbers[at])) =>
        {
            Some(Format::Kitti)
        }
        (super::re10k::COLUMNS, super::re10k::COLUMNS) if are_orthonormal_rows(&numbers[7..]) => Some(Format::Re10k),
        (3, 3) => Some(Format::Log),
        (10, 9) => Some(Format::Colmap),
        (len, numeric)
            if len >= 5 && numeric == len - 1 && columns[1].chars().all(|c| c.is_ascii_uppercase() || c == '_') =>
        {
            Some(Format::Colmap)
        }
        _ => None,
    };
    if let Some(format) = format {
        return Some((format, None));
    }
    match line_layout::find(text) {
        // The reader of KITTI says which line is no rigid pose.
        None => (numbers.len() == 12 && columns.len() == 12).then_some((Format::Kitti, None)),
        Some(found) => {
            let is_euroc = found.layout.unit == StampUnit::Nanoseconds || found.num_columns == EUROC_COLUMNS;
            let format = match found.layout {
                LineLayout::DPVO if found.has_floating_stamps => Format::Dpvo,
                _ if is_euroc => Format::Euroc,
                _ => Format::Tum,
            };
            Some((format, Some(found)))
        }
    }
}

/// Whether the first three of each four numbers are the rows of a rotation, as in KITTI, within rounding.
fn are_orthonormal_rows(numbers: &[f64]) -> bool {
    let rows: Vec<DVec3> = numbers.chunks_exact(4).map(|row| DVec3::new(row[0], row[1], row[2])).collect();
    let is_unit = |row: &DVec3| (row.length() - 1.0).abs() < UNIT_TOLERANCE;
    rows.iter().all(is_unit) && rows.windows(2).all(|pair| pair[0].dot(pair[1]).abs() < UNIT_TOLERANCE)
}
