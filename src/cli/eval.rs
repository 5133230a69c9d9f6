use super::outputs::Overwrite;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use glam::DVec3;

use super::choice::choice;
use super::failure::{Exit, Failure};
use super::{console, eval_folders, eval_paths, figures, heading, outputs};
use cinesplat::evaluation::{
    Align, BatchRow, Convention, Delta, DeltaUnit, EvalSettings, Evaluation, Matching, Metric, MotionFilter,
    PairSettings, Reduction, Relation, Role, SubjectSphere, Trajectory, compared_figure, error_figure, evaluate,
    motion_text, result_latex, result_markdown, summary_csv, summary_json, summary_text,
};
use cinesplat::export::Format;

/// Compare camera paths: absolute and relative pose error
///
/// Reads every format that `import` reads. Prints statistics of the error over matched poses.
#[derive(Debug, clap::Args)]
#[expect(clippy::struct_excessive_bools, reason = "flags of a command")]
#[command(after_help = "\
Examples:
  cinesplat eval groundtruth.txt estimate.txt --align se3
  cinesplat eval plan.shot.json flown.tum --rpe --delta 1 --unit m --relation angle_deg --json
  cinesplat eval groundtruth.txt orb.txt dso.txt --align sim3 --plot-errors errors.pdf --table latex
  cinesplat eval planned/ flown/ --align se3 --csv > all.csv
Paths are aligned only with --align. A shot.json is sampled at the frames of its film. Of two folders, files with the
same name up to the first dot are compared.")]
pub(super) struct Args {
    /// Reference path, or a folder of paths
    #[arg(value_name = "REF")]
    reference: PathBuf,
    /// Paths to compare with it, or a folder of paths
    #[arg(value_name = "EST", required = true)]
    estimates: Vec<PathBuf>,
    /// Format of all files [default: by their contents]
    #[arg(long, value_name = "FORMAT", hide_possible_values = true, value_parser = choice::<Format>())]
    from: Option<Format>,
    /// How the estimate is aligned to the reference first
    #[arg(long, value_name = "MODE", default_value = "none", value_parser = choice::<Align>())]
    align: Align,
    /// Which part of the error is measured
    #[arg(long, value_name = "RELATION", default_value = "trans", value_parser = choice::<Relation>())]
    relation: Relation,
    /// Measure the relative error: of the motion between two poses [default: absolute]
    #[arg(long)]
    rpe: bool,
    /// Distance between the two poses of a relative error
    #[arg(long, value_name = "N", default_value_t = 1.0, requires = "rpe")]
    delta: f64,
    /// Unit of --delta: frames, scene units (m), degrees or radians
    #[arg(long, value_name = "UNIT", default_value = "f", value_parser = choice::<DeltaUnit>(), requires = "rpe")]
    unit: DeltaUnit,
    /// Use all pairs of poses, including overlapping ones
    #[arg(long, hide_short_help = true, requires = "rpe")]
    all_pairs: bool,
    /// Measure --delta along the reference instead of the estimate
    #[arg(long, hide_short_help = true, requires = "rpe")]
    pairs_from_reference: bool,
    /// Choose as evo where this program chooses otherwise
    ///
    /// A pose may be matched with two others, interpolation keeps only times with a pose nearby, positions alone
    /// determine the alignment of nearly straight paths, and --start and --end trim the reference alone.
    #[arg(long)]
    like_evo: bool,
    /// Number of first poses used for the alignment [default: all]
    #[arg(long, value_name = "N", hide_short_help = true)]
    align_poses: Option<usize>,
    /// Interpolate the path with more poses at the times of the other [default: match nearest poses]
    #[arg(long)]
    interpolate: bool,
    /// First time to use, on the clock of the files
    #[arg(long, value_name = "SECS", hide_short_help = true, allow_hyphen_values = true)]
    start: Option<f64>,
    /// Last time to use
    #[arg(long, value_name = "SECS", hide_short_help = true, allow_hyphen_values = true)]
    end: Option<f64>,
    /// Use at most N poses of each file, evenly chosen
    #[arg(long, value_name = "N", hide_short_help = true, value_parser = clap::value_parser!(u32).range(1..))]
    downsample: Option<u32>,
    /// Use only poses this far, or turned this much, from the one before
    #[arg(long, value_name = "DIST,DEG", hide_short_help = true, value_parser = parse_motion_filter)]
    motion_filter: Option<MotionFilter>,
    /// Compare all estimates as one path, in order of their times
    #[arg(long, hide_short_help = true)]
    merge: bool,
    /// Seconds added to the estimate's times
    #[arg(long, value_name = "SECS", default_value_t = 0.0, allow_hyphen_values = true)]
    time_offset: f64,
    /// Diameter for relative errors, scene units [default: the reference's]
    #[arg(long, value_name = "D", hide_short_help = true)]
    diameter: Option<f64>,
    /// Compare the framing of a sphere: center and radius, scene units
    #[arg(long, value_name = "X,Y,Z,R", value_parser = parse_subject, allow_hyphen_values = true)]
    subject: Option<SubjectSphere>,
    /// Also describe the motion of the paths: moves, smoothness, motion tags, tables of poses
    #[arg(long)]
    motion: bool,
    /// Largest time difference of matched poses in seconds
    #[arg(long, value_name = "SECS", default_value_t = EvalSettings::default().max_diff_secs)]
    max_diff: f64,
    /// Print one JSON object instead of lines
    #[arg(long, help_heading = heading::OUTPUT)]
    json: bool,
    /// Print a CSV table instead of lines
    #[arg(long, help_heading = heading::OUTPUT, conflicts_with = "json")]
    csv: bool,
    /// Print a table for a text instead of lines
    #[arg(long, value_name = "LANGUAGE", help_heading = heading::OUTPUT, conflicts_with_all = ["json", "csv"], value_parser = choice::<TableLanguage>())]
    table: Option<TableLanguage>,
    /// Plot the paths and their x, y, z, roll, pitch and yaw (.svg, .png or .pdf)
    #[arg(long, value_name = "FIGURE", help_heading = heading::OUTPUT)]
    plot: Option<PathBuf>,
    /// Plot the errors: as a map, over time, per axis, their distribution and their growth
    #[arg(long, value_name = "FIGURE", help_heading = heading::OUTPUT)]
    plot_errors: Option<PathBuf>,
    #[command(flatten)]
    overwrite: Overwrite,
}

