//! The compressed PLY of `PlayCanvas`: each Gaussian takes four words of 32 bits, quantized within the bounds of a `chunk`
//! of 256 Gaussians.

use glam::{DVec3, Vec3};

use super::comments;
use super::header::{Element, Header};
use super::rows::Rows;
use crate::decoded::DecodedScene;
use crate::error::SceneError;
use crate::gaussians::NUM_SH_REST;
use crate::intake::{Intake, RawGaussian, SH_C0};
use crate::source_file::SourceFile;

/// Number of Gaussians per chunk.
const CHUNK: usize = 256;

/// Chunk properties in the order of this module: position bounds, log-scale bounds, color bounds.
const CHUNK_NAMES: [&str; 18] = [
    "min_x",
    "min_y",
    "min_z",
    "max_x",
    "max_y",
    "max_z",
    "min_scale_x",
    "min_scale_y",
    "min_scale_z",
    "max_scale_x",
    "max_scale_y",
    "max_scale_z",
    "min_r",
    "min_g",
    "min_b",
    "max_r",
    "max_g",
    "max_b",
];

/// Vertex properties in the order of this module.
const PACKED_NAMES: [&str; 4] = ["packed_position", "packed_rotation", "packed_scale", "packed_color"];

/// Bounds of a chunk, [low, high] each. Old files have no color bounds; 0 and 1 replace them.
#[derive(Clone, Copy)]
struct Chunk {
    position: [DVec3; 2],
    log_scale: [DVec3; 2],
    color: [DVec3; 2],
}

/// Whether the header is that of a compressed PLY.
pub(super) fn is_compressed(header: &Header) -> bool {
    let has = |element: &str, property: &str| header.element(element).is_some_and(|e| e.find(property).is_some());
    has("chunk", "min_x") && has("vertex", "packed_position")
}

/// Gaussians of a compressed PLY.
///
/// # Errors
/// [`SceneError`] with a `PLY-*` code, [`SceneError::TooManyGaussians`], [`SceneError::OutOfMemory`],
/// [`SceneError::Empty`].
pub(super) fn read(source: &SourceFile, header: &Header) -> Result<DecodedScene, SceneError> {
    let fault = |reason: String| header.fault(source, reason);
    let (mut chunks, mut packed, mut rest): (Vec<Chunk>, Vec<[u32; 4]>, Vec<u8>) = (Vec::new(), Vec::new(), Vec::new());
    let mut num_rest = 0;
    let mut rows = Rows::new(source, header);
    for element in &header.elements {
        rows.check_room(element)?;
        match element.name.as_str() {
            "chunk" => {
                let wanted = chunk_columns(element).map_err(fault)?;
                rows.read(element, &wanted, |row| chunks.push(chunk(row)))?;
            }
            "vertex" => {
                let find = |name: &str| element.find(name).ok_or_else(|| fault(format!("no property {name}")));
                let wanted: Vec<usize> = PACKED_NAMES.into_iter().map(find).collect::<Result<_, _>>()?;
                source.check_count(element.count)?;
                rows.read(element, &wanted, |row| packed.push(std::array::from_fn(|idx| row[idx] as u32)))?;
            }
            "sh" => {
                let wanted = rest_columns(element).map_err(fault)?;
                num_rest = wanted.len() / 3;
                rows.read(element, &wanted, |row| rest.extend(row.iter().map(|value| *value as u8)))?;
            }
            _ => rows.skip(element)?,
        }
    }
    let left = rows.num_left();
    if chunks.len() < packed.len().div_ceil(CHUNK) {
        return Err(fault(format!("{} chunks for {} vertices, expected one per 256", chunks.len(), packed.len())));
    }
    if num_rest > 0 && rest.len() != packed.len() * num_rest * 3 {
        return Err(fault(format!("element sh does not have one row per vertex, expected {}", packed.len())));
    }
    let degree = NUM_SH_REST.iter().position(|n| *n == num_rest).unwrap_or(0) as u8;
    let mut intake = Intake::new(source, packed.len(), degree)?;
    let mut coefficients = vec![Vec3::ZERO; num_rest];
    for (idx, words) in packed.iter().enumerate() {
        let bytes = &rest[idx * num_rest * 3..(idx + 1) * num_rest * 3];
        for (at, coefficient) in coefficients.iter_mut().enumerate() {
            *coefficient = Vec3::from_array(std::array::from_fn(|channel| sh_value(bytes[channel * num_rest + at])));
        }
        intake.push(&gaussian(*words, &chunks[idx / CHUNK]), &coefficients);
    }
    let mut collected = intake.finish(source.path)?;
    if left > 0 {
        collected.notes.push(format!("{left} bytes after the last element are ignored"));
    }
    Ok(DecodedScene {
        format: "compressed ply".to_owned(),
        collected,
        filter: comments::filter(&header.comments),
        up: comments::up(&header.comments),
        further_sha256: Vec::new(),
    })
}

