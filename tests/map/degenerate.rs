use cinesplat::map::draw;
use cinesplat::map::drawing::Drawing;
use cinesplat::objects::ObjectSet;
use cinesplat::scene::Gaussians;
use cinesplat::trajectory::{Keyframe, Shot};
use glam::{DVec3, Vec3};

use super::{key, mapped, texts, travel, views};
use crate::objects::{push, scene_of};

/// Asserts that a drawing is finite, on a page of a sensible size, and can be written both ways.
fn check(drawing: &Drawing) {
    assert!(drawing.size_px.cmpgt(glam::DVec2::splat(200.0)).all(), "{}", drawing.size_px);
    assert!(drawing.size_px.cmplt(glam::DVec2::splat(2500.0)).all(), "{}", drawing.size_px);
    let svg = drawing.to_svg();
    let mut lines = svg.lines().filter(|line| !line.contains("base64"));
    assert!(lines.all(|line| !line.contains("NaN") && !line.contains("inf\"")));
    drawing.to_png(1.0).unwrap();
    let page = drawing.size_px;
    assert!(
        views(drawing).iter().all(|(corner, size)| (*corner + *size).cmplt(page).all() && size.min_element() > 8.0)
    );
}

fn shot(keyframes: Vec<Keyframe>) -> Shot {
    Shot { keyframes, ..travel() }
}

#[test]
fn scenes_of_few_gaussians_have_a_map() {
    for num in 0..3 {
        let mut gaussians = Gaussians::default();
        for i in 0..num {
            push(&mut gaussians, DVec3::new(f64::from(i), 0.0, 0.0), 0.1, Vec3::ONE);
        }
        check(&draw(&scene_of(gaussians), &ObjectSet::default(), &travel()).unwrap());
    }
}

#[test]
fn one_gaussian_at_the_camera_has_a_map() {
    let mut gaussians = Gaussians::default();
    push(&mut gaussians, DVec3::ONE, 0.1, Vec3::ONE);
    let still = shot(vec![key(0.0, DVec3::ONE, DVec3::X, DVec3::Y)]);
    check(&draw(&scene_of(gaussians), &ObjectSet::default(), &still).unwrap());
}

#[test]
fn a_camera_that_sinks_looking_straight_down_has_a_map() {
    let at = |height: f64| DVec3::new(0.3, height, 0.2);
    let keys = vec![key(0.0, at(2.2), DVec3::NEG_Y, DVec3::Y), key(4.0, at(0.8), DVec3::NEG_Y, DVec3::Y)];
    let drawing = mapped(&shot(keys));
    check(&drawing);
    let words: Vec<&str> = texts(&drawing).into_iter().map(|(_, words)| words).collect();
    assert!(words.contains(&"start and end"), "from above both ends coincide: {words:?}");
    assert!(words.contains(&"start") && words.contains(&"end"), "from the side they do not: {words:?}");
}

#[test]
fn a_camera_that_stays_in_place_has_no_speed() {
    let at = DVec3::new(0.31, 1.23, 0.17);
    let drawing = mapped(&shot(vec![key(0.0, at, DVec3::X, DVec3::Y), key(4.0, at, DVec3::Z, DVec3::Y)]));
    check(&drawing);
    assert!(texts(&drawing).iter().any(|(_, words)| *words == "the camera stays in place"));
}

#[test]
fn a_camera_far_outside_sees_the_scene_on_its_map() {
    let at = |z: f64| DVec3::new(0.0, 1.2, z);
    let drawing =
        mapped(&shot(vec![key(0.0, at(30.0), DVec3::NEG_Z, DVec3::Y), key(4.0, at(29.5), DVec3::NEG_Z, DVec3::Y)]));
    check(&drawing);
}

#[test]
fn thousands_of_keys_and_cuts_have_a_map() {
    let keys = (0..3000).map(|i| {
        let angle = f64::from(i) * 0.002;
        let at = DVec3::new(angle.cos(), 1.2, angle.sin());
        Keyframe { cut: i % 500 == 499, ..key(f64::from(i) * 0.02, at, -at.with_y(0.0), DVec3::Y) }
    });
    let drawing = mapped(&Shot { duration_secs: 60.0, ..shot(keys.collect()) });
    check(&drawing);
    assert!(drawing.marks.len() < 2000, "{} marks", drawing.marks.len());
}
