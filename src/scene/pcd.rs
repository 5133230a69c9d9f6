//! PCD point clouds: every point becomes a small round Gaussian. Enters: bytes, in ASCII, binary or LZF-compressed form.
//! Leaves: Gaussians of degree 0, whose size is the typical distance of neighboring points. Reference: the PCD file format of
//! the Point Cloud Library, version 0.7.

use glam::DVec3;

use super::decoded::DecodedScene;
use super::error::SceneError;
use super::intake::{Intake, RawGaussian, SH_C0};
use super::source_file::SourceFile;

/// Opacity of a point.
const OPACITY: f64 = 0.95;
/// Standard deviation over the distance to the nearest point.
const SIZE_FRAC: f64 = 0.5;
/// Points whose nearest neighbor is searched.
const NUM_SAMPLES: usize = 400;
/// Color of points without one.
const GRAY: [u8; 3] = [160; 3];

/// A field of a point: where its first number lies, how long it is, and its type.
#[derive(Debug, Clone)]
struct Field {
    name: String,
    size: usize,
    kind: u8,
    count: usize,
    /// Offset in a point, bytes.
    offset: usize,
}

struct Header {
    fields: Vec<Field>,
    num_points: usize,
    /// `ascii`, `binary` or `binary_compressed`.
    data: String,
    /// Offset of the data, bytes.
    start: usize,
}

impl Header {
    /// Bytes of a point.
    fn stride(&self) -> usize {
        self.fields.last().map_or(0, |field| field.offset + field.size * field.count)
    }

    fn field(&self, name: &str) -> Option<&Field> {
        self.fields.iter().find(|field| field.name == name)
    }
}

/// The points of a PCD as Gaussians.
///
/// # Errors
/// [`SceneError::Damaged`] for a bad header or missing data, [`SceneError::TooManyGaussians`], [`SceneError::OutOfMemory`],
/// [`SceneError::Empty`].
pub(super) fn read(source: &SourceFile) -> Result<DecodedScene, SceneError> {
    let header = header(source)?;
    let count = source.check_count(header.num_points as u64)?;
    // The data unpacked, and its points before they become Gaussians.
    let point_bytes = header.stride().saturating_add(size_of::<(DVec3, [u8; 3])>());
    source.check_memory(count, 0, header.num_points.saturating_mul(point_bytes) as u64)?;
    let points = points(source, &header)?;
    let size = SIZE_FRAC * spacing(&points);
    let mut intake = Intake::new(source, count, 0)?;
    for (mean, rgb) in &points {
        let color = DVec3::from_array(rgb.map(f64::from)) / 255.0;
        let raw = RawGaussian {
            mean: *mean,
            scale: DVec3::splat(size),
            rotation_wxyz: [1.0, 0.0, 0.0, 0.0],
            opacity: OPACITY,
            sh_dc: (color - 0.5) / SH_C0,
        };
        intake.push(&raw, &[]);
    }
    let mut collected = intake.finish(source.path)?;
    collected
        .notes
        .push(format!("a point cloud: each point is drawn as a round Gaussian of standard deviation {size:.4}"));
    Ok(DecodedScene {
        format: format!("pcd ({})", header.data),
        collected,
        filter: None,
        up: None,
        further_sha256: Vec::new(),
    })
}

fn damaged(source: &SourceFile, byte: usize, reason: impl Into<String>) -> SceneError {
    SceneError::Damaged { path: source.path.to_path_buf(), byte: byte as u64, reason: reason.into() }
}

fn header(source: &SourceFile) -> Result<Header, SceneError> {
    let (mut names, mut sizes, mut kinds, mut counts) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    let (mut num_points, mut area, mut start) = (None, [None, None], 0);
    let most = source.options.limits.header_bytes;
    loop {
        let rest = source.bytes.get(start..(start + most).min(source.bytes.len())).unwrap_or_default();
        let Some(len) = rest.iter().position(|byte| *byte == b'\n').filter(|_| start < most) else {
            return Err(damaged(source, start, "the header ends without a line DATA"));
        };
        let line = String::from_utf8_lossy(&rest[..len]).into_owned();
        let at = start;
        start += len + 1;
        let mut words = line.split_whitespace();
        let key = words.next().unwrap_or_default().to_ascii_uppercase();
        let words: Vec<&str> = words.collect();
        let numbers = || words.iter().map(|word| word.parse::<usize>().ok()).collect::<Option<Vec<_>>>();
        let bad = || damaged(source, at, format!("{key} without numbers"));
        match key.as_str() {
            "FIELDS" | "COLUMNS" => names = words.iter().map(|word| (*word).to_owned()).collect(),
            "SIZE" => sizes = numbers().ok_or_else(bad)?,
            "TYPE" => kinds = words.iter().map(|word| word.as_bytes()[0]).collect(),
            "COUNT" => counts = numbers().ok_or_else(bad)?,
            "WIDTH" => area[0] = numbers().and_then(|found| found.first().copied()),
            "HEIGHT" => area[1] = numbers().and_then(|found| found.first().copied()),
            "POINTS" => num_points = numbers().and_then(|found| found.first().copied()),
            "DATA" => {
                let num_points = num_points.or(area[0].and_then(|width| width.checked_mul(area[1]?)));
                let num_points =
                    num_points.ok_or_else(|| damaged(source, at, "neither POINTS nor WIDTH and HEIGHT"))?;
                let fields = fields(&names, &sizes, &kinds, &counts);
                let fields = fields.ok_or_else(|| damaged(source, at, "FIELDS, SIZE and TYPE that do not fit"))?;
                let data = words.first().map(|word| word.to_ascii_lowercase()).unwrap_or_default();
                return Ok(Header { fields, num_points, data, start });
            }
            _ => {}
        }
    }
}

