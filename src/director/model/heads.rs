//! The heads: states of the intent decoder to choices.
//!
//! Classes come from one linear layer. Objects, quantities and words are pointed at: the score of a place is the product
//! of a query made from the state and a key made from the place, so that the network works for any number of them.

use candle_core::{Device, Result, Tensor};

use super::batch::PromptBatch;
use super::config::ModelConfig;
use super::decoder::Memory;
use super::layers::Linear;
use super::parameters::{Parameters, Start};
use crate::codes::{Field, OBJECT_POINTERS, QUANTITY_POINTERS};

/// Score of a place that does not exist: no probability, no infinity.
const ABSENT: f32 = -1e9;

/// Scores (before softmax) of every choice of every key.
#[derive(Debug, Clone)]
pub struct Scores {
    /// Classes of all fields side by side: `[batch, keys, classes]`
    pub classes: Tensor,
    /// Nothing, then each object: `[batch, keys, OBJECT_POINTERS, 1 + objects]`
    pub objects: Tensor,
    /// Nothing, then each quantity: `[batch, keys, QUANTITY_POINTERS, 1 + quantities]`
    pub quantities: Tensor,
    /// First and last token: `[batch, keys, 2, tokens]`
    pub words: Tensor,
    /// The film's length: nothing, then each quantity: `[batch, 1, 1, 1 + quantities]`
    pub film: Tensor,
}

#[derive(Debug, Clone)]
struct Pointer {
    query: Linear,
    key: Linear,
    /// Key of "nothing": `[pointer width]`
    nothing: Option<Tensor>,
    num: usize,
    width: usize,
}

impl Pointer {
    /// `num` pointers from states of `widths[0]` numbers at places of `widths[1]` numbers.
    fn new(parameters: &mut Parameters, name: &str, num: usize, widths: [usize; 3]) -> Result<Self> {
        let [from, at, width] = widths;
        Ok(Self {
            query: Linear::biased(parameters, &format!("{name}.query"), from, num * width)?,
            key: Linear::new(parameters, &format!("{name}.key"), at, width)?,
            nothing: None,
            num,
            width,
        })
    }

    /// The same with "nothing" as place 0.
    fn with_nothing(parameters: &mut Parameters, name: &str, num: usize, widths: [usize; 3]) -> Result<Self> {
        let nothing = parameters.get(&format!("{name}.nothing"), &[widths[2]], Start::Normal(1.0))?;
        Ok(Self { nothing: Some(nothing), ..Self::new(parameters, name, num, widths)? })
    }

    /// `[batch, keys, num, places]`, one more place with "nothing".
    fn apply(&self, states: &Tensor, places: &Tensor, exists: &[bool]) -> Result<Tensor> {
        let (batch, num_keys, _) = states.dims3()?;
        let mut keys = self.key.apply(places)?; // [batch, places, width]
        let num_places = keys.dim(1)?;
        let mut absent: Vec<f32> = Vec::with_capacity(batch * (num_places + 1));
        for row in exists.chunks_exact(num_places) {
            absent.extend(self.nothing.iter().map(|_| 0.0));
            absent.extend(row.iter().map(|exists| if *exists { 0.0 } else { ABSENT }));
        }
        if let Some(nothing) = &self.nothing {
            let nothing = nothing.reshape((1, 1, self.width))?.broadcast_as((batch, 1, self.width))?;
            keys = Tensor::cat(&[&nothing.contiguous()?, &keys], 1)?; // [batch, 1 + places, width]
        }
        let num_places = keys.dim(1)?;
        let query = self.query.apply(states)?.reshape((batch, num_keys * self.num, self.width))?; // [batch, keys * num, width]
        let query = (query * f64::from((self.width as f32).sqrt().recip()))?;
        let scores = query.matmul(&keys.transpose(1, 2)?.contiguous()?)?; // [batch, keys * num, places]
        let absent = Tensor::from_vec(absent, (batch, 1, num_places), &Device::Cpu)?;
        scores.broadcast_add(&absent)?.reshape((batch, num_keys, self.num, num_places))
    }
}

/// All heads of the intent decoder.
#[derive(Debug, Clone)]
pub(super) struct Heads {
    classes: Linear,
    objects: Pointer,
    quantities: Pointer,
    words: Pointer,
    film: Pointer,
}

impl Heads {
    pub(super) fn new(parameters: &mut Parameters, config: &ModelConfig) -> Result<Self> {
        let (width, pointer) = (config.width, config.pointer_width);
        let quantity = [width, width, pointer];
        Ok(Self {
            classes: Linear::biased(parameters, "head.classes", width, Field::total_classes())?,
            objects: Pointer::with_nothing(parameters, "head.objects", OBJECT_POINTERS, [width, 2 * width, pointer])?,
            quantities: Pointer::with_nothing(parameters, "head.quantities", QUANTITY_POINTERS, quantity)?,
            words: Pointer::new(parameters, "head.words", 2, quantity)?,
            film: Pointer::with_nothing(parameters, "head.film", 1, quantity)?,
        })
    }

    /// Scores of the keys that `states` predict.
    pub(super) fn apply(&self, states: &Tensor, memory: &Memory, batch: &PromptBatch) -> Result<Scores> {
        let named = batch.object_tokens.matmul(&memory.text)?; // [batch, objects, width]
        let objects = Tensor::cat(&[&memory.objects, &named], 2)?; // [batch, objects, 2 width]
        let quantities = batch.quantity_tokens.matmul(&memory.text)?; // [batch, quantities, width]
        let whole = memory.text.narrow(1, 0, 1)?.contiguous()?; // [batch, 1, width]
        Ok(Scores {
            classes: self.classes.apply(states)?,
            objects: self.objects.apply(states, &objects, &batch.object_exists)?,
            quantities: self.quantities.apply(states, &quantities, &batch.quantity_exists)?,
            words: self.words.apply(states, &memory.text, &batch.token_exists)?,
            film: self.film.apply(&whole, &quantities, &batch.quantity_exists)?,
        })
    }
}
