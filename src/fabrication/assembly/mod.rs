//! The step list: from sheets to the standing structure, in the order of the paper's showcase
//! (section 6.1): cut, coat, stickers, assemble flat, set out and cast the supports, bend and fix
//! to two supports, expand, fix the rest. Lamellae in pieces become whole before: those that are
//! glued before the coat, those with plates after it.
//!
//! Markdown, with the ids, files and measures of this structure in it, so that the people on the
//! site need nothing else.

mod splices;

use crate::fabrication::index::PlanIndex;
use crate::fabrication::names::distinct_file_names;
use crate::fabrication::part::short_id;
use crate::fabrication::setting::first_two;
use crate::fabrication::sheet::trim;
use crate::fabrication::summary::Summary;
use crate::fabrication::supports::setting_out::SettingOut;
use crate::fabrication::units::MM;
use crate::plan::{Face, LamellaRecord, MemberRecord, PatchRecord, Plan, StickerRecord};
use crate::project::model::{Family, Hardware, SupportKind};
use std::fmt::Write as _;

/// `assembly.md`.
pub fn steps(plan: &Plan, hardware: &Hardware) -> Vec<u8> {
    let mut page = Page::default();
    page.line(&format!("# {}: from sheets to a structure", plan.name));
    page.line("");
    overview(&mut page, plan);
    cut(&mut page, plan);
    splices::glue(&mut page, plan);
    coat(&mut page, plan);
    if !plan.stickers.is_empty() {
        stickers(&mut page, plan);
    }
    sort_hardware(&mut page, plan);
    splices::bolt(&mut page, plan, hardware);
    let files = distinct_file_names(plan.patches.iter().map(|patch| patch.id.as_str()));
    for (patch, file) in plan.patches.iter().zip(files) {
        assemble(&mut page, plan, patch, &file, hardware);
    }
    join(&mut page, plan);
    if !plan.supports.is_empty() {
        set_out(&mut page, plan);
    }
    erect(&mut page, plan);
    page.text.into_bytes()
}

#[derive(Default)]
struct Page {
    text: String,
    step: usize,
}

impl Page {
    fn line(&mut self, words: &str) {
        self.text.push_str(words);
        self.text.push('\n');
    }

    /// A heading with the next number.
    fn step(&mut self, title: &str) {
        self.step += 1;
        let _ = write!(self.text, "\n## {}. {title}\n\n", self.step);
    }

    fn table(&mut self, header: &[&str], rows: impl IntoIterator<Item = Vec<String>>) {
        self.line(&format!("| {} |", header.join(" | ")));
        self.line(&format!("|{}", "---|".repeat(header.len())));
        for row in rows {
            let cells: Vec<String> = row.iter().map(|cell| cell.replace('|', "\\|")).collect();
            self.line(&format!("| {} |", cells.join(" | ")));
        }
    }
}

fn overview(page: &mut Page, plan: &Plan) {
    let lines = Summary::new(plan).lines();
    page.table(
        &["", "", ""],
        lines
            .into_iter()
            .map(|(name, value, unit)| vec![name.to_owned(), value, unit.to_owned()]),
    );
    page.line("");
    page.line(
        "Lengths are in millimetres. What to buy stands in `bom.csv`; all tables are also in \
         `bill.xlsx`. Loads and reactions are not computed: whoever builds something that people \
         stand under asks an engineer.",
    );
}

fn cut(page: &mut Page, plan: &Plan) {
    page.step("Cut");
    page.table(
        &["sheet", "material", "size", "parts"],
        plan.sheets.iter().map(|sheet| {
            vec![
                sheet.id.clone(),
                format!("{} {} mm", sheet.material, trim(sheet.thickness * MM)),
                format!("{} x {}", trim(sheet.length * MM), trim(sheet.width * MM)),
                sheet.parts.len().to_string(),
            ]
        }),
    );
    page.line("");
    page.line(
        "Check the scale with the reference bar and the grain with the title of the sheet. Sort \
         the parts by their engraved ids: `cutlist.csv` is in that order.",
    );
}

fn coat(page: &mut Page, plan: &Plan) {
    page.step("Sand and coat");
    let area = plan.bill_of_materials.iter().find(|r| r.id == "coating");
    let area = area.map_or(0.0, |row| row.quantity);
    page.line(&format!(
        "Break all edges, those of holes and notches too. Coat faces and edges: {area:.2} m2 a \
         layer. Let it harden before anything is stuck on it, and keep the ids legible."
    ));
}

