//! A language model of two layers, trained in place: a forward pass of its own in differentiable operations, a tokenizer
//! trained on the questions, and both as a GGUF file.
//!
//! The first layer and the table of tokens stay as they are drawn; the second layer and the output learn. So the first
//! layer passes over each question once, and the second only where an answer stands.

use std::collections::BTreeMap;
use std::io::Cursor;

use candle_core::quantized::gguf_file::{self, Content, Value};
use candle_core::quantized::tokenizer::TokenizerFromGguf;
use candle_core::quantized::{GgmlDType, QTensor};
use candle_core::{D, DType, Device, Result, Tensor, Var};
use candle_nn::{AdamW, Optimizer, ParamsAdamW, loss};
use cinesplat::reader::{Question, question_tokens};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use tokenizers::models::TrainerWrapper;
use tokenizers::models::bpe::{BPE, BpeTrainer};
use tokenizers::pre_tokenizers::byte_level::ByteLevel;
use tokenizers::{AddedToken, Tokenizer};

const WIDTH: usize = 64;
const INNER: usize = 128;
const NUM_LAYERS: usize = 2;
const NUM_HEADS: usize = 4;
const NUM_KEY_HEADS: usize = 2;
const HEAD: usize = WIDTH / NUM_HEADS;
const EPSILON: f64 = 1e-6;
const ROPE_BASE: f32 = 10_000.0;
const NUM_TOKENS: usize = 1200;

/// The families of models.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Family {
    Qwen2,
    Llama,
}

impl Family {
    fn name(self) -> &'static str {
        if self == Self::Qwen2 { "qwen2" } else { "llama" }
    }

    /// Special tokens; the second ends an answer.
    fn special(self) -> Vec<&'static str> {
        match self {
            Self::Qwen2 => vec!["<|endoftext|>", "<|im_end|>", "<|im_start|>"],
            Self::Llama => vec!["<|begin_of_text|>", "<|eot_id|>", "<|start_header_id|>", "<|end_header_id|>"],
        }
    }
}

/// A model in training.
pub struct TinyModel {
    family: Family,
    tokenizer_keys: BTreeMap<String, Value>,
    tokenizer: Tokenizer,
    weights: BTreeMap<String, Tensor>,
    learned: Vec<Var>,
}

impl TinyModel {
    /// A model with drawn weights, and a tokenizer for the words of the questions.
    pub fn new(family: Family, questions: &[Question]) -> Self {
        let tokenizer_keys = tokenizer_keys(family, questions);
        let header = gguf(&tokenizer_keys, &BTreeMap::new());
        let tokenizer = Tokenizer::from_gguf(&Content::read(&mut Cursor::new(header)).unwrap()).unwrap();
        let mut rng = Pcg64::seed_from_u64(3);
        let (mut weights, mut learned) = (BTreeMap::new(), Vec::new());
        for (name, dims) in shapes(family, tokenizer.get_vocab_size(true)) {
            let values = drawn(&mut rng, &name, &dims);
            let learns = name.starts_with("blk.1.") || name.starts_with("output");
            weights.insert(
                name,
                if learns {
                    learned.push(Var::from_tensor(&values).unwrap());
                    learned.last().unwrap().as_tensor().clone()
                } else {
                    values
                },
            );
        }
        Self { family, tokenizer_keys, tokenizer, weights, learned }
    }

    /// Trains on questions with their answers until the mean loss is below 0.02. Returns the last loss.
    pub fn train(&mut self, examples: &[(Question, &str)]) -> f32 {
        let mut optimizer =
            AdamW::new(self.learned.clone(), ParamsAdamW { lr: 4e-3, weight_decay: 0.0, ..ParamsAdamW::default() })
                .unwrap();
        let end = self.tokenizer.token_to_id(self.family.special()[1]).unwrap();
        let prepared: Vec<_> = examples
            .iter()
            .map(|(question, answer)| {
                let prompt = self.prompt(question);
                let mut answer = self.tokenizer.encode(*answer, false).unwrap().get_ids().to_vec();
                answer.push(end);
                let tokens: Vec<u32> = prompt.iter().chain(&answer[..answer.len() - 1]).copied().collect();
                let hidden = self.layer(0, &self.embedded(&tokens).unwrap(), 0).unwrap().detach();
                (hidden, prompt.len() - 1, Tensor::new(answer, &Device::Cpu).unwrap())
            })
            .collect();
        let mut last = f32::MAX;
        for _ in 0..400 {
            let losses: Vec<Tensor> = prepared
                .iter()
                .map(|(hidden, from, answer)| {
                    let scores = self.scores(&self.layer(1, hidden, *from).unwrap()).unwrap();
                    loss::cross_entropy(&scores, answer).unwrap()
                })
                .collect();
            let mean = Tensor::stack(&losses, 0).unwrap().mean_all().unwrap();
            optimizer.backward_step(&mean).unwrap();
            last = mean.to_scalar().unwrap();
            if last < 0.02 {
                break;
            }
        }
        last
    }

