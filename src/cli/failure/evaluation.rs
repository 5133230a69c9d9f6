use cinesplat::evaluation::{EvaluationError, SettingName};

use super::exit::Exit;
use super::message::Failure;

impl From<EvaluationError> for Failure {
    fn from(error: EvaluationError) -> Self {
        use EvaluationError as E;
        let (code, message) = (error.code(), error.to_string());
        let (exit, help) = match error {
            E::Empty { which } => (Exit::BadData, format!("check that the {which} file holds a camera path")),
            E::Unreadable { .. } => (Exit::BadData, "check the file, or take it out of the folder".to_owned()),
            E::SameStem { .. } => (
                Exit::BadData,
                "rename one of the two, or move it out of the folder: files are paired by their names up to the first dot"
                    .to_owned(),
            ),
            E::NoMatches { .. } => {
                (Exit::BadData, "raise --max-diff, or check that both files use one clock".to_owned())
            }
            E::NoTimes { wanted } => (Exit::BadData, format!("leave out {wanted}, or give files with times")),
            E::NoPairs { .. } => (Exit::BadData, "lower --delta or take --unit f".to_owned()),
            E::BadSetting { setting, expected, .. } => (Exit::Usage, setting_advice(setting, expected)),
        };
        Self::new(code, message, help, exit)
    }
}

fn setting_advice(setting: SettingName, expected: &str) -> String {
    let flag = match setting {
        SettingName::AlignPoses => "--align-poses",
        SettingName::Delta => "--delta",
        SettingName::MaxDiff => "--max-diff",
        SettingName::TimeOffset => "--time-offset",
        SettingName::Diameter => "--diameter",
        SettingName::Relation => return "choose another --relation, or add --rpe".to_owned(),
    };
    format!("set {flag} to {expected}")
}
