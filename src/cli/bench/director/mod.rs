mod captions;

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use cinesplat::director::{Director, ModelFiles};
use cinesplat::files::create_folder;
use cinesplat::plot::{Axis, COLORS, Chart, Marker, Series, grid};
use cinesplat::training::corpus::{self, SentenceKind, Split, Writer};
use cinesplat::training::{Examination, Mentions, Tally, examine};
use strum::VariantArray;

use super::calibration::{bins, calibration_error};
use crate::cli::console;
use crate::cli::failure::Failure;
use crate::cli::heading;
use crate::cli::outputs::Overwrite;

/// Quantile of the normal distribution of a 95 % interval.
const Z_95: f64 = 1.96;

/// Measure how well models understand the sentences of writers that they were not trained on
///
/// Per model, split and kind of sentence: the share of wholly right programs with its 95 % interval (Wilson), that of right
/// steps, the expected calibration error of their certainty, and the time per sentence on one core. Writes director.csv
/// and reliability.svg, and prints a table.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  cinesplat bench director -o bench
  cinesplat bench director --models built-in,models/small --split exam -o bench")]
pub(super) struct Args {
    /// Folders of models, separated by commas; `built-in` is the one in the program
    #[arg(long, value_name = "MODELS", value_delimiter = ',', default_value = "built-in")]
    models: Vec<PathBuf>,
    /// Folder of sentences with their programs
    #[arg(long, value_name = "DIR", default_value = "prompts/corpus")]
    sentences: PathBuf,
    /// Writers to measure on: training, development or exam
    #[arg(long, value_name = "SPLIT", default_values_t = [Split::Development, Split::Exam], value_delimiter = ',')]
    split: Vec<Split>,
    /// File of human captions with labels of motions (CameraBench): prints F1 per motion instead
    #[arg(long, value_name = "CAPTIONS.JSONL")]
    captions: Option<PathBuf>,
    /// Folder for director.csv and reliability.svg
    #[arg(short, long, value_name = "DIR", help_heading = heading::OUTPUT, required_unless_present = "captions")]
    output: Option<PathBuf>,
    #[command(flatten)]
    overwrite: Overwrite,
}

/// One row of the table.
struct Row {
    model: String,
    num_bytes: usize,
    split: Split,
    kind: &'static str,
    mentions: Mentions,
    examination: Examination,
}

impl Args {
    pub(super) fn run(self) -> Result<(), Failure> {
        if let Some(path) = &self.captions {
            for model in &self.models {
                console::data(&captions::table(&Director::from_all(&files_of(model)?)?, path)?)?;
            }
            return Ok(());
        }
        let output = self.output.clone().unwrap_or_default();
        if self.output.is_some() {
            create_folder(&output)?;
        }
        let (csv, plot) = (output.join("director.csv"), output.join("reliability.svg"));
        self.overwrite.check(&csv)?;
        self.overwrite.check(&plot)?;
        let writers = corpus::read_folder(&self.sentences)?;
        let mut rows = Vec::new();
        for model in &self.models {
            let files = files_of(model)?;
            let director = Director::from_all(&files)?;
            let num_bytes = files.iter().flat_map(ModelFiles::named).map(|(_, bytes)| bytes.len()).sum();
            for split in &self.split {
                let writers: Vec<&Writer> = writers.iter().filter(|writer| writer.split == *split).collect();
                rows.extend(rows_of(model, num_bytes, &director, *split, &writers)?);
            }
        }
        let mut table = String::from(HEADER);
        rows.iter().for_each(|row| table.push_str(&row.csv()));
        self.overwrite.write(&csv, table.as_bytes())?;
        self.overwrite.write(&plot, reliability(&rows).as_bytes())?;
        console::data(&table)
    }
}

fn files_of(model: &Path) -> Result<Vec<ModelFiles>, Failure> {
    let is_built_in = model.as_os_str() == "built-in";
    Ok(if is_built_in { ModelFiles::embedded_all().to_vec() } else { ModelFiles::read_all(model)? })
}

