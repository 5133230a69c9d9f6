//! The critic on hand-made scenes with known answers.

mod choice;
pub mod fronts;
mod limits;
mod pictures;

use cinesplat::critic::{Critic, CriticSettings, Film, Picture, Review, Subjects};
use cinesplat::geometry::{LevelFrame, Pose};
use cinesplat::objects::{Object, ObjectSet};
use cinesplat::operator::Sighting;
use cinesplat::scene::{Gaussians, Scene, UpSource};
use cinesplat::trajectory::{CameraPath, CameraState, Easing, Keyframe};
use glam::{DQuat, DVec3, Quat, Vec3};

/// Size of the films' frames.
const SIZE_PX: [u32; 2] = [1280, 720];
/// Vertical field of view of the films.
const FOV_RAD: f64 = 50.0 * std::f64::consts::PI / 180.0;
/// Distance between the Gaussians of a wall, and their standard deviation.
const STEP: f64 = 0.06;
const SIGMA: f32 = 0.04;

/// Adds an upright wall across the view axis at a depth, opaque, from one corner to the other. `rgb` colors each column and
/// row.
fn wall(scene: &mut Gaussians, (left, right): (f64, f64), depth: f64, rgb: impl Fn(i64, i64) -> Vec3) {
    sheet(scene, ([left, -3.0], [right, 3.0]), (depth, 0.99), rgb);
}

/// Adds a sheet of an opacity from corner to corner (x and y).
fn sheet(
    scene: &mut Gaussians,
    (low, high): ([f64; 2], [f64; 2]),
    (depth, opacity): (f64, f32),
    rgb: impl Fn(i64, i64) -> Vec3,
) {
    let num = |axis: usize| ((high[axis] - low[axis]) / STEP).round() as i64;
    for (column, row) in (0..=num(0)).flat_map(|column| (0..=num(1)).map(move |row| (column, row))) {
        let at = DVec3::new(low[0] + column as f64 * STEP, low[1] + row as f64 * STEP, depth);
        scene.means.push(at.as_vec3());
        scene.scales.push(Vec3::new(SIGMA, SIGMA, 0.001));
        scene.rotations.push(Quat::IDENTITY);
        scene.opacities.push(opacity);
        scene.sh_dc.push((rgb(column, row) - 0.5) / 0.282_094_8);
    }
}

fn gray(_: i64, _: i64) -> Vec3 {
    Vec3::splat(0.5)
}

/// A scene with y down and its objects, ready to be judged.
struct Stage {
    scene: Scene,
    subjects: Subjects,
}

impl Stage {
    fn new(gaussians: Gaussians, objects: Vec<Object>) -> Self {
        let ids: Vec<u32> = objects.iter().map(|object| object.id).collect();
        let subjects = Subjects::new(&gaussians, &ObjectSet { objects, labels: Vec::new() }, &ids);
        let scene = Scene {
            path: "made".into(),
            sha256: String::new(),
            format: "made".to_owned(),
            gaussians,
            dropped: Vec::new(),
            filter: None,
            up: -DVec3::Y,
            up_source: UpSource::Flag,
            notes: Vec::new(),
        };
        Self { scene, subjects }
    }

    fn judged<T>(&self, num_moments: usize, with: impl FnOnce(&Critic<'_>) -> T) -> T {
        let settings = CriticSettings { num_moments, ..CriticSettings::default() };
        with(&Critic::new((&self.scene, &self.scene.bounds()), &self.subjects, settings))
    }

    /// A picture from the origin along +z.
    fn picture(&self) -> Picture {
        let state = state(DVec3::ZERO);
        self.judged(2, |critic| critic.look(&state, 0.0, SIZE_PX).unwrap())
    }

    fn review(&self, film: &Film, num_moments: usize) -> Review {
        self.judged(num_moments, |critic| critic.review(film, None).unwrap())
    }
}

/// A camera that looks along +z.
fn state(position: DVec3) -> CameraState {
    CameraState { pose: Pose::new(position, DQuat::IDENTITY), fov_y_rad: FOV_RAD, focus_distance: None }
}

/// A film of ten seconds in a straight line at even speed, looking along +z, that should show some objects throughout.
fn film(from: DVec3, to: DVec3, objects: &[u32]) -> Film {
    let key = |time_secs: f64, position: DVec3| Keyframe {
        time_secs,
        pose: Pose::new(position, DQuat::IDENTITY),
        fov_y_rad: FOV_RAD,
        focus_distance: None,
        optics: cinesplat::trajectory::KeyOptics::default(),
        easing: Easing::Linear,
        cut: false,
        intent: None,
    };
    let frame = LevelFrame::new(-DVec3::Y).unwrap();
    Film {
        path: CameraPath::fine(vec![key(0.0, from), key(10.0, to)], frame),
        duration_secs: 10.0,
        size_px: SIZE_PX,
        sightings: objects.iter().map(|&object| Sighting { object, from_secs: 0.0, to_secs: 10.0 }).collect(),
        foregrounds: Vec::new(),
        is_indoor: true,
        cost_per_step: 0.0,
    }
}
