//! What the `dxf` crate leaves out of an R2000 file and AutoCAD asks for.
//!
//! The crate writes tables without handles, owners and counts, no BLOCKS section, no root
//! dictionary and no layouts; AutoCAD and programs built on its libraries refuse such files. The
//! saved code pairs are taken apart and put together again as the DXF reference of R2000 tells:
//!
//! 1. HEADER: handle seed, fixed dates, identifiers from the content.
//! 2. CLASSES of the objects below that are no built-in types.
//! 3. TABLES in AutoCAD's order, each with handle, owner and count, each record with its owner;
//!    dimension styles with their own handle code; layers with lineweight and plot style.
//! 4. BLOCKS of model and paper space.
//! 5. ENTITIES owned by model space, their lineweight left to the layer.
//! 6. OBJECTS: root dictionary, plot style placeholder, multiline style, two layouts.

use super::pairs::{Pair, records, section};
use crate::fabrication::drawing::Drawing;

/// Tables in the order of AutoCAD's files.
const TABLES: [&str; 9] = [
    "VPORT",
    "LTYPE",
    "LAYER",
    "STYLE",
    "VIEW",
    "UCS",
    "APPID",
    "DIMSTYLE",
    "BLOCK_RECORD",
];

/// Julian date of 2000-01-01: files carry no clock.
const EPOCH: &str = "2451544.5";

/// Classes of OBJECTS that are not built into every reader: name, C++ name.
const CLASSES: [(&str, &str); 3] = [
    ("ACDBDICTIONARYWDFLT", "AcDbDictionaryWithDefault"),
    ("ACDBPLACEHOLDER", "AcDbPlaceHolder"),
    ("LAYOUT", "AcDbLayout"),
];

/// Handles of what this file adds, besides those of tables.
struct Handles {
    next: u64,
    tables: [String; TABLES.len()],
    model: Space,
    paper: Space,
    root: String,
    groups: String,
    layouts: String,
    line_styles: String,
    line_style: String,
    plot_styles: String,
    plot_style: String,
}

/// Handles of model or paper space.
struct Space {
    name: &'static str,
    record: String,
    block: String,
    end: String,
    layout: String,
}

/// The pairs of a saved file as a complete R2000 file.
pub(super) fn complete(saved: &[Pair], drawing: &Drawing) -> Vec<Pair> {
    let handles = Handles::allocate(saved);
    let mut out = Vec::with_capacity(saved.len() + 600);
    let mut write_section = |name: &str, body: Vec<Pair>| {
        out.extend([Pair::new(0, "SECTION"), Pair::new(2, name)]);
        out.extend(body);
        out.push(Pair::new(0, "ENDSEC"));
    };
    write_section("HEADER", header(saved, &handles, drawing));
    write_section("CLASSES", classes());
    write_section("TABLES", tables(saved, &handles, drawing));
    write_section("BLOCKS", blocks(&handles));
    write_section("ENTITIES", entities(saved, &handles));
    write_section("OBJECTS", objects(&handles, drawing));
    out.push(Pair::new(0, "EOF"));
    out
}

impl Handles {
    /// Allocates from the handle seed that the crate wrote.
    fn allocate(saved: &[Pair]) -> Self {
        let seed = header_value(section(saved, "HEADER"), "$HANDSEED")
            .and_then(|pair| u64::from_str_radix(pair.value.trim(), 16).ok());
        // Without a seed any number above all entities is free.
        let mut next = seed.unwrap_or(saved.len() as u64 + 1);
        let mut new = || {
            let handle = format!("{next:X}");
            next += 1;
            handle
        };
        let mut space = |name| Space {
            name,
            record: space_record(saved, name).unwrap_or_else(&mut new),
            block: new(),
            end: new(),
            layout: new(),
        };
        let [model, paper] = [space("*Model_Space"), space("*Paper_Space")];
        Self {
            tables: core::array::from_fn(|_| new()),
            model,
            paper,
            root: new(),
            groups: new(),
            layouts: new(),
            line_styles: new(),
            line_style: new(),
            plot_styles: new(),
            plot_style: new(),
            next,
        }
    }
}

/// Handle of the block record of a space as the crate gave it.
fn space_record(saved: &[Pair], name: &str) -> Option<String> {
    records(section(saved, "TABLES"))
        .into_iter()
        .filter(|record| record[0].is(0, "BLOCK_RECORD"))
        .find(|record| value(record, 2).is_some_and(|v| v.eq_ignore_ascii_case(name)))
        .and_then(|record| value(record, 5).map(str::to_owned))
}

fn value(record: &[Pair], code: i32) -> Option<&str> {
    record
        .iter()
        .find(|pair| pair.code == code)
        .map(|pair| pair.value.as_str())
}

fn header_value<'a>(header: &'a [Pair], variable: &str) -> Option<&'a Pair> {
    header
        .windows(2)
        .find(|w| w[0].is(9, variable))
        .map(|w| &w[1])
}

