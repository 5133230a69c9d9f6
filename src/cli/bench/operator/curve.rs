use crate::cli::outputs::Overwrite;
use std::path::PathBuf;
use std::time::Duration;

use super::statistics::Summary;
use crate::cli::bench::cases::CaseArgs;
use crate::cli::console;
use crate::cli::failure::Failure;
use cinesplat::operator::{SolveLevel, SolveSettings};
use cinesplat::plot::{Axis, COLORS, Chart, Marker, Series, grid};
use cinesplat::trajectory::Shot;

/// Search budgets: a level and the factor on its number of tries.
const BUDGETS: [(SolveLevel, f64); 9] = [
    (SolveLevel::Off, 1.0),
    (SolveLevel::Fast, 0.05),
    (SolveLevel::Fast, 0.15),
    (SolveLevel::Fast, 0.4),
    (SolveLevel::Fast, 1.0),
    (SolveLevel::Full, 0.5),
    (SolveLevel::Full, 1.0),
    (SolveLevel::Full, 2.0),
    (SolveLevel::Full, 4.0),
];

/// Measure unmet requirements against search time
#[derive(Debug, clap::Args)]
pub(super) struct Args {
    #[command(flatten)]
    cases: CaseArgs,
    /// Plot the curve
    #[arg(long, value_name = "OUT.SVG")]
    plot: Option<PathBuf>,
    #[command(flatten)]
    overwrite: Overwrite,
}

/// Results of all films at one budget.
#[derive(Debug, Default)]
struct BudgetOutcome {
    ms: Vec<f64>,
    lines: usize,
    unmet: usize,
    whole: usize,
}

impl BudgetOutcome {
    fn add(&mut self, shot: &Shot, time: Duration) {
        let unmet = shot.report.iter().filter(|line| !line.met).count();
        self.ms.push(time.as_secs_f64() * 1e3);
        self.lines += shot.report.len();
        self.unmet += unmet;
        self.whole += usize::from(unmet == 0);
    }

    /// Share of unmet lines of the reports.
    fn violated_frac(&self) -> f64 {
        self.unmet as f64 / self.lines.max(1) as f64
    }
}

impl Args {
    pub(super) fn run(self) -> Result<(), Failure> {
        if let Some(plot) = &self.plot {
            self.overwrite.check(plot)?;
        }
        let (cases, mut director) = self.cases.open()?;
        let tries =
            BUDGETS.map(|(level, tries_factor)| SolveSettings { level, tries_factor, ..SolveSettings::default() });
        let mut outcomes: [BudgetOutcome; BUDGETS.len()] = Default::default();
        for case in &cases {
            let shots = director.direct_each(case, &tries)?;
            outcomes.iter_mut().zip(&shots).for_each(|(outcome, (shot, time))| outcome.add(shot, *time));
            console::note(&format!("{}: done", case.id));
        }
        console::data("level,tries_factor,ms_median,ms_most,violated_frac,unmet_lines,whole_films,films\n")?;
        for ((level, factor), outcome) in BUDGETS.iter().zip(&outcomes) {
            let Summary { median, largest, .. } = Summary::of(&outcome.ms);
            let (violated, unmet, whole) = (outcome.violated_frac(), outcome.unmet, outcome.whole);
            let films = outcome.ms.len();
            let name = level.as_ref();
            console::data(&format!(
                "{name},{factor},{median:.1},{largest:.1},{violated:.5},{unmet},{whole},{films}\n"
            ))?;
        }
        let Some(plot) = &self.plot else { return Ok(()) };
        let title = format!("unmet requirements, {} films", cases.len());
        let svg = curve_svg(&title, &outcomes);
        self.overwrite.write(plot, svg.as_bytes())?;
        console::note(&format!("{}: the curve", plot.display()));
        Ok(())
    }
}

/// Share of unmet report lines against search time, one labeled dot per budget.
fn curve_svg(title: &str, outcomes: &[BudgetOutcome]) -> String {
    let point = |outcome: &BudgetOutcome| (Summary::of(&outcome.ms).median.max(1e-3), 100.0 * outcome.violated_frac());
    let name = |(level, factor): &(SolveLevel, f64)| format!("{} x {factor}", level.as_ref());
    let dot = |(idx, budget)| Marker { label: name(budget), ..Marker::dot(idx, 3.5) };
    let mut chart = Chart::new("", Axis::logarithmic("ms of search, median"), Axis::linear("lines not met, %"));
    chart.series.push(Series {
        points: outcomes.iter().map(point).collect(),
        color: COLORS[2],
        line_px: 1.5,
        markers: BUDGETS.iter().enumerate().map(dot).collect(),
    });
    grid(title, &[], &[chart], 1, [740.0, 420.0])
}
