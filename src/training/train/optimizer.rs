//! AdamW with gradient clipping and a state that can be saved. (candle's own hides its moments.)
//!
//! Decoupled weight decay: Loshchilov and Hutter 2019, algorithm 2. Decay applies to matrices, not to gains and biases.

use std::collections::BTreeMap;

use candle_core::{Device, Result, Tensor, Var};

use crate::workers::map_on_threads;

/// Constants of the optimizer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct AdamSettings {
    /// Decay of the running mean of the gradients.
    pub(crate) beta1: f32,
    /// Decay of the running mean of the squared gradients.
    pub(crate) beta2: f32,
    /// Added to the root of the mean square.
    pub(crate) epsilon: f32,
    /// Fraction of a weight that a step with learning rate 1 removes.
    pub(crate) weight_decay: f32,
    /// Largest norm of the gradient of all parameters together; a longer gradient is scaled down to it.
    pub(crate) max_norm: f32,
    /// Learning rate of the parameters of BERT, which were trained beforehand, over that of the rest.
    pub(crate) base_rate_frac: f32,
}

impl Default for AdamSettings {
    fn default() -> Self {
        Self { beta1: 0.9, beta2: 0.98, epsilon: 1e-8, weight_decay: 0.01, max_norm: 1.0, base_rate_frac: 1.0 }
    }
}

/// Running means of one parameter's gradient and of its square.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Moments {
    /// Of the gradient.
    pub(crate) mean: Vec<f32>,
    /// Of the squared gradient.
    pub(crate) square: Vec<f32>,
}

/// The optimizer's state.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct AdamW {
    /// Steps done.
    pub(crate) steps: u64,
    /// By name of the parameter.
    pub(crate) moments: BTreeMap<String, Moments>,
}

impl AdamW {
    /// One step against `gradients`, which are in the order of `vars`, on `threads` threads. Returns the norm of all gradients
    /// before clipping. If the norm is not finite, the weights stay as they are.
    pub(crate) fn step(
        &mut self,
        vars: &BTreeMap<String, Var>,
        gradients: &[Vec<f32>],
        rate: f32,
        settings: &AdamSettings,
        threads: usize,
    ) -> Result<f32> {
        self.steps += 1;
        let of_one = |gradient: &Vec<f32>| gradient.iter().map(|g| f64::from(*g) * f64::from(*g)).sum::<f64>();
        let squares = map_on_threads(threads, gradients.iter().collect(), of_one);
        let norm = squares.iter().sum::<f64>().sqrt() as f32;
        if !norm.is_finite() {
            return Ok(norm);
        }
        let scale = if norm > settings.max_norm { settings.max_norm / norm } else { 1.0 };
        let power = i32::try_from(self.steps).unwrap_or(i32::MAX);
        let unbias = [1.0 - settings.beta1.powi(power), 1.0 - settings.beta2.powi(power)];
        for name in vars.keys() {
            self.moments.entry(name.clone()).or_default();
        }
        let moments = self.moments.iter_mut().filter(|(name, _)| vars.contains_key(*name)).map(|(_, moments)| moments);
        let parameters = vars.iter().zip(moments).zip(gradients).collect();
        let update = |(((name, var), moments), gradient): (((&String, &Var), &mut Moments), &Vec<f32>)| {
            let rate = if name.starts_with("bert.") { rate * settings.base_rate_frac } else { rate };
            let decay = if var.rank() >= 2 { rate * settings.weight_decay } else { 0.0 };
            let mut values = var.flatten_all()?.to_vec1::<f32>()?;
            moments.mean.resize(gradient.len(), 0.0);
            moments.square.resize(gradient.len(), 0.0);
            let of_values = values.iter_mut().zip(gradient).zip(&mut moments.mean).zip(&mut moments.square);
            for (((value, g), mean), square) in of_values {
                let g = g * scale;
                *mean = settings.beta1 * *mean + (1.0 - settings.beta1) * g;
                *square = settings.beta2 * *square + (1.0 - settings.beta2) * g * g;
                *value -= decay * *value;
                *value -= rate * (*mean / unbias[0]) / ((*square / unbias[1]).sqrt() + settings.epsilon);
            }
            var.set(&Tensor::from_vec(values, var.shape(), &Device::Cpu)?)
        };
        map_on_threads(threads, parameters, update).into_iter().collect::<Result<()>>()?;
        Ok(norm)
    }
}

/// Learning rate of a step: linear up to `peak` over `warm_up` steps, then half a cosine down to 2 % of it at `total`.
pub(crate) fn learning_rate(step: u64, warm_up: u64, total: u64, peak: f32) -> f32 {
    if step < warm_up {
        return peak * (step + 1) as f32 / warm_up as f32;
    }
    let progress = ((step - warm_up) as f32 / total.saturating_sub(warm_up).max(1) as f32).min(1.0);
    peak * (0.02 + 0.98 * 0.5 * (1.0 + (progress * std::f32::consts::PI).cos()))
}
