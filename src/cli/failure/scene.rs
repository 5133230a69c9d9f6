use cinesplat::scene::SceneError;

use super::exit::Exit;
use super::message::{Failure, MORE_MEMORY};

impl From<SceneError> for Failure {
    fn from(error: SceneError) -> Self {
        use SceneError as E;
        let (code, message) = (error.code(), error.to_string());
        let (exit, help) = match error {
            E::NotFound { .. } => {
                (Exit::NoInput, "check the path; an unbundled SOG is named by its folder or its meta.json")
            }
            E::NotAFile { .. } => (Exit::NoInput, "save the data to a file first"),
            E::Permission { .. } => {
                (Exit::Permission, "change the permissions, or copy it to where you may read and write")
            }
            E::Io { .. } => (Exit::Io, "check the disk and the path, then try again"),
            E::TooManyBytes { .. } => {
                (Exit::OverCap, "raise the cap with --max-file-bytes, or thin the scene out in an editor")
            }
            E::TooManyGaussians { .. } => {
                (Exit::OverCap, "raise the cap with --max-gaussians, or thin the scene out in an editor")
            }
            E::OutOfMemory { .. } | E::NoMemory { .. } => (Exit::OverCap, MORE_MEMORY),
            E::UnknownFormat { .. } => {
                (Exit::BadData, "export the scene again as one of these; the content decides, not the extension")
            }
            E::NotReadYet { format, .. } if format.contains("SOG") => {
                (Exit::BadData, "name one of its level folders, such as 2_0")
            }
            E::NotReadYet { .. } => {
                (Exit::BadData, "convert it to .ply, .spz or .sog, with splat-transform or SuperSplat for instance")
            }
            E::PlyHeader { .. } => (
                Exit::BadData,
                "a scene needs x y z, scale_*, rot_*, opacity and f_dc_* (or red green blue); a plain point cloud has no Gaussians",
            ),
            E::PlyCount { .. } => (Exit::BadData, "the header is damaged or wrong: export the file again"),
            E::PlyTruncated { .. } | E::SpzCorrupt { .. } | E::Damaged { .. } => {
                (Exit::BadData, "the file is cut or damaged: download or export it again")
            }
            E::PlyValue { .. } => (Exit::BadData, "correct that value, or export the file again"),
            E::SplatSize { .. } => (Exit::BadData, "the file is cut, or is not a .splat: download or export it again"),
            E::SpzHeader { .. } => (
                Exit::BadData,
                "the file is damaged or newer than this program: export it again as SPZ version 2, 3 or 4",
            ),
            E::SpzBomb { .. } => (Exit::BadData, "do not trust this file; if it is yours, export it again as .ply"),
            E::SogMeta { .. } | E::SogPicture { .. } => {
                (Exit::BadData, "the SOG is damaged or incomplete: export it again with all its pictures")
            }
            E::Empty { .. } => (Exit::BadData, "nothing in this file can be drawn: export it again"),
            E::BadUp { .. } => (Exit::Usage, "give three numbers that are not all 0, such as 0,-1,0"),
        };
        Self::new(code, message, help, exit)
    }
}
