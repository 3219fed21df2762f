//! Declaring a graph: instances of stages, their inputs and dependencies, in order.
//!
//! A dependency is always declared before what needs it, so the graph has no cycles and its order
//! of declaration is a topological one. Where instances depend on a result (the patches that
//! automatic splitting proposes), [`Graph::unfold`] continues the declaration once it is known.

use super::key::canon::{self, CanonError};
use super::needs::{Needs, Node, Ports, Supplied, Supply, Value};
use super::publish::Files;
use super::request::Request;
use super::stage::{Context, Failure, Stage};
use crate::diagnostics::{Diagnostic, Place};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::any::Any;
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;

/// The name of an instance: a stage, and what it is done for.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct Instance {
    /// `cladding`.
    pub stage: String,
    /// `west`; empty where there is one for the whole structure.
    pub target: String,
}

impl fmt::Display for Instance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.stage)?;
        if !self.target.is_empty() {
            write!(f, " {}", self.target)?;
        }
        Ok(())
    }
}

/// A graph of instances. `'p` is the life of what unfolding closures borrow (the project).
#[derive(Default)]
pub struct Graph<'p> {
    pub(super) nodes: Vec<Declared>,
    pub(super) unfolds: Vec<(usize, Unfold<'p>)>,
    /// Targets that are parts of others.
    wholes: BTreeMap<String, String>,
}

pub(super) type Unfold<'p> = Box<dyn FnOnce(&mut Graph<'p>, &(dyn Any + Send + Sync)) + 'p>;

/// One declared instance.
pub(super) struct Declared {
    pub(super) instance: Arc<Instance>,
    pub(super) work: Arc<dyn Work>,
    pub(super) ports: Ports,
    /// Prefix of an input's field, and the key of the project it comes from.
    pub(super) origins: Vec<(Cow<'static, str>, Cow<'static, str>)>,
    /// Fields of the input, and what the user calls them.
    pub(super) names: Vec<(String, String)>,
    pub(super) publishes: bool,
}

impl Declared {
    /// The key of the project that a field of the input comes from.
    pub(super) fn key_of(&self, field: &str) -> Option<String> {
        self.origins
            .iter()
            .filter_map(|(prefix, key)| {
                let below = field.strip_prefix(&**prefix)?;
                let whole = below.is_empty() || prefix.is_empty() || below.starts_with(['.', '[']);
                let dot = if prefix.is_empty() && !below.is_empty() {
                    "."
                } else {
                    ""
                };
                whole.then(|| (prefix.len(), format!("{key}{dot}{below}")))
            })
            .max_by_key(|(length, _)| *length)
            .map(|(_, key)| key)
    }

    /// Translates a diagnostic of the stage into the terms of the project: a key that begins with
    /// a dot names a field of the stage's input, `{.field}` in a text is what the user calls it,
    /// and without a subject it is about the target.
    pub(super) fn localised(&self, diagnostic: &Diagnostic) -> Diagnostic {
        let mut diagnostic = diagnostic.with_names(&|field| {
            let mut names = self.names.iter();
            names.find_map(|(named, name)| (named == field).then_some(name.as_str()))
        });
        for label in &mut diagnostic.labels {
            if let Place::Key(key) = &mut label.place
                && let Some(field) = key.strip_prefix('.')
            {
                *key = self.key_of(field).unwrap_or_default();
            }
        }
        if diagnostic.subject.is_none() && !self.instance.target.is_empty() {
            diagnostic.subject = Some(self.instance.target.clone());
        }
        diagnostic
    }
}

impl<'p> Graph<'p> {
    /// Declares an instance of `stage` for `target`, with its input and dependencies.
    ///
    /// Stage and target together name the instance and are unique. The target is a name, not an
    /// input: it does not enter the key, so a renamed patch keeps its results.
    ///
    /// # Panics
    /// If a dependency is a handle of another graph.
    pub fn add<I, N, O>(
        &mut self,
        stage: &Stage<I, N, O>,
        target: impl Into<String>,
        input: I,
        needs: N,
    ) -> Node<O>
    where
        I: Serialize + Send + Sync + 'static,
        N: Needs,
        O: Serialize + DeserializeOwned + Send + Sync + 'static,
    {
        let mut ports = Ports::default();
        needs.ports(&mut ports);
        let index = self.nodes.len();
        assert!(
            ports.list.iter().all(|port| port.node < index),
            "a handle names a node of the graph that made it"
        );
        self.nodes.push(Declared {
            instance: Arc::new(Instance {
                stage: stage.name.to_owned(),
                target: target.into(),
            }),
            work: Arc::new(Job {
                name: stage.name,
                version: stage.version,
                numerics: stage.numerics.class(),
                run: stage.run,
                input,
                needs,
            }),
            ports,
            origins: Vec::new(),
            names: Vec::new(),
            publishes: false,
        });
        Node::new(index)
    }

    /// Says that field `field` of the node's input (and what is below it) comes from `key` of the
    /// project, so that reasons can point at a line of the project file.
    pub fn origin<T>(
        &mut self,
        node: Node<T>,
        field: impl Into<Cow<'static, str>>,
        key: impl Into<Cow<'static, str>>,
    ) {
        self.nodes[node.index]
            .origins
            .push((field.into(), key.into()));
    }

