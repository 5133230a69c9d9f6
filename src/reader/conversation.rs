//! A question as tokens, in the form of conversation that a model was trained on.

use tokenizers::Tokenizer;

use crate::error::ReaderError;
use crate::question::Question;

/// Forms of conversation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Form {
    /// `<|im_start|>ROLE\nTEXT<|im_end|>\n`
    ChatMl,
    /// `<|start_header_id|>ROLE<|end_header_id|>\n\nTEXT<|eot_id|>`
    Llama3,
    /// `TEXT\n`, for models that only continue a text.
    Plain,
}

/// A part of a conversation: a special token, or text. Text never becomes a special token, whatever it says.
enum Part<'a> {
    Special(&'a str),
    Text(String),
}

impl Form {
    /// The form whose tokens a vocabulary has.
    fn of(tokenizer: &Tokenizer) -> Self {
        let has = |names: &[&str]| names.iter().all(|name| tokenizer.token_to_id(name).is_some());
        if has(&["<|im_start|>", "<|im_end|>"]) {
            Self::ChatMl
        } else if has(&["<|start_header_id|>", "<|end_header_id|>", "<|eot_id|>"]) {
            Self::Llama3
        } else {
            Self::Plain
        }
    }

    /// The parts of what one speaker says.
    fn turn(self, role: &str, text: &str) -> Vec<Part<'static>> {
        match self {
            Self::ChatMl => vec![
                Part::Special("<|im_start|>"),
                Part::Text(format!("{role}\n{text}")),
                Part::Special("<|im_end|>"),
                Part::Text("\n".to_owned()),
            ],
            Self::Llama3 => vec![
                Part::Special("<|start_header_id|>"),
                Part::Text(role.to_owned()),
                Part::Special("<|end_header_id|>"),
                Part::Text(format!("\n\n{text}")),
                Part::Special("<|eot_id|>"),
            ],
            Self::Plain => {
                let before = if role == "assistant" { "Answer: " } else { "" };
                vec![Part::Text(format!("{before}{text}\n"))]
            }
        }
    }

    /// The parts before the model's own answer.
    fn opening(self) -> Vec<Part<'static>> {
        match self {
            Self::ChatMl => vec![Part::Special("<|im_start|>"), Part::Text("assistant\n".to_owned())],
            Self::Llama3 => vec![
                Part::Special("<|start_header_id|>"),
                Part::Text("assistant".to_owned()),
                Part::Special("<|end_header_id|>"),
                Part::Text("\n\n".to_owned()),
            ],
            Self::Plain => vec![Part::Text("Answer:".to_owned())],
        }
    }
}

/// The tokens of a conversation that ends where the answer to `question` begins: `ChatML` or Llama 3 where the vocabulary has
/// their special tokens, otherwise plain text. `first` is the token that begins every text, where the model has one.
///
/// # Errors
/// [`ReaderError::Compute`] when the tokenizer fails.
pub fn question_tokens(
    tokenizer: &Tokenizer,
    question: &Question,
    first: Option<u32>,
) -> Result<Vec<u32>, ReaderError> {
    let form = Form::of(tokenizer);
    let mut parts = form.turn("system", &Question::instructions());
    for (asked, answer) in Question::examples() {
        parts.extend(form.turn("user", &asked));
        parts.extend(form.turn("assistant", &answer));
    }
    parts.extend(form.turn("user", &question.text()));
    parts.extend(form.opening());
    let mut plain = tokenizer.clone();
    plain.set_encode_special_tokens(true);
    let mut tokens: Vec<u32> = first.into_iter().collect();
    for part in parts {
        match part {
            Part::Special(name) => tokens.extend(tokenizer.token_to_id(name)),
            Part::Text(text) => {
                let encoded = plain.encode(text, false).map_err(|error| ReaderError::compute(&error))?;
                tokens.extend(encoded.get_ids());
            }
        }
    }
    Ok(tokens)
}
