//! The supports as a table: where each stands, in the frame of the surface and on the ground, and
//! what it is.

use super::super::tables::{Table, fixed, optional};
use super::super::units::MM;
use super::setting_out::SettingOut;
use crate::plan::Plan;
use crate::project::model::SupportKind;

/// The word of the project file for a kind.
pub fn kind_word(kind: SupportKind) -> &'static str {
    match kind {
        SupportKind::Printed => "printed",
        SupportKind::ConcreteBlock => "concrete-block",
        SupportKind::WedgeOnBlock => "wedge-on-block",
    }
}

/// `supports.csv`.
pub fn table(plan: &Plan) -> Vec<u8> {
    let setting = SettingOut::new(&plan.supports);
    let mut table = Table::new(&[
        "id",
        "at",
        "kind",
        "x_m",
        "y_m",
        "z_m",
        "normal_x",
        "normal_y",
        "normal_z",
        "tilt_deg",
        "azimuth_deg",
        "height_mm",
        "ground_x_mm",
        "ground_y_mm",
        "tape_1_mm",
        "tape_2_mm",
        "contact_mm",
        "foot_mm",
        "volume_l",
        "mass_kg",
        "tipping_thrust_N",
        "bolt_mm",
        "hole_mm",
        "hole_depth_mm",
    ]);
    for (i, support) in plan.supports.iter().enumerate() {
        let station = setting.as_ref().and_then(|setting| setting.stations.get(i));
        let [x, y, z] = support.position;
        let [nx, ny, nz] = support.normal;
        let body = support.body;
        table.row([
            support.id.clone(),
            support.at.clone(),
            kind_word(support.kind).to_owned(),
            fixed(x, 5),
            fixed(y, 5),
            fixed(z, 5),
            fixed(nx, 5),
            fixed(ny, 5),
            fixed(nz, 5),
            fixed(support.tilt, 2),
            fixed(support.azimuth, 2),
            fixed(support.height * MM, 1),
            optional(station.map(|s| s.at[0]), 1),
            optional(station.map(|s| s.at[1]), 1),
            optional(station.map(|s| s.tapes[0]), 1),
            optional(station.map(|s| s.tapes[1]), 1),
            optional(body.map(|b| b.pad * MM), 1),
            optional(body.map(|b| b.foot * MM), 1),
            optional(body.map(|b| b.volume * 1e3), 3),
            optional(body.map(|b| b.mass), 3),
            optional(body.map(|b| b.tipping_thrust), 2),
            fixed(support.bolt_length * MM, 0),
            optional(body.map(|b| b.bore * MM), 2),
            optional(body.map(|b| b.depth * MM), 1),
        ]);
    }
    table.finish()
}
