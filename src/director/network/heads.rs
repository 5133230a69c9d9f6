//! The heads: turn states of the intent decoder into scores.
//!
//! Classes come from one linear layer. Objects, quantities and words are chosen by pointers: the score of an item is the
//! scalar product of a query, made from the state, and a key, made from the item. So the network works for any number of
//! items.

use candle_core::{Device, Result, Tensor};

use super::config::ModelConfig;
use super::decoder::Memory;
use super::layers::Linear;
use super::matrix_product::matrix_product;
use super::parameters::{Parameters, Start};
use super::prompt_batch::PromptBatch;
use crate::codes::{Field, OBJECT_POINTERS, QUANTITY_POINTERS};

/// Added to the score of an item that does not exist: its probability becomes 0, and no score becomes infinite.
const ABSENT: f32 = -1e9;

/// Scores before the softmax (logits) of every choice of every key.
#[derive(Debug, Clone)]
pub struct Scores {
    /// Classes of all fields, side by side in the order of [`Field`]: `[batch, keys, classes]`
    pub classes: Tensor,
    /// Per object pointer: nothing, then each object: `[batch, keys, OBJECT_POINTERS, 1 + objects]`
    pub objects: Tensor,
    /// Per quantity pointer: nothing, then each quantity: `[batch, keys, QUANTITY_POINTERS, 1 + quantities]`
    pub quantities: Tensor,
    /// First token and last token of the span: `[batch, keys, 2, tokens]`
    pub words: Tensor,
    /// Per token, whether the notation can say it: yes, no: `[batch, tokens, 2]`
    pub unmet: Tensor,
    /// Length of the film: nothing, then each quantity: `[batch, 1, 1, 1 + quantities]`
    pub film_length: Tensor,
}

/// Pointers at the items of one list.
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
    /// `num` pointers. `widths` are the widths of states, items, and queries with keys.
    fn new(parameters: &mut Parameters, name: &str, num: usize, widths: [usize; 3]) -> Result<Self> {
        let [state, item, width] = widths;
        Ok(Self {
            query: Linear::biased(parameters, &format!("{name}.query"), state, num * width)?,
            key: Linear::new(parameters, &format!("{name}.key"), item, width)?,
            nothing: None,
            num,
            width,
        })
    }

    /// As [`Self::new`], with "nothing" as item 0.
    fn with_nothing(parameters: &mut Parameters, name: &str, num: usize, widths: [usize; 3]) -> Result<Self> {
        let nothing = parameters.get(&format!("{name}.nothing"), &[widths[2]], Start::Normal(1.0))?;
        Ok(Self { nothing: Some(nothing), ..Self::new(parameters, name, num, widths)? })
    }

    /// Scores `[batch, keys, num, items]`, with "nothing" `[batch, keys, num, 1 + items]`. `items` is
    /// `[batch, items, item width]`, `exists` is `[batch * items]`.
    fn apply(&self, states: &Tensor, items: &Tensor, exists: &[bool]) -> Result<Tensor> {
        let (batch, num_keys, _) = states.dims3()?;
        let mut keys = self.key.apply(items)?; // [batch, items, width]
        let num_items = keys.dim(1)?;
        let mut absent: Vec<f32> = Vec::with_capacity(batch * (num_items + 1));
        for row in exists.chunks_exact(num_items) {
            absent.extend(self.nothing.iter().map(|_| 0.0));
            absent.extend(row.iter().map(|exists| if *exists { 0.0 } else { ABSENT }));
        }
        if let Some(nothing) = &self.nothing {
            let nothing = nothing.reshape((1, 1, self.width))?.broadcast_as((batch, 1, self.width))?;
            keys = Tensor::cat(&[&nothing.contiguous()?, &keys], 1)?; // [batch, 1 + items, width]
        }
        let num_items = keys.dim(1)?;
        let query = self.query.apply(states)?.reshape((batch, num_keys * self.num, self.width))?; // [batch, keys * num, width]
        let query = (query * f64::from((self.width as f32).sqrt().recip()))?;
        let scores = matrix_product(&query, &keys.transpose(1, 2)?)?; // [batch, keys * num, items]
        let absent = Tensor::from_vec(absent, (batch, 1, num_items), &Device::Cpu)?;
        scores.broadcast_add(&absent)?.reshape((batch, num_keys, self.num, num_items))
    }
}

/// All heads of the intent decoder.
#[derive(Debug, Clone)]
pub(super) struct Heads {
    classes: Linear,
    objects: Pointer,
    quantities: Pointer,
    words: Pointer,
    film_length: Pointer,
    unmet: Linear,
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
            film_length: Pointer::with_nothing(parameters, "head.film", 1, quantity)?,
            unmet: Linear::biased(parameters, "head.unmet", width, 2)?,
        })
    }

    /// Per token, scores of "the notation can say it" and "it cannot": `[batch, tokens, 2]`
    pub(super) fn unmet(&self, memory: &Memory) -> Result<Tensor> {
        self.unmet.apply(&memory.text)
    }

    /// Scores of the keys that `states` predict.
    pub(super) fn apply(&self, states: &Tensor, memory: &Memory, batch: &PromptBatch) -> Result<Scores> {
        let named = matrix_product(&batch.object_tokens, &memory.text)?; // [batch, objects, width]
        let objects = Tensor::cat(&[&memory.objects, &named], 2)?; // [batch, objects, 2 width]
        let quantities = matrix_product(&batch.quantity_tokens, &memory.text)?; // [batch, quantities, width]
        let whole = memory.text.narrow(1, 0, 1)?.contiguous()?; // [batch, 1, width]
        Ok(Scores {
            classes: self.classes.apply(states)?,
            objects: self.objects.apply(states, &objects, &batch.object_exists)?,
            quantities: self.quantities.apply(states, &quantities, &batch.quantity_exists)?,
            words: self.words.apply(states, &memory.text, &batch.token_exists)?,
            unmet: self.unmet(memory)?,
            film_length: self.film_length.apply(&whole, &quantities, &batch.quantity_exists)?,
        })
    }
}
