//! The room itself: floor, walls with window openings, ceiling, trims, and the view outside. All with object id 0.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::{DVec2, DVec3, Vec3};

use super::bake::Portal;
use super::color::Palette;
use super::dice::Dice;
use super::model::Model;
use super::noise;
use super::paint::{Paint, Pattern};
use super::place::Place;

/// Faces of a block: only up, only down, only toward +z.
const UP: u8 = 0b00_1000;
const DOWN: u8 = 0b00_0100;
const INTO: u8 = 0b10_0000;

/// How far floor, walls and ceiling run past the corners, m, so that no light shows through there.
const LAP: f64 = 0.06;

/// One side of a room.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Wall {
    /// At -z: behind the main group.
    Back,
    /// At +x.
    Right,
    /// At +z.
    Front,
    /// At -x.
    Left,
}

impl Wall {
    /// All four.
    pub(super) const ALL: [Self; 4] = [Self::Back, Self::Right, Self::Front, Self::Left];

    /// Turn of objects with their back to it.
    pub(super) fn yaw_rad(self) -> f64 {
        match self {
            Self::Back => 0.0,
            Self::Right => -FRAC_PI_2,
            Self::Front => PI,
            Self::Left => FRAC_PI_2,
        }
    }
}

/// A window opening: along its wall from the middle (to the right as seen from inside), sill height, size.
#[derive(Debug, Clone, Copy)]
pub(super) struct Opening {
    /// Wall it is in.
    pub(super) wall: Wall,
    /// Middle along the wall.
    pub(super) at: f64,
    /// Height of its lower edge.
    pub(super) sill: f64,
    /// Width and height.
    pub(super) size: [f64; 2],
}

/// What the floor is made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Flooring {
    /// Boards along x.
    Boards,
    /// Square tiles in two tones.
    Tiles,
    /// Boards in a herringbone.
    Herringbone,
}

/// How a wall is finished.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Finish {
    /// Paint alone.
    Painted,
    /// Wallpaper with stripes.
    Striped,
    /// Paint over a paneled lower third.
    Paneled,
    /// Bare bricks.
    Brick,
}

/// Proportions and materials of a room.
pub(super) struct Shell {
    /// Half of its width (x) and depth (z).
    pub(super) half: DVec2,
    /// Height.
    pub(super) height: f64,
    /// Windows.
    pub(super) openings: Vec<Opening>,
    /// Floor.
    pub(super) flooring: Flooring,
    /// Finish of the back wall; the others are painted.
    pub(super) finish: Finish,
    /// Whether the ceiling can be seen; light treats it as there in any case.
    pub(super) ceiling: bool,
    /// Brightness and tint of the view outside.
    pub(super) outside: Vec3,
}

impl Shell {
    /// Frame of a wall: its middle on the floor, x to the right as seen from inside, z into the room.
    pub(super) fn wall_place(&self, wall: Wall) -> Place {
        let at = match wall {
            Wall::Back => DVec3::new(0.0, 0.0, -self.half.y),
            Wall::Right => DVec3::new(self.half.x, 0.0, 0.0),
            Wall::Front => DVec3::new(0.0, 0.0, self.half.y),
            Wall::Left => DVec3::new(-self.half.x, 0.0, 0.0),
        };
        Place::facing(at, wall.yaw_rad())
    }

    /// Half of a wall's length.
    pub(super) fn half_length(&self, wall: Wall) -> f64 {
        if matches!(wall, Wall::Back | Wall::Front) { self.half.x } else { self.half.y }
    }

    /// The window's light: a rectangle in the wall that shines inward.
    pub(super) fn portal(&self, opening: &Opening, radiance: Vec3) -> Portal {
        let place = self.wall_place(opening.wall);
        let turn = |v: DVec3| (place.rotation * v).as_vec3();
        let center = place.apply(DVec3::new(opening.at, opening.sill + opening.size[1] / 2.0, -0.05));
        Portal {
            center: center.as_vec3(),
            half_width: turn(DVec3::X * opening.size[0] / 2.0),
            half_height: turn(DVec3::Y * opening.size[1] / 2.0),
            inward: turn(DVec3::Z),
            radiance,
        }
    }

