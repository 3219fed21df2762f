//! The difference for a pull request: short at the top, the rest folded, and never longer than
//! what a forge takes. The first line is a hidden mark by which a bot finds its own comment and
//! updates it.

use super::words::{Row, hidden, project, ranges, rows, side, total, verdict};
use crate::diff::class::Class;
use crate::diff::document::Difference;
use crate::diff::part::Kind;
use std::fmt::Write;

/// Largest size, bytes: GitHub takes 65 536 characters, and a bot adds a line or two.
pub const MARKDOWN_LIMIT: usize = 60_000;

const ARROW: &str = "→";
/// Rows that are shown of what has to be cut before the rest is folded.
const OPEN_ROWS: usize = 12;

/// The hidden mark of a project's comment.
pub fn marker(project: &str) -> String {
    let words: Vec<&str> = project
        .split(|c: char| !c.is_alphanumeric())
        .filter(|word| !word.is_empty())
        .collect();
    format!("<!-- egg diff: {} -->", words.join("-"))
}

/// The difference as Markdown of at most so many bytes.
pub fn markdown(difference: &Difference, most: usize) -> String {
    let verdict = verdict(difference);
    let sides = [&difference.before, &difference.after].map(side);
    let mut text = format!(
        "{}\n### {}: {}\n\n`{}` {ARROW} `{}`",
        marker(&difference.after.project),
        escaped(&project(difference, ARROW)),
        escaped(&verdict),
        sides[0],
        sides[1]
    );
    if let Some(subject) = &difference.after.subject {
        let _ = write!(text, ", {}", escaped(subject));
    }
    text.push_str("\n\n");
    for note in &difference.notes {
        let _ = writeln!(text, "> **Note:** {}\n", escaped(note));
    }
    let end = end(difference, &verdict);
    let mut page = Page {
        text,
        room: most.saturating_sub(end.len() + 200),
        left: 0,
    };
    edits(&mut page, difference);
    totals(&mut page, difference);
    for class in Class::REVIEWED {
        section(&mut page, difference, class);
    }
    warnings(&mut page, difference);
    if page.left > 0 {
        let _ = writeln!(
            page.text,
            "**{} more rows did not fit here**; `egg diff` tells all.\n",
            page.left
        );
    }
    page.text + &end
}

/// A text with a limit.
struct Page {
    text: String,
    room: usize,
    /// Rows that did not fit.
    left: usize,
}

impl Page {
    /// Adds a table, folded under its head if that is wanted; rows that do not fit are counted.
    fn table(&mut self, head: &str, columns: &[&str], rows: &[String], fold: Fold) {
        if rows.is_empty() {
            return;
        }
        let rule: String = columns
            .iter()
            .map(|name| match *name {
                "before" | "after" | "change" if columns[0].is_empty() => " ---: |",
                _ => " --- |",
            })
            .collect();
        let columns = columns.join(" | ");
        let (open, close) = match fold {
            Fold::Open => (format!("#### {head}\n\n"), "\n"),
            Fold::Folded => (
                format!("<details><summary>{head}</summary>\n\n"),
                "\n</details>\n\n",
            ),
        };
        let begin = format!("{open}| {columns} |\n|{rule}\n");
        let mut size = self.text.len() + begin.len() + close.len();
        let fitting = rows
            .iter()
            .take_while(|row| {
                size += row.len() + 1;
                size <= self.room
            })
            .count();
        self.left += rows.len() - fitting;
        if fitting > 0 {
            self.text.push_str(&begin);
            for row in &rows[..fitting] {
                self.text.extend([row, "\n"]);
            }
            self.text.push_str(close);
        }
    }
}

/// Whether a table is shown at once.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Fold {
    Open,
    Folded,
}

fn edits(page: &mut Page, difference: &Difference) {
    let mut rows: Vec<String> = difference
        .edits
        .iter()
        .map(|edit| {
            let value = |value: &Option<String>| match value {
                Some(value) => code(value),
                None => String::new(),
            };
            let place = edit.place.as_deref().unwrap_or("");
            let (before, after) = (value(&edit.before), value(&edit.after));
            format!(
                "| {} | {before} | {after} | {} |",
                code(&edit.key),
                escaped(place)
            )
        })
        .collect();
    rows.extend(difference.renames.iter().map(|rename| {
        let (before, after) = (code(&rename.before), code(&rename.after));
        format!("| {} renamed | {before} | {after} | |", rename.what)
    }));
    let fold = if rows.len() <= 10 {
        Fold::Open
    } else {
        Fold::Folded
    };
    let head = format!("Edited ({})", rows.len());
    page.table(&head, &["what", "before", "after", "where"], &rows, fold);
}

