//! Tables and the step list.

use super::OutputFile;
use crate::fabrication::cut_list::{Woods, cut_list};
use crate::fabrication::workbook::{self, Tab};
use crate::fabrication::{assembly, stickers, supports, tables};
use crate::plan::Plan;
use crate::project::model::Hardware;

/// The step list.
pub fn assembly_file(plan: &Plan, hardware: &Hardware) -> OutputFile {
    OutputFile {
        path: "assembly.md".to_owned(),
        bytes: assembly::steps(plan, hardware),
    }
}

/// The tables, each as CSV, and all of them as a workbook.
pub fn table_files(plan: &Plan, hardware: &Hardware, woods: &Woods) -> Vec<OutputFile> {
    let mut made = vec![
        ("Summary", "summary", tables::summary(plan)),
        ("Shopping", "bom", tables::bom(&plan.bill_of_materials)),
        ("Cut list", "cutlist", cut_list(plan, woods)),
        ("Crossings", "crossings", tables::crossings(plan, hardware)),
    ];
    if !plan.stickers.is_empty() {
        made.push(("Stickers", "stickers", stickers::table(plan)));
    }
    if !plan.supports.is_empty() {
        made.push(("Supports", "supports", supports::table(plan)));
    }
    let tabs: Vec<Tab<'_>> = made
        .iter()
        .map(|(name, _, csv)| Tab { name, csv })
        .collect();
    let workbook = workbook::write(&plan.name, &tabs);
    let mut files: Vec<OutputFile> = made
        .into_iter()
        .map(|(_, name, bytes)| OutputFile {
            path: format!("{name}.csv"),
            bytes,
        })
        .collect();
    files.push(OutputFile {
        path: "bill.xlsx".to_owned(),
        bytes: workbook,
    });
    files
}
