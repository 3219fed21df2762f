//! The PDF writer: drawings for people as pages that an office printer takes.
//!
//! Each drawing is scaled into an A3 page in the direction that fits it; what has to keep its
//! size is cut from DXF and SVG, not from paper. Lines and letters are drawn as they are in the
//! SVG, so nothing depends on fonts. Files carry no dates: equal drawings give equal bytes.

use super::drawing::{Closure, Drawing, Entity, NotFinite, Path, Segment, Shape};
use pdf_writer::{Content, Finish, Pdf, Rect, Ref, TextStr};

/// Points in a millimetre.
const POINTS: f64 = 72.0 / 25.4;
/// A3, millimetres.
const PAPER: [f64; 2] = [420.0, 297.0];
/// Border that printers leave, millimetres.
const BORDER: f64 = 8.0;
/// Longest arc that one cubic draws to a ten-thousandth of its radius: a quarter of a turn.
const LONGEST_ARC: f64 = core::f64::consts::FRAC_PI_2;

/// Writes drawings as pages. The only way to fail is a number that is none.
pub fn write(title: &str, drawings: &[Drawing]) -> Result<Vec<u8>, NotFinite> {
    let mut pdf = Pdf::new();
    let mut next = Ref::new(1);
    let [catalog, tree, info] = [next.bump(), next.bump(), next.bump()];
    pdf.catalog(catalog).pages(tree);
    pdf.document_info(info).title(TextStr(title));
    let mut kids = Vec::new();
    for drawing in drawings {
        drawing.check()?;
        let [page_id, content_id] = [next.bump(), next.bump()];
        kids.push(page_id);
        let [width, height] = drawing.size;
        let paper = if width >= height {
            PAPER
        } else {
            [PAPER[1], PAPER[0]]
        };
        let mut page = pdf.page(page_id);
        let [right, top] = paper.map(|side| (side * POINTS) as f32);
        page.media_box(Rect::new(0.0, 0.0, right, top));
        page.parent(tree);
        page.contents(content_id);
        page.resources();
        page.finish();
        let content = draw(drawing, paper);
        pdf.stream(content_id, &content);
    }
    let count = i32::try_from(kids.len()).unwrap_or(i32::MAX);
    pdf.pages(tree).kids(kids).count(count);
    Ok(pdf.finish())
}

/// The page's content: layers in painting order, as in the SVG.
fn draw(drawing: &Drawing, paper: [f64; 2]) -> Vec<u8> {
    let [width, height] = drawing.size.map(|side| side.max(1.0));
    let room = paper.map(|side| side - 2.0 * BORDER);
    let scale = (room[0] / width).min(room[1] / height);
    let shift = [
        0.5 * (paper[0] - scale * width),
        0.5 * (paper[1] - scale * height),
    ];
    let mut page = Page {
        content: Content::new(),
        scale: scale * POINTS,
        shift: shift.map(|s| s * POINTS),
    };
    page.content
        .set_line_cap(pdf_writer::types::LineCapStyle::RoundCap);
    page.content
        .set_line_join(pdf_writer::types::LineJoinStyle::RoundJoin);
    for layer in drawing.layers() {
        let style = drawing.palette.style(layer);
        let [r, g, b] = style.rgb.map(|c| f32::from(c) / 255.0);
        page.content.set_stroke_rgb(r, g, b);
        if let Some([r, g, b]) = style.fill.map(|rgb| rgb.map(|c| f32::from(c) / 255.0)) {
            page.content.set_fill_rgb(r, g, b);
        }
        let filled = style.fill.is_some();
        for entity in drawing.entities.iter().filter(|e| e.layer == layer) {
            let letters = match (&entity.shape, style.letters) {
                (Shape::Text(text), Some(share)) => Some(share * text.height),
                _ => None,
            };
            page.pen(letters.unwrap_or(style.pen * drawing.pen));
            page.entity(entity, filled);
        }
    }
    page.content.finish().to_vec()
}

