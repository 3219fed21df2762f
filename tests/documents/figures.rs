//! The figures of a plan as a table.

use egg::fabrication::summary::Summary;
use egg::plan::{MemberRecord, NestingRecord, OpeningRecord, PatchRecord, Plan, SheetRecord};
use std::fmt::Write;

/// A table of two columns for a project's README.
pub(crate) fn table(plan: &Plan) -> String {
    let mut rows = Vec::new();
    surface(plan, &mut rows);
    if let [patch] = &plan.patches[..] {
        rows.extend(figures(plan, patch));
    }
    parts(plan, &mut rows);
    evenness(plan, &mut rows);
    rings(plan, &mut rows);
    let mut text = String::from("| | |\n|---|---|\n");
    for (name, value) in rows {
        let _ = writeln!(text, "| {name} | {value} |");
    }
    text.push('\n');
    if plan.patches.len() > 1 {
        text.push_str(&checks(plan));
        text.push('\n');
    }
    text.push_str(&remarks(plan));
    text
}

type Row = (String, String);

fn surface(plan: &Plan, rows: &mut Vec<Row>) {
    let surface = &plan.surface;
    let size = extent(
        plan.members
            .iter()
            .flat_map(|member| member.polyline.iter().copied()),
    );
    rows.push((
        "mesh".into(),
        format!("{} faces, {:.3} m²", surface.faces, surface.area),
    ));
    rows.push((
        "structure between its anchors".into(),
        format!("{:.3} x {:.3} x {:.3} m", size[0], size[1], size[2]),
    ));
    let range = surface.gaussian_curvature;
    rows.push((
        "Gaussian curvature".into(),
        format!("{} to {} 1/m²", short(range.min), short(range.max)),
    ));
}

fn figures(plan: &Plan, patch: &PatchRecord) -> Vec<Row> {
    let members: Vec<&MemberRecord> = plan
        .members
        .iter()
        .filter(|member| member.patch == patch.id)
        .collect();
    let count = |family: &str| {
        members
            .iter()
            .filter(|m| m.id[patch.id.len() + 1..].starts_with(family))
            .count()
    };
    let millimetres = |values: &[f64]| -> String {
        let texts: Vec<String> = values.iter().map(|v| format!("{:.1}", 1e3 * v)).collect();
        texts.join(", ")
    };
    let d = &patch.diagonals;
    let (u, v) = (&patch.cladding.u, &patch.cladding.v);
    let flat = along_diagonal(patch);
    let crossings: Vec<_> = plan
        .crossings
        .iter()
        .filter(|crossing| members.iter().any(|member| member.id == crossing.u))
        .collect();
    let inner = crossings
        .iter()
        .filter(|crossing| {
            let boundary = |id: &str| members.iter().any(|m| m.id == id && m.boundary);
            !boundary(&crossing.u) && !boundary(&crossing.v)
        })
        .count();
    let excess = members
        .iter()
        .map(|member| (member.length_surface - member.length_planar).abs());
    let nanometres = libm::round(1e9 * excess.fold(0.0, f64::max));
    let bound = patch.curvature.injectivity_bound.map_or_else(
        || "every geodesic is unique (curvature is negative)".to_owned(),
        |bound| format!("geodesics below {bound:.3} m are unique"),
    );
    let row = |name: &str, value: String| (name.to_owned(), value);
    vec![
        row(
            "sides 1-2, 2-3, 3-4, 4-1",
            format!(
                "{} mm",
                millimetres(&patch.sides.each_ref().map(|s| s.length))
            ),
        ),
        row(
            "diagonals on the surface, in the plane",
            format!(
                "{} mm, {} mm",
                millimetres(&[d.e, d.f]),
                millimetres(&[d.e_planar, d.f_planar])
            ),
        ),
        row(
            "angle at the first corner on the surface, in the plane",
            format!("{:.1}°, {:.1}°", patch.alpha_surface, patch.alpha_planar),
        ),
        row(
            "flat quadrilateral, along its long diagonal",
            format!("{:.3} x {:.3} m", flat[0], flat[1]),
        ),
        row(
            "slopes of the cladding functions",
            format!(
                "u {:.2} to {:.2}, v {:.2} to {:.2}",
                u.slope_min, u.slope_max, v.slope_min, v.slope_max
            ),
        ),
        row(
            "coverage of curvature peaks (eta)",
            format!("u {:.5}, v {:.5}", patch.eta.u, patch.eta.v),
        ),
        row(
            "uniqueness",
            format!(
                "{bound}; the longest here is {:.3} m",
                patch.curvature.longest_geodesic
            ),
        ),
        row("members", format!("{} u, {} v", count("u"), count("v"))),
        row(
            "lengths of members, surface against plane",
            format!("differ by less than {} nm", nanometres + 1.0),
        ),
        row(
            "crossings",
            format!("{}, {inner} of them inside", crossings.len()),
        ),
    ]
}

