//! Sheets, bill and files.

use super::{judged, outcome, plain};
use crate::build::{Failure, Files, Node, Numerics, Stage};
use crate::diagnostics::{Checked, Warned};
use crate::fabrication::bom::{self, Shopping};
use crate::fabrication::coupon::CouponSection;
use crate::fabrication::nesting::{Nest, Settings, nest};
use crate::fabrication::part::PartStyle;
use crate::fabrication::pieces::blanks;
use crate::fabrication::splicing::{Rules, Spliced, splice};
use crate::fabrication::supports::{self, SupportInputs};
use crate::fabrication::{
    self as outputs, Grains, NamedQuad, OutputFile, SheetSettings, Woods, Workshop, stickers,
};
use crate::plan::{BomRow, Plan, SheetRecord, StickerRecord, SupportRecord, bind, to_ron};
use crate::project::model::{Bolt, ColourPreset, Hardware, Material, Sticker, Stock, Supports};
use serde::{Deserialize, Serialize};

/// Pieces of lamellae that are longer than the stock.
pub(in crate::build) const SPLICES: Stage<Rules, Vec<Node<Plan>>, Vec<Spliced>> = Stage {
    name: "splices",
    version: 3,
    numerics: Numerics::Portable,
    run: |rules, chapters, _| outcome(splice(&bind("", chapters.into_iter()), rules)),
};

/// The chapter of a patch with the pieces of its lamellae.
pub(in crate::build) const SPLICED: Stage<(), (Node<Plan>, Node<Vec<Spliced>>), Plan> = Stage {
    name: "spliced",
    version: 2,
    numerics: Numerics::Portable,
    run: |(), (chapter, splices), _| {
        let mut chapter = chapter.clone();
        for lamella in &mut chapter.lamellae {
            if let Some(found) = splices.iter().find(|s| s.lamella == lamella.id) {
                found.put_into(lamella);
            }
        }
        plain(chapter)
    },
};

/// What nesting depends on besides the lamellae.
#[derive(Debug, Serialize)]
pub(in crate::build) struct NestInput {
    pub(in crate::build) settings: Settings,
    pub(in crate::build) grains: Grains,
}

/// Sheets of all lamellae, once no workshop objects to one of them.
pub(in crate::build) const NEST: Stage<NestInput, (Vec<Node<Plan>>, Vec<Node<()>>), Nest> = Stage {
    name: "nest",
    version: 3,
    numerics: Numerics::Portable,
    run: |input, (chapters, _), _| {
        let lamellae = chapters.iter().flat_map(|chapter| &chapter.lamellae);
        let blanks = blanks(lamellae, |material| input.grains.grain(material));
        outcome(nest(&blanks, &input.settings))
    },
};

/// Stickers and the sheets of foil that they are cut from.
#[derive(Debug, Default, Serialize, Deserialize)]
pub(in crate::build) struct Foils {
    pub(in crate::build) stickers: Vec<StickerRecord>,
    pub(in crate::build) sheets: Vec<SheetRecord>,
}

/// Stickers of all crossings that slide, on sheets of foil.
pub(in crate::build) const STICKERS: Stage<
    Option<Sticker>,
    (Vec<Node<Plan>>, Vec<Node<()>>),
    Foils,
> = Stage {
    name: "stickers",
    version: 2,
    numerics: Numerics::Portable,
    run: |sticker, (chapters, _), _| {
        let Some(sticker) = sticker else {
            return plain(Foils::default());
        };
        let plan = bind("", chapters.into_iter());
        let Warned {
            value: stickers,
            warnings,
        } = stickers::records(&plan, sticker);
        let sheets = stickers::nest(&stickers, sticker).map_err(Failure::Errors)?;
        judged(
            Foils {
                stickers,
                sheets: sheets.value,
            },
            warnings,
        )
    },
};

/// What supports depend on besides the plan.
#[derive(Debug, Serialize)]
pub(in crate::build) struct SupportInput {
    pub(in crate::build) supports: Supports,
    pub(in crate::build) bolt: Bolt,
    /// Whether the project has a section on supports. Where it has none, usual supports are made
    /// if they can be, and nothing is said about them.
    pub(in crate::build) asked: bool,
}

type SupportNeeds = (Node<Plan>, Vec<Node<Plan>>, Vec<Node<()>>);

