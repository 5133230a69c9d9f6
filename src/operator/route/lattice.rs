//! The cheapest path over a lattice of free points (A*; Hart, Nilsson and Raphael 1968). Points next to matter cost
//! more, so that the camera keeps away from walls where the detour is short.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use glam::{DVec3, IVec3};

use super::straight::{free_around, is_clear};
use crate::grid::Grid;
use crate::world::World;

/// Limit on the points that one search expands.
const MAX_EXPANDED: usize = 80_000;
/// Margin of the lattice around the scene's core box, over the scene size.
const MARGIN_FRAC: f64 = 0.08;
/// Cost per length next to a wall, over that in the open.
const NARROW_COST: f64 = 2.0;
/// Additional cost per length outside the scene's core box, per scene size of distance from it.
const OUTSIDE_COST: f64 = 20.0;

/// Points at the middles of a grid's cells.
pub(super) struct Lattice<'a> {
    world: &'a World,
    grid: Grid,
    /// Distance to matter that makes a point free, scene units.
    room: f64,
}

/// The outcome of a search.
pub(super) enum LatticePath {
    /// Points from start to goal, both included.
    Found(Vec<DVec3>),
    /// All points reachable from one end were expanded, and the other end is not among them.
    Enclosed,
    /// The search expanded the maximum number of points.
    LimitReached,
}

/// The points of one search.
struct SearchState {
    /// Distance to matter, up to [`Lattice::reach`]; NaN where not computed yet.
    free: Vec<f32>,
    /// Cost of the cheapest path from the start.
    cost: Vec<f32>,
    /// Predecessor on that path; the point itself where it is an entry.
    before: Vec<u32>,
}

const NOT_REACHED: f32 = f32::INFINITY;

impl<'a> Lattice<'a> {
    /// Points a `cell` apart over the scene's core box and around both ends.
    pub(super) fn new(world: &'a World, ends: (DVec3, DVec3), cell: f64, room: f64) -> Self {
        let margin = DVec3::splat(MARGIN_FRAC * world.bounds.size());
        let low = (world.bounds.core_min - margin).min(ends.0.min(ends.1) - 2.0 * cell);
        let high = (world.bounds.core_max + margin).max(ends.0.max(ends.1) + 2.0 * cell);
        Self { world, grid: Grid::over(low, high, cell), room }
    }

    /// The cheapest path from `start` to `goal`.
    pub(super) fn path(&self, start: DVec3, goal: DVec3) -> LatticePath {
        let goals = self.entries(goal);
        let starts = self.entries(start);
        if goals.is_empty() || starts.is_empty() {
            return LatticePath::Enclosed;
        }
        match self.search(&starts, &goals, (start, goal)) {
            // Where the goal is enclosed, a flood from the goal detects it soonest.
            LatticePath::LimitReached if self.flood(&goals, &starts, MAX_EXPANDED / 4) == Some(false) => {
                LatticePath::Enclosed
            }
            reached => reached,
        }
    }

    /// Free points near a position that a camera can reach from it on a straight line.
    fn entries(&self, position: DVec3) -> Vec<u32> {
        let middle = ((position - self.grid.low) / self.grid.cell - 0.5).round().as_ivec3();
        let near = (-2..=2).flat_map(|x| (-2..=2).flat_map(move |y| (-2..=2).map(move |z| IVec3::new(x, y, z))));
        near.filter_map(|step| {
            let idx = self.grid.index_of(middle + step)?;
            let point = self.grid.middle(idx);
            let free = free_around(self.world, point, self.reach()) >= self.room;
            (free && is_clear(self.world, position, point, self.world.camera_radius * 1.0001)).then_some(idx as u32)
        })
        .collect()
    }

    /// Larger distances to matter make no difference.
    fn reach(&self) -> f64 {
        2.0 * self.room + 3.0 * self.grid.cell
    }

