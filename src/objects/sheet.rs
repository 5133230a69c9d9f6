//! The contact sheet: every object with its id and name.
//!
//! Enters: a scene and its objects. Leaves: an overview, and one picture per object before its dimmed surroundings.

use std::collections::{BTreeMap, BTreeSet};

use glam::DVec2;
use image::{Rgb, RgbImage, imageops};
use rayon::prelude::*;

use super::drawing::{self, Ink};
use super::error::ObjectsError;
use super::object::{Object, ObjectSet};
use super::photo::{TILE_FOV_RAD, photo, photo_before};
use super::up_views::{UpView, up_views};
use super::viewpoints::{IdPicture, MIN_ID_PIXELS, ThinnedScene, ViewpointSearch};
use cinesplat_geometry::{Camera, Intrinsics};
use cinesplat_render::{Quality, Renderer};
use cinesplat_scene::Scene;

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

impl SheetSettings {
    fn tile_size_px(&self) -> (u32, u32) {
        let width = self.tile_width_px.max(64);
        (width, width * 3 / 4)
    }

    /// Upper left corner of the i-th tile below a height.
    fn place(&self, height: u32, i: u32) -> (i64, i64) {
        let columns = self.num_columns.max(1);
        let (width, picture_height) = self.tile_size_px();
        let left = GAP_PX + i % columns * (width + GAP_PX);
        let top = height + GAP_PX + i / columns * (picture_height + CAPTION_PX + GAP_PX);
        (left.into(), top.into())
    }

    fn overview_size_px(&self) -> (u32, u32) {
        let width = self.num_columns.max(1) * (self.tile_size_px().0 + GAP_PX) + GAP_PX;
        (width, width * 9 / 16)
    }
}

const BACKGROUND: Ink = Rgb([24, 24, 28]);
const PAPER: Ink = Rgb([245, 245, 245]);
const INK: Ink = Rgb([12, 12, 14]);

/// Vertical field of view of the overview.
const OVERVIEW_FOV_RAD: f64 = 1.15;

/// Height of the two lines of text under a tile.
const CAPTION_PX: u32 = 44;

/// Space between tiles.
const GAP_PX: u32 = 6;

/// Distance before the middle of an object, over its radius, from which a tile shows what is around it.
const CONTEXT_RADII: f64 = 1.2;

/// Step to the right of the caption of a part.
const INDENT_PX: i64 = 16;

/// Diagonal of a box, over the scene size, below which the overview draws it.
const MAX_BOXED_FRAC: f64 = 0.3;

/// The pictures of a sheet.
#[derive(Debug, Clone, PartialEq)]
pub struct Sheet {
    /// The scene with the number of every object that is seen: one picture, or up to three of a room.
    pub overviews: Vec<RgbImage>,
    /// One picture per object, each whole followed by its parts.
    pub tiles: Vec<Tile>,
    /// If up is a guess: the scene with each direction that may be up, most likely first.
    pub up_views: Vec<UpView>,
}

/// The picture of one object.
#[derive(Debug, Clone, PartialEq)]
pub struct Tile {
    /// Id of the object.
    pub id: u32,
    /// Its name.
    pub label: String,
    /// How many wholes it is a part of, one inside the other.
    pub depth: usize,
    /// The object from the direction in which most of it is seen in its scene, uncovered; what is around it is gray and dim.
    pub picture: RgbImage,
}

/// Draws the pictures of all objects.
///
/// # Errors
/// [`ObjectsError::Picture`] for a scene without extent, or where a picture cannot be rendered.
pub fn sheet(scene: &Scene, set: &ObjectSet, settings: &SheetSettings) -> Result<Sheet, ObjectsError> {
    let no_extent = || ObjectsError::Picture { reason: "the scene has no extent".to_owned() };
    let thinned = ThinnedScene::new(scene, set);
    let viewpoints = ViewpointSearch::new(scene, set, &thinned).ok_or_else(no_extent)?;
    let painter = SheetPainter {
        scene,
        set,
        renderer: Renderer::new(&scene.gaussians),
        viewpoints,
        members: set.members(),
        settings,
    };
    let ordered = set.with_parts();
    let overviews = painter.overviews()?;
    let tiles: Result<Vec<Tile>, ObjectsError> =
        ordered.into_par_iter().map(|(object, depth)| painter.tile(object, depth)).collect();
    Ok(Sheet { overviews, tiles: tiles?, up_views: up_views(scene, settings.tile_size_px(), settings.quality)? })
}

