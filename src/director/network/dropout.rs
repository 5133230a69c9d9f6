//! Dropout as one operation, forward and backward. (A product with a mask has a gradient for the mask as well.)

use std::cell::RefCell;

use candle_core::{CpuStorage, CustomOp1, Layout, Result, Shape, Tensor};
use rand::Rng;
use rand_pcg::Pcg64Mcg;

use super::slices::{contiguous, read};

/// Dropout: sets random values to zero in training, and does nothing otherwise.
#[derive(Debug)]
pub struct Dropout {
    rate: f32,
    rng: Option<RefCell<Pcg64Mcg>>,
}

impl Dropout {
    /// No dropout.
    pub fn off() -> Self {
        Self { rate: 0.0, rng: None }
    }

    /// Drops a fraction `rate` of the values, 0..1; `rng` selects them.
    pub fn new(rate: f32, rng: Pcg64Mcg) -> Self {
        Self { rate, rng: (rate > 0.0).then(|| RefCell::new(rng)) }
    }

    /// The input with random values set to zero.
    pub(crate) fn apply(&self, input: &Tensor) -> Result<Tensor> {
        let Some(rng) = &self.rng else { return Ok(input.clone()) };
        // One random byte per value: the rate is exact to 1/256.
        let limit = ((1.0 - self.rate) * 256.0) as u8;
        let mut bytes = vec![0; input.elem_count()];
        rng.borrow_mut().fill_bytes(&mut bytes);
        input.contiguous()?.apply_op1(Mask { bytes, limit })
    }
}

/// Keeps the values whose byte is below the limit, and scales them so that their mean stays.
#[derive(Debug)]
struct Mask {
    bytes: Vec<u8>,
    limit: u8,
}

impl Mask {
    fn of(&self, values: &[f32]) -> Vec<f32> {
        let scale = 256.0 / f32::from(self.limit);
        values.iter().zip(&self.bytes).map(|(x, byte)| if *byte < self.limit { x * scale } else { 0.0 }).collect()
    }
}

impl CustomOp1 for Mask {
    fn name(&self) -> &'static str {
        "dropout"
    }

    fn cpu_fwd(&self, input: &CpuStorage, layout: &Layout) -> Result<(CpuStorage, Shape)> {
        Ok((CpuStorage::F32(self.of(contiguous(input, layout)?)), layout.shape().clone()))
    }

    fn bwd(&self, input: &Tensor, _out: &Tensor, grad: &Tensor) -> Result<Option<Tensor>> {
        let grad = read(grad, |grad| Ok(self.of(grad)))?;
        Tensor::from_vec(grad, input.shape(), input.device()).map(Some)
    }
}
