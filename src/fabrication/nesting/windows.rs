//! Windows: a panel that is longer than the bed is cut, pushed on, and cut again.
//!
//! Neighbouring windows overlap, and the overlap is wide enough for every opening to lie in one
//! of them as a whole: where a window ends is a matter of each part, see
//! [`crate::fabrication::passage`]. Pushes are all the same, so that one stop serves them all.

use super::BedSize;
use crate::plan::WindowRecord;

/// Least overlap of two windows, metres: a label and the holes for the pins.
const LEAST_OVERLAP: f64 = 0.06;
/// Beside a shape that must be cut in one go, on both sides together, metres.
const BESIDE: f64 = 0.02;

/// Windows of a sheet whose longest opening is `whole`; none if the bed takes it as it is.
/// Metres.
pub(super) fn windows(length: f64, bed: Option<&BedSize>, whole: f64) -> Vec<WindowRecord> {
    let Some(bed) = bed.filter(|bed| bed.pass_through && bed.length < length) else {
        return Vec::new();
    };
    // An overlap of the whole bed would never get to the end of the panel.
    let overlap = LEAST_OVERLAP.max(whole + BESIDE).min(0.5 * bed.length);
    let pushes = libm::ceil((length - bed.length) / (bed.length - overlap) - 1e-9).max(1.0);
    let push = (length - bed.length) / pushes;
    (0..=pushes as u32)
        .map(|step| {
            let from = f64::from(step) * push;
            WindowRecord {
                from,
                to: from + bed.length,
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bed(length: f64, pass_through: bool) -> BedSize {
        BedSize {
            length,
            width: 0.71,
            pass_through,
        }
    }

    #[test]
    fn windows_cover_the_panel_in_equal_pushes_and_overlap() {
        let windows = windows(2.5, Some(&bed(1.245, true)), 0.03);
        assert_eq!(windows.len(), 3);
        assert_eq!(windows[0].from, 0.0);
        assert!((windows[2].to - 2.5).abs() < 1e-12);
        for pair in windows.windows(2) {
            assert!((pair[1].from - pair[0].from - 0.6275).abs() < 1e-12);
            assert!(pair[0].to - pair[1].from >= LEAST_OVERLAP);
        }
    }

    #[test]
    fn a_long_notch_widens_the_overlap() {
        let two = windows(2.0, Some(&bed(1.1, true)), 0.05);
        assert_eq!(two.len(), 2);
        assert_eq!(windows(2.0, Some(&bed(1.1, true)), 0.3).len(), 3);
    }

    #[test]
    fn a_bed_that_takes_the_panel_or_is_closed_has_no_windows() {
        assert_eq!(windows(1.2, Some(&bed(1.245, true)), 0.03), []);
        assert_eq!(windows(2.5, Some(&bed(1.245, false)), 0.03), []);
        assert_eq!(windows(2.5, None, 0.03), []);
    }
}
