//! Bolts, nuts and washers of the metric series, as dealers keep them.
//!
//! Dimensions in millimetres after ISO 7380-1 (button head; ISO 4762 below M3), DIN 985 (lock
//! nuts) and ISO 7093-1 (large washers; ISO 7089 below M3); above M12 hexagon heads after ISO
//! 4014. Where more lamellae meet than the longest bolt goes through, threaded rod (DIN 976) is cut
//! to length, with a nut at either end. Masses are computed from these dimensions and are good to a
//! tenth.

use super::units::MM;
use crate::diagnostics::Diagnostic;
use crate::diagnostics::codes::fabrication as codes;
use crate::project::model::{Hardware, Shell};

/// kg/m^3.
const STEEL: f64 = 7850.0;

/// Densities of tubes by the first word of their name, kg/m^3.
const TUBES: [(&str, f64); 5] = [
    ("brass", 8500.0),
    ("steel", STEEL),
    ("stainless", 7900.0),
    ("aluminium", 2700.0),
    ("copper", 8930.0),
];

/// How much longer a shell is than the stack, metres: the bolt clamps the shell, not the wood, so
/// that the lamellae stay free to slide.
pub const SHELL_EXCESS: f64 = 0.2e-3;

/// Kerf of the saw that cuts tubes, metres.
pub const TUBE_SAW: f64 = 1.0e-3;

/// Threaded rod is cut to multiples of this, millimetres.
const ROD_STEP: f64 = 5.0;

/// Thinner rod than this, millimetres, is not what a stack of lamellae is held by: they would ask
/// for a larger bolt.
const ROD_FROM: f64 = 8.0;

/// What goes through a connection.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Fastener {
    /// A bolt of this length under its head, metres; one nut.
    Bolt(f64),
    /// Threaded rod cut to this length, metres; two nuts.
    Rod(f64),
}

/// Threads that stand out of a nut.
const FREE_THREADS: f64 = 2.0;

/// One row of the series. Millimetres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Series {
    /// Nominal diameter.
    pub diameter: f64,
    /// Pitch of the coarse thread.
    pub pitch: f64,
    /// Standard of the bolt.
    pub bolt_standard: &'static str,
    /// Diameter and height of its head.
    pub head: [f64; 2],
    /// Shortest and longest bolt.
    pub lengths: [f64; 2],
    /// Width across flats and height of the lock nut.
    pub nut: [f64; 2],
    /// Standard of the washer.
    pub washer_standard: &'static str,
    /// Bore, outer diameter and thickness of the washer.
    pub washer: [f64; 3],
}

/// Lengths of bolts under the head, millimetres (ISO 888).
const LENGTHS: [f64; 33] = [
    4.0, 5.0, 6.0, 8.0, 10.0, 12.0, 16.0, 20.0, 25.0, 30.0, 35.0, 40.0, 45.0, 50.0, 55.0, 60.0,
    65.0, 70.0, 80.0, 90.0, 100.0, 110.0, 120.0, 130.0, 140.0, 150.0, 160.0, 180.0, 200.0, 220.0,
    240.0, 260.0, 300.0,
];

const fn button(
    diameter: f64,
    pitch: f64,
    head: [f64; 2],
    lengths: [f64; 2],
    nut: [f64; 2],
    washer: [f64; 3],
) -> Series {
    Series {
        diameter,
        pitch,
        bolt_standard: "ISO 7380-1",
        head,
        lengths,
        nut,
        washer_standard: "ISO 7093-1",
        washer,
    }
}

const fn small(
    diameter: f64,
    pitch: f64,
    head: [f64; 2],
    lengths: [f64; 2],
    nut: [f64; 2],
    washer: [f64; 3],
) -> Series {
    Series {
        bolt_standard: "ISO 4762",
        washer_standard: "ISO 7089",
        ..button(diameter, pitch, head, lengths, nut, washer)
    }
}

const fn hexagon(
    diameter: f64,
    pitch: f64,
    head: [f64; 2],
    lengths: [f64; 2],
    nut: [f64; 2],
    washer: [f64; 3],
) -> Series {
    Series {
        bolt_standard: "ISO 4014",
        ..button(diameter, pitch, head, lengths, nut, washer)
    }
}