/// Indices of the chunk properties, with or without color bounds.
fn chunk_columns(element: &Element) -> Result<Vec<usize>, String> {
    let num = if element.find("min_r").is_some() { CHUNK_NAMES.len() } else { CHUNK_NAMES.len() - 6 };
    let find = |name: &&str| element.find(name).ok_or_else(|| format!("no property {name} in chunk"));
    CHUNK_NAMES[..num].iter().map(find).collect()
}

/// Indices of the coefficients above degree 0.
fn rest_columns(element: &Element) -> Result<Vec<usize>, String> {
    let num = element.properties.len();
    if ![9, 24, 45].contains(&num) {
        return Err(format!("{num} properties in sh, expected 9, 24 or 45"));
    }
    (0..num)
        .map(|idx| element.find(&format!("f_rest_{idx}")).ok_or_else(|| format!("no property f_rest_{idx} in sh")))
        .collect()
}

fn chunk(row: &[f64]) -> Chunk {
    let at = |start: usize| DVec3::from_slice(&row[start..start + 3]);
    let color = if row.len() == CHUNK_NAMES.len() { [at(12), at(15)] } else { [DVec3::ZERO, DVec3::ONE] };
    Chunk { position: [at(0), at(3)], log_scale: [at(6), at(9)], color }
}

/// Unpacks position and scale (11, 10, 11 bits), rotation (2 bits for the index of the omitted component of wxyz, then
/// 3 x 10 bits), and color with opacity (4 x 8 bits).
fn gaussian([position, rotation, scale, color]: [u32; 4], chunk: &Chunk) -> RawGaussian {
    let lerp = |[low, high]: [DVec3; 2], t: DVec3| low + (high - low) * t;
    let log_scale = lerp(chunk.log_scale, unit_11_10_11(scale));
    let [r, g, b, a] = color.to_be_bytes().map(|byte| f64::from(byte) / 255.0);
    RawGaussian {
        mean: lerp(chunk.position, unit_11_10_11(position)),
        scale: DVec3::new(log_scale.x.exp(), log_scale.y.exp(), log_scale.z.exp()),
        rotation_wxyz: rotation_wxyz(rotation),
        opacity: a,
        sh_dc: (lerp(chunk.color, DVec3::new(r, g, b)) - 0.5) / SH_C0,
    }
}

/// Three numbers in 0..=1 of 11, 10 and 11 bits.
fn unit_11_10_11(word: u32) -> DVec3 {
    DVec3::new(f64::from(word >> 21) / 2047.0, f64::from(word >> 11 & 1023) / 1023.0, f64::from(word & 2047) / 2047.0)
}

/// A quaternion without its largest component, which follows from the unit length.
fn rotation_wxyz(word: u32) -> [f64; 4] {
    let omitted = (word >> 30) as usize;
    let mut wxyz = [0.0; 4];
    let mut shift = 20;
    for (idx, value) in wxyz.iter_mut().enumerate() {
        if idx != omitted {
            *value = (f64::from(word >> shift & 1023) / 1023.0 - 0.5) * std::f64::consts::SQRT_2;
            shift = if shift == 0 { 0 } else { shift - 10 };
        }
    }
    wxyz[omitted] = (1.0 - wxyz.iter().map(|v| v * v).sum::<f64>()).max(0.0).sqrt();
    wxyz
}

/// A coefficient in -4..=4: 0 and 255 are the exact ends, every other byte is the center of its bin.
fn sh_value(byte: u8) -> f32 {
    let unit = match byte {
        0 => 0.0,
        255 => 1.0,
        _ => (f64::from(byte) + 0.5) / 256.0,
    };
    ((unit - 0.5) * 8.0) as f32
}
