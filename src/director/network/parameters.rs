//! Parameters of a network: drawn from a seed, or taken from a file.

use std::collections::BTreeMap;

use candle_core::{DType, Device, Result, Tensor, Var};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// Initial values of fresh parameters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Start {
    /// Normally distributed with this standard deviation, mean 0.
    Normal(f32),
    /// All equal.
    Constant(f32),
}

/// Source of the named parameters while a network is built.
#[derive(Debug)]
pub enum Parameters {
    /// Trainable parameters, drawn in the order in which the network requests them.
    Fresh {
        /// Random numbers. (candle's generator cannot be seeded on the CPU.)
        rng: Pcg64Mcg,
        /// Parameters drawn so far, by name.
        vars: BTreeMap<String, Var>,
    },
    /// Stored parameters; the network takes each of them once.
    Stored {
        /// Parameters that the network has not taken yet, by name.
        tensors: BTreeMap<String, Tensor>,
    },
}

impl Parameters {
    /// Trainable parameters from a seed.
    pub fn seeded(seed: u64) -> Self {
        Self::Fresh { rng: Pcg64Mcg::seed_from_u64(seed), vars: BTreeMap::new() }
    }

    /// The parameter of this name and shape, as `f32`.
    pub(crate) fn get(&mut self, name: &str, shape: &[usize], start: Start) -> Result<Tensor> {
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

/// `count` initial values.
fn draw(rng: &mut Pcg64Mcg, count: usize, start: Start) -> Vec<f32> {
    match start {
        Start::Constant(value) => vec![value; count],
        Start::Normal(deviation) => (0..count).map(|_| normal(rng) * deviation).collect(),
    }
}

/// One standard normal value (Box-Muller).
fn normal(rng: &mut Pcg64Mcg) -> f32 {
    let radius = (-2.0 * (1.0 - rng.random::<f64>()).ln()).sqrt();
    (radius * (std::f64::consts::TAU * rng.random::<f64>()).cos()) as f32
}
