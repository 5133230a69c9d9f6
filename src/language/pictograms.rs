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
    let is_in = |list: &str, word: &str| list.split_ascii_whitespace().any(|known| known == word);
    before.map_or_else(|| is_in(BEHIND, behind), |word| is_in(BEFORE, word))
}