    /// The tokens of a question.
    pub fn prompt(&self, question: &Question) -> Vec<u32> {
        let first = (self.family == Family::Llama).then_some(0);
        question_tokens(&self.tokenizer, question, first).unwrap()
    }

    /// The scores of the token after some tokens.
    pub fn last_scores(&self, tokens: &[u32]) -> Vec<f32> {
        let hidden = self.layer(0, &self.embedded(tokens).unwrap(), 0).unwrap();
        let hidden = self.layer(1, &hidden, tokens.len() - 1).unwrap();
        self.scores(&hidden).unwrap().squeeze(0).unwrap().to_vec1().unwrap()
    }

    /// The model as a GGUF file.
    pub fn gguf(&self) -> Vec<u8> {
        let mut keys = self.tokenizer_keys.clone();
        let family = self.family.name();
        let sizes = [
            ("attention.head_count", NUM_HEADS),
            ("attention.head_count_kv", NUM_KEY_HEADS),
            ("embedding_length", WIDTH),
            ("context_length", 4096),
            ("block_count", NUM_LAYERS),
            ("rope.dimension_count", HEAD),
        ];
        keys.extend(sizes.map(|(key, size)| (format!("{family}.{key}"), Value::U32(size as u32))));
        keys.insert(format!("{family}.attention.layer_norm_rms_epsilon"), Value::F32(EPSILON as f32));
        keys.insert(format!("{family}.rope.freq_base"), Value::F32(ROPE_BASE));
        gguf(&keys, &self.weights)
    }

    fn embedded(&self, tokens: &[u32]) -> Result<Tensor> {
        self.weights["token_embd.weight"].index_select(&Tensor::new(tokens, &Device::Cpu)?, 0) // [token, width]
    }

    /// A layer over all tokens, for those from `from` on. Input and output: `[token, width]`.
    fn layer(&self, layer: usize, input: &Tensor, from: usize) -> Result<Tensor> {
        let weight = |part: &str| &self.weights[&format!("blk.{layer}.{part}")];
        let linear = |x: &Tensor, part: &str| {
            let product = x.matmul(&weight(&format!("{part}.weight")).t()?)?;
            match self.weights.get(&format!("blk.{layer}.{part}.bias")) {
                Some(bias) => product.broadcast_add(bias),
                None => Ok(product),
            }
        };
        let num_tokens = input.dim(0)?;
        let normed = normed(input, weight("attn_norm.weight"))?;
        let asked = normed.narrow(0, from, num_tokens - from)?;
        let heads = |x: Tensor, num_heads: usize| x.reshape(((), num_heads, HEAD))?.transpose(0, 1); // [head, token, HEAD]
        let queries = self.rotated(&heads(linear(&asked, "attn_q")?, NUM_HEADS)?, from)?;
        let keys = self.rotated(&heads(linear(&normed, "attn_k")?, NUM_KEY_HEADS)?, 0)?;
        let values = heads(linear(&normed, "attn_v")?, NUM_KEY_HEADS)?;
        let per_query = |x: &Tensor| {
            let share = NUM_HEADS / NUM_KEY_HEADS;
            let repeated = x.unsqueeze(1)?.repeat((1, share, 1, 1))?; // [key head, share, token, HEAD]
            repeated.reshape((NUM_HEADS, num_tokens, HEAD))
        };
        let scores = queries.matmul(&per_query(&keys)?.t()?.contiguous()?)?.affine((HEAD as f64).powf(-0.5), 0.0)?;
        let later = |i: usize, j: usize| if j > i + from { -1e9 } else { 0.0_f32 };
        let mask: Vec<f32> = (0..num_tokens - from).flat_map(|i| (0..num_tokens).map(move |j| later(i, j))).collect();
        let mask = Tensor::from_vec(mask, (1, num_tokens - from, num_tokens), &Device::Cpu)?;
        let shares = candle_nn::ops::softmax(&scores.broadcast_add(&mask)?, D::Minus1)?;
        let mixed = shares.matmul(&per_query(&values)?)?.transpose(0, 1)?.reshape(((), WIDTH))?; // [token, width]
        let x = (input.narrow(0, from, num_tokens - from)? + linear(&mixed, "attn_output")?)?;
        let inner = self::normed(&x, weight("ffn_norm.weight"))?;
        let gate = linear(&inner, "ffn_gate")?;
        let gate = (&gate * candle_nn::ops::sigmoid(&gate)?)?;
        let inner = (gate * linear(&inner, "ffn_up")?)?;
        x + linear(&inner, "ffn_down")?
    }