    /// All of it as one model in the world's frame.
    pub(super) fn model(&self, dice: &mut Dice, palette: &Palette) -> Model {
        let mut model = Model::new("room");
        self.lay_floor(&mut model, dice, palette);
        for wall in Wall::ALL {
            let mut side = Model::new("wall");
            self.raise(&mut side, wall, dice, palette);
            model.include(&side, &self.wall_place(wall));
        }
        let (x, z) = (2.0 * self.half.x + LAP, 2.0 * self.half.y + LAP);
        let white = Paint::plain(Vec3::new(0.8, 0.79, 0.76));
        if self.ceiling {
            model.block([0.0, self.height + 0.05, 0.0], [x, 0.1, z], 0.0, white).only(DOWN).cells(2.2);
        } else {
            model.block([0.0, self.height + 0.05, 0.0], [x, 0.1, z], 0.0, white).only(0);
        }
        for opening in &self.openings {
            self.view(&mut model, opening, dice);
        }
        model
    }

    fn lay_floor(&self, model: &mut Model, dice: &mut Dice, palette: &Palette) {
        let (x, z) = (2.0 * self.half.x + LAP, 2.0 * self.half.y + LAP);
        let gap = Paint::plain(palette.floor.linear * if self.flooring == Flooring::Tiles { 0.9 } else { 0.22 });
        model.block([0.0, -0.054, 0.0], [x, 0.1, z], 0.0, gap).only(UP).cells(2.0);
        match self.flooring {
            Flooring::Boards => boards(model, self.half, palette, dice),
            Flooring::Tiles => tiles(model, self.half, palette, dice.seed()),
            Flooring::Herringbone => herringbone(model, self.half, palette, dice),
        }
    }

    /// One wall in its own frame.
    fn raise(&self, side: &mut Model, wall: Wall, dice: &mut Dice, palette: &Palette) {
        let half = self.half_length(wall);
        let finish = if wall == Wall::Back { self.finish } else { Finish::Painted };
        let hue = if wall == Wall::Back { palette.feature } else { palette.wall };
        let paint = match finish {
            Finish::Striped => Paint::patterned(Pattern::Stripes, hue.linear, hue.linear * 0.82 + 0.03, 0.12),
            Finish::Brick => Paint::plain(Vec3::splat(0.3)),
            _ => Paint { scale: 0.6, ..Paint::plain(hue.linear) },
        };
        let coarse = if finish == Finish::Striped { 1.0 } else { 1.6 };
        let here: Vec<&Opening> = self.openings.iter().filter(|o| o.wall == wall).collect();
        let mut piece = |low: [f64; 2], high: [f64; 2]| {
            let center = [f64::midpoint(low[0], high[0]), f64::midpoint(low[1], high[1]), -0.05];
            side.block(center, [high[0] - low[0], high[1] - low[1], 0.1], 0.0, paint).only(INTO).cells(coarse);
        };
        let mut from = -half - LAP;
        let mut sorted = here.clone();
        sorted.sort_by(|a, b| a.at.total_cmp(&b.at));
        for opening in &sorted {
            let (left, right) = (opening.at - opening.size[0] / 2.0, opening.at + opening.size[0] / 2.0);
            piece([from, -LAP], [left, self.height + LAP]);
            piece([left - 0.03, -LAP], [right + 0.03, opening.sill]);
            piece([left - 0.03, opening.sill + opening.size[1]], [right + 0.03, self.height + LAP]);
            from = right;
        }
        piece([from, -LAP], [half + LAP, self.height + LAP]);
        if finish == Finish::Brick {
            brickwork(side, half, self.height, dice.seed());
        }
        self.trims(side, half, finish, &here);
        for opening in here {
            reveal(side, opening);
        }
    }

