//! Placing objects in a room: against walls, on the floor, on each other, on the walls; nothing meets anything else.

use glam::{DVec2, DVec3};

use super::color::Palette;
use super::dice::Dice;
use super::footprint::Footprint;
use super::model::Model;
use super::place::Place;
use super::shell::{Shell, Wall};

/// Distance between the back of furniture and the wall: more than the skirting.
const WALL_GAP: f64 = 0.03;

/// Distance kept between objects on the floor.
const FLOOR_GAP: f64 = 0.03;

/// An object that has found its place.
pub(super) struct Item {
    /// What it is.
    pub(super) model: Model,
    /// Object to world.
    pub(super) place: Place,
}

/// Where a model goes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Spot {
    /// World position of its base.
    pub(super) at: DVec3,
    /// Turn.
    pub(super) yaw_rad: f64,
}

/// A room being furnished.
pub(super) struct Stage<'a> {
    /// The room.
    pub(super) shell: &'a Shell,
    /// Its colors.
    pub(super) palette: Palette,
    /// Chance.
    pub(super) dice: Dice,
    /// Objects so far.
    pub(super) items: Vec<Item>,
    /// Room kept free.
    pub(super) reserved: Vec<Footprint>,
    taken: Vec<Footprint>,
}

impl<'a> Stage<'a> {
    /// An empty room.
    pub(super) fn new(shell: &'a Shell, palette: &Palette, dice: Dice) -> Self {
        Self { shell, palette: *palette, dice, items: Vec::new(), reserved: Vec::new(), taken: Vec::new() }
    }

    /// Keeps a strip of the floor free of everything but rugs: from `low` to `high` along z over the whole width.
    pub(super) fn reserve_aisle(&mut self, low: f64, high: f64) {
        let (center, half) =
            (DVec2::new(0.0, f64::midpoint(low, high)), DVec2::new(self.shell.half.x - 0.4, (high - low) / 2.0));
        self.reserve(center, half);
    }

    /// Keeps a rectangle of the floor free of everything but rugs.
    pub(super) fn reserve(&mut self, center: DVec2, half: DVec2) {
        self.reserved.push(Footprint { center, half, yaw_rad: 0.0, low: 0.05, high: 2.1 });
    }

    /// Puts a model at a spot if nothing is there; `ignore` may be touched. Returns its index.
    fn put(&mut self, model: Model, spot: Spot, ignore: Option<usize>) -> Option<usize> {
        let (low, high) = model.bounds();
        let mut print = Footprint::of(low, high, spot.at, spot.yaw_rad);
        // Rugs lie under things.
        print.low = print.low.max(if spot.at.y == 0.0 && print.high > 0.05 { 0.02 } else { print.low });
        let extent = print.extent() - 1e-9;
        if (print.center.abs() + extent).cmpgt(self.shell.half - 1e-6).any() || print.high > self.shell.height + 1e-6 {
            return None;
        }
        let gap = if spot.at.y > 0.0 { 0.012 } else { FLOOR_GAP };
        let others = self.taken.iter().enumerate().filter(|(i, _)| Some(*i) != ignore).map(|(_, other)| other);
        if others.chain(&self.reserved).any(|other| print.meets(other, gap)) {
            return None;
        }
        self.taken.push(print);
        self.items.push(Item { model, place: Place::facing(spot.at, spot.yaw_rad) });
        Some(self.items.len() - 1)
    }

    /// Stands a model on the floor at (x, z).
    pub(super) fn stand(&mut self, model: Model, at: DVec2, yaw_rad: f64) -> Option<usize> {
        self.put(model, Spot { at: DVec3::new(at.x, 0.0, at.y), yaw_rad }, None)
    }

    /// Stands a model with its back to a wall, `along` it from the middle, to the right as seen from inside.
    pub(super) fn against(&mut self, model: Model, wall: Wall, along: f64) -> Option<usize> {
        let off = DVec3::new(along, 0.0, model.size().z / 2.0 + WALL_GAP);
        let at = self.shell.wall_place(wall).apply(off);
        self.put(model, Spot { at, yaw_rad: wall.yaw_rad() }, None)
    }

