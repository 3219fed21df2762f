//! Units of measurement: what a string such as `"7.6 GPa"` may end in, and its exact size in SI.

/// A unit as an exact decimal multiple of the SI unit, `factor * 10^power`. Degrees are the one
/// exception: their size holds pi.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Unit {
    /// The way to write it.
    pub(crate) symbol: &'static str,
    /// Other ways that are understood.
    pub(crate) aliases: &'static [&'static str],
    pub(crate) factor: u32,
    pub(crate) power: i64,
}

const fn unit(
    symbol: &'static str,
    aliases: &'static [&'static str],
    factor: u32,
    power: i64,
) -> Unit {
    Unit {
        symbol,
        aliases,
        factor,
        power,
    }
}

impl Unit {
    fn is(&self, written: &str) -> bool {
        self.symbol == written || self.aliases.contains(&written)
    }

    /// Its size in the SI unit, for messages.
    pub(crate) fn size(&self) -> f64 {
        format!("{}e{}", self.factor, self.power)
            .parse()
            .expect("an integer and a power are a float literal")
    }
}

/// A kind of quantity.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Dimension {
    /// With its article: `a length`.
    pub(crate) name: &'static str,
    /// Units, the customary order; none for a plain number.
    pub(crate) units: &'static [Unit],
}

pub(crate) const MILLIMETRE: Unit = unit("mm", &[], 1, -3);
pub(crate) const CENTIMETRE: Unit = unit("cm", &[], 1, -2);
pub(crate) const METRE: Unit = unit("m", &[], 1, 0);
pub(crate) const INCH: Unit = unit("in", &["inch"], 254, -4);
pub(crate) const FOOT: Unit = unit("ft", &["foot", "feet"], 3048, -4);
pub(crate) const DEGREE: Unit = unit("deg", &["°"], 1, 0);
pub(crate) const RADIAN: Unit = unit("rad", &[], 1, 0);

pub(crate) const LENGTH: Dimension = Dimension {
    name: "a length",
    units: &[MILLIMETRE, CENTIMETRE, METRE, INCH, FOOT],
};
pub(crate) const ANGLE: Dimension = Dimension {
    name: "an angle",
    units: &[DEGREE, RADIAN],
};
pub(crate) const STRESS: Dimension = Dimension {
    name: "a stress",
    units: &[
        unit("Pa", &[], 1, 0),
        unit("kPa", &[], 1, 3),
        unit("MPa", &["N/mm^2", "N/mm2", "N/mm²"], 1, 6),
        unit("GPa", &["kN/mm^2", "kN/mm2", "kN/mm²"], 1, 9),
    ],
};
pub(crate) const DENSITY: Dimension = Dimension {
    name: "a density",
    units: &[
        unit("kg/m^3", &["kg/m3", "kg/m³"], 1, 0),
        unit("g/cm^3", &["g/cm3", "g/cm³"], 1, 3),
    ],
};
pub(crate) const ACCELERATION: Dimension = Dimension {
    name: "an acceleration",
    units: &[unit("m/s^2", &["m/s2", "m/s²"], 1, 0)],
};
pub(crate) const PLAIN: Dimension = Dimension {
    name: "a number",
    units: &[],
};

/// Every dimension with units.
pub(crate) const DIMENSIONS: [Dimension; 5] = [LENGTH, ANGLE, STRESS, DENSITY, ACCELERATION];

impl Dimension {
    /// Its unit of that name.
    pub(crate) fn unit(&self, written: &str) -> Option<Unit> {
        self.units.iter().copied().find(|unit| unit.is(written))
    }

    /// Symbols of its units.
    pub(crate) fn symbols(&self) -> impl Iterator<Item = &'static str> {
        self.units.iter().map(|unit| unit.symbol)
    }
}

/// The dimension that has this unit.
pub(crate) fn dimension_of(written: &str) -> Option<Dimension> {
    DIMENSIONS
        .into_iter()
        .find(|dimension| dimension.unit(written).is_some())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn every_unit_is_written_in_one_dimension_only() {
        let mut seen = BTreeSet::new();
        for dimension in DIMENSIONS {
            for unit in dimension.units {
                for name in unit.aliases.iter().chain([&unit.symbol]) {
                    assert!(seen.insert(*name), "{name} means two units");
                    assert_eq!(dimension_of(name), Some(dimension));
                }
            }
        }
    }

    #[test]
    fn units_have_their_defined_sizes() {
        assert_eq!(INCH.size(), 0.0254);
        assert_eq!(FOOT.size(), 0.3048);
        assert_eq!(STRESS.unit("N/mm²").map(|unit| unit.size()), Some(1e6));
        assert_eq!(DENSITY.unit("g/cm^3").map(|unit| unit.size()), Some(1000.0));
    }
}
