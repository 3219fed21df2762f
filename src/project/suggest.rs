//! "Did you mean": the valid names closest to what was written.

/// More suggestions than this confuse.
const MOST_SUGGESTIONS: usize = 3;

/// So few valid names are listed instead, if none is close.
const MOST_LISTED: usize = 8;

/// Names longer than this, or lists longer than the next constant, are not searched: the edit
/// distance costs the product of their lengths, and such files come from mishaps, not hands.
const LONGEST_SEARCHED: usize = 64;
const MOST_SEARCHED: usize = 2000;

/// A sentence of help: close names, else all names where they are few, else nothing. `what` is
/// what the names name, in the singular.
pub(crate) fn help<'a>(
    written: &str,
    what: &str,
    valid: impl IntoIterator<Item = &'a str>,
) -> Option<String> {
    let valid: Vec<&str> = valid.into_iter().collect();
    if let Some(question) = did_you_mean(written, &valid) {
        return Some(question);
    }
    let plural = if what.ends_with("ch") { "es" } else { "s" };
    match valid.len() {
        0 => None,
        1 => Some(format!("the only {what} is `{}`", valid[0])),
        2..=MOST_LISTED => Some(format!("the {what}{plural} are {}", all_of(&valid))),
        _ => None,
    }
}

/// The question for close names, if there are any.
pub(crate) fn did_you_mean(written: &str, valid: &[&str]) -> Option<String> {
    let close = close_names(written, valid);
    (!close.is_empty()).then(|| format!("did you mean {}?", one_of(&close)))
}

/// Whether the one was probably meant to be the other.
pub(crate) fn is_close(written: &str, valid: &str) -> bool {
    !close_names(written, &[valid]).is_empty()
}

/// At most three names within a third of the length (and at least two edits for short ones),
/// the closest first. Upper and lower case count as half an edit apart: they sort behind equal
/// letters and before others.
fn close_names<'a>(written: &str, valid: &[&'a str]) -> Vec<&'a str> {
    if written.len() > LONGEST_SEARCHED || valid.len() > MOST_SEARCHED {
        return Vec::new();
    }
    let folded = written.to_lowercase();
    let mut close: Vec<(usize, &str)> = valid
        .iter()
        .filter(|name| name.len() <= LONGEST_SEARCHED && !written.is_empty())
        .filter_map(|&name| {
            let longer = written.chars().count().max(name.chars().count());
            let edits = strsim::osa_distance(&folded, &name.to_lowercase());
            let allowed = (longer / 3).max(1);
            let cased = usize::from(edits == 0 && name != written);
            (edits <= allowed && edits < longer).then_some((2 * edits + cased, name))
        })
        .collect();
    close.sort_unstable();
    close.dedup();
    close
        .into_iter()
        .take(MOST_SUGGESTIONS)
        .map(|(_, name)| name)
        .collect()
}

/// `a`, `b` or `c`.
pub(crate) fn one_of(names: &[&str]) -> String {
    joined(names, "or")
}

/// `a`, `b` and `c`.
pub(crate) fn all_of(names: &[&str]) -> String {
    joined(names, "and")
}

fn joined(names: &[&str], word: &str) -> String {
    let quoted: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    match quoted.split_last() {
        None => String::new(),
        Some((last, [])) => last.clone(),
        Some((last, rest)) => format!("{} {word} {last}", rest.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_closest_names_come_first_and_at_most_three() {
        let valid = ["width", "depth", "weight", "thickness", "widths", "wid"];
        assert_eq!(
            help("widht", "key", valid).as_deref(),
            Some("did you mean `width`, `weight` or `widths`?")
        );
        assert_eq!(
            help("WIDTH", "key", ["width", "material"]).as_deref(),
            Some("did you mean `width`?")
        );
    }

    #[test]
    fn few_names_are_listed_where_none_is_close_and_many_are_not() {
        assert_eq!(
            help("zzzz", "point", ["a", "b", "c"]).as_deref(),
            Some("the points are `a`, `b` and `c`")
        );
        assert_eq!(
            help("zzzz", "point", ["a"]).as_deref(),
            Some("the only point is `a`")
        );
        assert_eq!(help("zzzz", "point", (0..9).map(|_| "abc")), None);
        assert_eq!(help("zzzz", "point", []), None);
    }
}
