//! Parts of one material into rows along the sheet.

use super::{Blank, Settings, packing};

/// A row of parts side by side along the sheet.
pub(super) struct Row<'a> {
    pub(super) width: f64,
    pub(super) parts: Vec<&'a Blank>,
}

/// Rows and a lower bound of their number. Widths are taken from the widest: parts may lie in
/// the rest of a wider row, where that saves a row of their own.
pub(super) fn rows<'a>(
    blanks: &[&'a Blank],
    settings: &Settings,
    capacity: f64,
) -> (Vec<Row<'a>>, usize) {
    let size = |blank: &Blank| blank.length + settings.spacing;
    let mut sorted = blanks.to_vec();
    sorted.sort_by(|a, b| b.width.total_cmp(&a.width).then(a.id.cmp(&b.id)));
    let mut rows: Vec<Row> = Vec::new();
    let mut bound = 0;
    let mut wider: Vec<f64> = Vec::new();
    for class in sorted.chunk_by(|a, b| a.width == b.width) {
        wider.extend(class.iter().map(|blank| size(blank)));
        // Rows of this width or more hold all parts of this width or more.
        bound = bound.max(packing::lower_bound(&wider, capacity));
        let alone = pack_class(class, size, capacity);
        let (filled, rest) = fill_rests(&rows, class, size, capacity);
        let beside = pack_class(&rest, size, capacity);
        if beside.len() < alone.len() {
            for (row, part) in filled {
                rows[row].parts.push(part);
            }
            rows.extend(beside);
        } else {
            rows.extend(alone);
        }
    }
    for row in &mut rows {
        row.parts.sort_by(|a, b| a.id.cmp(&b.id));
    }
    rows.sort_by(|a, b| {
        let first = |row: &Row<'a>| row.parts.first().map(|part| &part.id);
        b.width.total_cmp(&a.width).then(first(a).cmp(&first(b)))
    });
    (rows, bound)
}

fn pack_class<'a>(
    class: &[&'a Blank],
    size: impl Fn(&Blank) -> f64,
    capacity: f64,
) -> Vec<Row<'a>> {
    let sizes: Vec<f64> = class.iter().map(|blank| size(blank)).collect();
    packing::pack(&sizes, capacity)
        .into_iter()
        .map(|bin| Row {
            width: class.first().map_or(0.0, |blank| blank.width),
            parts: bin.into_iter().map(|i| class[i]).collect(),
        })
        .collect()
}

/// Puts parts into the rests of wider rows, longest first, where the least room is left.
fn fill_rests<'a>(
    rows: &[Row<'a>],
    class: &[&'a Blank],
    size: impl Fn(&Blank) -> f64,
    capacity: f64,
) -> (Vec<(usize, &'a Blank)>, Vec<&'a Blank>) {
    let load = |row: &Row| row.parts.iter().map(|part| size(part)).sum::<f64>();
    let mut rests: Vec<f64> = rows.iter().map(|row| capacity - load(row)).collect();
    let mut longest = class.to_vec();
    longest.sort_by(|a, b| b.length.total_cmp(&a.length).then(a.id.cmp(&b.id)));
    let (mut filled, mut rest) = (Vec::new(), Vec::new());
    for part in longest {
        let need = size(part);
        let fit = (0..rests.len())
            .filter(|&row| rests[row] >= need)
            .min_by(|&a, &b| rests[a].total_cmp(&rests[b]).then(a.cmp(&b)));
        match fit {
            Some(row) => {
                rests[row] -= need;
                filled.push((row, part));
            }
            None => rest.push(part),
        }
    }
    rest.sort_by(|a, b| a.id.cmp(&b.id));
    (filled, rest)
}
