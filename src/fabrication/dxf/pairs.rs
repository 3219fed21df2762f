//! Code pairs, the two-line records of which a DXF file consists.

/// A code and its value as text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Pair {
    pub(super) code: i32,
    pub(super) value: String,
}

impl Pair {
    pub(super) fn new(code: i32, value: impl Into<String>) -> Self {
        Self {
            code,
            value: value.into(),
        }
    }

    /// Whether it opens something: `0 SECTION`, `0 CIRCLE`.
    pub(super) fn is(&self, code: i32, value: &str) -> bool {
        self.code == code && self.value == value
    }
}

/// Splits text into pairs; a last line without partner is dropped.
pub(super) fn read(text: &str) -> Vec<Pair> {
    let mut lines = text.lines();
    let mut pairs = Vec::new();
    while let (Some(code), Some(value)) = (lines.next(), lines.next()) {
        if let Ok(code) = code.trim().parse() {
            pairs.push(Pair::new(code, value));
        }
    }
    pairs
}

/// Pairs as text with the line ends that the format asks for.
pub(super) fn write(pairs: &[Pair]) -> Vec<u8> {
    let lines = pairs
        .iter()
        .flat_map(|Pair { code, value }| [format!("{code:>3}\r\n"), format!("{value}\r\n")]);
    lines.collect::<String>().into_bytes()
}

/// Splits pairs before each one with code 0: the records of a section or table.
pub(super) fn records(pairs: &[Pair]) -> Vec<&[Pair]> {
    let starts: Vec<usize> = (0..pairs.len()).filter(|&i| pairs[i].code == 0).collect();
    let ends = starts.iter().skip(1).copied().chain([pairs.len()]);
    starts
        .iter()
        .zip(ends)
        .map(|(&start, end)| &pairs[start..end])
        .collect()
}

/// What stands in a section, its own marks left out.
pub(super) fn section<'a>(pairs: &'a [Pair], name: &str) -> &'a [Pair] {
    let Some(start) = pairs
        .windows(2)
        .position(|w| w[0].is(0, "SECTION") && w[1].is(2, name))
    else {
        return &[];
    };
    let body = &pairs[start + 2..];
    let end = body.iter().position(|p| p.is(0, "ENDSEC"));
    &body[..end.unwrap_or(body.len())]
}
