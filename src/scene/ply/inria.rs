//! The PLY that training programs write: one `vertex` element with one property per number, found by name.

use glam::{DVec3, Vec3};

use super::comments;
use super::header::{Element, Encoding, Header, Scalar};
use super::rows::Rows;
use crate::decoded::DecodedScene;
use crate::error::SceneError;
use crate::filter::SplatFilter;
use crate::gaussians::NUM_SH_REST;
use crate::intake::{Intake, RawGaussian, SH_C0};
use crate::source_file::SourceFile;

/// Names of object-id properties in other programs, the most specific first.
const ID_NAMES: [&str; 9] =
    ["object_id", "instance_id", "obj_id", "ins_id", "segment_id", "instance", "label", "object", "id"];

/// Largest log-scale whose `exp` is finite.
const MAX_LOG_SCALE: f64 = 700.0;

/// Positions of the attributes in a row of read values. The mean comes first, at 0.
struct VertexLayout {
    /// Indices of the properties to read, in the order of the row.
    wanted: Vec<usize>,
    color: usize,
    opacity: usize,
    scale: usize,
    num_scales: usize,
    rotation: usize,
    rest: usize,
    /// Coefficients per channel above degree 0 in the file.
    num_rest: usize,
    /// Coefficients per channel that are kept.
    kept_rest: usize,
    id: Option<usize>,
    /// Value of full red, green or blue; `None` if the file has `f_dc` instead.
    rgb_peak: Option<f64>,
}

/// Gaussians of a PLY with INRIA's properties.
///
/// # Errors
/// [`SceneError`] with a `PLY-*` code, [`SceneError::TooManyGaussians`], [`SceneError::OutOfMemory`],
/// [`SceneError::Empty`].
pub(super) fn read(source: &SourceFile, header: &Header) -> Result<DecodedScene, SceneError> {
    let Some(vertex) = header.element("vertex") else {
        return Err(header.fault(source, "no element vertex".to_owned()));
    };
    let layout = VertexLayout::of(vertex).map_err(|reason| header.fault(source, reason))?;
    let mut rows = Rows::new(source, header);
    for element in header.elements.iter().take_while(|element| element.name != "vertex") {
        rows.skip(element)?;
    }
    rows.check_room(vertex)?;
    let count = source.check_count(vertex.count)?;
    let degree = NUM_SH_REST.iter().position(|n| *n == layout.kept_rest).unwrap_or(0) as u8;
    let mut intake = Intake::new(source, count, degree)?;
    let mut ids: Vec<f64> = Vec::new();
    let mut rest = vec![Vec3::ZERO; layout.kept_rest];
    rows.read(vertex, &layout.wanted, |row| {
        layout.rest_of(row, &mut rest);
        intake.push(&layout.gaussian(row), &rest);
        ids.extend(layout.id.map(|at| row[at]));
    })?;
    let mut collected = intake.finish(source.path)?;
    let notes = &mut collected.notes;
    skip_the_rest(&mut rows, header, notes)?;
    notes.extend(layout_notes(vertex, &layout));
    notes.extend(precision_note(vertex, collected.gaussians.origin));
    if let Some(at) = layout.id {
        let name = &vertex.properties[layout.wanted[at]].name;
        match object_ids(&ids, &collected.dropped) {
            Ok(column) => collected.gaussians.ids = column,
            Err(reason) => notes.push(format!("property {name} is not used as object ids: {reason}")),
        }
    }
    let filter = if vertex.find("filter_3D").is_some() {
        Some(SplatFilter::MipSmall)
    } else {
        comments::filter(&header.comments)
    };
    Ok(DecodedScene {
        format: format_name(header.encoding).to_owned(),
        collected,
        filter,
        up: comments::up(&header.comments),
        further_sha256: Vec::new(),
    })
}

fn format_name(encoding: Encoding) -> &'static str {
    match encoding {
        Encoding::Ascii => "ply (ascii)",
        Encoding::LittleEndian => "ply",
        Encoding::BigEndian => "ply (big-endian)",
    }
}

