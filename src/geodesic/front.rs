//! The wavefront's memory: the sheaves that wait at half-edges, and the order in which they go on.
//!
//! A sheaf is forgotten once it has been swept, and its memory used again: a solve holds the wave
//! and not the surface it has passed, and a workspace that is used for many solves allocates
//! nothing after the first.

use super::beam::Beam;
use super::sheaf::{Lists, Sheaf};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Marks a queue entry as a vertex.
const VERTEX: u32 = 1 << 31;

/// No sheaf waits at a half-edge.
const NONE: u32 = u32::MAX;

/// Half-edges with waiting sheaves, and vertices about to become sources, by distance.
#[derive(Debug, Default)]
pub(super) struct Front {
    /// Per half-edge the place of its sheaf, or `NONE`.
    slots: Vec<u32>,
    sheaves: Vec<Option<Sheaf>>,
    /// Places without a sheaf.
    free: Vec<u32>,
    /// Empty lists with memory.
    spare: Vec<Vec<Beam>>,
    queue: BinaryHeap<Reverse<(u64, u32)>>,
    pub(super) lists: Lists,
}

/// What goes on next.
#[derive(Debug, Clone, Copy)]
pub(super) enum Next {
    /// The sheaf that waits at a half-edge.
    HalfEdge(u32),
    /// A vertex where paths bend.
    Vertex(u32),
}

impl Front {
    /// A front for a mesh with so many half-edges.
    pub(super) fn new(half_edges: usize) -> Self {
        Self {
            slots: vec![NONE; half_edges],
            ..Self::default()
        }
    }

    /// Takes what is nearest out of the queue, and about its distance.
    pub(super) fn pop(&mut self) -> Option<(f64, Next)> {
        let Reverse((key, id)) = self.queue.pop()?;
        let next = if id & VERTEX == 0 {
            Next::HalfEdge(id)
        } else {
            Next::Vertex(id & !VERTEX)
        };
        Some((f64::from_bits(key), next))
    }

    /// Queues a vertex.
    pub(super) fn push_vertex(&mut self, v: u32, distance: f64) {
        self.queue.push(Reverse((distance.to_bits(), v | VERTEX)));
    }

    /// Takes the sheaf that waits at a half-edge.
    pub(super) fn take(&mut self, h: u32) -> Option<Sheaf> {
        let slot = std::mem::replace(&mut self.slots[h as usize], NONE);
        if slot == NONE {
            return None;
        }
        self.free.push(slot);
        self.sheaves[slot as usize].take()
    }

    /// An empty list.
    pub(super) fn spare(&mut self) -> Vec<Beam> {
        self.spare.pop().unwrap_or_default()
    }

    /// Gives a list back.
    pub(super) fn recycle(&mut self, mut beams: Vec<Beam>) {
        beams.clear();
        self.spare.push(beams);
    }

    /// Adds a sheaf to what waits at a half-edge.
    pub(super) fn arrive(&mut self, h: u32, mut new: Sheaf) {
        let key = new.nearest.to_bits();
        let slot = &mut self.slots[h as usize];
        let place = self.sheaves.get_mut(*slot as usize);
        if let Some(Some(waiting)) = place {
            let queued = waiting.nearest;
            waiting.join(&mut new, &mut self.lists);
            let sooner = waiting.nearest < queued;
            self.recycle(new.beams);
            if !sooner {
                return;
            }
        } else if let Some(free) = self.free.pop() {
            self.sheaves[free as usize] = Some(new);
            *slot = free;
        } else {
            *slot = self.sheaves.len() as u32;
            self.sheaves.push(Some(new));
        }
        self.queue.push(Reverse((key, h)));
    }
}