    /// Says what the user calls field `field` of the node's input. Names are no inputs: they are
    /// put into diagnostics when these are told.
    pub fn name<T>(&mut self, node: Node<T>, field: impl Into<String>, name: impl Into<String>) {
        self.nodes[node.index]
            .names
            .push((field.into(), name.into()));
    }

    /// Publishes the node's files in the output directory.
    pub fn publish(&mut self, node: Node<Files>) {
        self.nodes[node.index].publishes = true;
    }

    /// Says that a target is a part of another one: whoever asks for the whole gets it.
    pub fn part(&mut self, part: impl Into<String>, whole: impl Into<String>) {
        self.wholes.insert(part.into(), whole.into());
    }

    /// Targets that fell into parts.
    pub(super) fn wholes(&self) -> impl Iterator<Item = &str> {
        self.wholes.values().map(String::as_str)
    }

    /// Whether a request names an instance, itself or as a part.
    pub(super) fn selects(&self, request: &Request, instance: &Instance) -> bool {
        let whole = || {
            let (part, below) = instance
                .target
                .split_once('.')
                .map_or((instance.target.as_str(), None), |(part, below)| {
                    (part, Some(below))
                });
            let whole = self.wholes.get(part)?;
            Some(Instance {
                stage: instance.stage.clone(),
                target: below.map_or_else(|| whole.clone(), |below| format!("{whole}.{below}")),
            })
        };
        request.selects(instance) || whole().is_some_and(|whole| request.selects(&whole))
    }

    /// Continues the declaration as soon as the node's value is known. The closure may use all
    /// handles that exist when it is called. If the node fails, it is never called.
    ///
    /// The value is kept with the node's record, so a build that has nothing to do unfolds without
    /// opening a result; it should be small (names and counts, not geometry).
    ///
    /// # Panics
    /// When the value becomes known, if the node is a handle of another graph.
    pub fn unfold<T: Send + Sync + 'static>(
        &mut self,
        node: Node<T>,
        grow: impl FnOnce(&mut Self, &T) + 'p,
    ) {
        self.unfolds.push((
            node.index,
            Box::new(move |graph, value| {
                let value = value
                    .downcast_ref()
                    .expect("a handle names a node of the graph that made it");
                grow(graph, value);
            }),
        ));
    }
}

/// An instance without its types.
pub(super) trait Work: Send + Sync {
    fn stage(&self) -> &'static str;
    fn version(&self) -> u32;
    fn numerics(&self) -> &'static str;
    /// Appends the canonical encoding of the input.
    fn encode_input(&self, out: &mut Vec<u8>) -> Result<(), CanonError>;
    fn run(&self, supplied: &[Supplied], context: &Context) -> Result<Made, Failure>;
    fn decode(&self, bytes: &[u8]) -> Result<Value, postcard::Error>;
}

/// What a run gave.
pub(super) struct Made {
    pub(super) value: Value,
    /// The value's encoding: its digest enters the keys of what depends on it.
    pub(super) bytes: Result<Vec<u8>, postcard::Error>,
    pub(super) warnings: Vec<Diagnostic>,
}

struct Job<I, N: Needs, O> {
    name: &'static str,
    version: u32,
    numerics: &'static str,
    run: for<'a> fn(&'a I, N::Values<'a>, &'a Context) -> super::stage::Outcome<O>,
    input: I,
    needs: N,
}

impl<I, N, O> Work for Job<I, N, O>
where
    I: Serialize + Send + Sync + 'static,
    N: Needs,
    O: Serialize + DeserializeOwned + Send + Sync + 'static,
{
    fn stage(&self) -> &'static str {
        self.name
    }

    fn version(&self) -> u32 {
        self.version
    }

    fn numerics(&self) -> &'static str {
        self.numerics
    }

    fn encode_input(&self, out: &mut Vec<u8>) -> Result<(), CanonError> {
        canon::encode(&self.input, out)
    }

    fn run(&self, supplied: &[Supplied], context: &Context) -> Result<Made, Failure> {
        let values = self.needs.values(&mut Supply(supplied.iter()));
        let made = (self.run)(&self.input, values, context)?;
        Ok(Made {
            bytes: encode_output(&made.value),
            value: Arc::new(made.value),
            warnings: made.warnings,
        })
    }

    fn decode(&self, bytes: &[u8]) -> Result<Value, postcard::Error> {
        Ok(Arc::new(decode_output::<O>(bytes)?))
    }
}

/// The encoding of an output. Some serde attributes (fields that are skipped, flattened or
/// untagged) make types that are written but not read back: builds with assertions find them.
fn encode_output<O: Serialize + DeserializeOwned>(value: &O) -> Result<Vec<u8>, postcard::Error> {
    let bytes = postcard::to_stdvec(value)?;
    if cfg!(debug_assertions) && postcard::to_stdvec(&decode_output::<O>(&bytes)?)? != bytes {
        return Err(postcard::Error::SerdeSerCustom);
    }
    Ok(bytes)
}

fn decode_output<O: DeserializeOwned>(bytes: &[u8]) -> Result<O, postcard::Error> {
    // Bytes left over mean that the type has changed without its version.
    match postcard::take_from_bytes(bytes)? {
        (value, []) => Ok(value),
        _ => Err(postcard::Error::SerdeDeCustom),
    }
}
