//! Items by the group that each belongs to, in one list.

/// Groups of items; in each they have the order in which they came.
pub(super) struct Grouped<T> {
    items: Vec<T>,
    /// Where each group begins, and where the last one ends.
    starts: Vec<usize>,
}

impl<T: Copy + Default> Grouped<T> {
    /// `count` groups of these items, each with the number of its group.
    pub(super) fn new(count: usize, items: impl Iterator<Item = (usize, T)> + Clone) -> Self {
        let mut starts = vec![0; count + 1];
        items.clone().for_each(|(group, _)| starts[group + 1] += 1);
        for group in 0..count {
            starts[group + 1] += starts[group];
        }
        let (mut next, mut grouped) = (starts.clone(), vec![T::default(); starts[count]]);
        for (group, item) in items {
            grouped[next[group]] = item;
            next[group] += 1;
        }
        Self { items: grouped, starts }
    }

    /// The items of one group.
    pub(super) fn of(&mut self, group: usize) -> &mut [T] {
        &mut self.items[self.starts[group]..self.starts[group + 1]]
    }

    /// Group after group.
    pub(super) fn iter(&self) -> impl Iterator<Item = &[T]> {
        self.starts.windows(2).map(|range| &self.items[range[0]..range[1]])
    }
}

#[cfg(test)]
mod tests {
    use super::Grouped;

    #[test]
    fn items_keep_their_order_within_a_group() {
        let mut grouped = Grouped::new(3, [(2, 'a'), (0, 'b'), (2, 'c'), (0, 'a')].into_iter());
        assert_eq!(vec![&['b', 'a'][..], &[], &['a', 'c']], grouped.iter().collect::<Vec<_>>());
        assert_eq!(['a', 'c'], grouped.of(2));
        assert_eq!(0, Grouped::<u32>::new(0, std::iter::empty()).iter().count());
    }
}
