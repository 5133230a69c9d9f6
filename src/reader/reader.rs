use std::collections::HashSet;
use std::fs::File;
use std::io::{self, Read, Seek};
use std::path::Path;
use std::sync::{Mutex, PoisonError};

use candle_core::quantized::gguf_file::{Content, Value};
use candle_core::quantized::tokenizer::TokenizerFromGguf;
use cinesplat_files::{FileError, Limits};
use cinesplat_language::Automaton;
use cinesplat_trajectory::ModelRef;
use sha2::{Digest, Sha256};
use tokenizers::Tokenizer;

use crate::conversation::question_tokens;
use crate::decode::decode;
use crate::error::ReaderError;
use crate::gguf_header::check_header;
use crate::interpretation::Interpretation;
use crate::question::Question;
use crate::shape::Shape;
use crate::vocabulary::Vocabulary;
use crate::weights::{MAX_TOKENS, Weights};

/// Most tokens of an answer.
const MAX_ANSWER_TOKENS: usize = 512;
/// The file beside the model that has the tokenizer, where the model itself has none that can be used.
const TOKENIZER_FILE: &str = "tokenizer.json";

/// A language model that reads prompts.
pub struct Reader {
    /// One prompt at a time: the network remembers what it has read.
    weights: Mutex<Weights>,
    tokenizer: Tokenizer,
    vocabulary: Vocabulary,
    /// The token that begins every text.
    first: Option<u32>,
    max_tokens: usize,
    model: ModelRef,
}

impl Reader {
    /// Loads a model from a GGUF file of the family `qwen2` or `llama`. Its tokenizer is the one in the file if that is
    /// byte-level, otherwise `tokenizer.json` beside it. Nothing is fetched.
    ///
    /// # Errors
    /// [`ReaderError::File`] · [`ReaderError::BadModel`] for a file that is damaged, of another family, or without a
    /// tokenizer.
    pub fn load(path: &Path) -> Result<Self, ReaderError> {
        let mut file = open(path)?;
        let failed = |source| FileError::Read { path: path.to_owned(), source };
        check_header(path, &mut file)?;
        let num_bytes = file.metadata().map_err(failed)?.len();
        file.rewind().map_err(failed)?;
        let content = Content::read(&mut file).map_err(|error| {
            ReaderError::bad_model(path, "the header", &format!("damaged: {error}"), &"a GGUF header")
        })?;
        let shape = Shape::of(path, &content, num_bytes)?;
        let tokenizer = tokenizer(path, &content)?;
        let token = |key: &str| match content.metadata.get(&format!("tokenizer.ggml.{key}_token_id")) {
            Some(Value::U32(id)) if (*id as usize) < shape.num_tokens => Some(*id),
            _ => None,
        };
        let vocabulary = Vocabulary::of(&tokenizer, shape.num_tokens, token("eos"));
        check_vocabulary(path, &vocabulary, &tokenizer, &shape)?;
        let begins = !matches!(content.metadata.get("tokenizer.ggml.add_bos_token"), Some(Value::Bool(false)));
        let first = token("bos").filter(|_| begins && shape.family.begins_with_token());
        let weights = Mutex::new(Weights::load(path, &mut file, content, &shape)?);
        file.rewind().map_err(failed)?;
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let model = ModelRef { name, sha256: sha256_hex(&mut file).map_err(failed)? };
        let max_tokens = shape.max_tokens.min(MAX_TOKENS);
        Ok(Self { weights, tokenizer, vocabulary, first, max_tokens, model })
    }

    /// Name and hash of the file, as shots store them.
    pub fn model_ref(&self) -> ModelRef {
        self.model.clone()
    }

    /// What a question's prompt is understood as. The same question gives the same answer.
    ///
    /// # Errors
    /// [`ReaderError::TooLong`] · [`ReaderError::NotFinite`] · [`ReaderError::Compute`]
    pub fn read(&self, question: &Question) -> Result<Interpretation, ReaderError> {
        let tokens = question_tokens(&self.tokenizer, question, self.first)?;
        let limit = self.max_tokens.saturating_sub(MAX_ANSWER_TOKENS);
        if tokens.len() > limit {
            return Err(ReaderError::TooLong { found: tokens.len(), limit });
        }
        let automaton = Automaton::new(&question.answers());
        // A thread that failed left nothing behind: every prompt starts afresh.
        let mut weights = self.weights.lock().unwrap_or_else(PoisonError::into_inner);
        let scores = weights.begin(&tokens)?;
        let mut next = |token| weights.push(&[token]);
        let answer = decode(&self.vocabulary, &automaton, MAX_ANSWER_TOKENS, scores, &mut next)?;
        Interpretation::of(&answer, question)
    }
}

/// Opens a regular file; opening a pipe would wait for a writer.
fn open(path: &Path) -> Result<File, FileError> {
    let failed = |source| FileError::Read { path: path.to_owned(), source };
    if !std::fs::metadata(path).map_err(failed)?.is_file() {
        return Err(FileError::NotAFile { path: path.to_owned(), found: "a folder, pipe or device" });
    }
    File::open(path).map_err(failed)
}

