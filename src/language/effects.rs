use super::lexicon::Lexicon;
use super::{LanguageError, Linked};

/// An effect or another thing beside the camera that the words call for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CalledFor {
    /// Name from the lexicon: `depth-of-field`, `motion-blur`, `music` ..
    pub kind: String,
    /// The words that call for it.
    pub because: String,
    /// Byte range of the prompt.
    pub span: [usize; 2],
}

/// What the words call for beside camera moves, in order of the words: effects of the lens, and things that no camera
/// can do. `no motion blur` and `without music` call for nothing.
///
/// # Errors
/// [`LanguageError::BadData`] when the embedded lexicon is damaged.
pub fn effects_called_for(linked: &Linked) -> Result<Vec<CalledFor>, LanguageError> {
    let lexicon = Lexicon::embedded()?;
    let tokens: Vec<&str> = linked.tokens_text.split(' ').collect();
    let mut found: Vec<CalledFor> = Vec::new();
    let mut i = 0;
    while i < tokens.len() {
        let rest = tokens.get(i..).unwrap_or_default();
        let starts =
            |wording: &Vec<String>| wording.len() <= rest.len() && wording.iter().zip(rest).all(|(a, b)| a == b);
        let Some((kind, wording)) = lexicon.effects.iter().find(|(_, wording)| starts(wording)) else {
            i += 1;
            continue;
        };
        let end = i + wording.len();
        let denied = tokens
            .get(i.saturating_sub(2)..i)
            .unwrap_or_default()
            .iter()
            .any(|w| matches!(*w, "no" | "without" | "not"));
        if !denied && !found.iter().any(|known| known.kind == *kind) {
            let span = [linked.spans.get(i).map_or(0, |s| s[0]), linked.spans.get(end - 1).map_or(0, |s| s[1])];
            found.push(CalledFor { kind: kind.clone(), because: wording.join(" "), span });
        }
        i = end;
    }
    Ok(found)
}
