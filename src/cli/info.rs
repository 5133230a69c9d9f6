use std::fmt::Write as _;

use serde_json::{Value, json};

use super::console;
use super::failure::Failure;
use super::scene_args::SceneArgs;
use cinesplat::scene::SceneInfo;

/// Print what a scene file contains
///
/// Format, number of Gaussians, bounds, size, filter, up axis with its source, and dropped Gaussians with the reason.
#[derive(Debug, clap::Args)]
#[command(after_help = "Example:\n  cinesplat info room.spz --json | jq .num_gaussians")]
pub(super) struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    /// Print one JSON object instead of lines
    #[arg(long)]
    json: bool,
}

impl Args {
    pub(super) fn run(self) -> Result<(), Failure> {
        let scene = self.scene.open()?.scene;
        let info = scene.info();
        let file = scene.path.display().to_string();
        if self.json {
            console::data(&format!("{:#}\n", as_json(&file, &info)))
        } else {
            console::text(&as_text(&file, &info))
        }
    }
}

fn as_json(file: &str, info: &SceneInfo) -> Value {
    let bounds = &info.bounds;
    json!({
        "path": file,
        "format": info.format,
        "sha256": info.sha256,
        "num_gaussians": info.num_gaussians,
        "num_dropped": info.num_dropped,
        "sh_degree": info.sh_degree,
        "bounds": { "min": bounds.min.to_array(), "max": bounds.max.to_array() },
        "core": { "min": bounds.core_min.to_array(), "max": bounds.core_max.to_array() },
        "size": info.size,
        "filter": info.filter.as_ref(),
        "filter_is_stated": info.filter_is_stated,
        "up": info.up,
        "up_source": info.up_source.to_string(),
        "num_objects": info.num_objects,
        "notes": info.notes,
    })
}

fn as_text(file: &str, info: &SceneInfo) -> String {
    let vector = |v: [f64; 3]| format!("{:.4} {:.4} {:.4}", v[0], v[1], v[2]);
    let span =
        |low: glam::DVec3, high: glam::DVec3| format!("{} .. {}", vector(low.to_array()), vector(high.to_array()));
    let stated = if info.filter_is_stated { "stated in the file" } else { "not stated in the file" };
    let mut lines = vec![
        ("scene", file.to_owned()),
        ("format", info.format.clone()),
        ("gaussians", info.num_gaussians.to_string()),
        ("dropped", info.num_dropped.to_string()),
        ("sh degree", info.sh_degree.to_string()),
        ("bounds", span(info.bounds.min, info.bounds.max)),
        ("core", format!("{} (middle 96 % of the solid Gaussians)", span(info.bounds.core_min, info.bounds.core_max))),
        ("size", format!("{:.4} (diagonal of the core)", info.size)),
        ("filter", format!("{} ({stated})", info.filter)),
        ("up", format!("{} ({})", vector(info.up), info.up_source)),
    ];
    if info.num_objects > 0 {
        lines.push(("objects", format!("{}, from ids in the file", info.num_objects)));
    }
    if !info.sha256.is_empty() {
        lines.push(("sha256", info.sha256.clone()));
    }
    lines.extend(info.notes.iter().map(|note| ("note", note.clone())));
    lines.iter().fold(String::new(), |mut text, (key, value)| {
        let _ = writeln!(text, "{key:<10} {value}");
        text
    })
}
