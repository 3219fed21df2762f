//! Lines of an OBJ file that are passed over with a warning.

use super::findings::Findings;
use super::lines::{Line, Span, Word};
use crate::diagnostics::{Diagnostic, File, codes::surface as codes};

/// Lines that are passed over with a warning, by reason.
#[derive(Debug, Default)]
pub(super) struct Ignored {
    /// No OBJ records.
    pub(super) unknown: Tally,
    /// Free-form curves and surfaces.
    pub(super) free_form: Tally,
    /// Weights of vertices other than 1.
    pub(super) weights: Tally,
    /// More columns of a vertex than there are meanings.
    pub(super) columns: Tally,
}

/// How many, and the first with its keyword.
#[derive(Debug, Default)]
pub(super) struct Tally {
    count: usize,
    first: Option<(Span, String)>,
}

impl Tally {
    pub(super) fn count(&mut self, line: Line<'_>) {
        self.count += 1;
        if self.first.is_none() {
            let keyword = line.words().next().map_or(String::new(), Word::shown);
            self.first = Some((line.span(), keyword));
        }
    }

    fn tell(&self, findings: &mut Findings, what: &str, label: impl Fn(&str) -> String) {
        let Some((span, keyword)) = &self.first else {
            return;
        };
        findings.add(&codes::IGNORED_LINES, || {
            let message = format!("{what} are ignored ({})", at_lines(self.count, *span));
            Diagnostic::warning(codes::IGNORED_LINES, message).at_bytes(
                File::Mesh,
                span.bytes(),
                label(keyword),
            )
        });
    }
}

/// `line 7`, or `3 lines, first: line 7`.
pub(super) fn at_lines(count: usize, first: Span) -> String {
    match count {
        1 => format!("line {}", first.line),
        _ => format!("{count} lines, first: line {}", first.line),
    }
}

impl Ignored {
    pub(super) fn tell(&self, findings: &mut Findings) {
        self.unknown.tell(findings, "unknown records", |keyword| {
            format!("`{keyword}` is no OBJ record")
        });
        self.free_form
            .tell(findings, "free-form curves and surfaces", |_| {
                "only polygons are read".into()
            });
        self.weights.tell(findings, "weights of vertices", |_| {
            "the weight is not applied".into()
        });
        self.columns
            .tell(findings, "surplus columns of vertices", |_| {
                "only x, y and z are read".into()
            });
    }
}

/// Why there is no surface in a file without faces.
pub(super) fn no_faces(vertices: u32, ignored: &Ignored) -> Diagnostic {
    let message = format!("the mesh has {vertices} vertices and no faces");
    let mut diagnostic = Diagnostic::error(codes::NO_FACES, message);
    if let Some((span, _)) = &ignored.free_form.first {
        return diagnostic
            .at_bytes(File::Mesh, span.bytes(), "free-form geometry is no mesh")
            .help("mesh the surface in the modelling program, then export it");
    }
    diagnostic = match &ignored.unknown.first {
        Some((span, keyword)) => diagnostic.at_bytes(
            File::Mesh,
            span.bytes(),
            format!("`{keyword}` is no OBJ record"),
        ),
        None if vertices == 0 => Diagnostic::error(
            codes::EMPTY,
            "the mesh file has no vertices and no faces, only comments and names",
        )
        .at_bytes(File::Mesh, 0..1, "nothing from here on"),
        None => diagnostic.at_bytes(File::Mesh, 0..1, "no `f` record from here on"),
    };
    diagnostic.help("export the surface as a mesh in Wavefront OBJ format")
}
