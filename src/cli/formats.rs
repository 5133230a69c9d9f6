use strum::{EnumMessage, VariantArray};

use cinesplat::export::Format;

/// The formats of camera paths with what each is, after `examples`.
pub(super) fn table_with(examples: &str) -> String {
    let row = |format: &Format| {
        let description = format.get_documentation().unwrap_or_default();
        format!("  {:<11} {}", format.as_ref(), description.trim_end_matches('.'))
    };
    let rows: Vec<String> = Format::VARIANTS.iter().map(row).collect();
    format!("{examples}\n\nFormats:\n{}", rows.join("\n"))
}
