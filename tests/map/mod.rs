//! The map of a shot: places and angles by arithmetic, labels, pictures, degenerate scenes.

mod degenerate;
mod geometry;
mod labels;
mod matter;

use cinesplat::geometry::Pose;
use cinesplat::map::draw;
use cinesplat::map::drawing::{Drawing, Ink, Mark};
use cinesplat::objects::{Object, ObjectSet};
use cinesplat::scene::{Gaussians, Scene};
use cinesplat::trajectory::{Easing, Intent, Keyframe, Shot};
use glam::{DVec2, DVec3, Vec3};

use crate::objects::{push_box, scene_of};
use crate::support::shot_over;

/// Vertical field of view of the keys.
pub const FOV_Y_DEG: f64 = 40.0;

/// A closed room, symmetric about the vertical axis: 4 wide, 3 deep, 2.5 high, floor at y = 0, with a box in it.
pub fn room() -> (Scene, ObjectSet) {
    let mut gaussians = Gaussians::default();
    push_box(&mut gaussians, DVec3::new(0.0, 1.25, 0.0), DVec3::new(2.0, 1.25, 1.5), 0.08, Vec3::splat(0.7));
    let (center, half) = (DVec3::new(1.0, 0.4, -0.6), DVec3::new(0.3, 0.4, 0.2));
    push_box(&mut gaussians, center, half, 0.05, Vec3::new(0.2, 0.5, 0.2));
    let objects = vec![Object::from_box(7, "chest", center, half)];
    (scene_of(gaussians), ObjectSet { objects, labels: Vec::new() })
}

/// A key at a place that looks along a direction, with a subject.
pub fn key(time_secs: f64, position: DVec3, forward: DVec3, up: DVec3) -> Keyframe {
    Keyframe {
        time_secs,
        pose: Pose::facing(position, forward.normalize(), up, None),
        fov_y_rad: FOV_Y_DEG.to_radians(),
        focus_distance: None,
        optics: cinesplat::trajectory::KeyOptics::default(),
        easing: Easing::Smooth,
        cut: false,
        intent: Some(Intent { subjects: vec![7], ..Intent::default() }),
    }
}

/// A travel of one unit along x, level, looking along -z.
pub fn travel() -> Shot {
    let at = |x: f64| DVec3::new(x, 1.2, 0.5);
    let keys = vec![key(0.0, at(-0.5), DVec3::NEG_Z, DVec3::Y), key(4.0, at(0.5), DVec3::NEG_Z, DVec3::Y)];
    Shot { prompt: "truck right".to_owned(), ..shot_over(keys) }
}

/// The map of a shot in the room.
pub fn mapped(shot: &Shot) -> Drawing {
    let (scene, objects) = room();
    draw(&scene, &objects, shot).unwrap()
}

/// Upper left corner and size of the views' pictures: plan, elevation.
pub fn views(drawing: &Drawing) -> Vec<(DVec2, DVec2)> {
    let view = |mark: &Mark| match mark {
        Mark::Picture { corner_px, size_px, .. } => Some((*corner_px, *size_px)),
        _ => None,
    };
    drawing.marks.iter().filter_map(view).collect()
}

/// Position and words of every text.
pub fn texts(drawing: &Drawing) -> Vec<(DVec2, &str)> {
    drawing
        .marks
        .iter()
        .filter_map(|mark| match mark {
            Mark::Text { at_px, text, .. } => Some((*at_px, text.as_str())),
            _ => None,
        })
        .collect()
}

/// Outlines of the filled areas in a color and opacity.
pub fn areas(drawing: &Drawing, ink: Ink) -> Vec<Vec<DVec2>> {
    let area = |mark: &Mark| match mark {
        Mark::Area { outline_px, fill: Some(fill), .. } if *fill == ink => Some(outline_px.clone()),
        _ => None,
    };
    drawing.marks.iter().filter_map(area).collect()
}

/// Middle of the first black mark in the plan: the disc of the first key.
pub fn first_key_px(drawing: &Drawing) -> DVec2 {
    let discs = areas(drawing, Ink::new([24, 24, 28]));
    middle(discs.iter().find(|disc| disc.len() == 40).unwrap())
}

/// Middle of the box around points.
pub fn middle(points: &[DVec2]) -> DVec2 {
    let low = points.iter().copied().reduce(DVec2::min).unwrap();
    let high = points.iter().copied().reduce(DVec2::max).unwrap();
    (low + high) / 2.0
}
