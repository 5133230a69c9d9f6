use cinesplat::evaluation::{
    Align, BatchRow, Delta, EvalSettings, EvaluationError, Metric, PairSettings, Trajectory, compared_figure,
    error_figure, evaluate, path_figure, result_latex, result_markdown,
};
use glam::{DQuat, DVec3};

use super::paths::through;

/// Checks that tags are nested and closed, as an XML parser does.
fn is_well_formed(svg: &str) -> bool {
    let mut open: Vec<&str> = Vec::new();
    for tag in svg.split('<').skip(1) {
        let Some((inside, _)) = tag.split_once('>') else { return false };
        let name = inside.split([' ', '/']).find(|part| !part.is_empty()).unwrap_or_default();
        if inside.starts_with('/') {
            if open.pop() != Some(name) {
                return false;
            }
        } else if !inside.ends_with('/') {
            open.push(name);
        }
    }
    open.is_empty()
}

#[test]
fn draws_every_path_in_every_chart() {
    let path = |shift: f64| through((0..50).map(move |k| DVec3::new(f64::from(k) * 0.1, shift, 0.0)), DQuat::IDENTITY);
    let figure =
        path_figure("one < two & \"three\"", &[("reference", &path(0.0)), ("estimate", &path(0.2))], &[0.0, 1.0]);
    let svg = figure.to_svg();
    assert!(is_well_formed(&svg), "{svg}");
    // Two views and six charts, each with a line per path, and the legend with one per path.
    for color in ["#888888", "#d55e00"] {
        let lines = svg.lines().filter(|line| line.starts_with("<polyline") && line.contains(color));
        assert_eq!(lines.count(), 8 + 1, "{color}");
    }
    for name in
        ["seen from above", "seen from the side", "x, scene units", "roll, degrees", "yaw, degrees", "one &lt; two"]
    {
        assert!(svg.contains(name), "{name}");
    }
    assert!(!svg.contains("NaN") && !svg.contains("inf"));
}

#[test]
fn still_single_and_empty_paths_draw_without_nonsense() {
    let still = through(std::iter::repeat_n(DVec3::ONE, 20), DQuat::IDENTITY);
    let single = through(std::iter::once(DVec3::ZERO), DQuat::IDENTITY);
    for path in [&still, &single, &Trajectory::default()] {
        let svg = path_figure("still", &[("path", path)], &[]).to_svg();
        assert!(is_well_formed(&svg) && !svg.contains("NaN") && !svg.contains("inf"), "{svg}");
    }
}

#[test]
fn long_recordings_stay_small() {
    let long = through((0..200_000).map(|k| DVec3::new(f64::from(k) * 1e-4, 0.0, 0.0)), DQuat::IDENTITY);
    assert!(path_figure("long", &[("path", &long)], &[]).to_svg().len() < 400_000);
}

#[test]
fn yaw_of_an_estimate_stays_beside_the_references() {
    // The reference turns once around; the estimate misses the half turn in the middle.
    let turning = |frames: &mut dyn Iterator<Item = usize>| {
        let poses: Vec<_> = frames
            .map(|k| {
                let turn = DQuat::from_rotation_y((k as f64 * 3.6).to_radians());
                (k as f64 / 10.0, cinesplat::geometry::Pose::new(DVec3::X * k as f64, turn))
            })
            .collect();
        let (times, poses): (Vec<f64>, Vec<_>) = poses.into_iter().unzip();
        Trajectory { up: Some(DVec3::NEG_Y), ..Trajectory::from_poses(Some(times), &poses) }
    };
    let whole = turning(&mut (0..100));
    let gapped = turning(&mut (0..20).chain(80..100));
    let svg = path_figure("turn", &[("reference", &whole), ("estimate", &gapped)], &[]).to_svg();
    // The last chart is that of the yaw: its labels end within one turn of 0.
    let labels = svg.rsplit("yaw, degrees").nth(1).unwrap_or_default();
    assert!(!svg.contains(">-400<") && !svg.contains(">-300<"), "{labels}");
}

