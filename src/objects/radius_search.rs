//! The radius of the alpha shapes of an object: one number for all views.
//!
//! Enters: for every pixel of every view the least radius at which the shape covers it, and whether the pixel belongs to
//! the mask ([`Coverage`]). Leaves: the radius with the least mismatch `J(r)`, the sum over all views of the squared
//! difference between shape and mask, pixels; on pictures of 0 and 1 it is the number of pixels that differ.
//!
//! `J` is a step function: it changes only where a triangle enters the shape, which is at its own circumradius. The exact
//! sweep visits all these radii in one pass. The zeroth-order search knows `J` only at the radii that it tries.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// How the radius is found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RadiusOptimizer {
    /// All radii at which the shapes change, in one pass over the sorted pixels: the global minimum.
    ExactSweep,
    /// Two-point gradient estimates of the logarithm of the radius (Nesterov and Spokoiny 2017) from several starts.
    ZerothOrder {
        /// Limit on the number of evaluations of `J`.
        budget: usize,
        /// Seed of starts and directions.
        seed: u64,
    },
}

impl RadiusOptimizer {
    /// Zeroth order with a budget of 96 evaluations.
    pub const ZEROTH_ORDER: Self = Self::ZerothOrder { budget: 96, seed: 0 };
}

/// Why a search ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SearchStatus {
    /// Every radius was compared: the minimum is global.
    Exact,
    /// The budget is spent, and the result is better than the empty shape.
    Improved,
    /// No radius that was tried is better than the empty shape.
    Flat,
}

/// The result of a search.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RadiusMinimum {
    /// Radius of the least mismatch, px; the smallest one of several. 0 is the empty shape.
    pub radius_px: f64,
    /// The least mismatch, pixels.
    pub mismatch: u64,
    /// Number of evaluations of `J`; of the exact sweep the number of radii at which it changes.
    pub num_evaluations: usize,
    /// Why the search ended.
    pub status: SearchStatus,
}

/// The pixels of all views: the least radius at which the shape covers each, and whether the mask does.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Coverage {
    /// Radius (px) of every pixel that some shape covers; finite.
    radii_px: Vec<f32>,
    /// Whether the mask covers the same pixel.
    is_inside: Vec<bool>,
    /// Pixels of the masks.
    num_inside: u64,
}

impl Coverage {
    /// Adds the pixels of one view: covering radii, infinite outside the convex hull, and the mask.
    pub fn add(&mut self, radii_px: &[f32], mask: &[bool]) {
        for (&radius, &inside) in radii_px.iter().zip(mask) {
            self.num_inside += u64::from(inside);
            if radius.is_finite() {
                self.radii_px.push(radius);
                self.is_inside.push(inside);
            }
        }
    }

    /// `J(r)`: pixels in which shape and mask differ.
    pub fn mismatch(&self, radius_px: f64) -> u64 {
        let (mut inside, mut outside) = (0, 0);
        for (&radius, &is_inside) in self.radii_px.iter().zip(&self.is_inside) {
            let covered = u64::from(f64::from(radius) <= radius_px);
            inside += covered & u64::from(is_inside);
            outside += covered & u64::from(!is_inside);
        }
        self.num_inside - inside + outside
    }

    /// The radius of the least mismatch.
    pub fn minimize(&self, optimizer: RadiusOptimizer) -> RadiusMinimum {
        match optimizer {
            RadiusOptimizer::ExactSweep => self.sweep(),
            RadiusOptimizer::ZerothOrder { budget, seed } => self.descend(budget, seed),
        }
    }

    /// The empty shape.
    fn nothing(&self) -> RadiusMinimum {
        RadiusMinimum { radius_px: 0.0, mismatch: self.num_inside, num_evaluations: 0, status: SearchStatus::Flat }
    }

    /// Visits the radii in ascending order. The radius of the result is the geometric middle of the interval in which `J`
    /// has its minimum, so that rounding moves no triangle in or out.
    fn sweep(&self) -> RadiusMinimum {
        // Positive floats have the order of their bits; the lowest bit is free for the mask.
        let key = |(radius, inside): (&f32, &bool)| (u64::from(radius.to_bits()) << 1) | u64::from(*inside);
        let mut keys: Vec<u64> = self.radii_px.iter().zip(&self.is_inside).map(key).collect();
        keys.sort_unstable();
        let radius = |key: u64| f64::from(f32::from_bits((key >> 1) as u32));
        let mut best = RadiusMinimum { status: SearchStatus::Exact, ..self.nothing() };
        let (mut mismatch, mut num_changes) = (self.num_inside, 0);
        for (i, &key) in keys.iter().enumerate() {
            mismatch = if key & 1 == 1 { mismatch - 1 } else { mismatch + 1 };
            let next = keys.get(i + 1).map(|next| next >> 1);
            if next == Some(key >> 1) {
                continue;
            }
            num_changes += 1;
            if mismatch < best.mismatch {
                let end = keys.get(i + 1).map_or(2.0 * radius(key), |&next| radius(next));
                best = RadiusMinimum { radius_px: (radius(key) * end).sqrt(), mismatch, ..best };
            }
        }
        RadiusMinimum { num_evaluations: num_changes, ..best }
    }

    /// Descends from random starts. Each step evaluates `J` on both sides of a point and moves against the slope; a start
    /// is given up after a few steps, and the steps of one start become shorter.
    fn descend(&self, budget: usize, seed: u64) -> RadiusMinimum {
        let mut best = self.nothing();
        let largest = self.radii_px.iter().copied().fold(0.0_f32, f32::max);
        if largest <= 0.0 {
            return best;
        }
        let (low, high) = (0.25_f64.ln(), f64::from(largest).max(0.5).ln() + 0.01);
        let mut random = Pcg64Mcg::seed_from_u64(seed);
        let mut used = 0;
        let mut evaluate = |log_radius: f64, used: &mut usize| {
            *used += 1;
            let (radius_px, mismatch) = (log_radius.exp(), self.mismatch(log_radius.exp()));
            if mismatch < best.mismatch || (mismatch == best.mismatch && radius_px < best.radius_px) {
                best = RadiusMinimum { radius_px, mismatch, status: SearchStatus::Improved, ..best };
            }
            mismatch as f64
        };
        let scale = self.num_inside.max(1) as f64;
        while used + 2 <= budget {
            let mut at = low + (high - low) * random.random::<f64>();
            for step in 0..STEPS_PER_START {
                if used + 2 > budget {
                    break;
                }
                let reach = 0.4 / f64::from(step + 1);
                let slope = (evaluate(at + reach, &mut used) - evaluate(at - reach, &mut used)) / (2.0 * reach);
                at = (at - (3.0 * reach * slope / scale).clamp(-reach, reach)).clamp(low, high);
            }
        }
        RadiusMinimum { num_evaluations: used, ..best }
    }
}

/// Steps of the zeroth-order search from one start.
const STEPS_PER_START: u32 = 8;
