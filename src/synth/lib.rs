//! Procedural scenes: furnished rooms and still lifes made of Gaussians, with exact objects.
//!
//! Enters: a seed. Leaves: [`SynthScene`], the same bytes for the same settings on any machine and any number of threads.
//! World: y up, m, floor at y = 0, the main group at -z, a walkable strip in the middle.
//!
//! The way through: a recipe (`rooms`) throws a room and places objects of the catalog (`models`); every object is a
//! list of parts (`shape`) with a material (`paint`); parts are covered with flat Gaussians (`surfel`); light from
//! windows, sun and lamps is baked by casting rays at simple stand-ins of the parts (`bake`, `ray`), exposed and
//! written as spherical harmonics (`tone`).

mod bake;
mod color;
mod dice;
mod footprint;
mod model;
mod models;
mod naming;
mod noise;
mod paint;
mod pictures;
mod place;
mod radiance;
mod ray;
mod rooms;
mod shape;
mod shell;
mod stage;
mod surfel;
mod tone;

use glam::{DQuat, DVec3};
use rayon::prelude::*;

use self::bake::RayCounts;
use self::place::Place;
use self::ray::Blockers;
use self::rooms::Plan;
use self::shape::Part;
use self::surfel::Surfel;
use cinesplat_scene::Gaussians;

/// Width of a cell of the surface at detail 1, m.
const CELL: f64 = 0.02;

/// Exponent of the cell width over the detail: a little under -1/2, since small parts keep their few cells however coarse
/// the rest is.
const CELL_POWER: f64 = -0.6;

/// Detail from which polished things get a view-dependent sheen (degree 1).
const SHEEN_DETAIL: f64 = 0.5;

/// What kind of scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SynthKind {
    /// A furnished room: living, dining or bed room, kitchen, study, studio, workshop.
    Room,
    /// A still life on a table in the middle of a room.
    Tabletop,
}

/// Which scene to make.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SynthSettings {
    /// Decides everything: another seed is another room.
    pub seed: u64,
    /// Room or still life.
    pub kind: SynthKind,
    /// Number of Gaussians relative to film quality: 1 is some hundred thousand, 0.1 is enough to train on. 0.01..=4.
    pub detail: f64,
}

impl SynthSettings {
    /// The room of the demo and the README.
    pub fn demo() -> Self {
        Self { seed: 31, kind: SynthKind::Room, detail: 1.0 }
    }
}

/// A box with a name.
#[derive(Debug, Clone, PartialEq)]
pub struct SynthObject {
    /// Identity from 1, the value in [`SynthScene::labels`].
    pub id: u32,
    /// Name that no other object of the scene has, such as `green armchair`.
    pub label: String,
    /// Box center, world.
    pub center: DVec3,
    /// Half extents along the box's own axes: the smallest box around the one-sigma ellipsoids of its Gaussians, which is
    /// the outline of the shape to a fraction of a cell.
    pub half_extents: DVec3,
    /// Box axes to world: the turn of the object about the upright axis.
    pub rotation: DQuat,
}

/// A scene with exact objects.
#[derive(Debug, Clone, PartialEq)]
pub struct SynthScene {
    /// The Gaussians; display colors, degree 0 or 1.
    pub gaussians: Gaussians,
    /// Objects in order of id.
    pub objects: Vec<SynthObject>,
    /// Object id of each Gaussian; 0 = floor, walls, ceiling, the view outside.
    pub labels: Vec<u16>,
    /// World up.
    pub up: DVec3,
    /// Center and half extents of a box, along the world's axes, that holds nothing: room for a camera.
    pub free_space: [DVec3; 2],
}