/// What a table for a text is written in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, strum::EnumString, strum::VariantNames)]
#[strum(serialize_all = "kebab-case")]
enum TableLanguage {
    /// Markdown.
    Markdown,
    /// LaTeX with the package booktabs.
    Latex,
}

impl Args {
    pub(super) fn run(self) -> Result<(), Failure> {
        let figures = [("--plot", self.plot.as_deref()), ("--plot-errors", self.plot_errors.as_deref())];
        let figures = || figures.into_iter().filter_map(|(flag, figure)| Some((flag, figure?)));
        figures().try_for_each(|(_, figure)| figures::check(figure, self.overwrite))?;
        outputs::check_distinct(figures())?;
        let settings = self.settings()?;
        if let [estimate] = &self.estimates[..]
            && self.reference.is_dir()
            && estimate.is_dir()
        {
            return self.run_folders(estimate, &settings);
        }
        let reference = self.read(&self.reference, Role::Reference)?;
        let rows = self.compare(&reference, &settings)?;
        self.note_trimming();
        self.draw(&rows)?;
        let is_table = self.csv || self.table.is_some();
        if let ([BatchRow { outcome: Ok(_), .. }], false) = (&rows[..], is_table) {
        } else {
            self.print_rows(&rows)?;
            return check_any(&rows);
        }
        for evaluation in rows.iter().filter_map(|row| row.outcome.as_ref().ok()) {
            self.print(evaluation)?;
        }
        Ok(())
    }

    /// The comparison of each estimate, or of all as one path. Of one estimate alone an error ends the command.
    fn compare(&self, reference: &Trajectory, settings: &EvalSettings) -> Result<Vec<BatchRow>, Failure> {
        let paths = self.estimates.iter().map(|path| self.read(path, Role::Estimate)).collect::<Result<Vec<_>, _>>()?;
        let named: Vec<(String, Trajectory)> = if self.merge {
            vec![(self.names().join(" + "), Trajectory::merged(&paths)?)]
        } else {
            self.names().into_iter().zip(paths).collect()
        };
        let is_alone = named.len() == 1;
        let mut rows = Vec::with_capacity(named.len());
        for (name, estimate) in named {
            let outcome = evaluate(reference, &estimate, settings);
            if is_alone && let Err(error) = outcome {
                return Err(error.into());
            }
            rows.push(BatchRow { name, outcome });
        }
        Ok(rows)
    }

