//! The steps in which the pieces of lamellae become whole: which pieces belong together, in which
//! order, and what holds them.

use super::Page;
use crate::fabrication::hardware::Series;
use crate::fabrication::index::PlanIndex;
use crate::fabrication::pieces::{pieces, plates};
use crate::fabrication::sheet::trim;
use crate::fabrication::splicing::shopping::screw_length;
use crate::fabrication::units::MM;
use crate::plan::{LamellaRecord, Plan};
use crate::project::model::{Family, Hardware, SpliceKind};

/// Lamellae with joints of a kind.
fn spliced(plan: &Plan, kind: SpliceKind) -> Vec<&LamellaRecord> {
    let is_of_kind = |lamella: &&LamellaRecord| {
        let mut joints = lamella.pieces.iter().filter_map(|p| p.joint.as_ref());
        joints.any(|joint| joint.kind == kind)
    };
    plan.lamellae.iter().filter(is_of_kind).collect()
}

/// Fingers and scarfs.
pub(super) fn glue(page: &mut Page, plan: &Plan) {
    let how = [
        (
            SpliceKind::Finger,
            "Put glue on the flanks of the fingers, push them together and press the faces flat \
             between foils.",
        ),
        (
            SpliceKind::Scarf,
            "At each joint plane the piece before it down on its `TOP`, the piece after it on its \
             back, from the scored line to nothing at the end, and glue the slopes.",
        ),
    ];
    for (kind, how) in how {
        let lamellae = spliced(plan, kind);
        if lamellae.is_empty() {
            continue;
        }
        page.step("Glue the pieces");
        page.line(&format!(
            "{how} Faces `TOP` up, arrows the same way, all pieces against one straight edge. Let \
             the glue set for a day, and bend every lamella over the knee before it is built in."
        ));
        page.line("");
        page.table(
            &["lamella", "pieces, from its start", "length"],
            lamellae
                .iter()
                .map(|lamella| vec![lamella.id.clone(), in_order(lamella), length(lamella)]),
        );
    }
}

/// Plates.
pub(super) fn bolt(page: &mut Page, plan: &Plan, hardware: &Hardware) {
    let lamellae = spliced(plan, SpliceKind::Plate);
    if lamellae.is_empty() {
        return;
    }
    let index = PlanIndex::new(plan);
    page.step("Bolt the pieces together");
    page.line(
        "Lay the pieces end to end against a straight edge, faces `TOP` up, arrows the same way, and \
         a plate over every joint, on the face that is away from the crossing lamellae. Each bolt has \
         a washer on both sides and a nut, tight. Bend every lamella over the knee before it is built \
         in.",
    );
    page.line("");
    page.table(
        &[
            "lamella",
            "pieces, from its start",
            "plates",
            "on the face",
            "bolts",
            "length",
        ],
        lamellae.iter().map(|lamella| {
            let plates = plates(lamella);
            let screws: usize = plates.iter().map(|plate| plate.joint.screws.len()).sum();
            let ids: Vec<String> = plates
                .iter()
                .map(|plate| format!("`{}`", plate.id))
                .collect();
            // The u-family lies on the v-family.
            let face = match index.member(&lamella.member).map(|member| member.family) {
                Some(Family::V) => "bottom",
                _ => "top",
            };
            vec![
                lamella.id.clone(),
                in_order(lamella),
                ids.join(" "),
                face.to_owned(),
                format!("{screws} x {}", screw(lamella, hardware)),
                length(lamella),
            ]
        }),
    );
}

/// `M4x16`.
fn screw(lamella: &LamellaRecord, hardware: &Hardware) -> String {
    let bolt = &hardware.bolt;
    let length = Series::of(bolt.diameter).and_then(|series| screw_length(series, lamella).ok());
    match length {
        Some(length) => format!("{}x{}", bolt.name, trim(length * MM)),
        None => bolt.name.clone(),
    }
}

fn in_order(lamella: &LamellaRecord) -> String {
    let ids: Vec<String> = pieces(lamella)
        .iter()
        .map(|piece| format!("`{}`", piece.id))
        .collect();
    ids.join(" ")
}

fn length(lamella: &LamellaRecord) -> String {
    format!("{:.1}", lamella.length * MM)
}