const HEADER: &str = "model,bytes,split,kind,mentions,sentences,programs_percent,low_percent,high_percent,steps_percent,\
                      calibration_error,readers_percent,median_ms,p95_ms\n";

/// The rows of one model and split: every kind of sentence, then all.
fn rows_of(
    model: &Path,
    num_bytes: usize,
    director: &Director,
    split: Split,
    writers: &[&Writer],
) -> Result<Vec<Row>, Failure> {
    let mut rows = Vec::new();
    let mut all = Mentions::VARIANTS.iter().map(|_| Examination::default()).collect::<Vec<_>>();
    let row = |kind, mentions, examination| {
        let model = model.display().to_string();
        Row { model, num_bytes, split, kind, mentions, examination }
    };
    for kind in SentenceKind::VARIANTS.iter().copied() {
        let name = match kind {
            SentenceKind::Single => "one clause",
            SentenceKind::Several => "several clauses",
            SentenceKind::Free => "free",
        };
        for (mentions, all) in Mentions::VARIANTS.iter().copied().zip(&mut all) {
            let examination = examine(director, writers, Some(kind), mentions)?;
            all.extend(examination.clone());
            rows.push(row(name, mentions, examination));
        }
    }
    rows.extend(Mentions::VARIANTS.iter().copied().zip(all).map(|(mentions, all)| row("all", mentions, all)));
    Ok(rows)
}

impl Row {
    fn csv(&self) -> String {
        let Examination { metrics, certainty, latencies_secs, readers } = &self.examination;
        let [low, high] = interval_95(metrics.programs);
        let mut sorted = latencies_secs.clone();
        sorted.sort_by(f64::total_cmp);
        let quantile = |share: f64| sorted.get((share * sorted.len() as f64) as usize).copied().unwrap_or(0.0) * 1e3;
        format!(
            "{},{},{},{},{},{},{:.1},{:.1},{:.1},{:.1},{:.3},{:.1},{:.1},{:.1}\n",
            self.model,
            self.num_bytes,
            self.split,
            self.kind,
            self.mentions,
            metrics.programs.total,
            100.0 * metrics.programs.correct_frac(),
            100.0 * low,
            100.0 * high,
            100.0 * metrics.steps.correct_frac(),
            calibration_error(certainty),
            100.0 * readers.correct_frac(),
            quantile(0.5),
            quantile(0.95)
        )
    }
}

/// The 95 % interval of a share (Wilson 1927).
fn interval_95(tally: Tally) -> [f64; 2] {
    let n = tally.total.max(1) as f64;
    let share = tally.correct_frac();
    let scale = 1.0 + Z_95 * Z_95 / n;
    let middle = (share + Z_95 * Z_95 / (2.0 * n)) / scale;
    let half = Z_95 * (share * (1.0 - share) / n + Z_95 * Z_95 / (4.0 * n * n)).sqrt() / scale;
    [middle - half, middle + half]
}

/// Share of right steps against their probability, one chart per model and split, for all sentences with found mentions.
fn reliability(rows: &[Row]) -> String {
    let charts: Vec<Chart> = rows
        .iter()
        .filter(|row| row.kind == "all" && row.mentions == Mentions::Found)
        .map(|row| {
            let mut title = String::new();
            // Writing to a string cannot fail.
            let _ = write!(title, "{}, {}", row.model, row.split);
            let mut chart = Chart::new(&title, Axis::linear("probability"), Axis::linear("share of right steps"));
            let found = bins(&row.examination.certainty);
            let points: Vec<(f64, f64)> = found.iter().map(|(mean, share, _)| (*mean, *share)).collect();
            let markers = (0..points.len()).map(|idx| Marker::dot(idx, 3.0)).collect();
            let diagonal = vec![(0.0, 0.0), (1.0, 1.0)];
            chart.series.push(Series { points: diagonal, color: COLORS[1], line_px: 1.0, markers: Vec::new() });
            chart.series.push(Series { points, color: COLORS[0], line_px: 1.5, markers });
            chart
        })
        .collect();
    grid("Certainty of steps and how often they are right", &[], &charts, 2, [360.0, 300.0])
}
