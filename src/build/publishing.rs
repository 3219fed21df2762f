//! Deciding what has to be published: nothing, if the output directory is as it was left.

use super::declare::Instance;
use super::engine::Engine;
use super::event::Event;
use super::publish::{Claim, Claimed, Publication, Publishing, inspect, is_swept, manifest_stands};
use super::request::{OutputCheck, Request};
use super::session::{Conditions, Publisher, Session};
use super::store::worktree::Outputs;
use std::collections::BTreeSet;

impl Engine {
    /// Publishes what has a result. `None` if the directory is as recorded.
    pub(super) fn publish(
        &self,
        request: &Request,
        session: &mut Session<'_, '_>,
        conditions: &Conditions,
        observe: &mut dyn FnMut(Event<'_>),
    ) -> (Option<Outputs>, Publication) {
        if request.outputs == OutputCheck::Ignore {
            return (None, Publication::default());
        }
        let directory = &self.settings.output;
        let old = &self.worktree.outputs;
        loop {
            let publishers = session.publishers();
            let standing: Vec<bool> = publishers
                .iter()
                .map(|one| {
                    self.worktree.publication(&one.owner).is_some_and(|record| {
                        record.output == one.output
                            && inspect(directory, record, request.outputs).is_empty()
                    })
                })
                .collect();
            let gone: BTreeSet<&Instance> = old
                .publications
                .iter()
                .map(|record| &record.owner)
                .filter(|owner| session.is_whole() && !session.publishes(owner))
                .collect();
            let stands = standing.iter().all(|&stands| stands)
                && manifest_stands(directory, old)
                && is_swept(directory, old);
            if stands && gone.is_empty() {
                let files = old.publications.iter().map(|one| one.files.len());
                let publication = Publication {
                    unchanged: files.sum(),
                    ..Publication::default()
                };
                return (None, publication);
            }
            // A result that cannot be read any more has to be made again first.
            let Some(claims) = self.claims(session, &publishers, &standing) else {
                session.execute(conditions, observe);
                if session.is_complete() && !session.is_unsettled() {
                    continue;
                }
                return (None, Publication::default());
            };
            let claimed: BTreeSet<&Instance> = publishers.iter().map(|one| &*one.owner).collect();
            let others = old
                .publications
                .iter()
                .filter(|record| !claimed.contains(&record.owner) && !gone.contains(&record.owner));
            let names = session.publisher_names();
            let (outputs, publication) = Publishing {
                directory,
                claims,
                others: others.cloned().collect(),
                is_gone: &|owner| session.is_whole() && !names.contains(owner),
                foreign: request.foreign,
            }
            .run();
            return (Some(outputs), publication);
        }
    }

    /// What the publishers have and want. `None` if some of them have to run again for that.
    fn claims(
        &self,
        session: &mut Session<'_, '_>,
        publishers: &[Publisher],
        standing: &[bool],
    ) -> Option<Vec<Claim>> {
        let mut claims = Vec::new();
        for (publisher, stands) in publishers.iter().zip(standing) {
            let record = self.worktree.publication(&publisher.owner);
            let files = match record.filter(|_| *stands) {
                Some(record) => Some(Claimed::Standing(record.clone())),
                None => session.demand(publisher.index).map(Claimed::Wanted),
            };
            claims.push(files.map(|files| Claim {
                owner: publisher.owner.clone(),
                output: publisher.output,
                files,
            }));
        }
        claims.into_iter().collect()
    }
}
