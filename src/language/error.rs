/// Why a prompt cannot be worked with, or why the embedded language data cannot be read.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum LanguageError {
    /// The prompt is longer than anybody's description of a shot.
    #[error("prompt of {found} bytes, expected at most {limit}")]
    TooLong {
        /// Bytes of the prompt.
        found: usize,
        /// Bytes allowed.
        limit: usize,
    },
    /// No word in it.
    #[error("prompt without words, expected a sentence such as \"push in on <obj-3>\"")]
    Empty,
    /// It names something that the scene does not have.
    #[error("the prompt names \"{name}\", which is no object of this scene, expected one of its objects")]
    UnknownObject {
        /// The name as it stands in the prompt.
        name: String,
        /// The nearest names of this scene, best first.
        nearest: Vec<String>,
    },
    /// It names more objects than the model has identifiers.
    #[error("the prompt names more than {limit} objects, expected at most {limit}")]
    TooManyObjects {
        /// Identifiers of the model.
        limit: usize,
    },
    /// Embedded grammar, lexicon or exam is malformed: a fault of the program.
    #[error("{file} line {line}: {what}")]
    BadData {
        /// Which file.
        file: &'static str,
        /// Line, from 1.
        line: usize,
        /// What is wrong there.
        what: String,
    },
}

impl LanguageError {
    /// Stable name of the fault for `error[CODE]`.
    pub fn code(&self) -> &'static str {
        match self {
            Self::TooLong { .. } => "PROMPT-TOO-LONG",
            Self::Empty => "PROMPT-EMPTY",
            Self::UnknownObject { .. } => "OBJ-UNKNOWN",
            Self::TooManyObjects { .. } => "PROMPT-OBJECTS",
            Self::BadData { .. } => "LANGUAGE-DATA",
        }
    }
}
