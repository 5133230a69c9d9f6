//! Headings under which the help groups flags.

pub(super) const SCENE: &str = "Scene";
pub(super) const SHOT: &str = "Shot";
pub(super) const PICTURE: &str = "Picture";
pub(super) const OUTPUT: &str = "Output";
