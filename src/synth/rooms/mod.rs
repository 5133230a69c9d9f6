//! Recipes: which objects a kind of room holds and where they go.

mod bedroom;
mod dining;
mod kitchen;
mod living;
mod study;
mod tabletop;
mod workroom;

use glam::{DVec2, DVec3, Vec3};

use super::SynthKind;
use super::bake::{Lights, Sun};
use super::color::{NUM_PALETTES, Palette, SMALL_HUES, small_hue};
use super::dice::Dice;
use super::model::Model;
use super::models::{
    decor, devices, instruments, lamps, openings, plants, seats, storage, tables, tableware, textiles, walls,
};
use super::shell::{Finish, Flooring, Opening, Shell, Wall};
use super::stage::{Item, Stage};

/// Width of the strip that is kept free to walk, m.
const AISLE: f64 = 1.3;

/// Kinds of rooms.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Purpose {
    Living,
    Dining,
    Kitchen,
    Bedroom,
    Study,
    Studio,
    Workshop,
    Tabletop,
}

/// Time of day.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Daylight {
    Noon,
    Golden,
    Evening,
}

/// A furnished room, ready to be covered with surfels.
pub(super) struct Plan {
    /// Floor, walls, ceiling, outside.
    pub(super) room: Model,
    /// Objects.
    pub(super) items: Vec<Item>,
    /// Lights, lamps of the objects included.
    pub(super) lights: Lights,
    /// Free space: center and half extents of a box.
    pub(super) free: [DVec3; 2],
}

/// Furnishes a room of a kind from a seed.
pub(super) fn plan(seed: u64, kind: SynthKind) -> Plan {
    let mut dice = Dice::new(seed, 1);
    let palette = Palette::numbered(dice.index(NUM_PALETTES));
    let purpose = match kind {
        SynthKind::Tabletop => Purpose::Tabletop,
        SynthKind::Room => dice.pick([
            Purpose::Living,
            Purpose::Living,
            Purpose::Living,
            Purpose::Dining,
            Purpose::Kitchen,
            Purpose::Bedroom,
            Purpose::Study,
            Purpose::Studio,
            Purpose::Workshop,
        ]),
    };
    let daylight = dice.pick([Daylight::Noon, Daylight::Golden, Daylight::Golden, Daylight::Evening]);
    let shell = build_shell(&mut dice, purpose, daylight);
    let room = shell.model(&mut dice, &palette);
    let mut stage = Stage::new(&shell, &palette, Dice::new(seed, 2));
    let aisle = open_aisle(&mut stage, purpose);
    dress_windows(&mut stage, purpose);
    match purpose {
        Purpose::Living => living::furnish(&mut stage, aisle),
        Purpose::Dining => dining::furnish(&mut stage, aisle),
        Purpose::Kitchen => kitchen::furnish(&mut stage, aisle),
        Purpose::Bedroom => bedroom::furnish(&mut stage, aisle),
        Purpose::Study => study::furnish(&mut stage, aisle),
        Purpose::Studio => workroom::furnish_studio(&mut stage, aisle),
        Purpose::Workshop => workroom::furnish_workshop(&mut stage, aisle),
        Purpose::Tabletop => tabletop::furnish(&mut stage),
    }
    let (middle, half) = stage.reserved.first().map_or((DVec2::ZERO, DVec2::ZERO), |r| (r.center, r.half));
    let free = [DVec3::new(middle.x, 1.075, middle.y), DVec3::new(half.x, 1.025, half.y)];
    let items = stage.items;
    let lights = light(&mut dice, &shell, &items, daylight);
    Plan { room, items, lights, free }
}

