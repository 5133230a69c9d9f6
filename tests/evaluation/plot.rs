use cinesplat::evaluation::{Trajectory, plot_svg};
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
    let svg = plot_svg("one < two & \"three\"", &[("reference", &path(0.0)), ("estimate", &path(0.2))], &[0.0, 1.0]);
    assert!(is_well_formed(&svg), "{svg}");
    // Two views and six charts.
    assert_eq!(svg.matches("<polyline").count(), 2 * 8);
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
        let svg = plot_svg("still", &[("path", path)], &[]);
        assert!(is_well_formed(&svg) && !svg.contains("NaN") && !svg.contains("inf"), "{svg}");
    }
}

#[test]
fn long_recordings_stay_small() {
    let long = through((0..200_000).map(|k| DVec3::new(f64::from(k) * 1e-4, 0.0, 0.0)), DQuat::IDENTITY);
    assert!(plot_svg("long", &[("path", &long)], &[]).len() < 400_000);
}
