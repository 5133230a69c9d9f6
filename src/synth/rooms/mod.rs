//! Recipes: the objects that each type of room holds, and their positions.
//!
//! Enters: a seed and a kind of scene. Leaves: a furnished room with its lights. Invariant: draws have a fixed order, so a
//! seed always gives the same room. Stream 1 of the seed draws the room and its light, stream 2 the furniture.

mod bedroom;
mod dining;
mod furnishing;
mod kitchen;
mod lighting;
mod living;
mod openings;
mod structure;
mod study;
mod tabletop;
mod workroom;

use glam::{DVec2, DVec3};

use super::asset::Asset;
use super::color::{NUM_PALETTES, Palette};
use super::lights::Lights;
use super::rng::SceneRng;
use super::scene_builder::{PlacedAsset, SceneBuilder};
use super::settings::SynthKind;
use structure::{Daylight, RoomType};

/// A furnished room: the input of tessellation and light baking.
pub(super) struct RoomLayout {
    /// Floor, walls, ceiling and the view through the windows, in the world's frame.
    pub(super) room: Asset,
    /// Objects with their placements.
    pub(super) objects: Vec<PlacedAsset>,
    /// Lights, the lamps of the objects included.
    pub(super) lights: Lights,
    /// Center and half extents of an empty box in the world.
    pub(super) free_space: [DVec3; 2],
}

/// Draws and furnishes a room.
pub(super) fn lay_out(seed: u64, kind: SynthKind) -> RoomLayout {
    let mut rng = SceneRng::new(seed, 1);
    let palette = Palette::numbered(rng.index(NUM_PALETTES));
    let room_type = match kind {
        SynthKind::Tabletop => RoomType::Tabletop,
        SynthKind::Room => rng.pick(&[
            RoomType::Living,
            RoomType::Living,
            RoomType::Living,
            RoomType::Dining,
            RoomType::Kitchen,
            RoomType::Bedroom,
            RoomType::Study,
            RoomType::Studio,
            RoomType::Workshop,
        ]),
    };
    let daylight = rng.pick(&[Daylight::Noon, Daylight::Golden, Daylight::Golden, Daylight::Evening]);
    let shell = structure::draw_shell(&mut rng, room_type, daylight);
    let room = shell.asset(&mut rng, &palette);
    let mut builder = SceneBuilder::new(&shell, &palette, SceneRng::new(seed, 2));
    let aisle = openings::reserve_aisle(&mut builder, room_type);
    openings::place_windows_and_door(&mut builder, room_type);
    match room_type {
        RoomType::Living => living::furnish(&mut builder, aisle),
        RoomType::Dining => dining::furnish(&mut builder, aisle),
        RoomType::Kitchen => kitchen::furnish(&mut builder, aisle),
        RoomType::Bedroom => bedroom::furnish(&mut builder, aisle),
        RoomType::Study => study::furnish(&mut builder, aisle),
        RoomType::Studio => workroom::furnish_studio(&mut builder, aisle),
        RoomType::Workshop => workroom::furnish_workshop(&mut builder, aisle),
        RoomType::Tabletop => tabletop::furnish(&mut builder),
    }
    let (middle, half) = builder.reserved.first().map_or((DVec2::ZERO, DVec2::ZERO), |r| (r.center, r.half));
    let free_space = [DVec3::new(middle.x, 1.075, middle.y), DVec3::new(half.x, 1.025, half.y)];
    let objects = builder.placed;
    let lights = lighting::lights(&mut rng, &shell, &objects, daylight);
    RoomLayout { room, objects, lights, free_space }
}
