//! Sheets, bill and files.

use super::{judged, outcome, plain};
use crate::build::{Failure, Files, Node, Numerics, Stage};
use crate::diagnostics::{Checked, Warned};
use crate::fabrication::bom::{self, Shopping};
use crate::fabrication::nesting::{Blank, Nest, Settings, nest};
use crate::fabrication::{self as outputs, Inputs, NamedQuad, OutputFile};
use crate::plan::{BomRow, Plan, bind, to_ron};
use crate::project::model::{Fabrication, Grain, Hardware, Material, Stock};
use serde::Serialize;

/// What nesting depends on besides the lamellae.
#[derive(Debug, Serialize)]
pub(in crate::build) struct NestInput {
    pub(in crate::build) settings: Settings,
    /// Grain of the materials, by name.
    pub(in crate::build) grains: Vec<(String, Grain)>,
}

/// Sheets of all lamellae, once no workshop objects to one of them.
pub(in crate::build) const NEST: Stage<NestInput, (Vec<Node<Plan>>, Vec<Node<()>>), Nest> = Stage {
    name: "nest",
    version: 1,
    numerics: Numerics::Portable,
    run: |input, (chapters, _), _| {
        let grain = |material: &str| {
            let known = input.grains.iter().find(|(name, _)| name == material);
            known.map_or(Grain::Along, |(_, grain)| *grain)
        };
        let blanks: Vec<Blank> = chapters
            .iter()
            .flat_map(|chapter| &chapter.lamellae)
            .map(|lamella| Blank {
                id: lamella.id.clone(),
                material: lamella.material.clone(),
                thickness: lamella.thickness,
                length: lamella.length,
                width: lamella.width,
                grain: grain(&lamella.material),
            })
            .collect();
        outcome(nest(&blanks, &input.settings))
    },
};

/// What the bill depends on besides the plan.
#[derive(Debug, Serialize)]
pub(in crate::build) struct BillInput {
    pub(in crate::build) hardware: Hardware,
    pub(in crate::build) materials: Vec<Material>,
    pub(in crate::build) stock: Stock,
}

/// The bill of materials.
pub(in crate::build) const BILL: Stage<BillInput, (Vec<Node<Plan>>, Node<Nest>), Vec<BomRow>> =
    Stage {
        name: "bill",
        version: 1,
        numerics: Numerics::Portable,
        run: |input, (chapters, nest), _| {
            let plan = bind("", chapters.into_iter());
            let shopping = Shopping {
                hardware: &input.hardware,
                materials: &input.materials,
                stock: &input.stock,
                groups: &nest.groups,
            };
            outcome(bom::rows(&plan, &shopping))
        },
    };

/// `plan.ron`.
pub(in crate::build) const PLAN_FILE: Stage<(), Node<Plan>, Files> = Stage {
    name: "plan-file",
    version: 1,
    numerics: Numerics::Portable,
    run: |(), plan, _| plain(Files::new().with("plan.ron", to_ron(plan))),
};

/// What drawings depend on besides the plan.
#[derive(Debug, Serialize)]
pub(in crate::build) struct DrawingInput {
    pub(in crate::build) name: String,
    pub(in crate::build) hardware: Hardware,
    pub(in crate::build) fabrication: Fabrication,
    pub(in crate::build) materials: Vec<Material>,
}

impl DrawingInput {
    fn inputs(&self) -> Inputs<'_> {
        Inputs {
            hardware: &self.hardware,
            fabrication: &self.fabrication,
            materials: &self.materials,
        }
    }
}

/// What a workshop would object to in the lamellae of a patch.
pub(in crate::build) const WORKSHOP: Stage<DrawingInput, Node<Plan>, ()> = Stage {
    name: "workshop",
    version: 1,
    numerics: Numerics::Portable,
    run: |input, chapter, _| outcome(outputs::check(chapter, input.inputs())),
};

/// The cladding functions of a patch, as a plot and as a document.
pub(in crate::build) const CLADDING_FILES: Stage<(), Node<Plan>, Files> = Stage {
    name: "cladding-files",
    version: 2,
    numerics: Numerics::Portable,
    run: |(), chapter, _| files(outputs::cladding_files(chapter)),
};

/// The flat layout of a patch.
pub(in crate::build) const LAYOUT_FILES: Stage<DrawingInput, Node<Plan>, Files> = Stage {
    name: "layout-files",
    version: 1,
    numerics: Numerics::Portable,
    run: |input, chapter, _| {
        let plan = bind(&input.name, std::iter::once(chapter));
        files(outputs::layout_files(&plan, input.inputs()))
    },
};

/// The structure from above.
pub(in crate::build) const ABOVE_FILES: Stage<String, (Node<Plan>, Vec<Node<Plan>>), Files> =
    Stage {
        name: "above-files",
        version: 1,
        numerics: Numerics::Portable,
        run: |name, (skeleton, chapters), _| {
            let plan = bind(name, std::iter::once(skeleton).chain(chapters));
            files(outputs::above_files(&plan))
        },
    };

/// What the drawing of the network is told of patches.
#[derive(Debug, Serialize)]
pub(in crate::build) struct NetworkDrawingInput {
    pub(in crate::build) name: String,
    pub(in crate::build) patches: Vec<NamedQuad>,
}

/// The layout: anchors, sides and patches from above.
pub(in crate::build) const NETWORK_FILES: Stage<NetworkDrawingInput, Node<Plan>, Files> = Stage {
    name: "network-files",
    version: 1,
    numerics: Numerics::Portable,
    run: |input, skeleton, _| {
        files(outputs::network_files(
            &input.name,
            &input.patches,
            skeleton,
        ))
    },
};

/// Cut files and overviews of all sheets.
pub(in crate::build) const SHEET_FILES: Stage<DrawingInput, (Vec<Node<Plan>>, Node<Nest>), Files> =
    Stage {
        name: "sheet-files",
        version: 1,
        numerics: Numerics::Portable,
        run: |input, (chapters, nest), _| {
            let mut plan = bind(&input.name, chapters.into_iter());
            plan.sheets.clone_from(&nest.sheets);
            let Warned {
                value: parts,
                warnings,
            } = outputs::parts(&plan, input.inputs());
            let by_id = parts.iter().map(|part| (part.id.as_str(), part)).collect();
            let mut made = Files::new();
            for sheet in &plan.sheets {
                let drawn = outputs::sheet_files(&plan, sheet, &by_id, input.inputs());
                for OutputFile { path, bytes } in drawn.map_err(Failure::Errors)?.value {
                    made.push(path, bytes);
                }
            }
            judged(made, warnings)
        },
    };

/// The tables.
pub(in crate::build) const TABLE_FILES: Stage<
    DrawingInput,
    (Vec<Node<Plan>>, Node<Nest>, Node<Vec<BomRow>>),
    Files,
> = Stage {
    name: "table-files",
    version: 1,
    numerics: Numerics::Portable,
    run: |input, (chapters, nest, bill), _| {
        let mut plan = bind(&input.name, chapters.into_iter());
        plan.sheets.clone_from(&nest.sheets);
        plan.bill_of_materials.clone_from(bill);
        let tables = outputs::table_files(&plan, input.inputs());
        files(Ok(Warned {
            value: tables,
            warnings: Vec::new(),
        }))
    },
};

fn files(made: Checked<Vec<OutputFile>>) -> Result<Warned<Files>, Failure> {
    let Warned { value, warnings } = made.map_err(Failure::Errors)?;
    let mut files = Files::new();
    for OutputFile { path, bytes } in value {
        files.push(path, bytes);
    }
    Ok(Warned {
        value: files,
        warnings,
    })
}
