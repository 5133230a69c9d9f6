//! The moves of a path as a sentence, a table and JSON.

use std::fmt::Write as _;

use glam::DQuat;
use strum::VariantArray;

use super::describe::{DescribedMove, describe};
use super::named_move::{extent, unrolled, zoom_factor};
use super::{SubjectSphere, Trajectory};
use cinesplat_export::json_write::{Json, object};
use cinesplat_geometry::LevelFrame;
use cinesplat_plot::significant;
use cinesplat_trajectory::{Move, ShotAngle, ShotSize};

/// Digits of amounts.
const DIGITS: usize = 3;
/// Smallest net motion that words name, over the largest.
const NAMED_FRAC: f64 = 0.25;
/// Smallest net turn that words name, rad.
const NAMED_TURN_RAD: f64 = 0.035;
/// Smallest rise beside an arc, and arc beside a rise, that words name, over the length of the path.
const BESIDE_FRAC: f64 = 0.1;
/// Smallest sweep beside a rise that words name, rad.
const BESIDE_RAD: f64 = 0.1;
/// Smallest factor of the focal length that words name beside another move.
const NAMED_ZOOM: f64 = 1.05;

/// What a camera does: its moves, and the size of a subject where one is named.
#[derive(Debug, Clone, PartialEq)]
pub struct Description {
    /// The moves in order.
    pub moves: Vec<DescribedMove>,
    /// The subject whose size is told.
    pub subject: Option<SubjectSphere>,
}

/// The size of a subject at one moment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SizeBand {
    /// Its height over that of the frame.
    pub height_frac: f64,
    /// The name of that size.
    pub size: ShotSize,
}

impl Description {
    /// The description of a path that jumps to the poses `cuts`.
    pub fn new(path: &Trajectory, cuts: &[usize], subject: Option<SubjectSphere>) -> Self {
        Self { moves: describe(path, cuts), subject }
    }

    /// The moves as one sentence that a director understands.
    pub fn sentence(&self) -> String {
        let mut out = String::new();
        for (idx, found) in self.moves.iter().enumerate() {
            out += match (idx, found.is_cut) {
                (0, _) => "",
                (_, true) => ", cut, then ",
                _ => ", then ",
            };
            out += &words(found);
            let _ = write!(out, " for {}", seconds(found.to_secs - found.from_secs));
        }
        out
    }

    /// The moves as a table: times, move, amount, height of the camera's view, lens, and the subject's size.
    pub fn table(&self) -> String {
        let mut out =
            format!("{:>8} {:>8}  {:<15} {:<18} {:<23} {:<15}", "from s", "to s", "move", "amount", "angle", "fov deg");
        out += if self.subject.is_some() { " size\n" } else { "\n" };
        for found in &self.moves {
            let ends = self.ends(found);
            let between = |of: &dyn Fn(&End) -> String| {
                let [a, b] = [of(&ends[0]), of(&ends[1])];
                if a == b { a } else { format!("{a} to {b}") }
            };
            let name = found.movement.map_or("several at once", |found| found.name.into());
            let line = format!(
                "{:>8.2} {:>8.2}  {name:<15} {:<18} {:<23} {:<15} {}",
                found.from_secs,
                found.to_secs,
                amount(found).map_or(String::new(), |(value, unit)| format!("{} {unit}", significant(value, DIGITS))),
                between(&|end| end.angle.map_or("-".to_owned(), |angle| angle.to_string())),
                between(&|end| end.fov_y_deg.map_or("-".to_owned(), |fov| format!("{fov:.1}"))),
                between(&|end| end.size.map_or(String::new(), |size| size.size.to_string())),
            );
            out += line.trim_end();
            out.push('\n');
        }
        out
    }

