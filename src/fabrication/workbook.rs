//! One workbook (XLSX) with all tables, for people who live in spreadsheets.
//!
//! It is made from the CSV tables, so the two cannot disagree: a cell that holds a plain decimal
//! number becomes a number with as many decimals as the table shows, every other a text. The date
//! of creation is fixed, so equal tables give equal bytes.

use rust_xlsxwriter::{DocProperties, ExcelDateTime, Format, FormatBorder, Workbook, XlsxError};

/// Widest column in characters.
const WIDEST: usize = 60;

/// A sheet of the workbook.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tab<'a> {
    /// Its name: at most 31 characters, without `[]:*?/\`.
    pub name: &'a str,
    /// The table as CSV, the first record its header.
    pub csv: &'a [u8],
}

/// The workbook.
///
/// # Panics
/// Never: names of tabs are fixed, and no table has the million rows of a sheet.
pub fn write(title: &str, tabs: &[Tab<'_>]) -> Vec<u8> {
    made(title, tabs).expect("names of tabs are fixed, and tables have fewer rows than a sheet")
}

fn made(title: &str, tabs: &[Tab<'_>]) -> Result<Vec<u8>, XlsxError> {
    let mut workbook = Workbook::new();
    let created = ExcelDateTime::from_ymd(2000, 1, 1)?;
    workbook.set_properties(
        &DocProperties::new()
            .set_title(title)
            .set_author("egg")
            .set_creation_datetime(&created),
    );
    let head = Format::new()
        .set_bold()
        .set_border_bottom(FormatBorder::Thin);
    for tab in tabs {
        let sheet = workbook.add_worksheet();
        sheet.set_name(tab.name)?;
        sheet.set_freeze_panes(1, 0)?;
        let records = csv::ReaderBuilder::new()
            .has_headers(false)
            .from_reader(tab.csv)
            .into_records()
            .map_while(Result::ok);
        let mut widths: Vec<usize> = Vec::new();
        for (row, record) in (0_u32..).zip(records) {
            widths.resize(widths.len().max(record.len()), 0);
            for (column, cell) in (0_u16..).zip(record.iter()) {
                let width = &mut widths[usize::from(column)];
                *width = (*width).max(cell.chars().count());
                match decimal(cell) {
                    _ if row == 0 => sheet.write_with_format(row, column, cell, &head)?,
                    Some((number, decimals)) => {
                        let zeros = "0".repeat(decimals);
                        let pattern = match decimals {
                            0 => "0".to_owned(),
                            _ => format!("0.{zeros}"),
                        };
                        let format = Format::new().set_num_format(pattern);
                        sheet.write_with_format(row, column, number, &format)?
                    }
                    None if cell.is_empty() => continue,
                    None => sheet.write(row, column, cell)?,
                };
            }
        }
        for (column, width) in (0_u16..).zip(&widths) {
            sheet.set_column_width(column, ((*width).min(WIDEST) + 2) as f64)?;
        }
    }
    workbook.save_to_buffer()
}

/// A plain decimal number and how many decimals it shows. What is written otherwise (`007`,
/// `1e5`, `.5`) is a name.
fn decimal(cell: &str) -> Option<(f64, usize)> {
    let digits = cell.strip_prefix('-').unwrap_or(cell);
    let (whole, decimals) = match digits.split_once('.') {
        Some((whole, decimals)) => (whole, Some(decimals)),
        None => (digits, None),
    };
    let plain = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    let leading = whole.len() > 1 && whole.starts_with('0');
    // Sixteen digits and more would lose some.
    if !plain(whole) || leading || whole.len() > 15 || !decimals.is_none_or(plain) {
        return None;
    }
    Some((cell.parse().ok()?, decimals.map_or(0, str::len)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plain_decimals_are_numbers_and_all_else_is_text() {
        assert_eq!(decimal("12.50"), Some((12.5, 2)));
        assert_eq!(decimal("-3"), Some((-3.0, 0)));
        assert_eq!(decimal("0.004"), Some((0.004, 3)));
        for name in ["", "007", "1e5", ".5", "5.", "-", "4x16", "1.2.3", "１"] {
            assert_eq!(decimal(name), None, "{name}");
        }
    }

    #[test]
    fn equal_tables_give_equal_bytes() {
        let tabs = [Tab {
            name: "Shopping",
            csv: b"item,qty\nbolt M4,12\n",
        }];
        let first = write("pavilion", &tabs);
        std::thread::sleep(std::time::Duration::from_millis(1100));
        assert_eq!(first, write("pavilion", &tabs));
    }
}
