//! Stated speeds make the length of a step of its extent, or its extent of its length: `dolly in 1.2 m at 0.3 m/s`, `rise at
//! 10 cm per second for 5 seconds`.

use cinesplat_language::{Linked, QuantityKind};
use cinesplat_operator::{Amount, Motion, Step};
use cinesplat_trajectory::Move;

use crate::direction::Direction;

/// Turns slower than this are no whip pans, degrees a second.
const WHIP_DEG_PER_SEC: f64 = 90.0;

/// Takes stated speeds.
pub(crate) fn take_rates(linked: &Linked, direction: &mut Direction) {
    let num_steps = direction.program.steps.len();
    for rate in linked.rates() {
        let holds =
            |step: &Step| num_steps == 1 || step.words.is_some_and(|[from, to]| (from..to).contains(&rate.bytes[0]));
        let film_secs = direction.program.duration_secs.filter(|_| num_steps == 1);
        let Some(step) = direction.program.steps.iter_mut().find(|step| holds(step) && fits(step, rate.kind)) else {
            continue;
        };
        if step.movement == Move::WhipPan && rate.per_sec < WHIP_DEG_PER_SEC {
            (step.movement, step.either_way) = (Move::PanRight, true);
        }
        let extent = match (rate.kind, step.amount) {
            (QuantityKind::Degrees, Some(Amount::Degrees(value))) | (_, Some(Amount::Units(value))) => Some(value),
            _ => None,
        };
        let is_open = !matches!(step.amount, Some(Amount::Degrees(_) | Amount::Units(_) | Amount::Factor(_)));
        match (extent, step.duration_secs.or(film_secs)) {
            (Some(extent), None) => step.duration_secs = Some(extent / rate.per_sec),
            (None, Some(secs)) if is_open => {
                let extent = rate.per_sec * secs;
                let is_turn = rate.kind == QuantityKind::Degrees;
                step.amount = Some(if is_turn { Amount::Degrees(extent) } else { Amount::Units(extent) });
            }
            _ => continue,
        }
        let overlaps = |span: &[usize; 2]| span[0] < rate.bytes[1] && rate.bytes[0] < span[1];
        direction.unmet.retain(|span| !overlaps(span));
    }
}

/// Whether a step's move has an extent of this kind.
fn fits(step: &Step, kind: QuantityKind) -> bool {
    let turns = step.movement.looks_elsewhere()
        || step.movement.is_circular()
        || Motion::of(step.movement) == Some(Motion::Roll);
    match kind {
        QuantityKind::Degrees => turns,
        QuantityKind::Units => !turns && !matches!(step.movement, Move::Static | Move::ZoomIn | Move::ZoomOut),
        _ => false,
    }
}
