use super::model::Model;

/// Labels that tell the objects of a room apart: the kind, a color before it where the object shows one, a number after
/// what still looks alike.
pub(super) fn labels(models: &[&Model]) -> Vec<String> {
    let colored = |m: &Model| m.color.map_or_else(|| m.kind.to_owned(), |color| format!("{color} {}", m.kind));
    let named: Vec<String> = models.iter().map(|m| colored(m)).collect();
    let same = |i: usize| named.iter().filter(|other| **other == named[i]).count();
    let before = |i: usize| named[..i].iter().filter(|other| **other == named[i]).count();
    (0..models.len())
        .map(|i| if same(i) > 1 { format!("{} {}", named[i], before(i) + 1) } else { named[i].clone() })
        .collect()
}