fn stickers(page: &mut Page, plan: &Plan) {
    page.step("Stickers");
    let foil = plan.foils.first();
    let name = foil.map_or("foil", |sheet| sheet.material.as_str());
    page.line(&format!(
        "Cut {} sheets of {name} with a knife plotter, kiss cuts first ({} stickers). **Never laser \
         foils that contain fluorine or chlorine.** Each sticker comes on a card with its number \
         and an arrow in the direction of its lamella; its slot lies over the notch, its slanted \
         ends show the lamella that crosses.",
        plan.foils.len(),
        plan.stickers.len()
    ));
    page.line("");
    page.table(
        &["lamella", "face", "stickers, from its start"],
        plan.stickers
            .chunk_by(|a, b| a.lamella == b.lamella)
            .filter_map(|group| {
                let first = group.first()?;
                Some(vec![
                    first.lamella.clone(),
                    face(first).to_owned(),
                    numbers(group),
                ])
            }),
    );
}

fn face(sticker: &StickerRecord) -> &'static str {
    match sticker.face {
        Face::Top => "top, with the labels",
        Face::Bottom => "bottom",
    }
}

fn numbers(group: &[StickerRecord]) -> String {
    match group {
        [] => String::new(),
        [only] => only.number.to_string(),
        [first, .., last] => format!("{} to {}", first.number, last.number),
    }
}

fn sort_hardware(page: &mut Page, plan: &Plan) {
    page.step("Lay out the hardware");
    let rows = plan
        .bill_of_materials
        .iter()
        .filter(|row| row.category == "fastener" || row.category == "sleeve" && row.id != "tube");
    page.table(
        &["what", "", "used", "spare"],
        rows.map(|row| {
            vec![
                row.description.clone(),
                row.specification.clone(),
                trim(row.quantity),
                trim(row.spare),
            ]
        }),
    );
}

fn assemble(page: &mut Page, plan: &Plan, patch: &PatchRecord, file: &str, hardware: &Hardware) {
    page.step(&format!("Assemble `{}` flat", patch.id));
    let index = PlanIndex::new(plan);
    let members = |family: Family| {
        let mut members: Vec<&MemberRecord> = plan
            .members
            .iter()
            .filter(|m| m.patch == patch.id && m.family == family)
            .collect();
        members.sort_by_key(|member| member.index);
        members
    };
    let names = |family| {
        let names: Vec<String> = members(family)
            .iter()
            .map(|m| format!("`{}`", short_id(&m.id, &patch.id)))
            .collect();
        names.join(" ")
    };
    let shell = match hardware.shell {
        Some(_) => ", shells on the bolts that stand in notches",
        None => "",
    };
    let here = |lamella: &&LamellaRecord| {
        let member = index.member(&lamella.member);
        member.is_some_and(|member| member.patch == patch.id) && !lamella.pieces.is_empty()
    };
    let joints = if plan.lamellae.iter().any(|lamella| here(&lamella)) {
        " It shows joints, with the letters of the pieces on both sides."
    } else {
        ""
    };
    page.line(&format!(
        "The drawing is `layout/{file}.svg`. Top faces up, arrows as drawn.{joints}"
    ));
    page.line("");
    page.line(&format!("- Lower layer, first: {}", names(Family::V)));
    page.line(&format!("- Upper layer, across: {}", names(Family::U)));
    page.line(&format!(
        "- Bolts from above through both, loose{shell}. The drawing shows them at the flat end of \
         each notch: {} crossings, {} of them with notches.",
        plan.crossings
            .iter()
            .filter(|c| index.member(&c.u).is_some_and(|m| m.patch == patch.id))
            .count(),
        plan.crossings
            .iter()
            .filter(|c| index.member(&c.u).is_some_and(|m| m.patch == patch.id))
            .filter(|c| crate::fabrication::nodes::slides(c, &index))
            .count(),
    ));
    let [a, b, c, d] = &patch.corners;
    page.line(&format!(
        "- Flat, the corner `{a}` has {:.1} degrees; unfolded {:.1}.",
        patch.alpha_planar, patch.alpha_surface
    ));
    for (from, to, flat) in [
        (a, c, patch.diagonals.e_planar),
        (b, d, patch.diagonals.f_planar),
    ] {
        let unfolded = straight(plan, from, to).map_or_else(String::new, |length| {
            format!(", unfolded {:.0} straight through the air", length * MM)
        });
        page.line(&format!(
            "- From `{from}` to `{to}`: flat {:.0}{unfolded}.",
            flat * MM
        ));
    }
}

