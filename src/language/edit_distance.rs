/// Number of edits (insert, delete, replace, swap neighbors) from one word to another: the optimal string alignment
/// distance. Different words are 41 apart when one has more than 40 letters, which bounds the time.
pub(crate) fn edit_distance(a: &str, b: &str) -> usize {
    let (a, b): (Vec<char>, Vec<char>) = (a.chars().take(41).collect(), b.chars().take(41).collect());
    if a.len() > 40 || b.len() > 40 {
        return usize::from(a != b) * 41;
    }
    let width = b.len() + 1;
    let mut table = vec![0usize; (a.len() + 1) * width];
    let cell = |table: &[usize], i: usize, j: usize| table.get(i * width + j).copied().unwrap_or(0);
    for i in 0..=a.len() {
        for j in 0..=b.len() {
            let value = if i == 0 || j == 0 {
                i + j
            } else {
                let replace = cell(&table, i - 1, j - 1) + usize::from(a.get(i - 1) != b.get(j - 1));
                let shift = cell(&table, i - 1, j).min(cell(&table, i, j - 1)) + 1;
                let swapped = i > 1 && j > 1 && a.get(i - 1) == b.get(j - 2) && a.get(i - 2) == b.get(j - 1);
                let swap = if swapped { cell(&table, i - 2, j - 2) + 1 } else { usize::MAX };
                replace.min(shift).min(swap)
            };
            if let Some(slot) = table.get_mut(i * width + j) {
                *slot = value;
            }
        }
    }
    table.last().copied().unwrap_or(0)
}