    /// The estimates' file names, or their paths where two have the same name.
    fn names(&self) -> Vec<String> {
        let short: Vec<String> = self.estimates.iter().map(|path| short_name(path)).collect();
        let is_shared = |name: &String| short.iter().filter(|other| *other == name).count() > 1;
        let name = |(path, name): (&PathBuf, &String)| {
            if is_shared(name) { path.display().to_string() } else { name.clone() }
        };
        self.estimates.iter().zip(&short).map(name).collect()
    }

    /// Writes the figures.
    fn draw(&self, rows: &[BatchRow]) -> Result<(), Failure> {
        let compared: Vec<(&str, &Evaluation)> =
            rows.iter().filter_map(|row| Some((row.name.as_str(), row.outcome.as_ref().ok()?))).collect();
        if compared.is_empty() {
            return Ok(());
        }
        let reference_name = short_name(&self.reference);
        if let Some(figure) = &self.plot {
            figures::write(figure, &compared_figure(&reference_name, &compared), "the paths", self.overwrite)?;
        }
        if let Some(figure) = &self.plot_errors {
            figures::write(figure, &error_figure(&reference_name, &compared), "the errors", self.overwrite)?;
        }
        Ok(())
    }

    /// Prints one comparison.
    fn print(&self, evaluation: &Evaluation) -> Result<(), Failure> {
        if self.json {
            let json = if self.motion { evaluation.to_json_with_motion() } else { evaluation.to_json() };
            return console::data(&json);
        }
        for line in &evaluation.notes {
            console::note(&format!("note: {line}"));
        }
        console::text(&text(evaluation))?;
        if self.motion {
            console::text(&motion_text("reference", &evaluation.matches.reference))?;
            console::text(&motion_text("estimate", &evaluation.matches.estimate))?;
        }
        Ok(())
    }

    /// Prints several comparisons as a table.
    fn print_rows(&self, rows: &[BatchRow]) -> Result<(), Failure> {
        for (row, found) in rows.iter().filter_map(|row| Some((row, row.outcome.as_ref().ok()?))) {
            found.notes.iter().for_each(|line| console::note(&format!("note: {}: {line}", row.name)));
        }
        match (self.json, self.csv, self.table) {
            (true, ..) => console::data(&summary_json(rows))?,
            (_, true, _) => console::data(&summary_csv(rows))?,
            (.., Some(TableLanguage::Markdown)) => console::data(&result_markdown(rows))?,
            (.., Some(TableLanguage::Latex)) => console::data(&result_latex(rows))?,
            _ => console::text(&summary_text(rows))?,
        }
        if self.motion && !self.json && !self.csv && self.table.is_none() {
            for (row, found) in rows.iter().filter_map(|row| Some((row, row.outcome.as_ref().ok()?))) {
                console::text(&motion_text(&row.name, &found.matches.estimate))?;
            }
        }
        Ok(())
    }

    /// Prints a table over pairs of files.
    fn run_folders(&self, estimate: &Path, settings: &EvalSettings) -> Result<(), Failure> {
        if self.plot.is_some() || self.plot_errors.is_some() || self.motion {
            return Err(Failure::usage(
                "--plot, --plot-errors and --motion compare files, found two folders",
                "give files, or leave these flags out",
            ));
        }
        let rows = eval_folders::compare([&self.reference, estimate], settings, |path, role| self.read(path, role))?;
        self.note_trimming();
        self.print_rows(&rows)?;
        check_any(&rows)
    }

    fn settings(&self) -> Result<EvalSettings, Failure> {
        Ok(EvalSettings {
            metric: self.metric()?,
            relation: self.relation,
            align: self.align,
            align_poses: self.align_poses,
            max_diff_secs: self.max_diff,
            estimate_offset_secs: self.time_offset,
            matching: if self.interpolate { Matching::Interpolated } else { Matching::Nearest },
            convention: self.convention(),
            scene_diameter: self.diameter,
            subject: self.subject,
        })
    }

    fn convention(&self) -> Convention {
        if self.like_evo { Convention::Evo } else { Convention::Cinesplat }
    }

    fn reduction(&self) -> Reduction {
        Reduction {
            start_secs: self.start,
            end_secs: self.end,
            max_poses: self.downsample.map(|poses| poses as usize),
            motion: self.motion_filter,
        }
    }

