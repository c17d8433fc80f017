//! Which label is which, from frame to frame: fields that are written in belong to a label, and not to its place in the list.

use std::sync::Arc;

use egui::{Id, Ui};

use crate::scene::LabelKeys;

/// Where the numbers are kept.
const KEPT: &str = "the numbers of labels";

/// Numbers of labels, which stay theirs as others come and go, and are never given again.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Names {
    labels: Arc<Vec<LabelKeys>>,
    numbers: Vec<u64>,
    next: u64,
}

impl Names {
    /// Those of these labels: one that is there still keeps its own, by what stands before and behind it.
    pub(super) fn of(ui: &Ui, labels: &[LabelKeys]) -> Self {
        let names: Names = ui.data(|data| data.get_temp(Id::unique(KEPT))).unwrap_or_default();
        names.met(labels)
    }

    /// They are of these labels from now on.
    pub(super) fn keep(mut self, ui: &Ui, labels: &[LabelKeys]) {
        if *self.labels != labels {
            self.labels = Arc::new(labels.to_vec());
        }
        ui.data_mut(|data| data.insert_temp(Id::unique(KEPT), self));
    }

    /// The number of the label at a place.
    pub(super) fn at(&self, place: usize) -> u64 {
        self.numbers.get(place).copied().unwrap_or(self.next)
    }

    /// Another label comes behind all others. Returns its number.
    pub(super) fn push(&mut self) -> u64 {
        let number = self.next;
        self.numbers.push(number);
        self.next += 1;
        number
    }

    /// The label at a place goes. Returns the number that it had.
    pub(super) fn remove(&mut self, place: usize) -> u64 {
        self.numbers.remove(place)
    }

    /// The labels became others by themselves, as undo makes them.
    fn met(mut self, labels: &[LabelKeys]) -> Self {
        if *self.labels == labels && self.numbers.len() == labels.len() {
            return self;
        }
        let old = &self.labels[..self.numbers.len().min(self.labels.len())];
        let first = old.iter().zip(labels).take_while(|(a, b)| a == b).count();
        let (rest_old, rest) = (&old[first..], &labels[first..]);
        let last = rest_old.iter().rev().zip(rest.iter().rev()).take_while(|(a, b)| a == b).count();
        // Between what is as it was, as many are the same ones, written anew or moved; else those are others.
        let (gone, come) = (rest_old.len() - last, rest.len() - last);
        let mut numbers = self.numbers[..first].to_vec();
        if gone == come {
            numbers.extend(&self.numbers[first..first + gone]);
        } else {
            numbers.extend(self.next..self.next + come as u64);
            self.next += come as u64;
        }
        numbers.extend(&self.numbers[first + gone..old.len()]);
        Names { labels: Arc::new(labels.to_vec()), numbers, next: self.next }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Vector;

    fn labels(words: &[&str]) -> Vec<LabelKeys> {
        let label = |text: &&str| LabelKeys { at: Vector::Plane([0.0; 2]), text: (*text).to_owned(), point: None };
        words.iter().map(label).collect()
    }

    #[test]
    fn a_label_keeps_its_number_as_others_come_and_go() {
        let names = Names::default().met(&labels(&["a", "b", "c"]));
        assert_eq!(names.numbers, [0, 1, 2]);
        let without = names.clone().met(&labels(&["b", "c"]));
        assert_eq!(without.numbers, [1, 2], "the first one went");
        assert_eq!(
            without.met(&labels(&["a", "b", "c"])).numbers,
            [3, 1, 2],
            "it came back: what was written of it is past"
        );
        assert_eq!(names.clone().met(&labels(&["a", "other", "c"])).numbers, [0, 1, 2], "it is written anew");
        assert_eq!(names.clone().met(&labels(&["a", "b", "c", "d"])).numbers, [0, 1, 2, 3]);
        assert_eq!(names.clone().met(&labels(&["x", "y"])).numbers, [3, 4], "all others");
        assert_eq!(names.met(&[]).numbers, [0; 0]);
    }

    #[test]
    fn of_labels_that_are_alike_the_one_goes_that_was_meant() {
        let mut names = Names::default().met(&labels(&["a", "a", "a"]));
        assert_eq!((names.remove(1), names.push(), names.at(1)), (1, 3, 2));
    }
}
