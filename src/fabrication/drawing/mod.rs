//! The neutral drawing from which both writers ([`super::dxf`], [`super::svg`]) draw, so that the
//! two files of a drawing cannot disagree.
//!
//! Frame: millimetres at full size, x right, y up, origin at the lower left of the frame; nothing
//! lies outside `[0, size]`. Entities stand in drawing order, which machines that cut in the
//! order of the file follow. What a layer looks like is the palette's matter; what it means is
//! its name.

mod layer;
mod path;
mod text;
mod tile;

pub use layer::{Layer, Palette, Style};
pub use path::{Arc, Closure, Path, QUARTER, Segment, Vertex};
pub use text::{Anchor, Text, upright};
pub use tile::Tile;

/// A drawing at full size.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawing {
    /// What it shows: one line, for the metadata of the file.
    pub title: String,
    /// Width and height of the frame, millimetres.
    pub size: [f64; 2],
    /// How layers look.
    pub palette: Palette,
    /// Stroke of a pen of width 1, millimetres: [`Style::pen`] times this is drawn.
    pub pen: f64,
    /// In drawing order.
    pub entities: Vec<Entity>,
}

/// A shape on a layer.
#[derive(Debug, Clone, PartialEq)]
pub struct Entity {
    /// Where it belongs.
    pub layer: Layer,
    /// Id of the part or thing that it belongs to; empty for what belongs to the sheet.
    pub subject: String,
    /// What is drawn.
    pub shape: Shape,
}

/// A shape has a coordinate that is infinite or no number.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NotFinite {
    /// Its layer.
    pub layer: Layer,
    /// What it belongs to.
    pub subject: String,
}

/// What can be drawn.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// Straight segments and arcs.
    Path(Path),
    /// A full circle.
    Circle {
        /// Millimetres.
        centre: [f64; 2],
        /// Millimetres.
        radius: f64,
    },
    /// A line of single strokes.
    Text(Text),
}

/// An axis-parallel box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// Smallest coordinates.
    pub min: [f64; 2],
    /// Largest coordinates.
    pub max: [f64; 2],
}

impl Drawing {
    /// An empty drawing with a pen of one millimetre.
    pub fn new(title: impl Into<String>, size: [f64; 2], palette: Palette) -> Self {
        Self {
            title: title.into(),
            size,
            palette,
            pen: 1.0,
            entities: Vec::new(),
        }
    }

    /// Adds a shape of a subject (empty: of the sheet itself).
    pub fn draw(&mut self, layer: Layer, subject: &str, shape: impl Into<Shape>) {
        self.entities.push(Entity {
            layer,
            subject: subject.to_owned(),
            shape: shape.into(),
        });
    }

    /// Smallest box around everything.
    pub fn bounds(&self) -> Bounds {
        let mut bounds = Bounds::EMPTY;
        for entity in &self.entities {
            bounds.join(&entity.shape.bounds());
        }
        bounds
    }

    /// Layers in use, in painting order.
    pub fn layers(&self) -> Vec<Layer> {
        let mut layers: Vec<Layer> = self.entities.iter().map(|e| e.layer).collect();
        layers.sort_unstable();
        layers.dedup();
        layers
    }

    /// Refuses numbers that are none: writers would print them and readers choke.
    pub fn check(&self) -> Result<(), NotFinite> {
        let broken = |entity: &&Entity| !entity.shape.is_finite();
        match self.entities.iter().find(broken) {
            Some(entity) => Err(NotFinite {
                layer: entity.layer,
                subject: entity.subject.clone(),
            }),
            None => Ok(()),
        }
    }

    /// First twelve hexadecimal digits of [`Drawing::digest`], to tell on the bench whether a
    /// sheet is of the plan in hand.
    pub fn content_hash(&self) -> String {
        let mut hex = self.digest().to_hex().to_string();
        hex.truncate(12);
        hex
    }