    fn read(&self, path: &Path, role: Role) -> Result<Trajectory, Failure> {
        let track = eval_paths::read(path, self.from)?;
        let reduced = self.reduction().apply_as(&Trajectory::from(&track), role, self.convention());
        reduced.map_err(|error| Failure::from(error).in_file(path))
    }

    /// Says that evo trims otherwise.
    fn note_trimming(&self) {
        if self.reduction().has_span() && !self.like_evo {
            console::note(
                "note: --start and --end trim all paths; evo trims the reference alone, which may give other pairs and figures: \
                 --like-evo trims as evo",
            );
        }
    }

    fn metric(&self) -> Result<Metric, Failure> {
        if !self.rpe {
            return Ok(Metric::Ape);
        }
        let delta = Delta::new(self.delta, self.unit)?;
        let pairs = PairSettings { delta, all_pairs: self.all_pairs, ..PairSettings::default() };
        Ok(Metric::Rpe { pairs, pairs_from_reference: self.pairs_from_reference })
    }
}

fn short_name(path: &Path) -> String {
    path.file_name().map_or_else(|| path.display().to_string(), |name| name.to_string_lossy().into_owned())
}

fn text(evaluation: &Evaluation) -> String {
    let settings = &evaluation.settings;
    let unit = settings.relation.unit();
    let mut text = evaluation.title() + "\n";
    for (name, value) in evaluation.statistics.named() {
        let _ = writeln!(text, "{name:<7} {value:.9} {}", if name == "sse" { "" } else { unit });
    }
    if settings.align != Align::None {
        let _ = writeln!(text, "scale   {:.9}", evaluation.alignment.scale);
    }
    if let Some(share) = evaluation.relative_to_diameter {
        let _ = writeln!(text, "mean / diameter {share:.9}");
    }
    if let Some(focal) = &evaluation.focal {
        let (rmse, most) = (focal.log_ratio_rmse, focal.log_ratio_max);
        let _ = writeln!(text, "focal length: rmse {rmse:.9}, max {most:.9} (logarithm of the ratio)");
    }
    if let Some(framing) = &evaluation.framing {
        let (offset, most, size) = (framing.offset_rmse, framing.offset_max, framing.log_size_rmse);
        let lost = 100.0 * framing.lost_frac;
        let _ = writeln!(text, "framing: offset rmse {offset:.6}, max {most:.6} frame heights");
        let _ = writeln!(text, "framing: size rmse {size:.6} (logarithm of the ratio), lost in {lost:.1} % of frames");
    }
    text.lines().fold(String::new(), |text, line| text + line.trim_end() + "\n")
}

pub(super) fn parse_subject(text: &str) -> Result<SubjectSphere, String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|part| part.trim().parse::<f64>()).collect();
    let sphere = numbers
        .ok()
        .and_then(|numbers| <[f64; 4]>::try_from(numbers).ok())
        .map(|[x, y, z, radius]| SubjectSphere { center: DVec3::new(x, y, z), radius });
    let usable = sphere.filter(|sphere| sphere.center.is_finite() && sphere.radius > 0.0 && sphere.radius.is_finite());
    usable.ok_or_else(|| "expected x, y, z and a radius above 0 separated by commas, such as 0,1,-2,0.4".to_owned())
}

/// Warns of comparisons that failed; an error if all did.
fn check_any(rows: &[BatchRow]) -> Result<(), Failure> {
    let failed = || rows.iter().filter_map(|row| Some(format!("{}: {}", row.name, row.outcome.as_ref().err()?)));
    if rows.iter().any(|row| row.outcome.is_ok()) {
        console::warnings(failed());
        return Ok(());
    }
    let found = format!("no comparison succeeded: {}", failed().collect::<Vec<_>>().join("; "));
    Err(Failure::new("EVAL-NONE", found, "compare one estimate alone for the advice on its error", Exit::BadData))
}

fn parse_motion_filter(text: &str) -> Result<MotionFilter, String> {
    let numbers: Vec<Option<f64>> = text.split(',').map(|part| part.trim().parse().ok()).collect();
    match numbers[..] {
        [Some(distance), Some(degrees)] if distance >= 0.0 && degrees >= 0.0 => {
            Ok(MotionFilter { distance, angle_rad: degrees.to_radians() })
        }
        _ => Err("expected a distance in scene units and an angle in degrees, such as 0.1,5".to_owned()),
    }
}
