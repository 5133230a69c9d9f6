//! Where the numbers of a network come from: a seed, or a file.

use std::collections::BTreeMap;

use candle_core::{DType, Device, Result, Tensor, Var};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// How fresh parameters are drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Start {
    /// Normal with this standard deviation.
    Normal(f32),
    /// All the same.
    Constant(f32),
}

/// The named parameters of a network while it is put together: drawn from a seed, or taken from stored tensors.
#[derive(Debug)]
pub enum Parameters {
    /// Trainable ones, drawn in the order in which they are asked for.
    Fresh {
        /// Source of the draws (candle's own cannot be seeded on the CPU).
        rng: Pcg64Mcg,
        /// What was drawn so far.
        vars: BTreeMap<String, Var>,
    },
    /// Stored ones; each is taken once.
    Stored {
        /// What is still to be taken.
        tensors: BTreeMap<String, Tensor>,
    },
}

impl Parameters {
    /// Trainable parameters from a seed.
    pub fn seeded(seed: u64) -> Self {
        Self::Fresh { rng: Pcg64Mcg::seed_from_u64(seed), vars: BTreeMap::new() }
    }

    /// The parameter of this name and shape, `f32`.
    pub(super) fn get(&mut self, name: &str, shape: &[usize], start: Start) -> Result<Tensor> {
        match self {
            Self::Fresh { rng, vars } => {
                let var = Var::from_vec(draw(rng, shape.iter().product(), start), shape, &Device::Cpu)?;
                let tensor = var.as_tensor().clone();
                vars.insert(name.to_owned(), var);
                Ok(tensor)
            }
            Self::Stored { tensors } => match tensors.remove(name) {
                Some(tensor) if tensor.dims() == shape => tensor.to_dtype(DType::F32),
                Some(tensor) => candle_core::bail!("{name} has shape {:?}, expected {shape:?}", tensor.dims()),
                None => candle_core::bail!("{name} is missing"),
            },
        }
    }
}

/// Draws `count` numbers.
fn draw(rng: &mut Pcg64Mcg, count: usize, start: Start) -> Vec<f32> {
    match start {
        Start::Constant(value) => vec![value; count],
        Start::Normal(deviation) => (0..count).map(|_| normal(rng) * deviation).collect(),
    }
}

/// One standard normal number (Box-Muller).
fn normal(rng: &mut Pcg64Mcg) -> f32 {
    let radius = (-2.0 * (1.0 - rng.random::<f64>()).ln()).sqrt();
    (radius * (std::f64::consts::TAU * rng.random::<f64>()).cos()) as f32
}
