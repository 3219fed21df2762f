//! Which sheets a panel gives: stock is what is bought, the bed is what the machine takes.
//!
//! A panel that is larger than the bed is sawn into equal shares that fit, or into as many
//! sheets of the bed's size as it holds. A bed whose rear opens takes any length.

use super::Settings;
use serde::{Deserialize, Serialize};

/// Width of the saw that divides panels, metres: a common circular saw blade.
pub const SAW: f64 = 0.004;

/// A size of sheet.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Format {
    /// Along the parts, metres.
    pub length: f64,
    /// Across the parts, metres.
    pub width: f64,
    /// Sheets from one panel.
    pub per_panel: u32,
}

/// Which way parts lie on a panel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Lay {
    /// Along the panel's length.
    Along,
    /// Along its width.
    Across,
}

/// The sizes of sheet to choose from.
pub(super) fn formats(settings: &Settings, lay: Lay) -> Vec<Format> {
    let stock = match lay {
        Lay::Along => [settings.stock_length, settings.stock_width],
        Lay::Across => [settings.stock_width, settings.stock_length],
    };
    let bed = settings.bed.map(|bed| {
        let length = if bed.pass_through {
            f64::INFINITY
        } else {
            bed.length
        };
        [length, bed.width]
    });
    let [lengths, widths] = [0, 1].map(|axis| {
        let limit = bed.map_or(f64::INFINITY, |bed| bed[axis]);
        divisions(stock[axis], limit)
    });
    lengths
        .iter()
        .flat_map(|&(length, n)| {
            widths.iter().map(move |&(width, m)| Format {
                length,
                width,
                per_panel: n * m,
            })
        })
        .collect()
}

/// Ways to divide a panel's side into pieces within a limit: (size, count).
fn divisions(side: f64, limit: f64) -> Vec<(f64, u32)> {
    if side <= limit {
        return vec![(side, 1)];
    }
    let pieces = |size: f64| (side + SAW) / (size + SAW);
    let shares = libm::ceil(pieces(limit));
    let whole = libm::floor(pieces(limit) + 1e-9).max(1.0);
    let mut ways = vec![((side + SAW) / shares - SAW, shares as u32)];
    if whole < shares {
        ways.push((limit, whole as u32));
    }
    ways
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panel_is_sawn_into_equal_shares_or_into_beds() {
        assert_eq!(divisions(1.25, 2.0), [(1.25, 1)]);
        let ways = divisions(1.25, 0.71);
        assert_eq!(ways.len(), 2);
        assert!((ways[0].0 - 0.623).abs() < 1e-12 && ways[0].1 == 2);
        assert_eq!(ways[1], (0.71, 1));
        // Two beds and the saw between them are just what the panel holds.
        assert_eq!(divisions(2.004, 1.0), [(1.0, 2)]);
    }
}
