//! The shapes of the letters.

/// Letters and their strokes: points of two base-36 digits, column and row. A stroke that starts with `~` is a curve: the
/// quadratic B-spline of its points, which ends at its first and last point.
#[rustfmt::skip]
const GLYPHS: [(&str, &str); 92] = [
    ("A", "0g50ag 2b8b"), ("B", "0g00 0050 ~50909757 0757 ~57a7ag5g 0g5g"), ("C", "~a4a0000gagac"),
    ("D", "0g00 0040 ~40a0ag4g 4g0g"), ("E", "80000g8g 0878"), ("F", "80000g 0878"), ("G", "~a4a0000gaga9 a969"),
    ("H", "000g a0ag 08a8"), ("Il", "000g"), ("J", "606b ~6b6g0g0c"), ("K", "000g 900a 379g"), ("L", "000g8g"),
    ("M", "0g006ac0cg"), ("N", "0g00aga0"), ("O", "~50000gaga050"), ("P", "0g00 0050 ~50a0a959 5909"),
    ("Q", "~50000gaga050 6cah"), ("R", "0g00 0050 ~50a0a959 5909 59ag"), ("S", "~93900008a8ag0g0c"),
    ("T", "00a0 505g"), ("U", "000a ~0a0gagaa aaa0"), ("V", "005ga0"), ("W", "003g73bge0"), ("X", "00ag a00g"),
    ("Y", "0058a0 585g"), ("Z", "00a00gag"), ("a", "868g ~46060g8g8646"), ("b", "000g ~46060g8g8646"),
    ("c", "~8986060g8g8d"), ("d", "808g ~46060g8g8646"), ("e", "0b8b ~8b86060g8g8d"), ("f", "~702026 262g 0656"),
    ("g", "868h ~8h8l0l0j ~46060g8g8646"), ("h", "000g ~0a06868b 8b8g"), ("i", "060g 0202"),
    ("j", "262i ~2i2l0l 2222"), ("k", "000g 760c 397g"), ("m", "060g ~0a06666b 6b6g ~6a66c6cb cbcg"),
    ("n", "060g ~0a06868b 8b8g"), ("o", "~46060g8g8646"), ("p", "060l ~46060g8g8646"), ("q", "868l ~46060g8g8646"),
    ("r", "060g ~0b0656"), ("s", "~7876060b7b7g0g0e"), ("t", "222c ~2c2g6g 0656"), ("u", "060b ~0b0g8g8c 868g"),
    ("v", "064g86"), ("w", "063g689gc6"), ("x", "068g 860g"), ("y", "064g 862l"), ("z", "06860g8g"),
    ("0", "~40000g8g8040"), ("1", "14504g 505g"), ("2", "~040080880g 0g8g"), ("3", "~0300808737 ~37979g0g0c"),
    ("4", "6g600b9b"), ("5", "801007 ~0725858g0g0c"), ("6", "~46060g8g8646 ~70020b"), ("7", "00803g"),
    ("8", "~400007878040 ~47070g8g8747"), ("9", "~40000a8a8040 ~858e1g"), (".", "0g0g"), (",", "1g0j"),
    (":", "0808 0g0g"), (";", "0808 1g0j"), ("'", "0004"), ("\"", "0004 3034"), ("-", "0a5a"),
    ("\u{2013}", "0a8a"), ("_", "0i8i"), ("/", "0i60"), ("\\", "006i"), ("({", "~30060c3i"), (")}", "~00363c0i"),
    ("[", "30000i3i"), ("]", "00303i0i"), ("<", "840a8g"), (">", "048a0g"), ("=", "0888 0c8c"), ("+", "0a8a 464e"),
    ("*", "404a 0288 8208"), ("!", "000b 0g0g"), ("?", "~03008086474b 4g4g"), ("&", "~9g15106065090g6g9a"),
    ("#", "302g 807g 0595 0bab"), ("%", "900g ~200004444020 ~7c5c5g9g9c7c"),
    ("@", "~75454b8b8575 ~858cccc0000gag"), ("|", "000i"), ("~", "~0b275c88"), ("\u{b0}", "~200004444020"),
    ("\u{d7}", "086e 680e"), ("\u{b7}", "0a0a"),
];

/// The strokes of a letter without a shape of its own: a box.
const UNKNOWN: &str = "00808g0g00";

/// Strokes of a letter.
pub(super) fn glyph(letter: char) -> &'static str {
    GLYPHS.iter().find(|(letters, _)| letters.contains(letter)).map_or(UNKNOWN, |(_, strokes)| *strokes)
}

/// The plain letter in place of an accented one, a curly quote or a long dash.
pub(super) fn plain(letter: char) -> char {
    const ACCENTED: [(&str, char); 17] = [
        ("\u{e0}\u{e1}\u{e2}\u{e3}\u{e4}\u{e5}\u{101}\u{103}\u{105}", 'a'),
        ("\u{c0}\u{c1}\u{c2}\u{c3}\u{c4}\u{c5}", 'A'),
        ("\u{e8}\u{e9}\u{ea}\u{eb}\u{113}\u{119}\u{11b}", 'e'),
        ("\u{c8}\u{c9}\u{ca}\u{cb}", 'E'),
        ("\u{ec}\u{ed}\u{ee}\u{ef}\u{131}", 'i'),
        ("\u{f2}\u{f3}\u{f4}\u{f5}\u{f6}\u{f8}\u{151}", 'o'),
        ("\u{d2}\u{d3}\u{d4}\u{d5}\u{d6}\u{d8}", 'O'),
        ("\u{f9}\u{fa}\u{fb}\u{fc}\u{16f}\u{171}", 'u'),
        ("\u{d9}\u{da}\u{db}\u{dc}", 'U'),
        ("\u{e7}\u{107}\u{10d}", 'c'),
        ("\u{f1}\u{144}", 'n'),
        ("\u{161}\u{15b}\u{15f}\u{df}", 's'),
        ("\u{17e}\u{17a}\u{17c}", 'z'),
        ("\u{142}", 'l'),
        ("\u{201c}\u{201d}\u{201e}\u{ab}\u{bb}", '"'),
        ("\u{2018}\u{2019}`", '\''),
        ("\u{2014}\u{2212}", '\u{2013}'),
    ];
    ACCENTED.iter().find(|(letters, _)| letters.contains(letter)).map_or(letter, |(_, plain)| *plain)
}
