//! Things that belong together, found by joining them two by two.

/// Disjoint sets of numbers; the lowest of a set stands for it.
pub(super) struct Groups {
    parent: Vec<u32>,
}

impl Groups {
    /// Every number below `count` by itself.
    pub(super) fn new(count: usize) -> Self {
        Self { parent: (0..count as u32).collect() }
    }

    /// The lowest number of a set.
    pub(super) fn find(&mut self, mut number: u32) -> u32 {
        while self.parent[number as usize] != number {
            // Every look shortens the way of the next.
            self.parent[number as usize] = self.parent[self.parent[number as usize] as usize];
            number = self.parent[number as usize];
        }
        number
    }

    pub(super) fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.find(a), self.find(b));
        self.parent[a.max(b) as usize] = a.min(b);
    }
}
