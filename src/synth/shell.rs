use std::f64::consts::{FRAC_PI_2, PI};

use glam::{DVec2, DVec3, Vec3};

use super::lights::Portal;
use super::placement::Placement;

/// A wall of a room.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[derive(strum::VariantArray)]
pub(super) enum Wall {
    /// At -z, behind the main furniture.
    Back,
    /// At +x.
    Right,
    /// At +z.
    Front,
    /// At -x.
    Left,
}

impl Wall {
    /// Yaw of objects with their back to the wall, rad.
    pub(super) fn yaw_rad(self) -> f64 {
        match self {
            Self::Back => 0.0,
            Self::Right => -FRAC_PI_2,
            Self::Front => PI,
            Self::Left => FRAC_PI_2,
        }
    }
}

/// A window opening, m.
#[derive(Debug, Clone, Copy)]
pub(super) struct Opening {
    /// Wall of the opening.
    pub(super) wall: Wall,
    /// Position of its middle from the wall's middle, to the right as seen from inside.
    pub(super) at: f64,
    /// Height of its lower edge.
    pub(super) sill: f64,
    /// Width and height.
    pub(super) size: [f64; 2],
}

/// Floor covering.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Flooring {
    /// Boards along x.
    Boards,
    /// Square tiles in two tones.
    Tiles,
    /// Slanted boards in a zigzag.
    Herringbone,
}

/// Finish of a wall.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Finish {
    /// Paint.
    Painted,
    /// Wallpaper with stripes.
    Striped,
    /// Paint above, panels on the lower third.
    Paneled,
    /// Bare bricks.
    Brick,
}

/// Proportions and finishes of a room. World: y up, m, centered in x and z, floor at y = 0.
pub(super) struct Shell {
    /// Half of the width (x) and of the depth (z).
    pub(super) half: DVec2,
    /// Height.
    pub(super) height: f64,
    /// Windows.
    pub(super) openings: Vec<Opening>,
    /// Floor covering.
    pub(super) flooring: Flooring,
    /// Finish of the back wall; the other walls are painted.
    pub(super) finish: Finish,
    /// Factor of the color of the view through the windows.
    pub(super) outside: Vec3,
}

impl Shell {
    /// World from wall. The wall's frame has its origin at the foot of the wall's middle, x to the right as seen from
    /// inside, z into the room.
    pub(super) fn world_from_wall(&self, wall: Wall) -> Placement {
        let at = match wall {
            Wall::Back => DVec3::new(0.0, 0.0, -self.half.y),
            Wall::Right => DVec3::new(self.half.x, 0.0, 0.0),
            Wall::Front => DVec3::new(0.0, 0.0, self.half.y),
            Wall::Left => DVec3::new(-self.half.x, 0.0, 0.0),
        };
        Placement::facing(at, wall.yaw_rad())
    }

    /// Half of the length of a wall.
    pub(super) fn half_length(&self, wall: Wall) -> f64 {
        if matches!(wall, Wall::Back | Wall::Front) { self.half.x } else { self.half.y }
    }

    /// The light portal of an opening.
    pub(super) fn portal(&self, opening: &Opening, radiance: Vec3) -> Portal {
        let world_from_wall = self.world_from_wall(opening.wall);
        let rotated = |v: DVec3| (world_from_wall.rotation * v).as_vec3();
        let center = world_from_wall.apply(DVec3::new(opening.at, opening.sill + opening.size[1] / 2.0, -0.05));
        Portal {
            center: center.as_vec3(),
            half_width: rotated(DVec3::X * opening.size[0] / 2.0),
            half_height: rotated(DVec3::Y * opening.size[1] / 2.0),
            inward: rotated(DVec3::Z),
            radiance,
        }
    }
}
