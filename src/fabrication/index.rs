//! Records of a plan by id.

use super::part::Neighbours;
use crate::plan::{CrossingRecord, LamellaRecord, MemberRecord, OpeningRecord, Plan};
use std::collections::BTreeMap;

/// Finds records by id. Ids that lead nowhere (a plan that was edited by hand) find nothing.
#[derive(Debug, Clone)]
pub struct PlanIndex<'a> {
    members: BTreeMap<&'a str, &'a MemberRecord>,
    crossings: BTreeMap<&'a str, &'a CrossingRecord>,
    lamellae: BTreeMap<&'a str, &'a LamellaRecord>,
}

impl<'a> PlanIndex<'a> {
    /// Reads the ids once.
    pub fn new(plan: &'a Plan) -> Self {
        Self {
            members: plan.members.iter().map(|m| (m.id.as_str(), m)).collect(),
            crossings: plan.crossings.iter().map(|c| (c.id.as_str(), c)).collect(),
            lamellae: plan
                .lamellae
                .iter()
                .map(|l| (l.member.as_str(), l))
                .collect(),
        }
    }

    /// A member by id.
    pub fn member(&self, id: &str) -> Option<&'a MemberRecord> {
        self.members.get(id).copied()
    }

    /// A crossing by id.
    pub fn crossing(&self, id: &str) -> Option<&'a CrossingRecord> {
        self.crossings.get(id).copied()
    }

    /// The lamella of a member.
    pub fn lamella_of(&self, member: &str) -> Option<&'a LamellaRecord> {
        self.lamellae.get(member).copied()
    }

    /// The opening that a member's lamella has for a crossing.
    pub fn opening(&self, member: &str, crossing: &str) -> Option<&'a OpeningRecord> {
        let openings = &self.lamella_of(member)?.openings;
        openings.iter().find(|o| o.crossing() == crossing)
    }

    /// Member, crossings and crossing lamellae of a lamella.
    pub fn neighbours(&self, lamella: &LamellaRecord) -> Option<Neighbours<'a>> {
        let crossings = lamella
            .openings
            .iter()
            .filter_map(|opening| self.crossing(opening.crossing()))
            .filter_map(|crossing| {
                let other = if crossing.u == lamella.member {
                    &crossing.v
                } else {
                    &crossing.u
                };
                Some((crossing, self.lamella_of(other)?))
            })
            .collect();
        Some(Neighbours {
            member: self.member(&lamella.member)?,
            crossings,
        })
    }
}
