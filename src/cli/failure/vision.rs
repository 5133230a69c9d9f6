use cinesplat::vision::VisionError;

use super::exit::Exit;
use super::message::Failure;

impl From<VisionError> for Failure {
    fn from(error: VisionError) -> Self {
        let (code, message) = (error.code(), error.to_string());
        let (exit, help) = match error {
            VisionError::File(error) => return error.into(),
            VisionError::NotBuilt { .. } => {
                (Exit::Unavailable, "build with `cargo build --release --features vision`, or leave --dino out")
            }
            VisionError::BadModel { .. } => {
                (Exit::BadData, "give --dino a folder with a Dinov2Model of `transformers`, or leave it out")
            }
            VisionError::BadPicture { .. } => (Exit::Fault, "leave --dino out"),
            VisionError::Compute { .. } => (Exit::BadData, "try another model, or leave --dino out"),
        };
        Self::new(code, message, help, exit)
    }
}