fn build_shell(dice: &mut Dice, purpose: Purpose, daylight: Daylight) -> Shell {
    let half = match purpose {
        Purpose::Living | Purpose::Kitchen => DVec2::new(dice.range(2.9, 3.4), dice.range(2.75, 3.1)),
        Purpose::Tabletop => DVec2::new(dice.range(2.3, 2.7), dice.range(2.3, 2.7)),
        _ => DVec2::new(dice.range(2.5, 3.0), dice.range(2.6, 2.95)),
    };
    let side = if dice.chance(0.6) { Wall::Left } else { Wall::Right };
    let (sill, tall) = (dice.range(0.78, 0.92), dice.range(1.35, 1.5));
    let mut openings = Vec::new();
    // Seen from inside, the right of the left wall is the back of the room.
    let toward_back = if side == Wall::Left { 1.0 } else { -1.0 };
    let wide = dice.range(1.2, 1.7);
    openings.push(Opening { wall: side, at: toward_back * dice.range(0.5, 0.9), sill, size: [wide, tall] });
    if dice.chance(0.6) {
        openings.push(Opening { wall: side, at: -toward_back * (half.y - 0.9), sill, size: [1.0, tall] });
    }
    let floors = match purpose {
        Purpose::Kitchen => [Flooring::Tiles, Flooring::Tiles, Flooring::Boards],
        Purpose::Workshop => [Flooring::Boards, Flooring::Tiles, Flooring::Boards],
        _ => [Flooring::Boards, Flooring::Herringbone, Flooring::Boards],
    };
    let finish = match purpose {
        Purpose::Kitchen => Finish::Painted,
        Purpose::Workshop | Purpose::Studio => dice.pick([Finish::Brick, Finish::Painted]),
        _ => dice.pick([Finish::Painted, Finish::Paneled, Finish::Striped, Finish::Paneled, Finish::Brick]),
    };
    let outside = match daylight {
        Daylight::Noon => Vec3::splat(1.25),
        Daylight::Golden => Vec3::new(1.5, 1.1, 0.75),
        Daylight::Evening => Vec3::new(0.1, 0.14, 0.26),
    };
    let height = dice.range(2.65, 2.95);
    Shell { half, height, openings, flooring: dice.pick(floors), finish, ceiling: dice.chance(0.88), outside }
}

/// Reserves the strip to walk and returns its limits along z; around a tabletop's table the front half.
fn open_aisle(stage: &mut Stage, purpose: Purpose) -> [f64; 2] {
    let half = stage.shell.half;
    let low = match purpose {
        Purpose::Tabletop => half.y - 1.5,
        Purpose::Bedroom => -half.y + 2.75,
        Purpose::Kitchen => -half.y + 0.88,
        _ => -half.y + 2.45,
    };
    stage.reserve_aisle(low, low + AISLE);
    [low, low + AISLE]
}

/// Windows into their openings, curtains beside most, and a door where the aisle meets the other side.
fn dress_windows(stage: &mut Stage, purpose: Purpose) {
    let openings = stage.shell.openings.clone();
    let hue = if stage.dice.chance(0.5) { stage.palette.light } else { stage.palette.second };
    let hung = !matches!(purpose, Purpose::Workshop | Purpose::Kitchen);
    for opening in openings {
        let bars = if opening.size[0] > 1.15 { [3, 2] } else { [2, 2] };
        let window = openings::window(opening.size, bars);
        stage.hang(window, opening.wall, [opening.at, opening.sill - 0.055]);
        if hung {
            let drop = (opening.sill + opening.size[1] + 0.14).min(stage.shell.height - 0.15) - 0.03;
            let curtains = textiles::curtains(&mut stage.dice, &hue, opening.size[0], drop);
            let off = DVec3::new(opening.at, 0.0, 0.2);
            let at = stage.shell.wall_place(opening.wall).apply(off);
            stage.stand(curtains, DVec2::new(at.x, at.z), opening.wall.yaw_rad());
        }
    }
    let windows = stage.shell.openings.first().map_or(Wall::Left, |o| o.wall);
    let across = if windows == Wall::Left { Wall::Right } else { Wall::Left };
    let hue = if stage.dice.chance(0.6) { stage.palette.light } else { stage.palette.feature };
    let middle = stage.reserved.first().map_or(0.0, |r| r.center.y);
    let along = if across == Wall::Right { middle } else { -middle };
    let door = openings::door(&mut stage.dice, &hue);
    stage.hang(door, across, [along, 0.0]);
}

