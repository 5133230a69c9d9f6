use clap::error::ErrorKind;

use super::console;
use super::failure::Failure;

/// Answers arguments that clap does not accept as a command: prints help or version on request, otherwise returns the error.
pub(super) fn answer(refused: &clap::Error) -> Result<(), Failure> {
    match refused.kind() {
        ErrorKind::DisplayHelp | ErrorKind::DisplayVersion => console::text(&refused.render().to_string()),
        ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand => {
            console::note(&refused.render().to_string());
            Err(Failure::usage(
                "no command, expected one of those above",
                "`cinesplat COMMAND --help` explains a command",
            ))
        }
        _ => Err(wrong(&refused.render().to_string())),
    }
}

/// Turns clap's paragraphs into two lines: the first paragraph is the message, tips and usage are the help.
fn wrong(text: &str) -> Failure {
    let joined = |part: &str| part.lines().map(str::trim).collect::<Vec<_>>().join(" ");
    let mut parts = text.split("\n\n").map(joined).filter(|part| !part.is_empty());
    let message = parts.next().unwrap_or_default();
    let kept = |part: &String| !part.starts_with("For more information");
    let mut help: Vec<String> = parts.filter(kept).map(|part| part.trim_start_matches("tip: ").to_owned()).collect();
    help.push("see --help".to_owned());
    Failure::usage(message.trim_start_matches("error: "), help.join("; "))
}
