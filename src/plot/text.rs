/// A text with the characters escaped that SVG reserves.
pub(super) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// Approximate width of a text in the fonts of a figure, px.
pub(super) fn text_width(text: &str, font_px: f64) -> f64 {
    0.6 * font_px * text.chars().count() as f64
}
