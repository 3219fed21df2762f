//! The structure in a few numbers: how much of it there is, what it weighs and costs.
//!
//! The paper gives the weight of its showcase by the rectangle that the structure stands in (7.1 kg
//! over 3.1 x 2.1 m are 1.09 kg/m2); that is [`Summary::per_rectangle`]. The area that the patches
//! cover, seen from above, is smaller. Load paths and reactions are the matter of statics.

use super::bom::is_bought;
use crate::plan::{BomRow, PatchRecord, Plan};

/// Numbers of a plan that has its bill. Metres, kilograms.
#[derive(Debug, Clone, PartialEq)]
pub struct Summary {
    /// Number of lamellae.
    pub lamellae: usize,
    /// Length of all lamellae.
    pub metres: f64,
    /// Mass of all lamellae.
    pub lamella_mass: f64,
    /// Mass of the plates over joints.
    pub plate_mass: f64,
    /// Mass of bolts, nuts, washers, shells and stickers that stay in the grid.
    pub hardware_mass: f64,
    /// Sides of the smallest rectangle around the structure, seen from above, the longer first.
    pub rectangle: [f64; 2],
    /// Area of the patches, seen from above.
    pub covered: f64,
    /// Number of supports.
    pub supports: usize,
    /// Mass of all supports.
    pub support_mass: f64,
    /// Sum of all rows with a price, spares included, in the project's currency.
    pub cost: Option<f64>,
    /// Rows of things to buy without a price; what is made from another row is not one of them.
    pub unpriced: usize,
}

impl Summary {
    /// Adds up a plan.
    pub fn new(plan: &Plan) -> Self {
        let bill = &plan.bill_of_materials;
        let mass = |is_counted: &dyn Fn(&BomRow) -> bool| -> f64 {
            let counted = bill.iter().filter(|row| is_counted(row));
            counted
                .map(|row| row.quantity * row.unit_mass.unwrap_or(0.0))
                .sum()
        };
        let is_hardware = |row: &BomRow| match row.category.as_str() {
            "fastener" => true,
            // Tube and foil are what shells and stickers are cut from.
            "sleeve" | "friction" => !is_bought(row),
            _ => false,
        };
        let cost = |row: &BomRow| Some((row.quantity + row.spare) * row.unit_cost?);
        let costs: Vec<f64> = bill.iter().filter_map(cost).collect();
        Self {
            lamellae: plan.lamellae.len(),
            metres: plan.lamellae.iter().map(|l| l.length).sum(),
            lamella_mass: mass(&|row| row.category == "lamella"),
            plate_mass: mass(&|row| row.category == "plate"),
            hardware_mass: mass(&is_hardware),
            rectangle: rectangle(plan),
            covered: plan.patches.iter().map(|p| covered(plan, p)).sum(),
            supports: plan.supports.len(),
            support_mass: plan
                .supports
                .iter()
                .filter_map(|support| Some(support.body?.mass))
                .sum(),
            cost: (!costs.is_empty()).then(|| costs.iter().sum()),
            unpriced: bill
                .iter()
                .filter(|row| is_bought(row) && row.unit_cost.is_none())
                .count(),
        }
    }

    /// Mass of the grid without supports.
    pub fn grid_mass(&self) -> f64 {
        self.lamella_mass + self.plate_mass + self.hardware_mass
    }

    /// Kilograms a square metre of the rectangle around it; 0 if it has no area.
    pub fn per_rectangle(&self) -> f64 {
        per(self.grid_mass(), self.rectangle[0] * self.rectangle[1])
    }

    /// Kilograms a square metre that is covered; 0 if none is.
    pub fn per_covered(&self) -> f64 {
        per(self.grid_mass(), self.covered)
    }

    /// Name, value and unit of each number, for tables.
    pub fn lines(&self) -> Vec<(&'static str, String, &'static str)> {
        let [long, short] = self.rectangle;
        let mut lines = vec![
            ("lamellae", self.lamellae.to_string(), "pcs"),
            ("length of all lamellae", format!("{:.1}", self.metres), "m"),
            (
                "mass of the lamellae",
                format!("{:.3}", self.lamella_mass),
                "kg",
            ),
        ];
        if self.plate_mass > 0.0 {
            lines.push(("mass of plates", format!("{:.3}", self.plate_mass), "kg"));
        }
        lines.extend([
            (
                "mass of bolts, nuts, washers, shells and stickers",
                format!("{:.3}", self.hardware_mass),
                "kg",
            ),
            ("mass of the grid", format!("{:.3}", self.grid_mass()), "kg"),
            ("length seen from above", format!("{long:.3}"), "m"),
            ("width seen from above", format!("{short:.3}"), "m"),
            (
                "mass of the grid per area of that rectangle",
                format!("{:.3}", self.per_rectangle()),
                "kg/m2",
            ),
            ("area covered", format!("{:.3}", self.covered), "m2"),
            (
                "mass of the grid per area covered",
                format!("{:.3}", self.per_covered()),
                "kg/m2",
            ),
            ("supports", self.supports.to_string(), "pcs"),
            (
                "mass of the supports",
                format!("{:.2}", self.support_mass),
                "kg",
            ),
        ]);
        if let Some(cost) = self.cost {
            lines.push(("cost of what has a price", format!("{cost:.2}"), ""));
        }
        lines.push(("rows without a price", self.unpriced.to_string(), ""));
        lines
    }
}

