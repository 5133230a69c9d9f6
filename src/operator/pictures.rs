//! What the pictures of a film are worth, by rays: void, matter close before the lens, and depth.
//!
//! A film is as good as its worst picture: an end in black is not made good by a fine start.

use glam::{DVec2, DVec3, IVec2};

use super::constraint::{Constraint, ConstraintKind};
use super::program::Pass;
use super::world::{Subject, World};
use cinesplat_geometry::{Camera, Intrinsics};
use cinesplat_trajectory::CameraState;

/// Columns and rows of rays over a picture at the ends of a segment, where void is worst, and over one between them.
const END_RAYS: (u32, u32) = (8, 6);
const INNER_RAYS: (u32, u32) = (6, 4);
/// Distance below which matter blocks the lens, over the scene size.
const NEAR_FRAC: f64 = 0.08;
/// Distance up to which a picture counts as shallow, over the scene size.
const SHALLOW_FRAC: f64 = 0.2;
/// Void that a picture of a room has at most where another one can be had.
const MAX_VOID: f64 = 0.25;
/// Bound of the cost of pictures, which the sum of its terms approaches: less than that of a violated constraint,
/// because words come first.
const MAX_COST: f64 = 2.9;
/// Share of a picture that matter close before the lens fills at most where another one can be had.
const MAX_BLOCKED: f64 = 0.2;
/// Weights in a room and outdoors: of void in the worst picture, of void above [`MAX_VOID`] there, and of its mean.
const ROOM_WEIGHTS: [f64; 3] = [1.8, 2.4, 0.8];
const OUTDOOR_WEIGHTS: [f64; 3] = [0.1, 0.0, 0.3];
/// Cost of matter close before the lens in every ray of the worst picture, and of more than [`MAX_BLOCKED`] there.
const BLOCKED_COST: f64 = 1.2;
const EXCESS_BLOCKED_COST: f64 = 1.0;
/// Distance below which matter is foreground, over the middle distance of a picture; the share of a picture that
/// foreground frames without harm; and the cost of one that it fills.
const FOREGROUND_FRAC: f64 = 0.33;
const FREE_FOREGROUND: f64 = 0.1;
const FOREGROUND_COST: f64 = 1.6;
/// Margin of the box of a subject, over its radius, within which matter is the subject.
const BOX_MARGIN: f64 = 0.05;
/// Cost of a room without depth.
const SHALLOW_COST: f64 = 0.25;
/// Cost of a camera below furniture.
const UNDER_COST: f64 = 4.0;

/// Shares of a picture's rays.
#[derive(Debug, Clone, Copy, Default)]
struct Picture {
    void: f64,
    blocked: f64,
    blocked_by_others: f64,
    foreground: f64,
    shallow: f64,
}

/// Cost of the pictures of a segment's sampled states: the ends and three moments between. What the constraints are about is
/// no foreground, however near it is.
pub(super) fn pictures_cost(world: &World, constraints: &[Constraint], states: &[CameraState]) -> f64 {
    let about = constraints.iter().flat_map(Constraint::about).filter_map(|id| world.subject(*id));
    let subjects: Vec<&Subject> = about.collect();
    let last = states.len() - 1;
    let mut picks = vec![0, last / 4, last / 2, last - last / 4, last];
    if states[0] == states[last] && states[0] == states[last / 2] {
        picks.truncate(1);
    }
    let rays = |i: usize| if i == 0 || i == last { END_RAYS } else { INNER_RAYS };
    let at = |&i: &usize| picture(world, &subjects, &states[i], rays(i));
    let pictures: Vec<Picture> = picks.iter().map(at).collect();
    let worst = |share: fn(&Picture) -> f64| pictures.iter().map(share).fold(0.0, f64::max);
    let mean = |share: fn(&Picture) -> f64| pictures.iter().map(share).sum::<f64>() / pictures.len() as f64;
    let [of_worst, of_excess, of_mean] = if world.is_indoor() { ROOM_WEIGHTS } else { OUTDOOR_WEIGHTS };
    let (void, blocked) = (worst(|p| p.void), worst(|p| p.blocked));
    let foreground = (worst(|p| p.foreground) - FREE_FOREGROUND).max(0.0);
    let shallow = if world.is_indoor() { SHALLOW_COST * mean(|p| p.shallow) } else { 0.0 };
    let sum = of_worst * void
        + of_excess * excess(void, MAX_VOID)
        + of_mean * mean(|p| p.void)
        + BLOCKED_COST * blocked
        + EXCESS_BLOCKED_COST * excess(blocked, MAX_BLOCKED)
        + FOREGROUND_COST * foreground
        + shallow;
    MAX_COST * (sum / MAX_COST).tanh()
}