    fn scores(&self, hidden: &Tensor) -> Result<Tensor> {
        normed(hidden, &self.weights["output_norm.weight"])?.matmul(&self.weights["output.weight"].t()?)
    }

    /// Rotary positions (Su et al. 2021) of `[head, token, HEAD]` for tokens from `from` on: Qwen2 pairs the channels of
    /// both halves, Llama neighbors.
    fn rotated(&self, x: &Tensor, from: usize) -> Result<Tensor> {
        let (num_heads, num_tokens, _) = x.dims3()?;
        let angle =
            |token: usize, pair: usize| (token + from) as f32 * ROPE_BASE.powf(-2.0 * pair as f32 / HEAD as f32);
        let angles: Vec<f32> =
            (0..num_tokens).flat_map(|token| (0..HEAD / 2).map(move |pair| angle(token, pair))).collect();
        let angles = Tensor::from_vec(angles, (1, num_tokens, HEAD / 2), &Device::Cpu)?;
        let (pairs, axis) = match self.family {
            Family::Qwen2 => ((num_heads, num_tokens, 2, HEAD / 2), 2),
            Family::Llama => ((num_heads, num_tokens, HEAD / 2, 2), 3),
        };
        let pairs = x.contiguous()?.reshape(pairs)?;
        let part = |idx: usize| pairs.narrow(axis, idx, 1)?.squeeze(axis);
        let (a, b, cos, sin) = (part(0)?, part(1)?, angles.cos()?, angles.sin()?);
        let turned_a = (a.broadcast_mul(&cos)? - b.broadcast_mul(&sin)?)?;
        let turned_b = (a.broadcast_mul(&sin)? + b.broadcast_mul(&cos)?)?;
        Tensor::stack(&[turned_a, turned_b], axis)?.reshape((num_heads, num_tokens, HEAD))
    }
}

/// Root mean square normalization.
fn normed(x: &Tensor, weight: &Tensor) -> Result<Tensor> {
    let square = x.sqr()?.mean_keepdim(D::Minus1)?;
    x.broadcast_div(&(square + EPSILON)?.sqrt()?)?.broadcast_mul(weight)
}

/// Names and dimensions of all tensors.
fn shapes(family: Family, num_tokens: usize) -> Vec<(String, Vec<usize>)> {
    let key_width = HEAD * NUM_KEY_HEADS;
    let mut shapes = vec![
        ("token_embd.weight".to_owned(), vec![num_tokens, WIDTH]),
        ("output_norm.weight".to_owned(), vec![WIDTH]),
        ("output.weight".to_owned(), vec![num_tokens, WIDTH]),
    ];
    for layer in 0..NUM_LAYERS {
        let mut add = |part: &str, dims: &[usize]| shapes.push((format!("blk.{layer}.{part}"), dims.to_vec()));
        add("attn_norm.weight", &[WIDTH]);
        add("ffn_norm.weight", &[WIDTH]);
        for (part, size) in [("attn_q", WIDTH), ("attn_k", key_width), ("attn_v", key_width)] {
            add(&format!("{part}.weight"), &[size, WIDTH]);
            if family == Family::Qwen2 {
                add(&format!("{part}.bias"), &[size]);
            }
        }
        add("attn_output.weight", &[WIDTH, WIDTH]);
        add("ffn_gate.weight", &[INNER, WIDTH]);
        add("ffn_up.weight", &[INNER, WIDTH]);
        add("ffn_down.weight", &[WIDTH, INNER]);
    }
    shapes
}