fn light(dice: &mut Dice, shell: &Shell, items: &[Item], daylight: Daylight) -> Lights {
    let (sky, sun, lamp) = match daylight {
        Daylight::Noon => (Vec3::new(3.2, 3.4, 3.7), Vec3::new(15.0, 13.4, 11.0), 0.35),
        Daylight::Golden => (Vec3::new(2.9, 2.6, 2.4), Vec3::new(19.0, 12.0, 6.0), 0.6),
        Daylight::Evening => (Vec3::new(0.16, 0.24, 0.42), Vec3::ZERO, 0.9),
    };
    let portals = shell.openings.iter().map(|opening| shell.portal(opening, sky)).collect();
    let side = shell.openings.first().map_or(Wall::Left, |o| o.wall);
    let (turn, lift) = (dice.range(-0.6, 0.6), dice.range(0.45, 0.72));
    let outward = shell.wall_place(side).rotation * DVec3::NEG_Z;
    let level = glam::DQuat::from_rotation_y(turn) * outward;
    let toward = (level * lift.cos() + DVec3::Y * lift.sin()).as_vec3();
    let sun = (sun != Vec3::ZERO).then_some(Sun { toward, irradiance: sun });
    let mut lamps = Vec::new();
    for Item { model, place } in items {
        for own in &model.lamps {
            let center = place.apply(own.center.as_dvec3()).as_vec3();
            lamps.push(super::bake::Lamp { center, intensity: own.intensity * lamp, ..*own });
        }
    }
    if daylight == Daylight::Evening && lamps.is_empty() {
        let center = Vec3::new(0.0, shell.height as f32 - 0.25, 0.0);
        lamps.push(super::bake::Lamp { center, radius: 0.15, intensity: Vec3::new(1.0, 0.75, 0.5) });
    }
    let ambient = sky * 0.012 + Vec3::splat(0.008);
    Lights { portals, sun, lamps, ambient }
}

/// A small thing for a table or a sideboard.
fn trinket(stage: &mut Stage) -> Model {
    let (dice, palette) = (&mut stage.dice, stage.palette);
    let hue = small_hue(dice.index(SMALL_HUES));
    match dice.index(9) {
        0 => decor::vase(dice, &hue, &palette),
        1 => storage::book_stack(dice, &palette),
        2 => lamps::candle(dice, &palette),
        3 => plants::small_plant(dice, &hue),
        4 => decor::sculpture(dice, &palette),
        5 => decor::globe(dice, &palette),
        6 => devices::radio(dice, &hue),
        7 => plants::cactus(dice, &hue),
        _ => decor::vase(dice, &palette.accent, &palette),
    }
}

/// Something to eat or drink from.
fn tableware_piece(stage: &mut Stage) -> Model {
    let dice = &mut stage.dice;
    let hue = small_hue(dice.index(SMALL_HUES));
    match dice.index(6) {
        0 => tableware::mug(dice, &hue),
        1 => tableware::teapot(dice, &hue),
        2 => tableware::fruit_bowl(dice, &hue),
        3 => tableware::bottle(dice, &hue),
        4 => tableware::wine_glass(dice),
        _ => tableware::plate(dice, &hue),
    }
}

/// A large thing for a free place on the floor.
fn floor_piece(stage: &mut Stage) -> Model {
    let (dice, palette) = (&mut stage.dice, stage.palette);
    match dice.index(9) {
        0 | 1 => plants::potted_plant(dice, &palette.light),
        2 => instruments::guitar(dice, &palette),
        3 => storage::basket(dice, &palette),
        4 => seats::pouf(dice, &palette.second),
        5 => decor::telescope(&palette),
        6 => storage::bookshelf(dice, &palette),
        7 => lamps::floor_lamp(dice, &palette),
        _ => decor::easel(dice, &palette),
    }
}

