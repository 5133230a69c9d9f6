use std::path::Path;

use super::console;
use super::failure::Failure;
use super::outputs::Overwrite;
use cinesplat::plot::drawing::Drawing;

/// Pixels of a PNG per px of the drawing.
const PNG_SCALE: f64 = 2.0;

/// What a drawing is written as.
#[derive(Clone, Copy)]
enum FigureFormat {
    Svg,
    Png,
    Pdf,
}

/// Checks before any work that the name of a figure determines its format.
pub(super) fn check_name(path: &Path) -> Result<(), Failure> {
    format_of(path).map(|_| ())
}

/// Checks before any work that a figure can be written.
pub(super) fn check(path: &Path, overwrite: Overwrite) -> Result<(), Failure> {
    format_of(path)?;
    overwrite.check(path)
}

/// Writes a drawing in the format that the name decides, and says what it shows.
pub(super) fn write(path: &Path, drawing: &Drawing, what: &str, overwrite: Overwrite) -> Result<(), Failure> {
    let bytes = match format_of(path)? {
        FigureFormat::Svg => drawing.to_svg().into_bytes(),
        FigureFormat::Png => drawing.to_png(PNG_SCALE)?,
        FigureFormat::Pdf => drawing.to_pdf(),
    };
    overwrite.write_once(path, &bytes)?;
    console::note(&format!("{}: {what}", path.display()));
    Ok(())
}

fn format_of(path: &Path) -> Result<FigureFormat, Failure> {
    let extension = path.extension().map(|extension| extension.to_string_lossy().to_lowercase());
    match extension.as_deref() {
        Some("svg") => Ok(FigureFormat::Svg),
        Some("png") => Ok(FigureFormat::Png),
        Some("pdf") => Ok(FigureFormat::Pdf),
        _ => {
            let found = format!(
                "{}: the name does not determine the format of the figure, expected .svg, .png or .pdf",
                path.display()
            );
            Err(Failure::usage(found, "name the figure something such as figure.svg"))
        }
    }
}
