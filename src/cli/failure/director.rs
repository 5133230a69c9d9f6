use cinesplat::director::DirectorError;

use super::exit::Exit;
use super::message::Failure;

impl From<DirectorError> for Failure {
    fn from(error: DirectorError) -> Self {
        let (code, message) = (error.code(), error.to_string());
        let (exit, help) = match error {
            DirectorError::Language(error) => return error.into(),
            DirectorError::EmptyPrompt => {
                (Exit::BadData, "say what the camera should do, such as \"push in on <obj-1>\"")
            }
            DirectorError::PromptTooLong { .. } => {
                (Exit::BadData, "say it in fewer words, or split it into several shots")
            }
            DirectorError::BadScene { .. } => {
                (Exit::BadData, "give the up direction with --up, or check the scene with `cinesplat info`")
            }
            DirectorError::Read { source, .. } => {
                (Exit::of_read(&source), "check the path given with --model, or leave it out for the built-in weights")
            }
            DirectorError::BadModel { .. }
            | DirectorError::IdBeyondVocabulary { .. }
            | DirectorError::NotFinite { .. } => (
                Exit::BadData,
                "leave --model out for the built-in weights, or train them again with `cinesplat train`",
            ),
            DirectorError::Compute(_) => {
                (Exit::Fault, "this is a fault of cinesplat: please report it with the prompt")
            }
        };
        Self::new(code, message, help, exit)
    }
}
