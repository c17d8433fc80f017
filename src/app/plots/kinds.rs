//! Kinds of energy: what a world has, and by its ledger, where one is kept, what brought it and what took it.

use crate::app::player::Measured;
use crate::sim::Book;

/// A kind of energy.
#[derive(Clone, Copy, Debug)]
pub(in crate::app) struct Kind {
    pub(in crate::app) name: &'static str,
    /// `[J]`.
    pub(in crate::app) of: fn(&Measured) -> f64,
    /// Its colour among those of energies; `None`: the sum of all, in that of words.
    pub(in crate::app) color: Option<usize>,
    /// It is told of where there is none, too.
    is_usual: bool,
}

impl Kind {
    const fn new(name: &'static str, of: fn(&Measured) -> f64, color: usize) -> Self {
        Kind { name, of, color: Some(color), is_usual: false }
    }

    const fn usual(self) -> Self {
        Kind { is_usual: true, ..self }
    }

    /// Whether any of these has some of it, or it is told of in any case.
    pub(super) fn is_seen<'a>(&self, mut among: impl Iterator<Item = &'a Measured>) -> bool {
        self.is_usual || among.any(|measured| (self.of)(measured) != 0.0)
    }
}

/// A work in the ledger `[J]`; 0 where none is kept.
fn work(measured: &Measured, of: impl Fn(&Book) -> f64) -> f64 {
    measured.book.as_ref().map_or(0.0, of)
}

/// What a world has.
pub(super) const ENERGIES: [Kind; 7] = [
    Kind::new("kinetic", |measured| measured.energies.kinetic, 0).usual(),
    Kind::new("springs", |measured| measured.energies.springs, 1).usual(),
    Kind::new("angles", |measured| measured.energies.angles, 3),
    Kind::new("areas", |measured| measured.energies.areas, 4),
    Kind::new("surfaces", |measured| measured.energies.surfaces, 5),
    Kind::new("gravity", |measured| measured.energies.gravity, 2).usual(),
    Kind { name: "sum", of: |measured| measured.energies.sum(), color: None, is_usual: true },
];

/// What brought energy since the ledger began, from outside.
pub(super) const BROUGHT: [Kind; 9] = [
    Kind::new("mouse", |measured| work(measured, |book| book.mouse), 0),
    Kind::new("grab", |measured| work(measured, |book| book.grab), 1),
    Kind::new("pins", |measured| work(measured, |book| book.pins), 2),
    Kind::new("forces", |measured| work(measured, |book| book.forces), 3),
    Kind::new("drives", |measured| work(measured, |book| book.drives), 4),
    Kind::new("wind", |measured| work(measured, |book| book.wind), 5),
    Kind::new("commands", |measured| work(measured, |book| book.commands), 6),
    Kind::new("parting", |measured| work(measured, |book| book.parting.max(0.0)), 7),
    Kind { name: "sum", of: |measured| work(measured, Book::brought), color: None, is_usual: true },
];

/// What took energy since then.
pub(super) const TAKEN: [Kind; 8] = [
    Kind::new("drag", |measured| work(measured, |book| book.drag), 1),
    Kind::new("dampers", |measured| work(measured, |book| book.dampers), 2),
    Kind::new("friction", |measured| work(measured, |book| book.friction), 0),
    Kind::new("impacts", |measured| work(measured, |book| book.impacts), 3),
    Kind::new("breaks", |measured| work(measured, |book| book.breaks), 4),
    Kind::new("sweeps", |measured| work(measured, |book| book.relaxation), 5),
    Kind::new("parting", |measured| work(measured, |book| (-book.parting).max(0.0)), 6),
    Kind { name: "sum", of: |measured| work(measured, Book::taken), color: None, is_usual: true },
];
