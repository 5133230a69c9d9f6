//! A comparison as a JSON object.

use super::motion::motion_value;
use super::{Evaluation, Metric};
use cinesplat_export::json_write::{Json, object};

impl Evaluation {
    /// The comparison as the text of one JSON object.
    ///
    /// At its top level are `rmse mean median std min max sse` in the unit of the relation, `pairs` (the number of
    /// errors), `relation`, `align`, and `scale`, `rotation` (3 x 3, by rows) and `translation` of the alignment.
    pub fn to_json(&self) -> String {
        Json::Object(self.fields()).pretty()
    }

    /// As [`Self::to_json`], with smoothness, motion tags and a table of poses of both matched paths under `motion`.
    pub fn to_json_with_motion(&self) -> String {
        let both = [("reference", &self.matches.reference), ("estimate", &self.matches.estimate)];
        let mut fields = self.fields();
        fields.push(("motion".to_owned(), object(both.map(|(name, path)| (name, motion_value(path))))));
        Json::Object(fields).pretty()
    }

    fn fields(&self) -> Vec<(String, Json)> {
        let mut fields: Vec<(String, Json)> = Vec::new();
        let mut put = |name: &str, value: Json| fields.push((name.to_owned(), value));
        for (name, value) in self.statistics.named() {
            put(name, value.into());
        }
        put("pairs", self.errors.len().into());
        fields.extend(self.settings_json());
        let mut put = |name: &str, value: Json| fields.push((name.to_owned(), value));
        let rotation = self.alignment.rotation.transpose();
        put("rotation", Json::list([rotation.x_axis, rotation.y_axis, rotation.z_axis]));
        put("translation", self.alignment.translation.into());
        put("matched", self.matches.reference.len().into());
        put("dropped_reference", self.matches.dropped_reference.into());
        put("dropped_estimate", self.matches.dropped_estimate.into());
        put("largest_time_diff_secs", self.matches.largest_diff_secs.into());
        put("mean_over_diameter", self.relative_to_diameter.into());
        if let Some(focal) = &self.focal {
            let numbers = [
                ("log_ratio_rmse", focal.log_ratio_rmse.into()),
                ("log_ratio_mean", focal.log_ratio_mean.into()),
                ("log_ratio_max", focal.log_ratio_max.into()),
            ];
            put("focal_error", object(numbers));
        }
        if let Some(framing) = &self.framing {
            let numbers = [
                ("offset_rmse", framing.offset_rmse.into()),
                ("offset_max", framing.offset_max.into()),
                ("log_size_rmse", framing.log_size_rmse.into()),
                ("lost_frac", framing.lost_frac.into()),
            ];
            put("framing_error", object(numbers));
        }
        put("notes", Json::list(self.notes.iter().map(String::as_str)));
        put("at_secs", Json::list(self.at_secs.iter().copied()));
        put("errors", Json::list(self.errors.iter().copied()));
        fields
    }

    /// What was measured, with its unit, and the scale of the alignment.
    pub(super) fn settings_json(&self) -> Vec<(String, Json)> {
        let settings = &self.settings;
        let named = [
            ("relation", settings.relation.as_ref().into()),
            ("unit", settings.relation.unit().into()),
            ("metric", self.metric_json()),
            ("align", settings.align.as_ref().into()),
            ("scale", self.alignment.scale.into()),
        ];
        named.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
    }

    fn metric_json(&self) -> Json {
        match &self.settings.metric {
            Metric::Ape => object([("name", "ape".into())]),
            Metric::Rpe { pairs, pairs_from_reference } => {
                let (delta, unit) = pairs.delta.named();
                object([
                    ("name", "rpe".into()),
                    ("delta", delta.into()),
                    ("unit", unit.into()),
                    ("all_pairs", pairs.all_pairs.into()),
                    ("pairs_from", if *pairs_from_reference { "reference" } else { "estimate" }.into()),
                ])
            }
        }
    }
}