/// The checks of several patches, a row a patch. Angles are those at the first corner.
fn checks(plan: &Plan) -> String {
    let mut text = String::from(
        "| patch | sides, m | angle on the surface, flat | slopes u | slopes v | eta u, v \
         | longest, unique below, m | members | feasible |\n|---|---|---|---|---|---|---|---|---|\n",
    );
    for patch in &plan.patches {
        let sides: Vec<String> = patch.sides.iter().map(|s| short(s.length)).collect();
        let (u, v) = (&patch.cladding.u, &patch.cladding.v);
        let own = |family: &str| {
            let prefix = format!("{}.{family}", patch.id);
            let ids = plan.members.iter().map(|member| &member.id);
            ids.filter(|id| id.starts_with(&prefix)).count()
        };
        let curvature = &patch.curvature;
        let unique = curvature.injectivity_bound.map_or("all".to_owned(), short);
        let _ = writeln!(
            text,
            "| `{}` | {} | {:.1}°, {:.1}° | {:.2} to {:.2} | {:.2} to {:.2} | {:.4}, {:.4} | {}, {} \
             | {} x {} | {} |",
            patch.id,
            sides.join(", "),
            patch.alpha_surface,
            patch.alpha_planar,
            u.slope_min,
            u.slope_max,
            v.slope_min,
            v.slope_max,
            patch.eta.u,
            patch.eta.v,
            short(curvature.longest_geodesic),
            unique,
            own("u"),
            own("v"),
            if patch.feasible { "yes" } else { "no" },
        );
    }
    text
}

/// What the distribution over all sides gained against even members on the first side alone.
fn evenness(plan: &Plan, rows: &mut Vec<Row>) {
    let gained = |strip: &egg::plan::StripRecord| {
        let percent = 1e2 * (strip.evenness_gained - 1.0);
        format!("{percent:.1} % ({})", strip.families.join(", "))
    };
    let strips: Vec<String> = plan.strips.iter().map(gained).collect();
    let shown = if strips.len() <= 4 {
        strips.join("; ")
    } else {
        let all = plan.strips.iter().map(|strip| strip.evenness_gained);
        let (low, high) = (
            all.clone().fold(f64::INFINITY, f64::min),
            all.fold(1.0, f64::max),
        );
        let [low, high] = [low, high].map(|gained| 1e2 * (gained - 1.0));
        format!("{low:.1} to {high:.1} % in {} strips", strips.len())
    };
    rows.push((
        "evenness gained against even spacing on the first side".into(),
        shown,
    ));
}

/// How exactly members of rings come back to where they began.
fn rings(plan: &Plan, rows: &mut Vec<Row>) {
    for strip in &plan.strips {
        let Some(ring) = &strip.ring else { continue };
        let shown = if ring.drift < 1e-8 {
            "end where they began, to less than 10 nm".to_owned()
        } else {
            format!(
                "end up to {:.2} mm beside where they began",
                1e3 * ring.drift
            )
        };
        rows.push((format!("members of the ring {}", strip.id), shown));
    }
}

