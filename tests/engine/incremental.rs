//! An edit runs what it touches and nothing else; what is told does not depend on what ran.

use crate::project::{Design, LAYOUT, MEMBERS, PLAN, Patch, SURFACE};
use crate::workshop::{Workshop, clean, ran};
use egg::build::{Force, How, Reason, Request, State};
use egg::diagnostics::Place;

const ALL: usize = 21;

#[test]
fn a_second_build_runs_nothing_and_writes_nothing() {
    let workshop = Workshop::new();
    let design = Design::default();
    let first = workshop.build(&design);
    assert!(first.succeeded(), "{:?}", first.diagnostics);
    assert_eq!(first.count(How::Ran), ALL);
    assert_eq!(
        first.publication.written,
        [
            "bom.csv",
            "drawings/p0.svg",
            "drawings/p1.svg",
            "drawings/p2.svg",
            "fabrication/sheet-00.dxf",
            "fabrication/sheet-01.dxf",
            "fabrication/sheet-02.dxf",
            "plan.txt",
        ]
    );
    let second = workshop.build(&design);
    assert_eq!(second.count(How::Cached), ALL);
    assert!(second.publication.written.is_empty());
    assert_eq!(second.publication.unchanged, 8);
    assert!(workshop.plan(&design).is_idle());
}

#[test]
fn a_build_with_nothing_to_do_opens_no_result() {
    let workshop = Workshop::new();
    let mut design = Design::default();
    design.patches[0].members = 21;
    let first = workshop.build(&design);
    std::fs::remove_dir_all(workshop.settings.cache.join("v1/blobs")).expect("removed");
    std::fs::remove_dir_all(workshop.settings.cache.join("v1/traces")).expect("removed");
    let second = workshop.build(&design);
    assert_eq!(second.count(How::Cached), ALL);
    assert_eq!(second.diagnostics, first.diagnostics);
    assert_eq!(second.diagnostics.len(), 1, "its warning is told as well");
}

#[test]
fn each_edit_runs_exactly_what_depends_on_it() {
    type Edit = fn(&mut Design);
    let edits: [(&str, Edit, &[&str]); 10] = [
        ("nothing", |_| {}, &[]),
        ("price", |d| d.price = 13.0, &["bom"]),
        ("kerf", |d| d.kerf = 0.000_2, &["sheets"]),
        (
            "modulus",
            |d| d.modulus = 8e9,
            &[
                "statics p0",
                "drawing p0",
                "statics p1",
                "drawing p1",
                "statics p2",
                "drawing p2",
            ],
        ),
        (
            "width",
            |d| d.width = 0.04,
            &[
                "drawing p0",
                "drawing p1",
                "drawing p2",
                "plan",
                "plan-file",
                "sheets",
            ],
        ),
        (
            "members of a patch",
            |d| d.patches[1].members = 9,
            &[
                "members p1",
                "statics p1",
                "summary p1",
                "drawing p1",
                "plan",
                "plan-file",
                "sheets",
                "bom",
            ],
        ),
        (
            // The summary rounds, so the bill of materials stays.
            "a corner moved a little",
            |d| d.patches[2].corner += 1e-7,
            &[
                "maps p2",
                "members p2",
                "statics p2",
                "summary p2",
                "drawing p2",
                "plan",
                "plan-file",
                "sheets",
            ],
        ),
        (
            // Named by nothing but its drawing.
            "a patch renamed",
            |d| d.patches[0].name = "west".into(),
            &["layout", "drawing west"],
        ),
        (
            "a patch added",
            |d| {
                d.patches.push(Patch {
                    name: "p3".into(),
                    corner: 7.0,
                    members: 6,
                });
            },
            &[
                "layout",
                "maps p3",
                "members p3",
                "statics p3",
                "summary p3",
                "drawing p3",
                "plan",
                "plan-file",
                "sheets",
                "bom",
            ],
        ),
        (
            "a patch removed",
            |d| drop(d.patches.remove(1)),
            &["layout", "plan", "plan-file", "sheets", "bom"],
        ),
    ];
    for (name, edit, expected) in edits {
        let workshop = Workshop::new();
        let mut design = Design::default();
        workshop.build(&design);
        edit(&mut design);
        let built = workshop.build(&design);
        assert_eq!(ran(&built), expected, "{name}");
        assert_eq!(workshop.outputs(), clean(&design), "{name}");
    }
}

#[test]
fn a_mesh_edit_that_changes_no_value_stops_at_the_surface() {
    let workshop = Workshop::new();
    let mut design = Design::default();
    workshop.build(&design);
    design.mesh[0] = -0.0;
    assert!(ran(&workshop.build(&design)).is_empty(), "-0.0 is 0.0");
    // Half of the smallest number is 0.0.
    design.mesh[0] = f64::from_bits(1);
    assert_eq!(ran(&workshop.build(&design)), ["surface"]);
}