/// Makes a scene.
pub fn generate(settings: &SynthSettings) -> SynthScene {
    let detail = settings.detail.clamp(0.01, 4.0);
    let plan = rooms::plan(settings.seed, settings.kind);
    let blockers = Blockers::new(stand_ins(&plan));
    let surfels = cover(&plan, &blockers, CELL * detail.powf(CELL_POWER));
    let baked = bake::bake(&surfels, &blockers, &plan.lights, ray_counts(detail));
    let toned = tone::tone(&surfels, &baked);
    let sh_degree = u8::from(detail >= SHEEN_DETAIL);
    let gaussians = Gaussians {
        origin: DVec3::ZERO,
        means: surfels.iter().map(|s| s.mean).collect(),
        scales: surfels.iter().map(|s| s.scale).collect(),
        rotations: surfels.iter().map(|s| s.rotation).collect(),
        opacities: surfels.iter().map(|s| s.opacity).collect(),
        sh_dc: toned.dc,
        sh_degree,
        sh_rest: if sh_degree == 1 { toned.first } else { Vec::new() },
        ids: Vec::new(),
    };
    let labels = surfels.iter().map(|s| s.object).collect();
    SynthScene { objects: objects(&plan, &surfels), gaussians, labels, up: DVec3::Y, free_space: plan.free }
}

fn ray_counts(detail: f64) -> RayCounts {
    if detail >= SHEEN_DETAIL {
        RayCounts { portal: 16, point: 4, gather: 18, grid: 1.0 }
    } else if detail > 0.15 {
        RayCounts { portal: 8, point: 2, gather: 10, grid: 1.4 }
    } else {
        RayCounts { portal: 2, point: 1, gather: 2, grid: 2.2 }
    }
}

/// Every part of the scene with its place in the world and its owner: object id and number of the part.
fn parts(plan: &Plan) -> impl Iterator<Item = (&Part, Place, (u16, u32))> {
    let room = plan.room.parts.iter().map(|part| (part, Place::at(DVec3::ZERO), 0));
    let objects = plan.items.iter().enumerate();
    let objects =
        objects.flat_map(|(i, item)| item.model.parts.iter().map(move |part| (part, item.place, i as u16 + 1)));
    room.chain(objects).enumerate().map(|(i, (part, place, object))| (part, place, (object, i as u32)))
}

/// All surfels that can be seen from somewhere, the room's first, then object by object.
fn cover(plan: &Plan, blockers: &Blockers, step: f64) -> Vec<Surfel> {
    let all: Vec<_> = parts(plan).collect();
    let covered: Vec<Vec<Surfel>> = all
        .par_iter()
        .map(|(part, place, (object, number))| {
            let mut surfels = part.surfels(place, *object, step);
            surfels.retain(|surfel| !surfel.hidden(blockers, *number));
            surfels
        })
        .collect();
    covered.concat()
}

fn stand_ins(plan: &Plan) -> Vec<ray::Blocker> {
    let mut out = Vec::new();
    for (part, place, owner) in parts(plan) {
        part.blockers(&place, owner, &mut out);
    }
    out
}

/// Boxes of the one-sigma ellipsoids, in the turned frame of each object.
fn objects(plan: &Plan, surfels: &[Surfel]) -> Vec<SynthObject> {
    let mut reach = vec![(DVec3::INFINITY, DVec3::NEG_INFINITY); plan.items.len()];
    for surfel in surfels.iter().filter(|s| s.object > 0) {
        let i = usize::from(surfel.object) - 1;
        let to_box = plan.items[i].place.rotation.conjugate();
        let (local, spread) = (to_box * surfel.mean.as_dvec3(), surfel.spread(to_box));
        reach[i] = (reach[i].0.min(local - spread), reach[i].1.max(local + spread));
    }
    let models: Vec<_> = plan.items.iter().map(|item| &item.model).collect();
    let names = naming::labels(&models);
    let boxed = |(i, label): (usize, String)| {
        let (low, high) = reach[i];
        let rotation = plan.items[i].place.rotation;
        // The margin is the rounding of f32 means.
        let half_extents = (high - low) / 2.0 + 1e-6;
        SynthObject { id: i as u32 + 1, label, center: rotation * ((low + high) / 2.0), half_extents, rotation }
    };
    names.into_iter().enumerate().map(boxed).collect()
}