fn totals(page: &mut Page, difference: &Difference) {
    let rows: Vec<String> = difference
        .summary
        .totals
        .iter()
        .filter_map(total)
        .map(|[what, before, after, delta]| format!("| {what} | {before} | {after} | {delta} |"))
        .collect();
    page.table(
        "Totals",
        &["", "before", "after", "change"],
        &rows,
        Fold::Open,
    );
}

fn section(page: &mut Page, difference: &Difference, class: Class) {
    let all = rows(difference.of(class), ARROW);
    let count = difference.of(class).count();
    let open = match class {
        Class::Recut if all.len() <= OPEN_ROWS + 2 => all.len(),
        Class::Recut => OPEN_ROWS,
        _ => 0,
    };
    let lines = |rows: &[Row]| -> Vec<String> { rows.iter().map(line).collect() };
    let columns = &["", "part", "what", "sheet"];
    let head = format!("{} ({count})", class.heading());
    page.table(&head, columns, &lines(&all[..open]), Fold::Open);
    let rest = &all[open..];
    let parts: usize = rest.iter().map(|row| row.ids.len()).sum();
    let head = if open > 0 {
        format!("{parts} more to cut")
    } else {
        head
    };
    page.table(&head, columns, &lines(rest), Fold::Folded);
}

fn line(row: &Row) -> String {
    let kind = match row.kind {
        Kind::Lamella | Kind::Sheet | Kind::Support | Kind::Structure => String::new(),
        Kind::BillRow => "bill row ".to_owned(),
        kind => format!("{} ", kind.word()),
    };
    format!(
        "| {} | {kind}{} | {} | {} |",
        row.action
            .mark()
            .to_string()
            .replace('-', "−")
            .replace('~', "\\~"),
        code(&ranges(&row.ids)),
        escaped(&row.what.join("; ")),
        escaped(&ranges(&row.used_on)),
    )
}

fn warnings(page: &mut Page, difference: &Difference) {
    for (head, list) in [
        ("New warnings", &difference.new_warnings),
        ("Warnings that are gone", &difference.gone_warnings),
    ] {
        let rows: Vec<String> = list
            .iter()
            .map(|told| format!("| {} |", escaped(told)))
            .collect();
        page.table(
            &format!("{head} ({})", rows.len()),
            &["warning"],
            &rows,
            Fold::Folded,
        );
    }
}

/// The last lines: the verdict again, and what was hidden.
fn end(difference: &Difference, verdict: &str) -> String {
    let tolerance = difference.tolerance.length;
    let hidden = hidden(difference);
    let mut end = String::new();
    if difference.summary.class.is_some() {
        let _ = writeln!(end, "**{}**\n", escaped(verdict));
    }
    let _ = write!(end, "<sub>`egg diff`, tolerance {tolerance} mm");
    if !hidden.is_empty() {
        let _ = write!(end, "; {}", escaped(&hidden));
    }
    end.push_str(".</sub>\n");
    end
}

/// Text that means nothing to Markdown and to tables.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '\\' | '`' | '*' | '_' | '[' | ']' | '|' | '#' | '~' | '@' => out.extend(['\\', c]),
            '\n' | '\r' => out.push(' '),
            c => out.push(c),
        }
    }
    out
}

/// Text as it is, in a cell of a table.
fn code(text: &str) -> String {
    if text.is_empty() {
        return String::new();
    }
    let text = text.replace(['\n', '\r'], " ").replace('|', "\\|");
    if text.contains('`') {
        format!("`` {text} ``")
    } else {
        format!("`{text}`")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_users_do_not_become_markdown() {
        assert_eq!(escaped("a|b <i>_x_"), "a\\|b &lt;i&gt;\\_x\\_");
        assert_eq!(code("[\"a|b\"]"), "`[\"a\\|b\"]`");
        assert_eq!(code("a`b"), "`` a`b ``");
        assert_eq!(marker("my --> dome"), "<!-- egg diff: my-dome -->");
    }
}