fn header(saved: &[Pair], handles: &Handles, drawing: &Drawing) -> Vec<Pair> {
    let digest = drawing.digest().to_hex();
    let (fingerprint, version) = digest.split_at(32);
    let mut header = section(saved, "HEADER").to_vec();
    for i in 1..header.len() {
        let fixed = match header[i - 1].value.as_str() {
            "$TDCREATE" | "$TDUCREATE" | "$TDUPDATE" | "$TDUUPDATE" => EPOCH.to_owned(),
            "$FINGERPRINTGUID" => guid(fingerprint),
            "$VERSIONGUID" => guid(version),
            "$HANDSEED" => format!("{:X}", handles.next),
            _ => continue,
        };
        header[i].value = fixed;
    }
    header
}

/// Half of a hash in the form of identifiers.
fn guid(half: &str) -> String {
    let hex = half.to_ascii_uppercase();
    let [a, b, c, d, e] = [0..8, 8..12, 12..16, 16..20, 20..32].map(|range| &hex[range]);
    format!("{{{a}-{b}-{c}-{d}-{e}}}")
}

fn classes() -> Vec<Pair> {
    let mut out = Vec::new();
    for (name, class) in CLASSES {
        out.extend(list(&[
            (0, "CLASS"),
            (1, name),
            (2, class),
            (3, "ObjectDBX Classes"),
            (90, "0"),
            (280, "0"),
            (281, "0"),
        ]));
    }
    out
}

fn tables(saved: &[Pair], handles: &Handles, drawing: &Drawing) -> Vec<Pair> {
    let saved = records(section(saved, "TABLES"));
    let mut out = Vec::new();
    for (table, handle) in TABLES.iter().zip(&handles.tables) {
        let rows: Vec<_> = saved
            .iter()
            .filter(|record| record[0].is(0, table))
            .filter(|record| value(record, 2).is_none_or(|name| !name.contains("ANNOTATIVE")))
            .collect();
        let count = rows.len().to_string();
        out.extend(list(&[
            (0, "TABLE"),
            (2, table),
            (5, handle),
            (330, "0"),
            (100, "AcDbSymbolTable"),
            (70, &count),
        ]));
        if *table == "DIMSTYLE" {
            out.extend(list(&[(100, "AcDbDimStyleTable"), (71, "0")]));
        }
        for row in rows {
            out.extend(table_row(table, handle, row, handles, drawing));
        }
        out.push(Pair::new(0, "ENDTAB"));
    }
    out
}

fn table_row(
    table: &str,
    owner: &str,
    row: &[Pair],
    handles: &Handles,
    drawing: &Drawing,
) -> Vec<Pair> {
    let mut out = Vec::with_capacity(row.len() + 1);
    let space = [&handles.model, &handles.paper]
        .into_iter()
        .find(|space| value(row, 2).is_some_and(|v| v.eq_ignore_ascii_case(space.name)));
    for pair in row {
        let pair = match (table, pair.code) {
            (_, 5) => {
                let code = if table == "DIMSTYLE" { 105 } else { 5 };
                out.push(Pair::new(code, pair.value.as_str()));
                Pair::new(330, owner)
            }
            // Pointers to blocks and styles that nothing here uses; flags of later versions.
            ("DIMSTYLE", 340..=344) | ("BLOCK_RECORD", 70) => continue,
            ("LAYER", 370) => {
                let name = value(row, 2).unwrap_or_default();
                Pair::new(370, super::layer_weight(drawing, name).to_string())
            }
            ("LAYER", 390) => Pair::new(390, handles.plot_style.as_str()),
            ("BLOCK_RECORD", 2) => Pair::new(2, space.map_or(pair.value.as_str(), |s| s.name)),
            ("BLOCK_RECORD", 340) => Pair::new(340, space.map_or("0", |s| s.layout.as_str())),
            _ => pair.clone(),
        };
        out.push(pair);
    }
    out
}

fn blocks(handles: &Handles) -> Vec<Pair> {
    let mut out = Vec::new();
    for space in [&handles.model, &handles.paper] {
        out.extend(list(&[
            (0, "BLOCK"),
            (5, &space.block),
            (330, &space.record),
            (100, "AcDbEntity"),
            (8, "0"),
            (100, "AcDbBlockBegin"),
            (2, space.name),
            (70, "0"),
            (10, "0.0"),
            (20, "0.0"),
            (30, "0.0"),
            (3, space.name),
            (1, ""),
            (0, "ENDBLK"),
            (5, &space.end),
            (330, &space.record),
            (100, "AcDbEntity"),
            (8, "0"),
            (100, "AcDbBlockEnd"),
        ]));
    }
    out
}

