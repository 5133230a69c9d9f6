//! The shortest way over a lattice of free places (A*; Hart, Nilsson and Raphael 1968), where the camera keeps away from
//! walls if that costs little.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use glam::{DVec3, IVec3};

use super::straight::{free_around, is_clear};
use crate::grid::Grid;
use crate::world::World;

/// Places that one search goes on from, at most.
const MAX_PLACES: usize = 80_000;
/// Room around the scene's core box in which ways may lead, over the scene size.
const AROUND_FRAC: f64 = 0.08;
/// Cost of a way next to a wall over that in the open.
const NARROW_COST: f64 = 2.0;
/// Cost of a way outside the scene's core box over that inside, for each scene size out.
const OUTSIDE_COST: f64 = 20.0;

/// Free places at the middles of a grid's cells.
pub(super) struct Lattice<'a> {
    world: &'a World,
    grid: Grid,
    /// Distance to matter that a place needs.
    room: f64,
}

/// How a search ended.
pub(super) enum Reached {
    /// Places from start to goal, both included.
    Way(Vec<DVec3>),
    /// All places that one end leads to were seen without the other.
    Enclosed,
    /// Too many places.
    GaveUp,
}

/// What is known of the places of one search.
struct Known {
    /// Distance to matter, up to what matters; NaN where nobody looked.
    free: Vec<f32>,
    /// Cost of the best way from the start.
    cost: Vec<f32>,
    /// Place before; itself where the start leads to it.
    before: Vec<u32>,
}

const NOT_REACHED: f32 = f32::INFINITY;

impl<'a> Lattice<'a> {
    /// Places a cell apart over the scene's core box and around both ends.
    pub(super) fn new(world: &'a World, ends: (DVec3, DVec3), cell: f64, room: f64) -> Self {
        let around = DVec3::splat(AROUND_FRAC * world.bounds.size());
        let low = (world.bounds.core_min - around).min(ends.0.min(ends.1) - 2.0 * cell);
        let high = (world.bounds.core_max + around).max(ends.0.max(ends.1) + 2.0 * cell);
        Self { world, grid: Grid::over(low, high, cell), room }
    }

    /// The cheapest way from `start` to `goal`.
    pub(super) fn way(&self, start: DVec3, goal: DVec3) -> Reached {
        let goals = self.entries(goal);
        let starts = self.entries(start);
        if goals.is_empty() || starts.is_empty() {
            return Reached::Enclosed;
        }
        match self.search(&starts, &goals, (start, goal)) {
            // The goal may stand in an enclosure, which is found out soonest from its side.
            Reached::GaveUp if self.flood(&goals, &starts, MAX_PLACES / 4) == Some(false) => Reached::Enclosed,
            reached => reached,
        }
    }

    /// Places next to a point that a camera can reach from it straight.
    fn entries(&self, point: DVec3) -> Vec<u32> {
        let middle = ((point - self.grid.low) / self.grid.cell - 0.5).round().as_ivec3();
        let near = (-2..=2).flat_map(|x| (-2..=2).flat_map(move |y| (-2..=2).map(move |z| IVec3::new(x, y, z))));
        near.filter_map(|step| {
            let idx = self.grid.index_of(middle + step)?;
            let place = self.grid.middle(idx);
            let free = free_around(self.world, place, self.reach()) >= self.room;
            (free && is_clear(self.world, point, place, self.world.camera_radius * 1.0001)).then_some(idx as u32)
        })
        .collect()
    }

    /// Distance to matter beyond which it makes no difference.
    fn reach(&self) -> f64 {
        2.0 * self.room + 3.0 * self.grid.cell
    }

    /// Whether one of `goals` is reached from `starts`; `None` where that is not known after so many places.
    fn flood(&self, starts: &[u32], goals: &[u32], most: usize) -> Option<bool> {
        let mut known = Known::new(self.grid.len());
        let mut front: Vec<u32> = starts.to_vec();
        starts.iter().for_each(|&place| known.cost[place as usize] = 0.0);
        let mut done = 0;
        while done < front.len() {
            let here = front[done];
            if goals.contains(&here) {
                return Some(true);
            }
            if done >= most {
                return None;
            }
            done += 1;
            for (next, _) in self.neighbors(&mut known, here) {
                if known.cost[next as usize] == NOT_REACHED {
                    known.cost[next as usize] = 0.0;
                    front.push(next);
                }
            }
        }
        Some(false)
    }

