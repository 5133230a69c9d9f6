use std::collections::BTreeSet;
use std::fmt::Write as _;

use glam::DVec2;

use super::{Anchor, Drawing, Ink, Mark, Picture, Stroke, TextStyle, text_width_px};

/// Distance of the control points of a quarter circle from its ends, over the radius.
const CIRCLE_HANDLE: f64 = 0.552_284_75;
/// Widths of the letters of Helvetica from the space on, thousandths of the font size.
#[rustfmt::skip]
const HELVETICA: [u16; 95] = [
    278, 278, 355, 556, 556, 889, 667, 191, 333, 333, 389, 584, 278, 333, 278, 278, 556, 556, 556, 556, 556, 556, 556,
    556, 556, 556, 278, 278, 584, 584, 584, 556, 1015, 667, 667, 722, 722, 667, 611, 778, 722, 278, 500, 667, 556, 833,
    722, 778, 667, 778, 722, 667, 611, 722, 667, 944, 667, 667, 611, 278, 278, 278, 469, 556, 333, 556, 556, 500, 556,
    556, 278, 556, 556, 222, 222, 500, 222, 833, 556, 556, 556, 556, 333, 500, 278, 556, 500, 722, 500, 500, 500, 334,
    260, 334, 584,
];
/// Width of a bold text over that of a plain one, about.
const BOLD_FACTOR: f64 = 1.07;
/// Width of every other letter.
const OTHER_WIDTH: u16 = 556;

impl Drawing {
    /// The drawing as the bytes of a PDF of one page, a point per px. Text is in Helvetica, which every reader has.
    pub fn to_pdf(&self) -> Vec<u8> {
        let pictures: Vec<&Picture> = self.marks.iter().filter_map(picture_of).collect();
        let opacities: BTreeSet<u32> = self.marks.iter().flat_map(opacities_of).collect();
        let state = |percent: &u32| {
            let share = f64::from(*percent) / 100.0;
            format!("/G{percent} <</ca {share} /CA {share}>>")
        };
        let states = opacities.iter().map(state).collect::<Vec<_>>().join(" ");
        let image = |idx: usize| format!("/I{idx} {} 0 R", 7 + idx);
        let images = (0..pictures.len()).map(image).collect::<Vec<_>>().join(" ");
        let DVec2 { x: width, y: height } = self.size_px;
        let mut file = File::default();
        file.object("<</Type /Catalog /Pages 2 0 R>>");
        file.object("<</Type /Pages /Kids [3 0 R] /Count 1>>");
        file.object(&format!(
            "<</Type /Page /Parent 2 0 R /MediaBox [0 0 {width:.2} {height:.2}] /Contents 4 0 R /Resources \
             <</Font <</F1 5 0 R /F2 6 0 R>> /ExtGState <<{states}>> /XObject <<{images}>>>>>>"
        ));
        file.stream("", self.content().as_bytes());
        for name in ["Helvetica", "Helvetica-Bold"] {
            file.object(&format!("<</Type /Font /Subtype /Type1 /BaseFont /{name} /Encoding /WinAnsiEncoding>>"));
        }
        for picture in pictures {
            let [width, height] = picture.size;
            let kind = "/Type /XObject /Subtype /Image /ColorSpace /DeviceRGB /BitsPerComponent 8";
            file.stream(&format!("{kind} /Width {width} /Height {height} "), &picture.rgb8);
        }
        file.finish()
    }

    /// The operators of the page. The first turns y downward.
    fn content(&self) -> String {
        let mut out = format!("1 0 0 -1 0 {:.2} cm 1 J 1 j\n", self.size_px.y);
        let mut num_pictures = 0;
        for mark in &self.marks {
            match mark {
                Mark::Area { outline_px, fill, border } => {
                    paint(&mut out, &format!("{}h ", path(outline_px)), *fill, *border);
                }
                Mark::Circle { center_px, radius_px, fill, border } => {
                    paint(&mut out, &circle(*center_px, *radius_px), *fill, *border);
                }
                Mark::Line { points_px, stroke } => paint(&mut out, &path(points_px), None, Some(*stroke)),
                Mark::Text { at_px, style, halo_px, text } => write_text(&mut out, *at_px, style, *halo_px, text),
                Mark::Picture { corner_px, size_px, .. } => {
                    let DVec2 { x, y } = *corner_px + DVec2::new(0.0, size_px.y);
                    // Writing to a string cannot fail, here and below.
                    let _ = writeln!(
                        out,
                        "q {:.2} 0 0 {:.2} {x:.2} {y:.2} cm /I{num_pictures} Do Q",
                        size_px.x, -size_px.y
                    );
                    num_pictures += 1;
                }
            }
        }
        out
    }
}

fn picture_of(mark: &Mark) -> Option<&Picture> {
    if let Mark::Picture { picture, .. } = mark { Some(picture) } else { None }
}

fn percent(ink: Ink) -> u32 {
    (ink.opacity.clamp(0.0, 1.0) * 100.0).round() as u32
}

fn opacities_of(mark: &Mark) -> Vec<u32> {
    match mark {
        Mark::Area { fill, border, .. } | Mark::Circle { fill, border, .. } => {
            fill.iter().copied().chain(border.map(|stroke| stroke.ink)).map(percent).collect()
        }
        Mark::Line { stroke, .. } => vec![percent(stroke.ink)],
        Mark::Text { style, .. } => vec![percent(style.ink), 100],
        Mark::Picture { .. } => Vec::new(),
    }
}