    /// Stands a model somewhere along a stretch of a wall.
    pub(super) fn along(&mut self, model: &Model, wall: Wall, [low, high]: [f64; 2]) -> Option<usize> {
        (0..14).find_map(|_| {
            let along = self.dice.range(low, high);
            self.against(model.clone(), wall, along)
        })
    }

    /// Stands a model at any wall that has room.
    pub(super) fn anywhere(&mut self, model: &Model) -> Option<usize> {
        let first = self.dice.index(4);
        (0..4).find_map(|i| {
            let wall = Wall::ALL[(first + i) % 4];
            let half = self.shell.half_length(wall) - 0.1;
            self.along(model, wall, [-half, half])
        })
    }

    /// Hangs a model on a wall with its lower edge at a height.
    pub(super) fn hang(&mut self, model: Model, wall: Wall, [along, height]: [f64; 2]) -> Option<usize> {
        let off = DVec3::new(along, height, model.size().z / 2.0 + 0.004);
        let at = self.shell.wall_place(wall).apply(off);
        self.put(model, Spot { at, yaw_rad: wall.yaw_rad() }, None)
    }

    /// Hangs a model somewhere along a wall.
    pub(super) fn hang_along(&mut self, model: &Model, wall: Wall, height: f64) -> Option<usize> {
        let half = self.shell.half_length(wall) - model.size().x / 2.0 - 0.15;
        (0..12).find_map(|_| {
            let along = self.dice.range(-half, half);
            self.hang(model.clone(), wall, [along, height])
        })
    }

    /// Hangs a model from the ceiling.
    pub(super) fn suspend(&mut self, model: Model, at: DVec2) -> Option<usize> {
        let at = DVec3::new(at.x, self.shell.height - model.size().y, at.y);
        self.put(model, Spot { at, yaw_rad: 0.0 }, None)
    }

    /// Stands a model on top of another, anywhere on its free places.
    pub(super) fn on(&mut self, host: Option<usize>, model: &Model) -> Option<usize> {
        let turn = self.dice.range(-0.5, 0.5);
        self.on_turned(host, model, turn)
    }

    /// As [`Self::on`], turned by an angle against its host.
    pub(super) fn on_turned(&mut self, host: Option<usize>, model: &Model, turn: f64) -> Option<usize> {
        let host = host?;
        let place = self.items[host].place;
        let tops = self.items[host].model.tops.clone();
        let (low, high) = model.bounds();
        let reach = Footprint::of(low, high, DVec3::ZERO, turn).extent();
        for _ in 0..16 {
            let top = *tops.get(self.dice.index(tops.len()))?;
            let free = top.half - reach;
            if free.min_element() < 0.0 || high.y > top.headroom {
                continue;
            }
            let shift = DVec3::new(self.dice.range(-free.x, free.x), 0.0, self.dice.range(-free.y, free.y));
            let yaw_rad = turn + yaw_of(&place);
            let spot = Spot { at: place.apply(top.center + shift), yaw_rad };
            if let Some(index) = self.put(model.clone(), spot, Some(host)) {
                return Some(index);
            }
        }
        None
    }

    /// Stands a model at a chosen place on another: fractions -1..1 of the first free place's half extents.
    pub(super) fn on_at(&mut self, host: Option<usize>, model: Model, frac: [f64; 2], turn: f64) -> Option<usize> {
        let host = host?;
        let place = self.items[host].place;
        let top = *self.items[host].model.tops.first()?;
        let shift = DVec3::new(top.half.x * frac[0], 0.0, top.half.y * frac[1]);
        let spot = Spot { at: place.apply(top.center + shift), yaw_rad: turn + yaw_of(&place) };
        self.put(model, spot, Some(host))
    }

    /// Plan of an object that has been placed.
    pub(super) fn print_of(&self, index: Option<usize>) -> Option<Footprint> {
        index.and_then(|i| self.taken.get(i).copied())
    }
}

/// Turn of a placement about the upright axis.
fn yaw_of(place: &Place) -> f64 {
    let front = place.rotation * DVec3::Z;
    front.x.atan2(front.z)
}
