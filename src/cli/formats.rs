use std::path::Path;

use strum::{EnumMessage, VariantArray};

use super::console;
use cinesplat::export::{Doubt, Format};

/// The formats of camera paths with what each is, after `examples`.
pub(super) fn table_with(examples: &str) -> String {
    let row = |format: &Format| {
        let description = format.get_documentation().unwrap_or_default();
        format!("  {:<11} {}", format.as_ref(), description.trim_end_matches('.'))
    };
    let rows: Vec<String> = Format::VARIANTS.iter().map(row).collect();
    format!("{examples}\n\nFormats:\n{}", rows.join("\n"))
}

/// Says how a file was read whose content fits two formats, and the flag that settles it.
pub(super) fn note_doubt(path: &Path, doubt: Option<&Doubt>) {
    if let Some(Doubt { read_as, other, other_reading }) = doubt {
        console::note(&format!("note: {}: read as {read_as}; --from {other} reads {other_reading}", path.display()));
    }
}
