use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;

use cinesplat_files::{Existing, FileError, NewFile};
use glam::{DVec3, Vec3};

use crate::gaussians::{Gaussians, NUM_SH_REST};

/// Writes Gaussians as a PLY in INRIA's layout: binary little-endian, one property per number, normals 0, log-scales,
/// opacity logits, quaternions wxyz.
///
/// Positions are `float`, or `double` for a scene with a local origin, so that they keep their precision. Object ids, if
/// any, become the property `object_id`. `comments` become comment lines. The file gets its name when it is complete.
///
/// # Errors
/// [`FileError::Exists`] when the file exists and `existing` keeps it, [`FileError::Create`] or [`FileError::Write`] when
/// the system refuses.
pub fn write_ply(path: &Path, gaussians: &Gaussians, comments: &[String], existing: Existing) -> Result<(), FileError> {
    let new = NewFile::create(path, existing)?;
    write_rows(new.file(), gaussians, comments).map_err(|source| FileError::Write { path: path.to_owned(), source })?;
    new.commit()
}

fn write_rows(file: &File, gaussians: &Gaussians, comments: &[String]) -> std::io::Result<()> {
    let mut out = BufWriter::with_capacity(1 << 20, file);
    out.write_all(header(gaussians, comments).as_bytes())?;
    let mut row = Vec::new();
    for idx in 0..gaussians.len() {
        row.clear();
        push_row(&mut row, gaussians, idx);
        out.write_all(&row)?;
    }
    out.flush()
}

fn header(gaussians: &Gaussians, comments: &[String]) -> String {
    let mut lines = vec!["ply".to_owned(), "format binary_little_endian 1.0".to_owned()];
    lines.extend(comments.iter().map(|comment| format!("comment {}", comment.replace(['\n', '\r'], " "))));
    lines.push(format!("element vertex {}", gaussians.len()));
    let position = if gaussians.origin == DVec3::ZERO { "float" } else { "double" };
    lines.extend(["x", "y", "z"].map(|name| format!("property {position} {name}")));
    let num_rest = 3 * NUM_SH_REST[usize::from(gaussians.sh_degree.min(3))];
    let rest: Vec<String> = (0..num_rest).map(|idx| format!("f_rest_{idx}")).collect();
    let before = ["nx", "ny", "nz", "f_dc_0", "f_dc_1", "f_dc_2"];
    let after = ["opacity", "scale_0", "scale_1", "scale_2", "rot_0", "rot_1", "rot_2", "rot_3"];
    let names = before.into_iter().chain(rest.iter().map(String::as_str)).chain(after);
    lines.extend(names.map(|name| format!("property float {name}")));
    if !gaussians.ids.is_empty() {
        lines.push("property ushort object_id".to_owned());
    }
    lines.push("end_header\n".to_owned());
    lines.join("\n")
}

fn push_row(row: &mut Vec<u8>, gaussians: &Gaussians, idx: usize) {
    if gaussians.origin == DVec3::ZERO {
        push_all(row, &gaussians.means[idx].to_array());
    } else {
        row.extend(gaussians.mean_world(idx).to_array().iter().flat_map(|value| value.to_le_bytes()));
    }
    push_all(row, &Vec3::ZERO.to_array());
    push_all(row, &gaussians.sh_dc[idx].to_array());
    let rest = gaussians.sh_rest_of(idx);
    for channel in 0..3 {
        row.extend(rest.iter().flat_map(|coefficient| coefficient[channel].to_le_bytes()));
    }
    push_all(row, &[opacity_logit(gaussians.opacities[idx])]);
    push_all(row, &gaussians.scales[idx].map(|scale| f64::from(scale).ln() as f32).to_array());
    let q = gaussians.rotations[idx];
    push_all(row, &[q.w, q.x, q.y, q.z]);
    if let Some(id) = gaussians.ids.get(idx) {
        row.extend(id.to_le_bytes());
    }
}

fn push_all(row: &mut Vec<u8>, values: &[f32]) {
    row.extend(values.iter().flat_map(|value| value.to_le_bytes()));
}

/// The logit ln(a / (1 - a)) of an opacity a; infinite at 0 and 1.
fn opacity_logit(opacity: f32) -> f32 {
    let opacity = f64::from(opacity);
    (opacity.ln() - (-opacity).ln_1p()) as f32
}
