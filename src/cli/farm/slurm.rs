use std::num::NonZeroU16;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use super::array_job::{Job, Tasks};
use super::waiting::{Ended, pause};
use super::words;
use crate::cli::console;
use crate::cli::failure::{Exit, Failure};
use crate::cli::interrupt::Interrupt;
use crate::cli::progress::FrameProgress;
use crate::cli::{heading, reproduce};
use cinesplat::files::{self, Existing};
use cinesplat::pipeline;

/// Time between two questions to Slurm: clusters ask not to be asked more often than every few seconds.
const POLL: Duration = Duration::from_secs(2);
/// Longest time that Slurm may not answer.
const PATIENCE: Duration = Duration::from_mins(10);

/// How a cluster renders.
#[derive(Debug, clap::Args)]
pub(super) struct ClusterArgs {
    /// With --slurm: number of tasks
    #[arg(long, value_name = "N", help_heading = heading::OUTPUT, hide_short_help = true, default_value = "4", conflicts_with = "local")]
    parts: NonZeroU16,
    /// With --slurm: further words for sbatch, such as "--partition=long --time=2:00:00"
    ///
    /// They are taken apart as in a shell: --sbatch '--comment="two words" --time=2:00:00'. A --dependency is what the tasks
    /// wait for, and may make their inputs. The job of --no-wait waits for the tasks too.
    ///
    /// A task has the threads that --cpus-per-task says, 1 without it. A node that fails, and preemption where the cluster
    /// says so, put a task back into the queue.
    #[arg(long, value_name = "WORDS", help_heading = heading::OUTPUT, hide_short_help = true, default_value = "", hide_default_value = true, allow_hyphen_values = true, conflicts_with = "local")]
    sbatch: String,
    /// With --slurm: do not wait; a further job makes the film after the tasks
    #[arg(long, help_heading = heading::OUTPUT, hide_short_help = true, conflicts_with = "local")]
    no_wait: bool,
}

impl ClusterArgs {
    /// Whether the tasks wait for other jobs, which may make their inputs.
    pub(super) fn waits_for_jobs(&self) -> Result<bool, Failure> {
        Ok(!words::take_dependencies(&mut words::split(&self.sbatch)?).is_empty())
    }
}

/// A film that an array job renders.
pub(super) struct Farm<'a> {
    output: &'a Path,
    /// Scripts and logs.
    folder: PathBuf,
    num_parts: usize,
    /// Further words for `sbatch`.
    further: Vec<String>,
    /// Whether the job folder was made for this job.
    is_new: bool,
    is_left_alone: bool,
}

impl<'a> Farm<'a> {
    pub(super) fn new(args: &ClusterArgs, output: &'a Path) -> Result<Self, Failure> {
        let is_new = !pipeline::job_folder(output).exists();
        Ok(Self {
            output,
            is_new,
            folder: pipeline::tasks_folder(output)?,
            num_parts: usize::from(args.parts.get()),
            further: words::split(&args.sbatch)?,
            is_left_alone: args.no_wait,
        })
    }

    /// Submits the tasks, and again those that failed, until all frames are there.
    pub(super) fn run(&self, interrupt: &Interrupt) -> Result<Ended, Failure> {
        let part = r#"--part="$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT" "#;
        let script = self.write_script("part.sh", &reproduce::words_of_part("farm", None), part)?;
        let mut num_tasks = self.num_parts;
        while self.num_missing() != Some(0) {
            let before = self.num_done();
            let job = self.submit(num_tasks, &script).inspect_err(|_| self.remove_new_folder())?;
            console::note(&format!("job {}: {num_tasks} tasks; logs are in {}", job.id(), self.folder.display()));
            if self.is_left_alone {
                self.submit_film(&job)?;
                return Ok(Ended::LeftAlone);
            }
            if self.watch(&job, interrupt)? == Ended::Stopped {
                return Ok(Ended::Stopped);
            }
            match self.num_missing() {
                Some(0) => {}
                Some(missing) if self.num_done() > before => {
                    console::warnings([format!("{missing} frames are missing: they are submitted again")]);
                    num_tasks = missing.min(self.num_parts);
                }
                _ => return Err(self.no_progress(&job)),
            }
        }
        Ok(Ended::Done)
    }

    /// Leaves nothing of a job that Slurm did not take.
    fn remove_new_folder(&self) {
        if self.is_new && pipeline::job_progress(self.output).is_none() {
            pipeline::remove_tasks_folder(self.output);
        }
    }

    fn submit(&self, num_tasks: usize, script: &Path) -> Result<Job, Failure> {
        let mut words = vec![format!("--array=1-{num_tasks}"), "--requeue".to_owned(), "--open-mode=append".to_owned()];
        words.push(self.log_word("%A-%a.log"));
        Job::submit(&words_of(words, &self.further, script))
    }

    /// Submits the job that makes the film when the tasks have ended. It renders the frames that they left.
    fn submit_film(&self, tasks: &Job) -> Result<(), Failure> {
        let script = self.write_script("film.sh", &reproduce::words_of_film("farm"), "")?;
        let mut further = self.further.clone();
        let stated = words::take_dependencies(&mut further).pop();
        // A list with question marks takes no further member. What it names has ended when the tasks have.
        let stated = stated.filter(|stated| !stated.contains('?')).map(|stated| format!(",{stated}"));
        let after = format!("--dependency=afterany:{}{}", tasks.id(), stated.unwrap_or_default());
        let own = vec![after, self.log_word("film-%j.log")];
        let job = Job::submit(&words_of(own, &further, &script))?;
        console::note(&format!("job {}: makes {} after them", job.id(), self.output.display()));
        Ok(())
    }

