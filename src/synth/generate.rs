use glam::DVec3;
use rayon::prelude::*;

use super::bake;
use super::bake_quality::{BakeQuality, SHEEN_DETAIL};
use super::bvh::OccluderBvh;
use super::naming;
use super::occluder::{Occluder, Owner};
use super::placement::Placement;
use super::primitive::Primitive;
use super::rooms::{self, RoomLayout};
use super::scene::{SynthObject, SynthScene};
use super::settings::SynthSettings;
use super::surfel::Surfel;
use super::tone_map;
use cinesplat_scene::Gaussians;

/// Width of a surface cell at detail 1, m.
const CELL: f64 = 0.02;

/// The cell width is proportional to the detail to this power. It is slightly below -1/2: small primitives keep a
/// minimum number of cells at every detail, so the number of cells of the others must vary more.
const CELL_POWER: f64 = -0.6;

/// Generates a scene. A detail outside 0.01..=4 is clamped.
pub fn generate(settings: &SynthSettings) -> SynthScene {
    let detail = settings.detail.clamp(0.01, 4.0);
    let layout = rooms::lay_out(settings.seed, settings.kind);
    let occluders = OccluderBvh::new(shadow_proxies(&layout));
    let surfels = visible_surfels(&layout, &occluders, CELL * detail.powf(CELL_POWER));
    let baked = bake::bake(&surfels, &occluders, &layout.lights, BakeQuality::for_detail(detail));
    let toned = tone_map::tone_map(&surfels, &baked);
    let sh_degree = u8::from(detail >= SHEEN_DETAIL);
    let gaussians = Gaussians {
        origin: DVec3::ZERO,
        means: surfels.iter().map(|s| s.mean).collect(),
        scales: surfels.iter().map(|s| s.scale).collect(),
        rotations: surfels.iter().map(|s| s.rotation).collect(),
        opacities: surfels.iter().map(|s| s.opacity).collect(),
        sh_dc: toned.degree_0,
        sh_degree,
        sh_rest: if sh_degree == 1 { toned.degree_1 } else { Vec::new() },
        ids: Vec::new(),
    };
    let labels = surfels.iter().map(|s| s.object).collect();
    let objects = objects(&layout, &surfels);
    SynthScene { gaussians, objects, labels, up: DVec3::Y, free_space: layout.free_space }
}

/// Every primitive of the scene with its placement in the world and its owner; the room's first, then object by object.
fn primitives(layout: &RoomLayout) -> impl Iterator<Item = (&Primitive, Placement, Owner)> {
    let room = layout.room.primitives.iter().map(|primitive| (primitive, Placement::at(DVec3::ZERO), 0));
    let objects = layout.objects.iter().enumerate().flat_map(|(i, placed)| {
        placed.asset.primitives.iter().map(move |primitive| (primitive, placed.world_from_object, i as u16 + 1))
    });
    room.chain(objects).enumerate().map(|(i, (primitive, world_from_object, object))| {
        (primitive, world_from_object, Owner { object, primitive: i as u32 })
    })
}

/// Surfels that a camera can see, in the order of [`primitives`].
fn visible_surfels(layout: &RoomLayout, occluders: &OccluderBvh, step: f64) -> Vec<Surfel> {
    let all: Vec<_> = primitives(layout).collect();
    let by_primitive: Vec<Vec<Surfel>> = all
        .par_iter()
        .map(|(primitive, world_from_object, owner)| {
            let mut surfels = primitive.surfels(world_from_object, owner.object, step);
            surfels.retain(|surfel| !surfel.is_hidden(occluders, owner.primitive));
            surfels
        })
        .collect();
    by_primitive.concat()
}

fn shadow_proxies(layout: &RoomLayout) -> Vec<Occluder> {
    let mut out = Vec::new();
    for (primitive, world_from_object, owner) in primitives(layout) {
        primitive.add_occluders(&world_from_object, owner, &mut out);
    }
    out
}

/// The objects with their boxes: bounds of the one-sigma ellipsoids in each object's rotated frame.
fn objects(layout: &RoomLayout, surfels: &[Surfel]) -> Vec<SynthObject> {
    let mut bounds = vec![(DVec3::INFINITY, DVec3::NEG_INFINITY); layout.objects.len()];
    for surfel in surfels.iter().filter(|s| s.object > 0) {
        let i = usize::from(surfel.object) - 1;
        let box_from_world = layout.objects[i].world_from_object.rotation.conjugate();
        let (local, half) = (box_from_world * surfel.mean.as_dvec3(), surfel.half_extents(box_from_world));
        bounds[i] = (bounds[i].0.min(local - half), bounds[i].1.max(local + half));
    }
    let assets: Vec<_> = layout.objects.iter().map(|placed| &placed.asset).collect();
    let with_box = |(i, label): (usize, String)| {
        let (low, high) = bounds[i];
        let rotation = layout.objects[i].world_from_object.rotation;
        // The margin covers the rounding of f32 means.
        let half_extents = (high - low) / 2.0 + 1e-6;
        SynthObject { id: i as u32 + 1, label, center: rotation * ((low + high) / 2.0), half_extents, rotation }
    };
    naming::labels(&assets).into_iter().enumerate().map(with_box).collect()
}
