//! `egg git`: `git diff` of plans and drawings in terms of parts.
//!
//! Git asks a *textconv* program for a text of each side and compares the texts. Which program is
//! a matter of the clone (`.git/config`), for which files it is a matter of attributes; both are
//! written here and taken away again, and nothing else is touched.

use crate::cli::args::{Attributes, GitCommand};
use crate::cli::commands::diff::bad_plan;
use crate::cli::console::{Console, out};
use crate::cli::exit::Exit;
use crate::cli::git::{git, no_git};
use crate::diagnostics::Diagnostic;
use crate::diagnostics::codes::diff as codes;
use crate::diff::{dxf_as_text, plan_as_text};
use crate::plan::from_ron;
use std::path::{Path, PathBuf};

/// Name of the driver in git's configuration.
const DRIVER: &str = "egg";
const BEGIN: &str = "# egg: begin (written by `egg git install`)";
const END: &str = "# egg: end";
/// Which files are compared by parts.
const PATTERNS: [&str; 2] = ["plan.ron", "*.dxf"];

pub(in crate::cli) fn run(console: Console, command: &GitCommand) -> Result<Exit, Exit> {
    match command {
        GitCommand::Install { attributes } => install(console, *attributes),
        GitCommand::Uninstall => uninstall(console),
        GitCommand::Textconv { file } => textconv(console, file),
    }
}

fn install(console: Console, attributes: Attributes) -> Result<Exit, Exit> {
    let program = std::env::current_exe()
        .ok()
        .and_then(|path| path.to_str().map(str::to_owned))
        .unwrap_or_else(|| "egg".to_owned());
    // Git hands the command to a shell, also on Windows.
    let quoted = format!("'{}'", program.replace('\\', "/").replace('\'', "'\\''"));
    configure(console, "textconv", &format!("{quoted} git textconv"))?;
    configure(console, "cachetextconv", "true")?;
    let path = attributes_path(console, attributes)?;
    let text = std::fs::read_to_string(&path).unwrap_or_default();
    let mut lines = without_block(&text);
    lines.extend([BEGIN, "\n"]);
    for pattern in PATTERNS {
        lines.extend([pattern, " diff=", DRIVER]);
        if attributes == Attributes::Shared {
            lines.push_str(" linguist-generated");
        }
        lines.push('\n');
    }
    lines.extend([END, "\n"]);
    write(console, &path, &lines)?;
    let what = format!(
        "`git diff` shows parts of plans and drawings ({})",
        path.display()
    );
    console.status("Installed", &what);
    Ok(Exit::Done)
}

fn uninstall(console: Console) -> Result<Exit, Exit> {
    let section = format!("diff.{DRIVER}");
    // A clone in which nothing was installed has no such section.
    let output = git(Path::new("."))
        .args(["config", "--local", "--remove-section", &section])
        .output()
        .map_err(|error| tell(console, no_git(&error)))?;
    let mut removed = output.status.success();
    for attributes in [Attributes::Local, Attributes::Shared] {
        let path = attributes_path(console, attributes)?;
        let Ok(text) = std::fs::read_to_string(&path) else {
            continue;
        };
        let rest = without_block(&text);
        if rest == text {
            continue;
        }
        removed = true;
        if rest.is_empty() {
            std::fs::remove_file(&path).map_err(|error| unwritable(console, &path, &error))?;
        } else {
            write(console, &path, &rest)?;
        }
    }
    let what = if removed {
        "`git diff` shows plans and drawings as they are written"
    } else {
        "nothing was installed in this clone"
    };
    console.status("Uninstalled", what);
    Ok(Exit::Done)
}

