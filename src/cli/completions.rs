use std::path::PathBuf;

use clap_complete::Shell;

use super::failure::Failure;
use super::outputs::{self, Overwrite};
use super::{console, heading};

/// Print a completion script for a shell.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cinesplat completions bash > ~/.local/share/bash-completion/completions/cinesplat
  cinesplat completions zsh > ~/.zfunc/_cinesplat")]
pub(super) struct CompletionsArgs {
    /// Shell that reads the script
    #[arg(value_name = "SHELL")]
    shell: Shell,
}

impl CompletionsArgs {
    pub(super) fn run(self, program: &mut clap::Command) -> Result<(), Failure> {
        let mut script = Vec::new();
        clap_complete::generate(self.shell, program, "cinesplat", &mut script);
        console::data_bytes(&script)
    }
}

/// Print the manual page, or write one page per command.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cinesplat man | man -l -
  cinesplat man -o ~/.local/share/man/man1")]
pub(super) struct ManArgs {
    /// Folder for one page per command [default: one page on stdout]
    ///
    /// The pages are cinesplat.1, cinesplat-render.1 and so on. The folder is created where it is missing.
    #[arg(short, long, value_name = "DIR", help_heading = heading::OUTPUT)]
    output: Option<PathBuf>,
    #[command(flatten)]
    overwrite: Overwrite,
}

impl ManArgs {
    pub(super) fn run(self, mut program: clap::Command) -> Result<(), Failure> {
        program.build();
        let Some(folder) = &self.output else { return console::data_bytes(&page(&program)?) };
        let pages: Vec<(PathBuf, Vec<u8>)> = commands(&program)
            .map(|command| Ok((folder.join(file_name(command)), page(command)?)))
            .collect::<Result<_, Failure>>()?;
        outputs::create_folder(folder)?;
        pages.iter().try_for_each(|(path, _)| self.overwrite.check(path))?;
        pages.iter().try_for_each(|(path, page)| self.overwrite.write(path, page))?;
        console::note(&format!("{}: {} pages", folder.display(), pages.len()));
        Ok(())
    }
}

/// The program and its commands, without the built-in `help`.
fn commands(program: &clap::Command) -> impl Iterator<Item = &clap::Command> {
    std::iter::once(program).chain(program.get_subcommands().filter(|command| command.get_name() != "help"))
}

fn file_name(command: &clap::Command) -> String {
    format!("{}.1", command.get_display_name().unwrap_or_else(|| command.get_name()))
}

fn page(command: &clap::Command) -> Result<Vec<u8>, Failure> {
    let mut page = Vec::new();
    let rendered = clap_mangen::Man::new(command.clone()).render(&mut page);
    rendered.map_err(|error| Failure::fault(&format!("manual page: {error}")))?;
    Ok(page)
}
