//! `egg explain`: what a diagnostic code means, or why an output is as it is.

use crate::build::graph::Extent;
use crate::build::{Explanation, Reason, State};
use crate::cli::args::Global;
use crate::cli::console::{Console, out};
use crate::cli::design::Opened;
use crate::cli::exit::Exit;
use crate::cli::run::Job;
use crate::diagnostics::codes;
use std::fmt::Write;
use std::path::Path;

/// Explains a code, or an output or stage of the project in the current folder.
pub(in crate::cli) fn run(
    console: Console,
    global: &Global,
    what: &[String],
) -> Result<Exit, Exit> {
    match what {
        [code] if codes::find(code).is_some() => Ok(explain_code(code)),
        [code] if looks_like_code(code) => {
            console.complain(
                &format!("there is no diagnostic `{code}`"),
                Some("codes look like E0503 or W0601"),
            );
            Err(Exit::Usage)
        }
        [subject] => explain_output(console, global, None, subject),
        [file, subject] => explain_output(console, global, Some(Path::new(file)), subject),
        _ => Err(Exit::Usage),
    }
}

fn looks_like_code(text: &str) -> bool {
    let mut chars = text.chars();
    matches!(chars.next(), Some('E' | 'W' | 'e' | 'w')) && chars.all(|c| c.is_ascii_digit())
}

fn explain_code(code: &str) -> Exit {
    if let Some(info) = codes::find(code) {
        out(&format!(
            "{} {}: {}\n\n{}\n",
            info.code, info.name, info.title, info.text
        ));
    }
    Exit::Done
}

fn explain_output(
    console: Console,
    global: &Global,
    file: Option<&Path>,
    subject: &str,
) -> Result<Exit, Exit> {
    let opened = Opened::open(console, file)?;
    let job = Job::prepare(console, global, opened)?;
    let Some(explanation) = job.explain(subject, Extent::Files)? else {
        console.complain(
            &format!("`{subject}` is no output and no stage of this project"),
            Some("outputs are named as below the output directory: `fabrication/NAME.dxf`"),
        );
        return Err(Exit::Usage);
    };
    if console.is_json() {
        console.record(&explanation);
    } else {
        out(&describe(&explanation, &job.opened));
    }
    Ok(Exit::Done)
}

/// Causes first, then every line of the project file that it is made from.
fn describe(explanation: &Explanation, opened: &Opened) -> String {
    let mut text = format!("{} is {}\n", explanation.instance, explanation.state.word());
    let tense = match (explanation.pending, &explanation.state) {
        (true, State::Cached) => "the next build takes it from the cache because",
        (true, _) => "it will be made again because",
        (false, _) => "it last changed because",
    };
    if !explanation.causes.is_empty() {
        let _ = writeln!(text, "\n{tense}");
    }
    for cause in &explanation.causes {
        let way: Vec<String> = cause.path.iter().map(ToString::to_string).collect();
        let place = match &cause.reason {
            Reason::InputChanged { key: Some(key), .. } => opened.place_of(key),
            _ => None,
        };
        let place = place.map_or_else(String::new, |place| format!("  ({place})"));
        let _ = writeln!(text, "  {}{place}\n    {}", cause.reason, way.join(" > "));
    }
    let keys = explanation
        .influences
        .iter()
        .filter_map(|one| one.key.as_deref());
    let lines = opened.lines_of(keys);
    if !lines.is_empty() {
        let _ = writeln!(text, "\nit is made from\n{}", lines.join("\n"));
    }
    text
}
