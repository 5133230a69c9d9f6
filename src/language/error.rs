/// Error of a prompt, or of the embedded language data.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum LanguageError {
    /// The prompt asks for nothing that a camera could do.
    #[error("nothing in the prompt is something that a camera could do")]
    NothingToDo,
    /// A prompt that is too long.
    #[error("prompt of {found} bytes, expected at most {limit}")]
    TooLong {
        /// Length of the prompt in bytes.
        found: usize,
        /// Largest length in bytes.
        limit: usize,
    },
    /// A prompt without words.
    #[error("prompt without words, expected a sentence such as \"push in on <obj-3>\"")]
    Empty,
    /// A prompt that names an unknown object.
    #[error("the prompt names \"{name}\", which is no object of this scene, expected one of its objects")]
    UnknownObject {
        /// The name as it stands in the prompt.
        name: String,
        /// The nearest names of this scene, best first.
        nearest: Vec<String>,
    },
    /// A prompt that names more objects than the model has identifiers.
    #[error("the prompt names more than {limit} objects, expected at most {limit}")]
    TooManyObjects {
        /// Number of identifiers of the model.
        limit: usize,
    },
    /// Malformed embedded data: a fault of this program.
    #[error("{file} line {line}: {what}")]
    BadData {
        /// The file.
        file: &'static str,
        /// Line, from 1.
        line: usize,
        /// The defect.
        what: String,
    },
}

impl LanguageError {
    /// Stable code for people and scripts.
    pub fn code(&self) -> &'static str {
        match self {
            Self::NothingToDo => "PROMPT-NOTHING",
            Self::TooLong { .. } => "PROMPT-TOO-LONG",
            Self::Empty => "PROMPT-EMPTY",
            Self::UnknownObject { .. } => "OBJ-UNKNOWN",
            Self::TooManyObjects { .. } => "PROMPT-OBJECTS",
            Self::BadData { .. } => "LANGUAGE-DATA",
        }
    }
}