    /// Where a job writes what its programs say, also where --sbatch names another folder to work in. The output's own percent
    /// signs are no placeholders of Slurm.
    fn log_word(&self, name: &str) -> String {
        let folder = std::path::absolute(&self.folder).unwrap_or_else(|_| self.folder.clone());
        format!("--output={}/{name}", folder.to_string_lossy().replace('%', "%%"))
    }

    fn write_script(&self, name: &str, words: &[String], part: &str) -> Result<PathBuf, Failure> {
        let program = std::env::current_exe().map_err(|error| Failure::fault(&error.to_string()))?;
        let words: Vec<String> = [&[program.to_string_lossy().into_owned()], words]
            .concat()
            .iter()
            .map(|word| reproduce::quoted(word))
            .collect();
        let threads = if words.iter().any(|word| word.starts_with("--threads")) {
            ""
        } else {
            r#"--threads "${SLURM_CPUS_PER_TASK:-1}""#
        };
        let text = format!("#!/bin/sh\n# Written by `cinesplat farm`.\nexec {} {part}{threads}\n", words.join(" "));
        let path = self.folder.join(name);
        files::write(&path, text.as_bytes(), Existing::Replace)?;
        Ok(path)
    }

    /// Waits until the tasks have ended, or all frames are there.
    fn watch(&self, job: &Job, interrupt: &Interrupt) -> Result<Ended, Failure> {
        let (mut bar, mut last, mut answered) = (FrameProgress::new(), Tasks::Ended, Instant::now());
        let ended = loop {
            if !pause(POLL, interrupt) {
                job.cancel()?;
                break Ended::Stopped;
            }
            let tasks = job.tasks()?;
            if let Some((done, total)) = pipeline::job_progress(self.output) {
                bar.show(done, total);
            }
            match &tasks {
                Tasks::Ended => break Ended::Done,
                // What is left has nothing to do, or will never start.
                _ if self.num_missing() == Some(0) || tasks.never_start().is_some() => {
                    if let Some(reason) = tasks.never_start() {
                        console::warnings([format!("Slurm never starts the tasks that are left: {reason}")]);
                    }
                    job.cancel()?;
                    break Ended::Done;
                }
                Tasks::Unknown(reason) if answered.elapsed() > PATIENCE => return Err(self.no_answer(reason)),
                Tasks::Unknown(_) => {}
                Tasks::Left { states, .. } => {
                    answered = Instant::now();
                    if tasks != last {
                        let states: Vec<_> = states.iter().map(|(name, num)| format!("{num} {name}")).collect();
                        console::note(&format!("tasks: {}", states.join(", ").to_lowercase()));
                        if tasks.num_held() > 0 {
                            console::note(&format!("held tasks run after `scontrol release {}`", job.id()));
                        }
                    }
                }
            }
            last = tasks;
        };
        bar.finish();
        Ok(ended)
    }

    fn num_done(&self) -> usize {
        pipeline::job_progress(self.output).map_or(0, |(done, _)| done)
    }

    /// Number of frames that are missing; `None` before the first task has begun.
    fn num_missing(&self) -> Option<usize> {
        pipeline::job_progress(self.output).map(|(done, total)| total - done)
    }

    fn no_progress(&self, job: &Job) -> Failure {
        let said = self.said_by(job).unwrap_or_else(|| "they said nothing".to_owned());
        let found = format!("{}: the tasks of job {} finished no frame: {said}", self.output.display(), job.id());
        let help =
            format!("mend that and type the same line again; all that they said is in {}", self.folder.display());
        Failure::new("FARM-FAILED", found, help, Exit::Unavailable)
    }

    fn no_answer(&self, reason: &str) -> Failure {
        let found = format!("{}: Slurm does not answer: {reason}", self.output.display());
        Failure::new(
            "SLURM-SILENT",
            found,
            "type the same line when it does: finished frames are kept",
            Exit::Unavailable,
        )
    }

    /// The first line of a task's log that tells of an error, or its last one.
    fn said_by(&self, job: &Job) -> Option<String> {
        let mut logs: Vec<PathBuf> =
            std::fs::read_dir(&self.folder).ok()?.flatten().map(|entry| entry.path()).collect();
        logs.sort();
        let is_own = |path: &&PathBuf| {
            path.file_name().is_some_and(|name| name.to_string_lossy().starts_with(&format!("{}-", job.id())))
        };
        let texts = logs.iter().filter(is_own).filter_map(|path| std::fs::read_to_string(path).ok());
        let text = texts.collect::<Vec<_>>().join("\n");
        let error = text.lines().find(|line| line.contains("error"));
        error.or_else(|| text.lines().rfind(|line| !line.is_empty())).map(console::one_line)
    }
}

/// The words for `sbatch`: those of the farm, those of the user, the script.
fn words_of(own: Vec<String>, further: &[String], script: &Path) -> Vec<String> {
    let script = script.to_string_lossy().into_owned();
    [vec!["--job-name=cinesplat".to_owned()], own, further.to_vec(), vec![script]].concat()
}
