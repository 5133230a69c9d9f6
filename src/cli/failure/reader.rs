use cinesplat::reader::ReaderError;

use super::exit::Exit;
use super::message::Failure;

impl From<ReaderError> for Failure {
    fn from(error: ReaderError) -> Self {
        let (code, message) = (error.code(), error.to_string());
        let (exit, help) = match error {
            ReaderError::File(error) => return error.into(),
            ReaderError::NotBuilt { .. } => (
                Exit::Unavailable,
                "build with `cargo build --release --features reader`, or leave --reader out for the built-in director",
            ),
            ReaderError::BadModel { .. } => {
                (Exit::BadData, "give --reader a GGUF file of a Qwen2 or Llama model, or leave it out")
            }
            ReaderError::TooLong { .. } => {
                (Exit::BadData, "say it in fewer words, or give a model with a longer context")
            }
            ReaderError::NotFinite { .. } => {
                (Exit::BadData, "the weights of the model are damaged: get the file again, or leave --reader out")
            }
            ReaderError::Compute { .. } => (Exit::Fault, "try another model, or leave --reader out"),
        };
        Self::new(code, message, help, exit)
    }
}
