//! What is cut, cast or printed: lamellae with their openings and pieces, stickers, supports.

use crate::diff::class::Class::{Reassemble, Recut};
use crate::diff::part::{Field, Item, Kind, Part};
use crate::diff::quantity::Quantity;
use crate::plan::{Face, LamellaRecord, OpeningRecord, PieceRecord, Plan};
use crate::project::model::{SpliceKind, SupportKind};

pub(super) fn lamellae(plan: &Plan) -> Vec<Part> {
    plan.lamellae.iter().map(lamella).collect()
}

fn lamella(record: &LamellaRecord) -> Part {
    let openings = record.openings.iter().map(opening);
    Part {
        kind: Kind::Lamella,
        id: record.id.clone(),
        fields: vec![
            Field::length("length", Recut, record.length).headline(),
            Field::length("width", Recut, record.width).headline(),
            Field::length("thickness", Recut, record.thickness).headline(),
            Field::text("material", Recut, &*record.material).headline(),
            Field::length("end margin", Recut, record.end_margin),
        ],
        items: openings.chain(record.pieces.iter().map(piece)).collect(),
        presence: Recut,
    }
}

fn opening(record: &OpeningRecord) -> Item {
    let (kind, mut fields, diameter) = match *record {
        OpeningRecord::Hole { at, diameter, .. } => {
            ("hole", vec![Field::length("at", Recut, at)], diameter)
        }
        OpeningRecord::Notch {
            from, to, diameter, ..
        } => (
            "notch",
            vec![
                Field::length("from", Recut, from),
                Field::length("to", Recut, to),
            ],
            diameter,
        ),
    };
    fields.push(Field::length("diameter", Recut, diameter));
    Item {
        kind,
        id: record.crossing().to_owned(),
        fields,
        presence: Recut,
    }
}

fn piece(record: &PieceRecord) -> Item {
    let mut fields = vec![
        Field::length("from", Recut, record.from),
        Field::length("to", Recut, record.to),
    ];
    if let Some(joint) = &record.joint {
        let kind = match joint.kind {
            SpliceKind::Finger => "finger",
            SpliceKind::Scarf => "scarf",
            SpliceKind::Plate => "plate",
        };
        fields.push(Field::text("joint", Recut, kind));
        fields.push(Field::length("joint length", Recut, joint.length));
        fields.push(Field::count("fingers", Recut, joint.fingers as usize));
        fields.push(Field::count("screws", Recut, joint.screws.len()));
        fields.push(Field::length("screw hole", Recut, joint.hole));
    }
    Item {
        kind: "piece",
        id: record.id.clone(),
        fields,
        presence: Recut,
    }
}

pub(super) fn stickers(plan: &Plan) -> Vec<Part> {
    plan.stickers
        .iter()
        .map(|record| {
            let face = match record.face {
                Face::Top => "top",
                Face::Bottom => "bottom",
            };
            let side = |from: usize, to: usize| {
                let [a, b] = [record.outline[from], record.outline[to]];
                libm::hypot(b[0] - a[0], b[1] - a[1])
            };
            let [along, _] = record.outline[0];
            Part {
                kind: Kind::Sticker,
                id: record.id.clone(),
                fields: vec![
                    Field::length("length", Recut, side(0, 1)).headline(),
                    Field::length("width", Recut, side(1, 2)).headline(),
                    Field::length("slot", Recut, record.slot[1] - record.slot[0]).headline(),
                    Field::length("slot from the corner", Recut, record.slot[0] - along),
                    Field::length("diagonal 1-3", Recut, side(0, 2)),
                    Field::length("diagonal 2-4", Recut, side(1, 3)),
                    Field::length("slot width", Recut, record.diameter),
                    Field::length("from", Reassemble, along),
                    Field::text("face", Reassemble, face),
                    Field::id("lamella", Reassemble, &*record.lamella),
                    Field::count("number", Reassemble, record.number as usize).headline(),
                ],
                items: Vec::new(),
                presence: Recut,
            }
        })
        .collect()
}

pub(super) fn supports(plan: &Plan) -> Vec<Part> {
    plan.supports
        .iter()
        .map(|record| {
            let kind = match record.kind {
                SupportKind::ConcreteBlock => "concrete-block",
                SupportKind::Printed => "printed",
                SupportKind::WedgeOnBlock => "wedge-on-block",
            };
            let body = record.body.as_ref().map(|body| {
                [
                    Field::length("pad", Recut, body.pad),
                    Field::length("foot", Recut, body.foot),
                    Field::length("bore", Recut, body.bore),
                    Field::length("depth of the bore", Recut, body.depth),
                    Field::length("block", Recut, body.block),
                ]
            });
            let mut part = Part {
                kind: Kind::Support,
                id: record.id.clone(),
                fields: vec![
                    Field::text("kind", Recut, kind).headline(),
                    Field::length("height", Recut, record.height).headline(),
                    Field::number("tilt", Recut, record.tilt, Quantity::Angle).headline(),
                    Field::number("azimuth", Reassemble, record.azimuth, Quantity::Angle),
                    Field::length("bolt", Reassemble, record.bolt_length),
                    Field::place("position", Reassemble, record.position),
                    Field::id("at", Reassemble, &*record.at),
                ],
                items: Vec::new(),
                presence: Recut,
            };
            part.fields.extend(body.into_iter().flatten());
            part
        })
        .collect()
}