/// KITTI's ground truth has a file of times beside it, an estimate has none: the estimate was drawn over the numbers of its
/// frames, ten times as long, and its yaw turned to that of another moment.
#[test]
fn an_estimate_without_times_is_drawn_at_the_times_of_the_reference() {
    let circle = |times_secs: Option<Vec<f64>>| {
        let pose = |k: i32| {
            let turn = DQuat::from_rotation_y(f64::from(k) * 0.02);
            cinesplat::geometry::Pose::new(turn * DVec3::Z * 5.0, turn)
        };
        Trajectory {
            up: Some(DVec3::NEG_Y),
            ..Trajectory::from_poses(times_secs, &(0..600).map(pose).collect::<Vec<_>>())
        }
    };
    let timed = circle(Some((0..600).map(|k| f64::from(k) * 0.1).collect()));
    for (reference, estimate, axis) in [(&timed, &circle(None), "time, s"), (&circle(None), &timed, "frame")] {
        let found = evaluate(reference, estimate, &EvalSettings::default()).unwrap();
        let svg = compared_figure("truth.txt", &[("slam.txt", &found)]).to_svg();
        let points = |color: &str| {
            let lines = svg.lines().filter(|line| line.starts_with("<polyline") && line.contains(color));
            lines
                .map(|line| line.split("points=\"").nth(1).unwrap().split('"').next().unwrap().to_owned())
                .collect::<Vec<_>>()
        };
        // The first line of each is that of the legend.
        assert!(points("#888888").len() == 9 && points("#888888")[1..] == points("#d55e00")[1..], "{axis}");
        assert!(svg.contains(axis) && svg.contains("against truth.txt") && svg.contains("height, scene units"));
    }
}

/// The reference was drawn where the first estimate has poses, however far the others went.
#[test]
fn the_reference_is_drawn_as_far_as_any_estimate_goes() {
    let path = |range: std::ops::Range<i32>| {
        let poses: Vec<_> =
            range.clone().map(|k| cinesplat::geometry::Pose::new(DVec3::X * f64::from(k), DQuat::IDENTITY)).collect();
        Trajectory::from_poses(Some(range.map(f64::from).collect()), &poses)
    };
    let whole = path(0..100);
    let [lost_early, late] =
        [0..10, 5..100].map(|range| evaluate(&whole, &path(range), &EvalSettings::default()).unwrap());
    let svg = compared_figure("truth.txt", &[("lost.txt", &lost_early), ("late.txt", &late)]).to_svg();
    assert!(svg.contains("truth.txt (100 poses)"), "{svg}");
}

/// Figures and tables of relative errors did not say over which distance.
#[test]
fn relative_errors_say_over_which_distance() {
    let path = through((0..50).map(|k| DVec3::X * f64::from(k)), DQuat::IDENTITY);
    let title = |delta: Delta, all_pairs: bool, pairs_from_reference: bool| {
        let pairs = PairSettings { delta, all_pairs, ..PairSettings::default() };
        let metric = Metric::Rpe { pairs, pairs_from_reference };
        evaluate(&path, &path, &EvalSettings { metric, ..EvalSettings::default() }).unwrap().method()
    };
    assert_eq!(title(Delta::Frames(1), false, false), "relative pose error over 1 frame, trans, align none");
    assert_eq!(
        title(Delta::Distance(2.0), true, true),
        "relative pose error over 2 scene units of the reference, all pairs, trans, align none"
    );
}

fn compared(noise: f64) -> cinesplat::evaluation::Evaluation {
    let wave = |scale: f64| {
        let at = move |k: i32| {
            let t = f64::from(k) * 0.05;
            DVec3::new(t, (3.0 * t).sin() + scale * (17.0 * t).sin(), 0.3 * (2.0 * t).cos())
        };
        through((0..300).map(at), DQuat::IDENTITY)
    };
    evaluate(&wave(0.0), &wave(noise), &EvalSettings { align: Align::Se3, ..EvalSettings::default() }).unwrap()
}

#[test]
fn the_figure_of_errors_shows_maps_times_axes_and_spreads_of_every_estimate() {
    let (near, far) = (compared(0.01), compared(0.1));
    let svg = error_figure("truth.txt", &[("near.txt", &near), ("far.txt", &far)]).to_svg();
    assert!(is_well_formed(&svg) && !svg.contains("NaN") && !svg.contains("inf"));
    for name in [
        "near.txt (300 errors)",
        "far.txt: rmse",
        "truth.txt",
        "error over time",
        "error of x",
        "distribution",
        "relative error of the position",
        "relative error of the rotation",
        "position, scene units",
    ] {
        assert!(svg.contains(name), "{name}");
    }
    // Five distances with a box of each estimate, in two charts: boxes are the only marks with an opacity of 0.35.
    assert_eq!(svg.matches("fill-opacity=\"0.35\"").count(), 2 * 5 * 2);
    let still = through(std::iter::repeat_n(DVec3::ONE, 20), DQuat::IDENTITY);
    let still = evaluate(&still, &still, &EvalSettings::default()).unwrap();
    let svg = error_figure("still", &[("still", &still)]).to_svg();
    assert!(is_well_formed(&svg) && !svg.contains("NaN") && svg.contains("the reference is stationary"));
}

