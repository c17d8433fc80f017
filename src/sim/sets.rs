//! Disjoint sets: which points hang together.

/// Sets of the numbers 0..count, each known by its lowest member.
#[derive(Clone, Debug)]
pub(crate) struct Sets {
    parent: Vec<u32>,
}

impl Sets {
    /// Every number alone.
    pub(crate) fn new(count: usize) -> Self {
        Sets { parent: (0..count as u32).collect() }
    }

    /// The lowest member of the set of `i`.
    pub(crate) fn find(&mut self, i: u32) -> u32 {
        let mut at = i;
        while self.parent[at as usize] != at {
            let up = self.parent[self.parent[at as usize] as usize];
            self.parent[at as usize] = up;
            at = up;
        }
        at
    }

    /// Joins the sets of two numbers.
    pub(crate) fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.find(a), self.find(b));
        self.parent[a.max(b) as usize] = a.min(b);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn joined_numbers_share_their_lowest() {
        let mut sets = Sets::new(6);
        sets.join(4, 2);
        sets.join(5, 4);
        assert_eq!([0, 1, 2, 3, 4, 5].map(|i| sets.find(i)), [0, 1, 2, 3, 2, 2]);
    }
}
