//! `bench critic`: what the critic measures on the films of a file of cases, what each of its terms changes, and what more
//! finalists and more moments buy.

mod ablation;
mod curve;
mod film_row;
mod sheet;

use std::path::PathBuf;

use super::cases::{CaseArgs, CaseDirector, PromptCase};
use crate::cli::console;
use crate::cli::failure::Failure;
use crate::cli::heading;
use crate::cli::outputs::{self, Overwrite};
use crate::cli::shot_args::SolveArgs;
use cinesplat::critic::CriticSettings;
use cinesplat::pipeline::{Critique, DirectSettings, FilmChoice, Phase};
use film_row::FilmRow;

/// Files that the folder gets beside the contact sheets.
const FILES: [&str; 4] = ["films.csv", "films.md", "ablation.csv", "curve.csv"];

/// Measure the pictures of films: void, blocked, lost, sharpness and all marks
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example:
  cinesplat bench critic --cases public.jsonl -o critic --sheets
Prints one CSV line per film. DIR gets films.csv, films.md (summary and table), ablation.csv (what changes where a term is
switched off) and, with --curve, curve.csv (score and time against finalists and moments).")]
pub(super) struct Args {
    #[command(flatten)]
    cases: CaseArgs,
    #[command(flatten)]
    solve: SolveArgs,
    /// Films to finish and look at per prompt [default: that of the effort]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u8).range(1..=32))]
    finalists: Option<u8>,
    /// Pictures per film
    #[arg(long, value_name = "N", default_value_t = 16, value_parser = clap::value_parser!(u16).range(2..=1000))]
    moments: u16,
    /// Frame size of the films
    #[arg(long, value_name = "WxH", default_value = "1280x720", value_parser = crate::cli::shot_args::parse_size)]
    size: (u32, u32),
    /// Write a contact sheet per film, ID.png
    #[arg(long)]
    sheets: bool,
    /// Measure score and time against the number of finalists and of moments
    #[arg(long)]
    curve: bool,
    /// Folder for the results, created where it is missing
    #[arg(short, long, value_name = "DIR", help_heading = heading::OUTPUT)]
    output: PathBuf,
    #[command(flatten)]
    overwrite: Overwrite,
}

impl Args {
    pub(super) fn run(self) -> Result<(), Failure> {
        let (cases, mut director) = self.cases.open()?;
        outputs::create_folder(&self.output)?;
        FILES.iter().try_for_each(|name| self.overwrite.check(&self.output.join(name)))?;
        let sheet_of = |id: &str| self.output.join(format!("{id}.png"));
        if self.sheets {
            cases.iter().try_for_each(|case| self.overwrite.check(&sheet_of(&case.id)))?;
        }
        console::data(&film_row::csv_header())?;
        let (mut rows, mut curve) = (Vec::new(), curve::Curve::default());
        for case in &cases {
            match self.bench_case(case, &mut director, &mut curve) {
                Ok(row) => rows.push(row),
                // A prompt that cannot be planned does not stop the others.
                Err(failure) => console::error(&failure),
            }
        }
        self.write_results(&rows, &curve)
    }

    /// Plans and measures one case; prints its line.
    fn bench_case(
        &self,
        case: &PromptCase,
        director: &mut CaseDirector,
        curve: &mut curve::Curve,
    ) -> Result<FilmRow, Failure> {
        let directed = director.direct_with(case, &self.settings(None))?;
        let Some(critique) = directed.critique else {
            return Err(Failure::usage("--solve off: nobody looks at the film", "choose --solve fast or full"));
        };
        if self.curve {
            curve.add(&critique);
            for &num in &curve::FINALISTS {
                curve.add_times(num, &director.direct_with(case, &self.settings(Some(num)))?.times);
            }
        }
        if self.sheets {
            let path = self.output.join(format!("{}.png", case.id));
            sheet::write(&director.scene_of(case)?.scene, &directed.shot, &path, self.overwrite.existing())?;
        }
        let time =
            |phase| directed.times.iter().find(|(known, _)| *known == phase).map_or(0.0, |(_, t)| t.as_secs_f64());
        let row = FilmRow::new(&case.id, &directed.shot, critique, [time(Phase::Solve), time(Phase::Judge)]);
        console::data(&row.csv_line())?;
        Ok(row)
    }

    /// Writes the files of the folder, and prints the summary.
    fn write_results(&self, rows: &[FilmRow], curve: &curve::Curve) -> Result<(), Failure> {
        self.write("films.csv", &film_row::to_csv(rows))?;
        let critiques: Vec<&Critique> = rows.iter().map(|row| &row.critique).collect();
        let ablation = ablation::ablation(&critiques);
        let summary = film_row::summary(rows);
        console::note(&summary);
        let text = format!("{summary}\n{}\n{}", ablation::to_table(&ablation), film_row::to_table(rows));
        self.write("films.md", &text)?;
        self.write("ablation.csv", &ablation::to_csv(&ablation))?;
        if self.curve {
            let text = curve.to_csv();
            console::note(&text);
            self.write("curve.csv", &text)?;
        }
        Ok(())
    }

    fn settings(&self, finalists: Option<usize>) -> DirectSettings {
        // The curve takes its scores from one run with the most finalists.
        let most = if self.curve { Some(curve::MOST_FINALISTS) } else { self.finalists.map(usize::from) };
        let moments = if self.curve && finalists.is_none() { curve::MOST_MOMENTS } else { usize::from(self.moments) };
        // The curve compares all films at all moments.
        let of = CriticSettings::default();
        let num_first_moments = if self.curve && finalists.is_none() { moments } else { of.num_first_moments };
        let critic = CriticSettings { num_moments: moments, num_first_moments, ..of };
        let choice = FilmChoice { num_finalists: finalists.or(most), critic, ..FilmChoice::default() };
        DirectSettings {
            width: self.size.0,
            height: self.size.1,
            solve: self.solve.level,
            choice,
            ..DirectSettings::default()
        }
    }

    fn write(&self, name: &str, text: &str) -> Result<(), Failure> {
        self.overwrite.write(&self.output.join(name), text.as_bytes())
    }
}
