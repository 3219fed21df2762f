//! Networks drawn by hand.

use super::*;
use proptest::prelude::*;

fn show(strips: &Strips) -> Vec<String> {
    let passage = |p: &Passage| {
        format!(
            "{}{}",
            p.patch,
            if p.family == Family::U { "u" } else { "v" }
        )
    };
    strips
        .strips
        .iter()
        .map(|strip| {
            let chain: Vec<_> = strip.passages.iter().map(passage).collect();
            format!(
                "{}{}",
                chain.join(" "),
                if strip.ring { " ring" } else { "" }
            )
        })
        .collect()
}

#[test]
fn families_chain_across_a_shared_side_in_any_orientation() {
    // Two quads side by side; the second starts anywhere and may turn the other way round.
    let east = ["b", "c", "f", "e"];
    for turn in 0..4 {
        for mirrored in [false, true] {
            let mut corners = east;
            corners.rotate_left(turn);
            if mirrored {
                corners.reverse();
            }
            let network = Network {
                patches: vec![["a", "b", "e", "d"], corners],
                on_edges: vec![],
            };
            let strips = network.strips();
            let shared = (0..4)
                .map(|number| Side { patch: 1, number })
                .find(|side| sorted(side.ends(&network)) == ["b", "e"])
                .expect("both have the side b-e");
            let west = Passage {
                patch: 0,
                family: Family::V,
            };
            assert_eq!(strips.of(west), strips.of(shared.passage()));
            assert_eq!(strips.strips.len(), 3);
        }
    }
}

#[test]
fn a_closed_chain_is_a_ring() {
    // Four patches around a drum: bottom a b c d, top e f g h.
    let network = Network {
        patches: vec![
            ["a", "b", "f", "e"],
            ["b", "c", "g", "f"],
            ["c", "d", "h", "g"],
            ["d", "a", "e", "h"],
        ],
        on_edges: vec![],
    };
    let strips = network.strips();
    assert_eq!(show(&strips), ["0u", "0v 1v 2v 3v ring", "1u", "2u", "3u"]);
}

#[test]
fn a_strip_is_listed_from_end_to_end_wherever_it_is_met_first() {
    let network = Network {
        patches: vec![
            ["b", "c", "g", "f"],
            ["a", "b", "f", "e"],
            ["c", "d", "h", "g"],
        ],
        on_edges: vec![],
    };
    let strips = network.strips();
    let chain = &strips.strips[strips
        .of(Passage {
            patch: 0,
            family: Family::V,
        })
        .expect("in a strip")];
    let patches: Vec<_> = chain.passages.iter().map(|passage| passage.patch).collect();
    assert!(patches == [1, 0, 2] || patches == [2, 0, 1], "{patches:?}");
    assert!(!chain.ring);
}

fn tee(on_edges: Vec<OnEdge<'static>>) -> Network<'static> {
    // Patch 0 has the long side a-b; 1 and 2 stand on its two parts.
    Network {
        patches: vec![
            ["d", "c", "b", "a"],
            ["a", "t", "q", "p"],
            ["t", "b", "r", "q"],
        ],
        on_edges,
    }
}

#[test]
fn parts_of_a_long_side_make_a_junction_in_the_order_of_the_long_side() {
    let network = tee(vec![OnEdge {
        point: "t",
        edge: ["b", "a"],
        at: 0.25,
    }]);
    let strips = network.strips();
    assert_eq!(show(&strips), ["0u", "0v", "1u", "1v 2v", "2u"]);
    // Side 3-4 of patch 0 runs from b to a, so the part at b comes first.
    assert_eq!(
        strips.junctions,
        [Junction {
            long: Side {
                patch: 0,
                number: 2
            },
            parts: vec![
                Side {
                    patch: 2,
                    number: 0
                },
                Side {
                    patch: 1,
                    number: 0
                }
            ],
            complete: true,
        }]
    );
    assert_eq!(strips.groups(), [vec![0, 2, 4], vec![1], vec![3]]);
    assert_eq!(tee(vec![]).strips().junctions, []);
}

#[test]
fn an_anchor_on_a_part_lies_on_the_whole_and_a_gap_leaves_the_junction_incomplete() {
    let mut network = tee(vec![
        OnEdge {
            point: "s",
            edge: ["a", "b"],
            at: 0.5,
        },
        OnEdge {
            point: "t",
            edge: ["s", "b"],
            at: 0.5,
        },
    ]);
    assert!(network.strips().junctions[0].complete);
    network.patches.pop();
    let junctions = network.strips().junctions;
    assert_eq!(junctions.len(), 1);
    assert!(!junctions[0].complete);
}

#[test]
fn three_sides_over_one_stretch_are_a_crowd_even_if_they_only_overlap() {
    let mut network = tee(vec![OnEdge {
        point: "t",
        edge: ["a", "b"],
        at: 0.5,
    }]);
    assert_eq!(network.strips().crowds, []);
    network.patches.push(["a", "b", "y", "x"]);
    assert_eq!(
        network.strips().crowds,
        [Crowd {
            sides: vec![
                Side {
                    patch: 0,
                    number: 2
                },
                Side {
                    patch: 1,
                    number: 0
                },
                Side {
                    patch: 3,
                    number: 0
                },
            ],
        }]
    );
}

proptest! {
    #[test]
    fn a_grid_of_quads_has_a_strip_for_each_row_and_column_however_its_patches_are_turned(
        rows in 1..6_usize,
        columns in 1..6_usize,
        turns in prop::collection::vec((0..4_usize, any::<bool>()), 25),
    ) {
        let name = |row: usize, column: usize| format!("{row}-{column}");
        let names: Vec<String> = (0..=rows)
            .flat_map(|row| (0..=columns).map(move |column| name(row, column)))
            .collect();
        let point = |row: usize, column: usize| names[row * (columns + 1) + column].as_str();
        let mut network = Network::default();
        for row in 0..rows {
            for column in 0..columns {
                let mut corners = [
                    point(row, column),
                    point(row, column + 1),
                    point(row + 1, column + 1),
                    point(row + 1, column),
                ];
                let (turn, mirror) = turns[row * 5 + column];
                corners.rotate_left(turn);
                if mirror {
                    corners.reverse();
                }
                network.patches.push(corners);
            }
        }
        let strips = network.strips();
        prop_assert_eq!(strips.strips.len(), rows + columns);
        prop_assert!(strips.strips.iter().all(|strip| !strip.ring));
        let mut lengths: Vec<usize> = strips.strips.iter().map(|s| s.passages.len()).collect();
        let mut expected = [vec![rows; columns], vec![columns; rows]].concat();
        lengths.sort_unstable();
        expected.sort_unstable();
        prop_assert_eq!(lengths, expected);
        // Neighbours in a strip share a side.
        for strip in &strips.strips {
            for pair in strip.passages.windows(2) {
                let [a, b] = [pair[0].patch, pair[1].patch].map(|patch| network.patches[patch]);
                prop_assert_eq!(a.iter().filter(|corner| b.contains(corner)).count(), 2);
            }
        }
    }
}
