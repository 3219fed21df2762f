//! Both workflows on synthetic surfaces.

use crate::{bumps, grid, patch, point, single, surface};
use egg::cladding::Clad;
use egg::diagnostics::Diagnostic;
use egg::project::model::{Anchor, Workflow};
use egg::splitting::{Draft, NoSplit, SplitLimits, split};
use egg::surface::{Curvature, Mesh};

pub(crate) const LIMITS: SplitLimits = SplitLimits {
    workflow: Workflow::Automatic,
    eta_max: 1.0015,
    slope: [0.4, 2.5],
    min_side: None,
    max_patches: None,
    max_side: None,
};

pub(crate) fn run(mesh: &Mesh, draft: &Draft, limits: &SplitLimits) -> (Draft, Vec<Diagnostic>) {
    let surface = surface(mesh);
    let curvature = Curvature::estimate(&surface.mesh);
    let weaves = |_: &Draft, _: &[&Clad]| true;
    split(&surface, &curvature, draft, limits, &weaves, &|| false).expect("a result")
}

pub(crate) fn codes(told: &[Diagnostic]) -> Vec<&str> {
    told.iter().map(|d| d.code.as_str()).collect()
}

fn names(draft: &Draft) -> Vec<&str> {
    draft.patches.iter().map(|p| p.name.as_str()).collect()
}

/// The hill of `bump.obj`: long members pass beside its peak, short ones do not.
fn hill() -> (Mesh, Draft) {
    let mesh = bumps(&[[0.0, 0.0]], 3.0, 3.0, &grid([12.0, 9.0], [48, 36]));
    (mesh, single([11.0, 5.5], [9, 7]))
}

#[test]
fn what_is_feasible_is_left_alone() {
    let mesh = bumps(&[[0.0, 0.0]], 1.0, 3.0, &grid([12.0, 9.0], [48, 36]));
    let draft = single([6.0, 5.5], [9, 7]);
    for workflow in [Workflow::Off, Workflow::Automatic, Workflow::Informed] {
        let limits = SplitLimits { workflow, ..LIMITS };
        let (found, told) = run(&mesh, &draft, &limits);
        assert_eq!(found, draft);
        assert_eq!(told, []);
    }
}

#[test]
fn a_peak_that_one_family_passes_gets_a_side_over_it_in_both_workflows() {
    let (mesh, draft) = hill();
    for workflow in [Workflow::Automatic, Workflow::Informed] {
        let (found, told) = run(&mesh, &draft, &SplitLimits { workflow, ..LIMITS });
        assert_eq!(codes(&told), ["W0352"], "{told:#?}");
        assert_eq!(found.patches.len(), 2, "{found:#?}");
        let added = &found.points[4..];
        assert_eq!(added.len(), 2);
        for point in added {
            let Anchor::On { edge, at } = &point.anchor else {
                panic!("{point:?}")
            };
            assert!(["ab", "dc"].contains(&edge.concat().as_str()));
            assert_eq!(*at, 0.5);
        }
        // The side takes the place of a member: 8 spaces are shared as 4 and 4.
        assert!(found.patches.iter().all(|p| p.members == [5, 7]));
    }
}

#[test]
fn a_peak_that_both_families_pass_gets_a_corner() {
    let mesh = bumps(&[[0.0, 0.0]], 0.22, 0.15, &grid([0.55, 0.55], [44, 44]));
    let (found, _) = run(&mesh, &single([0.45, 0.45], [9, 9]), &LIMITS);
    let peak = found.points.iter().find(|p| p.name == "p-peak");
    let Anchor::Near([x, y, z]) = peak.expect("a corner on the peak").anchor else {
        panic!("{peak:?}")
    };
    assert!(x.abs() < 0.02 && y.abs() < 0.02 && (z - 0.22).abs() < 0.005);
    assert_eq!(&names(&found)[..1], ["p-1"]);
    assert!(
        found
            .patches
            .iter()
            .filter(|p| p.corners.contains(&"p-peak".to_owned()))
            .count()
            >= 4
    );
}

#[test]
fn mirror_images_are_split_alike() {
    // Two hills, a patch over each, a common side between them.
    let places = [[-11.0, 0.0], [11.0, 0.0]];
    let mesh = bumps(&places, 3.2, 3.0, &grid([23.0, 7.0], [92, 28]));
    let draft = Draft {
        points: vec![
            point("a", [-21.0, -5.5]),
            point("b", [0.0, -5.5]),
            point("c", [21.0, -5.5]),
            point("d", [21.0, 5.5]),
            point("e", [0.0, 5.5]),
            point("f", [-21.0, 5.5]),
        ],
        patches: vec![
            patch("east", ["b", "c", "d", "e"], [9, 7]),
            patch("west", ["a", "b", "e", "f"], [9, 7]),
        ],
    };
    for workflow in [Workflow::Automatic, Workflow::Informed] {
        let (found, _) = run(&mesh, &draft, &SplitLimits { workflow, ..LIMITS });
        let shares = |origin: &str, mirror: bool| -> Vec<String> {
            let mut shares: Vec<f64> = found
                .points
                .iter()
                .filter(|p| p.name.starts_with(origin))
                .filter_map(|p| match p.anchor {
                    Anchor::On { at, .. } => Some(if mirror { 1.0 - at } else { at }),
                    _ => None,
                })
                .collect();
            shares.sort_by(f64::total_cmp);
            shares.iter().map(|share| format!("{share:.3}")).collect()
        };
        assert!(!shares("west", false).is_empty());
        assert_eq!(shares("east", false), shares("west", true), "{workflow:?}");
        let parts = |origin: &str| {
            let parts = found.patches.iter().filter(|p| p.origin == origin);
            parts.count()
        };
        assert_eq!(parts("east"), parts("west"));
    }
}

