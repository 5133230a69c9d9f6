use cinesplat::render::RenderError;

use super::exit::Exit;
use super::message::{Failure, MORE_MEMORY};

impl From<RenderError> for Failure {
    fn from(error: RenderError) -> Self {
        use RenderError as E;
        let (code, message) = (error.code(), error.to_string());
        let (exit, help) = match error {
            E::Camera(_) => {
                (Exit::BadData, "give the camera a size, focal lengths above 0 and a finite pose".to_owned())
            }
            E::Setting { name, expected, .. } => (Exit::Usage, format!("set {name} to {expected}")),
            E::Fold { .. } => (
                Exit::BadData,
                "bring the k1, k2, k3, p1 and p2 of lens-distortion nearer to 0, or narrow the field of view"
                    .to_owned(),
            ),
            E::Length { what, expected, .. } => (Exit::BadData, format!("give {what} {expected} values, in order")),
            E::Memory { .. } => (Exit::OverCap, MORE_MEMORY.to_owned()),
            E::Cost { .. } => {
                (Exit::OverCap, "reduce the picture size, or move the camera out of the Gaussians".to_owned())
            }
        };
        Self::new(code, message, help, exit)
    }
}
