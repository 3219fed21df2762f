//! The difference as one HTML file without network: a list of parts beside their drawings. A row
//! marks its part in the drawings and a shape marks its row; classes can be left out; the keys
//! `j` and `k` go through the rows.

use super::picture;
use super::words::{Form, hidden, phrases, project, ranges, side, total, verdict};
use crate::diff::class::Class;
use crate::diff::document::{Change, Difference};
use crate::fabrication::svg::{number, printable};
use std::fmt::Write;

const ARROW: &str = "→";
const STYLE: &str = include_str!("page.css");
const SCRIPT: &str = include_str!("page.js");

/// The difference as an HTML page.
pub fn html(difference: &Difference) -> String {
    let sides = [&difference.before, &difference.after].map(side);
    let title = format!(
        "{}: {} {ARROW} {}",
        project(difference, ARROW),
        sides[0],
        sides[1]
    );
    let verdict = escaped(&verdict(difference));
    let class = difference.summary.class.map_or("none", Class::word);
    let subject = difference.after.subject.as_deref().unwrap_or("");
    let mut page = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; \
         style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <link rel=\"icon\" href=\"data:,\">\n\
         <title>{}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n<header>\n<h1>{}</h1>\n\
         <p class=\"subject\">{}</p>\n<p class=\"verdict {class}\">{verdict}</p>\n",
        escaped(&title),
        escaped(&title),
        escaped(subject)
    );
    for note in &difference.notes {
        let _ = writeln!(page, "<p class=\"note\">Note: {}</p>", escaped(note));
    }
    page.push_str("</header>\n<main>\n<section id=\"list\">\n");
    tables(&mut page, difference);
    filter(&mut page, difference);
    page.push_str(
        "<table id=\"changes\">\n<thead><tr><th>class</th><th>part</th><th>what</th>\
         <th>sheet</th></tr></thead>\n<tbody>\n",
    );
    for change in &difference.changes {
        row(&mut page, change);
    }
    let _ = writeln!(
        page,
        "</tbody>\n</table>\n<p class=\"verdict {class}\">{verdict}</p>"
    );
    let hidden = hidden(difference);
    if !hidden.is_empty() {
        let _ = writeln!(page, "<p class=\"hidden\">{}</p>", escaped(&hidden));
    }
    page.push_str("</section>\n<section id=\"drawings\">\n");
    for drawing in &difference.drawings {
        let (picture, [width, height]) = picture::group(drawing);
        let document = svg::Document::new()
            .set(
                "viewBox",
                format!("0 0 {} {}", number(width), number(height)),
            )
            .set("role", "img")
            .set("aria-label", printable(&drawing.title))
            .add(picture);
        let _ = writeln!(
            page,
            "<figure id=\"{}\">\n<figcaption>{}</figcaption>\n{document}\n</figure>",
            escaped(&drawing.id),
            escaped(&drawing.title)
        );
    }
    if difference.drawings.is_empty() {
        page.push_str("<p>Nothing that can be drawn changed.</p>\n");
    }
    let _ = write!(
        page,
        "</section>\n</main>\n<script>\n{SCRIPT}</script>\n</body>\n</html>\n"
    );
    page
}

/// Edits, renames, sums.
fn tables(page: &mut String, difference: &Difference) {
    if !(difference.edits.is_empty() && difference.renames.is_empty()) {
        page.push_str("<h2>Edited</h2>\n<table class=\"edits\">\n");
        for edit in &difference.edits {
            let value = |value: &Option<String>| escaped(value.as_deref().unwrap_or(""));
            let _ = writeln!(
                page,
                "<tr><th>{}</th><td>{}</td><td>{ARROW} {}</td><td>{}</td></tr>",
                escaped(&edit.key),
                value(&edit.before),
                value(&edit.after),
                value(&edit.place)
            );
        }
        for rename in &difference.renames {
            let _ = writeln!(
                page,
                "<tr><th>{} renamed</th><td>{}</td><td>{ARROW} {}</td><td></td></tr>",
                escaped(&rename.what),
                escaped(&rename.before),
                escaped(&rename.after)
            );
        }
        page.push_str("</table>\n");
    }
    let totals: Vec<[String; 4]> = difference.summary.totals.iter().filter_map(total).collect();
    if !totals.is_empty() {
        page.push_str("<h2>Totals</h2>\n<table class=\"totals\">\n");
        for [what, before, after, delta] in totals {
            let _ = writeln!(
                page,
                "<tr><th>{what}</th><td>{before}</td><td>{ARROW} {after}</td><td>{delta}</td></tr>"
            );
        }
        page.push_str("</table>\n");
    }
    for (head, list) in [
        ("New warnings", &difference.new_warnings),
        ("Warnings that are gone", &difference.gone_warnings),
    ] {
        if !list.is_empty() {
            let _ = writeln!(page, "<h2>{head}</h2>\n<ul>");
            for told in list {
                let _ = writeln!(page, "<li>{}</li>", escaped(told));
            }
            page.push_str("</ul>\n");
        }
    }
}

/// Which classes are shown.
fn filter(page: &mut String, difference: &Difference) {
    page.push_str("<h2>Parts</h2>\n<form id=\"filter\">\n");
    for class in Class::REVIEWED {
        let count = difference.of(class).count();
        if count > 0 {
            let _ = writeln!(
                page,
                "<label class=\"{0}\"><input type=\"checkbox\" value=\"{0}\" checked> {1} \
                 ({count})</label>",
                class.word(),
                class.heading()
            );
        }
    }
    page.push_str(
        "<span class=\"keys\"><kbd>j</kbd> next, <kbd>k</kbd> previous, <kbd>Esc</kbd> \
         none</span>\n</form>\n",
    );
}

fn row(page: &mut String, change: &Change) {
    let class = change.class.word();
    let id = escaped(&change.id);
    let _ = writeln!(
        page,
        "<tr class=\"{class}\" data-part=\"{id}\" tabindex=\"-1\"><td><span class=\"mark\">{}</span> \
         {class}</td><td>{} <b>{id}</b></td><td>{}</td><td>{}</td></tr>",
        change.action.mark(),
        change.kind.word(),
        escaped(&phrases(change, ARROW, Form::Full).join("; ")),
        escaped(&ranges(&change.used_on))
    );
}

/// Text that means nothing to HTML.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            c if c.is_control() => out.push(' '),
            c => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_users_do_not_become_markup() {
        assert_eq!(
            escaped("<b a=\"'\">&\u{7}"),
            "&lt;b a=&quot;&#39;&quot;&gt;&amp; "
        );
    }
}
