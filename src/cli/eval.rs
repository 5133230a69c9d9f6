use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use super::export::parse_format;
use super::failure::Failure;
use super::{console, outputs};
use crate::evaluation::{
    Align, Delta, EvalSettings, Evaluation, Metric, PairSettings, Relation, Trajectory, evaluate, plot_svg,
};
use crate::export::{self, Format, PoseTrack};

/// Compares two trajectories: absolute and relative pose error.
#[derive(Debug, clap::Args)]
#[expect(clippy::struct_excessive_bools, reason = "flags of a command")]
#[command(after_help = "\
Examples:
  cinesplat eval groundtruth.txt estimate.txt --align se3
  cinesplat eval plan.shot.json flown.tum --rpe --delta 1 --unit m --relation angle_deg --json
Relations: full trans rot angle_deg angle_rad point_distance point_distance_ratio. Nothing is aligned unless asked.
A shot.json stands for the frames of its film.")]
pub(super) struct Args {
    /// The path that is taken for true
    #[arg(value_name = "REF")]
    reference: PathBuf,
    /// The path that is measured
    #[arg(value_name = "EST")]
    estimate: PathBuf,
    /// Format of both files, instead of what their contents say
    #[arg(long, value_name = "FORMAT", value_parser = parse_format)]
    from: Option<Format>,
    /// What is aligned first: none, origin, yaw, se3, sim3 or scale
    #[arg(long, value_name = "MODE", default_value = "none", value_parser = parse_align)]
    align: Align,
    /// What of the error is measured
    #[arg(long, value_name = "R", default_value = "trans", value_parser = parse_relation)]
    relation: Relation,
    /// Relative error: of the motion between poses --delta apart
    #[arg(long)]
    rpe: bool,
    /// Distance of the two poses of a relative error
    #[arg(long, value_name = "N", default_value_t = 1.0, requires = "rpe")]
    delta: f64,
    /// Unit of --delta: f (frames), m (scene units), d (degrees) or r (radians)
    #[arg(long, value_name = "U", default_value = "f", value_parser = ["f", "m", "d", "r"], requires = "rpe")]
    unit: String,
    /// Pairs of poses may overlap
    #[arg(long, requires = "rpe")]
    all_pairs: bool,
    /// Largest time between the two poses of a match, seconds
    #[arg(long, value_name = "S", default_value_t = EvalSettings::default().max_diff_secs)]
    max_diff: f64,
    /// One JSON object instead of lines
    #[arg(long)]
    json: bool,
    /// Writes both paths and their x y z roll pitch yaw as a picture
    #[arg(long, value_name = "OUT.SVG")]
    plot: Option<PathBuf>,
    /// Replaces a plot that is already there
    #[arg(long)]
    overwrite: bool,
}

impl Args {
    pub(super) fn run(self) -> Result<(), Failure> {
        if let Some(plot) = &self.plot {
            outputs::check_new(plot, self.overwrite)?;
        }
        let (reference, estimate) = (self.read(&self.reference)?, self.read(&self.estimate)?);
        let settings = EvalSettings {
            metric: self.metric()?,
            relation: self.relation,
            align: self.align,
            max_diff_secs: self.max_diff,
            ..EvalSettings::default()
        };
        let evaluation = evaluate(&reference, &estimate, &settings)?;
        if let Some(plot) = &self.plot {
            let paths = [("reference", &evaluation.matches.reference), ("estimate", &evaluation.matches.estimate)];
            outputs::write(plot, plot_svg(&title(&evaluation), &paths, &[]).as_bytes())?;
            console::note(&format!("{}: both paths", plot.display()));
        }
        if self.json {
            return console::data(&evaluation.to_json());
        }
        for line in &evaluation.notes {
            console::note(&format!("note: {line}"));
        }
        console::data(&text(&evaluation))
    }

    fn read(&self, path: &Path) -> Result<Trajectory, Failure> {
        let in_file = |error| Failure::from(error).in_file(path);
        let imported = export::read(path, self.from).map_err(in_file)?;
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
        let delta = Delta::new(self.delta, &self.unit)?;
        let pairs = PairSettings { delta, all_pairs: self.all_pairs, ..PairSettings::default() };
        Ok(Metric::Rpe { pairs, pairs_from_reference: false })
    }
}

fn title(evaluation: &Evaluation) -> String {
    let settings = &evaluation.settings;
    let metric = match settings.metric {
        Metric::Ape => "absolute pose error",
        Metric::Rpe { .. } => "relative pose error",
    };
    let (relation, align) = (settings.relation.name(), settings.align.name());
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
    text.lines().fold(String::new(), |text, line| text + line.trim_end() + "\n")
}

fn parse_align(name: &str) -> Result<Align, String> {
    let names = || Align::ALL.iter().map(|mode| mode.name()).collect::<Vec<_>>().join(", ");
    Align::from_name(name).ok_or_else(|| format!("expected one of {}", names()))
}

fn parse_relation(name: &str) -> Result<Relation, String> {
    let names = || Relation::ALL.iter().map(|relation| relation.name()).collect::<Vec<_>>().join(", ");
    Relation::from_name(name).ok_or_else(|| format!("expected one of {}", names()))
}
