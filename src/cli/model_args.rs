use std::path::PathBuf;

use clap::Args;

use super::failure::Failure;
use super::heading;
use cinesplat::director::Director;
use cinesplat::pipeline::Interpreter;
use cinesplat::reader::Reader;

/// Which models read prompts.
#[derive(Debug, Clone, Args)]
pub(super) struct ModelArgs {
    /// Folder with the director's weights [default: the built-in weights]
    ///
    /// Folders of models in it are further networks: all read a prompt, and the reading that agrees best with all counts.
    #[arg(long, value_name = "DIR", help_heading = heading::SHOT, hide_short_help = true)]
    model: Option<PathBuf>,
    /// Language model that reads the words in the director's place [default: none]
    ///
    /// A GGUF file of the family Qwen2 or Llama. It runs on the CPU and answers only in the notation of programs. Its
    /// certainty is its own, not calibrated.
    #[arg(long, value_name = "MODEL.GGUF", help_heading = heading::SHOT, hide_short_help = true)]
    reader: Option<PathBuf>,
}

impl ModelArgs {
    /// Loads the models.
    pub(super) fn interpreter(&self) -> Result<Interpreter, Failure> {
        let reader = self.reader.as_deref().map(Reader::load).transpose()?;
        let director = match &self.model {
            Some(folder) => Director::load(folder)?,
            None => Director::embedded()?,
        };
        Ok(Interpreter { director, reader })
    }
}
