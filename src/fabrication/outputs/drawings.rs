//! Drawings of patches and of the whole structure, coupons, foils and supports.

use super::{Files, OutputFile, sheet_name};
use crate::diagnostics::Checked;
use crate::fabrication::coupon::{self, CouponSection};
use crate::fabrication::index::PlanIndex;
use crate::fabrication::layout::{self, FlatPatch};
use crate::fabrication::names::{distinct_file_names, file_name};
use crate::fabrication::network::{self, NamedQuad};
use crate::fabrication::sheet::trim;
use crate::fabrication::units::MM;
use crate::fabrication::{cladding_plot, from_above, stickers, supports};
use crate::plan::{Plan, cladding_to_ron};
use crate::project::model::{ColourPreset, Hardware};

/// The coupon that tells kerf and fit of a machine, one for each material and thickness.
pub fn coupon_files(
    sections: &[CouponSection],
    hardware: &Hardware,
    colours: ColourPreset,
) -> Checked<Vec<OutputFile>> {
    let mut files = Files::default();
    for section in sections {
        let name = format!(
            "coupon/{}-{}mm",
            file_name(&section.material),
            trim(section.thickness * MM)
        );
        let drawing = coupon::draw(section, hardware, colours);
        files.both(&name, &drawing);
    }
    files.finish()
}

/// Drawings of the whole structure beside those of its patches.
const WHOLE: [&str; 2] = ["from-above", "patches"];

/// The flat layout of every patch, with holes for a bolt (its diameter in metres).
pub fn layout_files(plan: &Plan, bolt: f64) -> Checked<Vec<OutputFile>> {
    let index = PlanIndex::new(plan);
    let patches = plan.patches.iter().map(|patch| patch.id.as_str());
    let names = distinct_file_names(WHOLE.into_iter().chain(patches));
    let names = names.into_iter().skip(WHOLE.len());
    let mut files = Files::default();
    for (patch, name) in plan.patches.iter().zip(names) {
        let members = plan.members.iter().filter(|m| m.patch == patch.id);
        let is_here = |member: &str| index.member(member).is_some_and(|m| m.patch == patch.id);
        let flat = FlatPatch {
            project: &plan.name,
            patch,
            lamellae: members
                .filter_map(|member| Some((member, index.lamella_of(&member.id)?)))
                .collect(),
            crossings: plan.crossings.iter().filter(|c| is_here(&c.u)).collect(),
            bolt,
        };
        files.both(&format!("layout/{name}"), &layout::draw(&flat));
    }
    files.finish()
}

/// The members of all patches from above.
pub fn above_files(plan: &Plan) -> Checked<Vec<OutputFile>> {
    let mut files = Files::default();
    let above = from_above::draw(&plan.name, &plan.patches, &plan.members, &plan.points);
    files.picture("layout/from-above", &above);
    files.finish()
}

/// The layout from above: its skeleton with names.
pub fn network_files(
    name: &str,
    patches: &[NamedQuad],
    skeleton: &Plan,
) -> Checked<Vec<OutputFile>> {
    let mut files = Files::default();
    let drawing = network::draw(name, patches, &skeleton.points, &skeleton.edges);
    files.picture("layout/patches", &drawing);
    files.finish()
}

/// The cladding functions of every patch, as a plot and as a document.
pub fn cladding_files(plan: &Plan) -> Checked<Vec<OutputFile>> {
    let names = distinct_file_names(plan.patches.iter().map(|patch| patch.id.as_str()));
    let mut files = Files::default();
    for (patch, name) in plan.patches.iter().zip(names) {
        let members = plan.members.iter().filter(|m| m.patch == patch.id);
        let drawing = cladding_plot::draw(patch, &members.collect::<Vec<_>>());
        files.picture(&format!("cladding/{name}"), &drawing);
        let document = cladding_to_ron(plan, patch).into_bytes();
        files.add(&format!("cladding/{name}"), "ron", Ok(document));
    }
    files.finish()
}

/// The sheets of foil.
pub fn sticker_files(plan: &Plan, colours: ColourPreset) -> Checked<Vec<OutputFile>> {
    let by_id = plan.stickers.iter().map(|s| (s.id.as_str(), s)).collect();
    let style = stickers::FoilStyle {
        project: &plan.name,
        count: plan.foils.len(),
        colours,
    };
    let mut files = Files::default();
    for sheet in &plan.foils {
        let material = (sheet.material.as_str(), sheet.thickness);
        let name = sheet_name("stickers", plan, material, &sheet.id, plan.foils.len());
        files.both(&name, &stickers::draw(sheet, &by_id, &style));
    }
    files.finish()
}

/// The ground plan, and every support as it is made: printed, or cast and cut.
pub fn support_files(plan: &Plan, colours: ColourPreset) -> Checked<Vec<OutputFile>> {
    let names = distinct_file_names(plan.supports.iter().map(|support| support.id.as_str()));
    let grid: f64 = plan.lamellae.iter().map(|lamella| lamella.mass).sum();
    let style = supports::drawing::BlockStyle {
        project: &plan.name,
        share: grid / plan.supports.len().max(1) as f64,
        sheet: supports::thinnest_sheet(plan).unwrap_or(supports::WEDGE_EDGE),
        colours,
    };
    let mut files = Files::default();
    if let Some(drawing) = supports::setting_out::draw(plan) {
        files.both("supports/setting-out", &drawing);
    }
    let mut solids = Vec::new();
    for (support, name) in plan.supports.iter().zip(names) {
        let name = format!("supports/{name}");
        if let Some(drawing) = supports::drawing::block(support, &style) {
            files.both(&format!("{name}.block"), &drawing);
        }
        if let Some(drawing) = supports::drawing::template(support, &style) {
            files.both(&format!("{name}.template"), &drawing);
        }
        if let Some(solid) = supports::solid::of(support) {
            files.made.push(OutputFile {
                path: format!("{name}.stl"),
                bytes: supports::solid::stl(&support.id, &solid),
            });
            solids.push((support.id.as_str(), solid));
        }
    }
    if !solids.is_empty() {
        files.made.push(OutputFile {
            path: "supports/supports.3mf".to_owned(),
            bytes: supports::solid::three_mf(&solids),
        });
    }
    files.finish()
}
