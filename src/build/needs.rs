//! Handles of declared results, and how a stage receives what is behind them.

use super::key::PortKind;
use super::store::trace::Head;
use crate::diagnostics::Diagnostic;
use std::any::Any;
use std::marker::PhantomData;
use std::sync::Arc;

/// The future result of one instance of a stage. Used as a dependency it hands over `&T`; if that
/// instance fails, whatever needs it is skipped.
pub struct Node<T> {
    pub(super) index: usize,
    output: PhantomData<fn() -> T>,
}

impl<T> Node<T> {
    pub(super) fn new(index: usize) -> Self {
        Self {
            index,
            output: PhantomData,
        }
    }

    /// As a dependency: what the instance had to say, without its value.
    pub fn warnings(self) -> Warnings {
        Warnings(self.index)
    }

    /// As a dependency: `Some(&T)`, or `None` if the instance failed for its inputs.
    pub fn attempt(self) -> Attempt<T> {
        Attempt(self)
    }
}

impl<T> Clone for Node<T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T> Copy for Node<T> {}

impl<T> std::fmt::Debug for Node<T> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Node({})", self.index)
    }
}

/// The warnings and notes of an instance; hands over `&[Diagnostic]`.
#[derive(Debug, Clone, Copy)]
pub struct Warnings(usize);

/// An instance that may fail; hands over `Option<&T>`.
#[derive(Debug)]
pub struct Attempt<T>(Node<T>);

impl<T> Clone for Attempt<T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T> Copy for Attempt<T> {}

/// The dependencies of a stage: `()`, a [`Node`], [`Warnings`], an [`Attempt`], an `Option`, a
/// `Vec` or a tuple of dependencies.
pub trait Needs: Send + Sync + 'static {
    /// What the stage receives.
    type Values<'a>;

    /// Lists the ports in order.
    fn ports(&self, ports: &mut Ports);

    /// Takes the ports' contents in the same order.
    fn values<'a>(&self, supply: &mut Supply<'a>) -> Self::Values<'a>;
}

/// One end of a dependency: whose result, and which side of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Port {
    pub(super) node: usize,
    pub(super) kind: PortKind,
}

/// The ports of an instance, in order.
#[derive(Debug, Clone, Default)]
pub struct Ports {
    pub(crate) list: Vec<Port>,
    /// Lengths of the vectors and presence of the options among the dependencies: without them
    /// two ways to spread the same ports over two vectors would share a key.
    pub(super) shape: Vec<u32>,
}

/// An erased output.
pub(super) type Value = Arc<dyn Any + Send + Sync>;

/// What came through one port.
pub(super) enum Supplied {
    Value(Value),
    Warnings(Arc<Head>),
    Nothing,
}

/// The contents of a stage's ports, in order.
pub struct Supply<'a>(pub(super) std::slice::Iter<'a, Supplied>);

impl<'a> Supply<'a> {
    fn value<T: 'static>(&mut self) -> Option<&'a T> {
        match self.0.next() {
            Some(Supplied::Value(value)) => Some(
                value
                    .downcast_ref()
                    .expect("a handle names a node of the graph that made it"),
            ),
            _ => None,
        }
    }
}

impl<T: Send + Sync + 'static> Needs for Node<T> {
    type Values<'a> = &'a T;

    fn ports(&self, ports: &mut Ports) {
        ports.list.push(Port {
            node: self.index,
            kind: PortKind::Value,
        });
    }

    fn values<'a>(&self, supply: &mut Supply<'a>) -> &'a T {
        supply
            .value()
            .expect("the session runs a stage only when its dependencies have values")
    }
}

impl<T: Send + Sync + 'static> Needs for Attempt<T> {
    type Values<'a> = Option<&'a T>;

    fn ports(&self, ports: &mut Ports) {
        ports.list.push(Port {
            node: self.0.index,
            kind: PortKind::Attempt,
        });
    }

    fn values<'a>(&self, supply: &mut Supply<'a>) -> Option<&'a T> {
        supply.value()
    }
}

impl Needs for Warnings {
    type Values<'a> = &'a [Diagnostic];

    fn ports(&self, ports: &mut Ports) {
        ports.list.push(Port {
            node: self.0,
            kind: PortKind::Warnings,
        });
    }

    fn values<'a>(&self, supply: &mut Supply<'a>) -> &'a [Diagnostic] {
        match supply.0.next() {
            Some(Supplied::Warnings(head)) => &head.diagnostics,
            _ => &[],
        }
    }
}

impl<N: Needs> Needs for Vec<N> {
    type Values<'a> = Vec<N::Values<'a>>;

    fn ports(&self, ports: &mut Ports) {
        ports.shape.push(self.len() as u32);
        for need in self {
            need.ports(ports);
        }
    }

    fn values<'a>(&self, supply: &mut Supply<'a>) -> Self::Values<'a> {
        self.iter().map(|need| need.values(supply)).collect()
    }
}

impl<N: Needs> Needs for Option<N> {
    type Values<'a> = Option<N::Values<'a>>;

    fn ports(&self, ports: &mut Ports) {
        ports.shape.push(self.is_some().into());
        if let Some(need) = self {
            need.ports(ports);
        }
    }

    fn values<'a>(&self, supply: &mut Supply<'a>) -> Self::Values<'a> {
        self.as_ref().map(|need| need.values(supply))
    }
}

macro_rules! tuples {
    ($(($($name:ident),*))*) => {$(
        impl<$($name: Needs),*> Needs for ($($name,)*) {
            type Values<'a> = ($($name::Values<'a>,)*);

            #[allow(
                non_snake_case,
                unused_variables,
                reason = "parts are named as their types; the empty tuple has none"
            )]
            fn ports(&self, ports: &mut Ports) {
                let ($($name,)*) = self;
                $($name.ports(ports);)*
            }

            #[allow(
                non_snake_case,
                unused_variables,
                clippy::unused_unit,
                reason = "parts are named as their types; the empty tuple has none"
            )]
            fn values<'a>(&self, supply: &mut Supply<'a>) -> Self::Values<'a> {
                let ($($name,)*) = self;
                ($($name.values(supply),)*)
            }
        }
    )*};
}

tuples! {
    () (A) (A, B) (A, B, C) (A, B, C, D) (A, B, C, D, E) (A, B, C, D, E, F)
    (A, B, C, D, E, F, G) (A, B, C, D, E, F, G, H) (A, B, C, D, E, F, G, H, J)
    (A, B, C, D, E, F, G, H, J, K)
}
