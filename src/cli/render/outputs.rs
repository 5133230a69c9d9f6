//! Outputs of films: their names, checks before any work, and what an earlier run left.

use std::path::{Path, PathBuf};

use super::Args;
use crate::cli::failure::Failure;
use crate::cli::prompts_file::{self, NamedPrompt};
use crate::cli::{figures, outputs, takes};
use cinesplat::video::{self, VideoFormat};

impl Args {
    /// The arguments that render one of several takes. Their sheet is written apart.
    pub(super) fn for_take(&self, number: usize) -> Self {
        let output = |path: &PathBuf| takes::output_of(path, number);
        Self {
            output: output(&self.output),
            save_shot: self.save_shot.as_ref().map(output),
            map: self.map.as_ref().map(output),
            sheet: None,
            ..self.clone()
        }
    }

    /// The sheet of several takes: as given, or beside the output.
    pub(super) fn sheet_of_takes(&self) -> PathBuf {
        self.sheet.clone().unwrap_or_else(|| takes::sheet_beside(&self.output))
    }

    /// Whether the film is there, and no frames to go on from.
    pub(super) fn is_finished(&self) -> bool {
        let first = match VideoFormat::from_path(&self.output) {
            Ok(VideoFormat::Sequence(pattern)) => pattern.path(self.frames.start),
            _ => self.output.clone(),
        };
        !self.job.goes_on(&self.output) && first.exists()
    }

    /// The arguments that render one prompt of a file.
    pub(super) fn for_prompt(&self, named: &NamedPrompt) -> Result<Self, Failure> {
        let output = |path: &PathBuf| prompts_file::output_of(path, &named.name);
        Ok(Self {
            output: output(&self.output)?,
            save_shot: self.save_shot.as_ref().map(output).transpose()?,
            sheet: self.sheet.as_ref().map(output).transpose()?,
            map: self.map.as_ref().map(output).transpose()?,
            ..self.clone()
        })
    }

    /// Refuses wrong outputs before the scene is read.
    pub(super) fn check_outputs(&self) -> Result<(), Failure> {
        if !self.shot.takes.is_several() {
            return self.check_own_outputs();
        }
        if self.source.file.is_some() {
            return Err(Failure::usage(
                "--takes with --shot: a shot is one take",
                "leave --takes out, or give a prompt",
            ));
        }
        if !self.takes_go_on() {
            self.overwrite.check(&self.sheet_of_takes())?;
        }
        let missing = self.shot.takes.numbers().map(|number| self.for_take(number)).filter(|take| !self.has(take));
        missing.into_iter().try_for_each(|take| take.check_own_outputs())
    }

    /// Whether an earlier run left frames of one of the takes.
    pub(super) fn takes_go_on(&self) -> bool {
        self.shot.takes.numbers().any(|number| self.job.goes_on(&self.for_take(number).output))
    }

    /// Whether an earlier run, whose frames are there, finished this take.
    pub(super) fn has(&self, take: &Self) -> bool {
        self.takes_go_on() && take.is_finished()
    }

    /// Refuses wrong outputs of one film.
    fn check_own_outputs(&self) -> Result<(), Failure> {
        self.check_names()?;
        self.job.check(&self.output)
    }

    /// Refuses wrong names of the outputs of one film.
    pub(super) fn check_names(&self) -> Result<(), Failure> {
        let format = video::check_format(&self.output, &self.encoder())?;
        let goes_on = self.job.goes_on(&self.output);
        if !matches!(format, VideoFormat::Sequence(_)) || !(goes_on || self.job.part.is_some()) {
            video::check_output(&self.output, &self.encoder())?;
        }
        // A stopped film may have written them already; they are written again only if they differ.
        for path in self.save_shot.iter().chain(&self.sheet).filter(|_| !goes_on) {
            self.overwrite.check(path)?;
        }
        let check_map =
            |path: &Path| if goes_on { figures::check_name(path) } else { figures::check(path, self.overwrite) };
        self.map.as_deref().map_or(Ok(()), check_map)?;
        let shot = self.save_shot.as_deref().map(|path| ("--save-shot", path));
        let sheet = self.sheet.as_deref().map(|path| ("--sheet", path));
        let map = self.map.as_deref().map(|path| ("--map", path));
        outputs::check_distinct([("--output", self.output.as_path())].into_iter().chain(shot).chain(sheet).chain(map))
    }
}
