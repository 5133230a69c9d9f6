/// Longest word that is compared, letters. It bounds the time.
const MAX_LETTERS: usize = 40;

/// Number of edits (insert, delete, replace, swap neighbors) from one word to another: the optimal string alignment
/// distance. Different words are 41 apart when one has more than 40 letters.
pub fn edit_distance(a: &str, b: &str) -> usize {
    let bounded = |word: &str| word.chars().take(MAX_LETTERS + 1).collect::<String>();
    let (a, b) = (bounded(a), bounded(b));
    if [&a, &b].iter().any(|word| word.chars().count() > MAX_LETTERS) {
        return if a == b { 0 } else { MAX_LETTERS + 1 };
    }
    strsim::osa_distance(&a, &b)
}
