use cinesplat::export::ExportError;
use cinesplat::trajectory::TrajectoryError;

use super::exit::Exit;
use super::message::Failure;

impl From<ExportError> for Failure {
    fn from(error: ExportError) -> Self {
        use ExportError as E;
        let (code, message) = (error.code(), error.to_string());
        let (exit, help) = match error {
            E::File(error) => return error.into(),
            E::TooLarge { .. } => (Exit::OverCap, "is this the camera file, and not the scene?".to_owned()),
            E::NotJson { .. } => (Exit::BadData, "check the file with a JSON validator; it may be cut off".to_owned()),
            E::WrongFormat { .. } => (Exit::BadData, "name the format with --from or --to".to_owned()),
            E::WrongVersion { .. } => (Exit::BadData, "write the file with a version listed above".to_owned()),
            E::BadField { place, expected, .. } if expected.contains("<obj-") => {
                let names = "the label of an object or its <obj-N> (`cinesplat objects SCENE` lists them)";
                (Exit::BadData, format!("set {place} to {names}, or to a point [x, y, z]"))
            }
            E::BadField { place, expected, .. } => (Exit::BadData, format!("set {place} to {expected}")),
            E::BadLine { line, .. } => (Exit::BadData, format!("correct or remove line {line}")),
            E::BadBytes { .. } => (Exit::BadData, "the file may be cut off: copy it again".to_owned()),
            E::InFile { name, error } => return Self::from(*error).in_file(name.as_ref()),
            E::BadShot(TrajectoryError::TooManyKeyframes { .. }) => {
                (Exit::BadData, "leave out keys: the path between them is smooth".to_owned())
            }
            E::BadShot(TrajectoryError::TooManyFrames { .. }) => {
                (Exit::OverCap, "make it shorter, or lower --fps".to_owned())
            }
            E::BadShot(_) => (Exit::BadData, "correct the value named above in the file".to_owned()),
            E::NoPoses => (Exit::BadData, "export the camera path again from the program that wrote it".to_owned()),
            E::NotWritable { .. } => (Exit::Usage, "name another format with --to".to_owned()),
            E::NotReadable { .. } => (Exit::BadData, "export the path as nerfstudio, gltf or tum instead".to_owned()),
        };
        Self::new(code, message, help, exit)
    }
}
