//! The `effects` of a `shot.json`: kind, settings, reason, and the frames that each runs on.
//!
//! Settings are numbers under their own names beside `kind` and `because`; anything else there is no setting, which a
//! note says. `frames`, `samples`, `measure`, `error` and
//! `allowed` record what the last plan found; they bind nothing.

use super::ExportError;
use super::json_read::Node;
use super::json_write::Json;
use cinesplat_trajectory::{EffectRequest, EffectRuns};

/// Keys that are no settings.
const OWN_KEYS: [&str; 7] = ["kind", "because", "frames", "samples", "measure", "error", "allowed"];

/// Reads one effect.
pub(super) fn read(node: &Node) -> Result<EffectRequest, ExportError> {
    let names = node.fields().into_iter().map(|(name, _)| name).filter(|name| !OWN_KEYS.contains(name));
    // Null is a setting that is not stated.
    let stated = names.filter_map(|name| Some((name, node.optional(name)?)));
    let settings = stated.filter(|(_, value)| is_setting(value));
    let settings = settings.map(|(name, value)| Ok((name.to_owned(), value.number()?)));
    let settings = settings.collect::<Result<_, ExportError>>()?;
    let kind = node.field("kind", "the name of an effect")?.text()?.to_owned();
    let because = node.optional("because").map_or(Ok(String::new()), |text| text.text().map(str::to_owned))?;
    Ok(EffectRequest { kind, because, settings, runs: read_runs(node)? })
}

/// One line per value of an effect that is no number, and so no setting.
pub(super) fn notes(node: &Node) -> Vec<String> {
    let others = node.fields().into_iter().filter(|(name, _)| !OWN_KEYS.contains(name));
    let is_stated = |(name, value): &(&str, Node)| node.optional(name).is_some() && !is_setting(value);
    let unread = others.filter(is_stated);
    unread.map(|(_, value)| format!("{}: no number, and so no setting: it is not read", value.place())).collect()
}

/// Whether a value is a number; one in quotes is meant as one.
fn is_setting(value: &Node) -> bool {
    value.number().is_ok() || value.text().is_ok_and(|text| text.parse::<f64>().is_ok())
}

fn read_runs(node: &Node) -> Result<Option<EffectRuns>, ExportError> {
    let Some(frames) = node.optional("frames") else { return Ok(None) };
    let number = |name: &str| node.optional(name).map_or(Ok(f64::NAN), |number| number.number());
    let pair = |node: &Node| -> Result<[usize; 2], ExportError> {
        let [from, to] = node.numbers::<2>()?;
        Ok([from.max(0.0) as usize, to.max(0.0) as usize])
    };
    let samples = node.optional("samples").map_or(Ok([0, 0]), |samples| pair(&samples))?;
    Ok(Some(EffectRuns {
        frames: frames.items()?.iter().map(pair).collect::<Result<_, _>>()?,
        samples: samples.map(|num| num as u32),
        measure: node.optional("measure").map_or(Ok(String::new()), |text| text.text().map(str::to_owned))?,
        error: number("error")?,
        allowed: number("allowed")?,
    }))
}

/// One effect as JSON.
pub(super) fn write(effect: &EffectRequest) -> Json {
    let mut fields = vec![("kind".to_owned(), effect.kind.as_str().into())];
    fields.extend(effect.settings.iter().map(|(name, value)| (name.clone(), (*value).into())));
    fields.push(("because".to_owned(), effect.because.as_str().into()));
    if let Some(runs) = &effect.runs {
        let frames = Json::list(runs.frames.iter().map(|[from, to]| Json::list([*from as u64, *to as u64])));
        fields.push(("frames".to_owned(), frames));
        fields.push(("samples".to_owned(), Json::list(runs.samples)));
        fields.push(("measure".to_owned(), runs.measure.as_str().into()));
        fields.push(("error".to_owned(), runs.error.into()));
        fields.push(("allowed".to_owned(), runs.allowed.into()));
    }
    Json::Object(fields)
}
