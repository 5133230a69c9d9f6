//! A text encoder that was trained beforehand: a folder with BERT's weights as `transformers` stores them.
//!
//! Enters: `config.json`, `model.safetensors` and `vocab.txt`. Leaves: a vocabulary of those of its word pieces that English
//! needs, the sizes of the network, and its weights under the names of this program.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use candle_core::{Device, Tensor, Var};
use cinesplat_director::inputs::Vocabulary;
use cinesplat_director::network::BertConfig;
use cinesplat_files::Limits;
use safetensors::tensor::{Dtype, SafeTensors};
use serde::Deserialize;

use super::error::TrainError;

/// Pieces that are kept whether or not a sentence has them: the first of the list, which is roughly in order of frequency.
const COMMON_PIECES: usize = 10_000;
/// Positions that are kept.
const POSITIONS: usize = 256;
/// Piece whose weights the identifiers of objects start from.
const OBJECT_PIECE: &str = "thing";
/// Pieces whose weights the kinds of quantities start from, in the order of the kinds (seconds, degrees, scene units,
/// factors, percent, millimeters of a lens).
const KIND_PIECES: [&str; 6] = ["seconds", "degrees", "meters", "times", "percent", "lens"];

/// Sizes as `config.json` states them.
#[derive(Debug, Clone, Deserialize)]
struct Sizes {
    hidden_size: usize,
    intermediate_size: usize,
    num_attention_heads: usize,
    num_hidden_layers: usize,
}

/// A text encoder of other makers.
#[derive(Debug, Clone)]
pub struct Base {
    folder: PathBuf,
    sizes: Sizes,
    /// Id of each piece.
    pieces: BTreeMap<String, usize>,
    /// Values by the names of the file.
    tensors: BTreeMap<String, Vec<f32>>,
}

impl Base {
    /// Reads a folder.
    ///
    /// # Errors
    /// [`TrainError::File`] · [`TrainError::BadBase`] for files that are not of this family.
    pub fn read(folder: &Path) -> Result<Self, TrainError> {
        let bytes = |name: &str| cinesplat_files::read(&folder.join(name), Limits::DEFAULT.model_bytes);
        let sizes = serde_json::from_slice(&bytes("config.json")?)
            .map_err(|error| bad(folder, "config.json", &error.to_string()))?;
        let list =
            String::from_utf8(bytes("vocab.txt")?).map_err(|error| bad(folder, "vocab.txt", &error.to_string()))?;
        let pieces = list.lines().enumerate().map(|(id, piece)| (piece.to_owned(), id)).collect();
        let weights = bytes("model.safetensors")?;
        let file =
            SafeTensors::deserialize(&weights).map_err(|error| bad(folder, "model.safetensors", &error.to_string()))?;
        let tensors = file.iter().filter(|(_, view)| view.dtype() == Dtype::F32).map(|(name, view)| {
            let values = view.data().as_chunks::<4>().0.iter().map(|bytes| f32::from_le_bytes(*bytes)).collect();
            (name.trim_start_matches("bert.").to_owned(), values)
        });
        Ok(Self { folder: folder.to_owned(), sizes, pieces, tensors: tensors.collect() })
    }

    /// Sizes of its network.
    pub fn config(&self) -> BertConfig {
        BertConfig {
            width: self.sizes.hidden_size,
            heads: self.sizes.num_attention_heads,
            hidden: self.sizes.intermediate_size,
            layers: self.sizes.num_hidden_layers,
            positions: POSITIONS,
        }
    }

    /// The pieces of plain English that the words of `lines` are made of, and the most common others, in the order of the
    /// list.
    ///
    /// # Errors
    /// [`TrainError::Director`] when they make no vocabulary.
    pub fn vocabulary(&self, lines: &[String]) -> Result<Vocabulary, TrainError> {
        let words: BTreeSet<String> = lines
            .iter()
            .flat_map(|line| line.split(|c: char| !c.is_ascii_alphanumeric()))
            .map(str::to_ascii_lowercase)
            .collect();
        let used: BTreeSet<&str> = words.iter().flat_map(|word| self.split(word)).collect();
        let is_plain = |piece: &str| {
            let word = piece.strip_prefix("##").unwrap_or(piece);
            !word.is_empty()
                && (word.bytes().all(|b| b.is_ascii_lowercase() || b.is_ascii_digit())
                    || piece.len() == 1 && piece.bytes().all(|b| b.is_ascii_punctuation()))
        };
        let is_kept = |(piece, id): &(&String, &usize)| {
            is_plain(piece) && (**id < COMMON_PIECES || used.contains(piece.as_str()) || piece.len() <= 3)
        };
        let mut kept: Vec<(&String, &usize)> = self.pieces.iter().filter(is_kept).collect();
        kept.sort_by_key(|(_, id)| **id);
        let kept: Vec<String> = kept.into_iter().map(|(piece, _)| piece.clone()).collect();
        Ok(Vocabulary::of_word_pieces(&kept)?)
    }

    /// The longest pieces from the left; empty when a rest is no piece.
    fn split(&self, word: &str) -> Vec<&str> {
        let mut pieces = Vec::new();
        let mut start = 0;
        while start < word.len() {
            let mut found = None;
            for end in (start + 1..=word.len()).rev() {
                let text = if start == 0 { word[..end].to_owned() } else { format!("##{}", &word[start..end]) };
                if let Some((piece, _)) = self.pieces.get_key_value(&text) {
                    found = Some((piece, end));
                    break;
                }
            }
            let Some((piece, end)) = found else { return Vec::new() };
            pieces.push(piece.as_str());
            start = end;
        }
        pieces
    }

