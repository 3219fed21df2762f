//! Disjoint sets.

/// Sets of numbers `0..n` that are joined step by step.
#[derive(Debug)]
pub(super) struct UnionFind(Vec<u32>);

impl UnionFind {
    /// Every number by itself.
    pub(super) fn new(n: u32) -> Self {
        Self((0..n).collect())
    }

    /// The number that stands for a set.
    pub(super) fn find(&mut self, mut i: u32) -> u32 {
        while self.0[i as usize] != i {
            // Halving the path keeps later searches short.
            self.0[i as usize] = self.0[self.0[i as usize] as usize];
            i = self.0[i as usize];
        }
        i
    }

    /// Joins the set of `i` to that of `root`, which goes on to stand for both.
    pub(super) fn join(&mut self, i: u32, root: u32) {
        let (i, root) = (self.find(i), self.find(root));
        self.0[i as usize] = root;
    }
}
