//! Growing blocks around peaks (workflow 2): how far they reach, what lies beyond, and that what is
//! symmetric stays so.

use crate::workflows::{LIMITS, codes, run};
use crate::{bumps, grid, patch, single};
use egg::project::model::{Anchor, Workflow};
use egg::splitting::{Draft, DraftPatch, SplitLimits};
use egg::surface::Mesh;

const INFORMED: SplitLimits = SplitLimits {
    workflow: Workflow::Informed,
    ..LIMITS
};

/// A hill at x = -7 in an outline from x = -14 to 14.
fn off_the_middle() -> (Mesh, Draft) {
    let mesh = bumps(&[[-7.0, 0.0]], 3.2, 3.0, &grid([16.0, 7.0], [64, 28]));
    (mesh, single([14.0, 5.5], [13, 7]))
}

/// Shares of the anchors on a side of the outline, ascending.
fn shares(draft: &Draft, side: &str) -> Vec<f64> {
    let mut shares: Vec<f64> = draft
        .points
        .iter()
        .filter_map(|p| match &p.anchor {
            Anchor::On { edge, at } if edge.concat() == side => Some(*at),
            _ => None,
        })
        .collect();
    shares.sort_by(f64::total_cmp);
    shares
}

/// Whether the outline cut once from `ab` to `dc` leaves a feasible part on the side of the hill.
fn holds(mesh: &Mesh, whole: &Draft, share: f64) -> bool {
    let on = |name: &str, edge: [&str; 2]| egg::project::model::Point {
        name: name.into(),
        anchor: Anchor::On {
            edge: edge.map(Into::into),
            at: share,
        },
    };
    let mut draft = whole.clone();
    draft
        .points
        .extend([on("s", ["a", "b"]), on("t", ["d", "c"])]);
    draft.patches = vec![DraftPatch {
        members: [7, 7],
        ..patch("p", ["a", "s", "t", "d"], [7, 7])
    }];
    let off = SplitLimits {
        workflow: Workflow::Off,
        ..LIMITS
    };
    codes(&run(mesh, &draft, &off).1).is_empty()
}

#[test]
fn off_the_middle_one_patch_grows_from_the_circle_until_it_would_not_cover_the_hill() {
    let (mesh, draft) = off_the_middle();
    let (found, told) = run(&mesh, &draft, &INFORMED);
    assert_eq!(codes(&told), ["W0352"], "{told:#?}");
    // The hill in the first patch, and one patch beside it.
    assert_eq!(found.patches.len(), 2, "{found:#?}");
    let cut = shares(&found, "ab");
    let [cut] = cut[..] else { panic!("{cut:?}") };
    // The circle: the hill's K is (h/s²)², so that the patch on it reaches π s² / (h √2) beyond the
    // peak, which stands at 7 of 28.
    let circle = std::f64::consts::PI * 9.0 / (3.2 * std::f64::consts::SQRT_2);
    assert!(cut > (7.0 + circle) / 28.0, "{cut}");
    // It is as large as it can be, to a sixteenth of what lies beyond the circle.
    assert!(holds(&mesh, &draft, cut));
    let step = (21.0 - circle) / 28.0 / 16.0;
    assert!(!holds(&mesh, &draft, cut + 1.1 * step), "{cut} {step}");
}

#[test]
fn a_patch_grows_to_the_size_that_is_wanted() {
    let mesh = bumps(&[[0.0, 0.0]], 3.2, 3.0, &grid([22.0, 7.0], [88, 28]));
    let draft = single([20.0, 5.5], [17, 7]);
    let wanted = SplitLimits {
        max_side: Some(14.0),
        ..INFORMED
    };
    let (found, told) = run(&mesh, &draft, &wanted);
    // Nothing is left that is infeasible or larger: that would be told.
    assert_eq!(codes(&told), ["W0352"], "{told:#?}");
    // The hill in the middle, a patch on either side.
    assert_eq!(found.patches.len(), 3, "{found:#?}");
    let unlimited = run(&mesh, &draft, &INFORMED).0;
    assert!(unlimited.patches.len() <= found.patches.len());
}

#[test]
fn twins_are_parted_in_the_middle_by_both_workflows() {
    let places = [[-7.0, 0.0], [7.0, 0.0]];
    let mesh = bumps(&places, 3.2, 3.0, &grid([16.0, 7.0], [64, 28]));
    let draft = single([14.0, 5.5], [13, 7]);
    for workflow in [Workflow::Automatic, Workflow::Informed] {
        let limits = SplitLimits { workflow, ..LIMITS };
        let (found, told) = run(&mesh, &draft, &limits);
        assert_eq!(codes(&told), ["W0352"], "{told:#?}");
        for side in ["ab", "dc"] {
            let shares = shares(&found, side);
            let mirrored: Vec<f64> = shares.iter().rev().map(|share| 1.0 - share).collect();
            assert!(shares.contains(&0.5), "{workflow:?} {shares:?}");
            for (one, other) in shares.iter().zip(mirrored) {
                assert!((one - other).abs() < 1e-9, "{workflow:?} {shares:?}");
            }
        }
    }
}

#[test]
fn four_patches_around_a_corner_shrink_until_members_do_not_bunch() {
    let mesh = bumps(&[[0.0, 0.0]], 4.2, 3.0, &grid([14.0, 14.0], [56, 56]));
    let strict = SplitLimits {
        slope: [0.78, 1.28],
        ..INFORMED
    };
    let draft = single([12.0, 12.0], [17, 17]);
    let (found, told) = run(&mesh, &draft, &strict);
    assert_eq!(codes(&told), ["W0352"], "{told:#?}");
    let corner = |p: &&DraftPatch| p.corners.contains(&"p-peak".to_owned());
    let around = found.patches.iter().filter(corner).count();
    assert!(around == 4 || found.points.iter().all(|p| p.name != "p-peak"));
    for side in ["ab", "bc", "dc", "ad"] {
        let shares = shares(&found, side);
        let mirrored = shares.iter().rev().map(|share| 1.0 - share);
        for (one, other) in shares.iter().zip(mirrored) {
            assert!((one - other).abs() < 1e-9, "{side} {shares:?}");
        }
    }
}

#[test]
fn a_size_that_cannot_be_had_is_told() {
    let (mesh, draft) = off_the_middle();
    let few = SplitLimits {
        max_side: Some(4.0),
        max_patches: Some(3),
        ..INFORMED
    };
    let (found, told) = run(&mesh, &draft, &few);
    assert!(found.patches.len() <= 3);
    let left: Vec<&str> = told
        .iter()
        .filter(|d| d.code.as_str() == "W0351")
        .map(|d| d.message.as_str())
        .collect();
    assert!(!left.is_empty());
    assert!(
        left.iter().any(|m| m.contains("`split.max_side`")),
        "{left:?}"
    );
}
