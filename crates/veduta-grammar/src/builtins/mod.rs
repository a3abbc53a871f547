//! The names that the language brings along, as tables: operations, functions, shape attributes.

pub mod annotations;
pub mod attributes;
pub mod functions;
pub mod operations;
pub mod words;

/// Words that an argument may be, instead of a value. `ANY` accepts any word.
pub type Words = &'static [&'static str];

pub const NONE: Words = &[];
pub const ANY: Words = &["*"];

/// Whether a name is one of `words`.
pub fn is_word(words: Words, name: &str) -> bool {
    words.contains(&name) || words == ANY
}

/// The words that the argument at `position` may be.
pub fn words_at(words: &'static [Words], position: usize) -> Words {
    words.get(position).copied().unwrap_or(NONE)
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use super::*;

    #[test]
    fn names_are_unique_and_words_have_arguments() {
        let mut names = HashSet::new();
        for one in operations::OPERATIONS {
            assert!(names.insert(one.name), "{}", one.name);
            assert!(
                one.counts.windows(2).all(|pair| pair[0] < pair[1]),
                "{}",
                one.name
            );
            let most = one.counts.iter().max().copied().unwrap_or(0);
            assert!(one.words.len() <= usize::from(most), "{}", one.name);
        }
        names.clear();
        for one in functions::FUNCTIONS {
            assert!(names.insert(one.name), "{}", one.name);
            assert!(one.least <= one.most, "{}", one.name);
            assert!(one.words.len() <= usize::from(one.most), "{}", one.name);
        }
    }

    #[test]
    fn attributes_are_known_by_their_names() {
        assert!(attributes::names().all(|name| attributes::is_attribute(&name)));
        for unknown in [
            "scope",
            "scope.s",
            "material.colormap.",
            "material.colormapsu",
        ] {
            assert!(!attributes::is_attribute(unknown), "{unknown}");
        }
    }
}
