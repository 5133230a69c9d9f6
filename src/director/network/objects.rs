//! The Q-former: turns the sparse cloud of each object into a few tokens.
//!
//! Learned queries attend to the points of one object by cross-attention (Li et al. 2023, BLIP-2, for images). A point is
//! its offset from the object's centroid. The object's box and its identifier in the text are added to the queries.

use candle_core::{Result, Tensor};

use super::config::ModelConfig;
use super::dropout::Dropout;
use super::layers::{AttentionLayer, FeedForward, Linear, Norm, Visibility};
use super::parameters::{Parameters, Start};
use super::prompt_batch::PromptBatch;

/// Learned queries and the layers that fill them.
#[derive(Debug, Clone)]
pub(super) struct ObjectEncoder {
    /// `[queries, width]`
    queries: Tensor,
    boxes: Linear,
    points: Linear,
    layers: Vec<Layer>,
    norm: Norm,
}

#[derive(Debug, Clone)]
struct Layer {
    self_attention: AttentionLayer,
    cross_attention: AttentionLayer,
    feed: FeedForward,
}

impl ObjectEncoder {
    pub(super) fn new(parameters: &mut Parameters, config: &ModelConfig) -> Result<Self> {
        let (width, heads) = (config.width, config.heads);
        let layer = |idx: usize, parameters: &mut Parameters| {
            Ok(Layer {
                self_attention: AttentionLayer::over_sequence(
                    parameters,
                    &format!("objects.{idx}.among"),
                    width,
                    heads,
                )?,
                cross_attention: AttentionLayer::over_memory(
                    parameters,
                    &format!("objects.{idx}.points"),
                    width,
                    heads,
                )?,
                feed: FeedForward::new(parameters, &format!("objects.{idx}.feed"), width, config.hidden / 2)?,
            })
        };
        Ok(Self {
            queries: parameters.get("objects.queries", &[config.queries, width], Start::Normal(0.5))?,
            boxes: Linear::new(parameters, "objects.boxes", 6 * config.axis_features, width)?,
            points: Linear::biased(parameters, "objects.point", 3 * config.axis_features, width)?,
            layers: (0..config.object_layers).map(|idx| layer(idx, parameters)).collect::<Result<_>>()?,
            norm: Norm::new(parameters, "objects.norm", width)?,
        })
    }

    /// Tokens of every object: `[batch * objects, queries, width]`. `slots` are the embeddings of the identifiers,
    /// `[batch * objects, width]`.
    pub(super) fn apply(&self, batch: &PromptBatch, slots: &Tensor, dropout: &Dropout) -> Result<Tensor> {
        let points = self.points.apply(&batch.points)?; // [batch * objects, points, width]
        let identity = (self.boxes.apply(&batch.boxes)? + slots)?.unsqueeze(1)?; // [batch * objects, 1, width]
        let mut tokens = identity.broadcast_add(&self.queries)?; // [batch * objects, queries, width]
        let num_queries = self.queries.dim(0)?;
        let all = Visibility { exists: vec![true; tokens.dim(0)? * num_queries].into(), causal: false };
        let cloud = Visibility { exists: batch.point_exists.clone(), causal: false };
        for layer in &self.layers {
            tokens = layer.self_attention.apply(&tokens, None, &all, dropout)?;
            tokens = layer.cross_attention.apply(&tokens, Some(&points), &cloud, dropout)?;
            tokens = layer.feed.apply(&tokens, dropout)?;
        }
        self.norm.apply(&tokens)
    }
}
