//! The difference as a document: what every renderer works from, and what `--format json` writes.
//!
//! Numbers are in the units that are shown (`unit` beside them), rounded to a tenth of what people
//! read. Fields may be added without a new `format_version`; readers ignore what they do not know.

use super::class::Class;
use super::drawing::Drawing;
use super::part::Kind;
use super::quantity::Quantity;
use super::tolerance::Tolerances;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Version of the format that this program writes and reads.
pub const FORMAT: u32 = 1;

/// The difference of two plans.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Difference {
    /// Version of this format.
    pub format_version: u32,
    /// The side that is compared with.
    pub before: Side,
    /// The side that is judged.
    pub after: Side,
    /// What is noise.
    pub tolerance: Tolerances,
    /// The whole in a few numbers.
    pub summary: Summary,
    /// What was edited in the project file, where both texts are at hand.
    pub edits: Vec<Edit>,
    /// Points and patches under new names.
    pub renames: Vec<Rename>,
    /// Parts that changed, worst first; noise is left out.
    pub changes: Vec<Change>,
    /// What the compiler says now and did not say before.
    pub new_warnings: Vec<String>,
    /// What the compiler said before and does not say now.
    pub gone_warnings: Vec<String>,
    /// What a reader must know about this comparison: sides that could not be compiled.
    pub notes: Vec<String>,
    /// Overlays of both sides.
    pub drawings: Vec<Drawing>,
}

/// One side.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
pub struct Side {
    /// As the user named it: `HEAD~1`, `working tree`, `a/plan.ron`.
    pub label: String,
    /// Digest of the commit, if it is one.
    pub commit: Option<String>,
    /// First line of its message.
    pub subject: Option<String>,
    /// Name of the project.
    pub project: String,
    /// What stands for it.
    pub basis: Basis,
}

/// What a side was read from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Basis {
    /// A plan: compiled, or a file.
    #[default]
    Plan,
    /// A lock: ids and headline values only.
    Lock,
}

/// The whole in a few numbers.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
pub struct Summary {
    /// The worst class of all changes; none if there are none above noise.
    pub class: Option<Class>,
    /// Parts by kind; kinds of which there are none are left out.
    pub counts: Vec<Count>,
    /// Sums over the structure; those that neither side has are left out.
    pub totals: Vec<Total>,
    /// Largest change that was hidden as noise, per quantity.
    pub hidden: Vec<Hidden>,
}

/// How many parts of a kind changed how. A part is counted once, except that a new name is
/// counted beside.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
pub struct Count {
    /// `lamellae`, `openings`, `bill rows`.
    pub what: String,
    /// Before.
    pub before: usize,
    /// After.
    pub after: usize,
    /// Only after.
    pub added: usize,
    /// Only before.
    pub removed: usize,
    /// On both sides, to be cut anew.
    pub recut: usize,
    /// On both sides, to be assembled otherwise.
    pub reassemble: usize,
    /// On both sides, to be drawn anew, for more than its name.
    pub redraw: usize,
    /// On both sides, with changes below tolerance only.
    pub noise: usize,
    /// On both sides and equal.
    pub same: usize,
    /// On both sides, under a new name.
    pub renamed: usize,
}

/// A sum over the structure.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Total {
    /// What is summed.
    pub what: String,
    /// Before, in its unit.
    pub before: Option<f64>,
    /// After, in its unit.
    pub after: Option<f64>,
    /// What is measured.
    pub quantity: Quantity,
    /// Unit of the numbers.
    pub unit: String,
}

/// The largest hidden change of a quantity.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Hidden {
    /// What is measured.
    pub quantity: Quantity,
    /// How much, in its unit.
    pub delta: f64,
    /// Unit of the number.
    pub unit: String,
    /// Id of the part.
    pub part: String,
    /// Name of its value.
    pub field: String,
    /// How many values changed this little.
    pub count: usize,
}

/// An edit of the project file.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Edit {
    /// Key path: `patches.west.members.u`.
    pub key: String,
    /// As it was written before.
    pub before: Option<String>,
    /// As it is written after.
    pub after: Option<String>,
    /// File and line after, or before if it is gone.
    pub place: Option<String>,
}

/// A point or patch under a new name.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Rename {
    /// `patch` or `point`.
    pub what: String,
    /// Name before.
    pub before: String,
    /// Name after.
    pub after: String,
}

/// What happened to a part.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "lowercase")]
pub enum Action {
    /// It is gone.
    Removed,
    /// It is new.
    Added,
    /// It is another.
    Changed,
    /// Only its name changed.
    Renamed,
}