    /// Whether one of `goals` is reachable from `starts`; `None` where that is not known after expanding `most` points.
    fn flood(&self, starts: &[u32], goals: &[u32], most: usize) -> Option<bool> {
        let mut state = SearchState::new(self.grid.len());
        let mut front: Vec<u32> = starts.to_vec();
        starts.iter().for_each(|&point| state.cost[point as usize] = 0.0);
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
            for (next, _) in self.neighbors(&mut state, here) {
                if state.cost[next as usize] == NOT_REACHED {
                    state.cost[next as usize] = 0.0;
                    front.push(next);
                }
            }
        }
        Some(false)
    }

    fn search(&self, starts: &[u32], goals: &[u32], (start, goal): (DVec3, DVec3)) -> LatticePath {
        let mut state = SearchState::new(self.grid.len());
        let left = |point: u32| self.grid.middle(point as usize).distance(goal) as f32;
        // Non-negative floats sort like their bits. Ties go to the lower index.
        let mut open: BinaryHeap<Reverse<(u32, u32, u32)>> = BinaryHeap::new();
        for &point in starts {
            let cost = self.grid.middle(point as usize).distance(start) as f32;
            state.reach(point, point, cost);
            open.push(Reverse(((cost + left(point)).to_bits(), point, cost.to_bits())));
        }
        let mut num_expanded = 0;
        while let Some(Reverse((_, here, cost))) = open.pop() {
            let cost = f32::from_bits(cost);
            if cost > state.cost[here as usize] {
                continue;
            }
            if goals.contains(&here) {
                return LatticePath::Found(self.traced(&state, here, (start, goal)));
            }
            num_expanded += 1;
            if num_expanded > MAX_EXPANDED {
                return LatticePath::LimitReached;
            }
            for (next, length) in self.neighbors(&mut state, here) {
                let cost = cost + length as f32 * self.weight(&state, next);
                if cost < state.cost[next as usize] {
                    state.reach(next, here, cost);
                    open.push(Reverse(((cost + left(next)).to_bits(), next, cost.to_bits())));
                }
            }
        }
        LatticePath::Enclosed
    }

    /// Neighbors of a point that a ball with room can reach on a straight line, and their distances.
    fn neighbors(&self, state: &mut SearchState, here: u32) -> Vec<(u32, f64)> {
        let at = self.grid.cell_of(here as usize);
        let free_here = state.free(self, here);
        let mut found = Vec::with_capacity(26);
        for x in -1..=1 {
            for y in -1..=1 {
                for z in -1..=1 {
                    let step = IVec3::new(x, y, z);
                    let Some(next) = self.grid.index_of(at + step).filter(|_| step != IVec3::ZERO) else { continue };
                    let free = state.free(self, next as u32);
                    let length = step.as_dvec3().length() * self.grid.cell;
                    if free >= self.room && self.connects(here, next as u32, free_here + free - length) {
                        found.push((next as u32, length));
                    }
                }
            }
        }
        found
    }

    /// Whether the line between two free points is free. The free balls about both cover it where `overlap` (the sum of
    /// their radii minus the distance) is at least twice the room; otherwise the line is tested.
    fn connects(&self, here: u32, next: u32, overlap: f64) -> bool {
        overlap >= 2.0 * self.room || {
            let (a, b) = (self.grid.middle(here as usize), self.grid.middle(next as usize));
            is_clear(self.world, a, b, self.room * 0.99)
        }
    }

    /// Cost per length at a point.
    fn weight(&self, state: &SearchState, point: u32) -> f32 {
        let free = f64::from(state.free[point as usize]);
        let narrow = ((self.reach() - free) / (self.reach() - self.room)).clamp(0.0, 1.0);
        let outside = self.world.outside_frac(self.grid.middle(point as usize));
        (1.0 + (NARROW_COST - 1.0) * narrow + OUTSIDE_COST * outside) as f32
    }

    /// The path that ends at a point, from its predecessors.
    fn traced(&self, state: &SearchState, end: u32, (start, goal): (DVec3, DVec3)) -> Vec<DVec3> {
        let mut path = vec![goal];
        let mut here = end;
        loop {
            path.push(self.grid.middle(here as usize));
            let before = state.before[here as usize];
            if before == here {
                break;
            }
            here = before;
        }
        path.push(start);
        path.reverse();
        path
    }
}

impl SearchState {
    fn new(len: usize) -> Self {
        Self { free: vec![f32::NAN; len], cost: vec![NOT_REACHED; len], before: vec![0; len] }
    }

    fn reach(&mut self, point: u32, before: u32, cost: f32) {
        self.cost[point as usize] = cost;
        self.before[point as usize] = before;
    }

    /// Distance from a point to matter, rounded down; computed once per point.
    fn free(&mut self, lattice: &Lattice, point: u32) -> f64 {
        let known = &mut self.free[point as usize];
        if known.is_nan() {
            let middle = lattice.grid.middle(point as usize);
            *known = (free_around(lattice.world, middle, lattice.reach()) as f32).next_down().max(0.0);
        }
        f64::from(*known)
    }
}
