//! Names of files, and lists of ids in words.

/// So many ids are named, the others counted.
const NAMED: usize = 6;

/// Ids in words: the first few of them, and how many more there are.
pub fn listed<'a>(ids: impl ExactSizeIterator<Item = &'a str>) -> String {
    let more = ids.len().saturating_sub(NAMED);
    let names: Vec<String> = ids.take(NAMED).map(|id| format!("`{id}`")).collect();
    match more {
        0 => names.join(", "),
        more => format!("{} and {more} more", names.join(", ")),
    }
}

/// A user's name as a part of a file name: letters and digits of ASCII, `-` and `_` stay, each
/// run of anything else becomes one `-`.
pub fn file_name(name: &str) -> String {
    let mut out = String::with_capacity(name.len());
    for c in name.chars() {
        if c.is_ascii_alphanumeric() || c == '_' {
            out.push(c);
        } else if !out.ends_with('-') {
            out.push('-');
        }
    }
    let trimmed = out.trim_matches('-');
    if trimmed.is_empty() {
        "unnamed".to_owned()
    } else {
        trimmed.to_owned()
    }
}

/// File names of parts in their order: ids keep the dots between their words.
pub fn part_file_names<'a>(ids: impl IntoIterator<Item = &'a str>) -> Vec<String> {
    let dotted = |id: &str| {
        let words: Vec<String> = id.split('.').map(file_name).collect();
        words.join(".")
    };
    distinct(ids.into_iter().map(dotted))
}

/// File names of several things in their order, made different by a number where they would be
/// the same on some file system (`A b` and `a-b`).
pub fn distinct_file_names<'a>(names: impl IntoIterator<Item = &'a str>) -> Vec<String> {
    distinct(names.into_iter().map(file_name))
}

fn distinct(names: impl Iterator<Item = String>) -> Vec<String> {
    let mut used = std::collections::BTreeSet::new();
    names
        .map(|base| {
            let mut unique = base.clone();
            let mut number = 2;
            while !used.insert(unique.to_ascii_lowercase()) {
                unique = format!("{base}-{number}");
                number += 1;
            }
            unique
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_keep_the_dots_of_their_ids() {
        let ids = ["west.u03a", "west.u03a-b", "a b.v01", "a-b.v01"];
        assert_eq!(
            part_file_names(ids),
            ["west.u03a", "west.u03a-b", "a-b.v01", "a-b.v01-2"]
        );
    }

    #[test]
    fn names_become_portable_and_stay_different() {
        let names = ["west", "West", "a/b", "a b", "..", "Größe 2", "con:"];
        assert_eq!(
            distinct_file_names(names),
            ["west", "West-2", "a-b", "a-b-2", "unnamed", "Gr-e-2", "con"]
        );
    }
}