    fn search(&self, starts: &[u32], goals: &[u32], (start, goal): (DVec3, DVec3)) -> Reached {
        let mut known = Known::new(self.grid.len());
        let left = |place: u32| self.grid.middle(place as usize).distance(goal) as f32;
        // Non-negative floats sort as their bits; ties go to the lower place.
        let mut open: BinaryHeap<Reverse<(u32, u32, u32)>> = BinaryHeap::new();
        for &place in starts {
            let cost = self.grid.middle(place as usize).distance(start) as f32;
            known.reach(place, place, cost);
            open.push(Reverse(((cost + left(place)).to_bits(), place, cost.to_bits())));
        }
        let mut num_places = 0;
        while let Some(Reverse((_, here, cost))) = open.pop() {
            let cost = f32::from_bits(cost);
            if cost > known.cost[here as usize] {
                continue;
            }
            if goals.contains(&here) {
                return Reached::Way(self.traced(&known, here, (start, goal)));
            }
            num_places += 1;
            if num_places > MAX_PLACES {
                return Reached::GaveUp;
            }
            for (next, length) in self.neighbors(&mut known, here) {
                let cost = cost + length as f32 * self.weight(&known, next);
                if cost < known.cost[next as usize] {
                    known.reach(next, here, cost);
                    open.push(Reverse(((cost + left(next)).to_bits(), next, cost.to_bits())));
                }
            }
        }
        Reached::Enclosed
    }

    /// Places next to one that a ball with room can reach straight, and how far they are.
    fn neighbors(&self, known: &mut Known, here: u32) -> Vec<(u32, f64)> {
        let at = self.grid.cell_of(here as usize);
        let free_here = known.free(self, here);
        let mut found = Vec::with_capacity(26);
        for x in -1..=1 {
            for y in -1..=1 {
                for z in -1..=1 {
                    let step = IVec3::new(x, y, z);
                    let Some(next) = self.grid.index_of(at + step).filter(|_| step != IVec3::ZERO) else { continue };
                    let free = known.free(self, next as u32);
                    let length = step.as_dvec3().length() * self.grid.cell;
                    if free >= self.room && self.leads(here, next as u32, free_here + free - length) {
                        found.push((next as u32, length));
                    }
                }
            }
        }
        found
    }

    /// Whether the way between two free places is free: balls about both cover it where `both` (the sum of their radii
    /// less the way) is twice the room; else it is looked at.
    fn leads(&self, here: u32, next: u32, both: f64) -> bool {
        both >= 2.0 * self.room || {
            let (a, b) = (self.grid.middle(here as usize), self.grid.middle(next as usize));
            is_clear(self.world, a, b, self.room * 0.99)
        }
    }

    /// Cost of a unit of way at a place.
    fn weight(&self, known: &Known, place: u32) -> f32 {
        let free = f64::from(known.free[place as usize]);
        let narrow = ((self.reach() - free) / (self.reach() - self.room)).clamp(0.0, 1.0);
        let outside = self.world.outside_frac(self.grid.middle(place as usize));
        (1.0 + (NARROW_COST - 1.0) * narrow + OUTSIDE_COST * outside) as f32
    }

    fn traced(&self, known: &Known, end: u32, (start, goal): (DVec3, DVec3)) -> Vec<DVec3> {
        let mut way = vec![goal];
        let mut here = end;
        loop {
            way.push(self.grid.middle(here as usize));
            let before = known.before[here as usize];
            if before == here {
                break;
            }
            here = before;
        }
        way.push(start);
        way.reverse();
        way
    }
}

impl Known {
    fn new(len: usize) -> Self {
        Self { free: vec![f32::NAN; len], cost: vec![NOT_REACHED; len], before: vec![0; len] }
    }

    fn reach(&mut self, place: u32, before: u32, cost: f32) {
        self.cost[place as usize] = cost;
        self.before[place as usize] = before;
    }

    /// Distance from a place to matter, rounded down, looked up once.
    fn free(&mut self, lattice: &Lattice, place: u32) -> f64 {
        let known = &mut self.free[place as usize];
        if known.is_nan() {
            let middle = lattice.grid.middle(place as usize);
            *known = (free_around(lattice.world, middle, lattice.reach()) as f32).next_down().max(0.0);
        }
        f64::from(*known)
    }
}
