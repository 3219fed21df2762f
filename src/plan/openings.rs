//! Openings in the notations for people and in the binary form of the cache.
//!
//! In RON and JSON an opening names its kind beside its other fields. A reader can tell which
//! fields to expect only after it has seen the kind, which formats that are not self-describing
//! cannot do: in them an opening is a row of fixed columns.

use super::OpeningRecord;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// Centre when flat, centre when deployed (`None` for a hole), cut width, id of the crossing.
type Row<'a> = (f64, Option<f64>, f64, std::borrow::Cow<'a, str>);

/// For `#[serde(with)]`.
pub(super) fn serialize<S: Serializer>(
    openings: &[OpeningRecord],
    serializer: S,
) -> Result<S::Ok, S::Error> {
    if serializer.is_human_readable() {
        return openings.serialize(serializer);
    }
    serializer.collect_seq(openings.iter().map(row))
}

/// For `#[serde(with)]`.
pub(super) fn deserialize<'de, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<Vec<OpeningRecord>, D::Error> {
    if deserializer.is_human_readable() {
        return Vec::deserialize(deserializer);
    }
    let rows = Vec::<Row<'static>>::deserialize(deserializer)?;
    Ok(rows.into_iter().map(record).collect())
}

fn row(opening: &OpeningRecord) -> Row<'_> {
    match opening {
        OpeningRecord::Hole {
            at,
            diameter,
            crossing,
        } => (*at, None, *diameter, crossing.into()),
        OpeningRecord::Notch {
            from,
            to,
            diameter,
            crossing,
        } => (*from, Some(*to), *diameter, crossing.into()),
    }
}

fn record((from, to, diameter, crossing): Row<'_>) -> OpeningRecord {
    let crossing = crossing.into_owned();
    match to {
        None => OpeningRecord::Hole {
            at: from,
            diameter,
            crossing,
        },
        Some(to) => OpeningRecord::Notch {
            from,
            to,
            diameter,
            crossing,
        },
    }
}

#[cfg(test)]
mod tests {
    use super::OpeningRecord::{self, Hole, Notch};
    use serde::{Deserialize, Serialize};

    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
    struct Part {
        #[serde(with = "super")]
        openings: Vec<OpeningRecord>,
    }

    #[test]
    fn openings_come_back_from_every_notation() {
        let crossing = "west.u01-v02".to_owned();
        let part = Part {
            openings: vec![
                Hole {
                    at: 0.25,
                    diameter: 0.0042,
                    crossing: crossing.clone(),
                },
                Notch {
                    from: 0.5,
                    to: 0.5625,
                    diameter: 0.0052,
                    crossing,
                },
            ],
        };
        let bytes = postcard::to_stdvec(&part).expect("records have a binary form");
        assert_eq!(postcard::from_bytes(&bytes), Ok(part.clone()));
        let ron = ron::to_string(&part).expect("records have a form for people");
        assert!(ron.contains("kind:\"notch\",from:0.5,to:0.5625"), "{ron}");
        assert_eq!(ron::from_str(&ron), Ok(part.clone()));
        let json = serde_json::to_string(&part).expect("records have a form for scripts");
        let back: Part = serde_json::from_str(&json).expect("what was written");
        assert_eq!(back, part);
    }
}