    /// Sentence and moves as JSON text.
    pub fn to_json(&self) -> String {
        let item = |found: &DescribedMove| {
            let ends = self.ends(found);
            let amount = amount(found);
            let list = |of: &dyn Fn(&End) -> Json| Json::list(ends.iter().map(of));
            let name = |text: Option<&'static str>| text.map_or_else(Json::NULL, Json::from);
            object([
                ("from_secs", found.from_secs.into()),
                ("to_secs", found.to_secs.into()),
                ("move", name(found.movement.map(|found| found.name.into()))),
                ("amount", amount.map(|(value, _)| value).into()),
                ("unit", name(amount.map(|(_, unit)| unit))),
                ("cut", found.is_cut.into()),
                ("words", words(found).as_str().into()),
                ("path_length", found.path.path_length().into()),
                ("angle", list(&|end| name(end.angle.map(<&str>::from)))),
                ("fov_y_deg", list(&|end| end.fov_y_deg.into())),
                ("height_frac", list(&|end| end.size.map(|size| size.height_frac).into())),
                ("size", list(&|end| name(end.size.map(|size| size.size.into())))),
            ])
        };
        let moves = Json::list(self.moves.iter().map(item));
        object([("sentence", self.sentence().as_str().into()), ("moves", moves)]).pretty()
    }

    /// The camera at both ends of a move.
    fn ends(&self, found: &DescribedMove) -> [End; 2] {
        [0, found.path.len().saturating_sub(1)].map(|idx| {
            let fov_y_rad = found.path.fov_y_rad.get(idx).copied().flatten();
            let size = self.subject.zip(fov_y_rad).and_then(|(subject, fov)| size_of(&found.path, idx, &subject, fov));
            End { angle: angle_of(&found.path, idx), fov_y_deg: fov_y_rad.map(f64::to_degrees), size }
        })
    }
}

/// The camera at one end of a move.
struct End {
    angle: Option<ShotAngle>,
    fov_y_deg: Option<f64>,
    size: Option<SizeBand>,
}

fn angle_of(path: &Trajectory, idx: usize) -> Option<ShotAngle> {
    let level = LevelFrame::new(path.up_or_mean()).ok()?;
    let pitch_deg = level.angles(DQuat::from_mat3(path.rotations.get(idx)?).normalize()).pitch_rad.to_degrees();
    Some(match pitch_deg {
        pitch if pitch < -40.0 => ShotAngle::Overhead,
        pitch if pitch < -10.0 => ShotAngle::High,
        pitch if pitch <= 10.0 => ShotAngle::EyeLevel,
        pitch if pitch <= 40.0 => ShotAngle::Low,
        _ => ShotAngle::Worm,
    })
}

/// Height of the subject's sphere over that of the frame; `None` behind the camera or inside the sphere.
fn size_of(path: &Trajectory, idx: usize, subject: &SubjectSphere, fov_y_rad: f64) -> Option<SizeBand> {
    let seen = path.rotations.get(idx)?.transpose() * (subject.center - *path.positions.get(idx)?);
    let depth = (seen.length_squared() - subject.radius.powi(2)).max(0.0).sqrt();
    if !(seen.z > 0.0 && depth > 0.0) {
        return None;
    }
    let height_frac = subject.radius / depth / (fov_y_rad / 2.0).tan();
    let reaches = |size: &&ShotSize| height_frac >= size.height_band_frac().0;
    let size = ShotSize::VARIANTS.iter().find(reaches).copied().unwrap_or(ShotSize::ExtremeLong);
    Some(SizeBand { height_frac, size })
}

/// The amount of a move with its unit; `None` for a still camera and for several moves at once.
fn amount(found: &DescribedMove) -> Option<(f64, &'static str)> {
    let movement = found.movement?;
    match movement.name {
        Move::Static => None,
        Move::ZoomIn | Move::ZoomOut => Some((movement.amount, "x focal length")),
        name if is_turn(name) => Some((movement.amount.to_degrees(), "degrees")),
        _ => Some((movement.amount, "scene units")),
    }
}

fn is_turn(name: Move) -> bool {
    use Move as M;
    let circles = [M::OrbitLeft, M::OrbitRight, M::ArcLeft, M::ArcRight];
    let turns = [M::PanLeft, M::PanRight, M::TiltUp, M::TiltDown, M::RollCw, M::RollCcw];
    circles.contains(&name) || turns.contains(&name)
}

