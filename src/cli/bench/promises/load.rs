use std::process::{Child, Command, Stdio};

use crate::cli::failure::Failure;

/// When another process takes a core.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum LoadTime {
    /// From before the forecast on.
    Throughout,
    /// From the first frame on: the forecast does not see it.
    FromFirstFrame,
}

impl LoadTime {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Throughout => "throughout",
            Self::FromFirstFrame => "from the first frame",
        }
    }
}

/// A process that takes a core until it is dropped.
pub(super) struct Load(Child);

impl Load {
    pub(super) fn start() -> Result<Self, Failure> {
        let mut command = Command::new("sh");
        command.args(["-c", "while :; do :; done"]).stdin(Stdio::null()).stdout(Stdio::null());
        command.spawn().map(Self).map_err(|error| Failure::io("sh", &error))
    }
}

impl Drop for Load {
    fn drop(&mut self) {
        // A process that has ended cannot be ended again.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}
