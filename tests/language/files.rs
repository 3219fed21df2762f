//! The corpus on disk.

use egg::diagnostics::render::{Source, Sources};
use egg::project::{Loaded, Notation, load};
use std::path::Path;

/// A file of the corpus.
pub(crate) struct Case {
    /// Without folder and extension.
    pub(crate) stem: String,
    /// Without folder.
    pub(crate) name: String,
    pub(crate) notation: Notation,
    pub(crate) text: String,
    pub(crate) loaded: Loaded,
}

impl Case {
    pub(crate) fn sources(&self) -> Sources<'_> {
        Sources {
            project: Source {
                name: &self.name,
                text: &self.text,
            },
            spans: &self.loaded.spans,
            mesh: None,
        }
    }

    /// Codes in the order of the report.
    pub(crate) fn codes(&self) -> Vec<&str> {
        let diagnostics = self.loaded.diagnostics.iter();
        diagnostics
            .map(|diagnostic| diagnostic.code.as_str())
            .collect()
    }
}

/// All files of a folder of the corpus (`good`, `wrong`), by name.
pub(crate) fn cases(folder: &str) -> Vec<Case> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/corpus/projects")
        .join(folder);
    let mut paths: Vec<_> = std::fs::read_dir(folder)
        .expect("the corpus is there")
        .map(|entry| entry.expect("a readable folder").path())
        .collect();
    paths.sort();
    paths
        .into_iter()
        .map(|path| {
            let part = |part: Option<&std::ffi::OsStr>| {
                part.and_then(|part| part.to_str())
                    .expect("names are ASCII")
                    .to_owned()
            };
            let stem = part(path.file_stem());
            let notation = Notation::of_extension(&part(path.extension())).expect("TOML or RON");
            let text = std::fs::read_to_string(&path).expect("text");
            let loaded = load(&text, notation, &stem);
            Case {
                name: part(path.file_name()),
                stem,
                notation,
                text,
                loaded,
            }
        })
        .collect()
}

/// Settings of the golden files of this room.
pub(crate) fn golden(folder: &str) -> insta::Settings {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path(format!("../golden/{folder}"));
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings
}
