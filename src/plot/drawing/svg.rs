use std::fmt::Write as _;

use cinesplat_files::base64;
use glam::DVec2;

use super::simplify::simplified;
use super::{Anchor, Drawing, Ink, Mark, Stroke, TextStyle, text_width_px};

impl Drawing {
    /// The drawing as SVG text. Pictures are embedded.
    pub fn to_svg(&self) -> String {
        let DVec2 { x: width, y: height } = self.size_px;
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width:.0}\" height=\"{height:.0}\" \
             viewBox=\"0 0 {width:.0} {height:.0}\" font-family=\"DejaVu Sans, Verdana, Helvetica, Arial, sans-serif\" \
             stroke-linecap=\"round\" stroke-linejoin=\"round\">\n<title>{}</title>\n\
             <rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n",
            escaped(&self.title)
        );
        for mark in &self.marks {
            svg.push_str(&element(mark));
            svg.push('\n');
        }
        svg.push_str("</svg>\n");
        svg
    }
}

fn element(mark: &Mark) -> String {
    match mark {
        Mark::Area { outline_px, fill, border } => {
            format!("<polygon points=\"{}\" {}/>", points(outline_px), paint(*fill, *border))
        }
        Mark::Circle { center_px, radius_px, fill, border } => {
            let DVec2 { x, y } = *center_px;
            format!("<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{radius_px:.2}\" {}/>", paint(*fill, *border))
        }
        Mark::Line { points_px, stroke } => {
            format!("<polyline points=\"{}\" {}/>", points(&simplified(points_px)), paint(None, Some(*stroke)))
        }
        Mark::Text { at_px, style, halo_px, text } => text_element(*at_px, style, *halo_px, text),
        Mark::Picture { corner_px, size_px, picture } => format!(
            "<image x=\"{:.2}\" y=\"{:.2}\" width=\"{:.2}\" height=\"{:.2}\" preserveAspectRatio=\"none\" \
             href=\"data:image/png;base64,{}\"/>",
            corner_px.x,
            corner_px.y,
            size_px.x,
            size_px.y,
            base64::encode(&picture.png)
        ),
    }
}

/// The width is stated, so that labels keep clear of each other in any font.
fn text_element(at_px: DVec2, style: &TextStyle, halo_px: f64, text: &str) -> String {
    let anchor = match style.anchor {
        Anchor::Start => "start",
        Anchor::Middle => "middle",
        Anchor::End => "end",
    };
    let weight = if style.is_bold { " font-weight=\"bold\"" } else { "" };
    let halo = if halo_px > 0.0 {
        format!(" stroke=\"#ffffff\" stroke-width=\"{:.1}\" paint-order=\"stroke\"", 2.0 * halo_px)
    } else {
        String::new()
    };
    format!(
        "<text x=\"{:.2}\" y=\"{:.2}\" font-size=\"{}\" text-anchor=\"{anchor}\" textLength=\"{:.1}\" \
         lengthAdjust=\"spacingAndGlyphs\" fill=\"{}\"{weight}{halo}>{}</text>",
        at_px.x,
        at_px.y,
        style.size_px,
        text_width_px(text, style.size_px),
        color(style.ink),
        escaped(text)
    )
}

fn points(points_px: &[DVec2]) -> String {
    let mut list = String::new();
    for point in points_px {
        // Writing to a string cannot fail.
        let _ = write!(list, "{:.2},{:.2} ", point.x, point.y);
    }
    list.trim_end().to_owned()
}

fn paint(fill: Option<Ink>, border: Option<Stroke>) -> String {
    let mut attributes = match fill {
        Some(ink) if ink.opacity < 1.0 => format!("fill=\"{}\" fill-opacity=\"{:.2}\"", color(ink), ink.opacity),
        Some(ink) => format!("fill=\"{}\"", color(ink)),
        None => "fill=\"none\"".to_owned(),
    };
    if let Some(Stroke { ink, width_px, dash_px }) = border {
        let _ = write!(attributes, " stroke=\"{}\" stroke-width=\"{width_px}\"", color(ink));
        if ink.opacity < 1.0 {
            let _ = write!(attributes, " stroke-opacity=\"{:.2}\"", ink.opacity);
        }
        if let Some([dash, gap]) = dash_px {
            let _ = write!(attributes, " stroke-dasharray=\"{dash} {gap}\"");
        }
    }
    attributes
}

fn color(ink: Ink) -> String {
    let [red, green, blue] = ink.rgb;
    format!("#{red:02x}{green:02x}{blue:02x}")
}

/// A text with the characters escaped that XML reserves, without those that it forbids.
fn escaped(text: &str) -> String {
    let allowed: String = text.chars().filter(|letter| !letter.is_control()).collect();
    allowed.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
