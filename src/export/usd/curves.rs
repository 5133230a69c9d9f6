//! The numbers of a prim's attributes over time, read once.

use std::collections::BTreeMap;

use glam::DQuat;

use super::super::ExportError;
use super::layer::{Prim, Value};
use cinesplat_geometry::rotation;

/// Most numbers of an attribute that count (those of a matrix), with one more that tells longer ones.
const MAX_NUMBERS: usize = 17;
/// Most transform operations of a prim.
const MAX_OPERATIONS: usize = 64;
/// Behind the name of an attribute with values over time.
pub(super) const SAMPLES: &str = ".timeSamples";
/// Behind the name of an attribute that a spline animates.
pub(super) const SPLINE: &str = ".spline";
/// Attributes of cameras that are read over time.
const LENS: [&str; 6] = [
    "focalLength",
    "horizontalAperture",
    "verticalAperture",
    "horizontalApertureOffset",
    "verticalApertureOffset",
    "focusDistance",
];
/// Entries of an order of operations: the start of the name of one that is undone, and that the prims above do not
/// count.
const INVERSE: &str = "!invert!";
const RESET: &str = "!resetXformStack!";

/// Numbers by time code, in order; a constant has one.
type Curve = Vec<(f64, Vec<f64>)>;

/// What is read of a prim at each time code.
pub(super) struct Curves<'a> {
    by_name: BTreeMap<&'a str, Curve>,
    /// The transform operations, each with whether it is undone; `None` for entries that are none and for too many.
    pub(super) order: Option<Vec<(&'a str, bool)>>,
    /// Whether the prims above do not move this one.
    pub(super) resets_stack: bool,
}

impl<'a> Curves<'a> {
    pub(super) fn new(prim: &'a Prim) -> Result<Self, ExportError> {
        let is_read = |name: &str| is_operation(name) || LENS.contains(&name);
        let mut by_name = BTreeMap::new();
        for (name, value) in &prim.attributes {
            if let Some(name) = name.strip_suffix(SPLINE).filter(|name| is_read(name)) {
                let reason = format!("{name} is animated by a spline, which is not read: sample it per frame");
                return Err(ExportError::NotReadable { format: "usd", reason });
            }
            if let (Some(name), Value::Map(samples)) = (name.strip_suffix(SAMPLES), value)
                && is_read(name)
                && let Some(curve) = curve(samples)
            {
                by_name.entry(name).or_insert(curve);
            }
        }
        for (name, value) in prim.attributes.iter().filter(|(name, _)| is_read(name)) {
            let is_sampled = matches!(prim.attribute(&format!("{name}{SAMPLES}")), Some(Value::Map(_)));
            if let Some(numbers) = value.numbers().filter(|_| !is_sampled) {
                by_name.entry(name).or_insert_with(|| vec![(0.0, first(numbers))]);
            }
        }
        let entries =
            if let Some(Value::List(order)) = prim.attribute("xformOpOrder") { order.as_slice() } else { &[] };
        let is_reset = |op: &&Value| matches!(op, Value::Text(name) if name == RESET);
        let operations = entries.iter().filter(|op| !is_reset(op)).map(|op| {
            let Value::Text(name) = op else { return None };
            Some(name.strip_prefix(INVERSE).map_or((name.as_str(), false), |name| (name, true)))
        });
        let order: Option<Vec<_>> = operations.take(MAX_OPERATIONS + 1).collect();
        let order = order.filter(|order| order.len() <= MAX_OPERATIONS);
        Ok(Self { by_name, order, resets_stack: entries.iter().any(|op| is_reset(&op)) })
    }

    /// An attribute's numbers at a time code, interpolated linearly, or along the shorter arc for quaternions.
    pub(super) fn numbers_at(&self, name: &str, code: f64) -> Option<Vec<f64>> {
        let samples = self.by_name.get(name)?;
        let after = samples.partition_point(|(key, _)| *key <= code);
        let Some(before) = after.checked_sub(1) else { return samples.first().map(|(_, v)| v.clone()) };
        let (from, a) = &samples[before];
        let Some((to, b)) = samples.get(after).filter(|_| *from < code) else { return Some(a.clone()) };
        let t = (code - from) / (to - from);
        if name.contains(":orient") && a.len() == 4 && b.len() == 4 {
            return Some(wxyz(rotation::slerp(quaternion(a)?, quaternion(b)?, t)));
        }
        Some(a.iter().zip(b).map(|(a, b)| a + (b - a) * t).collect())
    }
}

/// Whether an attribute is a transform operation.
pub(super) fn is_operation(name: &str) -> bool {
    name.starts_with("xformOp:")
}

/// Time samples in order; `None` where one has no numbers.
fn curve(samples: &[(String, Value)]) -> Option<Curve> {
    let sample = |(key, value): &(String, Value)| Some((key.parse().ok()?, first(value.numbers()?)));
    let mut curve: Curve = samples.iter().map(sample).collect::<Option<_>>()?;
    curve.sort_by(|(a, _), (b, _)| a.total_cmp(b));
    Some(curve)
}

/// The numbers that count.
fn first(mut numbers: Vec<f64>) -> Vec<f64> {
    numbers.truncate(MAX_NUMBERS);
    numbers
}

pub(super) fn quaternion(wxyz: &[f64]) -> Option<DQuat> {
    let [w, x, y, z] = wxyz.try_into().ok()?;
    Some(DQuat::from_xyzw(x, y, z, w)).filter(|q| q.length() > 1e-6).map(DQuat::normalize)
}

fn wxyz(rotation: DQuat) -> Vec<f64> {
    vec![rotation.w, rotation.x, rotation.y, rotation.z]
}
