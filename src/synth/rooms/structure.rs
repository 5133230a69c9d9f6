use glam::{DVec2, Vec3};

use crate::rng::SceneRng;
use crate::shell::{Finish, Flooring, Opening, Shell, Wall};

/// Type of a room: decides its proportions and furniture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum RoomType {
    /// Living room.
    Living,
    /// Dining room.
    Dining,
    /// Kitchen.
    Kitchen,
    /// Bedroom.
    Bedroom,
    /// Study.
    Study,
    /// Artist's studio.
    Studio,
    /// Workshop.
    Workshop,
    /// A room around the table of a still life.
    Tabletop,
}

/// Time of day: decides the light.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Daylight {
    /// High sun, neutral light.
    Noon,
    /// Low sun, warm light.
    Golden,
    /// No sun; lamps dominate.
    Evening,
}

/// Draws the proportions, windows and finishes of a room.
pub(super) fn draw_shell(rng: &mut SceneRng, room_type: RoomType, daylight: Daylight) -> Shell {
    let half = match room_type {
        RoomType::Living | RoomType::Kitchen => DVec2::new(rng.range(2.9, 3.4), rng.range(2.75, 3.1)),
        RoomType::Tabletop => DVec2::new(rng.range(2.3, 2.7), rng.range(2.3, 2.7)),
        _ => DVec2::new(rng.range(2.5, 3.0), rng.range(2.6, 2.95)),
    };
    let side = if rng.chance(0.6) { Wall::Left } else { Wall::Right };
    let (sill, tall) = (rng.range(0.78, 0.92), rng.range(1.35, 1.5));
    let mut openings = Vec::new();
    // Seen from inside, right along the left wall is toward the back of the room.
    let toward_back = if side == Wall::Left { 1.0 } else { -1.0 };
    let wide = rng.range(1.2, 1.7);
    openings.push(Opening { wall: side, at: toward_back * rng.range(0.5, 0.9), sill, size: [wide, tall] });
    if rng.chance(0.6) {
        openings.push(Opening { wall: side, at: -toward_back * (half.y - 0.9), sill, size: [1.0, tall] });
    }
    let floors = match room_type {
        RoomType::Kitchen => [Flooring::Tiles, Flooring::Tiles, Flooring::Boards],
        RoomType::Workshop => [Flooring::Boards, Flooring::Tiles, Flooring::Boards],
        _ => [Flooring::Boards, Flooring::Herringbone, Flooring::Boards],
    };
    let finish = match room_type {
        RoomType::Kitchen => Finish::Painted,
        RoomType::Workshop | RoomType::Studio => rng.pick(&[Finish::Brick, Finish::Painted]),
        _ => rng.pick(&[Finish::Painted, Finish::Paneled, Finish::Striped, Finish::Paneled, Finish::Brick]),
    };
    let outside = match daylight {
        Daylight::Noon => Vec3::splat(1.25),
        Daylight::Golden => Vec3::new(1.5, 1.1, 0.75),
        Daylight::Evening => Vec3::new(0.1, 0.14, 0.26),
    };
    let height = rng.range(2.65, 2.95);
    // Decides nothing any more; the draw keeps the rooms of each seed as they are.
    rng.chance(0.88);
    Shell { half, height, openings, flooring: rng.pick(&floors), finish, outside }
}
