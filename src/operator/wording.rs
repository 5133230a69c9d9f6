//! Constraints in words.

use super::attainable::least_visible;
use super::composition::place_words;
use super::constraint::{
    BACKDROP_OFF, Constraint, ConstraintKind, FOREGROUND_OFF, PLACE_TOLERANCE, Scope, side_tolerance_deg,
};
use super::passage::STANDING_FRAC;
use super::program::Pass;
use super::simultaneous::extent_words;
use super::world::World;

/// A constraint in words, for the report.
pub(super) fn wording(world: &World, constraint: &Constraint) -> String {
    let name = |id: &u32| world.subject(*id).map_or_else(|| format!("<obj-{id}>"), |s| s.label.clone());
    let names = |ids: &[u32]| ids.iter().map(name).collect::<Vec<_>>().join(", ");
    let what = match &constraint.kind {
        ConstraintKind::Centered(target, most) => {
            format!("{} within {most:.2} of the frame's middle", names(&target.ids))
        }
        ConstraintKind::OnThird(target) => format!("{} on a third of the frame", names(&target.ids)),
        ConstraintKind::Unoccluded(id, least) => {
            let least = world.subject(*id).map_or(*least, |subject| least_visible(world, subject, *least));
            format!("visible share of {} at least {least:.2}", name(id))
        }
        ConstraintKind::Height(target, (low, high)) => {
            format!("{} {low:.2} to {high:.2} of the frame's height", names(&target.ids))
        }
        ConstraintKind::InFrame(ids, least) => format!("share of {} in the frame at least {least:.2}", names(ids)),
        ConstraintKind::NotWhole(ids, most) => format!("share of {} in the frame at most {most:.2}", names(ids)),
        ConstraintKind::Pitch((low, high)) => format!("pitch {low:.0} to {high:.0} degrees"),
        ConstraintKind::YawChange((low, high)) => format!("turn to the right {low:.0} to {high:.0} degrees"),
        ConstraintKind::PitchChange((low, high)) => format!("turn upward {low:.0} to {high:.0} degrees"),
        ConstraintKind::DistanceRatio(_, band) => format!("distance, end over start, {}", range(*band)),
        ConstraintKind::LensRatio(band) => {
            format!("tangent of half the field of view, end over start, {}", range(*band))
        }
        ConstraintKind::Travel(direction, _, least) => {
            format!("travel {direction}, over the distance, at least {least:.2}")
        }
        kind => composition_wording(kind, &names),
    };
    let scope = match constraint.scope {
        Scope::Start => " at the start",
        Scope::End => " at the end",
        Scope::All => "",
        Scope::Any => " on at least one frame",
    };
    what + scope
}

/// The words of the constraints on composition, path and look.
fn composition_wording(kind: &ConstraintKind, names: &dyn Fn(&[u32]) -> String) -> String {
    match kind {
        ConstraintKind::Placed(target, place) => {
            let what = if target.ids.is_empty() { "the scene".to_owned() } else { names(&target.ids) };
            format!("{what} {} within {PLACE_TOLERANCE:.2}", place_words(*place))
        }
        ConstraintKind::Distance(target, band) => {
            format!("distance to the center of {} {}", names(&target.ids), range(*band))
        }
        ConstraintKind::Elevation(target, (low, high)) => {
            format!("seen from {low:.0} to {high:.0} degrees above {}", names(&target.ids))
        }
        ConstraintKind::CameraHeight(band) => format!("camera above the floor {}", range(*band)),
        ConstraintKind::FieldOfView((low, high)) => format!("vertical field of view {low:.1} to {high:.1} degrees"),
        ConstraintKind::FromSide(target, side) => {
            let tolerance = side_tolerance_deg(*side);
            format!("{} seen {} within {tolerance:.0} degrees", names(&target.ids), spaced(side.as_ref()))
        }
        ConstraintKind::Unseen(id, most) => format!("visible share of {} at most {most:.2}", names(&[*id])),
        ConstraintKind::LookAt(_, what, most) => format!("look at {what}, within {most:.2} of the frame's middle"),
        ConstraintKind::LookAlong(sign, most) => {
            let way = if *sign > 0.0 { "ahead" } else { "back" };
            format!("look {way} along the path, within {most:.0} degrees")
        }
        ConstraintKind::Passed(how, id) => passage_wording(*how, &names(&[*id])),
        ConstraintKind::Foreground(id, target) => format!(
            "{} in the foreground of {}: beside or below the middle of the frame by {FOREGROUND_OFF:.2} to 0.50",
            names(&[*id]),
            names(&target.ids)
        ),
        ConstraintKind::Backdrop(id, target) => format!(
            "{} behind {}: farther away, at most {BACKDROP_OFF:.2} of the frame's width beside it",
            names(&[*id]),
            names(&target.ids)
        ),
        ConstraintKind::Also(movement, _) => {
            format!("{movement} at the same time, {}", extent_words(*movement))
        }
        ConstraintKind::Without(motion) => format!("no {motion}"),
        _ => String::new(),
    }
}

fn passage_wording(how: Pass, name: &str) -> String {
    if how == Pass::From {
        return format!("the camera starts at {name}: distance from it over the scene size at most {STANDING_FRAC:.2}");
    }
    let measured = match how {
        Pass::Under => "height of its bottom above the camera at least 0",
        Pass::Through => "distance from its center over its extent at most 1",
        Pass::Behind | Pass::Front => "angle from that side at most 60 degrees",
        Pass::Along => "covered share of its length at least 0.80",
        Pass::Past => "distance from it where it is abeam, over the scene size, at most 0.30",
        Pass::Between | Pass::Over | Pass::From => "",
    };
    let way = match how {
        Pass::Front => "in front of",
        Pass::Past => "past",
        Pass::Between => "between",
        Pass::Over => "over",
        Pass::Under => "under",
        Pass::Through => "through",
        Pass::Behind => "behind",
        Pass::Along => "along",
        Pass::From => "from",
    };
    format!("the camera passes {way} {name}: {measured}")
}

/// A name in kebab case as words.
fn spaced(name: &str) -> String {
    name.replace('-', " ")
}

fn range((low, high): (f64, f64)) -> String {
    match (low > 0.0, high.is_finite()) {
        (true, true) => format!("{low:.2} to {high:.2}"),
        (true, false) => format!("at least {low:.2}"),
        _ => format!("at most {high:.2}"),
    }
}
