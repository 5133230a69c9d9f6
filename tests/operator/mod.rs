//! The operator on a small synthetic room.

mod backdrops;
mod clearance;
mod composition;
mod crowded;
mod edges;
mod ends;
mod finalists;
mod flow;
mod forbidden;
mod intents;
mod limits;
mod looks;
mod moves;
mod overhead;
mod passes;
mod places;
mod proof;
mod route;
mod sides;
mod square;
mod tables;
mod viewpoints;
mod ways;
mod wholes;

use cinesplat::objects::{Object, ObjectSet};
use cinesplat::operator::{Program, SIGMA_LEVEL, Solution, SolveLevel, SolveSettings, Step, World, realize};
use cinesplat::scene::{Gaussians, SOLID_OPACITY};
use cinesplat::trajectory::{CameraPath, CameraState, Shot};
use glam::{DVec3, Quat, Vec3};

use crate::support::shot_over;

/// Half extents of the room about the vertical axis, and its height.
pub const ROOM: DVec3 = DVec3::new(3.0, 2.6, 3.0);

/// A room of floor and four walls with two boxes in it: 1 near one corner, 2 across from it. Up is +y, floor y = 0.
pub fn room() -> (Gaussians, ObjectSet) {
    let mut gaussians = Gaussians::default();
    wall(&mut gaussians, DVec3::new(-3.0, 0.0, -3.0), DVec3::X * 6.0, DVec3::Z * 6.0);
    for (corner, along) in [
        (DVec3::new(-3.0, 0.0, -3.0), DVec3::X),
        (DVec3::new(-3.0, 0.0, 3.0), DVec3::X),
        (DVec3::new(-3.0, 0.0, -3.0), DVec3::Z),
        (DVec3::new(3.0, 0.0, -3.0), DVec3::Z),
    ] {
        wall(&mut gaussians, corner, along * 6.0, DVec3::Y * ROOM.y);
    }
    let boxes = [
        (1, DVec3::new(1.2, 0.6, 0.9), DVec3::new(0.3, 0.6, 0.3)),
        (2, DVec3::new(-1.2, 0.5, 0.8), DVec3::new(0.4, 0.5, 0.3)),
    ];
    let objects = boxes.map(|(id, center, half)| {
        let first = gaussians.len();
        for axis in 0..3 {
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            for side in [-1.0, 1.0] {
                let mut corner = center - half;
                corner[axis] = center[axis] + side * half[axis];
                let (mut du, mut dv) = (DVec3::ZERO, DVec3::ZERO);
                du[u] = 2.0 * half[u];
                dv[v] = 2.0 * half[v];
                wall(&mut gaussians, corner, du, dv);
            }
        }
        Object { num_gaussians: gaussians.len() - first, ..Object::from_box(id, &format!("box {id}"), center, half) }
    });
    (gaussians, ObjectSet { objects: objects.to_vec(), labels: Vec::new() })
}

/// Adds a Gaussian.
pub fn add(gaussians: &mut Gaussians, mean: DVec3, scales: Vec3, rotation: Quat, opacity: f32) {
    gaussians.means.push(mean.as_vec3());
    gaussians.scales.push(scales);
    gaussians.rotations.push(rotation);
    gaussians.opacities.push(opacity);
    gaussians.sh_dc.push(Vec3::ZERO);
}

/// Distance from a point to the ellipsoid of one Gaussian, 0 inside, by bisection of the distance's equation.
pub fn bisected(gaussians: &Gaussians, i: usize, point: DVec3) -> f64 {
    let y = gaussians.rotations[i].as_dquat().normalize().conjugate() * (point - gaussians.mean_world(i));
    let e = (gaussians.scales[i].as_dvec3() * SIGMA_LEVEL).max(DVec3::splat(1e-12));
    let sum = |t: f64| (e * y / (e * e + t)).length_squared();
    if sum(0.0) <= 1.0 {
        return 0.0;
    }
    let (mut low, mut high): (f64, f64) = (0.0, y.length() * e.max_element());
    for _ in 0..200 {
        let middle = low.midpoint(high);
        if sum(middle) > 1.0 { low = middle } else { high = middle }
    }
    y.distance(e * e * y / (e * e + high))
}

/// Distance from a point to the nearest ellipsoid of a solid Gaussian, and the index of that Gaussian, by brute force.
pub fn brute_force(gaussians: &Gaussians, point: DVec3) -> (f64, usize) {
    let mut best = (f64::INFINITY, 0);
    for i in (0..gaussians.len()).filter(|&i| gaussians.opacities[i] >= SOLID_OPACITY) {
        let reach = SIGMA_LEVEL * f64::from(gaussians.scales[i].max_element());
        if gaussians.mean_world(i).distance(point) - reach < best.0 {
            let distance = bisected(gaussians, i, point);
            best = if distance < best.0 { (distance, i) } else { best };
        }
    }
    best
}

/// A parallelogram of round, opaque Gaussians 6 cm apart.
pub fn wall(gaussians: &mut Gaussians, corner: DVec3, u: DVec3, v: DVec3) {
    let count = |side: DVec3| (side.length() / 0.06).ceil() as usize;
    for i in 0..=count(u) {
        for j in 0..=count(v) {
            let at = corner + u * (i as f64 / count(u) as f64) + v * (j as f64 / count(v) as f64);
            add(gaussians, at, Vec3::splat(0.03), Quat::IDENTITY, 0.95);
        }
    }
}

/// The room prepared for planning.
pub fn world() -> World {
    let (gaussians, objects) = room();
    World::new(&gaussians, DVec3::Y, &objects, &[1, 2]).unwrap()
}

/// The solution of a program at the fast level with a fixed seed.
pub fn solved(world: &World, steps: Vec<Step>) -> Solution {
    let program = Program { steps, ..Program::default() };
    realize(world, &program, "", &[], &SolveSettings { level: SolveLevel::Fast, seed: 7, ..SolveSettings::default() })
}

/// The cameras of a solution at ten frames per second, and at its end.
pub fn film(solution: &Solution) -> Vec<CameraState> {
    let shot = Shot { fps: 10.0, duration_secs: solution.duration_secs, ..shot_over(solution.keyframes.clone()) };
    let path = CameraPath::new(&shot).unwrap();
    let frames = (0..shot.num_frames()).map(|k| path.sample(shot.frame_time_secs(k)));
    frames.chain([path.sample(solution.duration_secs)]).collect()
}
