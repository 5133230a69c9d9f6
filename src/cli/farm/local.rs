use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::thread;
use std::time::Duration;

use super::waiting::Ended;
use crate::cli::failure::{Exit, Failure};
use crate::cli::interrupt::Interrupt;
use crate::cli::progress::FrameProgress;
use crate::cli::{console, member, reproduce};
use cinesplat::pipeline;

/// Time between two looks at the programs.
const POLL: Duration = Duration::from_millis(50);
/// Times that a program that was killed is started again.
const MAX_RESTARTS: usize = 10;

/// Renders the frames of this line's film with `num_programs` programs on this machine.
pub(super) fn run(num_programs: usize, output: &Path, interrupt: &Interrupt) -> Result<Ended, Failure> {
    let words = reproduce::words_of_part("farm", Some(num_programs));
    let words_of = |number: usize| [words.as_slice(), &[format!("--part={number}/{num_programs}")]].concat();
    let mut programs: Vec<Program> =
        (1..=num_programs).map(|number| Program::start(words_of(number))).collect::<Result<_, _>>()?;
    let mut bar = FrameProgress::new();
    let ended = watch(&mut programs, output, interrupt, &mut bar);
    bar.finish();
    ended
}

/// Waits for the programs; starts those again that were killed.
fn watch(
    programs: &mut [Program],
    output: &Path,
    interrupt: &Interrupt,
    bar: &mut FrameProgress,
) -> Result<Ended, Failure> {
    let (mut is_asked, mut is_stopped) = (false, false);
    while programs.iter().any(|program| program.child.is_some()) {
        if interrupt.is_asked() && !is_asked {
            is_asked = true;
            programs.iter().for_each(Program::ask_to_stop);
        }
        for program in &mut *programs {
            is_stopped |= program.poll(is_asked)?;
        }
        if let Some((done, total)) = pipeline::job_progress(output) {
            bar.show(done, total);
        }
        thread::sleep(POLL);
    }
    Ok(if is_stopped || is_asked { Ended::Stopped } else { Ended::Done })
}

/// A program that renders a part.
struct Program {
    words: Vec<String>,
    child: Option<Child>,
    num_restarts: usize,
}

impl Program {
    fn start(words: Vec<String>) -> Result<Self, Failure> {
        Ok(Self { child: Some(spawn(&words)?), words, num_restarts: 0 })
    }

    /// Looks whether the program has ended. Returns whether it was stopped.
    fn poll(&mut self, is_asked: bool) -> Result<bool, Failure> {
        let failed = |error: std::io::Error| Failure::fault(&error.to_string());
        let Some(child) = &mut self.child else { return Ok(false) };
        let Some(status) = child.try_wait().map_err(failed)? else { return Ok(false) };
        self.child = None;
        if was_killed(status) && !is_asked && self.num_restarts < MAX_RESTARTS {
            self.num_restarts += 1;
            console::warnings([format!("a program ended with {status}: it is started again")]);
            self.child = Some(spawn(&self.words)?);
        }
        Ok(status.code() == Some(i32::from(Exit::Stopped as u8)))
    }

    /// Passes a stop on. Ctrl-C on a terminal reaches the program without this; it counts once.
    fn ask_to_stop(&self) {
        #[cfg(unix)]
        if let Some(child) = &self.child {
            use nix::sys::signal::{Signal, kill};
            let id = nix::unistd::Pid::from_raw(child.id().cast_signed());
            // A program that has ended needs no signal.
            let _ = kill(id, Signal::SIGTERM);
        }
    }
}

impl Drop for Program {
    fn drop(&mut self) {
        self.ask_to_stop();
    }
}

fn was_killed(status: ExitStatus) -> bool {
    status.code().is_none()
}

fn spawn(words: &[String]) -> Result<Child, Failure> {
    let failed = |error: std::io::Error| Failure::fault(&format!("a program cannot be started: {error}"));
    let mut command = Command::new(std::env::current_exe().map_err(failed)?);
    // Of their own group: Ctrl-C reaches them once, through this program.
    #[cfg(unix)]
    std::os::unix::process::CommandExt::process_group(&mut command, 0);
    member::mark(&mut command);
    command.args(words).stdin(Stdio::null()).stdout(Stdio::null()).spawn().map_err(failed)
}
