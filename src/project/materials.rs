//! The built-in materials, with the source of every value.
//!
//! Values where the method's papers give them are the papers'; the rest are handbook values for
//! clear, dry material (12 % moisture for wood). They are good for a first design: for a load
//! test or a permit enter your own under `[materials]`.

use super::model::{Grain, Material};

/// A built-in material.
#[derive(Debug, Clone, PartialEq)]
pub struct BuiltIn {
    /// Its values, SI.
    pub material: Material,
    /// What it is, one line.
    pub about: &'static str,
    /// Where the values come from.
    pub source: &'static str,
}

/// All built-in materials, by name.
pub fn built_in() -> Vec<BuiltIn> {
    ROWS.iter().map(Row::built_in).collect()
}

/// The built-in material of that name.
pub fn find(name: &str) -> Option<Material> {
    let row = ROWS.iter().find(|row| row.name == name)?;
    Some(row.built_in().material)
}

/// Names of all built-in materials, sorted.
pub fn names() -> impl Iterator<Item = &'static str> {
    ROWS.iter().map(|row| row.name)
}

/// A line of the table, in the customary units.
struct Row {
    name: &'static str,
    /// Young's modulus along the lamella, in `MPa`.
    elastic: u32,
    /// Shear modulus, in `MPa`.
    shear: u32,
    /// kg/m^3.
    density: u32,
    /// Bending strength, in `MPa`.
    strength: u32,
    grain: Grain,
    about: &'static str,
    source: &'static str,
}

impl Row {
    fn built_in(&self) -> BuiltIn {
        let megapascals = |value: u32| f64::from(value) * 1e6;
        BuiltIn {
            material: Material {
                name: self.name.to_owned(),
                elastic_modulus: megapascals(self.elastic),
                shear_modulus: megapascals(self.shear),
                density: f64::from(self.density),
                bending_strength: megapascals(self.strength),
                price: None,
                grain: self.grain,
            },
            about: self.about,
            source: self.source,
        }
    }
}

/// Sorted by name. Shear moduli of solid wood are E/14, the common ratio for E : G of hardwoods
/// (Bodig and Jayne, Mechanics of Wood and Wood Composites).
const ROWS: &[Row] = &[
    Row {
        name: "aluminium",
        elastic: 70_000,
        shear: 27_000,
        density: 2700,
        strength: 250,
        grain: Grain::None,
        about: "sheet of a hardened alloy such as EN AW-6082 T6",
        source: "EN 1999-1-1: moduli and density of wrought alloys, 0.2 % proof strength of EN AW-6082 T6",
    },
    Row {
        name: "ash",
        elastic: 12_300,
        shear: 880,
        density: 680,
        strength: 104,
        grain: Grain::Along,
        about: "European ash, solid, grain along the lamella",
        source: "handbook means of clear wood at 12 % moisture; shear modulus E/14 (Bodig and Jayne)",
    },
    Row {
        name: "beech",
        elastic: 14_300,
        shear: 1020,
        density: 710,
        strength: 110,
        grain: Grain::Along,
        about: "European beech, solid, grain along the lamella",
        source: "handbook means of clear wood at 12 % moisture; shear modulus E/14 (Bodig and Jayne)",
    },
    Row {
        name: "birch-plywood",
        elastic: 12_700,
        shear: 620,
        density: 680,
        strength: 51,
        grain: Grain::Along,
        about: "birch plywood, five plies, face grain along the lamella",
        source: "Handbook of Finnish Plywood, birch 6.5 mm: mean moduli and density, characteristic bending strength",
    },
    Row {
        name: "birch-plywood-across",
        elastic: 4000,
        shear: 620,
        density: 650,
        strength: 29,
        grain: Grain::Across,
        about: "birch plywood with the face grain across the lamella: the paper's model of it collapsed",
        source: "E and density: Pillwein et al. 2021, table of specific moduli; shear modulus and strength: Handbook of Finnish Plywood, birch 6.5 mm",
    },
    Row {
        name: "gfrp",
        elastic: 23_000,
        shear: 3000,
        density: 1850,
        strength: 240,
        grain: Grain::Along,
        about: "pultruded glass-fibre profile, fibres along the lamella",
        source: "EN 13706-3 grade E23: least axial modulus and flexural strength; shear modulus and density typical of such profiles",
    },
    Row {
        name: "limewood",
        elastic: 9100,
        shear: 650,
        density: 500,
        strength: 85,
        grain: Grain::Along,
        about: "limewood, solid, grain along the lamella: the paper's desktop models and prototype",
        source: "E and density: Pillwein et al. 2021, table of specific moduli; strength: handbook mean of clear wood; shear modulus E/14 (Bodig and Jayne)",
    },
    Row {
        name: "oak",
        elastic: 10_600,
        shear: 760,
        density: 675,
        strength: 97,
        grain: Grain::Along,
        about: "European oak, solid, grain along the lamella",
        source: "handbook means of clear wood at 12 % moisture; shear modulus E/14 (Bodig and Jayne)",
    },
    Row {
        name: "poplar-plywood",
        elastic: 7600,
        shear: 400,
        density: 430,
        strength: 40,
        grain: Grain::Along,
        about: "poplar plywood, three plies, face grain along the lamella: the paper's 3.1 m pavilion",
        source: "E and density: Pillwein et al. 2021, table of specific moduli; shear modulus and strength: cautious values for thin poplar sheets",
    },
    Row {
        name: "poplar-plywood-across",
        elastic: 1500,
        shear: 400,
        density: 430,
        strength: 12,
        grain: Grain::Across,
        about: "poplar plywood with the face grain across the lamella",
        source: "E: a fifth of that along the grain (Pillwein et al. 2021); shear modulus and strength: cautious values for thin poplar sheets",
    },
    Row {
        name: "spruce",
        elastic: 11_000,
        shear: 690,
        density: 430,
        strength: 66,
        grain: Grain::Along,
        about: "Norway spruce, solid, grain along the lamella",
        source: "handbook means of clear wood at 12 % moisture; shear modulus: EN 338 class C24",
    },
    Row {
        name: "steel",
        elastic: 210_000,
        shear: 81_000,
        density: 7850,
        strength: 355,
        grain: Grain::None,
        about: "structural steel S355",
        source: "EN 1993-1-1: moduli; EN 1991-1-1: density; nominal yield strength of S355",
    },
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_sorted_and_usable() {
        assert!(ROWS.is_sorted_by(|a, b| a.name < b.name));
        for name in names() {
            assert_eq!(crate::project::file::words::name_fault(name), None);
        }
    }

    #[test]
    fn the_papers_specific_moduli_are_met() {
        // Its table gives E / density in 10^6 m^2/s^2.
        for (name, specific) in [
            ("limewood", 18.2),
            ("birch-plywood-across", 6.15),
            ("poplar-plywood", 17.7),
        ] {
            let material = find(name).expect("built in");
            let found = material.elastic_modulus / material.density / 1e6;
            assert!((found - specific).abs() < 0.05, "{name} {found}");
        }
    }

    #[test]
    fn values_are_physical() {
        for BuiltIn { material, .. } in built_in() {
            // G <= E/2 for isotropic solids with a Poisson ratio of at least 0, and far less for
            // wood; strains at the bending strength stay below 2 %.
            assert!(
                material.shear_modulus <= material.elastic_modulus / 2.0,
                "{material:?}"
            );
            assert!(
                material.bending_strength < 0.02 * material.elastic_modulus,
                "{material:?}"
            );
        }
    }
}