fn fields(names: &[String], sizes: &[usize], kinds: &[u8], counts: &[usize]) -> Option<Vec<Field>> {
    let mut offset = 0;
    let mut fields = Vec::with_capacity(names.len());
    for (idx, name) in names.iter().enumerate() {
        let (size, kind) = (*sizes.get(idx)?, *kinds.get(idx)?);
        let count = counts.get(idx).copied().unwrap_or(1);
        if !matches!(size, 1 | 2 | 4 | 8) || !(1..=4096).contains(&count) {
            return None;
        }
        fields.push(Field { name: name.clone(), size, kind, count, offset });
        offset += size * count;
    }
    Some(fields)
}

/// Position and color of every point.
fn points(source: &SourceFile, header: &Header) -> Result<Vec<(DVec3, [u8; 3])>, SceneError> {
    let axes = ["x", "y", "z"].map(|name| header.field(name));
    let [Some(x), Some(y), Some(z)] = axes else {
        return Err(damaged(source, 0, "no fields x, y and z"));
    };
    let color = header.field("rgb").or(header.field("rgba"));
    if header.data == "ascii" {
        return ascii_points(source, header, [x, y, z], color);
    }
    let needed = header.stride().saturating_mul(header.num_points);
    let rest = source.bytes.get(header.start..).unwrap_or_default();
    let unpacked;
    let (data, is_by_field) = match header.data.as_str() {
        "binary" => (rest, false),
        "binary_compressed" => {
            unpacked = unpack(source, header.start, rest, needed)?;
            (&unpacked[..], true)
        }
        other => return Err(damaged(source, header.start, format!("DATA {other}"))),
    };
    if data.len() < needed {
        let reason = format!("{} bytes of points, expected {needed}", data.len());
        return Err(damaged(source, header.start, reason));
    }
    let place = |field: &Field, idx: usize| {
        if is_by_field {
            field.offset * header.num_points + idx * field.size * field.count
        } else {
            idx * header.stride() + field.offset
        }
    };
    let point = |idx: usize| {
        let axis = |field: &Field| number(&data[place(field, idx)..], field);
        let rgb = color.filter(|field| field.size == 4).map_or(GRAY, |field| {
            let at = place(field, idx);
            [data[at + 2], data[at + 1], data[at]]
        });
        (DVec3::new(axis(x), axis(y), axis(z)), rgb)
    };
    Ok((0..header.num_points).map(point).collect())
}

fn ascii_points(
    source: &SourceFile,
    header: &Header,
    axes: [&Field; 3],
    color: Option<&Field>,
) -> Result<Vec<(DVec3, [u8; 3])>, SceneError> {
    let text = String::from_utf8_lossy(source.bytes.get(header.start..).unwrap_or_default());
    let column = |field: &Field| {
        header.fields.iter().take_while(|other| other.offset < field.offset).map(|other| other.count).sum::<usize>()
    };
    let columns = axes.map(column);
    let mut points = Vec::new();
    for line in text.lines().filter(|line| !line.trim().is_empty()).take(header.num_points) {
        let cells: Vec<&str> = line.split_whitespace().collect();
        let value = |column: usize| cells.get(column).and_then(|cell| cell.parse::<f64>().ok());
        let [Some(x), Some(y), Some(z)] = columns.map(value) else {
            return Err(damaged(source, header.start, format!("point {}: no three numbers", points.len() + 1)));
        };
        let packed = color.and_then(|field| {
            let cell = cells.get(column(field))?;
            match field.kind {
                b'F' => cell.parse().ok().map(f32::to_bits),
                // The same four bytes are below 0 as a signed number where the highest bit is set.
                _ => cell.parse::<i64>().ok().map(|value| value as u32),
            }
        });
        let rgb = packed.map_or(GRAY, |packed| {
            let [_, red, green, blue] = packed.to_be_bytes();
            [red, green, blue]
        });
        points.push((DVec3::new(x, y, z), rgb));
    }
    if points.len() < header.num_points {
        let reason = format!("{} points, expected {}", points.len(), header.num_points);
        return Err(damaged(source, header.start, reason));
    }
    Ok(points)
}

