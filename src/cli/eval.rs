use super::outputs::Overwrite;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use glam::DVec3;

use super::choice::choice;
use super::failure::Failure;
use super::{console, eval_folders, formats, heading};
use cinesplat::evaluation::{
    Align, Delta, DeltaUnit, EvalSettings, Evaluation, Matching, Metric, PairSettings, Relation, SubjectSphere,
    Trajectory, evaluate, motion_text, plot_svg, summary_csv, summary_json, summary_text,
};
use cinesplat::export::{self, Format, PoseTrack};

/// Compare two camera paths: absolute and relative pose error
///
/// Reads every format that `import` reads. Prints statistics of the error over matched poses.
#[derive(Debug, clap::Args)]
#[expect(clippy::struct_excessive_bools, reason = "flags of a command")]
#[command(after_help = "\
Examples:
  cinesplat eval groundtruth.txt estimate.txt --align se3
  cinesplat eval plan.shot.json flown.tum --rpe --delta 1 --unit m --relation angle_deg --json
  cinesplat eval planned/ flown/ --align se3 --csv > all.csv
  cinesplat eval a.shot.json b.shot.json --subject 0,1,-2,0.4 --motion
Paths are aligned only with --align. A shot.json is sampled at the frames of its film. Of two folders, files with the
same name up to the first dot are compared.")]
pub(super) struct Args {
    /// Reference path, or a folder of paths
    #[arg(value_name = "REF")]
    reference: PathBuf,
    /// Path to compare with it, or a folder of paths
    #[arg(value_name = "EST")]
    estimate: PathBuf,
    /// Format of both files [default: by their contents]
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
    /// Number of first poses used for the alignment [default: all]
    #[arg(long, value_name = "N")]
    align_poses: Option<usize>,
    /// Interpolate the estimate at the reference's times [default: match nearest poses]
    #[arg(long)]
    interpolate: bool,
    /// Seconds added to the estimate's times
    #[arg(long, value_name = "SECS", default_value_t = 0.0, allow_hyphen_values = true)]
    time_offset: f64,
    /// Diameter for relative errors, scene units [default: the reference's]
    #[arg(long, value_name = "D")]
    diameter: Option<f64>,
    /// Compare the framing of a sphere: center and radius, scene units
    #[arg(long, value_name = "X,Y,Z,R", value_parser = parse_subject, allow_hyphen_values = true)]
    subject: Option<SubjectSphere>,
    /// Also describe the motion of both paths: smoothness, motion tags, tables of poses
    #[arg(long)]
    motion: bool,
    /// Largest time difference of matched poses in seconds
    #[arg(long, value_name = "SECS", default_value_t = EvalSettings::default().max_diff_secs)]
    max_diff: f64,
    /// Print one JSON object instead of lines
    #[arg(long, help_heading = heading::OUTPUT)]
    json: bool,
    /// Print a CSV table instead of lines; for folders
    #[arg(long, help_heading = heading::OUTPUT, conflicts_with = "json")]
    csv: bool,
    /// Plot both paths and their x, y, z, roll, pitch and yaw
    #[arg(long, value_name = "OUT.SVG", help_heading = heading::OUTPUT)]
    plot: Option<PathBuf>,
    #[command(flatten)]
    overwrite: Overwrite,
}

impl Args {
    pub(super) fn run(self) -> Result<(), Failure> {
        if let Some(plot) = &self.plot {
            self.overwrite.check(plot)?;
        }
        let settings = self.settings()?;
        if self.reference.is_dir() && self.estimate.is_dir() {
            return self.run_folders(&settings);
        }
        let (reference, estimate) = (self.read(&self.reference)?, self.read(&self.estimate)?);
        let evaluation = evaluate(&reference, &estimate, &settings)?;
        if let Some(plot) = &self.plot {
            let paths = [("reference", &evaluation.matches.reference), ("estimate", &evaluation.matches.estimate)];
            self.overwrite.write(plot, plot_svg(&title(&evaluation), &paths, &[]).as_bytes())?;
            console::note(&format!("{}: both paths", plot.display()));
        }
        if self.json {
            let json = if self.motion { evaluation.to_json_with_motion() } else { evaluation.to_json() };
            return console::data(&json);
        }
        for line in &evaluation.notes {
            console::note(&format!("note: {line}"));
        }
        console::text(&text(&evaluation))?;
        if self.motion {
            console::text(&motion_text("reference", &evaluation.matches.reference))?;
            console::text(&motion_text("estimate", &evaluation.matches.estimate))?;
        }
        Ok(())
    }

    /// Prints a table over pairs of files.
    fn run_folders(&self, settings: &EvalSettings) -> Result<(), Failure> {
        if self.plot.is_some() || self.motion {
            return Err(Failure::usage(
                "--plot and --motion compare two files, found two folders",
                "give two files, or leave these flags out",
            ));
        }
        let rows = eval_folders::compare([&self.reference, &self.estimate], settings, |path| self.read(path))?;
        match (self.json, self.csv) {
            (true, _) => console::data(&summary_json(&rows)),
            (_, true) => console::data(&summary_csv(&rows)),
            _ => console::text(&summary_text(&rows)),
        }
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
            scene_diameter: self.diameter,
            subject: self.subject,
        })
    }

    fn read(&self, path: &Path) -> Result<Trajectory, Failure> {
        let in_file = |error| Failure::from(error).in_file(path);
        let imported = export::read(path, self.from).map_err(in_file)?;
        formats::note_doubt(path, imported.doubt.as_ref());
        console::file_warnings(path, &imported.notes);
        let track = match &imported.shot {
            Some(shot) => PoseTrack::sampled(shot, None)?,
            None => imported.track,
        };
        Ok(Trajectory::from(&track))
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

fn title(evaluation: &Evaluation) -> String {
    let settings = &evaluation.settings;
    let metric = match settings.metric {
        Metric::Ape => "absolute pose error",
        Metric::Rpe { .. } => "relative pose error",
    };
    let (relation, align) = (settings.relation.as_ref(), settings.align.as_ref());
    format!("{metric}, {relation}, align {align}, {} errors", evaluation.errors.len())
}

fn text(evaluation: &Evaluation) -> String {
    let settings = &evaluation.settings;
    let unit = settings.relation.unit();
    let mut text = title(evaluation) + "\n";
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

fn parse_subject(text: &str) -> Result<SubjectSphere, String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|part| part.trim().parse::<f64>()).collect();
    let sphere = numbers
        .ok()
        .and_then(|numbers| <[f64; 4]>::try_from(numbers).ok())
        .map(|[x, y, z, radius]| SubjectSphere { center: DVec3::new(x, y, z), radius });
    let usable = sphere.filter(|sphere| sphere.center.is_finite() && sphere.radius > 0.0 && sphere.radius.is_finite());
    usable.ok_or_else(|| "expected x, y, z and a radius above 0 separated by commas, such as 0,1,-2,0.4".to_owned())
}