/// Share of a picture that other matter than its subjects takes close before the lens.
pub(super) fn blocked_by_others_frac(world: &World, ids: &[u32], state: &CameraState) -> f64 {
    let subjects: Vec<&Subject> = ids.iter().filter_map(|id| world.subject(*id)).collect();
    picture(world, &subjects, state, END_RAYS).blocked_by_others
}

/// Void of the worst picture of some cameras, as a share of it.
pub(super) fn worst_void(world: &World, states: impl Iterator<Item = CameraState>) -> f64 {
    states.map(|state| picture(world, &[], &state, END_RAYS).void).fold(0.0, f64::max)
}

/// Which directions around a picture meet no matter: a grid of cells over the frame and a margin around it.
pub(super) struct VoidMap {
    /// Half the width and height of the frame on the plane at depth 1.
    half: DVec2,
    is_void: Vec<bool>,
}

impl VoidMap {
    /// Columns and rows of the frame.
    const CELLS: IVec2 = IVec2::new(14, 8);
    /// Columns and rows of the margin on each side: turns go up to it.
    pub(super) const MARGIN: IVec2 = IVec2::new(4, 2);

    /// The void around the picture of a camera.
    pub(super) fn around(world: &World, state: &CameraState) -> Self {
        Self { half: half_frame(world, state), is_void: void_cells(world, state, Self::MARGIN) }
    }

    /// Share of void in the frame that is moved by some cells, within the margin, to the right and down.
    pub(super) fn void(&self, by: IVec2) -> f64 {
        let stride = Self::CELLS.x + 2 * Self::MARGIN.x;
        let first = Self::MARGIN + by;
        let is_void = |column: i32, row: i32| {
            let index = (row + first.y) * stride + column + first.x;
            usize::try_from(index).ok().and_then(|index| self.is_void.get(index)).copied().unwrap_or(true)
        };
        let cells = (0..Self::CELLS.y).flat_map(|row| (0..Self::CELLS.x).map(move |column| (column, row)));
        let count = cells.filter(|&(column, row)| is_void(column, row)).count();
        count as f64 / f64::from(Self::CELLS.element_product())
    }

    /// Direction of the middle of the frame that is moved by some cells, world.
    pub(super) fn direction(&self, state: &CameraState, by: IVec2) -> DVec3 {
        let at = 2.0 * self.half * by.as_dvec2() / Self::CELLS.as_dvec2();
        state.pose.rotation * at.extend(1.0).normalize()
    }
}

/// Share of void in the picture of a camera, on the cells of [`VoidMap`].
pub(super) fn void_frac(world: &World, state: &CameraState) -> f64 {
    let cells = void_cells(world, state, IVec2::ZERO);
    cells.iter().filter(|is_void| **is_void).count() as f64 / cells.len() as f64
}

/// Half the width and height of the frame on the plane at depth 1.
fn half_frame(world: &World, state: &CameraState) -> DVec2 {
    let tan = (state.fov_y_rad / 2.0).tan();
    DVec2::new(tan * world.aspect, tan)
}

