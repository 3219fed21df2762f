//! Writing and reading plans.

use super::Plan;

/// Version of the plan's format that this program writes.
pub const FORMAT: u32 = 1;

/// Why a plan could not be read.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ReadError {
    /// The text is no plan: what is wrong, and where (line and column from 1).
    Malformed {
        /// What is wrong.
        message: String,
        /// Line and column.
        at: (usize, usize),
    },
    /// The plan is of a format that this program does not know.
    UnknownFormat(u32),
}

/// The plan as RON, for people and git: a record a line, records sorted by id.
///
/// # Panics
/// Never: a plan holds nothing that RON cannot write.
pub fn to_ron(plan: &Plan) -> String {
    ron_to_depth(plan, 2)
}

/// A document as RON in which what lies deeper than `depth` stands on one line.
pub(super) fn ron_to_depth(document: &impl serde::Serialize, depth: usize) -> String {
    let config = ron::ser::PrettyConfig::new()
        .new_line("\n")
        .indentor("  ")
        .depth_limit(depth);
    let mut text = ron::ser::to_string_pretty(document, config).expect("plain records");
    text.push('\n');
    text
}

/// The plan as JSON, a record a line.
///
/// # Panics
/// Never: a plan holds nothing that JSON cannot write.
pub fn to_json(plan: &Plan) -> String {
    let value = serde_json::to_value(plan).expect("plain records");
    let mut text = String::from("{\n");
    let fields = value.as_object().into_iter().flatten();
    let count = value.as_object().map_or(0, serde_json::Map::len);
    for (i, (key, field)) in fields.enumerate() {
        let comma = if i + 1 < count { "," } else { "" };
        match field.as_array().filter(|records| !records.is_empty()) {
            Some(records) => {
                let lines: Vec<String> = records.iter().map(|r| format!("    {r}")).collect();
                let lines = lines.join(",\n");
                text.extend(["  \"", key, "\": [\n", &lines, "\n  ]", comma, "\n"]);
            }
            None => text.extend(["  \"", key, "\": ", &field.to_string(), comma, "\n"]),
        }
    }
    text.push_str("}\n");
    text
}

/// Reads a plan that [`to_ron`] wrote.
///
/// # Errors
/// Where the text is no plan, or one of another format.
pub fn from_ron(text: &str) -> Result<Plan, ReadError> {
    let format = text.lines().find_map(|line| {
        line.trim()
            .strip_prefix("format:")?
            .trim()
            .trim_end_matches(',')
            .parse::<u32>()
            .ok()
    });
    match format {
        Some(other) if other != FORMAT => Err(ReadError::UnknownFormat(other)),
        _ => ron::from_str(text).map_err(|error| ReadError::Malformed {
            message: error.code.to_string(),
            at: (error.span.start.line, error.span.start.col),
        }),
    }
}

/// The JSON schema of the plan, draft-07.
///
/// # Panics
/// Never: a schema is JSON.
pub fn schema() -> String {
    let settings = schemars::generate::SchemaSettings::draft07();
    let schema = settings.into_generator().into_root_schema_for::<Plan>();
    let mut text = serde_json::to_string_pretty(&schema).expect("a schema is JSON");
    text.push('\n');
    text
}