/// The first number of a field; NaN for an unknown type.
fn number(bytes: &[u8], field: &Field) -> f64 {
    let chunk = |len: usize| bytes.get(..len).unwrap_or_default();
    match (field.kind, field.size) {
        (b'F', 4) => chunk(4).first_chunk().map_or(f64::NAN, |b| f64::from(f32::from_le_bytes(*b))),
        (b'F', 8) => chunk(8).first_chunk().map_or(f64::NAN, |b| f64::from_le_bytes(*b)),
        (b'I', 1) => chunk(1).first().map_or(f64::NAN, |b| f64::from(b.cast_signed())),
        (b'U', 1) => chunk(1).first().map_or(f64::NAN, |b| f64::from(*b)),
        (b'I', 4) => chunk(4).first_chunk().map_or(f64::NAN, |b| f64::from(i32::from_le_bytes(*b))),
        (b'I', 2) => chunk(2).first_chunk().map_or(f64::NAN, |b| f64::from(i16::from_le_bytes(*b))),
        (b'U', 4) => chunk(4).first_chunk().map_or(f64::NAN, |b| f64::from(u32::from_le_bytes(*b))),
        (b'U', 2) => chunk(2).first_chunk().map_or(f64::NAN, |b| f64::from(u16::from_le_bytes(*b))),
        _ => f64::NAN,
    }
}

/// The data of a compressed file: two sizes, then LZF.
fn unpack(source: &SourceFile, start: usize, bytes: &[u8], needed: usize) -> Result<Vec<u8>, SceneError> {
    let size = |at: usize| bytes.get(at..)?.first_chunk().map(|chunk| u32::from_le_bytes(*chunk) as usize);
    let (Some(packed_len), Some(len)) = (size(0), size(4)) else {
        return Err(damaged(source, start, "no sizes of the compressed data"));
    };
    let Some(packed) = bytes.get(8..).and_then(|rest| rest.get(..packed_len)) else {
        return Err(damaged(source, start, format!("{packed_len} compressed bytes, more than the file has")));
    };
    if len != needed || len as u64 > source.options.limits.unpacked(packed_len) {
        return Err(damaged(source, start, format!("unpacks to {len} bytes, expected {needed}")));
    }
    lzf(packed, len).ok_or_else(|| damaged(source, start + 8, "compressed data that does not unpack"))
}

/// Unpacks LZF: a byte below 32 starts that many literal bytes plus 1, every other one a copy of earlier bytes.
fn lzf(packed: &[u8], len: usize) -> Option<Vec<u8>> {
    let mut out: Vec<u8> = Vec::new();
    let mut rest = packed.iter().copied();
    while let Some(control) = rest.next() {
        if control < 32 {
            for _ in 0..=control {
                out.push(rest.next()?);
            }
            continue;
        }
        let mut count = usize::from(control >> 5);
        if count == 7 {
            count += usize::from(rest.next()?);
        }
        let back = (usize::from(control & 31) << 8) + usize::from(rest.next()?) + 1;
        let from = out.len().checked_sub(back)?;
        if out.len() + count + 2 > len {
            return None;
        }
        for idx in from..from + count + 2 {
            out.push(out[idx]);
        }
    }
    (out.len() == len).then_some(out)
}

/// The median distance from a point to its nearest neighbor, of evenly chosen points; 1 where there is none.
fn spacing(points: &[(DVec3, [u8; 3])]) -> f64 {
    let all: Vec<DVec3> = points.iter().map(|(point, _)| *point).filter(|point| point.is_finite()).collect();
    let stride = all.len().div_ceil(NUM_SAMPLES).max(1);
    let nearest = |point: &DVec3| {
        let to_others = all.iter().map(|other| other.distance_squared(*point)).filter(|squared| *squared > 0.0);
        to_others.fold(f64::INFINITY, f64::min).sqrt()
    };
    let mut found: Vec<f64> = all.iter().step_by(stride).map(nearest).filter(|distance| distance.is_finite()).collect();
    found.sort_by(f64::total_cmp);
    found.get(found.len() / 2).copied().unwrap_or(1.0)
}