/// Pictures, a clock, a mirror or a shelf on the walls where there is room.
fn hang_things(stage: &mut Stage, count: usize) {
    for _ in 0..count {
        let wall = stage.dice.pick(Wall::ALL);
        let palette = stage.palette;
        let one_clock = stage.items.iter().any(|item| item.model.kind == "clock");
        let (model, height) = match stage.dice.index(6) {
            0 if !one_clock => (walls::clock(&mut stage.dice, &palette), 1.75),
            1 => (walls::mirror(&mut stage.dice), 1.25),
            2 => (storage::wall_shelf(&mut stage.dice, &palette), 1.45),
            _ => {
                let size = stage.dice.pick([[0.5, 0.7], [0.8, 0.6], [0.6, 0.6], [0.45, 0.6]]);
                (walls::picture(&mut stage.dice, &palette, size), 1.6 - size[1] / 2.0)
            }
        };
        stage.hang_along(&model, wall, height);
    }
}

/// Fills free places along the walls with large things.
fn fill_floor(stage: &mut Stage, count: usize) {
    for _ in 0..count {
        let model = floor_piece(stage);
        stage.anywhere(&model);
    }
}

/// Chairs at the long sides of a table that stands along x, and at its heads.
fn chairs_around(stage: &mut Stage, table: Option<usize>, heads: bool) {
    let Some(print) = stage.print_of(table) else { return };
    let wood = super::paint::Paint::wood(stage.palette.wood.linear, 5);
    let seat = if stage.dice.chance(0.5) { super::paint::Paint::cloth(stage.palette.accent.linear, 6) } else { wood };
    let style = stage.dice.seed();
    let chair = seats::chair(style, wood, seat);
    let out = chair.size().z / 2.0 + 0.035;
    let extent = print.extent();
    let quarter = extent.x * 0.48;
    for (x, side) in [(-quarter, 1.0), (quarter, 1.0), (-quarter, -1.0), (quarter, -1.0)] {
        let wobble = stage.dice.range(-0.12, 0.12);
        let at = print.center + DVec2::new(x, side * (extent.y + out + stage.dice.range(0.02, 0.07)));
        // Its front looks at the table.
        let yaw = if side > 0.0 { std::f64::consts::PI } else { 0.0 };
        stage.stand(chair.clone(), at, yaw + wobble);
    }
    if heads {
        for side in [-1.0, 1.0] {
            let at = print.center + DVec2::new(side * (extent.x + out + 0.04), 0.0);
            stage.stand(chair.clone(), at, -side * std::f64::consts::FRAC_PI_2);
        }
    }
}

/// A lamp at a chosen place on a table.
fn lamp_on(stage: &mut Stage, host: Option<usize>, frac: [f64; 2]) {
    let palette = stage.palette;
    let hue = if stage.dice.chance(0.5) { palette.accent } else { palette.second };
    let lamp = lamps::table_lamp(&mut stage.dice, &hue, &palette);
    stage.on_at(host, lamp, frac, 0.0);
}

/// The window's side of the room: -1 at -x, +1 at +x.
fn window_side(stage: &Stage) -> f64 {
    stage.shell.openings.first().map_or(-1.0, |o| if o.wall == Wall::Left { -1.0 } else { 1.0 })
}

/// A side table against something, with a lamp.
fn side_table_with_lamp(stage: &mut Stage, at: DVec2) {
    let palette = stage.palette;
    let table = tables::side_table(&mut stage.dice, &palette);
    let host = stage.stand(table, at, 0.0);
    lamp_on(stage, host, [0.0, 0.0]);
}