fn parts(plan: &Plan, rows: &mut Vec<Row>) {
    let slides: Vec<f64> = plan
        .lamellae
        .iter()
        .flat_map(|lamella| &lamella.openings)
        .filter_map(|opening| match opening {
            OpeningRecord::Notch { from, to, .. } => Some((to - from).abs()),
            OpeningRecord::Hole { .. } => None,
        })
        .collect();
    let mean = slides.iter().sum::<f64>() / slides.len().max(1) as f64;
    let longest = slides.iter().copied().fold(0.0, f64::max);
    rows.push((
        "notches".into(),
        format!(
            "{}, the bolt slides {:.1} mm on average, {:.1} mm at most",
            slides.len(),
            1e3 * mean,
            1e3 * longest
        ),
    ));
    if let Some(first) = plan.lamellae.first() {
        let length: f64 = plan.lamellae.iter().map(|lamella| lamella.length).sum();
        let mass: f64 = plan.lamellae.iter().map(|lamella| lamella.mass).sum();
        rows.push((
            "lamellae".into(),
            format!(
                "{} of {} x {} mm {}, {length:.2} m in all, {} without hardware",
                plan.lamellae.len(),
                short(1e3 * first.width),
                short(1e3 * first.thickness),
                first.material,
                weight(mass)
            ),
        ));
    }
    let summary = Summary::new(plan);
    rows.push((
        "grid with its hardware".into(),
        format!(
            "{}, {:.2} kg/m² of the rectangle around it",
            weight(summary.grid_mass()),
            summary.per_rectangle()
        ),
    ));
    if !plan.stickers.is_empty() {
        rows.push((
            "stickers".into(),
            format!(
                "{} on {} sheets of foil",
                plan.stickers.len(),
                plan.foils.len()
            ),
        ));
    }
    let tilts = plan.supports.iter().map(|support| support.tilt);
    let supports = if plan.supports.is_empty() {
        "none: a structure of this size stands on foundations".to_owned()
    } else {
        format!(
            "{}, {:.1} kg in all, contact faces of up to {:.1}°",
            plan.supports.len(),
            summary.support_mass,
            tilts.fold(0.0, f64::max)
        )
    };
    rows.push(("supports".into(), supports));
    let sheets: Vec<String> = plan.sheets.iter().map(sheet).collect();
    let told: Vec<String> = match sheets.len() {
        0..=4 => sheets,
        count => {
            let used = plan
                .sheets
                .iter()
                .map(|sheet| sheet.yield_share)
                .sum::<f64>();
            let used = 1e2 * used / count as f64;
            vec![format!("{count}, {used:.0} % used on average")]
        }
    };
    rows.push(("sheets".into(), told.join("; ")));
    let nesting: Vec<String> = plan.nesting.iter().map(nesting).collect();
    rows.push(("nesting".into(), nesting.join("; ")));
}

fn sheet(sheet: &SheetRecord) -> String {
    format!(
        "{} x {} mm, {} parts, {:.0} % used",
        short(1e3 * sheet.length),
        short(1e3 * sheet.width),
        sheet.parts.len(),
        1e2 * sheet.yield_share
    )
}

fn nesting(group: &NestingRecord) -> String {
    let plural = if group.sheets == 1 { "" } else { "s" };
    format!(
        "{} sheet{plural}, {} at least; {:.1} % yield, {:.1} % at most",
        group.sheets,
        group.sheets_bound,
        1e2 * group.yield_share,
        1e2 * group.yield_bound
    )
}

/// What `egg check` says.
fn remarks(plan: &Plan) -> String {
    if plan.diagnostics.is_empty() {
        return "`egg check` has nothing to say.\n".to_owned();
    }
    let mut text = String::from("`egg check` says:\n\n");
    for told in &plan.diagnostics {
        let subject = told
            .subject
            .as_ref()
            .map_or_else(String::new, |subject| format!(" (`{subject}`)"));
        let _ = writeln!(text, "- {} {}{subject}", told.code, told.message);
    }
    text
}

/// Size of the flat quadrilateral along and across its longer diagonal.
fn along_diagonal(patch: &PatchRecord) -> [f64; 3] {
    let [a, b, c, d] = patch.planar_corners.map(nalgebra::Point2::from);
    let long = if (c - a).norm() > (d - b).norm() {
        c - a
    } else {
        d - b
    }
    .normalize();
    extent([a, b, c, d].into_iter().map(|p| {
        let from_a = p - a;
        [from_a.dot(&long), long.perp(&from_a), 0.0]
    }))
}

/// Size of the box around points.
fn extent(points: impl Iterator<Item = [f64; 3]>) -> [f64; 3] {
    let [mut low, mut high] = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
    for point in points {
        for k in 0..3 {
            low[k] = low[k].min(point[k]);
            high[k] = high[k].max(point[k]);
        }
    }
    std::array::from_fn(|k| high[k] - low[k])
}

/// Grams up to ten kilograms, then kilograms, then tonnes.
fn weight(kilograms: f64) -> String {
    match kilograms {
        small if small < 10.0 => format!("{:.0} g", 1e3 * small),
        middle if middle < 1e4 => format!("{middle:.0} kg"),
        large => format!("{:.0} t", 1e-3 * large),
    }
}

/// Three digits that matter, as people write them.
fn short(value: f64) -> String {
    let digits = 2 - libm::floor(libm::log10(value.abs().max(1e-9))) as i32;
    let text = format!("{:.*}", digits.clamp(0, 6) as usize, value);
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}
