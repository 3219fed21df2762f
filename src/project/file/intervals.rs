//! What a number may be: the bounds of every quantity of the file.

/// Bounds of a quantity: in metres for lengths, in degrees for angles, in SI for the rest.
pub(crate) trait Interval {
    const LOW: Edge;
    const HIGH: Edge;
    /// What a value outside usually means, and what to write.
    const ADVICE: Option<&'static str>;
}

/// One end of an interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Edge {
    /// The end belongs to it.
    Closed(f64),
    /// It does not.
    Open(f64),
}

impl Edge {
    pub(crate) fn value(self) -> f64 {
        match self {
            Self::Closed(value) | Self::Open(value) => value,
        }
    }
}

macro_rules! interval {
    ($($(#[$doc:meta])* $name:ident: $low:expr, $high:expr, $advice:expr;)*) => {$(
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq)]
        pub(crate) enum $name {}

        impl Interval for $name {
            const LOW: Edge = $low;
            const HIGH: Edge = $high;
            const ADVICE: Option<&'static str> = $advice;
        }
    )*};
}

use Edge::{Closed, Open};

interval! {
    /// Coordinates: within a thousand kilometres.
    Coordinate: Closed(-1e6), Closed(1e6), None;
    /// A length of something that exists.
    Extent: Open(0.0), Closed(1e6), None;
    /// Heights and borders, which may be nothing.
    Gap: Closed(0.0), Closed(1e6), None;
    /// Width and thickness of a lamella.
    Section: Open(0.0), Closed(100.0), Some("lengths without a unit are in `project.units`");
    /// Width of a cut.
    KerfWidth: Closed(0.0), Closed(0.01),
        Some("a laser removes 0.08 to 0.3 mm, a mill the diameter of its cutter; 0 draws nominal geometry");
    /// Play between bolt or shell and its opening.
    Play: Closed(0.0), Closed(0.02), Some("a running fit has 0.2 to 0.3 mm");
    /// Height of engraved text.
    TextHeight: Closed(0.0005), Closed(0.5), None;
    /// Thickness of a foil.
    FoilThickness: Open(0.0), Closed(0.005), Some("PTFE foils are 0.1 to 0.25 mm thick");
    /// A share of a length, without its ends.
    InnerShare: Open(0.0), Open(1.0),
        Some("a share lies strictly between the two anchors; for an end use that anchor itself");
    /// A corner of a convex plan.
    PlanAngle: Open(0.0), Open(180.0), Some("leave it out, or write \"auto\", and the compiler chooses");
    /// A factor of size.
    Factor: Closed(1e-6), Closed(1e6), None;
    /// A factor of size of a study.
    StudyFactor: Closed(1e-3), Closed(1e4), None;
    /// Importance of a side.
    Weight: Open(0.0), Closed(1e6), Some("1 is the weight of every other side; a larger one is kept more even");
    /// Ratio of geodesic lengths around a peak.
    Eta: Closed(1.0), Closed(2.0), Some("the paper uses 1.0015; 1 allows no detour at all");
    /// Slope of a cladding function.
    Slope: Open(0.0), Closed(1000.0), None;
    /// Elastic constants.
    Modulus: Open(0.0), Closed(1e13), None;
    /// Strengths.
    Strength: Open(0.0), Closed(1e12), None;
    /// Densities.
    Heaviness: Open(0.0), Closed(1e5), None;
    /// Money.
    Money: Closed(0.0), Closed(1e9), None;
    /// A component of gravity.
    Pull: Closed(-1000.0), Closed(1000.0), None;
}