/// The series.
const SERIES: [Series; 14] = [
    small(
        2.0,
        0.4,
        [3.8, 2.0],
        [4.0, 20.0],
        [4.0, 2.8],
        [2.2, 5.0, 0.3],
    ),
    small(
        2.5,
        0.45,
        [4.5, 2.5],
        [4.0, 25.0],
        [5.0, 3.8],
        [2.7, 6.0, 0.5],
    ),
    button(
        3.0,
        0.5,
        [5.7, 1.65],
        [5.0, 30.0],
        [5.5, 4.0],
        [3.2, 9.0, 0.8],
    ),
    button(
        4.0,
        0.7,
        [7.6, 2.2],
        [6.0, 40.0],
        [7.0, 5.0],
        [4.3, 12.0, 1.0],
    ),
    button(
        5.0,
        0.8,
        [9.5, 2.75],
        [8.0, 50.0],
        [8.0, 5.0],
        [5.3, 15.0, 1.0],
    ),
    button(
        6.0,
        1.0,
        [10.5, 3.3],
        [8.0, 60.0],
        [10.0, 6.0],
        [6.4, 18.0, 1.6],
    ),
    button(
        8.0,
        1.25,
        [14.0, 4.4],
        [10.0, 80.0],
        [13.0, 8.0],
        [8.4, 24.0, 2.0],
    ),
    button(
        10.0,
        1.5,
        [17.5, 5.5],
        [12.0, 90.0],
        [17.0, 10.0],
        [10.5, 30.0, 2.5],
    ),
    button(
        12.0,
        1.75,
        [21.0, 6.6],
        [16.0, 120.0],
        [19.0, 12.0],
        [13.0, 37.0, 3.0],
    ),
    hexagon(
        14.0,
        2.0,
        [21.0, 8.8],
        [60.0, 140.0],
        [22.0, 14.0],
        [15.0, 44.0, 3.0],
    ),
    hexagon(
        16.0,
        2.0,
        [24.0, 10.0],
        [65.0, 160.0],
        [24.0, 16.0],
        [17.0, 50.0, 3.0],
    ),
    hexagon(
        20.0,
        2.5,
        [30.0, 12.5],
        [80.0, 200.0],
        [30.0, 20.0],
        [22.0, 60.0, 4.0],
    ),
    hexagon(
        24.0,
        3.0,
        [36.0, 15.0],
        [90.0, 240.0],
        [36.0, 24.0],
        [26.0, 72.0, 5.0],
    ),
    hexagon(
        30.0,
        3.5,
        [46.0, 18.7],
        [110.0, 300.0],
        [46.0, 30.0],
        [33.0, 92.0, 6.0],
    ),
];

impl Series {
    /// The row of a nominal diameter in metres.
    pub fn of(diameter: f64) -> Option<&'static Self> {
        SERIES
            .iter()
            .find(|row| (row.diameter - diameter * MM).abs() < 0.05)
    }

    /// Shortest bolt, metres, for a stack of lamellae and foils (metres): through both washers
    /// and the nut with two threads to spare.
    pub fn bolt_length(&self, stack: f64) -> Result<f64, f64> {
        let need = stack * MM + 2.0 * self.washer[2] + self.nut[1] + FREE_THREADS * self.pitch;
        self.length_of(need / MM).ok_or(need / MM)
    }

    /// Shortest bolt that is at least so long under the head, metres.
    pub fn length_of(&self, need: f64) -> Option<f64> {
        LENGTHS
            .into_iter()
            .filter(|length| (self.lengths[0]..=self.lengths[1]).contains(length))
            .find(|length| *length >= need * MM - 1e-9)
            .map(|length| length / MM)
    }

    /// What holds a stack of lamellae and foils, metres: the shortest bolt, or rod where no bolt
    /// is long enough.
    pub fn fastener(&self, stack: f64) -> Result<Fastener, f64> {
        self.bolt_length(stack).map(Fastener::Bolt).or_else(|need| {
            if self.diameter < ROD_FROM {
                return Err(need);
            }
            let with_second_nut = need * MM + self.nut[1] + FREE_THREADS * self.pitch;
            Ok(Fastener::Rod(
                libm::ceil(with_second_nut / ROD_STEP - 1e-9) * ROD_STEP / MM,
            ))
        })
    }

    /// Mass of a bolt, kilograms: shank of the pitch diameter, head less its socket.
    pub fn bolt_mass(&self, length: f64) -> f64 {
        let [across, height] = self.head;
        let head = if self.bolt_standard == "ISO 4014" {
            0.75_f64.sqrt() * across * across * height
        } else {
            0.68 * disc(across) * height
        };
        self.rod_mass(length) + head * STEEL * 1e-9
    }

    /// Mass of threaded rod, kilograms: its pitch diameter.
    pub fn rod_mass(&self, length: f64) -> f64 {
        disc(self.diameter - 0.65 * self.pitch) * length * MM * STEEL * 1e-9
    }

    /// Mass of a nut, kilograms: a hexagon less its bore, nine tenths of it steel.
    pub fn nut_mass(&self) -> f64 {
        let [flats, height] = self.nut;
        let hexagon = 0.75_f64.sqrt() * flats * flats;
        0.9 * (hexagon - disc(self.diameter)) * height * STEEL * 1e-9
    }

    /// Mass of a washer, kilograms.
    pub fn washer_mass(&self) -> f64 {
        let [bore, outer, height] = self.washer;
        (disc(outer) - disc(bore)) * height * STEEL * 1e-9
    }
}

