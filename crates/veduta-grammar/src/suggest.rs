//! "Did you mean …?": the known name that is nearest to an unknown one.

/// Names longer than this are not compared.
const MAX_LENGTH: usize = 48;
/// Known names that are compared at most.
const MAX_CANDIDATES: usize = 4000;

/// The candidate with the fewest mistypings, where these are few for its length.
pub(crate) fn closest<'a>(
    name: &str,
    candidates: impl Iterator<Item = &'a str>,
) -> Option<&'a str> {
    let length = name.len();
    if length > MAX_LENGTH {
        return None;
    }
    let allowed = match length {
        0..=2 => 0,
        3..=5 => 1,
        6..=8 => 2,
        _ => 3,
    };
    let near = candidates
        .filter(|other| other.len().abs_diff(length) <= allowed && *other != name)
        .take(MAX_CANDIDATES);
    let measured = near.map(|other| (mistypings(name, other), other));
    let best = measured.min_by_key(|(count, other)| (*count, *other));
    best.filter(|(count, _)| *count <= allowed * 2)
        .map(|(_, other)| other)
}

/// As a hint.
pub(crate) fn did_you_mean(found: Option<&str>) -> Option<String> {
    found.map(|name| format!("did you mean `{name}`?"))
}

/// Twice the number of letters that are missing, too many, wrong or swapped with the next (optimal
/// string alignment); a letter in the wrong case counts as half a mistyping.
fn mistypings(one: &str, other: &str) -> usize {
    let (a, b) = (one.as_bytes(), other.as_bytes());
    let width = b.len() + 1;
    let mut table = vec![0; (a.len() + 1) * width];
    for i in 0..=a.len() {
        for j in 0..=b.len() {
            table[i * width + j] = if i == 0 || j == 0 {
                2 * (i + j)
            } else {
                let (x, y) = (a[i - 1], b[j - 1]);
                let wrong = match x {
                    _ if x == y => 0,
                    _ if x.eq_ignore_ascii_case(&y) => 1,
                    _ => 2,
                };
                let at = |i: usize, j: usize| table[i * width + j];
                let mut least = (at(i - 1, j - 1) + wrong).min(at(i - 1, j).min(at(i, j - 1)) + 2);
                if i > 1 && j > 1 && x == b[j - 2] && a[i - 2] == y {
                    least = least.min(at(i - 2, j - 2) + 2);
                }
                least
            };
        }
    }
    table[table.len() - 1]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mistypings_are_counted() {
        let counted = |one, other| mistypings(one, other);
        assert_eq!(counted("comp", "comp"), 0);
        assert_eq!(counted("cmop", "comp"), 2);
        assert_eq!(counted("copm", "comp"), 2);
        assert_eq!(counted("com", "comp"), 2);
        assert_eq!(counted("coomp", "comp"), 2);
        assert_eq!(counted("Comp", "comp"), 1);
        assert_eq!(counted("", "abc"), 6);
    }

    #[test]
    fn only_near_names_are_suggested() {
        let known = ["comp", "color", "extrude", "t", "Wall"];
        let suggest = |name| closest(name, known.into_iter());
        assert_eq!(suggest("cmop"), Some("comp"));
        assert_eq!(suggest("colour"), Some("color"));
        assert_eq!(suggest("extude"), Some("extrude"));
        assert_eq!(suggest("wall"), Some("Wall"));
        assert_eq!(suggest("x"), None);
        assert_eq!(suggest("Window"), None);
    }
}
