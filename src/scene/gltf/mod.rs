//! glTF 2.0 with `KHR_gaussian_splatting`: the primitives of all meshes in the scene as one set of Gaussians. Enters: a `.glb`, or a
//! `.gltf` with embedded buffers or buffers in its folder. Leaves: Gaussians in the file's world, which has +y up. Primitives
//! may be compressed as SPZ; other compressions are refused. Reference: the READMEs of the extensions.

mod accessor;
mod nodes;
mod packed;

use std::borrow::Cow;
use std::path::Path;

use glam::{DQuat, DVec3, Vec3};
use serde_json::Value;

use crate::decoded::DecodedScene;
use crate::error::SceneError;
use crate::gaussians::NUM_SH_REST;
use crate::intake::{Intake, RawGaussian};
use crate::source_file::{SourceFile, collected_bytes, read_file};
use accessor::Numbers;
use cinesplat_files::{base64, json_excess};
use nodes::Placed;
use packed::Packed;

const EXTENSION: &str = "KHR_gaussian_splatting";
const HEADER: usize = 12;
const JSON_CHUNK: &[u8] = b"JSON";
const BINARY_CHUNK: &[u8] = b"BIN\0";

/// The columns of a primitive.
struct Primitive {
    positions: Numbers,
    rotations: Numbers,
    scales: Numbers,
    opacities: Numbers,
    /// Coefficients of the spherical harmonics in order, degree 0 first.
    harmonics: Vec<Numbers>,
    degree: u8,
    placed: Placed,
}

/// The buffers of a file, and the SHA-256 of those in files of their own.
type Buffers<'a> = (Vec<Cow<'a, [u8]>>, Vec<String>);

/// Gaussians of a glTF file.
///
/// # Errors
/// [`SceneError::Damaged`] for a file that is no glTF with Gaussians, [`SceneError::NotReadYet`] for compressed primitives,
/// [`SceneError::TooManyGaussians`], [`SceneError::OutOfMemory`], [`SceneError::Empty`].
pub(super) fn read(source: &SourceFile) -> Result<DecodedScene, SceneError> {
    let (text, binary) = chunks(source)?;
    json_excess(text, &source.options.limits).map_or(Ok(()), |excess| Err(damaged(source, excess)))?;
    // The letters of embedded data are in memory twice.
    source.check_memory(0, 0, text.len() as u64)?;
    let json: Value = serde_json::from_slice(text).map_err(|error| damaged(source, format!("not JSON: {error}")))?;
    let (buffers, further_sha256) = buffers(source, &json, binary)?;
    let (mut primitives, mut packed, mut total) = (Vec::new(), Vec::new(), 0);
    for placed in nodes::placed_meshes(&json) {
        let mesh = json.pointer(&format!("/meshes/{}/primitives", placed.mesh)).and_then(Value::as_array);
        for primitive in mesh.into_iter().flatten() {
            if let Some(extension) = primitive.pointer(&format!("/extensions/{EXTENSION}")) {
                let inner = extension.get("extensions");
                if let Some(view) = inner.and_then(packed::view_of) {
                    let source = &SourceFile { held_bytes: collected_bytes(total as usize, 3), ..*source };
                    let read = Packed::read(source, (&json, &buffers), view, placed.clone())?;
                    total += read.len() as u64;
                    source.check_count(total)?;
                    packed.push(read);
                    continue;
                }
                if inner.is_some_and(|inner| inner.as_object().is_some_and(|o| !o.is_empty())) {
                    let format = "glTF with Gaussians in another compression than SPZ";
                    return Err(SceneError::NotReadYet { path: source.path.to_path_buf(), format });
                }
                let read = read_primitive(source, &json, &buffers, primitive, placed.clone())?;
                total += read.positions.count as u64;
                // A mesh may be placed many times.
                let columns = 3 + 4 + 3 + 1 + 3 * NUM_SH_REST[3] as u64;
                source.check_memory(source.check_count(total)?, 3, total.saturating_mul(4 * columns))?;
                primitives.push(read);
            }
        }
    }
    if primitives.is_empty() && packed.is_empty() {
        return Err(damaged(source, format!("no primitive with {EXTENSION}")));
    }
    let count = source.check_count(total)?;
    let packed_degrees = || packed.iter().map(Packed::degrees);
    let degree =
        primitives.iter().map(Primitive::kept_degree).chain(packed_degrees().map(|[_, kept]| kept)).max().unwrap_or(0);
    let mut intake = Intake::new(source, count, degree)?;
    // A few values below 0 are damage, and dropped; logarithms are often below 0.
    let num_negative: usize = primitives.iter().map(Primitive::num_negative_scales).sum();
    let is_log = num_negative * 10 > count;
    primitives.iter().for_each(|primitive| primitive.push_all(&mut intake, (degree, is_log)));
    packed.iter().for_each(|primitive| primitive.push_all(&mut intake, degree));
    let mut collected = intake.finish(source.path)?;
    for primitive in &packed {
        collected.notes.extend(primitive.decoded.collected.notes.iter().map(|note| format!("SPZ: {note}")));
    }
    if !packed.is_empty() {
        collected.notes.push(packed::AXES_NOTE.to_owned());
    }
    if is_log {
        collected.notes.push("scales below 0: read as logarithms, as in drafts of the extension".to_owned());
    }
    let num_flat = primitives.iter().filter(|primitive| primitive.kept_degree() < primitive.degree).count()
        + packed_degrees().filter(|[own, kept]| kept < own).count();
    let num_primitives = primitives.len() + packed.len();
    if num_flat > 0 {
        let what = "rotated primitives are drawn without view-dependent color";
        collected.notes.push(format!("{num_flat} of {num_primitives} {what}"));
    }
    let spz = if packed.is_empty() { String::new() } else { format!(", {} as SPZ", packed.len()) };
    let format = format!("gltf ({num_primitives} primitives{spz})");
    let filter = packed.first().and_then(|primitive| primitive.decoded.filter);
    let up = Some((DVec3::Y, "glTF has +y up".to_owned()));
    Ok(DecodedScene { format, collected, filter, up, further_sha256 })
}