#[test]
fn going_back_to_an_earlier_state_runs_nothing() {
    let workshop = Workshop::new();
    let first = Design::default();
    let mut second = first.clone();
    second.mesh[3] = 99.0;
    workshop.build(&first);
    workshop.build(&second);
    assert!(ran(&workshop.build(&first)).is_empty());
    assert!(ran(&workshop.build(&second)).is_empty());
    assert_eq!(workshop.outputs(), clean(&second));
}

#[test]
fn another_folder_and_another_worktree_find_everything() {
    let mut workshop = Workshop::new();
    let design = Design::default();
    workshop.build(&design);
    let before = workshop.outputs();
    let moved = workshop.path().join("elsewhere");
    std::fs::rename(&workshop.settings.output, &moved).expect("renamed");
    workshop.settings.output = moved;
    let built = workshop.build(&design);
    assert_eq!(built.count(How::Cached), ALL);
    assert!(
        built.publication.written.is_empty(),
        "the files moved along"
    );
    workshop.settings.output = workshop.path().join("clone");
    let built = workshop.build(&design);
    assert_eq!(built.count(How::Cached), ALL);
    assert_eq!(workshop.outputs(), before);
}

#[test]
fn warnings_and_errors_are_told_again_without_running() {
    let workshop = Workshop::new();
    let mut design = Design::default();
    design.patches[0].members = 21;
    design.patches[1].members = 13;
    let first = workshop.build(&design);
    assert!(!first.succeeded());
    let how = |name: &str| {
        let stages = first.stages.iter();
        let mut named = stages.filter(|stage| stage.instance.to_string() == name);
        named.next().map(|stage| stage.how)
    };
    assert_eq!(how("members p1"), Some(How::Failed));
    assert_eq!(how("drawing p1"), Some(How::Skipped));
    assert_eq!(how("plan"), Some(How::Skipped));
    assert_eq!(how("drawing p2"), Some(How::Ran), "others go on");
    assert_eq!(
        first.publication.written,
        ["drawings/p0.svg", "drawings/p2.svg"]
    );
    let told: Vec<_> = first
        .diagnostics
        .iter()
        .map(|told| (told.code.as_str(), told.subject.as_deref().unwrap_or("")))
        .collect();
    assert_eq!(told, [("W0999", "p0"), ("E0999", "p1")]);
    assert_eq!(
        first.diagnostics[1].labels[0].place,
        Place::Key("patches.p1.members".into()),
        "a field of the input is told as a key of the project"
    );
    let second = workshop.build(&design);
    assert!(ran(&second).is_empty());
    assert_eq!(second.count(How::FailedCached), 1);
    assert_eq!(second.diagnostics, first.diagnostics);
}

#[test]
fn a_failed_build_keeps_the_earlier_files_of_what_failed() {
    let workshop = Workshop::new();
    let mut design = Design::default();
    workshop.build(&design);
    let before = workshop.outputs();
    design.patches[1].members = 13;
    design.price = 99.0;
    let built = workshop.build(&design);
    assert!(built.publication.written.is_empty());
    assert!(built.publication.removed.is_empty());
    assert_eq!(workshop.outputs(), before);
    design.patches[1].members = 5;
    workshop.build(&design);
    assert_eq!(workshop.outputs(), clean(&design));
}

#[test]
fn when_the_first_stage_fails_nothing_is_removed() {
    let workshop = Workshop::new();
    let mut design = Design::default();
    workshop.build(&design);
    let before = workshop.outputs();
    design.mesh.clear();
    let built = workshop.build(&design);
    assert_eq!(ran(&built), ["surface"]);
    assert_eq!(workshop.outputs(), before);
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let mut design = Design::with_patches(8);
    design.patches[3].members = 25;
    let mut results = Vec::new();
    for jobs in [1, 2, 8] {
        let mut workshop = Workshop::new();
        workshop.settings.jobs = jobs;
        let built = workshop.build(&design);
        results.push((workshop.outputs(), built.diagnostics));
    }
    assert_eq!(results[0], results[1]);
    assert_eq!(results[0], results[2]);
}

#[test]
fn a_request_for_one_patch_leaves_the_others_alone() {
    let workshop = Workshop::new();
    let mut design = Design::default();
    workshop.build(&design);
    let before = workshop.outputs();
    design.modulus = 1e9;
    let request = Request {
        targets: vec!["p1".into()],
        ..Request::default()
    };
    let built = workshop.request(&design, &request);
    assert_eq!(ran(&built), ["statics p1", "drawing p1"]);
    assert_eq!(built.publication.written, ["drawings/p1.svg"]);
    assert!(built.publication.removed.is_empty());
    assert_eq!(workshop.outputs().len(), before.len());
    let request = Request {
        targets: vec!["p1".into()],
        stages: vec!["maps".into()],
        ..Request::default()
    };
    let built = workshop.request(&design, &request);
    let named: Vec<_> = built
        .stages
        .iter()
        .map(|stage| stage.instance.to_string())
        .collect();
    assert_eq!(named, ["surface", "layout", "maps p1"]);
    let rest = workshop.build(&design);
    assert_eq!(
        ran(&rest),
        ["statics p0", "drawing p0", "statics p2", "drawing p2"]
    );
    assert_eq!(workshop.outputs(), clean(&design));
}

