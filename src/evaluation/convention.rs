/// Whose choices decide where this program and evo differ: one pose matched twice, times without a pose nearby,
/// rotations about nearly straight paths, a span of time of the reference alone.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Convention {
    /// Those of this program.
    #[default]
    Cinesplat,
    /// Those of evo 1.38.1.
    Evo,
}