/// The text of a file by its parts. What cannot be understood is shown as it is: git has asked
/// for something to compare, and an error would end its whole command.
fn textconv(console: Console, file: &Path) -> Result<Exit, Exit> {
    let bytes = std::fs::read(file).map_err(|error| {
        console.complain(&format!("cannot read `{}`: {error}", file.display()), None);
        Exit::Usage
    })?;
    let text = String::from_utf8_lossy(&bytes);
    let shown = file.display().to_string();
    if text.trim_start().starts_with('(') {
        match from_ron(&text) {
            Ok(plan) => out(&plan_as_text(&plan)),
            Err(error) => {
                console.tell_plainly(&[bad_plan(&shown, &error)]);
                out(&text);
            }
        }
        return Ok(Exit::Done);
    }
    match dxf_as_text(&bytes) {
        Ok(parts) => out(&parts),
        Err(what) => {
            let message = format!("`{shown}` is neither a plan nor a drawing: {what}");
            console.tell_plainly(&[Diagnostic::warning(codes::BAD_PLAN, message)]);
            out(&text);
        }
    }
    Ok(Exit::Done)
}

/// Sets a value of the driver in the clone's own configuration.
fn configure(console: Console, key: &str, value: &str) -> Result<(), Exit> {
    let key = format!("diff.{DRIVER}.{key}");
    let output = git(Path::new("."))
        .args(["config", "--local", &key, value])
        .output()
        .map_err(|error| tell(console, no_git(&error)))?;
    if output.status.success() {
        return Ok(());
    }
    let said = String::from_utf8_lossy(&output.stderr).trim().to_owned();
    let message = "the current folder is in no git repository that can be configured";
    let told = Diagnostic::error(codes::NO_REPOSITORY, message).note(format!("git says: {said}"));
    Err(tell(console, told))
}

/// The file with attributes: of this clone alone, or the one that is committed.
fn attributes_path(console: Console, attributes: Attributes) -> Result<PathBuf, Exit> {
    let arguments: &[&str] = match attributes {
        Attributes::Local => &["rev-parse", "--git-path", "info/attributes"],
        Attributes::Shared => &["rev-parse", "--show-toplevel"],
    };
    let output = git(Path::new("."))
        .args(arguments)
        .output()
        .map_err(|error| tell(console, no_git(&error)))?;
    let text = String::from_utf8_lossy(&output.stdout);
    let path = PathBuf::from(text.trim_end_matches('\n'));
    if !output.status.success() {
        let message = "the current folder is in no git repository with a working tree";
        return Err(tell(
            console,
            Diagnostic::error(codes::NO_REPOSITORY, message),
        ));
    }
    Ok(match attributes {
        Attributes::Local => path,
        Attributes::Shared => path.join(".gitattributes"),
    })
}

/// A text without the lines that egg wrote; all others stay as they are.
fn without_block(text: &str) -> String {
    let mut rest = String::new();
    let mut inside = false;
    for line in text.split_inclusive('\n') {
        let word = line.trim_end();
        if word == BEGIN {
            inside = true;
        } else if word == END && inside {
            inside = false;
        } else if !inside {
            rest.push_str(line);
        }
    }
    if !rest.is_empty() && !rest.ends_with('\n') {
        rest.push('\n');
    }
    rest
}

fn write(console: Console, path: &Path, text: &str) -> Result<(), Exit> {
    let folder = path.parent().unwrap_or(Path::new("."));
    std::fs::create_dir_all(folder)
        .and_then(|()| std::fs::write(path, text))
        .map_err(|error| unwritable(console, path, &error))
}

fn unwritable(console: Console, path: &Path, error: &std::io::Error) -> Exit {
    console.complain(&format!("cannot write `{}`: {error}", path.display()), None);
    Exit::Usage
}

fn tell(console: Console, told: Diagnostic) -> Exit {
    console.tell_plainly(&[told]);
    Exit::Usage
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_lines_of_egg_are_taken_away() {
        let text = format!("*.obj -text\n{BEGIN}\nplan.ron diff=egg\n{END}\n*.png binary\n");
        assert_eq!(without_block(&text), "*.obj -text\n*.png binary\n");
        assert_eq!(without_block("*.obj -text"), "*.obj -text\n");
        assert_eq!(without_block(""), "");
    }
}
