//! Plans of made-up grids: flat quadrilaterals with straight members, smooth slides and a bulge
//! in space. They have every record and every relation that fabrication reads, without the
//! stages that compute them.

use egg::fabrication::part::net_area;
use egg::plan::{
    Cladding, CladdingFunction, CrossingRecord, Diagonals, EdgeRecord, Eta, LamellaRecord,
    MemberRecord, OpeningRecord, PatchCurvature, PatchRecord, Plan, PointRecord, Positions, Range,
    SideRecord, SurfaceRecord,
};
use egg::project::model::{
    Bolt, ColourPreset, Fabrication, Family, Grain, Hardware, Material, Shell, Sticker, Stock,
};
use std::f64::consts::PI;

/// A patch to make.
pub(crate) struct Patch {
    pub(crate) name: &'static str,
    pub(crate) corners: [&'static str; 4],
    /// Flat, metres, counter-clockwise.
    pub(crate) planar: [[f64; 2]; 4],
    /// Counts of members.
    pub(crate) u: usize,
    pub(crate) v: usize,
    /// How shares of the start and the end side are distributed: 1 is even.
    pub(crate) u_bias: [f64; 2],
    pub(crate) v_bias: [f64; 2],
    /// Largest slide, metres.
    pub(crate) slide: f64,
}

/// Section and hardware.
pub(crate) struct Section {
    pub(crate) width: f64,
    pub(crate) thickness: f64,
    pub(crate) material: &'static str,
    /// Diameter of the hole and of the notch, metres.
    pub(crate) hole: f64,
    pub(crate) notch: f64,
}

/// A desktop model: one rhombic patch of 430 x 570 mm, 1 x 10 mm limewood.
pub(crate) fn desktop() -> Plan {
    let patch = Patch {
        name: "west",
        corners: ["a", "b", "c", "d"],
        planar: quad([0.43, 0.57, 0.43, 0.57], 62.0),
        u: 7,
        v: 9,
        u_bias: [0.8, 1.3],
        v_bias: [1.1, 0.7],
        slide: 0.006,
    };
    plan(
        "desktop",
        &[patch],
        &section(0.010, 0.001, "limewood", 3.0, 4.0),
    )
}

/// A pavilion of two sheared patches that share a side, 3 x 30 mm plywood.
pub(crate) fn pavilion() -> Plan {
    let [a, b, c, d] = quad([1.5, 1.3, 1.7, 1.1], 55.0);
    let west = Patch {
        name: "west",
        corners: ["a", "b", "e", "d"],
        planar: [a, b, c, d],
        u: 9,
        v: 7,
        u_bias: [1.0, 1.4],
        v_bias: [1.0, 0.7],
        slide: 0.030,
    };
    let [a, b, c, d] = quad([1.2, 1.6, 1.4, 1.3], 118.0);
    let east = Patch {
        name: "east",
        corners: ["b", "c", "f", "e"],
        planar: [a, b, c, d],
        u: 8,
        v: 7,
        u_bias: [1.2, 0.9],
        v_bias: [0.7, 1.3],
        slide: 0.018,
    };
    plan(
        "pavilion",
        &[west, east],
        &section(0.030, 0.003, "poplar-plywood", 4.0, 5.0),
    )
}

fn section(
    width: f64,
    thickness: f64,
    material: &'static str,
    bolt_mm: f64,
    shell_mm: f64,
) -> Section {
    Section {
        width,
        thickness,
        material,
        hole: (bolt_mm + 0.2) * 1e-3,
        notch: (shell_mm + 0.2) * 1e-3,
    }
}

/// Values of `[hardware]` that fit a bolt and a shell, millimetres.
pub(crate) fn hardware(bolt: f64, shell: f64) -> Hardware {
    Hardware {
        bolt: Bolt {
            name: format!("M{bolt}"),
            diameter: bolt * 1e-3,
        },
        sticker: Some(Sticker {
            foil: "PTFE".to_owned(),
            thickness: 0.13e-3,
            margin: 2e-3,
            sheet: [0.3, 0.2],
        }),
        shell: Some(Shell {
            name: format!("brass {shell}x0.45"),
            diameter: shell * 1e-3,
            wall: 0.45e-3,
        }),
    }
}

/// Values of `[fabrication]`.
pub(crate) fn fabrication(stock: [f64; 2]) -> Fabrication {
    Fabrication {
        stock: Stock {
            length: stock[0],
            width: stock[1],
            price: Some(24.5),
        },
        bed: None,
        kerf: 0.0,
        clearance: 0.2e-3,
        spacing: 3e-3,
        margin: 10e-3,
        end_margin: None,
        label_height: 3e-3,
        colours: ColourPreset::RedCut,
        splice: None,
    }
}

/// The materials that the plans name.
pub(crate) fn materials() -> Vec<Material> {
    [("limewood", 9.1e9, 500.0), ("poplar-plywood", 7.6e9, 430.0)]
        .into_iter()
        .map(|(name, elastic_modulus, density)| Material {
            name: name.to_owned(),
            elastic_modulus,
            shear_modulus: elastic_modulus / 15.0,
            density,
            bending_strength: 60e6,
            price: None,
            grain: Grain::Along,
        })
        .collect()
}

/// Side lengths 1-2, 2-3, 3-4, 4-1 and the angle at the first corner, degrees.
pub(crate) fn quad([a, b, c, d]: [f64; 4], alpha: f64) -> [[f64; 2]; 4] {
    let (sin, cos) = libm::sincos(alpha.to_radians());
    let corner = [d * cos, d * sin];
    // The third corner lies on circles of b around the second and of c around the fourth.
    let [dx, dy] = [corner[0] - a, corner[1]];
    let gap = libm::hypot(dx, dy);
    let along = (b * b - c * c + gap * gap) / (2.0 * gap);
    let aside = (b * b - along * along).sqrt();
    let third = [
        a + (along * dx + aside * dy) / gap,
        (along * dy - aside * dx) / gap,
    ];
    [[0.0, 0.0], [a, 0.0], third, corner]
}

/// A whole plan without sheets and bill.
pub(crate) fn plan(name: &str, patches: &[Patch], section: &Section) -> Plan {
    let mut plan = Plan {
        format: 1,
        name: name.to_owned(),
        surface: SurfaceRecord {
            vertices: 0,
            faces: 0,
            area: 1.0,
            bounding_box: [[0.0; 3], [1.0; 3]],
            gaussian_curvature: Range { min: 0.0, max: 1.0 },
        },
        points: Vec::new(),
        edges: Vec::new(),
        patches: Vec::new(),
        strips: Vec::new(),
        members: Vec::new(),
        crossings: Vec::new(),
        lamellae: Vec::new(),
        sheets: Vec::new(),
        nesting: Vec::new(),
        stickers: Vec::new(),
        foils: Vec::new(),
        supports: Vec::new(),
        bill_of_materials: Vec::new(),
        diagnostics: Vec::new(),
    };
    for patch in patches {
        add_patch(&mut plan, patch, section);
    }
    plan.points.sort_by(|a, b| a.id.cmp(&b.id));
    plan.edges.sort_by(|a, b| a.id.cmp(&b.id));
    plan.members.sort_by(|a, b| a.id.cmp(&b.id));
    plan.crossings.sort_by(|a, b| a.id.cmp(&b.id));
    plan.lamellae.sort_by(|a, b| a.id.cmp(&b.id));
    plan
}

/// A line of a family: shares on the start and the end side, ends in the plane.
struct Line {
    start: f64,
    end: f64,
    from: [f64; 2],
    to: [f64; 2],
}

fn add_patch(plan: &mut Plan, patch: &Patch, section: &Section) {
    let [a, b, c, d] = patch.planar;
    let space = corners_in_space(plan, patch);
    let u = lines(patch.u, patch.u_bias, [a, b], [d, c]);
    let v = lines(patch.v, patch.v_bias, [a, d], [b, c]);
    let sides = edges(plan, patch, &space);
    plan.patches.push(patch_record(patch, sides));
    for (family, lines) in [(Family::U, &u), (Family::V, &v)] {
        for (i, line) in lines.iter().enumerate() {
            let steps = (0..=24).map(|k| {
                let t = f64::from(k) / 24.0;
                let across = line.start + t * (line.end - line.start);
                let shares = match family {
                    Family::U => [across, t],
                    Family::V => [t, across],
                };
                lift(&space, shares)
            });
            let length = distance(line.from, line.to);
            plan.members.push(MemberRecord {
                id: member_id(patch, family, i),
                patch: patch.name.to_owned(),
                family,
                index: i as u32 + 1,
                start: line.start,
                end: line.end,
                boundary: i == 0 || i + 1 == lines.len(),
                length_surface: length,
                length_planar: length,
                polyline: steps.collect(),
                planar: [line.from, line.to],
            });
        }
    }
    for (i, g) in u.iter().enumerate() {
        for (j, h) in v.iter().enumerate() {
            plan.crossings.push(crossing(patch, &space, [i, j], g, h));
        }
    }
    let members: Vec<MemberRecord> = plan
        .members
        .iter()
        .filter(|m| m.patch == patch.name)
        .cloned()
        .collect();
    for member in &members {
        plan.lamellae.push(lamella(plan, member, section));
    }
}

fn lines(count: usize, bias: [f64; 2], start: [[f64; 2]; 2], end: [[f64; 2]; 2]) -> Vec<Line> {
    let share = |i: usize, k: f64| {
        let x = i as f64 / (count - 1) as f64;
        x * k / (1.0 + (k - 1.0) * x)
    };
    (0..count)
        .map(|i| {
            let [s, e] = [share(i, bias[0]), share(i, bias[1])];
            Line {
                start: s,
                end: e,
                from: mix(start[0], start[1], s),
                to: mix(end[0], end[1], e),
            }
        })
        .collect()
}

fn crossing(
    patch: &Patch,
    space: &[[f64; 3]; 4],
    [i, j]: [usize; 2],
    g: &Line,
    h: &Line,
) -> CrossingRecord {
    let [dg, dh] = [g, h].map(|line| [line.to[0] - line.from[0], line.to[1] - line.from[1]]);
    let det = dg[0] * dh[1] - dg[1] * dh[0];
    let gap = [h.from[0] - g.from[0], h.from[1] - g.from[1]];
    let s = (gap[0] * dh[1] - gap[1] * dh[0]) / det;
    let t = (gap[0] * dg[1] - gap[1] * dg[0]) / det;
    let planar = mix(g.from, g.to, s);
    let inner = i > 0 && i + 1 < patch.u && j > 0 && j + 1 < patch.v;
    let slide = if inner {
        patch.slide * libm::sin(PI * s) * libm::sin(PI * t)
    } else {
        0.0
    };
    let on = |line: &Line, share: f64, slide: f64| {
        let planar = share * distance(line.from, line.to);
        Positions {
            surface: planar + slide,
            planar,
        }
    };
    let angle = libm::atan2(dg[0] * dh[1] - dg[1] * dh[0], dg[0] * dh[0] + dg[1] * dh[1]);
    let shares = [
        g.start + s * (g.end - g.start),
        h.start + t * (h.end - h.start),
    ];
    CrossingRecord {
        id: format!("{}.u{:02}-v{:02}", patch.name, i + 1, j + 1),
        u: member_id(patch, Family::U, i),
        v: member_id(patch, Family::V, j),
        position: lift(space, shares),
        normal: [0.0, 0.0, 1.0],
        planar,
        on_u: on(g, s, slide),
        on_v: on(h, t, -0.6 * slide),
        angle_surface: angle.abs().to_degrees() + 20.0,
        angle_planar: angle.abs().to_degrees(),
    }
}

fn lamella(plan: &Plan, member: &MemberRecord, section: &Section) -> LamellaRecord {
    let mut openings: Vec<OpeningRecord> = plan
        .crossings
        .iter()
        .filter_map(|crossing| {
            let on = if crossing.u == member.id {
                crossing.on_u
            } else if crossing.v == member.id {
                crossing.on_v
            } else {
                return None;
            };
            let id = crossing.id.clone();
            Some(if (on.surface - on.planar).abs() < 1e-9 {
                OpeningRecord::Hole {
                    at: on.planar,
                    diameter: section.hole,
                    crossing: id,
                }
            } else {
                OpeningRecord::Notch {
                    from: on.planar,
                    to: on.surface,
                    diameter: section.notch,
                    crossing: id,
                }
            })
        })
        .collect();
    let place = |opening: &OpeningRecord| match opening {
        OpeningRecord::Hole { at, .. } => *at,
        OpeningRecord::Notch { from, .. } => *from,
    };
    openings.sort_by(|a, b| place(a).total_cmp(&place(b)));
    let length = member.length_planar + 2.0 * section.width;
    let mut lamella = LamellaRecord {
        id: member.id.clone(),
        member: member.id.clone(),
        material: section.material.to_owned(),
        length,
        end_margin: section.width,
        width: section.width,
        thickness: section.thickness,
        mass: 0.0,
        openings,
        pieces: Vec::new(),
    };
    lamella.mass = net_area(&lamella) * 1e-6 * section.thickness * 450.0;
    lamella
}

fn patch_record(patch: &Patch, [ab, bc, cd, da]: [String; 4]) -> PatchRecord {
    let [a, b, c, d] = patch.planar;
    let side = |edge: String, from: [f64; 2], to: [f64; 2]| SideRecord {
        edges: vec![edge],
        length: distance(from, to),
    };
    let function = |bias: [f64; 2]| {
        let ratio = bias[1] / bias[0];
        CladdingFunction {
            samples: (0..=32)
                .map(|k| {
                    let x = f64::from(k) / 32.0;
                    [x, x * ratio / (1.0 + (ratio - 1.0) * x)]
                })
                .collect(),
            slope_min: ratio.min(1.0 / ratio),
            slope_max: ratio.max(1.0 / ratio),
        }
    };
    PatchRecord {
        id: patch.name.to_owned(),
        corners: patch.corners.map(str::to_owned),
        sides: [
            side(ab, a, b),
            side(bc, b, c),
            side(cd, c, d),
            side(da, d, a),
        ],
        alpha_surface: 80.0,
        alpha_planar: libm::atan2(d[1], d[0]).to_degrees(),
        planar_corners: patch.planar,
        diagonals: Diagonals {
            e: 1.0,
            f: 1.0,
            e_planar: distance(a, c),
            f_planar: distance(b, d),
        },
        eta: Eta { u: 1.0, v: 1.0 },
        curvature: PatchCurvature {
            max: 1.0,
            peak: [0.0; 3],
            injectivity_bound: Some(PI),
            longest_geodesic: distance(a, c),
        },
        cladding: Cladding {
            u: function(patch.u_bias),
            v: function(patch.v_bias),
        },
        feasible: true,
    }
}

/// Places of anchors in space: on a grid of metres by their letter, so that patches which share
/// anchors share sides.
fn corners_in_space(plan: &mut Plan, patch: &Patch) -> [[f64; 3]; 4] {
    patch.corners.map(|name| {
        if let Some(point) = plan.points.iter().find(|point| point.id == name) {
            return point.position;
        }
        let scale = distance(patch.planar[0], patch.planar[1]);
        let [x, y] = match name {
            "a" => [0.0, 0.0],
            "b" => [1.0, -0.1],
            "c" => [1.9, 0.1],
            "f" => [2.0, 1.1],
            "e" => [1.05, 1.0],
            _ => [0.1, 0.95],
        };
        let position = [x * scale, y * scale, 0.0];
        plan.points.push(PointRecord {
            id: name.to_owned(),
            position,
            normal: outward([x, y]),
        });
        position
    })
}

/// The normal of an arch over the middle of both patches.
fn outward([x, y]: [f64; 2]) -> [f64; 3] {
    let lean = [0.3 * (x - 1.0), 0.8 * (y - 0.5), 1.0];
    let length = libm::sqrt(lean.iter().map(|v| v * v).sum());
    lean.map(|v| v / length)
}

/// Adds the edges of a patch that the plan does not have; gives the ids of its sides.
fn edges(plan: &mut Plan, patch: &Patch, space: &[[f64; 3]; 4]) -> [String; 4] {
    std::array::from_fn(|i| {
        let j = (i + 1) % 4;
        let (mut from, mut to) = ((patch.corners[i], space[i]), (patch.corners[j], space[j]));
        if from.0 > to.0 {
            (from, to) = (to, from);
        }
        let id = format!("{}-{}", from.0, to.0);
        if plan.edges.iter().all(|edge| edge.id != id) {
            plan.edges.push(EdgeRecord {
                id: id.clone(),
                from: from.0.to_owned(),
                to: to.0.to_owned(),
                length: distance(patch.planar[i], patch.planar[j]),
                polyline: vec![from.1, to.1],
            });
        }
        id
    })
}

fn lift([a, b, c, d]: &[[f64; 3]; 4], [x, y]: [f64; 2]) -> [f64; 3] {
    let mut point: [f64; 3] = std::array::from_fn(|k| {
        (1.0 - x) * (1.0 - y) * a[k] + x * (1.0 - y) * b[k] + x * y * c[k] + (1.0 - x) * y * d[k]
    });
    point[2] += 0.3 * libm::sin(PI * x) * libm::sin(PI * y);
    point
}

fn member_id(patch: &Patch, family: Family, i: usize) -> String {
    let letter = match family {
        Family::U => 'u',
        Family::V => 'v',
    };
    format!("{}.{letter}{:02}", patch.name, i + 1)
}

fn mix(a: [f64; 2], b: [f64; 2], t: f64) -> [f64; 2] {
    [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])]
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    libm::hypot(b[0] - a[0], b[1] - a[1])
}
