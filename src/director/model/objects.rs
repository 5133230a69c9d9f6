//! The Q-former: the sparse cloud of each object to a few tokens.
//!
//! Learned queries look at the points of one object by cross-attention (Li et al. 2023, BLIP-2, for images). A point is
//! its offset from the object's centroid; where the object stands, how large it is and by which identifier the text
//! calls it comes with the queries.

use candle_core::{Result, Tensor};

use super::batch::PromptBatch;
use super::config::ModelConfig;
use super::layers::{AttentionLayer, Dropout, FeedForward, Linear, Norm, Sight};
use super::parameters::{Parameters, Start};

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
    among: AttentionLayer,
    onto_points: AttentionLayer,
    feed: FeedForward,
}

impl ObjectEncoder {
    pub(super) fn new(parameters: &mut Parameters, config: &ModelConfig) -> Result<Self> {
        let (width, heads) = (config.width, config.heads);
        let layer = |idx: usize, parameters: &mut Parameters| {
            Ok(Layer {
                among: AttentionLayer::among(parameters, &format!("objects.{idx}.among"), width, heads)?,
                onto_points: AttentionLayer::onto(parameters, &format!("objects.{idx}.points"), width, heads)?,
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

    /// Tokens of every object, `[batch * objects, queries, width]`; `slots` are the embeddings of their identifiers,
    /// `[batch * objects, width]`.
    pub(super) fn apply(&self, batch: &PromptBatch, slots: &Tensor, dropout: &Dropout) -> Result<Tensor> {
        let points = self.points.apply(&batch.points)?; // [batch * objects, points, width]
        let who = (self.boxes.apply(&batch.boxes)? + slots)?.unsqueeze(1)?; // [batch * objects, 1, width]
        let mut tokens = who.broadcast_add(&self.queries)?; // [batch * objects, queries, width]
        let num_queries = self.queries.dim(0)?;
        let all = Sight { exists: vec![true; tokens.dim(0)? * num_queries].into(), causal: false };
        let cloud = Sight { exists: batch.point_exists.clone(), causal: false };
        for layer in &self.layers {
            tokens = layer.among.apply(&tokens, None, &all, dropout)?;
            tokens = layer.onto_points.apply(&tokens, Some(&points), &cloud, dropout)?;
            tokens = layer.feed.apply(&tokens, dropout)?;
        }
        self.norm.apply(&tokens)
    }
}
