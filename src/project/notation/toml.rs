//! TOML into the tree, by the `toml` crate's recovering parser: it reports every syntax error
//! of the file, not only the first, and keeps the bytes of keys and values.

use super::{DEEPEST, Entry, Node, Number, SyntaxError, SyntaxKind, Value};
use ::toml::Spanned;
use ::toml::de::{DeArray, DeInteger, DeTable, DeValue, Error};
use std::ops::Range;

pub(super) fn parse(text: &str) -> (Node, Vec<SyntaxError>) {
    let (table, errors) = DeTable::parse_recoverable(text);
    let mut errors = syntax_errors(&errors, text);
    let root = Node {
        span: 0..text.len(),
        value: Value::Table(entries(table.get_ref(), 1, &mut errors)),
    };
    dismantle(table.into_inner());
    (root, errors)
}

fn node(value: &Spanned<DeValue<'_>>, depth: usize, errors: &mut Vec<SyntaxError>) -> Node {
    let span = value.span();
    let too_deep = SyntaxError {
        span: span.clone(),
        kind: SyntaxKind::TooDeep,
    };
    let value = match value.get_ref() {
        DeValue::String(text) => Value::Text(text.to_string()),
        DeValue::Integer(integer) => integer_value(integer),
        DeValue::Float(float) => Value::Number(Number {
            text: float.as_str().to_owned(),
            whole: false,
        }),
        DeValue::Boolean(bool) => Value::Bool(*bool),
        DeValue::Datetime(_) => Value::Other("a date or time"),
        DeValue::Array(_) | DeValue::Table(_) if depth >= DEEPEST => {
            errors.push(too_deep);
            Value::Other("a value nested too deep")
        }
        DeValue::Array(array) => Value::List(items(array, depth + 1, errors)),
        DeValue::Table(table) => Value::Table(entries(table, depth + 1, errors)),
    };
    Node { span, value }
}

fn items(array: &DeArray<'_>, depth: usize, errors: &mut Vec<SyntaxError>) -> Vec<Node> {
    array.iter().map(|item| node(item, depth, errors)).collect()
}

fn entries(table: &DeTable<'_>, depth: usize, errors: &mut Vec<SyntaxError>) -> Vec<Entry> {
    let mut entries: Vec<_> = table
        .iter()
        .map(|(key, value)| Entry {
            key: key.get_ref().to_string(),
            key_span: key.span(),
            node: node(value, depth, errors),
        })
        .collect();
    // The parser sorts by name; names keep the order of the file.
    entries.sort_by_key(|entry| entry.key_span.start);
    entries
}

fn integer_value(integer: &DeInteger<'_>) -> Value {
    let text = match integer.radix() {
        10 => integer.as_str().to_owned(),
        radix => match u128::from_str_radix(integer.as_str(), radix) {
            Ok(value) => value.to_string(),
            Err(_) => return Value::Other("a whole number of more than 128 bits"),
        },
    };
    Value::Number(Number { text, whole: true })
}

/// The parser's errors without consequences: of each line the first, and of an unclosed bracket
/// nothing below, where every line is taken for an element of the list.
fn syntax_errors(errors: &[Error], text: &str) -> Vec<SyntaxError> {
    let mut errors: Vec<(Range<usize>, &str)> = errors
        .iter()
        .map(|error| {
            let span = error.span().unwrap_or(text.len()..text.len());
            (span, error.message())
        })
        .collect();
    errors.sort_by_key(|(span, message)| (span.start, message.len()));
    let is_open = errors
        .iter()
        .any(|(_, message)| message.starts_with("unclosed "));
    let mut reported = Vec::new();
    let mut line_end = 0;
    for (span, message) in errors {
        let before = text.get(..span.start).unwrap_or(text);
        let starts_line = before.trim_end_matches([' ', '\t']).ends_with('\n');
        if is_open && starts_line && message.starts_with("missing comma") {
            let close = if message.contains("array") { "]" } else { "}" };
            let end = before.trim_end().len();
            reported.push(SyntaxError::syntax(
                end..end,
                format!("TOML syntax: `{close}` is missing"),
                format!("expected `{close}` before the next line begins"),
            ));
            break;
        }
        if reported.is_empty() || span.start > line_end {
            let rest = text.get(span.start..).unwrap_or_default();
            line_end = span.start + rest.find('\n').unwrap_or(rest.len());
            reported.push(syntax_error(span, message, text));
        }
    }
    reported
}

fn syntax_error(span: Range<usize>, message: &str, text: &str) -> SyntaxError {
    let kind = match message {
        "duplicate key" => SyntaxKind::DuplicateKey,
        "cannot recurse further; max recursion depth met" | "recursion limit" => {
            SyntaxKind::TooDeep
        }
        _ => {
            let (found, expected) = message.split_once(", expected ").unwrap_or((message, ""));
            let rest = text.get(span.start..).unwrap_or_default();
            let at_line_end = rest.is_empty() || rest.starts_with(['\r', '\n']);
            let marked = text.get(span.clone()).unwrap_or_default();
            let (message, label) = match found {
                "invalid basic string" | "invalid literal string" if at_line_end => (
                    "the string has no end",
                    "the closing quote is missing".to_owned(),
                ),
                "string values must be quoted" if marked.trim().is_empty() => {
                    ("the value is missing", "expected a value".to_owned())
                }
                "string values must be quoted" if marked.trim().contains(' ') => (
                    "this is not one value",
                    "expected a value and a comma, or a string in quotes".to_owned(),
                ),
                "string values must be quoted" => (found, "expected a string in quotes".to_owned()),
                _ if matches!(expected, "" | "nothing") => (found, "here".to_owned()),
                _ => (found, format!("expected {expected}")),
            };
            return SyntaxError::syntax(span, format!("TOML syntax: {message}"), label);
        }
    };
    SyntaxError { span, kind }
}

/// Takes a table apart level by level. Dotted keys in nested inline tables reach thousands of
/// levels within the parser's limits, and dropping those recursively would end the stack.
fn dismantle(table: DeTable<'_>) {
    let mut rest = vec![DeValue::Table(table)];
    while let Some(value) = rest.pop() {
        match value {
            DeValue::Table(table) => {
                rest.extend(table.into_iter().map(|(_, value)| value.into_inner()));
            }
            DeValue::Array(array) => rest.extend(array.into_iter().map(Spanned::into_inner)),
            _ => {}
        }
    }
}