/// The rise beside an arc, or the arc beside a rise, in words.
fn beside(found: &DescribedMove) -> Option<String> {
    use Move as M;
    let name = found.movement?.name;
    let places = unrolled(&found.path)?;
    let way = *places.last()? - *places.first()?;
    let least = BESIDE_FRAC * found.path.path_length();
    match name {
        M::ArcLeft | M::ArcRight | M::OrbitLeft | M::OrbitRight if way.y.abs() > least => {
            Some(format!("craning {}", if way.y > 0.0 { "up" } else { "down" }))
        }
        M::CraneUp | M::CraneDown if way.x.abs() > least => {
            let swept = extent(&found.path, M::ArcRight).filter(|swept| *swept > BESIDE_RAD)?;
            let side = if way.x > 0.0 { "right" } else { "left" };
            Some(format!("arcing to the {side} by {:.0} degrees", swept.to_degrees()))
        }
        _ => None,
    }
}

/// A move in words, with what is beside it.
fn words(found: &DescribedMove) -> String {
    let (mut moves, zoom) = (move_words(found), zoom_factor(&found.path));
    if let Some(other) = beside(found) {
        moves = format!("{moves} while {other}");
    }
    let has_zoom = found.movement.is_some_and(|movement| {
        use Move as M;
        matches!(movement.name, M::ZoomIn | M::ZoomOut | M::DollyZoomIn | M::DollyZoomOut | M::Static)
    });
    let way = match zoom {
        _ if has_zoom => return moves,
        zoom if zoom > NAMED_ZOOM => "in",
        zoom if zoom < 1.0 / NAMED_ZOOM => "out",
        _ => return moves,
    };
    let joined = if moves.contains(" while ") { "and" } else { "while" };
    format!("{moves} {joined} zooming {way}")
}

/// A move in words.
fn move_words(found: &DescribedMove) -> String {
    let Some(movement) = found.movement else { return several(&found.path) };
    let degrees = || format!("{:.0} degrees", movement.amount.to_degrees());
    match movement.name {
        Move::Static => "hold still".to_owned(),
        Move::RollCw => format!("roll clockwise {}", degrees()),
        Move::RollCcw => format!("roll counter-clockwise {}", degrees()),
        Move::OrbitLeft => format!("orbit to the left by {}", degrees()),
        Move::OrbitRight => format!("orbit to the right by {}", degrees()),
        Move::ArcLeft => format!("arc to the left by {}", degrees()),
        Move::ArcRight => format!("arc to the right by {}", degrees()),
        name if is_turn(name) => format!("{} {}", name.as_ref().replace('-', " "), degrees()),
        name => name.as_ref().replace('-', " "),
    }
}

/// A number of seconds in words, to a tenth.
fn seconds(secs: f64) -> String {
    let rounded = significant((secs * 10.0).round() / 10.0, DIGITS);
    if rounded == "1" { "1 second".to_owned() } else { format!("{rounded} seconds") }
}

/// The net motion of a path that makes several moves at once.
fn several(path: &Trajectory) -> String {
    let (Some(first), Some(last), Some(turn)) = (path.positions.first(), path.positions.last(), path.rotations.first())
    else {
        return "move".to_owned();
    };
    let net = turn.transpose() * (*last - *first);
    let directions = [(net.z, "forward", "back"), (net.x, "right", "left"), (-net.y, "up", "down")];
    let largest = net.abs().max_element();
    let named = |amount: f64, positive: &'static str, negative: &'static str, least: f64| {
        (amount.abs() > least).then_some(if amount > 0.0 { positive } else { negative })
    };
    let moved = directions.into_iter().filter_map(|(amount, a, b)| named(amount, a, b, NAMED_FRAC * largest));
    let moved = moved.collect::<Vec<_>>().join(" and ");
    let rows = super::keyframe_table(path);
    let turned = rows.first().zip(rows.last()).map(|(a, b)| [b.yaw_deg - a.yaw_deg, b.pitch_deg - a.pitch_deg]);
    let [yaw, pitch] = turned.unwrap_or([0.0; 2]);
    let least = NAMED_TURN_RAD.to_degrees();
    let turns = [named(yaw, "right", "left", least), named(pitch, "up", "down", least)];
    let turned = turns.into_iter().flatten().collect::<Vec<_>>().join(" and ");
    let moves = if moved.is_empty() { "move".to_owned() } else { format!("move {moved}") };
    if turned.is_empty() { moves } else { format!("{moves} while turning {turned}") }
}