/// Supports.
pub(in crate::build) const SUPPORTS: Stage<SupportInput, SupportNeeds, Vec<SupportRecord>> =
    Stage {
        name: "supports",
        version: 2,
        numerics: Numerics::Portable,
        run: |input, (skeleton, chapters, _), _| {
            let plan = bind("", std::iter::once(skeleton).chain(chapters));
            let inputs = SupportInputs {
                supports: &input.supports,
                bolt: &input.bolt,
            };
            let made = supports::records(&plan, inputs);
            if input.asked {
                outcome(made)
            } else {
                plain(made.map(|made| made.value).unwrap_or_default())
            }
        },
    };

/// What the bill depends on besides the plan.
#[derive(Debug, Serialize)]
pub(in crate::build) struct BillInput {
    pub(in crate::build) hardware: Hardware,
    pub(in crate::build) materials: Vec<Material>,
    pub(in crate::build) stock: Stock,
}

type BillNeeds = (
    Vec<Node<Plan>>,
    Node<Nest>,
    Node<Foils>,
    Node<Vec<SupportRecord>>,
);

/// The bill of materials.
pub(in crate::build) const BILL: Stage<BillInput, BillNeeds, Vec<BomRow>> = Stage {
    name: "bill",
    version: 4,
    numerics: Numerics::Portable,
    run: |input, (chapters, nest, foils, supports), _| {
        let mut plan = bind("", chapters.into_iter());
        equip(&mut plan, foils, supports);
        let shopping = Shopping {
            hardware: &input.hardware,
            materials: &input.materials,
            stock: &input.stock,
            groups: &nest.groups,
        };
        outcome(bom::rows(&plan, &shopping))
    },
};

/// Puts stickers and supports into a plan.
pub(in crate::build) fn equip(plan: &mut Plan, foils: &Foils, supports: &[SupportRecord]) {
    plan.stickers.clone_from(&foils.stickers);
    plan.foils.clone_from(&foils.sheets);
    plan.supports = supports.to_vec();
}

/// `plan.ron`.
pub(in crate::build) const PLAN_FILE: Stage<(), Node<Plan>, Files> = Stage {
    name: "plan-file",
    version: 2,
    numerics: Numerics::Portable,
    run: |(), plan, _| plain(Files::new().with("plan.ron", to_ron(plan))),
};

/// What a workshop would object to in the lamellae of a patch.
pub(in crate::build) const WORKSHOP: Stage<Workshop, Node<Plan>, ()> = Stage {
    name: "workshop",
    version: 4,
    numerics: Numerics::Portable,
    run: |workshop, chapter, _| outcome(outputs::check(chapter, workshop)),
};

/// The cladding functions of a patch, as a plot and as a document.
pub(in crate::build) const CLADDING_FILES: Stage<(), Node<Plan>, Files> = Stage {
    name: "cladding-files",
    version: 2,
    numerics: Numerics::Portable,
    run: |(), chapter, _| files(outputs::cladding_files(chapter)),
};

/// What the flat layout of a patch depends on besides it.
#[derive(Debug, Serialize)]
pub(in crate::build) struct LayoutInput {
    /// Of the project.
    pub(in crate::build) name: String,
    pub(in crate::build) bolt_diameter: f64,
}

