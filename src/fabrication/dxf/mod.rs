//! The DXF writer: a [`Drawing`] as an AC1015 (R2000) file in millimetres.
//!
//! R2000 is the oldest version with lightweight polylines, bulges and `$INSUNITS`, so every
//! program reads it. The `dxf` crate makes the entities and tables; what its files lack against
//! the format (handles and owners of tables, blocks, layouts) is completed by [`structure`].
//! Equal drawings give equal bytes: dates are fixed, identifiers come from the content.

mod pairs;
mod structure;

use super::drawing::{Closure, Drawing, Entity, Layer, NotFinite, Palette, Path, Shape};
use dxf::entities::{Circle, Entity as DxfEntity, EntityType, Line, LwPolyline};
use dxf::enums::{AcadVersion, DrawingUnits, Units};
use dxf::{Color, LwPolylineVertex, Point};

/// Writes a drawing. The only way to fail is a number that is none.
pub fn write(drawing: &Drawing) -> Result<Vec<u8>, NotFinite> {
    drawing.check()?;
    let mut file = dxf::Drawing::new();
    set_header(&mut file, drawing);
    set_tables(&mut file, drawing);
    for entity in &drawing.entities {
        for specific in entity_types(entity) {
            let mut written = DxfEntity::new(specific);
            entity.layer.name().clone_into(&mut written.common.layer);
            file.add_entity(written);
        }
    }
    let complete = structure::complete(&saved(&file), drawing);
    Ok(pairs::write(&complete))
}

/// The code pairs that the crate writes.
fn saved(file: &dxf::Drawing) -> Vec<pairs::Pair> {
    let mut bytes = Vec::new();
    file.save(&mut bytes)
        .expect("memory takes every byte, and there is no thumbnail to encode");
    pairs::read(&String::from_utf8_lossy(&bytes))
}

/// Lineweight of a layer in hundredths of a millimetre as the format codes it: hairlines for
/// machines, the reader's default for people.
fn line_weight(palette: Palette) -> i16 {
    match palette {
        Palette::Cut(_) => 0,
        Palette::People => -3,
    }
}

fn set_header(file: &mut dxf::Drawing, drawing: &Drawing) {
    let point = |[x, y]: [f64; 2]| Point::new(x, y, 0.0);
    let bounds = drawing.bounds();
    let [low, high] = if bounds.is_empty() {
        [[0.0; 2], drawing.size]
    } else {
        [bounds.min, bounds.max]
    };
    let header = &mut file.header;
    header.version = AcadVersion::R2000;
    header.drawing_units = DrawingUnits::Metric;
    header.default_drawing_units = Units::Millimeters;
    header.minimum_drawing_extents = point(low);
    header.maximum_drawing_extents = point(high);
    header.minimum_drawing_limits = point([0.0; 2]);
    header.maximum_drawing_limits = point(drawing.size);
    header.paperspace_minimum_drawing_limits = point([0.0; 2]);
    header.paperspace_maximum_drawing_limits = point(drawing.size);
    // Zero, the crate's default, makes printers collapse the drawing into a point.
    header.viewport_view_scale_factor = 1.0;
}

fn set_tables(file: &mut dxf::Drawing, drawing: &Drawing) {
    for layer in drawing.layers() {
        file.add_layer(dxf::tables::Layer {
            name: layer.name().to_owned(),
            color: Color::from_index(drawing.palette.style(layer).aci),
            ..dxf::tables::Layer::default()
        });
    }
    for style in file.dim_styles_mut() {
        // The crate's defaults are outside the ranges of these two variables.
        style.angular_dimension_precision = 0;
        style.dimension_precision = 0;
    }
    let [width, height] = drawing.size;
    for view in file.view_ports_mut() {
        view.view_center = Point::new(0.5 * width, 0.5 * height, 0.0);
        view.view_height = height.max(1.0);
        view.view_port_aspect_ratio = (width / height.max(1.0)).max(0.01);
    }
}

fn entity_types(entity: &Entity) -> Vec<EntityType> {
    match &entity.shape {
        Shape::Path(path) => vec![path_type(path)],
        Shape::Circle {
            centre: [x, y],
            radius,
        } => vec![EntityType::Circle(Circle {
            center: Point::new(*x, *y, 0.0),
            radius: *radius,
            ..Circle::default()
        })],
        Shape::Text(text) => text.strokes().iter().map(path_type).collect(),
    }
}

/// A single straight stroke is a line, which no reader can get wrong; all else is a polyline.
fn path_type(path: &Path) -> EntityType {
    if let ([from, to], Closure::Open) = (path.vertices.as_slice(), path.closed)
        && from.bulge == 0.0
    {
        return EntityType::Line(Line {
            p1: Point::new(from.x, from.y, 0.0),
            p2: Point::new(to.x, to.y, 0.0),
            ..Line::default()
        });
    }
    let mut polyline = LwPolyline {
        vertices: path
            .vertices
            .iter()
            .map(|v| LwPolylineVertex {
                x: v.x,
                y: v.y,
                bulge: v.bulge,
                ..LwPolylineVertex::default()
            })
            .collect(),
        ..LwPolyline::default()
    };
    polyline.set_is_closed(path.closed == Closure::Closed);
    EntityType::LwPolyline(polyline)
}

/// Layers by name, for the completion of their records.
fn layer_weight(drawing: &Drawing, name: &str) -> i16 {
    // Layer 0 belongs to every file and carries nothing.
    Layer::named(name).map_or(-3, |_| line_weight(drawing.palette))
}
