use glam::{DVec2, DVec3};

use super::structure::RoomType;
use crate::assets::{openings, textiles};
use crate::scene_builder::SceneBuilder;
use crate::shell::Wall;

/// Width of the free aisle, m.
const AISLE_WIDTH: f64 = 1.3;

/// Reserves the aisle and returns its limits along z. In a tabletop scene it lies in front of the table.
pub(super) fn reserve_aisle(builder: &mut SceneBuilder, room_type: RoomType) -> [f64; 2] {
    let half = builder.shell.half;
    let low = match room_type {
        RoomType::Tabletop => half.y - 1.5,
        RoomType::Bedroom => -half.y + 2.75,
        RoomType::Kitchen => -half.y + 0.88,
        _ => -half.y + 2.45,
    };
    builder.reserve_aisle(low, low + AISLE_WIDTH);
    [low, low + AISLE_WIDTH]
}

/// Places windows in their openings, curtains at most of them, and a door at the aisle's end in the opposite wall.
pub(super) fn place_windows_and_door(builder: &mut SceneBuilder, room_type: RoomType) {
    let openings = builder.shell.openings.clone();
    let color = if builder.rng.chance(0.5) { builder.palette.light } else { builder.palette.second };
    let has_curtains = !matches!(room_type, RoomType::Workshop | RoomType::Kitchen);
    for opening in openings {
        let bars = if opening.size[0] > 1.15 { [3, 2] } else { [2, 2] };
        let window = openings::window(opening.size, bars);
        builder.hang_on_wall(window, opening.wall, [opening.at, opening.sill - 0.055]);
        if has_curtains {
            let drop = (opening.sill + opening.size[1] + 0.14).min(builder.shell.height - 0.15) - 0.03;
            let curtains = textiles::curtains(&mut builder.rng, &color, opening.size[0], drop);
            let off = DVec3::new(opening.at, 0.0, 0.2);
            let at = builder.shell.world_from_wall(opening.wall).apply(off);
            builder.place_on_floor(curtains, DVec2::new(at.x, at.z), opening.wall.yaw_rad());
        }
    }
    let window_wall = builder.shell.openings.first().map_or(Wall::Left, |o| o.wall);
    let door_wall = if window_wall == Wall::Left { Wall::Right } else { Wall::Left };
    let color = if builder.rng.chance(0.6) { builder.palette.light } else { builder.palette.feature };
    let middle = builder.reserved.first().map_or(0.0, |r| r.center.y);
    let along = if door_wall == Wall::Right { middle } else { -middle };
    let door = openings::door(&mut builder.rng, &color);
    builder.hang_on_wall(door, door_wall, [along, 0.0]);
}