fn damaged(source: &SourceFile, reason: impl Into<String>) -> SceneError {
    SceneError::Damaged { path: source.path.to_path_buf(), byte: 0, reason: reason.into() }
}

/// The JSON and the binary chunk.
fn chunks<'a>(source: &SourceFile<'a>) -> Result<(&'a [u8], Option<&'a [u8]>), SceneError> {
    let bytes = source.bytes;
    if !bytes.starts_with(b"glTF") {
        return Ok((bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes), None));
    }
    let (mut at, mut json, mut binary) = (HEADER, None, None);
    while let Some(head) = bytes.get(at..at + 8) {
        let len = head.first_chunk().map_or(0, |len| u32::from_le_bytes(*len)) as usize;
        let chunk = bytes.get(at + 8..).and_then(|rest| rest.get(..len));
        let chunk =
            chunk.ok_or_else(|| damaged(source, format!("a chunk of {len} bytes at {at}, more than the file has")))?;
        match &head[4..] {
            kind if kind == JSON_CHUNK => json = json.or(Some(chunk)),
            kind if kind == BINARY_CHUNK => binary = binary.or(Some(chunk)),
            _ => {}
        }
        at += 8 + len;
    }
    Ok((json.ok_or_else(|| damaged(source, "no JSON chunk"))?, binary))
}

/// The buffers in order. The binary chunk is the first one, if that has no address; another one without an address holds
/// nothing. With them the SHA-256 of those in files of their own.
fn buffers<'a>(source: &SourceFile, json: &Value, binary: Option<&'a [u8]>) -> Result<Buffers<'a>, SceneError> {
    let list = json.get("buffers").and_then(Value::as_array).map_or(&[][..], Vec::as_slice);
    let (mut found, mut further_sha256, mut num_bytes) = (Vec::new(), Vec::new(), 0);
    for (idx, buffer) in list.iter().enumerate() {
        let uri = buffer.get("uri").and_then(Value::as_str);
        let content = match uri {
            Some(uri) => Cow::Owned(buffer_at(source, uri)?),
            None => Cow::Borrowed(binary.filter(|_| idx == 0).unwrap_or_default()),
        };
        num_bytes += content.len() as u64;
        // Many buffers may name one file.
        source.check_memory(0, 0, num_bytes)?;
        if uri.is_some_and(|uri| !uri.starts_with("data:")) {
            further_sha256.push(cinesplat_files::sha256_hex(&content));
        }
        found.push(content);
    }
    Ok((found, further_sha256))
}