/// The tokenizer of a model: its own, or that of the file beside it.
fn tokenizer(path: &Path, content: &Content) -> Result<Tokenizer, ReaderError> {
    let kind = match content.metadata.get("tokenizer.ggml.model") {
        Some(Value::String(kind)) => kind.as_str(),
        _ => "missing",
    };
    let beside = cinesplat_files::beside(path, TOKENIZER_FILE);
    if kind == "gpt2" {
        let expected = "tokens and merges of a byte-level tokenizer";
        let strings = |key: &str| match content.metadata.get(key) {
            Some(Value::Array(values)) => {
                values.iter().filter_map(|value| value.to_string().ok()).map(String::as_str).collect()
            }
            _ => Vec::new(),
        };
        let merges = strings("tokenizer.ggml.merges").into_iter().map(|merge| merge.split_once(' '));
        check_merges(&strings("tokenizer.ggml.tokens").into_iter().collect(), merges)
            .map_err(|found| ReaderError::bad_model(path, "the tokenizer", &found, &expected))?;
        return Tokenizer::from_gguf(content)
            .map_err(|error| ReaderError::bad_model(path, "the tokenizer", &format!("damaged: {error}"), &expected));
    }
    if !beside.exists() {
        let expected = "gpt2, or a file tokenizer.json beside the model";
        return Err(ReaderError::bad_model(path, "tokenizer.ggml.model", &kind, &expected));
    }
    let bytes = cinesplat_files::read(&beside, Limits::DEFAULT.text_bytes)?;
    let bad = |found: &str| ReaderError::bad_model(&beside, "the tokenizer", &found, &"a tokenizer.json of this model");
    let json = checked_tokenizer(&bytes).map_err(|found| bad(&found))?;
    let mut tokenizer = Tokenizer::from_bytes(json).map_err(|error| bad(&format!("damaged: {error}")))?;
    // Texts are neither cut nor filled up, whatever the file says.
    tokenizer.with_truncation(None).map_err(|error| bad(&error.to_string()))?.with_padding(None);
    Ok(tokenizer)
}

/// The JSON of a tokenizer, where keys stand once. Refuses what the package `tokenizers` panics at: a text that is no JSON, and
/// the packed tables of characters of other families, where they are damaged.
fn checked_tokenizer(bytes: &[u8]) -> Result<String, String> {
    let json: serde_json::Value = serde_json::from_slice(bytes).map_err(|error| format!("damaged: {error}"))?;
    let normalizer = json.get("normalizer").map(serde_json::Value::to_string).unwrap_or_default();
    let has_table = ["\"Precompiled\"", "\"precompiled_charsmap\""].iter().any(|table| normalizer.contains(table));
    if has_table {
        return Err("with a packed table of characters".to_owned());
    }
    if json
        .pointer("/model/continuing_subword_prefix")
        .is_some_and(|prefix| !matches!(prefix.as_str(), None | Some("")))
    {
        return Err("with marks of inner tokens".to_owned());
    }
    let tokens = json.pointer("/model/vocab").and_then(serde_json::Value::as_object);
    let tokens = tokens.into_iter().flat_map(|tokens| tokens.keys().map(String::as_str)).collect();
    let merges = json.pointer("/model/merges").and_then(serde_json::Value::as_array).into_iter().flatten();
    check_merges(&tokens, merges.map(merged))?;
    Ok(json.to_string())
}

/// The two tokens of a merge, which is an array or, in older files, a text with a space.
fn merged(merge: &serde_json::Value) -> Option<(&str, &str)> {
    match merge.as_array().map(Vec::as_slice) {
        Some([left, right]) => left.as_str().zip(right.as_str()),
        _ => merge.as_str()?.split_once(' '),
    }
}

/// Refuses merges that make no token: the package `tokenizers` panics at those that are longer than all tokens.
fn check_merges<'a>(
    tokens: &HashSet<&str>,
    mut merges: impl Iterator<Item = Option<(&'a str, &'a str)>>,
) -> Result<(), String> {
    let makes_token = |(left, right): (&str, &str)| tokens.contains(format!("{left}{right}").as_str());
    match merges.position(|merge| !merge.is_some_and(makes_token)) {
        Some(idx) => Err(format!("with merge {idx}, which makes no token")),
        None => Ok(()),
    }
}

/// Checks that every answer can be written and that the network knows every token.
fn check_vocabulary(
    path: &Path,
    vocabulary: &Vocabulary,
    tokenizer: &Tokenizer,
    shape: &Shape,
) -> Result<(), ReaderError> {
    let num_tokens = tokenizer.get_vocab_size(true);
    if num_tokens > shape.num_tokens {
        let expected = format!("at most the {} of token_embd.weight", shape.num_tokens);
        return Err(ReaderError::bad_model(path, "the number of tokens", &num_tokens, &expected));
    }
    if let Some(byte) = vocabulary.missing_byte(b' '..=b'~') {
        let found = format!("without {:?}", char::from(byte));
        return Err(ReaderError::bad_model(path, "the vocabulary", &found, &"a token for every byte"));
    }
    if vocabulary.ends().is_empty() {
        return Err(ReaderError::bad_model(path, "the vocabulary", &"without an end", &"a token that ends an answer"));
    }
    Ok(())
}

/// SHA-256 of a file as 64 lower-case hexadecimal digits; the file may be larger than the memory.
fn sha256_hex(file: &mut File) -> io::Result<String> {
    let mut hasher = Sha256::new();
    let mut buffer = vec![0; 1 << 20];
    loop {
        let num_bytes = match file.read(&mut buffer) {
            Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
            read => read?,
        };
        if num_bytes == 0 {
            break;
        }
        hasher.update(buffer.get(..num_bytes).unwrap_or_default());
    }
    Ok(hasher.finalize().iter().fold(String::with_capacity(64), |hex, byte| hex + &format!("{byte:02x}")))
}
