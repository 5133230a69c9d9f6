//! Labels of Gaussians from masks: pictures of ids with known cameras, such as any segmenter's output.
//!
//! Enters: a scene and masks. Leaves: one id per Gaussian. The same id in every picture is the same thing; 0 is none.
//! Each pixel votes for its id with the blending weight of every Gaussian that it shows, and the id with the largest
//! sum wins.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use cinesplat_files::Limits;
use glam::IVec3;
use image::{DynamicImage, ImageFormat};

use super::error::ObjectsError;
use cinesplat_geometry::Camera;
use cinesplat_render::{LiftedValues, RenderError, RenderSettings, Renderer};
use cinesplat_scene::{SOLID_OPACITY, Scene};

/// Ids that are lifted in one pass: memory for their sums.
const IDS_PER_PASS: usize = 15;

/// Side of the cells in which unseen Gaussians follow the seen ones, over the scene size.
const CELL_FRAC: f64 = 0.01;

/// A mask with its camera.
#[derive(Debug, Clone, PartialEq)]
pub struct PosedMask {
    /// Pose and image size of the mask.
    pub camera: Camera,
    /// One id per pixel, row-major.
    pub ids: Vec<u16>,
}

/// The width, height and ids of a mask: a gray PNG of 8 or 16 bits whose values are ids.
///
/// # Errors
/// [`ObjectsError::File`] and [`ObjectsError::BadMask`].
pub fn read_mask(path: &Path) -> Result<(u32, u32, Vec<u16>), ObjectsError> {
    let bad = |found: String| ObjectsError::BadMask { path: path.to_owned(), found };
    let bytes = cinesplat_files::read(path, Limits::DEFAULT.array_bytes)?;
    check_header(&bytes).map_err(bad)?;
    let picture =
        image::load_from_memory_with_format(&bytes, ImageFormat::Png).map_err(|error| bad(error.to_string()))?;
    let (width, height) = (picture.width(), picture.height());
    match picture {
        DynamicImage::ImageLuma8(gray) => Ok((width, height, gray.into_raw().into_iter().map(u16::from).collect())),
        DynamicImage::ImageLuma16(gray) => Ok((width, height, gray.into_raw())),
        other => Err(bad(format!("a picture of type {:?}", other.color()))),
    }
}

/// Refuses what a decoder would turn into other values than those in the file: gray of fewer than 8 bits is scaled, and
/// a palette becomes its colors.
fn check_header(bytes: &[u8]) -> Result<(), String> {
    if !bytes.starts_with(b"\x89PNG\r\n\x1a\n") {
        return Err("a file that is no PNG".to_owned());
    }
    match (bytes.get(24), bytes.get(25)) {
        (_, Some(3)) => Err("a PNG with a palette".to_owned()),
        (Some(bits), Some(0)) if *bits < 8 => Err(format!("a gray PNG of {bits} bits")),
        _ => Ok(()),
    }
}

/// The labels that masks give.
#[derive(Debug, Clone, PartialEq)]
pub struct LiftedLabels {
    /// One id per Gaussian, 0 for none.
    pub labels: Vec<u16>,
    /// Share of the solid Gaussians that any picture shows, 0..=1; of all where none is solid.
    pub seen_share: f64,
}

