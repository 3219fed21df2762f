//! Tables of the fields of a JSON schema.

use serde_json::Value;
use std::fmt::Write;

/// A schema with its named definitions.
pub(crate) struct Schema(Value);

/// Fields of an object, in the order of the schema.
pub(crate) struct Field<'s> {
    pub(crate) name: &'s str,
    schema: &'s Value,
    required: bool,
}

impl Schema {
    pub(crate) fn new(text: &str) -> Self {
        Self(serde_json::from_str(text).expect("a schema is JSON"))
    }

    pub(crate) fn root(&self) -> &Value {
        &self.0
    }

    /// Names of the definitions.
    pub(crate) fn definitions(&self) -> Vec<&str> {
        let definitions = self.0["definitions"].as_object();
        definitions.map_or_else(Vec::new, |map| map.keys().map(String::as_str).collect())
    }

    pub(crate) fn definition(&self, name: &str) -> &Value {
        &self.0["definitions"][name]
    }

    /// `| key | takes | default | meaning |` for the fields of an object.
    pub(crate) fn settings(&self, object: &Value) -> String {
        let mut text = String::from("| key | takes | default | |\n|---|---|---|---|\n");
        for field in fields(object) {
            let (meaning, default) = meaning(field.schema);
            let default = match default {
                Some(default) => default,
                None if field.required => "*must be given*".to_owned(),
                None => String::new(),
            };
            let _ = writeln!(
                text,
                "| `{}` | {} | {default} | {meaning}{} |",
                field.name,
                self.takes(field.schema),
                words(field.schema)
            );
        }
        text
    }

    /// `| field | holds | meaning |` for the fields of a record.
    pub(crate) fn record(&self, object: &Value) -> String {
        let mut text = String::from("| field | holds | |\n|---|---|---|\n");
        for field in fields(object) {
            let (meaning, _) = meaning(field.schema);
            let _ = writeln!(
                text,
                "| `{}` | {} | {meaning} |",
                field.name,
                self.takes(field.schema)
            );
        }
        text
    }

    /// What kind of value a schema describes, with its range.
    fn takes(&self, schema: &Value) -> String {
        if let Some(name) = reference(schema) {
            return self.named(name);
        }
        if schema["type"] == "integer" && schema["enum"].is_array() {
            return words_of(schema).join(" or ");
        }
        if schema["enum"].is_array() || schema["oneOf"].is_array() || schema["const"].is_string() {
            return "one of the words".to_owned();
        }
        if let Some(forms) = schema["anyOf"].as_array() {
            return self.forms(forms);
        }
        let kind = match &schema["type"] {
            Value::String(kind) => kind.as_str(),
            Value::Array(kinds) => {
                let some = kinds.iter().filter_map(Value::as_str);
                return match some.clone().find(|kind| *kind != "null") {
                    Some(kind) => format!("{}, or none", self.kind(kind, schema)),
                    None => "none".to_owned(),
                };
            }
            _ => return String::new(),
        };
        self.kind(kind, schema)
    }

    fn named(&self, name: &str) -> String {
        let definition = self.definition(name);
        if definition["enum"].is_array()
            || definition["oneOf"].is_array() && !has_fields(definition)
        {
            return words_of(definition).join(" or ");
        }
        let shown = name
            .trim_end_matches("Section")
            .trim_end_matches("File")
            .to_lowercase();
        if name.ends_with("File") || name.ends_with("Section") {
            format!("table ([{shown}](#{shown}))")
        } else {
            format!("[{name}](#{})", name.to_lowercase())
        }
    }

    fn forms(&self, forms: &[Value]) -> String {
        if let [number, text] = forms
            && let Some(pattern) = text["pattern"].as_str()
        {
            return format!("{}{}", dimension(pattern), range(number));
        }
        let mut kinds: Vec<String> = forms
            .iter()
            .map(|form| match (form["const"].as_str(), &form["type"]) {
                (Some(word), _) => format!("`\"{word}\"`"),
                (None, Value::String(null)) if null == "null" => "none".to_owned(),
                _ if form["enum"].is_array() => words_of(form).join(", "),
                _ => self.takes(form),
            })
            .collect();
        kinds.dedup();
        kinds.join(" or ")
    }

    fn kind(&self, kind: &str, schema: &Value) -> String {
        match kind {
            "number" => format!("number{}", range(schema)),
            "integer" => format!("whole number{}", range(schema)),
            "boolean" => "`true` or `false`".to_owned(),
            "string" => "text".to_owned(),
            "array" if schema["items"].is_array() => {
                format!("{} numbers", schema["items"].as_array().map_or(0, Vec::len))
            }
            "array" => {
                let bound = |key: &str| schema[key].as_u64();
                let items = self.takes(&schema["items"]);
                match (bound("minItems"), bound("maxItems")) {
                    (Some(low), Some(high)) if low == high => several(low, &items),
                    (Some(0), Some(high)) => format!("at most {high} of {items}"),
                    (Some(low), Some(high)) => format!("{low} to {high} of {items}"),
                    _ => format!("list of {items}"),
                }
            }
            "object" if schema["additionalProperties"].is_object() => format!(
                "table of names to {}",
                self.takes(&schema["additionalProperties"])
            ),
            "object" => {
                let names: Vec<String> = fields(schema)
                    .iter()
                    .map(|field| format!("`{}`", field.name))
                    .collect();
                format!("table of {}", names.join(", "))
            }
            other => other.to_owned(),
        }
    }
}

