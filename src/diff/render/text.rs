//! The difference for a terminal: what to cut, in one screen. The verdict stands first and last,
//! the worst changes first, what is unchanged not at all.

use super::words::{Row, hidden, project, ranges, rows, several, side, total, verdict};
use crate::diff::class::Class;
use crate::diff::document::{Action, Difference, Edit};
use std::collections::BTreeMap;
use std::fmt::Write;

/// How the text looks.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Look {
    /// Without colour, long lists cut short.
    #[default]
    Plain,
    /// In colour, long lists cut short.
    Colour,
    /// Without colour, everything.
    Everything,
}

const ARROW: &str = "->";

/// Most rows of a class before the rest is told by ids alone.
fn most_rows(class: Class, look: Look) -> usize {
    match (look, class) {
        (Look::Everything, _) => usize::MAX,
        (_, Class::Recut) => 12,
        _ => 4,
    }
}

/// The difference as text.
pub fn text(difference: &Difference, look: Look) -> String {
    let mut text = String::new();
    let sides = [&difference.before, &difference.after].map(side);
    let name = project(difference, ARROW);
    let _ = writeln!(
        text,
        "{}",
        bold(&format!("{name}: {} {ARROW} {}", sides[0], sides[1]), look)
    );
    if let Some(subject) = &difference.after.subject {
        let _ = writeln!(text, "  {subject}");
    }
    let verdict = coloured(&verdict(difference), difference.summary.class, look);
    let _ = writeln!(text, "{verdict}");
    for note in &difference.notes {
        let _ = writeln!(text, "note: {note}");
    }
    edits(&mut text, &difference.edits, look);
    if !difference.renames.is_empty() {
        text.push_str("\nRenamed\n");
        for rename in &difference.renames {
            let what = format!("{} {} {ARROW} {}", rename.what, rename.before, rename.after);
            let _ = writeln!(text, "  > {what}");
        }
    }
    let totals: Vec<[String; 4]> = difference.summary.totals.iter().filter_map(total).collect();
    if !totals.is_empty() {
        text.push_str("\nTotals\n");
        let width = |cell: usize| totals.iter().map(|row| row[cell].len()).max().unwrap_or(0);
        let (name, before, after) = (width(0), width(1), width(2));
        for [what, was, is, delta] in &totals {
            let _ = writeln!(
                text,
                "  {what:name$}  {was:>before$} {ARROW} {is:>after$}  {delta}"
            );
        }
    }
    for class in Class::REVIEWED {
        section(&mut text, difference, class, look);
    }
    for (head, list) in [
        ("New warnings", &difference.new_warnings),
        ("Warnings that are gone", &difference.gone_warnings),
    ] {
        if !list.is_empty() {
            let _ = writeln!(text, "\n{head}");
            for warning in list.iter().take(8) {
                let _ = writeln!(text, "  {warning}");
            }
            if list.len() > 8 {
                let _ = writeln!(text, "  and {} more", list.len() - 8);
            }
        }
    }
    if difference.summary.class.is_some() {
        let _ = writeln!(text, "\n{verdict}");
        let hidden = hidden(difference);
        if !hidden.is_empty() {
            let _ = writeln!(text, "{hidden}");
        }
    }
    text
}

fn edits(text: &mut String, edits: &[Edit], look: Look) {
    if edits.is_empty() {
        return;
    }
    text.push_str("\nEdited\n");
    let most = if look == Look::Everything {
        usize::MAX
    } else {
        10
    };
    for edit in edits.iter().take(most) {
        let what = match (&edit.before, &edit.after) {
            (Some(before), Some(after)) => format!("~ {} {before} {ARROW} {after}", edit.key),
            (None, Some(after)) => format!("+ {} {after}", edit.key),
            (before, None) => format!("- {} {}", edit.key, before.as_deref().unwrap_or("")),
        };
        let place = edit
            .place
            .as_ref()
            .map_or(String::new(), |place| format!("  ({place})"));
        let _ = writeln!(text, "  {what}{place}");
    }
    if edits.len() > most {
        let _ = writeln!(text, "  and {} more", edits.len() - most);
    }
}

fn section(text: &mut String, difference: &Difference, class: Class, look: Look) {
    let all = rows(difference.of(class), ARROW);
    if all.is_empty() {
        return;
    }
    let count = difference.of(class).count();
    let _ = writeln!(
        text,
        "\n{} ({count})",
        coloured(class.heading(), Some(class), look)
    );
    let most = most_rows(class, look);
    // One more row costs no more than the line that would tell of it.
    let shown = if all.len() <= most.saturating_add(1) {
        all.len()
    } else {
        most
    };
    let width = all[..shown]
        .iter()
        .map(|row| name(row).len())
        .max()
        .unwrap_or(0)
        .min(28);
    for row in &all[..shown] {
        let mark = row.action.mark();
        let name = name(row);
        let what = row.what.join("; ");
        let on = match row.used_on.as_slice() {
            [] => String::new(),
            sheets => format!("  [{}]", ranges(sheets)),
        };
        let line = format!("{mark} {name:width$}  {what}{on}");
        let _ = writeln!(text, "  {}", by_action(&line, row.action, look));
    }
    let mut rest: BTreeMap<_, Vec<String>> = BTreeMap::new();
    for row in &all[shown..] {
        rest.entry(row.kind)
            .or_default()
            .extend(row.ids.iter().cloned());
    }
    for (kind, ids) in rest {
        let _ = writeln!(
            text,
            "  and {} more: {}",
            several(ids.len(), kind_word(kind)),
            list(&ids)
        );
    }
}

/// Ids as ranges, cut short if they fill more than a few lines.
fn list(ids: &[String]) -> String {
    let all = ranges(ids);
    if all.len() <= 240 {
        return all;
    }
    let end = all[..240].rfind(", ").unwrap_or(240);
    format!("{}, ... (all with `--all`)", &all[..end])
}

fn kind_word(kind: crate::diff::Kind) -> &'static str {
    match kind {
        crate::diff::Kind::BillRow => "bill row",
        kind => kind.word(),
    }
}

/// What a row is about; the kind is left out where the id says it.
fn name(row: &Row) -> String {
    use crate::diff::Kind::{Lamella, Sheet, Structure, Support};
    match row.kind {
        Lamella | Sheet | Support | Structure => list(&row.ids),
        kind => format!("{} {}", kind_word(kind), list(&row.ids)),
    }
}

fn bold(text: &str, look: Look) -> String {
    match look {
        Look::Colour => format!("\u{1b}[1m{text}\u{1b}[0m"),
        _ => text.to_owned(),
    }
}

fn coloured(text: &str, class: Option<Class>, look: Look) -> String {
    let code = match (look, class) {
        (Look::Colour, Some(Class::Recut)) => "1;31",
        (Look::Colour, Some(Class::Reassemble)) => "1;33",
        (Look::Colour, Some(Class::Redraw)) => "1;34",
        (Look::Colour, _) => "1;32",
        _ => return text.to_owned(),
    };
    format!("\u{1b}[{code}m{text}\u{1b}[0m")
}

fn by_action(line: &str, action: Action, look: Look) -> String {
    let code = match (look, action) {
        (Look::Colour, Action::Added) => "32",
        (Look::Colour, Action::Removed) => "31",
        (Look::Colour, Action::Changed) => "33",
        (Look::Colour, Action::Renamed) => "34",
        _ => return line.to_owned(),
    };
    format!("\u{1b}[{code}m{line}\u{1b}[0m")
}
