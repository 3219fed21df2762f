//! The conditions that every plan keeps, recomputed from the written plan.

use crate::geometry::{PLACE, Polyline, ROUND, crossing, distance};
use egg::plan::{MemberRecord, OpeningRecord, PatchRecord, Plan};
use egg::project::model::Family;
use std::collections::BTreeMap;

/// A share of a length to which positions have to agree.
const AGREE: f64 = 1e-6;
/// A slide up to this is left to the clearance, metres.
const NO_SLIDE: f64 = 2e-5;

/// Asserts all conditions. `slope` are the bounds of the project, `bolt` and `slider` its cut
/// widths at a bolt that stays and at one that slides, metres.
pub(crate) fn hold(plan: &Plan, slope: [f64; 2], bolt: f64, slider: f64) {
    for member in &plan.members {
        has_equal_lengths(member);
    }
    sides_slide_nowhere(plan);
    pairs_cross_once(plan);
    members_continue(plan);
    openings_serve_crossings(plan, bolt, slider);
    for patch in &plan.patches {
        is_clad(patch, slope);
    }
}

/// Condition 1, as far as the plan itself tells: the path is as long as is said.
fn has_equal_lengths(member: &MemberRecord) {
    let id = &member.id;
    let surface = member.length_surface;
    assert!(
        (surface - member.length_planar).abs() <= AGREE * surface,
        "{id}"
    );
    let path = Polyline::new(member.polyline.iter().copied()).length();
    assert!(
        (path - surface).abs() < 3.0 * PLACE + ROUND,
        "{id}: {path} {surface}"
    );
    let [from, to] = member.planar;
    assert!(
        (distance(from, to) - member.length_planar).abs() < 2.0 * PLACE + ROUND,
        "{id}"
    );
}

/// Condition 2: connections of boundary members stay where they are.
fn sides_slide_nowhere(plan: &Plan) {
    let members = by_id(plan);
    let mut seen = 0;
    for crossing in &plan.crossings {
        for (id, on) in [(&crossing.u, crossing.on_u), (&crossing.v, crossing.on_v)] {
            let member = members[id.as_str()];
            if member.boundary {
                let slide = (on.surface - on.planar).abs();
                assert!(
                    slide <= AGREE * member.length_surface,
                    "{}: {slide}",
                    crossing.id
                );
                seen += 1;
            }
        }
    }
    assert!(seen >= 4 * plan.patches.len());
}

/// Condition 3: each u-member meets each v-member once, at the place that is said.
fn pairs_cross_once(plan: &Plan) {
    let lines: BTreeMap<&str, Polyline> = plan
        .members
        .iter()
        .map(|m| (m.id.as_str(), Polyline::new(m.polyline.iter().copied())))
        .collect();
    let members = by_id(plan);
    let of = |patch: &PatchRecord, family| {
        let own = plan.members.iter().filter(|m| m.patch == patch.id);
        own.filter(|m| m.family == family).count()
    };
    let pairs = plan
        .patches
        .iter()
        .map(|p| of(p, Family::U) * of(p, Family::V));
    assert_eq!(plan.crossings.len(), pairs.sum::<usize>());
    for record in &plan.crossings {
        let id = &record.id;
        let (u, v) = (members[record.u.as_str()], members[record.v.as_str()]);
        assert_eq!(u.patch, v.patch);
        let met = lines[u.id.as_str()].meetings(&lines[v.id.as_str()]);
        let [[on_u, on_v]] = met[..] else {
            panic!("{id}: the members meet at {met:?}")
        };
        let near = 6.0 * PLACE / libm::sin(record.angle_surface.to_radians());
        assert!((on_u - record.on_u.surface).abs() < near, "{id}: {on_u}");
        assert!((on_v - record.on_v.surface).abs() < near, "{id}: {on_v}");

        let shares = crossing(u.planar, v.planar).expect("members are not parallel");
        let near = 6.0 * PLACE / libm::sin(record.angle_planar.to_radians());
        for (share, member, on) in [(shares.x, u, record.on_u), (shares.y, v, record.on_v)] {
            let at = share * member.length_planar;
            assert!((at - on.planar).abs() < near, "{id}: {at}");
            assert!(
                at > -near && at < member.length_planar + near,
                "{id}: {share}"
            );
        }
    }
}

