//! Why a published file, or a result, is as it is.

use super::declare::{Graph, Instance};
use super::engine::Engine;
use super::plan::State;
use super::reason::Reason;
use super::request::Request;
use serde::Serialize;
use std::path::{Component, Path};

/// Why something is as it is, or will be made anew.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Explanation {
    /// The instance that makes it.
    pub instance: Instance,
    /// What the next build will do with that instance.
    pub state: State,
    /// Whether the causes are those of the next build; otherwise they are those of the build in
    /// which the result last changed.
    pub pending: bool,
    /// What came from outside, the nearest first.
    pub causes: Vec<Cause>,
    /// Every field of the project that it is made from.
    pub influences: Vec<Influence>,
}

/// A cause from outside.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Cause {
    /// What it is.
    pub reason: Reason,
    /// The instances that it went through, the last being the one asked for.
    pub path: Vec<Instance>,
}

/// A field that an instance on the way reads.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Influence {
    /// The instance that reads it.
    pub instance: Instance,
    /// Field of that instance's input.
    pub field: String,
    /// Key of the project that it comes from, where the graph says so.
    pub key: Option<String>,
    /// Short text of its value.
    pub value: String,
}

impl Engine {
    /// Explains a published file (by its path, relative to the output directory or not) or an
    /// instance (`cladding west`). `None` if the graph has neither.
    pub fn explain<'p>(
        &self,
        subject: &str,
        declare: &dyn Fn(&mut Graph<'p>),
    ) -> Option<Explanation> {
        let request = Request::default();
        let (plan, session) = self.planned(&request, declare);
        let name = |instance: &Instance| instance.to_string() == subject;
        let instance = match plan.stages.iter().find(|stage| name(&stage.instance)) {
            Some(stage) => stage.instance.clone(),
            None => self.owner_of(subject)?,
        };
        let mut stages = plan.stages.iter();
        let index = stages.position(|stage| stage.instance == instance)?;
        Some(session.explain(&plan, index))
    }

    /// The instance that published a file in the last build.
    fn owner_of(&self, subject: &str) -> Option<Instance> {
        let relative = self.relative(Path::new(subject));
        self.publications()
            .find(|publication| {
                let files = publication.files.iter();
                files.clone().any(|file| file.path == relative)
            })
            .map(|publication| publication.owner.clone())
    }

    /// The path below the output directory, with `/` between folders.
    fn relative(&self, path: &Path) -> String {
        let absolute = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
        let path = absolute.strip_prefix(self.output()).unwrap_or(path);
        let parts = path.components().filter_map(|part| match part {
            Component::Normal(name) => Some(name.to_string_lossy()),
            _ => None,
        });
        parts.collect::<Vec<_>>().join("/")
    }
}
