/// How a frame holds a view per eye. Each view is squeezed into half of the frame, as players expect of such films.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EyeLayout {
    /// The left eye's view on the left.
    SideBySide,
    /// The left eye's view above.
    OverUnder,
}