fn per(mass: f64, area: f64) -> f64 {
    if area > 0.0 { mass / area } else { 0.0 }
}

/// Area of a patch seen from above: inside the lines of its sides, or of its corners where the
/// plan has no lines.
fn covered(plan: &Plan, patch: &PatchRecord) -> f64 {
    let mut outline: Vec<[f64; 2]> = Vec::new();
    for (side, corner) in patch.sides.iter().zip(&patch.corners) {
        let start = plan.points.iter().find(|point| point.id == *corner);
        outline.extend(start.map(|p| [p.position[0], p.position[1]]));
        for id in &side.edges {
            let Some(edge) = plan.edges.iter().find(|edge| edge.id == *id) else {
                continue;
            };
            let mut line: Vec<[f64; 2]> = edge.polyline.iter().map(|p| [p[0], p[1]]).collect();
            if let (Some(last), Some(first), Some(end)) =
                (outline.last(), line.first(), line.last())
                && distance(*last, *end) < distance(*last, *first)
            {
                line.reverse();
            }
            outline.extend(line);
        }
    }
    let next = outline.iter().cycle().skip(1);
    let doubled: f64 = outline
        .iter()
        .zip(next)
        .map(|(a, b)| a[0] * b[1] - b[0] * a[1])
        .sum();
    0.5 * doubled.abs()
}

/// Sides of the smallest rectangle around all members seen from above: one of its sides lies on
/// a side of their convex hull.
fn rectangle(plan: &Plan) -> [f64; 2] {
    let points = plan.members.iter().flat_map(|member| &member.polyline);
    let hull = hull(points.map(|p| [p[0], p[1]]).collect());
    let next = hull.iter().cycle().skip(1);
    let mut best: Option<[f64; 2]> = None;
    for (a, b) in hull.iter().zip(next) {
        let length = distance(*a, *b);
        if length == 0.0 {
            continue;
        }
        let [c, s] = [(b[0] - a[0]) / length, (b[1] - a[1]) / length];
        let extent = |f: &dyn Fn([f64; 2]) -> f64| {
            let values = hull.iter().map(|p| f(*p));
            let [low, high] = values.fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], v| {
                [l.min(v), h.max(v)]
            });
            high - low
        };
        let [x, y] = [
            extent(&|p| c * p[0] + s * p[1]),
            extent(&|p| c * p[1] - s * p[0]),
        ];
        let sides = [x.max(y), x.min(y)];
        if best.is_none_or(|best| sides[0] * sides[1] < best[0] * best[1]) {
            best = Some(sides);
        }
    }
    best.unwrap_or_default()
}

/// Convex hull, counter-clockwise (Andrew's monotone chain).
fn hull(mut points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    points.dedup();
    let half = |points: &mut dyn Iterator<Item = [f64; 2]>| {
        let mut chain: Vec<[f64; 2]> = Vec::new();
        for p in points {
            while let [.., a, b] = chain[..]
                && (b[0] - a[0]) * (p[1] - a[1]) <= (b[1] - a[1]) * (p[0] - a[0])
            {
                chain.pop();
            }
            chain.push(p);
        }
        chain.pop();
        chain
    };
    let mut hull = half(&mut points.iter().copied());
    hull.extend(half(&mut points.iter().rev().copied()));
    hull
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    libm::hypot(a[0] - b[0], a[1] - b[1])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::MemberRecord;
    use crate::project::model::Family;

    fn member(points: &[[f64; 3]]) -> MemberRecord {
        MemberRecord {
            id: String::new(),
            patch: String::new(),
            family: Family::U,
            index: 1,
            start: 0.0,
            end: 0.0,
            boundary: true,
            length_surface: 1.0,
            length_planar: 1.0,
            polyline: points.to_vec(),
            planar: [[0.0; 2]; 2],
        }
    }

    #[test]
    fn the_rectangle_is_the_smallest_in_any_direction() {
        // A rectangle of 3.1 x 2.1 m turned by 30 degrees, with a point inside.
        let (sin, cos) = libm::sincos(30.0_f64.to_radians());
        let at = |x: f64, y: f64| [cos * x - sin * y, sin * x + cos * y, 0.7];
        let plan = Plan {
            members: vec![
                member(&[at(0.0, 0.0), at(1.0, 1.0), at(3.1, 0.0)]),
                member(&[at(3.1, 2.1), at(0.0, 2.1)]),
            ],
            ..Plan::default()
        };
        let [long, short] = rectangle(&plan);
        assert!((long - 3.1).abs() < 1e-12 && (short - 2.1).abs() < 1e-12);
        assert_eq!(rectangle(&Plan::default()), [0.0; 2]);
    }
}
