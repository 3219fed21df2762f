//! `egg verify`: are the files of a build those of its plan?

use crate::cli::console::Console;
use crate::cli::exit::Exit;
use crate::diagnostics::SpanTable;
use crate::diagnostics::render::{Source, Sources};
use crate::fabrication::readback::{Folder, verify};
use serde::Serialize;
use std::fs;
use std::io;
use std::path::Path;

pub(in crate::cli) fn run(console: Console, folder: &Path) -> Result<Exit, Exit> {
    let files = read(folder).map_err(|error| {
        let message = format!("cannot read `{}`: {error}", folder.display());
        console.complain(&message, Some("name the output folder of a build"));
        Exit::Usage
    })?;
    match verify(&files) {
        Ok(agreement) => {
            console.record(&Verified {
                reason: "verified",
                name: &agreement.name,
                cut_files: agreement.cut_files,
                parts: agreement.parts,
                openings: agreement.openings,
                pairs: agreement.pairs,
                rows: agreement.rows,
                solids: agreement.solids,
            });
            let solids = match agreement.solids {
                0 => String::new(),
                1 => ", 1 printed support".to_owned(),
                several => format!(", {several} printed supports"),
            };
            console.status(
                "Verified",
                &format!(
                    "{}: {} parts with {} openings in {} cut files, {} pairs of drawings, \
                     {} rows of tables{solids}",
                    agreement.name,
                    agreement.parts,
                    agreement.openings,
                    agreement.cut_files,
                    agreement.pairs,
                    agreement.rows
                ),
            );
            Ok(Exit::Done)
        }
        Err(differences) => {
            let spans = SpanTable::default();
            let sources = Sources {
                project: Source { name: "", text: "" },
                spans: &spans,
                mesh: None,
            };
            console.tell(&differences, &sources);
            Ok(Exit::Errors)
        }
    }
}

#[derive(Serialize)]
struct Verified<'a> {
    reason: &'static str,
    name: &'a str,
    cut_files: usize,
    parts: usize,
    openings: usize,
    pairs: usize,
    rows: usize,
    solids: usize,
}

/// All files below a folder. Links are not followed: what they lead to is not of the build.
fn read(folder: &Path) -> io::Result<Folder> {
    let mut files = Folder::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(next) = folders.pop() {
        for entry in fs::read_dir(&next)? {
            let entry = entry?;
            let kind = entry.file_type()?;
            if kind.is_dir() {
                folders.push(entry.path());
            } else if kind.is_file() {
                let path = entry.path();
                let name = path.strip_prefix(folder).unwrap_or(&path);
                let name = name.to_string_lossy().replace('\\', "/");
                files.insert(name, fs::read(&path)?);
            }
        }
    }
    Ok(files)
}
