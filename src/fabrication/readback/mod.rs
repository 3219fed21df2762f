//! Reading back: are the files of a build those of its plan?
//!
//! Files travel: they are copied to a machine, edited in a drawing program, mixed with those of
//! an older build. This room reads them with readers of its own, which share nothing with the
//! writers but the layers' names, and compares what they hold with the plan beside them:
//!
//! | files | are compared with |
//! |---|---|
//! | cut files, one a sheet or window | outlines of all parts at their places, every opening ([`sheets`]) |
//! | `parts/*.dxf` | outline and openings of the part |
//! | every SVG beside a DXF | the same curves on the same layers to a thousandth of a millimetre ([`curves`]) |
//! | STL and 3MF of printed supports | closed bodies, their height, foot and volume ([`solids`]) |
//! | `cutlist.csv`, `crossings.csv`, `bom.csv` | ids, counts and lengths ([`tables`]) |
//!
//! Pure functions over bytes: who reads folders is the command line.

mod curves;
mod dxf;
mod expected;
mod sheets;
mod solids;
mod svg;
mod tables;

use crate::diagnostics::Diagnostic;
use crate::diagnostics::codes::fabrication as codes;
use crate::plan::{Plan, ReadError, from_ron};
use std::collections::BTreeMap;

/// Files by their path in the folder, with forward slashes.
pub type Folder = BTreeMap<String, Vec<u8>>;

/// What was found to agree.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Agreement {
    /// Name of the project.
    pub name: String,
    /// Cut files.
    pub cut_files: usize,
    /// Parts on all sheets.
    pub parts: usize,
    /// Openings on all sheets.
    pub openings: usize,
    /// Pairs of DXF and SVG.
    pub pairs: usize,
    /// Rows of tables.
    pub rows: usize,
    /// Printed supports.
    pub solids: usize,
}

/// Compares the files of a build with its plan. All differences are told.
pub fn verify(folder: &Folder) -> Result<Agreement, Vec<Diagnostic>> {
    let plan = plan(folder).map_err(|error| vec![*error])?;
    let mut findings = Findings::default();
    let mut agreement = Agreement {
        name: plan.name.clone(),
        ..Agreement::default()
    };
    let drawings = curves::read_all(folder, &mut findings);
    sheets::check(&plan, folder, &drawings, &mut agreement, &mut findings);
    sheets::check_parts(&plan, folder, &drawings, &mut findings);
    curves::check_pairs(&drawings, &mut agreement, &mut findings);
    tables::check(&plan, folder, &mut agreement, &mut findings);
    solids::check(&plan, folder, &mut agreement, &mut findings);
    if findings.0.is_empty() {
        Ok(agreement)
    } else {
        Err(findings.0)
    }
}

fn plan(folder: &Folder) -> Result<Plan, Box<Diagnostic>> {
    let error = |message: String| {
        Diagnostic::error(codes::PLAN_UNREADABLE, message).help("build the project again")
    };
    let Some(bytes) = folder.get("plan.ron") else {
        let missing = error("there is no `plan.ron` in the folder".to_owned());
        return Err(Box::new(missing.help(
            "name the output folder of a build, such as `build/pavilion`",
        )));
    };
    let text = String::from_utf8_lossy(bytes);
    from_ron(&text).map_err(|told| {
        Box::new(error(match told {
            ReadError::Malformed {
                message,
                at: (line, column),
            } => format!("`plan.ron` is no plan: {message} in line {line}, column {column}"),
            ReadError::UnknownFormat(format) => {
                format!("`plan.ron` has format {format}, which this program does not know")
            }
        }))
    })
}

/// Differences in the order in which they are found.
#[derive(Debug, Default)]
struct Findings(Vec<Diagnostic>);

impl Findings {
    fn missing(&mut self, what: &str, subject: &str) {
        let message = format!("{what} is not in the folder");
        self.0.push(
            Diagnostic::error(codes::FILE_MISSING, message)
                .help("build the project again")
                .about(subject),
        );
    }

    fn unreadable(&mut self, path: &str, why: &str) {
        let message = format!("`{path}` cannot be read: {why}");
        self.0
            .push(Diagnostic::error(codes::FILE_UNREADABLE, message));
    }

    fn unexpected(&mut self, path: &str) {
        let message = format!("`{path}` is a cut file, but not of this plan");
        self.0.push(
            Diagnostic::error(codes::FILE_UNEXPECTED, message)
                .help("remove it, so that nobody cuts it"),
        );
    }

    fn part(&mut self, path: &str, part: &str, how: &str) {
        let message = format!("`{path}`: part `{part}` {how}");
        self.0
            .push(Diagnostic::error(codes::PART_DIFFERS, message).about(part));
    }

    fn drawing(&mut self, path: &str, how: &str) {
        let message = format!("`{path}` {how}");
        self.0
            .push(Diagnostic::error(codes::DRAWINGS_DIFFER, message));
    }

    fn table(&mut self, path: &str, row: &str, how: &str) {
        let message = format!("`{path}`: `{row}` {how}");
        self.0
            .push(Diagnostic::error(codes::TABLE_DIFFERS, message).about(row));
    }
}
