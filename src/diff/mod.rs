//! What a change of a design does to its parts: the difference of two plans, made for review.
//!
//! ```text
//! plan ─ records ─► parts ─┐                         ┌─► text, Markdown
//!                          ├─► compare ─► Difference ┼─► SVG, HTML
//! plan ─ records ─► parts ─┘  renames     (JSON)     └─► JSON
//!          └─► lock, text for `git diff`
//! ```
//!
//! - [`between`] compares two sides, each a [`Plan`] or, where a plan cannot be had, a [`Lock`].
//! - The part model (`part`) and one function a record (`records`) say what is compared and what
//!   a change asks for ([`Class`]); a record that the plan gains is added there and nowhere else.
//! - Renderers know the [`Difference`] only, which is also what `--format json` writes.

mod class;
mod compare;
mod convert;
mod document;
mod drawing;
mod lock;
mod part;
mod quantity;
mod records;
mod renames;
mod render;
mod tolerance;
mod totals;

use crate::plan::Plan;

pub use class::Class;
pub use convert::{dxf_as_text, plan_as_text};
pub use document::{
    Action, Basis, Change, Count, Difference, Edit, FORMAT, FieldChange, Hidden, ItemChange,
    ReadError, Reading, Rename, Side, Summary, Total, schema,
};
pub use drawing::{Drawing, Label, Move, Outline, Shape, State};
pub use lock::{Lock, LockError, lock_text};
pub use part::Kind;
pub use quantity::{Quantity, number};
pub use render::html::html;
pub use render::markdown::{MARKDOWN_LIMIT, markdown, marker};
pub use render::svg::{svg, svg_of};
pub use render::text::{Look, text};
pub use render::words::phrases_of;
pub use tolerance::Tolerances;

/// What a side is compared by.
#[derive(Debug, Clone, Copy)]
pub enum Content<'a> {
    /// Everything.
    Plan(&'a Plan),
    /// Ids and headline values.
    Lock(&'a Lock),
}

/// What a comparison is told besides the two sides.
#[derive(Debug, Clone, Default)]
pub struct Context {
    /// What the sides are called.
    pub sides: [Side; 2],
    /// What is noise.
    pub tolerances: Tolerances,
    /// What was edited in the project file.
    pub edits: Vec<Edit>,
    /// What a reader must know.
    pub notes: Vec<String>,
    /// Whether overlays are wanted.
    pub pictures: Pictures,
}

/// Whether overlays are wanted.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Pictures {
    /// They are not: text and Markdown show none.
    #[default]
    Without,
    /// They are.
    With,
}

/// Compares two sides. Where one is a lock, both are compared by what a lock holds.
pub fn between(before: Content<'_>, after: Content<'_>, context: Context) -> Difference {
    if let (Content::Plan(before), Content::Plan(after)) = (before, after) {
        return between_plans(before, after, context);
    }
    let parts = [before, after].map(|content| match content {
        Content::Plan(plan) => Lock::of(plan).into_parts(),
        Content::Lock(lock) => lock.parts().to_vec(),
    });
    let names = [before, after].map(|content| match content {
        Content::Plan(plan) => (plan.name.clone(), Basis::Plan),
        Content::Lock(lock) => (lock.project().to_owned(), Basis::Lock),
    });
    let renames = renames::Renames::default();
    let compared = compare::compare(&parts[0], &parts[1], &renames, &context.tolerances);
    let totals = totals::of_parts(&parts[0], &parts[1]);
    bind(compared, &renames, totals, names, context)
}

fn between_plans(before: &Plan, after: &Plan, context: Context) -> Difference {
    let renames = renames::Renames::detect(before, after);
    let parts = [before, after].map(records::parts);
    let compared = compare::compare(&parts[0], &parts[1], &renames, &context.tolerances);
    let totals = totals::of_plans(before, after);
    let pictures = context.pictures;
    let names = [before, after].map(|plan| (plan.name.clone(), Basis::Plan));
    let mut difference = bind(compared, &renames, totals, names, context);
    if pictures == Pictures::With {
        difference.drawings = drawing::drawings(before, after, &renames, &difference.changes);
    }
    let said = |plan: &Plan| -> Vec<String> {
        plan.diagnostics
            .iter()
            .map(|told| format!("{}: {}", told.code, told.message))
            .collect()
    };
    let (old, new) = (said(before), said(after));
    difference.new_warnings = new
        .iter()
        .filter(|one| !old.contains(one))
        .cloned()
        .collect();
    difference.gone_warnings = old.into_iter().filter(|one| !new.contains(one)).collect();
    difference
}

fn bind(
    compared: compare::Compared,
    renames: &renames::Renames,
    totals: Vec<Total>,
    names: [(String, Basis); 2],
    context: Context,
) -> Difference {
    let [mut before, mut after] = context.sides;
    for (side, (project, basis)) in [&mut before, &mut after].into_iter().zip(names) {
        side.project = project;
        side.basis = basis;
    }
    let worst = compared.changes.iter().map(|change| change.class).max();
    Difference {
        format_version: FORMAT,
        before,
        after,
        tolerance: context.tolerances,
        summary: Summary {
            class: worst.filter(|class| *class > Class::Noise),
            counts: compared.counts,
            totals,
            hidden: compared.hidden,
        },
        edits: context.edits,
        renames: renames
            .named()
            .map(|(what, before, after)| Rename {
                what: what.to_owned(),
                before: before.to_owned(),
                after: after.to_owned(),
            })
            .collect(),
        changes: compared.changes,
        new_warnings: Vec::new(),
        gone_warnings: Vec::new(),
        notes: context.notes,
        drawings: Vec::new(),
    }
}
