use cinesplat::objects::ObjectsError;

use super::exit::Exit;
use super::message::Failure;

impl From<ObjectsError> for Failure {
    fn from(error: ObjectsError) -> Self {
        use ObjectsError as E;
        let (code, message) = (error.code(), error.to_string());
        let (exit, help) = match error {
            E::File(error) => return error.into(),
            E::NotJson { .. } | E::WrongKind { .. } => {
                (Exit::BadData, "`cinesplat objects SCENE -o objects.json` writes a file to start from".to_owned())
            }
            E::BadField { .. } => {
                let help = "an object needs `id` (1..65535) and `center` with `half_extents`, or Gaussians in `labels`";
                (Exit::BadData, help.to_owned())
            }
            E::DuplicateId { id, .. } => (Exit::BadData, format!("give one of the two another id than {id}")),
            E::BadLabels { .. } => {
                let help =
                    "labels are a little-endian .npy of u8, u16 or u32: one id per Gaussian, in the scene's order";
                (Exit::BadData, help.to_owned())
            }
            E::BadClouds { .. } => {
                (Exit::BadData, "clear `clouds` in the objects file: they are computed anew".to_owned())
            }
            E::BadMask { .. } => {
                let help = "write ids as gray values of 8 or 16 bits: colors of a palette are not ids";
                (Exit::BadData, help.to_owned())
            }
            E::Lift { .. } => {
                let help =
                    "give each mask one id per pixel of its camera, and masks of fewer pixels if memory is short";
                (Exit::BadData, help.to_owned())
            }
            E::Picture { .. } => (Exit::Fault, "leave out --sheet, or report the scene that it fails on".to_owned()),
        };
        Self::new(code, message, help, exit)
    }
}