fn path(points: &[DVec2]) -> String {
    let step =
        |(idx, point): (usize, &DVec2)| format!("{:.2} {:.2} {} ", point.x, point.y, if idx == 0 { 'm' } else { 'l' });
    points.iter().enumerate().map(step).collect()
}

fn circle(center: DVec2, radius: f64) -> String {
    let at = |x: f64, y: f64| center + DVec2::new(x, y) * radius;
    let start = at(1.0, 0.0);
    let mut out = format!("{:.2} {:.2} m ", start.x, start.y);
    for quarter in 0..4 {
        let turn = DVec2::from_angle(f64::from(quarter) * std::f64::consts::FRAC_PI_2);
        let [a, b, c] = [DVec2::new(1.0, CIRCLE_HANDLE), DVec2::new(CIRCLE_HANDLE, 1.0), DVec2::new(0.0, 1.0)]
            .map(|point| center + turn.rotate(point) * radius);
        let _ = write!(out, "{:.2} {:.2} {:.2} {:.2} {:.2} {:.2} c ", a.x, a.y, b.x, b.y, c.x, c.y);
    }
    out + "h "
}

/// Color operands of an ink.
fn color(ink: Ink) -> String {
    let [red, green, blue] = ink.rgb.map(|level| f64::from(level) / 255.0);
    format!("{red:.3} {green:.3} {blue:.3}")
}

fn paint(out: &mut String, path: &str, fill: Option<Ink>, border: Option<Stroke>) {
    if let Some(ink) = fill {
        let _ = writeln!(out, "/G{} gs {} rg {path}f*", percent(ink), color(ink));
    }
    if let Some(Stroke { ink, width_px, dash_px }) = border {
        let dash = dash_px.map_or("[] 0 d".to_owned(), |[dash, gap]| format!("[{dash} {gap}] 0 d"));
        let _ = writeln!(out, "/G{} gs {} RG {width_px} w {dash} {path}S", percent(ink), color(ink));
    }
}

/// The text is stretched to the width that it has in every output.
fn write_text(out: &mut String, at_px: DVec2, style: &TextStyle, halo_px: f64, text: &str) {
    let width_px = text_width_px(text, style.size_px);
    let code = |letter: char| match letter {
        ' '..='~' | '\u{a0}'..='\u{ff}' => letter as u8,
        '\u{2013}' => 150,
        _ => b'?',
    };
    let codes: Vec<u8> = text.chars().filter(|letter| !letter.is_control()).map(code).collect();
    let width =
        |code: &u8| code.checked_sub(32).and_then(|idx| HELVETICA.get(usize::from(idx))).unwrap_or(&OTHER_WIDTH);
    let weight = if style.is_bold { BOLD_FACTOR } else { 1.0 };
    let own_px = weight * codes.iter().map(|code| f64::from(*width(code))).sum::<f64>() * style.size_px / 1000.0;
    let stretch = if own_px > 0.0 { 100.0 * width_px / own_px } else { 100.0 };
    let back = match style.anchor {
        Anchor::Start => 0.0,
        Anchor::Middle => 0.5,
        Anchor::End => 1.0,
    };
    let (font, x, y) = (if style.is_bold { "F2" } else { "F1" }, at_px.x - back * width_px, at_px.y);
    let hex = codes.iter().map(|code| format!("{code:02x}")).collect::<Vec<_>>().concat();
    let shown = format!("/{font} {} Tf {stretch:.2} Tz 1 0 0 -1 {x:.2} {y:.2} Tm", style.size_px);
    if halo_px > 0.0 {
        let _ = writeln!(out, "/G100 gs BT 1 Tr 1 1 1 RG {} w [] 0 d {shown} <{hex}> Tj ET", 2.0 * halo_px);
    }
    let _ = writeln!(out, "/G{} gs BT 0 Tr {} rg {shown} <{hex}> Tj ET", percent(style.ink), color(style.ink));
}

/// A PDF file under construction: its bytes and where each object starts.
#[derive(Default)]
struct File {
    bytes: Vec<u8>,
    starts: Vec<usize>,
}

impl File {
    fn start(&mut self) {
        if self.bytes.is_empty() {
            self.bytes.extend(b"%PDF-1.4\n");
        }
        self.starts.push(self.bytes.len());
        let number = self.starts.len();
        self.bytes.extend(format!("{number} 0 obj\n").bytes());
    }

    fn object(&mut self, text: &str) {
        self.start();
        self.bytes.extend(format!("{text}\nendobj\n").bytes());
    }

    fn stream(&mut self, entries: &str, content: &[u8]) {
        self.start();
        self.bytes.extend(format!("<<{entries}/Length {}>>\nstream\n", content.len()).bytes());
        self.bytes.extend(content);
        self.bytes.extend(b"\nendstream\nendobj\n");
    }

    fn finish(mut self) -> Vec<u8> {
        let table = self.bytes.len();
        let size = self.starts.len() + 1;
        let mut tail = format!("xref\n0 {size}\n0000000000 65535 f \n");
        for start in &self.starts {
            let _ = writeln!(tail, "{start:010} 00000 n ");
        }
        let _ = write!(tail, "trailer\n<</Size {size} /Root 1 0 R>>\nstartxref\n{table}\n%%EOF\n");
        self.bytes.extend(tail.bytes());
        self.bytes
    }
}
