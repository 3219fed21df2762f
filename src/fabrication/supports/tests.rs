use super::body::{LOW_EDGE, WALL};
use super::*;
use crate::plan::{
    CrossingRecord, LamellaRecord, MemberRecord, OpeningRecord, PointRecord, Positions,
};
use crate::project::model::{Family, SupportPlaces};

/// Two lamellae of 30 x 3 mm that cross in one point of a surface with this normal.
fn plan(points: &[(&str, [f64; 3], [f64; 3])]) -> Plan {
    let mut plan = Plan::default();
    for (id, position, normal) in points {
        plan.points.push(PointRecord {
            id: (*id).to_owned(),
            position: *position,
            normal: *normal,
        });
        let [u, v] = ["u01", "v01"].map(|label| format!("{id}.{label}"));
        for (member, family) in [(&u, Family::U), (&v, Family::V)] {
            plan.members.push(MemberRecord {
                id: member.clone(),
                patch: (*id).to_owned(),
                family,
                index: 1,
                start: 0.0,
                end: 0.0,
                boundary: true,
                length_surface: 1.0,
                length_planar: 1.0,
                polyline: vec![*position],
                planar: [[0.0; 2], [1.0, 0.0]],
            });
            plan.lamellae.push(LamellaRecord {
                id: member.clone(),
                member: member.clone(),
                material: String::new(),
                length: 1.06,
                end_margin: 0.03,
                width: 0.03,
                thickness: 0.003,
                mass: 0.04,
                openings: vec![OpeningRecord::Hole {
                    at: 0.0,
                    diameter: 0.0042,
                    crossing: format!("{id}.u01-v01"),
                }],
                pieces: Vec::new(),
            });
        }
        let on = Positions {
            surface: 0.0,
            planar: 0.0,
        };
        plan.crossings.push(CrossingRecord {
            id: format!("{id}.u01-v01"),
            u,
            v,
            position: *position,
            normal: *normal,
            planar: [0.0; 2],
            on_u: on,
            on_v: on,
            angle_surface: 90.0,
            angle_planar: 60.0,
        });
    }
    plan
}

fn listed(ids: &[&str], kind: SupportKind, height: f64) -> Supports {
    Supports {
        at: SupportPlaces::Listed(ids.iter().map(|&id| id.to_owned()).collect()),
        kind,
        height,
    }
}

fn made(plan: &Plan, supports: &Supports) -> Checked<Vec<SupportRecord>> {
    let bolt = Bolt {
        name: "M4".to_owned(),
        diameter: 0.004,
    };
    records(
        plan,
        SupportInputs {
            supports,
            bolt: &bolt,
        },
    )
}

/// A normal of that tilt whose face falls to that azimuth, degrees.
fn normal(tilt: f64, azimuth: f64) -> [f64; 3] {
    let (sin, cos) = libm::sincos(tilt.to_radians());
    let (y, x) = libm::sincos(azimuth.to_radians());
    [sin * x, sin * y, cos]
}

#[test]
fn a_contact_face_lies_half_the_stack_below_the_surface_and_falls_with_it() {
    let plan = plan(&[("a", [1.0, 2.0, 0.5], normal(30.0, 120.0))]);
    let records = made(&plan, &listed(&["a"], SupportKind::Printed, 0.0))
        .expect("made")
        .value;
    let [record] = &records[..] else {
        panic!("one support");
    };
    assert_eq!((record.id.as_str(), record.at.as_str()), ("support-a", "a"));
    assert_eq!(record.crossings, ["a.u01-v01"]);
    assert!((record.tilt - 30.0).abs() < 1e-9 && (record.azimuth - 120.0).abs() < 1e-9);
    let below = [0, 1, 2].map(|i| [1.0, 2.0, 0.5][i] - record.position[i]);
    for (offset, n) in below.iter().zip(normal(30.0, 120.0)) {
        assert!((offset - 0.003 * n).abs() < 1e-12);
    }
    // 6 mm of wood, a washer of 1 mm, 2.5 x 4 mm of thread: 17, of which M4 has 20.
    assert_eq!(record.bolt_length, 0.02);
    let body = record.body.expect("a foot");
    assert!((body.depth - 0.015).abs() < 1e-12 && (body.bore - 0.0033).abs() < 1e-12);
}

#[test]
fn a_surface_that_is_seen_from_below_is_supported_from_below_too() {
    let upside = normal(20.0, 45.0).map(|v| -v);
    let plan = plan(&[("a", [0.0; 3], upside)]);
    let records = made(&plan, &listed(&["a"], SupportKind::Printed, 0.0)).expect("made");
    assert!((records.value[0].tilt - 20.0).abs() < 1e-9);
    assert!(records.value[0].normal[2] > 0.9);
}

#[test]
fn without_a_height_supports_are_as_low_as_their_faces_allow() {
    let places = [
        ("a", [0.0, 0.0, 0.0], normal(0.0, 0.0)),
        ("b", [1.0, 0.0, 0.0], normal(40.0, 180.0)),
    ];
    let plan = plan(&places);
    let records = made(&plan, &listed(&["a", "b"], SupportKind::WedgeOnBlock, 0.0))
        .expect("made")
        .value;
    // The steep one decides: 5 mm of edge, half of 45 mm times tan 40, and 30 mm of block.
    let tan = libm::tan(40.0_f64.to_radians());
    assert!((records[1].height - (0.035 + 0.0225 * tan)).abs() < 1e-12);
    let block = records[1].body.expect("a block").block;
    assert!((block - LOW_EDGE).abs() < 1e-12);
    // Both stand on the same ground.
    let ground = |r: &SupportRecord| r.position[2] - r.height;
    assert!((ground(&records[0]) - ground(&records[1])).abs() < 1e-12);
}