impl Sheet {
    /// The sheet as one picture: the overview above the tiles with their captions.
    pub fn page(&self, settings: &SheetSettings) -> RgbImage {
        let columns = settings.num_columns.max(1);
        let (tile_width, picture_height) = settings.tile_size_px();
        let row_height = picture_height + CAPTION_PX + GAP_PX;
        let num_rows = (self.tiles.len() as u32).div_ceil(columns);
        let num_up_rows = (self.up_views.len() as u32).div_ceil(columns);
        let overview_height: u32 = self.overviews.iter().map(RgbImage::height).sum();
        let tiles_top = overview_height + num_up_rows * row_height;
        let height = tiles_top + GAP_PX + num_rows * row_height;
        let mut page = RgbImage::from_pixel(settings.overview_size_px().0, height, BACKGROUND);
        let mut top = 0;
        for overview in &self.overviews {
            imageops::replace(&mut page, overview, 0, top);
            top += i64::from(overview.height());
        }
        for (i, view) in (0..).zip(&self.up_views) {
            view.draw(&mut page, settings.place(overview_height, i), picture_height);
        }
        for (i, tile) in (0..).zip(&self.tiles) {
            let (left, top) = settings.place(tiles_top, i);
            imageops::replace(&mut page, &tile.picture, left, top);
            let indent = INDENT_PX * tile.depth.min(3) as i64;
            if tile.depth > 0 {
                drawing::fill(&mut page, (left, top), (4, i64::from(picture_height + CAPTION_PX)), ink_of(tile.id));
            }
            let per_line = ((i64::from(tile_width) - indent) / drawing::text_size_px("m", 2).0).max(1) as usize;
            let lines = wrapped(&format!("{} {}", tile.id, tile.label), per_line);
            for (line_idx, line) in lines.iter().take(2).enumerate() {
                let y = top + i64::from(picture_height) + 5 + line_idx as i64 * 19;
                drawing::text(&mut page, (left + 2 + indent, y), 2, PAPER, line);
            }
        }
        page
    }
}

/// The inputs of every picture of the sheet.
struct SheetPainter<'a> {
    scene: &'a Scene,
    set: &'a ObjectSet,
    renderer: Renderer<'a>,
    viewpoints: ViewpointSearch<'a>,
    /// Indices of the Gaussians of every object.
    members: BTreeMap<u32, Vec<usize>>,
    settings: &'a SheetSettings,
}

impl SheetPainter<'_> {
    fn overviews(&self) -> Result<Vec<RgbImage>, ObjectsError> {
        let (width, height) = self.settings.overview_size_px();
        let cameras = self.viewpoints.overviews(Intrinsics::from_fov_y(width, height, OVERVIEW_FOV_RAD))?;
        cameras.iter().map(|camera| self.overview(camera)).collect()
    }

    fn overview(&self, camera: &Camera) -> Result<RgbImage, ObjectsError> {
        let look = (self.scene.bounds().default_near(), [0.0; 3], self.settings.quality);
        let mut image = photo(self.scene, &self.renderer, camera, look)?;
        let ids = self.viewpoints.id_picture(camera)?;
        let scale = f64::from(camera.intrinsics.width) / ids.width as f64;
        let place = |object| Some((object, visible_middle(&ids, &self.viewpoints.ids_of(object))? * scale));
        let seen: Vec<(&Object, DVec2)> = self.set.objects.iter().filter_map(place).collect();
        // The boxes of large objects would cover the picture.
        let size = self.scene.bounds().size();
        for (object, _) in seen.iter().filter(|(object, _)| 2.0 * object.radius() < MAX_BOXED_FRAC * size) {
            draw_box(&mut image, camera, object, 0.0);
        }
        let mut taken = Vec::new();
        for (object, middle) in &seen {
            let place = free_place(&mut taken, *middle, &object.id.to_string());
            drawing::tag(&mut image, place, 2, (INK, ink_of(object.id)), &object.id.to_string());
        }
        let title = format!("{} objects, {} seen from here", self.set.objects.len(), seen.len());
        drawing::tag(&mut image, (10, 10), 2, (INK, PAPER), &title);
        Ok(image)
    }

    fn tile(&self, object: &Object, depth: usize) -> Result<Tile, ObjectsError> {
        let (width, height) = self.settings.tile_size_px();
        let camera = self.viewpoints.closeup(object, Intrinsics::from_fov_y(width, height, TILE_FOV_RAD))?;
        let members = self.members.get(&object.id).map_or(&[][..], Vec::as_slice);
        let gaussians = self.scene.gaussians.subset(members);
        let near = (object.center - camera.pose.position).length() - CONTEXT_RADII * object.radius();
        let mut picture = photo_before(
            self.scene,
            (&self.renderer, &Renderer::new(&gaussians)),
            &camera,
            (near.max(0.0), self.settings.quality),
        )?;
        if gaussians.is_empty() {
            draw_box(&mut picture, &camera, object, 0.0);
        }
        drawing::tag(&mut picture, (8, 8), 3, (INK, ink_of(object.id)), &object.id.to_string());
        Ok(Tile { id: object.id, label: object.label.clone(), depth, picture })
    }
}

/// Mean position of the pixels with some ids in the coarse picture; `None` below [`MIN_ID_PIXELS`].
fn visible_middle(survey: &IdPicture, ids: &BTreeSet<u16>) -> Option<DVec2> {
    let is_own = |(_, id): &(usize, &u16)| ids.contains(*id);
    let pixels = || survey.ids.iter().enumerate().filter(is_own).map(|(i, _)| i);
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