/// Whether the rays through the cells of the frame and of a margin around it meet no matter, row by row.
fn void_cells(world: &World, state: &CameraState, margin: IVec2) -> Vec<bool> {
    let (half, cells) = (half_frame(world, state), VoidMap::CELLS);
    let middle = |at: i32, count: i32| (f64::from(at) + 0.5) / f64::from(count) * 2.0 - 1.0;
    let is_void = |(column, row): (i32, i32)| {
        let at = half * DVec2::new(middle(column, cells.x), middle(row, cells.y));
        let ray = state.pose.rotation * at.extend(1.0).normalize();
        world.hit_distance(state.pose.position, ray).is_none()
    };
    let rows = -margin.y..cells.y + margin.y;
    rows.flat_map(|row| (-margin.x..cells.x + margin.x).map(move |column| (column, row))).map(is_void).collect()
}

/// How far a share is above its limit: 0 at or below it, 0.2 just above it, and 1.2 from twice the limit on.
fn excess(share: f64, limit: f64) -> f64 {
    if share > limit { 0.2 + ((share - limit) / limit).min(1.0) } else { 0.0 }
}

fn picture(world: &World, subjects: &[&Subject], state: &CameraState, (columns, rows): (u32, u32)) -> Picture {
    let (width, height) = (90.0 * world.aspect, 90.0);
    let camera = Camera {
        pose: state.pose,
        intrinsics: Intrinsics::from_fov_y(width.round().max(1.0) as u32, 90, state.fov_y_rad),
    };
    let (near, shallow) = (NEAR_FRAC * world.bounds.size(), SHALLOW_FRAC * world.bounds.size());
    let each = 1.0 / f64::from(columns * rows);
    let mut out = Picture::default();
    let mut distances = Vec::with_capacity((columns * rows) as usize);
    let mut others = Vec::with_capacity((columns * rows) as usize);
    for column in 0..columns {
        for row in 0..rows {
            let at = |i: u32, count: u32| (f64::from(i) + 0.5) / f64::from(count);
            let at = DVec2::new(at(column, columns) * width, at(row, rows) * height);
            let ray = camera.ray(at);
            match world.hit_distance(state.pose.position, ray) {
                None => out.void += each,
                Some(distance) => {
                    distances.push(distance);
                    let hit = state.pose.position + ray * distance;
                    if !subjects.iter().any(|subject| subject.has_in_box(hit, BOX_MARGIN)) {
                        others.push(distance);
                        out.blocked_by_others += if distance < near { each } else { 0.0 };
                    }
                    out.blocked += if distance < near { each } else { 0.0 };
                    out.shallow += if distance < shallow { each } else { 0.0 };
                }
            }
        }
    }
    distances.sort_by(f64::total_cmp);
    if let Some(middle) = distances.get(distances.len() / 2) {
        out.foreground = each * others.iter().filter(|distance| **distance < FOREGROUND_FRAC * middle).count() as f64;
    }
    out
}

/// Cost of standing under furniture in a room where nothing asks for it: of the ends and the middle, the share that has
/// matter above the camera and below the eyes of a standing person.
pub(super) fn under_furniture_cost(world: &World, constraints: &[Constraint], states: &[CameraState]) -> f64 {
    if !world.is_indoor() || constraints.iter().any(|constraint| asks_low(&constraint.kind)) {
        return 0.0;
    }
    let picks = [0, states.len() / 2, states.len() - 1];
    let is_under = |&&i: &&usize| {
        let eye = states[i].pose.position;
        let room = world.eye_height() - world.height_above_floor(eye);
        room > 0.0 && world.hit_distance(eye, world.frame.up).is_some_and(|distance| distance < room)
    };
    UNDER_COST * picks.iter().filter(is_under).count() as f64 / picks.len() as f64
}

/// Whether a constraint asks for a camera near the floor or below something.
pub(super) fn asks_low(kind: &ConstraintKind) -> bool {
    match kind {
        ConstraintKind::Pitch((low, _)) => *low > 0.0,
        ConstraintKind::CameraHeight(_) => true,
        ConstraintKind::Elevation(_, (low, _)) => *low < 0.0,
        ConstraintKind::Passed(how, _) => matches!(how, Pass::Under | Pass::Through | Pass::From),
        _ => false,
    }
}
