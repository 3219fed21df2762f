//! Random edits: what is published is what a clean build publishes, and the plan does not lie.

use crate::project::{Design, Patch};
use crate::workshop::{Workshop, clean};
use egg::build::{How, MANIFEST, State};
use proptest::prelude::*;
use std::collections::BTreeMap;

#[derive(Debug, Clone)]
enum Edit {
    Mesh(usize, u8),
    Width(u8),
    Modulus(u8),
    Price(u8),
    Kerf(u8),
    Corner(usize, u8),
    Members(usize, u32),
    Add(u8),
    Remove(usize),
    Rename(usize, u8),
    Swap(usize, usize),
    /// Back to an earlier state.
    Undo(usize),
    /// A published file is lost or edited behind egg's back.
    Lose(usize),
    Scribble(usize),
    /// The cache's memory of this worktree, or all of it, is gone.
    Forget,
    Clean,
}

fn edits() -> impl Strategy<Value = Vec<Edit>> {
    let edit = prop_oneof![
        (0..64_usize, any::<u8>()).prop_map(|(i, v)| Edit::Mesh(i, v)),
        any::<u8>().prop_map(Edit::Width),
        any::<u8>().prop_map(Edit::Modulus),
        any::<u8>().prop_map(Edit::Price),
        any::<u8>().prop_map(Edit::Kerf),
        (0..9_usize, any::<u8>()).prop_map(|(i, v)| Edit::Corner(i, v)),
        (0..9_usize, 2..26_u32).prop_map(|(i, v)| Edit::Members(i, v)),
        (0..6_u8).prop_map(Edit::Add),
        (0..9_usize).prop_map(Edit::Remove),
        (0..9_usize, 0..6_u8).prop_map(|(i, v)| Edit::Rename(i, v)),
        (0..9_usize, 0..9_usize).prop_map(|(i, j)| Edit::Swap(i, j)),
        (0..9_usize).prop_map(Edit::Undo),
        (0..20_usize).prop_map(Edit::Lose),
        (0..20_usize).prop_map(Edit::Scribble),
        Just(Edit::Forget),
        Just(Edit::Clean),
    ];
    prop::collection::vec(edit, 1..12)
}

/// Applies an edit of the design; names of patches stay unique.
fn apply(design: &mut Design, edit: &Edit) {
    let count = design.patches.len();
    let taken = |design: &Design, name: &str| design.patches.iter().any(|p| p.name == name);
    match *edit {
        Edit::Mesh(index, value) => design.mesh[index] = f64::from(value),
        Edit::Width(value) => design.width = f64::from(value) * 1e-3,
        Edit::Modulus(value) => design.modulus = (f64::from(value) + 1.0) * 1e9,
        Edit::Price(value) => design.price = f64::from(value),
        Edit::Kerf(value) => design.kerf = f64::from(value) * 1e-5,
        Edit::Corner(index, value) if count > 0 => {
            design.patches[index % count].corner = f64::from(value) * 1e-4;
        }
        Edit::Members(index, value) if count > 0 => design.patches[index % count].members = value,
        Edit::Add(name) => {
            let name = format!("n{name}");
            if !taken(design, &name) {
                design.patches.push(Patch {
                    name,
                    corner: 0.5,
                    members: 7,
                });
            }
        }
        Edit::Remove(index) if count > 0 => drop(design.patches.remove(index % count)),
        Edit::Rename(index, name) if count > 0 => {
            let name = format!("n{name}");
            if !taken(design, &name) {
                design.patches[index % count].name = name;
            }
        }
        Edit::Swap(i, j) if count > 0 => design.patches.swap(i % count, j % count),
        _ => {}
    }
}

/// Does to the disk what an edit says.
fn meddle(workshop: &Workshop, edit: &Edit) {
    let outputs = workshop.outputs();
    let output = |index: usize| {
        let names: Vec<_> = outputs.keys().filter(|name| *name != MANIFEST).collect();
        let name = names.get(index % names.len().max(1))?;
        Some(workshop.settings.output.join(name))
    };
    match *edit {
        Edit::Lose(index) => {
            if let Some(path) = output(index) {
                std::fs::remove_file(path).expect("removed");
            }
        }
        Edit::Scribble(index) => {
            if let Some(path) = output(index) {
                std::fs::write(path, "scribble").expect("written");
            }
        }
        Edit::Forget => {
            let worktrees = workshop.settings.cache.join("v1/worktrees");
            std::fs::remove_dir_all(worktrees).ok();
        }
        Edit::Clean => {
            std::fs::remove_dir_all(&workshop.settings.cache).ok();
        }
        _ => {}
    }
}

/// What the output directory holds in the end, if every stage succeeds: what failed keeps its
/// earlier files, so only successful builds are comparable.
fn expected(design: &Design) -> Option<BTreeMap<String, Vec<u8>>> {
    let fails = design.patches.iter().any(|patch| patch.members == 13);
    (!fails).then(|| clean(design))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn incremental_bytes_are_clean_bytes(edits in edits()) {
        let workshop = Workshop::new();
        let mut design = Design { size: 300, ..Design::default() };
        let mut history = vec![design.clone()];
        workshop.build(&design);
        for edit in &edits {
            if let Edit::Undo(steps) = edit {
                design = history[history.len().saturating_sub(steps + 1)].clone();
            }
            apply(&mut design, edit);
            meddle(&workshop, edit);
            history.push(design.clone());

            let plan = workshop.plan(&design);
            let built = workshop.build(&design);
            for stage in &built.stages {
                let planned = plan.stages.iter().find(|one| one.instance == stage.instance);
                let ran = matches!(stage.how, How::Ran | How::Failed);
                match planned.map(|one| &one.state) {
                    Some(State::Cached | State::Failed | State::Skipped) => prop_assert!(!ran),
                    Some(State::Run | State::Maybe { .. }) => {}
                    // Beyond what has unfolded.
                    None => prop_assert!(!plan.open.is_empty()),
                }
            }
            if plan.is_idle() {
                prop_assert!(built.publication.written.is_empty());
                prop_assert!(built.publication.removed.is_empty());
            }
            prop_assert_eq!(
                plan.stages.iter().any(|one| one.state == State::Run),
                built.stages.iter().any(|one| matches!(one.how, How::Ran | How::Failed))
            );
            if let Some(expected) = expected(&design) {
                prop_assert_eq!(workshop.outputs(), expected);
            }
            prop_assert!(workshop.plan(&design).is_idle());
        }
    }
}