/// The buffer at an address: data in the address itself, or a file beside this one.
fn buffer_at(source: &SourceFile, uri: &str) -> Result<Vec<u8>, SceneError> {
    if let Some((_, data)) = uri.strip_prefix("data:").and_then(|rest| rest.split_once(";base64,")) {
        return base64::decode(data).ok_or_else(|| damaged(source, "a buffer that is not base64"));
    }
    // A scene must not read from elsewhere.
    if uri.is_empty() || uri.contains(['/', '\\', ':']) || uri.starts_with('.') {
        return Err(damaged(source, "a buffer outside of the file's folder"));
    }
    let folder = source.path.parent().unwrap_or(Path::new(""));
    read_file(&folder.join(uri), source.options.limits.scene_bytes)
}

fn read_primitive(
    source: &SourceFile,
    json: &Value,
    buffers: &[Cow<[u8]>],
    primitive: &Value,
    placed: Placed,
) -> Result<Primitive, SceneError> {
    let accessor = |name: &str| primitive.get("attributes")?.get(name)?.as_u64();
    let numbers = |name: &str, width: usize| {
        let Some(idx) = accessor(name) else { return Ok(None) };
        let found = Numbers::new(json, buffers, idx, width);
        found.map(Some).map_err(|reason| damaged(source, format!("{name}: {reason}")))
    };
    let of = |name: &str, width: usize| {
        let name = if name == "POSITION" { name.to_owned() } else { format!("{EXTENSION}:{name}") };
        numbers(&name, width)?.ok_or_else(|| damaged(source, format!("a primitive without {name}")))
    };
    let (mut harmonics, mut degree) = (Vec::new(), 0);
    'degrees: for l in 0..=3_u8 {
        for n in 0..=2 * l {
            match numbers(&format!("{EXTENSION}:SH_DEGREE_{l}_COEF_{n}"), 3)? {
                Some(found) => harmonics.push(found),
                None if l == 0 => return Err(damaged(source, "a primitive without SH_DEGREE_0_COEF_0")),
                None => {
                    harmonics.truncate(usize::from(l * l));
                    break 'degrees;
                }
            }
        }
        degree = l;
    }
    let (positions, rotations) = (of("POSITION", 3)?, of("ROTATION", 4)?);
    let found = Primitive {
        positions,
        rotations,
        scales: of("SCALE", 3)?,
        opacities: of("OPACITY", 1)?,
        harmonics,
        degree,
        placed,
    };
    let count = found.positions.count;
    let columns = [&found.rotations, &found.scales, &found.opacities].into_iter().chain(&found.harmonics);
    if columns.into_iter().any(|column| column.count != count) {
        return Err(damaged(source, "attributes of different counts"));
    }
    Ok(found)
}

impl Primitive {
    /// The degree that is drawn: 0 under a rotated node, because the coefficients are those of unrotated axes.
    fn kept_degree(&self) -> u8 {
        if self.placed.is_upright() { self.degree } else { 0 }
    }

    fn num_negative_scales(&self) -> usize {
        (0..self.scales.count)
            .flat_map(|idx| (0..3).map(move |axis| (idx, axis)))
            .filter(|&(idx, axis)| self.scales.at(idx, axis) < 0.0)
            .count()
    }

    /// Adds the Gaussians with harmonics up to a degree; scales may be logarithms.
    fn push_all(&self, intake: &mut Intake, (degree, is_log): (u8, bool)) {
        let mut rest = vec![Vec3::ZERO; NUM_SH_REST[usize::from(degree)]];
        let own = NUM_SH_REST[usize::from(self.kept_degree())];
        let vector = |numbers: &Numbers, idx: usize| DVec3::from_array(std::array::from_fn(|k| numbers.at(idx, k)));
        for idx in 0..self.positions.count {
            for (coefficient, column) in rest.iter_mut().zip(&self.harmonics[1..]).take(own) {
                *coefficient = vector(column, idx).as_vec3();
            }
            let [x, y, z, w] = std::array::from_fn(|k| self.rotations.at(idx, k));
            let turned = self.placed.rotation * DQuat::from_xyzw(x, y, z, w);
            let raw = RawGaussian {
                mean: self.placed.position + self.placed.rotation * (vector(&self.positions, idx) * self.placed.scale),
                scale: if is_log { vector(&self.scales, idx).exp() } else { vector(&self.scales, idx) }
                    * self.placed.scale,
                rotation_wxyz: [turned.w, turned.x, turned.y, turned.z],
                opacity: self.opacities.at(idx, 0),
                sh_dc: vector(&self.harmonics[0], idx),
            };
            intake.push(&raw, &rest);
        }
    }
}
