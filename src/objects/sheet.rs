//! The contact sheet: one picture that shows every object with its id and label.
//!
//! Enters: a scene and its objects. Leaves: an RGB picture with an overview above one tile per object.

use glam::DVec2;
use image::{Rgb, RgbImage, imageops};
use rayon::prelude::*;

use super::drawing::{self, Ink};
use super::error::ObjectsError;
use super::object::{Object, ObjectSet};
use super::viewpoints::{IdPicture, ViewpointSearch};
use cinesplat_geometry::{Camera, Intrinsics};
use cinesplat_render::{Quality, RenderSettings, Renderer};
use cinesplat_scene::{Scene, SplatFilter};

/// Settings of [`sheet`].
#[derive(Debug, Clone, PartialEq)]
pub struct SheetSettings {
    /// Tiles per row, at least 1.
    pub num_columns: u32,
    /// Width of a tile, at least 64; its picture is three quarters as high.
    pub tile_width_px: u32,
    /// Quality of the pictures.
    pub quality: Quality,
}

impl Default for SheetSettings {
    fn default() -> Self {
        Self { num_columns: 5, tile_width_px: 272, quality: Quality::Standard }
    }
}

const BACKGROUND: Ink = Rgb([24, 24, 28]);
const PAPER: Ink = Rgb([245, 245, 245]);
const INK: Ink = Rgb([12, 12, 14]);

/// Vertical field of view of the overview.
const OVERVIEW_FOV_RAD: f64 = 1.15;
/// Vertical field of view of the tiles: a normal lens.
const TILE_FOV_RAD: f64 = 0.7;

/// Height of the two lines of text under a tile.
const CAPTION_PX: u32 = 44;

/// Space between tiles.
const GAP_PX: u32 = 6;

/// Least visible share of an object. Where less is visible, its tile is clipped in front of the object.
const MIN_VISIBLE_FRAC: f64 = 0.5;

/// Diagonal of a box, over the scene size, below which the overview draws it.
const MAX_BOXED_FRAC: f64 = 0.3;

/// Least number of pixels in the coarse picture of an object whose id the overview shows.
const MIN_ID_PIXELS: usize = 6;

/// Draws the sheet. Each tile shows its object in the scene, with its box, from the direction in which it is least
/// occluded. Where more than half stays occluded, the near plane clips the scene in front of it, and the tile has
/// the mark "cut open".
///
/// # Errors
/// [`ObjectsError::Picture`] where the scene cannot be rendered.
pub fn sheet(scene: &Scene, set: &ObjectSet, settings: &SheetSettings) -> Result<RgbImage, ObjectsError> {
    let no_extent = || ObjectsError::Picture { reason: "the scene has no extent".to_owned() };
    let viewpoints = ViewpointSearch::new(scene, set).ok_or_else(no_extent)?;
    let columns = settings.num_columns.max(1);
    let tile_width = settings.tile_width_px.max(64);
    let picture_height = tile_width * 3 / 4;
    let width = columns * (tile_width + GAP_PX) + GAP_PX;
    let overview_height = width * 9 / 16;
    let row_height = picture_height + CAPTION_PX + GAP_PX;
    let num_rows = (set.objects.len() as u32).div_ceil(columns);
    let mut page = RgbImage::from_pixel(width, overview_height + GAP_PX + num_rows * row_height, BACKGROUND);
    let painter =
        SheetPainter { scene, viewpoints, renderer: Renderer::new(&scene.gaussians), quality: settings.quality };
    imageops::replace(&mut page, &painter.overview(set, width, overview_height)?, 0, 0);
    let tiles: Result<Vec<RgbImage>, ObjectsError> =
        set.objects.par_iter().map(|object| painter.tile(object, tile_width, picture_height)).collect();
    for (i, tile) in tiles?.iter().enumerate() {
        let (column, row) = (i as u32 % columns, i as u32 / columns);
        let left = GAP_PX + column * (tile_width + GAP_PX);
        imageops::replace(&mut page, tile, i64::from(left), i64::from(overview_height + GAP_PX + row * row_height));
    }
    Ok(page)
}

/// The inputs of every picture of the sheet.
struct SheetPainter<'a> {
    scene: &'a Scene,
    viewpoints: ViewpointSearch<'a>,
    renderer: Renderer<'a>,
    quality: Quality,
}

