//! A made-up project with the shape of a real one: a surface, patches that may be a result, heavy
//! maps, members, drawings, sheets whose number depends on the result, a bill of materials.

#![allow(dead_code, reason = "the benchmark uses a part of it")]

use egg::build::{Failure, Files, Graph, Node, Numerics, Stage};
use egg::diagnostics::{Code, Diagnostic, Warned};
use serde::{Deserialize, Serialize};
use std::time::Duration;

/// What a designer edits.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Design {
    pub(crate) mesh: Vec<f64>,
    pub(crate) patches: Vec<Patch>,
    pub(crate) width: f64,
    pub(crate) modulus: f64,
    pub(crate) price: f64,
    pub(crate) kerf: f64,
    /// How long each patch's maps take.
    pub(crate) millis: u64,
    /// Number of values of each map.
    pub(crate) size: u32,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Patch {
    pub(crate) name: String,
    pub(crate) corner: f64,
    /// 13 fails, more than 20 warns.
    pub(crate) members: u32,
}

impl Default for Design {
    fn default() -> Self {
        Self::with_patches(3)
    }
}

impl Design {
    pub(crate) fn with_patches(count: u32) -> Self {
        Self {
            mesh: (0..64).map(f64::from).collect(),
            patches: (0..count)
                .map(|index| Patch {
                    name: format!("p{index}"),
                    corner: f64::from(index),
                    members: 5 + index % 4,
                })
                .collect(),
            width: 0.03,
            modulus: 7.6e9,
            price: 12.5,
            kerf: 0.000_15,
            millis: 0,
            size: 2000,
        }
    }

    /// The whole graph.
    pub(crate) fn declare<'p>(&'p self, g: &mut Graph<'p>) {
        let surface = g.add(&SURFACE, "", self.mesh.clone(), ());
        g.origin(surface, "", "surface.mesh");
        let names: Vec<_> = self.patches.iter().map(|p| p.name.clone()).collect();
        let layout = g.add(&LAYOUT, "", names, surface);
        g.unfold(layout, move |g, names: &Vec<String>| {
            let patches = names
                .iter()
                .map(|name| self.declare_patch(g, surface, name));
            let (members, summaries): (Vec<_>, Vec<_>) = patches.flatten().unzip();
            let warnings: Vec<_> = members.iter().map(|node| node.warnings()).collect();
            let plan = g.add(&PLAN, "", self.width, (members, warnings));
            let plan_file = g.add(&PLAN_FILE, "", (), plan);
            g.publish(plan_file);
            let sheets = g.add(&SHEETS, "", self.kerf, plan);
            g.origin(sheets, "", "fabrication.kerf");
            g.publish(sheets);
            let bom = g.add(&BOM, "", self.price, summaries);
            g.origin(bom, "", "materials.ash.price");
            g.publish(bom);
        });
    }

    fn declare_patch(
        &self,
        g: &mut Graph<'_>,
        surface: Node<Vec<f64>>,
        name: &str,
    ) -> Option<(Node<Vec<f64>>, Node<Summary>)> {
        let patch = self.patches.iter().find(|patch| patch.name == name)?;
        let input = Maps {
            corner: patch.corner,
            size: self.size,
            millis: self.millis,
        };
        let maps = g.add(&MAPS, name, input, surface);
        g.origin(maps, "corner", format!("patches.{name}.corners"));
        let count = Count {
            count: patch.members,
        };
        let members = g.add(&MEMBERS, name, count, maps);
        g.origin(members, "count", format!("patches.{name}.members"));
        let statics = g.add(&STATICS, name, self.modulus, (members, maps));
        let summary = g.add(&SUMMARY, name, (), members);
        let drawing = g.add(
            &DRAWING,
            name,
            (name.to_owned(), self.width),
            (members, statics),
        );
        g.publish(drawing);
        Some((members, summary))
    }
}

#[derive(Serialize)]
pub(crate) struct Maps {
    corner: f64,
    size: u32,
    millis: u64,
}

