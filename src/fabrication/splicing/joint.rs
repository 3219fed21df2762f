//! Dimensions of joints, from rules of trade.

use crate::fabrication::hardware::Series;
use crate::fabrication::units::MM;
use crate::project::model::SpliceKind;

/// Fingers in thicknesses: the glue between the flanks of so long fingers holds more than the
/// wood at their roots.
const FINGER_IN_THICKNESSES: f64 = 5.0;
/// Least number of fingers of a piece.
const LEAST_FINGERS: u32 = 2;
/// Widest finger, metres: wider ones leave too little glue for the section.
const WIDEST_FINGER: f64 = 0.012;
/// Scarfs of one in ten are as strong as the wood.
const SCARF_IN_THICKNESSES: f64 = 10.0;
/// Screws of a plate, on each side of the joint.
pub(super) const SCREWS: usize = 2;
/// From the end of the wood to a screw, and from screw to screw, in diameters of the hole.
const END_IN_HOLES: f64 = 2.5;
const PITCH_IN_HOLES: f64 = 4.0;
/// Between the washers of two screws, and from a washer to the end, metres.
const BESIDE_WASHER: f64 = 0.001;

/// What a joint depends on. Metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct JointSection {
    pub(super) width: f64,
    pub(super) thickness: f64,
    pub(super) bolt: f64,
    pub(super) clearance: f64,
}

/// A joint about its middle. Metres.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Joint {
    pub(super) kind: SpliceKind,
    pub(super) length: f64,
    pub(super) fingers: u32,
    /// From the middle, ascending.
    pub(super) screws: Vec<f64>,
    pub(super) hole: f64,
}

impl Joint {
    pub(super) fn new(kind: SpliceKind, section: JointSection) -> Self {
        let plain = |length, fingers| Self {
            kind,
            length,
            fingers,
            screws: Vec::new(),
            hole: 0.0,
        };
        match kind {
            SpliceKind::Finger => {
                let needed = libm::ceil(section.width / (2.0 * WIDEST_FINGER)) as u32;
                let length = FINGER_IN_THICKNESSES * section.thickness;
                plain(length, needed.max(LEAST_FINGERS))
            }
            SpliceKind::Scarf => plain(SCARF_IN_THICKNESSES * section.thickness, 0),
            SpliceKind::Plate => Self::plate(section),
        }
    }

    fn plate(section: JointSection) -> Self {
        let hole = section.bolt + section.clearance;
        let washer = Series::of(section.bolt).map_or(2.5 * section.bolt, |s| s.washer[1] / MM);
        let end = (END_IN_HOLES * hole).max(0.5 * washer + BESIDE_WASHER);
        let pitch = (PITCH_IN_HOLES * hole).max(washer + BESIDE_WASHER);
        let outer = end + pitch * (SCREWS - 1) as f64;
        let one_side = (0..SCREWS).map(|i| end + pitch * i as f64);
        let mut screws: Vec<f64> = one_side.clone().map(|x| -x).chain(one_side).collect();
        screws.sort_by(f64::total_cmp);
        Self {
            kind: SpliceKind::Plate,
            length: 2.0 * (outer + end),
            fingers: 0,
            screws,
            hole,
        }
    }

    /// Share of the section that carries where the joint is weakest: every second finger at
    /// their roots, all of a scarf, the plate beside its holes.
    pub(super) fn carrying(&self, width: f64) -> f64 {
        match self.kind {
            SpliceKind::Finger => 0.5,
            SpliceKind::Scarf => 1.0,
            SpliceKind::Plate => (1.0 - self.hole / width).max(0.01),
        }
    }

    /// How far a piece reaches over the middle.
    pub(super) fn reach(&self) -> f64 {
        match self.kind {
            SpliceKind::Finger | SpliceKind::Scarf => 0.5 * self.length,
            SpliceKind::Plate => 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PAVILION: JointSection = JointSection {
        width: 0.03,
        thickness: 0.003,
        bolt: 0.004,
        clearance: 0.0002,
    };

    #[test]
    fn joints_keep_the_rules_of_their_kind() {
        let finger = Joint::new(SpliceKind::Finger, PAVILION);
        assert_eq!((finger.length, finger.fingers), (0.015, 2));
        let wide = JointSection {
            width: 0.25,
            ..PAVILION
        };
        assert_eq!(Joint::new(SpliceKind::Finger, wide).fingers, 11);
        let scarf = Joint::new(SpliceKind::Scarf, PAVILION);
        assert!((scarf.length - 0.03).abs() < 1e-12 && scarf.reach() == 0.5 * scarf.length);
    }

    #[test]
    fn a_plate_has_four_screws_clear_of_each_other_and_of_the_ends() {
        let plate = Joint::new(SpliceKind::Plate, PAVILION);
        assert_eq!(plate.screws.len(), 4);
        let [a, b, c, d] = plate.screws[..] else {
            panic!("four");
        };
        assert!((a + d).abs() < 1e-12 && (b + c).abs() < 1e-12);
        // Two and a half holes to the butt, four from screw to screw.
        assert!((c - 0.0105).abs() < 1e-12 && (d - c - 0.0168).abs() < 1e-12);
        assert!((0.5 * plate.length - d - 0.0105).abs() < 1e-12);
        assert_eq!(plate.reach(), 0.0);
        assert!((plate.carrying(0.03) - 0.86).abs() < 1e-12);
    }
}
