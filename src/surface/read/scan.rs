//! The first pass: looks at every line once, judges it with its place, and writes what remains, in
//! plain form, for tobj.
//!
//! tobj reports no lines and takes a number of things silently: it loses the first record behind
//! a byte order mark, refuses the whole file for one Latin-1 byte, accepts NaN, makes faces of
//! points and lines, divides by vertex weights, and mixes up colours that only some vertices have.
//! None of that is left when it reads.

use super::findings::Findings;
use super::format::too_large;
use super::ignored::{Ignored, no_faces};
use super::lines::{Line, Lines, Span, Word};
use super::{MAX_CORNERS, MAX_VERTICES};
use crate::diagnostics::{Code, Diagnostic, File, codes::surface as codes};
use std::io::Write;

/// What the first pass found.
#[derive(Debug, Default)]
pub(super) struct Scan {
    /// `v x y z` and `f a b c ...` records only, with indices counted from 1.
    pub(super) clean: Vec<u8>,
    /// Place of each `v` record.
    pub(super) vertices: Vec<Span>,
    /// Place of each `f` record.
    pub(super) faces: Vec<Span>,
    /// Corners of all `f` records, one after another: numbers of `v` records, from 0.
    pub(super) corners: Vec<u32>,
    /// End of each `f` record's corners.
    ends: Vec<u32>,
}

impl Scan {
    /// Corners of an `f` record.
    pub(super) fn corners_of(&self, face: usize) -> &[u32] {
        let start = if face == 0 { 0 } else { self.ends[face - 1] };
        &self.corners[start as usize..self.ends[face] as usize]
    }
}

/// Scans the text from byte `start` on.
pub(super) fn scan(bytes: &[u8], start: usize, findings: &mut Findings) -> Scan {
    let mut scanner = Scanner {
        scan: Scan::default(),
        beyond: Vec::new(),
        ignored: Ignored::default(),
        findings,
    };
    for line in Lines::new(bytes, start) {
        if !scanner.read(line) {
            break;
        }
    }
    scanner.finish()
}

/// A face corner that names a vertex further on in the file, to be judged at its end.
struct Beyond {
    index: u32,
    face: u32,
}

struct Scanner<'a> {
    scan: Scan,
    beyond: Vec<Beyond>,
    ignored: Ignored,
    findings: &'a mut Findings,
}

impl Scanner<'_> {
    /// Reads a line; false when a limit is exceeded and there is no point in going on.
    fn read(&mut self, line: Line<'_>) -> bool {
        let mut words = line.words();
        let Some(keyword) = words.next() else {
            return true;
        };
        match keyword.bytes {
            b"v" => {
                self.vertex(line);
                if self.scan.vertices.len() > MAX_VERTICES {
                    return self.stop(format!("the mesh has more than {MAX_VERTICES} vertices"));
                }
            }
            b"f" | b"fo" => {
                self.face(line);
                if self.scan.corners.len() > MAX_CORNERS {
                    return self.stop(format!("the faces have more than {MAX_CORNERS} corners"));
                }
            }
            // Names, attributes, points, polylines, and how to display them.
            b"vt" | b"vn" | b"vp" | b"o" | b"g" | b"s" | b"usemtl" | b"mtllib" | b"usemap"
            | b"maplib" | b"p" | b"l" | b"mg" | b"lod" | b"bevel" | b"c_interp" | b"d_interp"
            | b"shadow_obj" | b"trace_obj" => {}
            b"cstype" | b"deg" | b"bmat" | b"step" | b"curv" | b"curv2" | b"surf" | b"parm"
            | b"trim" | b"hole" | b"scrv" | b"sp" | b"end" | b"con" | b"ctech" | b"stech"
            | b"res" | b"bzp" | b"bsp" | b"cdc" | b"cdp" => self.ignored.free_form.count(line),
            _ => self.ignored.unknown.count(line),
        }
        true
    }

    fn stop(&mut self, message: String) -> bool {
        self.findings.add(&codes::TOO_LARGE, || *too_large(message));
        false
    }

    fn vertex(&mut self, line: Line<'_>) {
        let span = line.span();
        let mut columns = 0;
        for word in line.words().skip(1) {
            columns += 1;
            let number = number(word);
            match number {
                Some(_) if columns > 4 => {}
                Some(weight) if columns == 4 => {
                    // The fourth of six columns is a colour.
                    if weight != 1.0 && line.words().count() == 5 {
                        self.ignored.weights.count(line);
                    }
                }
                Some(_) => {}
                None if columns > 3 => {}
                None => {
                    let code = codes::BAD_VERTEX;
                    self.findings.add(&code, || bad_number(span, word));
                }
            }
        }
        if columns < 3 {
            self.findings.add(&codes::BAD_VERTEX, || {
                Diagnostic::error(
                    codes::BAD_VERTEX,
                    format!(
                        "a vertex has {columns} coordinates instead of 3 (line {})",
                        span.line
                    ),
                )
                .at_bytes(File::Mesh, span.bytes(), "this vertex")
                .help("write `v x y z`")
            });
        }
        // x y z, with a weight, a colour, or both.
        if !matches!(columns, 0..=4 | 6 | 7) {
            self.ignored.columns.count(line);
        }
        self.scan.vertices.push(span);
        self.scan.clean.push(b'v');
        for word in line.words().skip(1).take(3) {
            self.scan.clean.push(b' ');
            self.scan.clean.extend_from_slice(word.bytes);
        }
        self.scan.clean.push(b'\n');
    }

    fn face(&mut self, line: Line<'_>) {
        let span = line.span();
        let first = self.scan.corners.len();
        let read = self.scan.vertices.len() as u32;
        self.scan.clean.push(b'f');
        for word in line.words().skip(1) {
            match reference(word, read) {
                Ok(index) => {
                    if index >= read {
                        let face = self.scan.faces.len() as u32;
                        self.beyond.push(Beyond { index, face });
                    }
                    self.scan.corners.push(index);
                    write!(self.scan.clean, " {}", u64::from(index) + 1)
                        .expect("a vector takes all bytes");
                }
                Err(fault) => self
                    .findings
                    .add(&fault.code(), || fault.tell(word, span, read)),
            }
        }
        self.scan.clean.push(b'\n');
        let corners = self.scan.corners.len() - first;
        let words = line.words().count() - 1;
        if words < 3 {
            self.findings.add(&codes::BAD_FACE, || {
                Diagnostic::error(
                    codes::BAD_FACE,
                    format!(
                        "a face has {words} corners instead of 3 or more (line {})",
                        span.line
                    ),
                )
                .at_bytes(File::Mesh, span.bytes(), "this face")
                .help("delete the record, or write it as a line: `l`")
            });
        }
        debug_assert!(corners <= words, "one corner a word");
        self.scan.ends.push(self.scan.corners.len() as u32);
        self.scan.faces.push(span);
    }

    fn finish(self) -> Scan {
        let Self {
            scan,
            beyond,
            ignored,
            findings,
        } = self;
        let count = scan.vertices.len() as u32;
        for corner in beyond.iter().filter(|corner| corner.index >= count) {
            let span = scan.faces[corner.face as usize];
            findings.add(&codes::BAD_INDEX, || {
                let written = u64::from(corner.index) + 1;
                Diagnostic::error(
                    codes::BAD_INDEX,
                    format!(
                        "a face names vertex {written}, but the file has {count} vertices (line {})",
                        span.line
                    ),
                )
                .at_bytes(File::Mesh, span.bytes(), "this face")
                .help("export the mesh again; the file may be cut off")
            });
        }
        if scan.faces.is_empty() && !findings.failed() {
            let diagnostic = no_faces(count, &ignored);
            findings.add(&diagnostic.code.clone(), || diagnostic);
        } else {
            ignored.tell(findings);
        }
        scan
    }
}

