//! Outputs of films: their names, checks before any work, and what an earlier run left.

use std::path::{Path, PathBuf};

use super::Args;
use crate::cli::failure::Failure;
use crate::cli::prompts_file::{self, NamedPrompt};
use crate::cli::{figures, outputs, takes};
use cinesplat::files;
use cinesplat::pipeline;
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

    /// Removes what a program left of a job folder that was killed while it removed that folder.
    pub(super) fn remove_leftovers(&self) -> Result<(), Failure> {
        if self.job.part.is_some() {
            return Ok(());
        }
        if !self.shot.takes.is_several() {
            return Ok(pipeline::remove_leftover(&self.output)?);
        }
        let outputs = self.shot.takes.numbers().map(|number| takes::output_of(&self.output, number));
        Ok(outputs.into_iter().try_for_each(|output| pipeline::remove_leftover(&output))?)
    }

    /// Makes the folder of the pictures of a sequence: other outputs may go there before the first picture.
    pub(super) fn make_picture_folder(&self) -> Result<(), Failure> {
        Ok(self.picture_folder().as_deref().map_or(Ok(()), files::create_folder)?)
    }

    /// The folder of the pictures of a sequence.
    fn picture_folder(&self) -> Option<PathBuf> {
        match VideoFormat::from_path(&self.output) {
            Ok(VideoFormat::Sequence(pattern)) => {
                Some(pattern.folder().to_owned()).filter(|folder| !folder.as_os_str().is_empty())
            }
            _ => None,
        }
    }

    /// Whether a path lies in the folder that is made for the pictures, so that nothing is in its way.
    fn is_in_new_folder(&self, path: &Path) -> bool {
        let folder = self.picture_folder().filter(|folder| !folder.exists());
        folder
            .is_some_and(|folder| std::path::absolute(files::folder_of(path)).ok() == std::path::absolute(folder).ok())
    }

    /// Refuses wrong outputs before the scene is read.
    pub(super) fn check_outputs(&self) -> Result<(), Failure> {
        self.remove_leftovers()?;
        if !self.shot.takes.is_several() {
            return self.check_own_outputs();
        }
        if self.source.file.is_some() {
            return Err(Failure::usage(
                "--takes with --shot: a shot is one take",
                "leave --takes out, or give a prompt",
            ));
        }
        let sheet = self.sheet_of_takes();
        if !self.takes_go_on() && !self.is_in_new_folder(&sheet) {
            self.overwrite.check(&sheet)?;
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
        let is_free = |path: &Path| goes_on || self.is_in_new_folder(path);
        for path in self.save_shot.iter().chain(&self.sheet).filter(|path| !is_free(path)) {
            self.overwrite.check(path)?;
        }
        let check_map =
            |path: &Path| if is_free(path) { figures::check_name(path) } else { figures::check(path, self.overwrite) };
        self.map.as_deref().map_or(Ok(()), check_map)?;
        let named = [
            ("--output", Some(&self.output)),
            ("--save-shot", self.save_shot.as_ref()),
            ("--sheet", self.sheet.as_ref()),
            ("--map", self.map.as_ref()),
        ];
        let named = || named.into_iter().filter_map(|(flag, path)| Some((flag, path?.as_path())));
        outputs::check_distinct(named())?;
        let inputs = [
            ("the scene", Some(self.scene.scene.as_path())),
            ("the shot", self.source.file.as_deref()),
            ("the prompts", self.source.prompts.as_deref()),
            ("the objects", self.shot.objects.as_deref()),
        ];
        outputs::check_not_inputs(named(), inputs)
    }
}