/// The flat layout of a patch.
pub(in crate::build) const LAYOUT_FILES: Stage<LayoutInput, Node<Plan>, Files> = Stage {
    name: "layout-files",
    version: 4,
    numerics: Numerics::Portable,
    run: |input, chapter, _| {
        let plan = bind(&input.name, std::iter::once(chapter));
        files(outputs::layout_files(&plan, input.bolt_diameter))
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

/// What drawings of sheets depend on besides the plan.
#[derive(Debug, Serialize)]
pub(in crate::build) struct SheetInput {
    /// Of the project.
    pub(in crate::build) name: String,
    pub(in crate::build) settings: SheetSettings,
}

/// Cut files and overviews of all sheets.
pub(in crate::build) const SHEET_FILES: Stage<SheetInput, (Vec<Node<Plan>>, Node<Nest>), Files> =
    Stage {
        name: "sheet-files",
        version: 5,
        numerics: Numerics::Portable,
        run: |input, (chapters, nest), _| {
            let mut plan = bind(&input.name, chapters.into_iter());
            plan.sheets.clone_from(&nest.sheets);
            plan.nesting = nest.records();
            let Warned {
                value: parts,
                mut warnings,
            } = outputs::parts(&plan, input.settings.parts);
            let by_id = parts.iter().map(|part| (part.id.as_str(), part)).collect();
            let mut made = Files::new();
            let mut take = |drawn: Checked<Vec<OutputFile>>| {
                let drawn = drawn.map_err(Failure::Errors)?;
                warnings.extend(drawn.warnings);
                for OutputFile { path, bytes } in drawn.value {
                    made.push(path, bytes);
                }
                Ok::<(), Failure>(())
            };
            for sheet in &plan.sheets {
                take(outputs::sheet_files(&plan, sheet, &by_id, &input.settings))?;
            }
            take(outputs::overview_files(&plan, &by_id, &input.settings))?;
            judged(made, warnings)
        },
    };

/// How single parts are drawn.
#[derive(Debug, Serialize)]
pub(in crate::build) struct PartInput {
    pub(in crate::build) style: PartStyle,
    pub(in crate::build) colours: ColourPreset,
}

/// Every part of a patch as a file of its own.
pub(in crate::build) const PART_FILES: Stage<PartInput, Node<Plan>, Files> = Stage {
    name: "part-files",
    version: 2,
    numerics: Numerics::Portable,
    run: |input, chapter, _| files(outputs::part_files(chapter, input.style, input.colours)),
};

/// What coupons depend on.
#[derive(Debug, Serialize)]
pub(in crate::build) struct CouponInput {
    pub(in crate::build) sections: Vec<CouponSection>,
    pub(in crate::build) hardware: Hardware,
    pub(in crate::build) colours: ColourPreset,
}

/// Test pieces for kerf and fit.
pub(in crate::build) const COUPON_FILES: Stage<CouponInput, (), Files> = Stage {
    name: "coupon-files",
    version: 3,
    numerics: Numerics::Portable,
    run: |input, (), _| {
        let CouponInput {
            sections,
            hardware,
            colours,
        } = input;
        files(outputs::coupon_files(sections, hardware, *colours))
    },
};

/// What drawings of foils and supports depend on besides the plan.
#[derive(Debug, Serialize)]
pub(in crate::build) struct DrawingInput {
    /// Of the project.
    pub(in crate::build) name: String,
    pub(in crate::build) colours: ColourPreset,
}

/// Cut files of the sheets of foil.
pub(in crate::build) const STICKER_FILES: Stage<DrawingInput, Node<Foils>, Files> = Stage {
    name: "sticker-files",
    version: 3,
    numerics: Numerics::Portable,
    run: |input, foils, _| {
        let mut plan = bind(&input.name, std::iter::empty());
        equip(&mut plan, foils, &[]);
        files(outputs::sticker_files(&plan, input.colours))
    },
};

type SupportFilesNeeds = (Node<Plan>, Vec<Node<Plan>>, Node<Vec<SupportRecord>>);

/// Solids, drawings and the ground plan of the supports.
pub(in crate::build) const SUPPORT_FILES: Stage<DrawingInput, SupportFilesNeeds, Files> = Stage {
    name: "support-files",
    version: 3,
    numerics: Numerics::Portable,
    run: |input, (skeleton, chapters, supports), _| {
        let mut plan = bind(&input.name, std::iter::once(skeleton).chain(chapters));
        equip(&mut plan, &Foils::default(), supports);
        files(outputs::support_files(&plan, input.colours))
    },
};

/// What tables depend on besides the plan.
#[derive(Debug, Serialize)]
pub(in crate::build) struct TableInput {
    pub(in crate::build) hardware: Hardware,
    pub(in crate::build) woods: Woods,
}

/// The tables and the step list.
pub(in crate::build) const TABLE_FILES: Stage<TableInput, Node<Plan>, Files> = Stage {
    name: "table-files",
    version: 5,
    numerics: Numerics::Portable,
    run: |input, plan, _| {
        let TableInput { hardware, woods } = input;
        let mut made = outputs::table_files(plan, hardware, woods);
        made.push(outputs::assembly_file(plan, hardware));
        files(Ok(Warned {
            value: made,
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
