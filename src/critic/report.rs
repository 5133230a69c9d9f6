//! The critic's lines in the report of a shot.

use cinesplat_trajectory::ReportLine;

use super::limits::{Limit, LimitCheck};
use super::resolution::{MAX_SPLAT_FRAC, holds_to};
use super::review::Review;
use super::terms::Weights;

/// Size of splats, over that at which a picture holds, from which on even a picture of a stated size shows nothing but paint.
const PAINT: f64 = 4.0;

/// Lines on the limits, the sharpness and the choice among `num_films`. A stated size stays the stated size; where it shows nothing but
/// paint, the line is not met.
pub fn report_lines(review: &Review, size_px: [u32; 2], num_films: usize) -> Vec<ReportLine> {
    let limits = review.limits.iter().map(limit_line);
    let sharpness = review.coarsest.map(|coarsest| sharpness_line(coarsest, size_px[1]));
    let moments = review.pictures.len();
    let taste = ReportLine {
        clause: "picture: taste".to_owned(),
        wanted: "the best mark, 0 to 1".to_owned(),
        got: review.score(&Weights::default()),
        met: true,
        note: format!("chosen from {num_films} films that clearly differ, each seen at {moments} moments"),
    };
    limits.chain(sharpness).chain([taste]).collect()
}

fn limit_line(check: &LimitCheck) -> ReportLine {
    let (clause, of) = match check.limit {
        Limit::Void => ("picture: nothing there", "of every frame without matter"),
        Limit::Blocked => ("picture: matter against the lens", "of every frame covered"),
        Limit::Lost => ("picture: subject lost", "of the frames that should show it"),
        Limit::Black => ("picture: black frames", "of the frames"),
    };
    let note = match check.at_secs.filter(|_| !check.is_kept()) {
        Some(secs) => format!("worst at {secs:.1} s"),
        None => String::new(),
    };
    let wanted = format!("at most {:.0} % {of}", 100.0 * check.most);
    ReportLine { clause: clause.to_owned(), wanted, got: check.got, met: check.is_kept(), note }
}

fn sharpness_line((splat_px, height_frac): (f64, Option<f64>), film_height_px: u32) -> ReportLine {
    let most = MAX_SPLAT_FRAC * f64::from(film_height_px);
    let note = match (splat_px > most, height_frac) {
        (false, _) => String::new(),
        (true, None) => format!("the capture is soft here: splats of {splat_px:.0} px"),
        (true, Some(height)) => {
            let size = holds_to(height, splat_px, film_height_px).as_ref().replace('-', " ");
            let article = if size.starts_with('e') { "an" } else { "a" };
            format!("holds to {article} {size}: splats of {splat_px:.0} px")
        }
    };
    ReportLine {
        clause: "picture: sharpness".to_owned(),
        wanted: format!("splats of at most {most:.0} px where the size is open, {:.0} px elsewhere", PAINT * most),
        got: splat_px,
        met: splat_px <= PAINT * most,
        note,
    }
}