/// Mass of a metre of tube, kilograms, if its name tells what it is made of.
pub fn tube_mass_per_metre(shell: &Shell) -> Option<f64> {
    let material = shell.name.split_whitespace().next()?;
    let (_, density) = TUBES
        .iter()
        .find(|(name, _)| material.eq_ignore_ascii_case(name))?;
    let bore = shell.diameter - 2.0 * shell.wall;
    Some((disc(shell.diameter) - disc(bore)) * density)
}

/// Bolts are made this much thinner than their nominal diameter, metres: a tube whose bore is the
/// nominal diameter slides over them.
const FIT: f64 = 1e-6;

/// Bores that are wider than the bolt by more than this leave the shell askew, metres.
const LOOSE: f64 = 0.5e-3;

/// Hardware that cannot be bought or does not go together.
pub fn check(hardware: &Hardware) -> Vec<Diagnostic> {
    let mut errors = Vec::new();
    if Series::of(hardware.bolt.diameter).is_none() {
        errors.push(
            Diagnostic::error(
                codes::UNKNOWN_BOLT,
                format!("no standard series for the bolt `{}`", hardware.bolt.name),
            )
            .at_key("hardware.bolt", "not in the series")
            .help("M2, M2.5, M3, M4, M5, M6, M8, M10, M12, M14, M16, M20, M24 and M30 are known"),
        );
    }
    if let Some(shell) = &hardware.shell {
        let bore = shell.diameter - 2.0 * shell.wall;
        if bore < hardware.bolt.diameter - FIT {
            errors.push(
                Diagnostic::error(
                    codes::SHELL_TOO_NARROW,
                    format!(
                        "the shell `{}` has a bore of {:.2} mm, the bolt {} does not go through",
                        shell.name,
                        bore * MM,
                        hardware.bolt.name
                    ),
                )
                .at_key("hardware.shell", "too narrow")
                .help(format!(
                    "a tube with a bore of {:.1} mm slides over the bolt",
                    hardware.bolt.diameter * MM + 0.1
                )),
            );
        } else if bore > hardware.bolt.diameter + LOOSE + FIT {
            errors.push(
                Diagnostic::warning(
                    codes::SHELL_LOOSE,
                    format!(
                        "the shell `{}` has a bore of {:.2} mm, {:.2} mm wider than the bolt {}",
                        shell.name,
                        bore * MM,
                        (bore - hardware.bolt.diameter) * MM,
                        hardware.bolt.name
                    ),
                )
                .at_key("hardware.shell", "loose")
                .help(format!(
                    "a tube with a bore of {:.1} mm stands straight on the bolt",
                    hardware.bolt.diameter * MM + 0.1
                )),
            );
        }
    }
    errors
}

fn disc(diameter: f64) -> f64 {
    0.25 * core::f64::consts::PI * diameter * diameter
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::project::model::Bolt;

    #[test]
    fn the_grip_of_two_lamellae_of_three_millimetres_takes_an_m4_of_sixteen() {
        let m4 = Series::of(0.004).expect("in the series");
        // 6 + 2 washers of 1 + nut of 5 + 2 threads of 0.7 = 14.4.
        assert_eq!(m4.bolt_length(0.006), Ok(0.016));
        assert_eq!(m4.bolt_length(0.0076), Ok(0.016));
        assert_eq!(m4.bolt_length(0.0077), Ok(0.02));
        assert!(m4.bolt_length(0.05).is_err());
    }

    #[test]
    fn masses_agree_with_dealers_tables() {
        // Catalogue masses in grams: ISO 7380 M4x16 1.8, M3x10 0.73; DIN 985 M4 1.1; ISO 7093 M4 0.77.
        let m4 = Series::of(0.004).expect("in the series");
        let m3 = Series::of(0.003).expect("in the series");
        for (computed, table) in [
            (m4.bolt_mass(0.016), 1.8e-3),
            (m3.bolt_mass(0.010), 0.73e-3),
            (m4.nut_mass(), 1.1e-3),
            (m4.washer_mass(), 0.77e-3),
        ] {
            assert!((computed / table - 1.0).abs() < 0.1, "{computed} {table}");
        }
    }

    #[test]
    fn a_bolt_goes_through_a_bore_of_its_nominal_diameter() {
        let hardware = Hardware {
            bolt: Bolt {
                name: "M4".to_owned(),
                diameter: 0.004,
            },
            sticker: None,
            shell: Some(Shell {
                name: "brass 5x0.5".to_owned(),
                diameter: 0.005,
                wall: 0.0005,
            }),
        };
        assert_eq!(check(&hardware), []);
    }

    #[test]
    fn a_shell_narrower_than_the_bolt_and_a_bolt_of_no_series_are_refused() {
        let hardware = Hardware {
            bolt: Bolt {
                name: "M7".to_owned(),
                diameter: 0.007,
            },
            sticker: None,
            shell: Some(Shell {
                name: "brass 5x0.5".to_owned(),
                diameter: 0.005,
                wall: 0.0005,
            }),
        };
        let codes: Vec<String> = check(&hardware)
            .iter()
            .map(|d| d.code.to_string())
            .collect();
        assert_eq!(codes, ["E0707", "E0709"]);
    }
}