#[test]
fn an_inclined_block_has_the_volume_of_its_middle_height_and_stands_by_itself() {
    let plan = plan(&[("a", [0.0; 3], normal(25.0, 0.0))]);
    let supports = listed(&["a"], SupportKind::ConcreteBlock, 0.12);
    let records = made(&plan, &supports).expect("made").value;
    let body = records[0].body.expect("a block");
    // Three widths of the lamella.
    assert!((body.foot - 0.09).abs() < 1e-12);
    assert!((body.volume - 0.09 * 0.09 * 0.12).abs() < 1e-12);
    assert!((body.mass - body.volume * 2400.0).abs() < 1e-9);
    // The centre of the obliquely cut prism, by summing slices.
    let tan = libm::tan(25.0_f64.to_radians());
    let slices = 2000;
    let (mut area, mut moment) = (0.0, 0.0);
    for i in 0..slices {
        let x = (f64::from(i) + 0.5) / f64::from(slices) * 0.09 - 0.045;
        let height = 0.12 - x * tan;
        area += height;
        moment += height * x;
    }
    let lever = (moment / area).abs();
    let thrust = body.mass * GRAVITY * (0.045 - lever) / 0.12;
    assert!((body.tipping_thrust / thrust - 1.0).abs() < 1e-6);
    assert!(body.tipping_thrust > 0.25 * body.mass * GRAVITY);
}

#[test]
fn the_hole_of_a_printed_foot_keeps_its_wall_at_every_tilt() {
    for tilt in [0.0, 10.0, 30.0, 50.0, 65.0, 69.0] {
        let plan = plan(&[("a", [0.0; 3], normal(tilt, 0.0))]);
        let supports = listed(&["a"], SupportKind::Printed, 0.0);
        let record = &made(&plan, &supports).expect("made").value[0];
        let body = record.body.expect("a foot");
        let (sin, cos) = libm::sincos(tilt.to_radians());
        // The lowest and the outermost point of the hole's end, and the wall at that height.
        let low = record.height - body.depth * cos - 0.5 * body.bore * sin;
        assert!(low >= WALL - 1e-9, "{tilt}: {low}");
        let level = record.height - body.depth * cos;
        let top = record.height + 0.5 * body.pad * sin;
        let wall = 0.5 * body.foot + level / top * 0.5 * (body.pad * cos - body.foot);
        let reach = body.depth * sin + 0.5 * body.bore * cos;
        assert!(wall - reach >= WALL - 1e-9, "{tilt}: {}", wall - reach);
    }
}

#[test]
fn what_cannot_stand_is_told() {
    let places = [
        ("a", [0.0, 0.0, 0.0], normal(0.0, 0.0)),
        ("b", [1.0, 0.0, 0.0], normal(60.0, 180.0)),
        ("c", [1.0, 1.0, 0.5], normal(80.0, 180.0)),
    ];
    let mut plan = plan(&places);
    plan.points.push(PointRecord {
        id: "free".to_owned(),
        position: [5.0; 3],
        normal: [0.0, 0.0, 1.0],
    });
    let codes = |ids: &[&str], kind, height| -> Vec<String> {
        let told = match made(&plan, &listed(ids, kind, height)) {
            Ok(checked) => checked.warnings,
            Err(told) => told,
        };
        told.iter().map(|d| d.code.to_string()).collect()
    };
    assert_eq!(codes(&["a"], SupportKind::Printed, 0.0), [""; 0]);
    assert_eq!(codes(&["a", "free"], SupportKind::Printed, 0.0), ["E0761"]);
    assert_eq!(codes(&["b"], SupportKind::Printed, 0.01), ["E0762"]);
    assert_eq!(
        codes(&["a", "a.u01-v01"], SupportKind::Printed, 0.0),
        ["W0763"]
    );
    assert_eq!(codes(&["a", "c"], SupportKind::Printed, 0.0), ["W0764"]);
    assert_eq!(codes(&["a"], SupportKind::Printed, 0.4), ["W0765"]);
    assert_eq!(codes(&["a"], SupportKind::ConcreteBlock, 0.6), ["W0766"]);
    // Supports that stand half a metre higher than the lowest member.
    assert_eq!(codes(&["c", "a"], SupportKind::Printed, 0.0), ["W0764"]);
    plan.members[0].polyline = vec![[0.0, 0.0, -0.12]];
    let supports = |height| made(&plan, &listed(&["a"], SupportKind::Printed, height));
    let told = supports(0.05).expect("made");
    assert_eq!(told.warnings[0].code, codes::GRID_BELOW_GROUND);
    // Without a height the ground goes below the grid.
    let lowered = supports(0.0).expect("made");
    assert_eq!(lowered.warnings, []);
    assert!((lowered.value[0].height - (0.12 + CLEAR - 0.003)).abs() < 1e-12);
}
