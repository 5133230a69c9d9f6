/// Who else may work on a job folder.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Access {
    /// Nobody.
    Alone,
    /// Other programs that render parts of the same film.
    Shared,
}