/// One id per Gaussian from masks, 0 for those that are no object in most pixels that show them. A Gaussian that no
/// picture shows takes the id that most of the opacity around it has. `progress` gets the number of lifted masks, and
/// that of all; a mask counts once per pass.
///
/// # Errors
/// [`ObjectsError::Lift`] when a mask cannot be lifted: its size differs from its camera's, or memory is short.
pub fn lift_masks(
    scene: &Scene,
    masks: &[PosedMask],
    progress: &mut dyn FnMut(usize, usize),
) -> Result<LiftedLabels, ObjectsError> {
    let failed = |error: RenderError| ObjectsError::Lift { reason: error.to_string() };
    let held: Vec<BTreeSet<u16>> = masks.iter().map(|mask| mask.ids.iter().copied().collect()).collect();
    let ids: Vec<u16> = held.iter().flatten().copied().collect::<BTreeSet<u16>>().into_iter().collect();
    let renderer = Renderer::new(&scene.gaussians);
    let settings = RenderSettings::for_scene(scene);
    let mut best: Vec<(f64, u16)> = vec![(0.0, 0); scene.gaussians.len()];
    let mut is_seen = vec![false; best.len()];
    let num_steps = ids.len().div_ceil(IDS_PER_PASS) * masks.len();
    for (pass, chunk) in ids.chunks(IDS_PER_PASS).enumerate() {
        let mut lifted = LiftedValues::new(best.len(), chunk.len());
        for (i, (mask, held)) in masks.iter().zip(&held).enumerate() {
            // The first pass takes every mask: it finds which Gaussians are seen.
            if pass == 0 || chunk.iter().any(|id| held.contains(id)) {
                let values: Vec<f32> =
                    mask.ids.iter().flat_map(|id| chunk.iter().map(move |c| one_if(c == id))).collect();
                renderer.lift(&mask.camera, &settings, &values, &mut lifted).map_err(failed)?;
            }
            progress(pass * masks.len() + i + 1, num_steps);
        }
        count_votes(&lifted, chunk, &mut best, &mut is_seen);
    }
    let labels = best.into_iter().map(|(_, id)| id).collect();
    Ok(LiftedLabels { seen_share: seen_share(scene, &is_seen), labels: with_unseen(scene, labels, &is_seen) })
}

/// Adds the sums of one pass to the largest so far. Of equal sums the smallest id wins.
fn count_votes(lifted: &LiftedValues, chunk: &[u16], best: &mut [(f64, u16)], is_seen: &mut [bool]) {
    for (i, sums) in lifted.sums.chunks_exact(chunk.len()).enumerate() {
        is_seen[i] |= lifted.weights[i] > 0.0;
        for (&sum, &id) in sums.iter().zip(chunk) {
            if sum > best[i].0 {
                best[i] = (sum, id);
            }
        }
    }
}

fn seen_share(scene: &Scene, is_seen: &[bool]) -> f64 {
    let is_solid = |i: usize| scene.gaussians.opacities[i] >= SOLID_OPACITY;
    let has_solid = (0..is_seen.len()).any(is_solid);
    let counted = || (0..is_seen.len()).filter(|&i| !has_solid || is_solid(i));
    counted().filter(|&i| is_seen[i]).count() as f64 / counted().count().max(1) as f64
}

fn one_if(condition: bool) -> f32 {
    f32::from(u8::from(condition))
}

/// The labels, with the unseen Gaussians labeled as most of the seen opacity in their cell of a grid.
fn with_unseen(scene: &Scene, mut labels: Vec<u16>, is_seen: &[bool]) -> Vec<u16> {
    let bounds = scene.bounds();
    let (cell, center) = (CELL_FRAC * bounds.size(), bounds.center());
    if !(cell > 0.0) {
        return labels;
    }
    let key = |i: usize| -> [i32; 3] {
        let at: IVec3 = ((scene.gaussians.mean_world(i) - center) / cell).floor().as_ivec3();
        at.to_array()
    };
    let mut votes: BTreeMap<[i32; 3], BTreeMap<u16, f64>> = BTreeMap::new();
    for i in (0..labels.len()).filter(|&i| is_seen[i]) {
        *votes.entry(key(i)).or_default().entry(labels[i]).or_default() += f64::from(scene.gaussians.opacities[i]);
    }
    let most = |votes: &BTreeMap<u16, f64>| votes.iter().max_by(|a, b| a.1.total_cmp(b.1)).map(|(id, _)| *id);
    for i in (0..labels.len()).filter(|&i| !is_seen[i]) {
        labels[i] = votes.get(&key(i)).and_then(most).unwrap_or(0);
    }
    labels
}