/// Weights of norms near 1, the others of a variance that keeps the size of their input.
fn drawn(rng: &mut Pcg64, name: &str, dims: &[usize]) -> Tensor {
    let is_norm = name.contains("norm");
    let spread = if name == "token_embd.weight" { 1.7 } else { (3.0 / *dims.last().unwrap() as f32).sqrt() };
    let value = |rng: &mut Pcg64| {
        let uniform = rng.random_range(-1.0_f32..1.0);
        if is_norm { 1.0 + 0.1 * uniform } else { spread * uniform }
    };
    let values: Vec<f32> = (0..dims.iter().product()).map(|_| value(rng)).collect();
    Tensor::from_vec(values, dims, &Device::Cpu).unwrap().to_dtype(DType::F32).unwrap()
}

/// The keys of a GGUF file that describe a tokenizer trained on the questions.
fn tokenizer_keys(family: Family, questions: &[Question]) -> BTreeMap<String, Value> {
    let examples = Question::examples().into_iter().flat_map(|(asked, answer)| [asked, answer]);
    let texts = questions.iter().map(Question::text).chain(examples).chain([Question::instructions()]);
    let texts: Vec<String> = texts.collect();
    let special = family.special();
    let trainer = BpeTrainer::builder()
        .show_progress(false)
        .vocab_size(NUM_TOKENS)
        .initial_alphabet(ByteLevel::alphabet().into_iter().collect())
        .special_tokens(special.iter().map(|name| AddedToken::from(*name, true)).collect())
        .build();
    let mut tokenizer = Tokenizer::new(BPE::default());
    tokenizer.with_pre_tokenizer(Some(ByteLevel::new(false, true, true)));
    tokenizer.train(&mut TrainerWrapper::from(trainer), texts.iter()).unwrap();
    let json: serde_json::Value = serde_json::from_str(&tokenizer.to_string(false).unwrap()).unwrap();
    let merge = |merge: &serde_json::Value| {
        let part = |idx: usize| merge[idx].as_str().unwrap();
        Value::String(format!("{} {}", part(0), part(1)))
    };
    let merges = json["model"]["merges"].as_array().unwrap().iter().map(merge).collect();
    let tokens = (0..tokenizer.get_vocab_size(true) as u32).map(|id| tokenizer.id_to_token(id).unwrap());
    let types = tokens.clone().map(|token| Value::I32(if special.contains(&token.as_str()) { 3 } else { 1 }));
    let text = |text: &str| Value::String(text.to_owned());
    BTreeMap::from([
        ("general.architecture".to_owned(), text(family.name())),
        ("tokenizer.ggml.model".to_owned(), text("gpt2")),
        ("tokenizer.ggml.pre".to_owned(), text(if family == Family::Qwen2 { "qwen2" } else { "llama3" })),
        ("tokenizer.ggml.token_type".to_owned(), Value::Array(types.collect())),
        ("tokenizer.ggml.tokens".to_owned(), Value::Array(tokens.map(Value::String).collect())),
        ("tokenizer.ggml.merges".to_owned(), Value::Array(merges)),
        ("tokenizer.ggml.bos_token_id".to_owned(), Value::U32(0)),
        ("tokenizer.ggml.eos_token_id".to_owned(), Value::U32(1)),
    ])
}

/// A GGUF file of 32-bit floats.
pub fn gguf(keys: &BTreeMap<String, Value>, weights: &BTreeMap<String, Tensor>) -> Vec<u8> {
    let tensors: Vec<(&str, QTensor)> = weights
        .iter()
        .map(|(name, tensor)| (name.as_str(), QTensor::quantize(tensor, GgmlDType::F32).unwrap()))
        .collect();
    let keys: Vec<(&str, &Value)> = keys.iter().map(|(key, value)| (key.as_str(), value)).collect();
    let tensors: Vec<(&str, &QTensor)> = tensors.iter().map(|(name, tensor)| (*name, tensor)).collect();
    let mut bytes = Cursor::new(Vec::new());
    gguf_file::write(&mut bytes, &keys, &tensors).unwrap();
    bytes.into_inner()
}