    /// Gives the parameters of BERT its weights.
    ///
    /// # Errors
    /// [`TrainError::BadBase`] when a tensor is missing or has another shape.
    pub fn load(&self, vars: &BTreeMap<String, Var>, vocabulary: &Vocabulary) -> Result<(), TrainError> {
        let mut set = |name: String, values: Vec<f32>| -> Result<(), TrainError> {
            let var = vars.get(&name).ok_or_else(|| bad(&self.folder, &name, "no such parameter"))?;
            if var.elem_count() != values.len() {
                let found = format!("{} values instead of {}", values.len(), var.elem_count());
                return Err(bad(&self.folder, &name, &found));
            }
            Ok(var.set(&Tensor::from_vec(values, var.shape(), &Device::Cpu)?)?)
        };
        let width = self.sizes.hidden_size;
        set("bert.table".into(), self.table(vocabulary)?)?;
        let kinds: Vec<Vec<f32>> =
            KIND_PIECES.iter().map(|piece| self.row(piece).map(<[f32]>::to_vec)).collect::<Result<_, _>>()?;
        set("bert.kinds".into(), std::iter::once(vec![0.0; width]).chain(kinds).flatten().collect())?;
        let segment = &self.tensor("embeddings.token_type_embeddings.weight")?[..width];
        let positions = self.tensor("embeddings.position_embeddings.weight")?;
        let positions = positions.iter().take(POSITIONS * width).zip(segment.iter().cycle());
        set("bert.positions".into(), positions.map(|(position, segment)| position + segment).collect())?;
        self.load_norm(&mut set, "bert.norm", "embeddings.LayerNorm")?;
        for idx in 0..self.sizes.num_hidden_layers {
            let (to, from) = (format!("bert.{idx}"), format!("encoder.layer.{idx}"));
            self.load_linear(&mut set, &format!("{to}.query"), &[format!("{from}.attention.self.query")])?;
            let key_value = ["key", "value"].map(|part| format!("{from}.attention.self.{part}"));
            self.load_linear(&mut set, &format!("{to}.key_value"), &key_value)?;
            self.load_linear(&mut set, &format!("{to}.out"), &[format!("{from}.attention.output.dense")])?;
            self.load_norm(&mut set, &format!("{to}.norm"), &format!("{from}.attention.output.LayerNorm"))?;
            self.load_linear(&mut set, &format!("{to}.up"), &[format!("{from}.intermediate.dense")])?;
            self.load_linear(&mut set, &format!("{to}.down"), &[format!("{from}.output.dense")])?;
            self.load_norm(&mut set, &format!("{to}.feed_norm"), &format!("{from}.output.LayerNorm"))?;
        }
        Ok(())
    }

    /// Rows of the vocabulary: `[vocabulary, width]`.
    fn table(&self, vocabulary: &Vocabulary) -> Result<Vec<f32>, TrainError> {
        let width = self.sizes.hidden_size;
        let mut table = vec![0.0; vocabulary.size() * width];
        for (piece, id) in vocabulary.pieces() {
            let from = match piece.as_str() {
                "<pad>" => "[PAD]",
                "<unk>" => "[UNK]",
                "<bos>" => "[CLS]",
                "<eos>" => "[SEP]",
                _ if piece.starts_with("<obj-") => OBJECT_PIECE,
                // The kind says what it is.
                _ if piece.starts_with("<qty-") => continue,
                piece => piece,
            };
            let start = id as usize * width;
            table[start..start + width].copy_from_slice(self.row(from)?);
        }
        Ok(table)
    }

    /// Embedding of a piece.
    fn row(&self, piece: &str) -> Result<&[f32], TrainError> {
        let width = self.sizes.hidden_size;
        let rows = self.tensor("embeddings.word_embeddings.weight")?;
        let id = self.pieces.get(piece).ok_or_else(|| bad(&self.folder, "vocab.txt", &format!("no {piece:?}")))?;
        rows.get(id * width..(id + 1) * width).ok_or_else(|| bad(&self.folder, piece, "no row in the embeddings"))
    }

    fn tensor(&self, name: &str) -> Result<&[f32], TrainError> {
        self.tensors
            .get(name)
            .map(Vec::as_slice)
            .ok_or_else(|| bad(&self.folder, name, "missing, or not of 32-bit numbers"))
    }

    fn load_norm(
        &self,
        set: &mut impl FnMut(String, Vec<f32>) -> Result<(), TrainError>,
        to: &str,
        from: &str,
    ) -> Result<(), TrainError> {
        set(format!("{to}.gain"), self.tensor(&format!("{from}.weight"))?.to_vec())?;
        set(format!("{to}.bias"), self.tensor(&format!("{from}.bias"))?.to_vec())
    }

    /// Loads linear layers side by side. The file has `[out, in]`, this program `[in, out]`.
    fn load_linear(
        &self,
        set: &mut impl FnMut(String, Vec<f32>) -> Result<(), TrainError>,
        to: &str,
        from: &[String],
    ) -> Result<(), TrainError> {
        let (mut weights, mut bias) = (Vec::new(), Vec::new());
        for name in from {
            let outs = self.tensor(&format!("{name}.bias"))?;
            bias.extend_from_slice(outs);
            weights.push((self.tensor(&format!("{name}.weight"))?, outs.len()));
        }
        let ins = weights.first().map_or(0, |(values, outs)| values.len() / (*outs).max(1));
        let column = |idx: usize| {
            weights.iter().flat_map(move |(values, outs)| (0..*outs).map(move |out| values[out * ins + idx]))
        };
        let values: Vec<f32> = (0..ins).flat_map(column).collect();
        set(format!("{to}.weight"), values)?;
        set(format!("{to}.bias"), bias)
    }
}

fn bad(folder: &Path, part: &str, found: &str) -> TrainError {
    TrainError::BadBase { path: folder.join(part), found: found.to_owned() }
}