#[derive(Serialize)]
pub(crate) struct Count {
    count: u32,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Summary {
    pub(crate) members: u32,
    /// Whole metres: a small move of a corner leaves it as it is.
    pub(crate) metres: i64,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct PlanDocument {
    pub(crate) width: f64,
    pub(crate) members: Vec<Vec<f64>>,
    pub(crate) warnings: Vec<String>,
}

fn plain<T>(value: T) -> Warned<T> {
    Warned {
        value,
        warnings: Vec::new(),
    }
}

pub(crate) const SURFACE: Stage<Vec<f64>, (), Vec<f64>> = Stage {
    name: "surface",
    version: 1,
    numerics: Numerics::Portable,
    run: |mesh, (), _| {
        if mesh.is_empty() {
            return Err(error("the mesh is empty"));
        }
        Ok(plain(mesh.iter().map(|x| x * 0.5).collect()))
    },
};

pub(crate) const LAYOUT: Stage<Vec<String>, Node<Vec<f64>>, Vec<String>> = Stage {
    name: "layout",
    version: 1,
    numerics: Numerics::Portable,
    run: |names, _, _| Ok(plain(names.clone())),
};

pub(crate) const MAPS: Stage<Maps, Node<Vec<f64>>, Vec<f64>> = Stage {
    name: "maps",
    version: 1,
    numerics: Numerics::Portable,
    run: |input, surface, context| {
        for step in 0..input.millis {
            context.check()?;
            context.progress(step, input.millis);
            std::thread::sleep(Duration::from_millis(1));
        }
        let at = |i: u32| surface[i as usize % surface.len()] + input.corner * f64::from(i);
        Ok(plain((0..input.size).map(at).collect()))
    },
};

pub(crate) const MEMBERS: Stage<Count, Node<Vec<f64>>, Vec<f64>> = Stage {
    name: "members",
    version: 1,
    numerics: Numerics::Portable,
    run: |input, maps, _| {
        if input.count == 13 {
            let told = Diagnostic::error(Code::new("E0999"), "13 members are unlucky");
            return Err(told.at_key(".count", "here").into());
        }
        let step = maps.len() / input.count.max(1) as usize;
        let members = maps.iter().step_by(step.max(1)).copied().collect();
        let mut told = plain(members);
        if input.count > 20 {
            let warning = Diagnostic::warning(Code::new("W0999"), "many members");
            told.warnings.push(warning.at_key(".count", "here"));
        }
        Ok(told)
    },
};

type Values = Node<Vec<f64>>;

pub(crate) const STATICS: Stage<f64, (Values, Values), f64> = Stage {
    name: "statics",
    version: 1,
    numerics: Numerics::Processor,
    run: |modulus, (members, maps), _| {
        let sum: f64 = members.iter().chain(maps).sum();
        Ok(plain(sum / modulus))
    },
};

pub(crate) const SUMMARY: Stage<(), Node<Vec<f64>>, Summary> = Stage {
    name: "summary",
    version: 1,
    numerics: Numerics::Portable,
    run: |(), members, _| {
        Ok(plain(Summary {
            members: members.len() as u32,
            metres: members.iter().sum::<f64>() as i64 / 1000,
        }))
    },
};

pub(crate) const DRAWING: Stage<(String, f64), (Values, Node<f64>), Files> = Stage {
    name: "drawing",
    version: 1,
    numerics: Numerics::Portable,
    run: |(name, width), (members, statics), _| {
        let text = format!("{name} {width} {statics:e} {members:?}\n");
        Ok(plain(
            Files::new().with(format!("drawings/{name}.svg"), text),
        ))
    },
};

pub(crate) const PLAN: Stage<f64, PlanNeeds, PlanDocument> = Stage {
    name: "plan",
    version: 1,
    numerics: Numerics::Portable,
    run: |width, (members, warnings), _| {
        Ok(plain(PlanDocument {
            width: *width,
            members: members.into_iter().cloned().collect(),
            warnings: warnings
                .into_iter()
                .flatten()
                .map(|warning| warning.message.clone())
                .collect(),
        }))
    },
};
type PlanNeeds = (Vec<Values>, Vec<egg::build::Warnings>);

pub(crate) const PLAN_FILE: Stage<(), Node<PlanDocument>, Files> = Stage {
    name: "plan-file",
    version: 1,
    numerics: Numerics::Portable,
    run: |(), plan, _| Ok(plain(Files::new().with("plan.txt", format!("{plan:?}\n")))),
};

pub(crate) const SHEETS: Stage<f64, Node<PlanDocument>, Files> = Stage {
    name: "sheets",
    version: 1,
    numerics: Numerics::Portable,
    run: |kerf, plan, _| {
        let mut files = Files::new();
        let members: usize = plan.members.iter().map(Vec::len).sum();
        for sheet in 0..members.div_ceil(8) {
            let text = format!("sheet {sheet} of {members} with {kerf}\n");
            files.push(format!("fabrication/sheet-{sheet:02}.dxf"), text);
        }
        Ok(plain(files))
    },
};

pub(crate) const BOM: Stage<f64, Vec<Node<Summary>>, Files> = Stage {
    name: "bom",
    version: 1,
    numerics: Numerics::Portable,
    run: |price, summaries, _| {
        let rows = summaries.iter();
        let rows: Vec<String> = rows
            .map(|one| format!("{};{};{price}\n", one.members, one.metres))
            .collect();
        let text = rows.concat();
        Ok(plain(Files::new().with("bom.csv", text)))
    },
};

fn error(message: &str) -> Failure {
    Diagnostic::error(Code::new("E0998"), message).into()
}