    /// Skirting, cornice and, for paneled walls, the panels.
    fn trims(&self, side: &mut Model, half: f64, finish: Finish, openings: &[&Opening]) {
        let paint = Paint::plain(Vec3::new(0.76, 0.74, 0.7)).gloss(0.2);
        let length = 2.0 * half;
        side.block([0.0, 0.05, 0.004], [length, 0.1, 0.02], 0.005, paint).only(0b10_1000).stretched(2.0);
        if self.ceiling {
            side.block([0.0, self.height - 0.03, 0.01], [length, 0.06, 0.03], 0.012, paint)
                .only(0b10_0100)
                .stretched(2.0);
        }
        if finish == Finish::Paneled && openings.is_empty() {
            side.block([0.0, 0.98, 0.006], [length, 0.045, 0.03], 0.01, paint).only(0b10_1100).stretched(2.0);
            side.block([0.0, 0.53, -0.046], [length, 0.86, 0.1], 0.0, paint).only(INTO).cells(1.5);
            let count = (length / 0.62).round();
            for i in 0..count as u32 {
                let x = (f64::from(i) + 0.5) * length / count - half;
                let [w, h] = [length / count - 0.14, 0.62];
                for s in [-1.0, 1.0] {
                    side.block([x + s * w / 2.0, 0.54, 0.006], [0.02, h + 0.02, 0.014], 0.004, paint)
                        .only(0b10_1111)
                        .cells(0.8)
                        .airy();
                    side.block([x, 0.54 + s * h / 2.0, 0.006], [w, 0.02, 0.014], 0.004, paint)
                        .only(0b10_1111)
                        .cells(0.8)
                        .airy();
                }
            }
        }
    }

    /// The bright world behind a window.
    fn view(&self, model: &mut Model, opening: &Opening, dice: &mut Dice) {
        let place = self.wall_place(opening.wall);
        let (width, height) = (opening.size[0] + 8.0, opening.size[1] + 5.0);
        let sky = Vec3::new(0.62, 0.78, 0.98) * self.outside;
        let trees = Vec3::new(0.13, 0.2, 0.06) * self.outside;
        let paint = Paint::patterned(Pattern::Outside, sky, trees, 0.3).glow(1.0).seeded(dice.seed());
        let (x, y) = (opening.at - width / 2.0, opening.sill + opening.size[1] / 2.0 - height / 2.0);
        let far = move |u: f64, v: f64| place.apply(DVec3::new(x + u * width, y + v * height, -1.4));
        model.sheet([width, height], paint, far).cells(2.6).airy();
    }
}

/// The four sides of an opening's depth.
fn reveal(side: &mut Model, opening: &Opening) {
    let paint = Paint::plain(Vec3::splat(0.76));
    let ([width, height], deep) = (opening.size, 0.14);
    let (x, y) = (opening.at, opening.sill + height / 2.0);
    let z = -deep / 2.0;
    side.block([x - width / 2.0 - 0.02, y, z], [0.04, height, deep], 0.0, paint).only(0b00_0010);
    side.block([x + width / 2.0 + 0.02, y, z], [0.04, height, deep], 0.0, paint).only(0b00_0001);
    side.block([x, y - height / 2.0 - 0.02, z], [width, 0.04, deep], 0.0, paint).only(UP);
    side.block([x, y + height / 2.0 + 0.02, z], [width, 0.04, deep], 0.0, paint).only(DOWN);
}

/// A board, tile or brick that differs a little from its neighbors.
fn tinted(color: Vec3, spread: f32, t: f64) -> Vec3 {
    color * (1.0 + spread * (2.0 * t as f32 - 1.0))
}

fn boards(model: &mut Model, half: DVec2, palette: &Palette, dice: &mut Dice) {
    let rows = (2.0 * half.y / 0.15).round();
    let width = 2.0 * half.y / rows;
    for row in 0..rows as u32 {
        let z = -half.y + width * (f64::from(row) + 0.5);
        let mut x = -half.x - dice.range(0.0, 1.0);
        while x < half.x {
            let end = x + dice.range(1.0, 1.9);
            let (low, high) = (x.max(-half.x), end.min(half.x));
            x = end;
            if high - low < 0.02 {
                continue;
            }
            let paint = Paint::wood(tinted(palette.floor.linear, 0.12, dice.unit()), dice.seed()).gloss(0.55);
            let board = model.block(
                [f64::midpoint(low, high), -0.01, z],
                [high - low - 0.003, 0.02, width - 0.004],
                0.0,
                paint,
            );
            board.only(UP).stretched(1.8).airy();
        }
    }
}