/// The definition that a value is of, where it is one's.
fn reference(schema: &Value) -> Option<&str> {
    let direct = schema["$ref"].as_str();
    let wrapped = || schema["allOf"][0]["$ref"].as_str();
    direct
        .or_else(wrapped)
        .and_then(|path| path.strip_prefix("#/definitions/"))
}

/// Fields of an object.
pub(crate) fn fields(object: &Value) -> Vec<Field<'_>> {
    let required: Vec<&str> = object["required"].as_array().map_or_else(Vec::new, |list| {
        list.iter().filter_map(Value::as_str).collect()
    });
    object["properties"]
        .as_object()
        .map_or_else(Vec::new, |map| {
            map.iter()
                .map(|(name, schema)| Field {
                    name,
                    schema,
                    required: required.contains(&name.as_str()),
                })
                .collect()
        })
}

/// A fixed number of things.
fn several(count: u64, items: &str) -> String {
    if items.starts_with(|c: char| c.is_ascii_digit()) {
        return format!("{count} x {items}");
    }
    for word in ["whole number", "number", "text", "length"] {
        if let Some(range) = items.strip_prefix(word) {
            return format!("{count} {word}s{range}");
        }
    }
    format!("{count} of {items}")
}

fn has_fields(definition: &Value) -> bool {
    definition["oneOf"]
        .as_array()
        .is_some_and(|forms| forms.iter().any(|form| form["properties"].is_object()))
}

/// What a unit pattern measures.
fn dimension(pattern: &str) -> &'static str {
    let kinds = [
        ("deg", "angle, degrees"),
        ("kg/m", "density, kg/m³"),
        ("m/s2", "acceleration, m/s²"),
        ("Pa", "stress, Pa"),
        ("mm", "length"),
    ];
    kinds
        .iter()
        .find(|(sign, _)| pattern.contains(sign))
        .map(|(_, kind)| *kind)
        .expect("a quantity of a known dimension")
}

/// Bounds that say something to a person.
fn range(schema: &Value) -> String {
    let bound = |key: &str| schema[key].as_f64();
    let low = bound("minimum")
        .map(|b| (b, "≥"))
        .or_else(|| bound("exclusiveMinimum").map(|b| (b, ">")));
    let high = bound("maximum")
        .filter(|b| *b < 1e5)
        .map(|b| (b, "≤"))
        .or_else(|| bound("exclusiveMaximum").map(|b| (b, "<")));
    let low = low.filter(|(b, _)| *b > -1e5);
    let parts: Vec<String> = [low, high]
        .into_iter()
        .flatten()
        .map(|(bound, sign)| {
            if bound > 0.0 && bound < 1e-3 {
                format!("{sign} {bound:e}")
            } else {
                format!("{sign} {bound}")
            }
        })
        .collect();
    if parts.is_empty() {
        String::new()
    } else {
        format!(" {}", parts.join(", "))
    }
}

/// A description without what it says about the default, and that.
fn meaning(schema: &Value) -> (String, Option<String>) {
    let text = schema["description"].as_str().unwrap_or("");
    let (mut kept, mut default) = (Vec::new(), None);
    for sentence in sentences(text) {
        match sentence.strip_prefix("Default") {
            Some(rest) => {
                let rest = rest.trim_start_matches(':').trim().trim_end_matches('.');
                default = Some(rest.to_owned());
            }
            None => kept.push(sentence),
        }
    }
    let escape = |text: String| text.replace('|', "\\|").replace('\n', " ");
    (escape(kept.join(" ")), default.map(escape))
}

fn sentences(text: &str) -> Vec<&str> {
    let mut found = Vec::new();
    let mut rest = text;
    while let Some(end) = rest.find(". ") {
        found.push(rest[..=end].trim());
        rest = &rest[end + 2..];
    }
    if !rest.trim().is_empty() {
        found.push(rest.trim());
    }
    found
}

/// Words with their meanings.
fn words(schema: &Value) -> String {
    let Some(forms) = schema["oneOf"].as_array() else {
        return match schema["enum"].as_array() {
            Some(words) if words.iter().all(Value::is_string) => {
                format!(" Words: {}.", words_of(schema).join(", "))
            }
            _ => String::new(),
        };
    };
    let mut text = String::new();
    for form in forms {
        let word = form["const"].as_str().unwrap_or("");
        let about = form["description"].as_str().unwrap_or("");
        let about = about.trim_end_matches('.');
        let _ = write!(text, "<br>`\"{word}\"`: {}", about.replace('|', "\\|"));
    }
    text
}

fn words_of(schema: &Value) -> Vec<String> {
    let listed = schema["enum"].as_array().into_iter().flatten();
    let described = schema["oneOf"].as_array().into_iter().flatten();
    listed
        .chain(described.map(|form| &form["const"]))
        .map(|word| match word {
            Value::String(word) => format!("`\"{word}\"`"),
            other => format!("`{other}`"),
        })
        .collect()
}