    /// Hash over every number and word of the drawing.
    pub fn digest(&self) -> blake3::Hash {
        let mut digest = Digest::default();
        digest.word(&self.title);
        digest.numbers(&[self.size[0], self.size[1], self.pen]);
        for Entity {
            layer,
            subject,
            shape,
        } in &self.entities
        {
            digest.word(layer.name());
            digest.word(subject);
            match shape {
                Shape::Path(path) => {
                    digest.word(match path.closed {
                        Closure::Closed => "closed",
                        Closure::Open => "open",
                    });
                    for v in &path.vertices {
                        digest.numbers(&[v.x, v.y, v.bulge]);
                    }
                }
                Shape::Circle { centre, radius } => {
                    digest.word("circle");
                    digest.numbers(&[centre[0], centre[1], *radius]);
                }
                Shape::Text(text) => {
                    digest.word(&text.content);
                    digest.numbers(&[text.at[0], text.at[1], text.height, text.angle]);
                }
            }
        }
        digest.0.finalize()
    }
}

/// Feeds a hash unambiguously.
#[derive(Default)]
struct Digest(blake3::Hasher);

impl Digest {
    fn word(&mut self, text: &str) {
        self.0.update(&(text.len() as u64).to_le_bytes());
        self.0.update(text.as_bytes());
    }

    fn numbers(&mut self, values: &[f64]) {
        for value in values {
            self.0.update(&value.to_bits().to_le_bytes());
        }
    }
}

impl Shape {
    fn is_finite(&self) -> bool {
        let finite = |values: &[f64]| values.iter().all(|v| v.is_finite());
        match self {
            Self::Path(path) => path.vertices.iter().all(|v| finite(&[v.x, v.y, v.bulge])),
            Self::Circle { centre, radius } => finite(&[centre[0], centre[1], *radius]),
            Self::Text(text) => finite(&[text.at[0], text.at[1], text.height, text.angle]),
        }
    }

    /// Smallest box around it.
    pub fn bounds(&self) -> Bounds {
        match self {
            Self::Path(path) => path.bounds(),
            Self::Circle {
                centre: [x, y],
                radius,
            } => Bounds {
                min: [x - radius, y - radius],
                max: [x + radius, y + radius],
            },
            Self::Text(text) => text.bounds(),
        }
    }

    /// Moved by (`dx`, `dy`).
    #[must_use]
    pub fn translated(&self, [dx, dy]: [f64; 2]) -> Self {
        match self {
            Self::Path(path) => Self::Path(path.translated([dx, dy])),
            Self::Circle {
                centre: [x, y],
                radius,
            } => Self::Circle {
                centre: [x + dx, y + dy],
                radius: *radius,
            },
            Self::Text(text) => Self::Text(Text {
                at: [text.at[0] + dx, text.at[1] + dy],
                ..text.clone()
            }),
        }
    }
}

impl From<Path> for Shape {
    fn from(path: Path) -> Self {
        Self::Path(path)
    }
}

impl From<Text> for Shape {
    fn from(text: Text) -> Self {
        Self::Text(text)
    }
}

impl Bounds {
    /// A box around nothing.
    pub const EMPTY: Self = Self {
        min: [f64::INFINITY; 2],
        max: [f64::NEG_INFINITY; 2],
    };

    /// Grows to hold a point.
    pub fn add(&mut self, point: [f64; 2]) {
        for (axis, value) in point.into_iter().enumerate() {
            self.min[axis] = self.min[axis].min(value);
            self.max[axis] = self.max[axis].max(value);
        }
    }

    /// Grows to hold another box.
    pub fn join(&mut self, other: &Self) {
        if !other.is_empty() {
            self.add(other.min);
            self.add(other.max);
        }
    }

    /// Whether it holds no point.
    pub fn is_empty(&self) -> bool {
        self.min[0] > self.max[0]
    }

    /// Width and height.
    pub fn size(&self) -> [f64; 2] {
        [self.max[0] - self.min[0], self.max[1] - self.min[1]]
    }

    /// Whether two boxes share a point.
    pub fn overlaps(&self, other: &Self) -> bool {
        (0..2).all(|a| self.min[a] <= other.max[a] && other.min[a] <= self.max[a])
    }
}