/// A finite number.
fn number(word: Word<'_>) -> Option<f64> {
    let text = std::str::from_utf8(word.bytes).ok()?;
    text.parse().ok().filter(|x: &f64| x.is_finite())
}

fn bad_number(span: Span, word: Word<'_>) -> Diagnostic {
    let shown = word.shown();
    let diagnostic = Diagnostic::error(
        codes::BAD_VERTEX,
        format!(
            "coordinate `{shown}` is no finite number (line {})",
            span.line
        ),
    )
    .at_bytes(File::Mesh, word.range(), "not a number");
    let comma = shown.replacen(',', ".", 1);
    if shown.contains(',') && comma.parse::<f64>().is_ok() {
        diagnostic.help(format!("write a decimal point: `{comma}`"))
    } else {
        diagnostic
    }
}

enum BadReference {
    Malformed,
    Zero,
    BeforeFirst,
    TooHigh,
}

/// The `v` record that a face corner names, from 0; it may stand further on in the file.
fn reference(word: Word<'_>, read: u32) -> Result<u32, BadReference> {
    let vertex = word.bytes.split(|&b| b == b'/').next().unwrap_or_default();
    let index: i64 = std::str::from_utf8(vertex)
        .ok()
        .and_then(|text| text.parse().ok())
        .ok_or(BadReference::Malformed)?;
    match index {
        0 => Err(BadReference::Zero),
        1.. => u32::try_from(index - 1)
            .ok()
            .filter(|&index| index < u32::MAX)
            .ok_or(BadReference::TooHigh),
        _ => u32::try_from(i64::from(read).saturating_add(index))
            .map_err(|_| BadReference::BeforeFirst),
    }
}

impl BadReference {
    fn code(&self) -> Code {
        match self {
            Self::Malformed => codes::BAD_FACE,
            Self::Zero | Self::BeforeFirst | Self::TooHigh => codes::BAD_INDEX,
        }
    }

    fn tell(&self, word: Word<'_>, span: Span, read: u32) -> Diagnostic {
        let (shown, line) = (word.shown(), span.line);
        let (message, label) = match self {
            Self::Malformed => (
                format!("face corner `{shown}` is no vertex number (line {line})"),
                "not a number",
            ),
            Self::Zero => (
                format!("a face names vertex 0, but vertices are numbered from 1 (line {line})"),
                "vertex 0",
            ),
            Self::BeforeFirst => (
                format!(
                    "a face counts {shown} vertices back, but only {read} precede it (line {line})"
                ),
                "before the first vertex",
            ),
            Self::TooHigh => (
                format!("a face names vertex {shown}, beyond all vertices (line {line})"),
                "no such vertex",
            ),
        };
        Diagnostic::error(self.code(), message).at_bytes(File::Mesh, word.range(), label)
    }
}