/// A page in the making.
struct Page {
    content: Content,
    /// Points per millimetre of the drawing.
    scale: f64,
    shift: [f64; 2],
}

impl Page {
    fn pen(&mut self, millimetres: f64) {
        self.content
            .set_line_width((millimetres * self.scale) as f32);
    }

    fn point(&self, [x, y]: [f64; 2]) -> [f32; 2] {
        [
            (x * self.scale + self.shift[0]) as f32,
            (y * self.scale + self.shift[1]) as f32,
        ]
    }

    fn entity(&mut self, entity: &Entity, filled: bool) {
        match &entity.shape {
            Shape::Path(path) => self.path(path, filled),
            Shape::Circle { centre, radius } => {
                let [x, y] = *centre;
                self.path(&Path::slot(x, x, y, *radius), filled);
            }
            Shape::Text(text) => {
                for stroke in text.strokes() {
                    self.path(&stroke, false);
                }
            }
        }
    }

    fn path(&mut self, path: &Path, filled: bool) {
        let mut segments = path.segments().peekable();
        let Some(first) = segments.peek() else {
            return;
        };
        let [x, y] = self.point(first.from);
        self.content.move_to(x, y);
        for segment in segments {
            self.segment(&segment);
        }
        match path.closed {
            Closure::Closed if filled => self.content.close_fill_nonzero_and_stroke(),
            Closure::Closed => self.content.close_and_stroke(),
            Closure::Open => self.content.stroke(),
        };
    }

    fn segment(&mut self, segment: &Segment) {
        let Some(arc) = segment.arc() else {
            let [x, y] = self.point(segment.to);
            self.content.line_to(x, y);
            return;
        };
        let pieces = libm::ceil(arc.sweep.abs() / LONGEST_ARC - 1e-9).max(1.0);
        let step = arc.sweep / pieces;
        // Control points lie on the tangents of the ends, so far away that the cubic touches the
        // circle in its middle.
        let reach = 4.0 / 3.0 * libm::tan(0.25 * step) * arc.radius;
        for i in 0..pieces as u32 {
            let [a, b] = [f64::from(i), f64::from(i + 1)].map(|k| arc.start + k * step);
            let tangent = |angle: f64| {
                let (sin, cos) = libm::sincos(angle);
                [-sin * reach, cos * reach]
            };
            let ([ax, ay], [bx, by]) = (arc.at(a), arc.at(b));
            let ([au, av], [bu, bv]) = (tangent(a), tangent(b));
            let [x1, y1] = self.point([ax + au, ay + av]);
            let [x2, y2] = self.point([bx - bu, by - bv]);
            let [x3, y3] = self.point([bx, by]);
            self.content.cubic_to(x1, y1, x2, y2, x3, y3);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fabrication::drawing::{Layer, Palette, Text};

    #[test]
    fn pages_are_pdf_and_the_same_every_time() {
        let mut drawing = Drawing::new("overview", [2500.0, 1250.0], Palette::People);
        drawing.draw(
            Layer::Sheet,
            "",
            Path::rectangle([0.0; 2], [2500.0, 1250.0]),
        );
        drawing.draw(
            Layer::LamellaU,
            "w.u01",
            Path::slot(30.0, 900.0, 40.0, 15.0),
        );
        drawing.draw(
            Layer::Label,
            "w.u01",
            Text::new("w.u01", [100.0, 30.0], 20.0),
        );
        let bytes = write("overview", &[drawing.clone(), drawing.clone()]).expect("finite");
        assert!(bytes.starts_with(b"%PDF-") && bytes.ends_with(b"%%EOF"));
        assert_eq!(
            write("overview", &[drawing.clone(), drawing.clone()]),
            Ok(bytes)
        );
        drawing.draw(Layer::Label, "x", Text::new("x", [f64::NAN, 30.0], 20.0));
        assert!(write("overview", &[drawing]).is_err());
    }
}