#[test]
fn a_request_for_something_unknown_is_an_error_with_the_nearest_names() {
    let workshop = Workshop::new();
    let design = Design::default();
    let mut request = Request {
        targets: vec!["p1x".into()],
        stages: vec!["members".into()],
        ..Request::default()
    };
    let built = workshop.request(&design, &request);
    let told = &built.diagnostics[0];
    assert_eq!(told.code.as_str(), "E0810");
    assert_eq!(told.message, "there is no target `p1x`");
    assert_eq!(told.help.as_deref(), Some("did you mean `p1`?"));
    request.targets = vec!["p1".into()];
    request.stages = vec!["surface".into()];
    let built = workshop.request(&design, &request);
    assert_eq!(
        built.diagnostics[0].message,
        "none of the stages is done for any of the targets"
    );
}

#[test]
fn forcing_runs_what_is_selected_and_finds_it_the_same() {
    let workshop = Workshop::new();
    let design = Design::default();
    workshop.build(&design);
    let request = Request {
        stages: vec!["maps".into()],
        force: Force::Selected,
        ..Request::default()
    };
    let built = workshop.request(&design, &request);
    assert_eq!(ran(&built), ["maps p0", "maps p1", "maps p2"]);
    assert!(built.diagnostics.is_empty());
    let forced = built.stages.iter().filter(|one| one.how == How::Ran);
    for stage in forced {
        assert_eq!(stage.reasons, [Reason::Forced]);
    }
    let everything = Request {
        force: Force::Selected,
        ..Request::default()
    };
    let built = workshop.request(&design, &everything);
    assert_eq!(built.count(How::Ran), ALL);
    assert!(built.publication.written.is_empty());
}

#[test]
fn results_can_be_fetched_by_stage_and_target() {
    let workshop = Workshop::new();
    let design = Design::default();
    let first = workshop.build(&design);
    let second = workshop.build(&design);
    for built in [first, second] {
        let plan = built.output(&PLAN, "").expect("built");
        assert_eq!(plan.members.len(), 3);
        let members = built.output(&MEMBERS, "p1").expect("built");
        assert_eq!(*members, plan.members[1]);
        assert_eq!(built.output(&SURFACE, "").expect("built").len(), 64);
        assert_eq!(built.output(&LAYOUT, "").expect("built").len(), 3);
        assert!(built.output(&PLAN, "west").is_none());
    }
}

#[test]
fn a_developers_build_never_uses_results_of_other_code() {
    let mut workshop = Workshop::new();
    let design = Design::default();
    workshop.build(&design);
    workshop.settings.build_id = Some("a1".into());
    let built = workshop.build(&design);
    assert_eq!(built.count(How::Ran), ALL);
    assert_eq!(
        built.stages[0].reasons,
        [Reason::StageVersionChanged {
            old: "1".into(),
            new: "1 (a1)".into()
        }]
    );
    assert_eq!(workshop.build(&design).count(How::Cached), ALL);
}

#[test]
fn a_plan_says_what_the_build_then_does() {
    let workshop = Workshop::new();
    let mut design = Design::default();
    let plan = workshop.plan(&design);
    assert_eq!(plan.stages.len(), 2, "the rest is not known yet");
    assert_eq!(plan.open[0].to_string(), "layout");
    workshop.build(&design);

    design.mesh[0] = 5.0;
    let plan = workshop.plan(&design);
    let state = |name: &str| {
        let mut stages = plan.stages.iter();
        let found = stages.find(|stage| stage.instance.to_string() == name);
        found.expect("planned").state.clone()
    };
    assert_eq!(state("surface"), State::Run);
    assert!(matches!(state("layout"), State::Maybe { .. }));
    assert!(
        matches!(state("maps p1"), State::Maybe { after } if after[0].to_string() == "layout"),
        "known from the last build"
    );

    design.mesh[0] = 0.0;
    design.patches[1].members = 9;
    let plan = workshop.plan(&design);
    let named = |wanted: fn(&State) -> bool| -> Vec<String> {
        let stages = plan.stages.iter().filter(|stage| wanted(&stage.state));
        stages.map(|stage| stage.instance.to_string()).collect()
    };
    assert_eq!(named(|state| *state == State::Run), ["members p1"]);
    assert_eq!(
        named(|state| matches!(state, State::Maybe { .. })),
        [
            "statics p1",
            "summary p1",
            "drawing p1",
            "plan",
            "plan-file",
            "sheets",
            "bom"
        ]
    );
    let causes = plan.root_causes();
    assert_eq!(causes.len(), 1);
    assert_eq!(
        causes[0].reason.to_string(),
        "patches.p1.members 6 -> 9",
        "in terms of the project"
    );
}