fn entities(saved: &[Pair], handles: &Handles) -> Vec<Pair> {
    let mut out = Vec::new();
    for pair in section(saved, "ENTITIES") {
        if pair.code == 370 {
            continue;
        }
        out.push(pair.clone());
        if pair.code == 5 {
            out.push(Pair::new(330, handles.model.record.as_str()));
        }
    }
    out
}

fn objects(handles: &Handles, drawing: &Drawing) -> Vec<Pair> {
    let h = handles;
    let mut out = list(&[
        (0, "DICTIONARY"),
        (5, &h.root),
        (330, "0"),
        (100, "AcDbDictionary"),
        (281, "1"),
        (3, "ACAD_GROUP"),
        (350, &h.groups),
        (3, "ACAD_LAYOUT"),
        (350, &h.layouts),
        (3, "ACAD_MLINESTYLE"),
        (350, &h.line_styles),
        (3, "ACAD_PLOTSTYLENAME"),
        (350, &h.plot_styles),
        (0, "DICTIONARY"),
        (5, &h.groups),
        (330, &h.root),
        (100, "AcDbDictionary"),
        (281, "1"),
        (0, "DICTIONARY"),
        (5, &h.layouts),
        (330, &h.root),
        (100, "AcDbDictionary"),
        (281, "1"),
        (3, "Model"),
        (350, &h.model.layout),
        (3, "Layout1"),
        (350, &h.paper.layout),
        (0, "DICTIONARY"),
        (5, &h.line_styles),
        (330, &h.root),
        (100, "AcDbDictionary"),
        (281, "1"),
        (3, "STANDARD"),
        (350, &h.line_style),
        (0, "ACDBDICTIONARYWDFLT"),
        (5, &h.plot_styles),
        (330, &h.root),
        (100, "AcDbDictionary"),
        (281, "1"),
        (3, "Normal"),
        (350, &h.plot_style),
        (100, "AcDbDictionaryWithDefault"),
        (340, &h.plot_style),
        (0, "ACDBPLACEHOLDER"),
        (5, &h.plot_style),
        (330, &h.plot_styles),
        (0, "MLINESTYLE"),
        (5, &h.line_style),
        (330, &h.line_styles),
        (100, "AcDbMlineStyle"),
        (2, "STANDARD"),
        (70, "0"),
        (3, ""),
        (62, "256"),
        (51, "90.0"),
        (52, "90.0"),
        (71, "2"),
        (49, "0.5"),
        (62, "256"),
        (6, "BYLAYER"),
        (49, "-0.5"),
        (62, "256"),
        (6, "BYLAYER"),
    ]);
    out.extend(layout(h, &h.model, "Model", "0", drawing));
    out.extend(layout(h, &h.paper, "Layout1", "1", drawing));
    out
}

/// A layout on paper of the drawing's size, plotted one to one in millimetres.
fn layout(h: &Handles, space: &Space, name: &str, tab: &str, drawing: &Drawing) -> Vec<Pair> {
    let [width, height] = drawing.size.map(|v| format!("{v:?}"));
    // Flag 1024 marks the settings of model space.
    let flags = if tab == "0" { "1024" } else { "0" };
    list(&[
        (0, "LAYOUT"),
        (5, &space.layout),
        (330, &h.layouts),
        (100, "AcDbPlotSettings"),
        (1, ""),
        (2, "none_device"),
        (4, ""),
        (6, ""),
        (40, "0.0"),
        (41, "0.0"),
        (42, "0.0"),
        (43, "0.0"),
        (44, &width),
        (45, &height),
        (46, "0.0"),
        (47, "0.0"),
        (48, "0.0"),
        (49, "0.0"),
        (140, "0.0"),
        (141, "0.0"),
        (142, "1.0"),
        (143, "1.0"),
        (70, flags),
        (72, "1"),
        (73, "0"),
        (74, "5"),
        (7, ""),
        (75, "16"),
        (147, "1.0"),
        (148, "0.0"),
        (149, "0.0"),
        (100, "AcDbLayout"),
        (1, name),
        (70, "1"),
        (71, tab),
        (10, "0.0"),
        (20, "0.0"),
        (11, &width),
        (21, &height),
        (12, "0.0"),
        (22, "0.0"),
        (32, "0.0"),
        (14, "0.0"),
        (24, "0.0"),
        (34, "0.0"),
        (15, &width),
        (25, &height),
        (35, "0.0"),
        (146, "0.0"),
        (13, "0.0"),
        (23, "0.0"),
        (33, "0.0"),
        (16, "1.0"),
        (26, "0.0"),
        (36, "0.0"),
        (17, "0.0"),
        (27, "1.0"),
        (37, "0.0"),
        (76, "0"),
        (330, &space.record),
    ])
}

fn list(pairs: &[(i32, &str)]) -> Vec<Pair> {
    pairs
        .iter()
        .map(|&(code, value)| Pair::new(code, value))
        .collect()
}