/// Condition 4: members end on the sides of their patch, and where patches share an edge, those
/// of both meet on it.
fn members_continue(plan: &Plan) {
    let edges: BTreeMap<&str, Polyline> = plan
        .edges
        .iter()
        .map(|e| (e.id.as_str(), Polyline::new(e.polyline.iter().copied())))
        .collect();
    let mut ends: BTreeMap<&str, Vec<Vec<nalgebra::Point3<f64>>>> = BTreeMap::new();
    for patch in &plan.patches {
        for (family, [start, end]) in [(Family::U, [0, 2]), (Family::V, [3, 1])] {
            let own = plan.members.iter().filter(|m| m.patch == patch.id);
            let lines: Vec<Polyline> = own
                .filter(|m| m.family == family)
                .map(|m| Polyline::new(m.polyline.iter().copied()))
                .collect();
            for (side, end) in [
                (start, Polyline::first as fn(&_) -> _),
                (end, Polyline::last),
            ] {
                let places: Vec<_> = lines.iter().map(end).collect();
                let names = &patch.sides[side].edges;
                for place in &places {
                    let on_side = names.iter().any(|edge| edges[edge.as_str()].passes(place));
                    assert!(on_side, "{} {place}", patch.id);
                }
                for edge in names {
                    let on_edge = places.iter().filter(|p| edges[edge.as_str()].passes(p));
                    ends.entry(edge)
                        .or_default()
                        .push(on_edge.copied().collect());
                }
            }
        }
    }
    for (edge, lists) in ends {
        let [mine, others] = &lists[..] else { continue };
        assert_eq!(mine.len(), others.len(), "{edge}");
        for place in mine {
            let nearest = others.iter().map(|other| (other - place).norm());
            let nearest = nearest.fold(f64::INFINITY, f64::min);
            assert!(nearest <= AGREE * edges[edge].length(), "{edge}: {nearest}");
        }
    }
}

/// Condition 5: a notch spans both positions of its crossing; boundary members have none.
fn openings_serve_crossings(plan: &Plan, bolt: f64, slider: f64) {
    let members = by_id(plan);
    let crossings: BTreeMap<&str, _> = plan.crossings.iter().map(|c| (c.id.as_str(), c)).collect();
    for lamella in &plan.lamellae {
        let member = members[lamella.member.as_str()];
        let mut served: Vec<&str> = Vec::new();
        for opening in &lamella.openings {
            let crossing = crossings[opening.crossing()];
            served.push(&crossing.id);
            let on = if crossing.u == member.id {
                crossing.on_u
            } else {
                assert_eq!(crossing.v, member.id);
                crossing.on_v
            };
            let place = format!("{} in {}", crossing.id, lamella.id);
            let ends = on.surface <= 0.0 || on.surface >= member.length_surface;
            let inner = !member.boundary && !ends;
            let width = if inner { slider } else { bolt };
            let slides = inner && (on.surface - on.planar).abs() > NO_SLIDE;
            match *opening {
                OpeningRecord::Hole { at, diameter, .. } => {
                    assert!(!slides, "{place} slides");
                    assert_eq!(at, on.surface, "{place}");
                    assert!((diameter - width).abs() < 1.1 * ROUND, "{place}");
                }
                OpeningRecord::Notch {
                    from, to, diameter, ..
                } => {
                    assert!(slides, "{place} does not slide");
                    assert_eq!([from, to], [on.planar, on.surface], "{place}");
                    assert!((diameter - width).abs() < 1.1 * ROUND, "{place}");
                }
            }
        }
        let mut expected: Vec<&str> = crossings
            .values()
            .filter(|c| c.u == member.id || c.v == member.id)
            .map(|c| c.id.as_str())
            .collect();
        expected.sort_unstable();
        served.sort_unstable();
        assert_eq!(served, expected, "{}", lamella.id);
    }
}

/// Condition 6: cladding functions increase within the bounds, or the patch is not feasible.
fn is_clad(patch: &PatchRecord, slope: [f64; 2]) {
    for function in [&patch.cladding.u, &patch.cladding.v] {
        let samples = &function.samples;
        assert_eq!(samples[0], [0.0; 2]);
        assert_eq!(samples[samples.len() - 1], [1.0; 2]);
        for pair in samples.windows(2) {
            let [run, rise] = [0, 1].map(|k| pair[1][k] - pair[0][k]);
            assert!(run > 0.0 && rise > 0.0, "{}: {pair:?}", patch.id);
            // Shares and slopes are written to 1e-9, shares are a hundredth apart.
            let (low, high) = (function.slope_min - 1e-6, function.slope_max + 1e-6);
            assert!(
                (low..=high).contains(&(rise / run)),
                "{}: {pair:?}",
                patch.id
            );
        }
        let within = slope[0] <= function.slope_min && function.slope_max <= slope[1];
        assert!(within || !patch.feasible, "{}", patch.id);
    }
}

fn by_id(plan: &Plan) -> BTreeMap<&str, &MemberRecord> {
    plan.members.iter().map(|m| (m.id.as_str(), m)).collect()
}
