//! The wavefront's memory: the windows that wait at half-edges, and the order in which they go on.
//!
//! Waiting windows are lists in a pool: a list that has been swept is used again for the next
//! half-edge that needs one, so a solve holds the wave and not the surface it has passed, and a
//! workspace that is used for many solves allocates nothing after the first.

use super::trim;
use super::window::Window;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Marks a queue entry as a vertex.
const VERTEX: u32 = 1 << 31;

/// No list waits at a half-edge.
const NONE: u32 = u32::MAX;

/// Half-edges with waiting windows, and vertices about to become sources, by distance.
#[derive(Debug, Default)]
pub(super) struct Front {
    /// Per half-edge its list, or `NONE`.
    slots: Vec<u32>,
    lists: Vec<Vec<Window>>,
    free: Vec<u32>,
    queue: BinaryHeap<Reverse<(u64, u32)>>,
    merged: Vec<Window>,
}

/// What goes on next.
#[derive(Debug, Clone, Copy)]
pub(super) enum Next {
    /// The windows that wait at a half-edge.
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

    /// Takes what is nearest out of the queue, if it is not beyond a distance.
    pub(super) fn pop(&mut self, bound: f64) -> Option<(f64, Next)> {
        let &Reverse((key, _)) = self.queue.peek()?;
        if f64::from_bits(key) > bound {
            return None;
        }
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

    /// Takes the windows that wait at a half-edge, sorted and without overlap. To be given back
    /// with [`Front::recycle`].
    pub(super) fn take(&mut self, h: u32) -> Option<(u32, Vec<Window>)> {
        let slot = std::mem::replace(&mut self.slots[h as usize], NONE);
        (slot != NONE).then(|| (slot, std::mem::take(&mut self.lists[slot as usize])))
    }

    /// Gives a taken list back.
    pub(super) fn recycle(&mut self, slot: u32, mut list: Vec<Window>) {
        list.clear();
        self.lists[slot as usize] = list;
        self.free.push(slot);
    }

    /// Adds a sorted list of windows without overlap to what waits at a half-edge, and leaves an
    /// empty one.
    pub(super) fn arrive(&mut self, h: u32, new: &mut Vec<Window>) {
        let nearest = new
            .iter()
            .map(Window::nearest)
            .fold(f64::INFINITY, f64::min);
        if nearest == f64::INFINITY {
            return;
        }
        let slot = &mut self.slots[h as usize];
        if *slot == NONE {
            *slot = self.free.pop().unwrap_or_else(|| {
                self.lists.push(Vec::new());
                self.lists.len() as u32 - 1
            });
            std::mem::swap(&mut self.lists[*slot as usize], new);
        } else {
            let waiting = &mut self.lists[*slot as usize];
            self.merged.clear();
            trim::merge(waiting, new, &mut self.merged);
            std::mem::swap(waiting, &mut self.merged);
            new.clear();
        }
        self.queue.push(Reverse((nearest.to_bits(), h)));
    }

    /// Forgets what still waits.
    pub(super) fn clear(&mut self) {
        let mut queue = std::mem::take(&mut self.queue);
        for Reverse((_, id)) in queue.drain() {
            if id & VERTEX == 0
                && let Some((slot, list)) = self.take(id)
            {
                self.recycle(slot, list);
            }
        }
        self.queue = queue;
    }
}
