use super::asset::Asset;

/// Unique labels of objects: the color word if there is one, the kind, and a number if several objects share both.
pub(super) fn labels(assets: &[&Asset]) -> Vec<String> {
    let colored = |a: &Asset| a.color.map_or_else(|| a.kind.to_owned(), |color| format!("{color} {}", a.kind));
    let named: Vec<String> = assets.iter().map(|asset| colored(asset)).collect();
    let same = |i: usize| named.iter().filter(|other| **other == named[i]).count();
    let before = |i: usize| named[..i].iter().filter(|other| **other == named[i]).count();
    (0..assets.len())
        .map(|i| if same(i) > 1 { format!("{} {}", named[i], before(i) + 1) } else { named[i].clone() })
        .collect()
}
