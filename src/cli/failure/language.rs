use cinesplat::language::LanguageError;
use cinesplat::objects::is_description;

use super::exit::Exit;
use super::message::Failure;

impl From<LanguageError> for Failure {
    fn from(error: LanguageError) -> Self {
        use LanguageError as E;
        let (code, message) = (error.code(), error.to_string());
        let (exit, help) = match error {
            E::NothingToDo => (
                Exit::BadData,
                "say in English where the camera goes or looks; `cinesplat read -p PROMPT` shows what is understood"
                    .to_owned(),
            ),
            E::TooLong { .. } => (Exit::BadData, "shorten the prompt to the camera's moves".to_owned()),
            E::Empty => {
                (Exit::BadData, "say what the camera does, for example -p \"orbit <obj-3> to the left\"".to_owned())
            }
            E::UnknownObject { nearest, .. } if nearest.is_empty() => {
                (Exit::BadData, "the scene has no named objects: list them with `cinesplat objects SCENE`".to_owned())
            }
            // A number that no object has is no name to give.
            E::UnknownObject { name, nearest }
                if !name.starts_with("<obj-") && nearest.iter().all(|label| is_description(label)) =>
            {
                let objects = "its objects have no names yet: `cinesplat objects SCENE -o objects.json --sheet objects.html` shows them";
                (
                    Exit::BadData,
                    format!("{objects}, `--name ID={name}` names one, and `--objects objects.json` reads the file"),
                )
            }
            E::UnknownObject { nearest, .. } => (Exit::BadData, format!("nearest names: {}", nearest.join(", "))),
            E::TooManyObjects { .. } => (Exit::BadData, "split the prompt into several shots".to_owned()),
            E::BadData { .. } => {
                (Exit::Fault, "please report this: the program's own language files are damaged".to_owned())
            }
        };
        Self::new(code, message, help, exit)
    }
}