impl Action {
    /// A mark that does not need colour.
    pub fn mark(self) -> char {
        match self {
            Self::Removed => '-',
            Self::Added => '+',
            Self::Changed => '~',
            Self::Renamed => '>',
        }
    }
}

/// A part that changed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Change {
    /// What it is.
    pub kind: Kind,
    /// Its id after, or before if it is gone.
    pub id: String,
    /// Its id before, if that was another.
    pub previous_id: Option<String>,
    /// What happened.
    pub action: Action,
    /// What it asks for.
    pub class: Class,
    /// Values that changed above tolerance; of an added or removed part its headline values.
    pub fields: Vec<FieldChange>,
    /// Openings, pieces, crossings and places on sheets that changed above tolerance.
    pub items: Vec<ItemChange>,
    /// Sheets on which it lies, after, or before if it is gone.
    pub used_on: Vec<String>,
}

/// A value that changed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FieldChange {
    /// Its name.
    pub name: String,
    /// Before; none if it was not there, or is a place or curve.
    pub before: Option<Reading>,
    /// After; none if it is not there any more, or is a place or curve.
    pub after: Option<Reading>,
    /// After less before; of places and curves how far they moved. None for words.
    pub delta: Option<f64>,
    /// What is measured; none for words.
    pub quantity: Option<Quantity>,
    /// Unit of the numbers.
    pub unit: String,
    /// What the change asks for.
    pub class: Class,
}

/// A shown value.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum Reading {
    /// A number in the unit beside it.
    Number(f64),
    /// A word or an id.
    Text(String),
}

/// An item that changed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ItemChange {
    /// `hole`, `notch`, `piece`, `crossing`, `family`, `part`.
    pub kind: String,
    /// Its id after, or before if it is gone.
    pub id: String,
    /// What happened.
    pub action: Action,
    /// Values that changed above tolerance.
    pub fields: Vec<FieldChange>,
}

/// Why a text is no difference.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ReadError {
    /// It is no JSON, or JSON of something else.
    Malformed(String),
    /// It has a version that this program does not know.
    UnknownFormat(u64),
}

impl Difference {
    /// The document: a change, an edit, a drawing a line.
    ///
    /// # Panics
    /// Never: a difference holds nothing that JSON cannot write.
    pub fn to_json(&self) -> String {
        let value = serde_json::to_value(self).expect("plain records");
        let mut text = String::from("{");
        for (i, (key, field)) in value.as_object().into_iter().flatten().enumerate() {
            text.push_str(if i > 0 { ",\n" } else { "\n" });
            match field.as_array().filter(|records| !records.is_empty()) {
                Some(records) => {
                    let lines: Vec<String> = records.iter().map(|r| format!("    {r}")).collect();
                    text.extend(["  \"", key, "\": [\n", &lines.join(",\n"), "\n  ]"]);
                }
                None => text.extend(["  \"", key, "\": ", &field.to_string()]),
            }
        }
        text.push_str("\n}\n");
        text
    }

    /// Reads a document that [`Difference::to_json`] wrote.
    ///
    /// # Errors
    /// Where the text is no difference, or one of another version.
    pub fn from_json(text: &str) -> Result<Self, ReadError> {
        let malformed = |error: serde_json::Error| ReadError::Malformed(error.to_string());
        let value: serde_json::Value = serde_json::from_str(text).map_err(malformed)?;
        match value
            .get("format_version")
            .and_then(serde_json::Value::as_u64)
        {
            Some(version) if version != u64::from(FORMAT) => Err(ReadError::UnknownFormat(version)),
            Some(_) => serde_json::from_value(value).map_err(malformed),
            None => Err(ReadError::Malformed(
                "it has no `format_version`".to_owned(),
            )),
        }
    }

    /// Whether there is a change that asks for at least this.
    pub fn has(&self, class: Class) -> bool {
        class > Class::Noise && self.summary.class.is_some_and(|worst| worst >= class)
    }

    /// Changes of a class, worst first.
    pub fn of(&self, class: Class) -> impl Iterator<Item = &Change> {
        self.changes
            .iter()
            .filter(move |change| change.class == class)
    }
}

/// The JSON schema of a difference, draft-07.
///
/// # Panics
/// Never: a schema is JSON.
pub fn schema() -> String {
    let settings = schemars::generate::SchemaSettings::draft07();
    let schema = settings
        .into_generator()
        .into_root_schema_for::<Difference>();
    let mut text = serde_json::to_string_pretty(&schema).expect("a schema is JSON");
    text.push('\n');
    text
}