impl VertexLayout {
    /// Finds the attributes by name; an error names the missing property.
    fn of(vertex: &Element) -> Result<Self, String> {
        let find = |name: &str| vertex.find(name).ok_or_else(|| format!("no property {name}"));
        let mut wanted: Vec<usize> = ["x", "y", "z"].into_iter().map(find).collect::<Result<_, _>>()?;
        let color = wanted.len();
        let rgb_peak = color_columns(vertex, &mut wanted)?;
        let opacity = wanted.len();
        wanted.push(find("opacity")?);
        let scale = wanted.len();
        wanted.push(find("scale_0")?);
        wanted.push(find("scale_1")?);
        wanted.extend(vertex.find("scale_2"));
        let rotation = wanted.len();
        for name in ["rot_0", "rot_1", "rot_2", "rot_3"] {
            wanted.push(find(name)?);
        }
        let rest = wanted.len();
        let num_rest = rest_columns(vertex, &mut wanted)?;
        let kept_rest = num_rest.min(NUM_SH_REST[3]);
        let id = ID_NAMES.iter().find_map(|name| vertex.find(name)).map(|idx| {
            wanted.push(idx);
            wanted.len() - 1
        });
        let num_scales = rotation - scale;
        Ok(Self { wanted, color, opacity, scale, num_scales, rotation, rest, num_rest, kept_rest, id, rgb_peak })
    }

    /// The Gaussian of a row. A missing third scale is 0, as for the flat Gaussians of 2DGS.
    fn gaussian(&self, row: &[f64]) -> RawGaussian {
        let at = |start: usize| DVec3::new(row[start], row[start + 1], row[start + 2]);
        let color = at(self.color);
        let scale = |axis: usize| if axis < self.num_scales { linear_scale(row[self.scale + axis]) } else { 0.0 };
        RawGaussian {
            mean: at(0),
            scale: DVec3::new(scale(0), scale(1), scale(2)),
            rotation_wxyz: std::array::from_fn(|idx| row[self.rotation + idx]),
            opacity: 1.0 / (1.0 + (-row[self.opacity]).exp()),
            sh_dc: self.rgb_peak.map_or(color, |peak| (color / peak - 0.5) / SH_C0),
        }
    }

    /// Copies the coefficients above degree 0 of a row: channel-major in the file, coefficient-major in `rest`.
    fn rest_of(&self, row: &[f64], rest: &mut [Vec3]) {
        let channels: [&[f64]; 3] = std::array::from_fn(|c| &row[self.rest + c * self.num_rest..]);
        for (idx, coefficient) in rest.iter_mut().enumerate() {
            *coefficient = Vec3::new(channels[0][idx] as f32, channels[1][idx] as f32, channels[2][idx] as f32);
        }
    }
}

/// The linear scale of a log-scale: 0 for -Inf, infinite only for +Inf.
fn linear_scale(log_scale: f64) -> f64 {
    if log_scale.is_finite() { log_scale.min(MAX_LOG_SCALE).exp() } else { log_scale.exp() }
}

/// Adds the three color columns; returns the value of full red, green or blue if the file has no `f_dc`.
fn color_columns(vertex: &Element, wanted: &mut Vec<usize>) -> Result<Option<f64>, String> {
    let all = |names: [&str; 3]| names.map(|name| vertex.find(name));
    match all(["f_dc_0", "f_dc_1", "f_dc_2"]) {
        [Some(r), Some(g), Some(b)] => {
            wanted.extend([r, g, b]);
            return Ok(None);
        }
        [None, None, None] => (),
        _ => return Err("f_dc_* is incomplete, expected f_dc_0, f_dc_1 and f_dc_2".to_owned()),
    }
    let [Some(r), Some(g), Some(b)] = all(["red", "green", "blue"]) else {
        return Err("no color: expected f_dc_0 f_dc_1 f_dc_2, or red green blue".to_owned());
    };
    wanted.extend([r, g, b]);
    Ok(Some(match vertex.properties[r].scalar {
        Scalar::I8 | Scalar::U8 => 255.0,
        Scalar::I16 | Scalar::U16 | Scalar::I32 | Scalar::U32 => 65535.0,
        Scalar::F32 | Scalar::F64 => 1.0,
    }))
}

