use std::path::PathBuf;

use super::failure::Failure;
use super::scene_args::SceneArgs;
use super::shot_args::{ShotArgs, deciding};
use super::{console, explain, outputs, reproduce};
use crate::export::shot_json;

/// Makes a sentence into keyframes, without rendering.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cinesplat plan room.spz -p \"push in on <obj-3>\" --objects objects.json -o shot.json
  cinesplat plan synth:demo -p \"push in on the sofa, then crane up\" -o shot.json --explain
shot.json may be edited by hand: move keys in time, add or remove some, then render --shot shot.json.")]
pub(super) struct Args {
    #[command(flatten)]
    scene: SceneArgs,
    /// What the camera does, in words; objects by name or as <obj-ID>
    #[arg(short, long, value_name = "PROMPT")]
    prompt: String,
    /// The shot
    #[arg(short, long, value_name = "SHOT.JSON", required_unless_present_any = ["json", "explain"])]
    output: Option<PathBuf>,
    #[command(flatten)]
    shot: ShotArgs,
    /// Prints the shot on stdout
    #[arg(long)]
    json: bool,
    /// Prints how every clause was understood and what it got
    #[arg(long)]
    explain: bool,
    /// Replaces a shot that is already there
    #[arg(long)]
    overwrite: bool,
}

impl Args {
    pub(super) fn run(self) -> Result<(), Failure> {
        if let Some(output) = &self.output {
            outputs::check_new(output, self.overwrite)?;
        }
        let (scene, objects) = self.scene.open_with_objects(self.shot.objects.as_deref())?;
        let mut directed = self.shot.direct(&scene, &objects, &self.prompt)?;
        if let Some(output) = &self.output {
            directed.shot.scene.path = outputs::relative_to(output, &scene.path);
            outputs::write(output, shot_json::write(&directed.shot).as_bytes())?;
            let (keys, secs) = (directed.shot.keyframes.len(), directed.shot.duration_secs);
            console::note(&format!("{}: {keys} keys, {secs:.2} s", output.display()));
        }
        if self.explain {
            let text = explain::explanation(&directed, &objects);
            if self.json { console::note(&text) } else { console::data(&text)? }
        }
        if self.json {
            console::data(&shot_json::write(&directed.shot))?;
        }
        reproduce::print(&deciding(&directed.shot));
        Ok(())
    }
}