/// Each estimate had distances of its own, so that boxes beside each other were of other distances.
#[test]
fn boxes_of_several_estimates_stand_at_common_distances() {
    let whole = compared(0.01);
    let wave = |count: usize| {
        let part: Vec<usize> = (0..count).collect();
        let (reference, estimate) = (whole.matches.reference.select(&part), whole.matches.estimate.select(&part));
        evaluate(&reference, &estimate, &EvalSettings::default()).unwrap()
    };
    let svg = error_figure("truth.txt", &[("whole.txt", &wave(300)), ("half.txt", &wave(150))]).to_svg();
    // The left side and the width.
    let boxes: Vec<(f64, f64)> = svg
        .lines()
        .filter(|line| line.starts_with("<polygon") && line.contains("fill-opacity=\"0.35\""))
        .map(|line| {
            let corners = line.split_once("points=\"").unwrap().1.split_once('"').unwrap().0;
            let corners: Vec<f64> =
                corners.split(' ').map(|corner| corner.split_once(',').unwrap().0.parse().unwrap()).collect();
            (corners[0], corners[1] - corners[0])
        })
        .collect();
    // In each chart first the five of one estimate, then those of the other.
    for chart in boxes.chunks(10) {
        for (a, b) in chart[..5].iter().zip(&chart[5..]) {
            assert!(b.0 > a.0 && b.0 - a.0 < 1.5 * a.1, "{a:?} {b:?}");
        }
    }
    assert_eq!(boxes.len(), 20);
    // The statistics along an axis name the estimate, too.
    assert_eq!(svg.matches("half.txt: rmse ").count(), 4);
}

#[test]
fn a_pdf_says_where_each_of_its_objects_starts() {
    let pdf = error_figure("truth", &[("near", &compared(0.01))]).to_pdf();
    let text = String::from_utf8_lossy(&pdf);
    let table = text.rsplit_once("startxref\n").unwrap().1.lines().next().unwrap().parse::<usize>().unwrap();
    assert!(pdf[table..].starts_with(b"xref"));
    let starts = String::from_utf8_lossy(&pdf[table..]).into_owned();
    for (number, line) in starts.lines().skip(3).take_while(|line| line.ends_with("n ")).enumerate() {
        let start: usize = line[..10].parse().unwrap();
        assert!(pdf[start..].starts_with(format!("{} 0 obj", number + 1).as_bytes()), "object {}", number + 1);
    }
    assert!(text.contains("/BaseFont /Helvetica ") && !text.contains("NaN"));
}

#[test]
fn tables_for_a_text_mark_the_best_row() {
    let failed = EvaluationError::Empty { which: "estimate" };
    let rows = [("a_b", Ok(compared(0.1))), ("c|d", Ok(compared(0.01))), ("e", Err(failed))]
        .map(|(name, outcome)| BatchRow { name: name.to_owned(), outcome });
    insta::assert_snapshot!(result_markdown(&rows), @r"
    absolute pose error, trans, align se3, in scene units

    | estimate | pairs | rmse | mean | median | std | min | max |
    |---|---:|---:|---:|---:|---:|---:|---:|
    | a_b | 300 | 0.07063 | 0.06352 | 0.0709 | 0.03088 | 3.667e-5 | 0.1008 |
    | c\|d | 300 | **0.007063** | 0.006352 | 0.00709 | 0.003088 | 3.668e-6 | 0.01008 |
    | e | | the estimate has no poses, expected at least one | | | | | |
    ");
    insta::assert_snapshot!(result_latex(&rows), @r"
    % absolute pose error, trans, align se3, in scene units
    \begin{tabular}{lrrrrrrr}
    \toprule
    estimate & pairs & rmse & mean & median & std & min & max \\
    \midrule
    a\_b & 300 & 0.07063 & 0.06352 & 0.0709 & 0.03088 & 3.667e-5 & 0.1008 \\
    c|d & 300 & \textbf{0.007063} & 0.006352 & 0.00709 & 0.003088 & 3.668e-6 & 0.01008 \\
    e & \multicolumn{7}{l}{the estimate has no poses, expected at least one} \\
    \bottomrule
    \end{tabular}
    ");
}