/// Adds the `f_rest_*` columns in numeric order; returns the number of coefficients per channel.
fn rest_columns(vertex: &Element, wanted: &mut Vec<usize>) -> Result<usize, String> {
    let found = vertex.properties.iter().filter(|property| property.name.starts_with("f_rest_")).count();
    if ![0, 9, 24, 45, 72].contains(&found) {
        return Err(format!("{found} properties f_rest_*, expected 0, 9, 24 or 45"));
    }
    for idx in 0..found {
        let name = format!("f_rest_{idx}");
        wanted.push(vertex.find(&name).ok_or_else(|| format!("{found} properties f_rest_* but no {name}"))?);
    }
    Ok(found / 3)
}

/// Skips the elements after `vertex`; a note reports bytes after the last element.
fn skip_the_rest(rows: &mut Rows, header: &Header, notes: &mut Vec<String>) -> Result<(), SceneError> {
    for element in header.elements.iter().skip_while(|element| element.name != "vertex").skip(1) {
        rows.skip(element)?;
    }
    let left = rows.num_left();
    if left > 0 {
        notes.push(format!("{left} bytes after the last element are ignored"));
    }
    Ok(())
}

/// Notes on the kind of scene that follow from its layout.
fn layout_notes(vertex: &Element, layout: &VertexLayout) -> Vec<String> {
    let mut notes = Vec::new();
    if layout.num_scales == 2 {
        notes.push("no scale_2: the Gaussians are flat (2DGS)".to_owned());
    }
    if layout.num_rest > layout.kept_rest {
        notes.push("spherical harmonics of degree 4 are truncated to degree 3".to_owned());
    }
    if vertex.find("filter_3D").is_some() {
        notes.push("filter_3D: splats are dilated by 0.1 px; scales and opacities are used as stored".to_owned());
    }
    notes
}

/// A note on the quantization of single-precision positions far from the origin; `None` near the origin.
fn precision_note(vertex: &Element, origin: DVec3) -> Option<String> {
    let is_single = ["x", "y", "z"]
        .iter()
        .any(|name| vertex.find(name).is_some_and(|i| vertex.properties[i].scalar == Scalar::F32));
    let farthest = origin.abs().max_element() as f32;
    let step = farthest.next_up() - farthest;
    (is_single && farthest > 0.0)
        .then(|| format!("positions are quantized to {step} (stored in single precision far from 0)"))
}

/// The object ids of the Gaussians that were kept, or the reason why the property holds none.
fn object_ids(ids: &[f64], dropped: &[u32]) -> Result<Vec<u16>, String> {
    let mut column = Vec::with_capacity(ids.len());
    let mut next_dropped = dropped.iter().peekable();
    for (file_idx, id) in ids.iter().enumerate() {
        if next_dropped.next_if(|idx| **idx as usize == file_idx).is_some() {
            continue;
        }
        // Some programs write -1 for no object.
        let id = if (-1.0..0.0).contains(id) && id.fract().abs() <= 0.0 { 0.0 } else { *id };
        if !((0.0..=f64::from(u16::MAX)).contains(&id) && id.fract().abs() <= 0.0) {
            return Err(format!("{id} at Gaussian {file_idx}, expected whole numbers from 0 to 65535"));
        }
        column.push(id as u16);
    }
    let mut distinct = column.clone();
    distinct.sort_unstable();
    distinct.dedup();
    if column.len() > 16 && distinct.len() == column.len() {
        return Err("every Gaussian has a different value".to_owned());
    }
    Ok(column)
}
