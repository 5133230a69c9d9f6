//! Pictograms that stand for the names of things: `🎸 ➡️ 💀`.

/// Pictograms, and the word that each stands for.
const NAMES: [(&str, &str); 62] = [
    ("🎸", "guitar"),
    ("🌴", "palm"),
    ("💀☠", "skull"),
    ("🪑💺", "chair"),
    ("🛋", "sofa"),
    ("📺", "television"),
    ("🖼", "painting"),
    ("🪴🌱🌿", "plant"),
    ("🌵", "cactus"),
    ("🌳🌲🎄", "tree"),
    ("🌷🌹💐🌺🌼", "flowers"),
    ("🌻", "sunflower"),
    ("🕯", "candle"),
    ("💡🪔", "lamp"),
    ("🏮", "lantern"),
    ("🚪", "door"),
    ("🪟", "window"),
    ("🛏", "bed"),
    ("🚽", "toilet"),
    ("🛁", "bathtub"),
    ("🚿", "shower"),
    ("🚰", "tap"),
    ("🪞", "mirror"),
    ("🧸", "teddy"),
    ("🎹", "piano"),
    ("🥁", "drums"),
    ("🎻", "violin"),
    ("🎺", "trumpet"),
    ("🎷", "saxophone"),
    ("💻", "laptop"),
    ("🖥", "monitor"),
    ("🖨", "printer"),
    ("📱", "phone"),
    ("☎📞", "telephone"),
    ("🕰", "clock"),
    ("📚", "books"),
    ("📖📕📗📘📙", "book"),
    ("🧺", "basket"),
    ("🗑", "bin"),
    ("🪣", "bucket"),
    ("🫖", "teapot"),
    ("☕🍵", "cup"),
    ("🍾🍶", "bottle"),
    ("🏺", "vase"),
    ("🔪", "knife"),
    ("🍽", "plate"),
    ("🥣", "bowl"),
    ("🍲", "pot"),
    ("🎂🍰", "cake"),
    ("🍎🍏", "apple"),
    ("🍋", "lemon"),
    ("🍞", "bread"),
    ("🚗🚙", "car"),
    ("🚲", "bicycle"),
    ("🏍", "motorbike"),
    ("🐱🐈", "cat"),
    ("🐶🐕", "dog"),
    ("🦉", "owl"),
    ("🤖", "robot"),
    ("📦", "box"),
    ("🗿🗽", "statue"),
    ("🌍🌎🌏", "globe"),
];
/// Words and marks behind which, or before which, a pictogram is a name and no ornament.
const BEFORE: &str = "the a an this that to on onto at of from in into towards toward past around round over behind above below \
    under between then and with by , :";
const BEHIND: &str = "to then and past , and towards into";

/// The word that a pictogram stands for.
pub(super) fn name_of(pictogram: char) -> Option<&'static str> {
    NAMES.iter().find(|(marks, _)| marks.contains(pictogram)).map(|(_, name)| *name)
}

/// Whether a pictogram between two words is a name: `from the 🎸 to the 💀`, but not `push in on the guitar 🎸`.
pub(super) fn is_name(before: Option<&str>, behind: &str) -> bool {
    let leads = |word: &str| super::tokenizer::is_listed(BEFORE, word);
    before.map_or_else(|| super::tokenizer::is_listed(BEHIND, behind), leads)
}

#[cfg(test)]
mod tests {
    use super::super::tokenizer::tokenize;

    #[test]
    fn a_pictogram_in_the_place_of_a_noun_is_one() {
        let words = |text: &str| tokenize(text).into_iter().map(|word| word.text).collect::<Vec<_>>().join(" ");
        assert_eq!(words("🎸 ➡️ 🌴 → 💀 in that order"), "guitar , palm , skull in that order");
        assert_eq!(words("🎸 to 💀"), "guitar to skull");
        assert_eq!(words("pan from the 🪑 to the 📺, slowly"), "pan from the chair to the television , slowly");
        assert_eq!(words("🎬 push in on the guitar 🎸🔥!"), "push in on the guitar !");
        assert_eq!(words("🎸 push in on the guitar"), "push in on the guitar");
    }
}
