use std::path::{Path, PathBuf};

use super::failure::Failure;
use super::outputs::{self, Overwrite};
use super::takes::{self, TakesArgs};
use super::{figures, prompts_file};

/// Files that a plan writes for one prompt.
#[derive(Debug, Clone)]
pub(super) struct PlanOutputs {
    pub(super) shot: Option<PathBuf>,
    pub(super) map: Option<PathBuf>,
    /// The sheet of the takes, where it is named.
    pub(super) named_sheet: Option<PathBuf>,
    pub(super) takes: TakesArgs,
}

impl PlanOutputs {
    /// The outputs of one prompt of a file.
    pub(super) fn for_prompt(&self, name: &str) -> Result<Self, Failure> {
        let named =
            |path: &Option<PathBuf>| path.as_deref().map(|path| prompts_file::output_of(path, name)).transpose();
        Ok(Self {
            shot: named(&self.shot)?,
            map: named(&self.map)?,
            named_sheet: named(&self.named_sheet)?,
            takes: self.takes,
        })
    }

    /// The sheet of the takes: as named, or beside the shots where there are several.
    pub(super) fn sheet(&self) -> Option<PathBuf> {
        let several = self.shot.as_ref().filter(|path| self.takes.is_several() && !outputs::is_stdout(path));
        self.named_sheet.clone().or_else(|| several.map(|path| takes::sheet_beside(path)))
    }

    /// The shot and the map of a take.
    pub(super) fn of_take(&self, number: usize) -> [Option<PathBuf>; 2] {
        let of = |path: &PathBuf| if self.takes.is_several() { takes::output_of(path, number) } else { path.clone() };
        [self.shot.as_ref().map(of), self.map.as_ref().map(of)]
    }

    /// Refuses wrong outputs before the scene is read.
    pub(super) fn check(&self, overwrite: Overwrite) -> Result<(), Failure> {
        if self.takes.is_several() && self.shot.as_deref().is_some_and(outputs::is_stdout) {
            return Err(Failure::usage("--takes with -o -: several shots and one stdout", "name a file: -o shot.json"));
        }
        let sheet = self.sheet();
        sheet.iter().try_for_each(|sheet| overwrite.check(sheet))?;
        for number in self.takes.numbers() {
            let [shot, map] = self.of_take(number);
            shot.iter().try_for_each(|path| overwrite.check(path))?;
            map.iter().try_for_each(|path| figures::check(path, overwrite))?;
        }
        let named: [(&str, Option<&Path>); 3] =
            [("--output", self.shot.as_deref()), ("--map", self.map.as_deref()), ("--sheet", sheet.as_deref())];
        outputs::check_distinct(named.into_iter().filter_map(|(flag, path)| Some((flag, path?))))
    }
}
