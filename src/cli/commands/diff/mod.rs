//! `egg diff`: what a change does to the parts.

mod edits;
mod sides;

use crate::cli::args::{DiffArguments, DiffFormat, Global};
use crate::cli::console::{Console, out};
use crate::cli::exit::Exit;
use crate::diagnostics::Diagnostic;
use crate::diagnostics::codes::diff as codes;
use crate::diff::{
    Content, Context, Difference, Look, MARKDOWN_LIMIT, Pictures, ReadError, Side, Tolerances,
    between, html, markdown, svg, svg_of, text,
};
use sides::{Held, Loaded, Sides};
use std::path::Path;

pub(in crate::cli) use sides::{LOCK, bad_lock, bad_plan, is_memory};

/// Compares two sides and writes the difference.
pub(in crate::cli) fn run(
    console: Console,
    global: &Global,
    arguments: &DiffArguments,
) -> Result<Exit, Exit> {
    let console = console.with_document();
    let mut tolerances = Tolerances::default();
    for text in arguments.tolerance.iter().flat_map(|text| text.split(',')) {
        tolerances.set(text).map_err(|message| {
            console.complain(&message, None);
            Exit::Usage
        })?;
    }
    let (difference, complete) = if let Some(difference) = saved(console, &arguments.sides)? {
        (difference, true)
    } else {
        let sides = Sides::parse(console, &arguments.sides)?;
        let [before, after] = sides.load(console, global)?;
        compare(console, arguments, tolerances, &before, &after)?
    };
    write(console, arguments, &difference)?;
    let asked = arguments.exit_code || arguments.fail_on.is_some();
    let fail_on = arguments.fail_on.unwrap_or_default().class();
    Ok(if !complete {
        Exit::Errors
    } else if asked && difference.has(fail_on) {
        Exit::Differences
    } else {
        Exit::Done
    })
}

/// A difference that was written as JSON before.
fn saved(console: Console, sides: &[String]) -> Result<Option<Difference>, Exit> {
    let [path] = sides else { return Ok(None) };
    let is_json = Path::new(path)
        .extension()
        .is_some_and(|ending| ending == "json");
    if !(is_json && Path::new(path).is_file()) {
        return Ok(None);
    }
    let text = std::fs::read_to_string(path).map_err(|error| {
        console.complain(&format!("cannot read `{path}`: {error}"), None);
        Exit::Usage
    })?;
    Difference::from_json(&text).map(Some).map_err(|error| {
        console.tell_plainly(&[match error {
            ReadError::Malformed(what) => {
                let message = format!("`{path}` is no difference: {what}");
                Diagnostic::error(codes::BAD_PLAN, message)
            }
            ReadError::UnknownFormat(format) => sides::other_format(path, format),
        }]);
        Exit::Usage
    })
}

/// Compares what could be had of both sides, and whether that is all there is to compare.
fn compare(
    console: Console,
    arguments: &DiffArguments,
    tolerances: Tolerances,
    before: &Loaded,
    after: &Loaded,
) -> Result<(Difference, bool), Exit> {
    let edits = edits::between(before, after);
    let mut missing = Vec::new();
    for side in [before, after] {
        if matches!(side.held, Held::Nothing) {
            let message = format!("there is nothing to compare of `{}`", side.side.label);
            let told = Diagnostic::error(codes::NO_SIDE, message)
                .note("it does not compile, and no plan or lock of it is there");
            let told = edits.iter().take(10).fold(told, |told, edit| {
                let value = |value: &Option<String>| value.clone().unwrap_or("nothing".to_owned());
                let (was, is) = (value(&edit.before), value(&edit.after));
                told.note(format!("`{}` was edited: {was} -> {is}", edit.key))
            });
            missing.push(told.help("write a lock of a state that compiles: `egg lock`"));
        }
    }
    let (Some(old), Some(new)) = (before.content(), after.content()) else {
        console.tell_plainly(&missing);
        return Err(Exit::Errors);
    };
    let sides: [&Side; 2] = [&before.side, &after.side];
    let context = Context {
        sides: sides.map(Side::clone),
        tolerances,
        edits: Vec::new(),
        notes: before.notes.iter().chain(&after.notes).cloned().collect(),
        pictures: match arguments.format {
            DiffFormat::Text | DiffFormat::Markdown => Pictures::Without,
            DiffFormat::Json | DiffFormat::Svg | DiffFormat::Html => Pictures::With,
        },
    };
    let mut difference = between(old, new, context);
    difference.edits = edits::without_renames(edits, &difference.renames);
    if let (Content::Plan(a), Content::Plan(b)) = (old, new) {
        let in_common = a
            .patches
            .iter()
            .any(|one| b.patches.iter().any(|two| one.id == two.id));
        let renamed = difference
            .renames
            .iter()
            .any(|rename| rename.what == "patch");
        if a.name != b.name && !in_common && !renamed {
            let message = format!("`{}` and `{}` are two different projects", a.name, b.name);
            let told = Diagnostic::warning(codes::TWO_PROJECTS, message)
                .note("they have no patch in common, by name or by place");
            console.tell_plainly(&[told]);
        }
    }
    Ok((difference, !(before.failed || after.failed)))
}

fn write(console: Console, arguments: &DiffArguments, difference: &Difference) -> Result<(), Exit> {
    let look = match (arguments.all, &arguments.to, console.colours_results()) {
        (true, _, _) => Look::Everything,
        (false, None, true) => Look::Colour,
        _ => Look::Plain,
    };
    let limit = arguments
        .max_bytes
        .map_or(MARKDOWN_LIMIT, |bytes| bytes as usize);
    let written = match arguments.format {
        DiffFormat::Text => text(difference, look),
        DiffFormat::Markdown => markdown(difference, limit),
        DiffFormat::Json => difference.to_json(),
        DiffFormat::Html => html(difference),
        DiffFormat::Svg => match &arguments.to {
            Some(folder) if folder.extension().is_none_or(|ending| ending != "svg") => {
                return pictures(console, folder, difference);
            }
            _ => svg(difference),
        },
    };
    match &arguments.to {
        None => out(&written),
        Some(path) => put(console, path, &written)?,
    }
    Ok(())
}

/// One file a drawing.
fn pictures(console: Console, folder: &Path, difference: &Difference) -> Result<(), Exit> {
    std::fs::create_dir_all(folder).map_err(|error| unwritable(console, folder, &error))?;
    for drawing in &difference.drawings {
        let path = folder.join(format!("{}.svg", drawing.id));
        put(console, &path, &svg_of(difference, drawing))?;
    }
    Ok(())
}

fn put(console: Console, path: &Path, text: &str) -> Result<(), Exit> {
    std::fs::write(path, text).map_err(|error| unwritable(console, path, &error))?;
    console.status("Wrote", &path.display().to_string());
    Ok(())
}

fn unwritable(console: Console, path: &Path, error: &std::io::Error) -> Exit {
    console.complain(&format!("cannot write `{}`: {error}", path.display()), None);
    Exit::Usage
}