#[test]
fn neighbours_across_a_cut_stay_whole_or_are_cut_at_the_same_anchor() {
    let places = [[0.0, -5.5], [0.0, 5.5]];
    let mesh = bumps(&places, 3.0, 3.0, &grid([12.0, 12.0], [48, 48]));
    let draft = Draft {
        points: vec![
            point("a", [-11.0, -11.0]),
            point("b", [11.0, -11.0]),
            point("c", [11.0, 0.0]),
            point("d", [-11.0, 0.0]),
            point("e", [11.0, 11.0]),
            point("f", [-11.0, 11.0]),
        ],
        patches: vec![
            patch("north", ["d", "c", "e", "f"], [9, 7]),
            patch("south", ["a", "b", "c", "d"], [9, 7]),
        ],
    };
    let (found, _) = run(&mesh, &draft, &LIMITS);
    assert_eq!(names(&found), ["north-1", "north-2", "south-1", "south-2"]);
    let middle: Vec<&str> = found
        .points
        .iter()
        .filter(|p| matches!(&p.anchor, Anchor::On { edge, .. } if edge.concat() == "dc"))
        .map(|p| p.name.as_str())
        .collect();
    assert_eq!(middle, ["north-s12"]);
    assert!(
        found
            .patches
            .iter()
            .all(|p| p.corners.iter().any(|c| c == "north-s12"))
    );
}

#[test]
fn limits_of_the_project_hold_and_what_is_left_is_told() {
    let (mesh, draft) = hill();
    let told_with = |limits: SplitLimits, draft: &Draft| {
        let (found, told) = run(&mesh, draft, &limits);
        assert_eq!(found, *draft);
        assert_eq!(codes(&told), ["W0351"]);
        format!("{:?}", told[0].notes)
    };
    let most = SplitLimits {
        max_patches: Some(1),
        ..LIMITS
    };
    assert!(told_with(most, &draft).contains("`split.max_patches`, 1"));
    let short = SplitLimits {
        min_side: Some(12.0),
        ..LIMITS
    };
    assert!(told_with(short, &draft).contains("shorter than `split.min_side`, 12 m"));
    let mut few = draft.clone();
    few.patches[0].members = [2, 7];
    assert!(told_with(LIMITS, &few).contains("u-family has too few members"));
    let mut own = draft;
    own.patches[0].alpha = Some(1.57);
    let slack = SplitLimits {
        eta_max: 1.1,
        ..LIMITS
    };
    assert!(told_with(slack, &own).contains("no cut makes it better"));
}

#[test]
fn splitting_stops_when_asked_and_leaves_what_cannot_be_measured() {
    let (mesh, mut draft) = hill();
    let surface = surface(&mesh);
    let curvature = Curvature::estimate(&surface.mesh);
    let weaves = |_: &Draft, _: &[&Clad]| true;
    let ended = split(&surface, &curvature, &draft, &LIMITS, &weaves, &|| true);
    assert!(matches!(ended, Err(NoSplit::Cancelled)));
    draft.patches[0].corners.swap(1, 2);
    let crossed = split(&surface, &curvature, &draft, &LIMITS, &weaves, &|| false);
    assert!(matches!(crossed, Err(NoSplit::Unmeasured)));
}

#[test]
fn the_number_of_threads_does_not_matter() {
    let (mesh, draft) = hill();
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.expect("a pool")
            .install(|| run(&mesh, &draft, &LIMITS))
    };
    assert_eq!(with(1), with(3));
}

#[test]
fn members_that_would_not_go_on_in_order_are_told() {
    let (mesh, mut draft) = hill();
    for point in &mut draft.points {
        if let Anchor::Above([x, _]) = &mut point.anchor {
            *x *= 0.5;
        }
    }
    let surface = surface(&mesh);
    let curvature = Curvature::estimate(&surface.mesh);
    let weaves = |_: &Draft, clads: &[&Clad]| clads.is_empty();
    let told = split(&surface, &curvature, &draft, &LIMITS, &weaves, &|| false);
    let (found, told) = told.expect("a result");
    assert_eq!(found, draft);
    assert_eq!(codes(&told), ["W0351"]);
    assert!(told[0].message.contains("go on in order"));
}
