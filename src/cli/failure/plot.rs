use cinesplat::plot::PlotError;

use super::exit::Exit;
use super::message::Failure;

impl From<PlotError> for Failure {
    fn from(error: PlotError) -> Self {
        let (code, message) = (error.code(), error.to_string());
        match error {
            PlotError::Picture { .. } => {
                Self::new(code, message, "leave out the figure, or report the file that it fails on", Exit::Fault)
            }
        }
    }
}