impl SheetPainter<'_> {
    fn overview(&self, set: &ObjectSet, width: u32, height: u32) -> Result<RgbImage, ObjectsError> {
        let camera = self.viewpoints.overview(Intrinsics::from_fov_y(width, height, OVERVIEW_FOV_RAD));
        let mut image = self.photo(&camera, self.scene.bounds().default_near())?;
        let ids = self.viewpoints.id_picture(&camera);
        let seen: Vec<(&Object, DVec2)> = set
            .objects
            .iter()
            .filter_map(|object| Some((object, visible_middle(&ids, object.id)? * f64::from(width) / ids.width as f64)))
            .collect();
        // The boxes of large objects would cover the picture.
        let size = self.scene.bounds().size();
        for (object, _) in seen.iter().filter(|(object, _)| 2.0 * object.radius() < MAX_BOXED_FRAC * size) {
            draw_box(&mut image, &camera, object, 0.0);
        }
        let mut taken = Vec::new();
        for (object, middle) in &seen {
            let place = free_place(&mut taken, *middle, &object.id.to_string());
            drawing::tag(&mut image, place, 2, (INK, ink_of(object.id)), &object.id.to_string());
        }
        let title = format!("{} objects, {} seen from here", set.objects.len(), seen.len());
        drawing::tag(&mut image, (10, 10), 2, (INK, PAPER), &title);
        Ok(image)
    }

    fn tile(&self, object: &Object, width: u32, height: u32) -> Result<RgbImage, ObjectsError> {
        let (camera, seen) = self.viewpoints.closeup(object, Intrinsics::from_fov_y(width, height, TILE_FOV_RAD));
        let near = self.scene.bounds().default_near();
        let distance = (object.center - camera.pose.position).length();
        let is_cut = seen < MIN_VISIBLE_FRAC;
        let near = if is_cut { near.max(distance - 1.05 * object.radius()) } else { near };
        let mut photo = self.photo(&camera, near)?;
        draw_box(&mut photo, &camera, object, near);
        drawing::tag(&mut photo, (8, 8), 3, (INK, ink_of(object.id)), &object.id.to_string());
        let mut tile = RgbImage::from_pixel(width, height + CAPTION_PX, BACKGROUND);
        imageops::replace(&mut tile, &photo, 0, 0);
        let per_line = (i64::from(width) / drawing::text_size_px("m", 2).0).max(1) as usize;
        let lines = wrapped(&format!("{} {}", object.id, object.label), per_line);
        for (row, line) in lines.iter().take(2).enumerate() {
            let top = i64::from(height) + 5 + row as i64 * 19;
            drawing::text(&mut tile, (2, top), 2, PAPER, line);
        }
        if is_cut {
            drawing::tag(&mut tile, (8, i64::from(height) - 12), 1, (PAPER, INK), "cut open");
        }
        Ok(tile)
    }

    fn photo(&self, camera: &Camera, near: f64) -> Result<RgbImage, ObjectsError> {
        let filter = self.scene.filter.unwrap_or(SplatFilter::Classic);
        let settings = RenderSettings { quality: self.quality, filter, near, ..RenderSettings::default() };
        let failed = |reason: String| ObjectsError::Picture { reason };
        let frame = self.renderer.render(camera, &settings).map_err(|error| failed(error.to_string()))?;
        let image = RgbImage::from_raw(frame.width, frame.height, frame.to_rgb8());
        image.ok_or_else(|| failed("the frame has another size than its pixels".to_owned()))
    }
}

/// Mean position of an object's pixels in the coarse picture; `None` below [`MIN_ID_PIXELS`].
fn visible_middle(survey: &IdPicture, id: u32) -> Option<DVec2> {
    let pixels = || survey.ids.iter().enumerate().filter(|(_, other)| u32::from(**other) == id).map(|(i, _)| i);
    let count = pixels().count();
    let sum: DVec2 =
        pixels().map(|i| DVec2::new((i % survey.width) as f64 + 0.5, (i / survey.width) as f64 + 0.5)).sum();
    (count >= MIN_ID_PIXELS).then(|| sum / count as f64)
}

/// Upper left corner of an id near a pixel, moved down past the ids placed before.
fn free_place(taken: &mut Vec<(i64, i64, i64)>, middle_px: DVec2, words: &str) -> (i64, i64) {
    let (width, height) = drawing::text_size_px(words, 2);
    let (x, mut y) = (middle_px.x as i64 - width / 2, middle_px.y as i64 - height / 2);
    while let Some(other) =
        taken.iter().find(|o| (o.1 - y).abs() < height + 5 && o.0 < x + width + 5 && x < o.0 + o.2 + 5)
    {
        y = other.1 + height + 5;
    }
    taken.push((x, y, width));
    (x, y)
}

/// Draws the edges of an object's box whose two ends are beyond the near plane.
fn draw_box(image: &mut RgbImage, camera: &Camera, object: &Object, near: f64) {
    let corners = object.corners().map(|corner| camera.project(corner).filter(|(_, depth)| *depth > near));
    for a in 0..8_usize {
        for b in [a | 1, a | 2, a | 4].into_iter().filter(|&b| b != a) {
            if let (Some((from, _)), Some((to, _))) = (corners[a], corners[b]) {
                drawing::line(image, from, to, ink_of(object.id));
            }
        }
    }
}

/// A bright color per id; the hues of consecutive ids differ by the golden angle.
fn ink_of(id: u32) -> Ink {
    let hue = f64::from(id) * 137.508 / 60.0 % 6.0;
    let channel = |shift: f64| (2.0 - ((hue + shift) % 6.0 - 3.0).abs()).clamp(0.0, 1.0);
    Rgb([channel(5.0), channel(3.0), channel(1.0)].map(|v| (80.0 + 175.0 * (1.0 - v)) as u8))
}

/// Text in lines of at most `per_line` letters; longer words are truncated.
fn wrapped(words: &str, per_line: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in words.split_whitespace() {
        let word: String = word.chars().take(per_line).collect();
        let room = per_line.saturating_sub(lines.last().map_or(0, |line| line.chars().count() + 1));
        match lines.last_mut() {
            Some(line) if line.is_empty() => line.push_str(&word),
            Some(line) if word.chars().count() <= room => {
                line.push(' ');
                line.push_str(&word);
            }
            _ => lines.push(word),
        }
    }
    lines
}
