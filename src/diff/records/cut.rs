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
            let [[from, right], [to, _], _, [lean, left]] = record.outline;
            Part {
                kind: Kind::Sticker,
                id: record.id.clone(),
                fields: vec![
                    Field::length("length", Recut, to - from).headline(),
                    Field::length("width", Recut, left - right).headline(),
                    Field::length("lean", Recut, lean - from),
                    Field::length("slot", Recut, record.slot[1] - record.slot[0]).headline(),
                    Field::length("slot from the edge", Recut, record.slot[0] - from),
                    Field::length("slot width", Recut, record.diameter),
                    Field::length("from", Reassemble, from),
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
            let mut fields = vec![
                Field::text("kind", Recut, kind).headline(),
                Field::length("height", Recut, record.height).headline(),
                Field::number("tilt", Recut, record.tilt, Quantity::Angle).headline(),
                Field::number("azimuth", Reassemble, record.azimuth, Quantity::Angle),
                Field::length("bolt", Reassemble, record.bolt_length),
                Field::place("position", Reassemble, record.position),
                Field::id("at", Reassemble, &*record.at),
            ];
            if let Some(body) = &record.body {
                fields.push(Field::length("pad", Recut, body.pad));
                fields.push(Field::length("foot", Recut, body.foot));
                fields.push(Field::length("bore", Recut, body.bore));
                fields.push(Field::length("depth of the bore", Recut, body.depth));
                fields.push(Field::length("block", Recut, body.block));
            }
            Part {
                kind: Kind::Support,
                id: record.id.clone(),
                fields,
                items: Vec::new(),
                presence: Recut,
            }
        })
        .collect()
}