fn herringbone(model: &mut Model, half: DVec2, palette: &Palette, dice: &mut Dice) {
    let (long, wide) = (0.6, 0.12);
    let columns = (2.0 * half.x / long).ceil() as i32 + 1;
    let rows = (2.0 * half.y / wide).ceil() as i32 + 6;
    for column in 0..columns {
        for row in -6..rows {
            // Chevron: boards slant up in one column and down in the next, cut at the column's sides.
            let slant = if column % 2 == 0 { 1.0 } else { -1.0 };
            let (x0, z0) = (-half.x + long * f64::from(column), -half.y + wide * f64::from(row));
            let (x1, mid) = ((x0 + long).min(half.x), z0 + wide / 2.0);
            let rise = slant * 0.18;
            let (lowest, highest) = (mid - wide / 2.0 - 0.09, mid + wide / 2.0 + 0.09);
            if x1 - x0 < 0.02 || lowest < -half.y - 0.05 || highest > half.y + 0.05 {
                continue;
            }
            let paint = Paint::wood(tinted(palette.floor.linear, 0.1, dice.unit()), dice.seed()).gloss(0.55);
            let plank = move |u: f64, v: f64| {
                let x = x0 + 0.002 + (x1 - x0 - 0.004) * u;
                DVec3::new(x, 0.0, mid + rise * ((x - x0) / long - 0.5) + wide * 0.97 * (0.5 - v))
            };
            model.sheet([long, wide], paint, plank).airy();
        }
    }
}

fn tiles(model: &mut Model, half: DVec2, palette: &Palette, seed: u32) {
    let edge = 0.33;
    let count = (half * 2.0 / edge).ceil();
    for i in 0..count.x as i32 {
        for j in 0..count.y as i32 {
            let low = DVec2::new(f64::from(i), f64::from(j)) * edge - half;
            let high = (low + edge).min(half);
            let tone = if (i + j) % 2 == 0 {
                palette.light.linear * 0.95
            } else {
                palette.second.linear.lerp(palette.light.linear, 0.35) * 0.7
            };
            let color = tinted(tone, 0.05, noise::cell(i, j, seed));
            let paint = Paint::patterned(Pattern::Marble, color, color * 0.8, 0.3)
                .seeded(seed ^ (i * 31 + j) as u32)
                .gloss(0.7);
            let (middle, size) = ((low + high) / 2.0, high - low - 0.006);
            model.block([middle.x, -0.01, middle.y], [size.x, 0.02, size.y], 0.0, paint).only(UP).cells(1.15).airy();
        }
    }
}

fn brickwork(side: &mut Model, half: f64, height: f64, seed: u32) {
    let (long, tall) = (0.25, 0.078);
    let base = if seed & 1 == 0 { Vec3::new(0.36, 0.14, 0.09) } else { Vec3::new(0.62, 0.58, 0.53) };
    let spread = if seed & 1 == 0 { 0.3 } else { 0.1 };
    let mortar = [(2.0 * half / long).ceil() as i32 + 1, (height / tall).ceil() as i32];
    for row in 0..mortar[1] {
        for column in 0..mortar[0] {
            let shift = f64::from(row % 2) * 0.5 * long;
            let low = (-half + long * f64::from(column) - shift).max(-half);
            let high = (-half + long * f64::from(column + 1) - shift).min(half);
            let (bottom, top) = (tall * f64::from(row), (tall * f64::from(row + 1)).min(height));
            if high - low < 0.03 || top - bottom < 0.02 {
                continue;
            }
            let color = tinted(base, spread, noise::cell(row, column, seed));
            let paint =
                Paint::patterned(Pattern::Speckle, color, color * 0.75, 0.04).seeded(seed ^ (row * 67 + column) as u32);
            let center = [f64::midpoint(low, high), f64::midpoint(bottom, top), -0.004];
            side.block(center, [high - low - 0.012, top - bottom - 0.011, 0.02], 0.0, paint)
                .only(INTO)
                .cells(1.25)
                .stretched(1.6)
                .airy();
        }
    }
}