/// Distance of two anchors in space, metres.
fn straight(plan: &Plan, from: &str, to: &str) -> Option<f64> {
    let find = |id: &str| plan.points.iter().find(|point| point.id == id);
    let (a, b) = (find(from)?.position, find(to)?.position);
    Some(libm::sqrt(
        a.iter().zip(b).map(|(p, q)| (p - q) * (p - q)).sum(),
    ))
}

fn join(page: &mut Page, plan: &Plan) {
    let mut shared: Vec<Vec<String>> = Vec::new();
    for (i, first) in plan.patches.iter().enumerate() {
        for second in &plan.patches[i + 1..] {
            let edges = |patch: &PatchRecord| -> Vec<String> {
                patch.sides.iter().flat_map(|s| s.edges.clone()).collect()
            };
            let theirs = edges(second);
            for edge in edges(first).into_iter().filter(|e| theirs.contains(e)) {
                shared.push(vec![first.id.clone(), second.id.clone(), edge]);
            }
        }
    }
    if shared.is_empty() {
        return;
    }
    page.step("Join the patches");
    page.line(
        "Unfold patches one after the other and join neighbours along their common side: both \
         boundary lamellae lie on each other, their holes meet, and one longer bolt goes through \
         all (`crossings.csv` says which).",
    );
    page.line("");
    page.table(&["patch", "patch", "along"], shared);
}

fn set_out(page: &mut Page, plan: &Plan) {
    page.step("Set out the supports");
    let kind = plan.supports.first().map(|support| support.kind);
    page.line(match kind {
        Some(SupportKind::Printed) => {
            "Print the feet: `supports/*.stl`, or all of them in `supports/supports.3mf`. The bolt \
             cuts its thread in the plastic. They weigh next to nothing: glue or screw them to a \
             board."
        }
        Some(SupportKind::ConcreteBlock) => {
            "Cast the blocks, a threaded sleeve square to each inclined top: \
             `supports/*.block.svg` has the measures, `supports/*.template.svg` the sides of the \
             forms."
        }
        Some(SupportKind::WedgeOnBlock) => {
            "Cast the blocks and glue the wedges: `supports/*.block.svg` has the measures, \
             `supports/*.template.svg` the sides of the wedges."
        }
        None => "",
    });
    page.line("");
    let Some(setting) = SettingOut::new(&plan.supports) else {
        return;
    };
    let [a, b] = setting.base.map(|i| &setting.stations[i].support.at);
    page.line(&format!(
        "Stretch a line from `{a}` to `{b}`, then find every other support with two tapes. All \
         stand on one level; `supports/setting-out.svg` is the plan of the ground."
    ));
    page.line("");
    let (from_a, from_b) = (format!("from `{a}`"), format!("from `{b}`"));
    page.table(
        &[
            "support",
            &from_a,
            &from_b,
            "side of the line",
            "height",
            "tilt °",
        ],
        setting.stations.iter().map(|station| {
            let side = match station.at[1] {
                y if y > 0.5 => "left",
                y if y < -0.5 => "right",
                _ => "on it",
            };
            vec![
                station.support.at.clone(),
                format!("{:.0}", station.tapes[0]),
                format!("{:.0}", station.tapes[1]),
                side.to_owned(),
                format!("{:.0}", station.support.height * MM),
                format!("{:.1}", station.support.tilt),
            ]
        }),
    );
}

fn erect(page: &mut Page, plan: &Plan) {
    page.step("Bend, fix two, expand, fix all");
    page.line(
        "A grid that is expanded from the floor may buckle into any of several shapes; one that \
         is bent first knows where to go.",
    );
    page.line("");
    match first_two(plan) {
        Some(two) => {
            let [a, b] = two.corners;
            page.line(&format!(
                "- Carry the folded grid to the supports `{a}` and `{b}`, its two far ends. Flat \
                 they are {:.0} apart, on the supports {:.0}: bend it up into an arch and bolt \
                 both ends.",
                two.flat * MM,
                two.standing * MM
            ));
        }
        None => page.line(
            "- Bend the folded grid up into an arch between its two far ends and fix both, in \
             place and in their tilt.",
        ),
    }
    page.line(
        "- Expand: pull the other corners apart, evenly on both sides. What is to be convex goes \
         up; help it by hand while forces are small.",
    );
    page.line(
        "- Bolts slide in their notches to the ends away from where the layout shows them. Where \
         one sticks, push the two lamellae at the crossing, not the corners.",
    );
    page.line("- Bolt the other supports, neighbours of fixed ones first.");
    page.line("- Tighten all nuts, from the supports inwards.");
    page.line(
        "- Bent lamellae are springs: eye protection, and no face in the plane in which one would \
         snap open. Take the structure down in the opposite order.",
    );
}
