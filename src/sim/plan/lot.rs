//! Islands that go together: what one method moves at one substep, in groups that fall asleep each for itself.

use super::choice::{self, Choice, Setting};
use super::island::Island;
use super::structure::MOST_OF_A_CROWD;
use crate::sim::model::Model;
use crate::sim::solver::{Order, Solver};

/// Points from which on a group of small islands is full: one that sleeps should not be woken by too many others, and a group
/// costs about as much as a few points.
const FULL: usize = 256;

/// Islands that make a group.
pub(super) struct Lot {
    pub(super) choice: Choice,
    pub(super) islands: Vec<Island>,
    /// Which islands have one method and substep: groups of one class count as one for those who ask.
    pub(super) class: usize,
    /// Points of the islands of its class that can move.
    pub(super) points: usize,
}

/// Islands by method and substep, in the order of their first points.
///
/// A method that was asked for by name moves all islands at the substep of the fastest; large bodies apart from what is
/// none, and from those that follow another strain.
pub(super) fn lots<const D: usize>(model: &Model<D>, islands: Vec<Island>) -> Vec<Lot> {
    let setting = Setting {
        has_surfaces: model.has_surfaces(),
        mouse: model.mouse.as_ref().map(|mouse| mouse.strength),
        drag_rate: model.drag_rate,
        points: model.mass.len(),
    };
    let mut classes: Vec<(Choice, Vec<Island>)> = Vec::new();
    for island in islands {
        let choice = choice::choose(&island, &model.method, setting);
        let fits = |class: &&mut (Choice, Vec<Island>)| match model.method.solver {
            Solver::Auto => class.0 == choice,
            _ => class.0.bulk == choice.bulk,
        };
        match classes.iter_mut().find(fits) {
            Some(class) => {
                class.0.substep = class.0.substep.min(choice.substep);
                class.0.is_direct &= choice.is_direct;
                class.1.push(island);
            }
            None => classes.push((choice, vec![island])),
        }
    }
    if classes.is_empty() {
        classes.push((choice::choose(&Island::default(), &model.method, setting), Vec::new()));
    }
    // A shuffled order is one of all bonds.
    let is_divided = !matches!(model.method.order, Order::Shuffled);
    let classes = classes.into_iter().enumerate();
    classes.flat_map(|(class, (choice, islands))| divide(class, choice, islands, is_divided)).collect()
}

/// The groups of a class: large bodies one by one, but for crowds; small islands by the handful.
fn divide(class: usize, choice: Choice, islands: Vec<Island>, is_divided: bool) -> Vec<Lot> {
    let points = islands.iter().map(|island| island.points.len()).sum();
    let lot = |islands| Lot { choice, islands, class, points };
    if !is_divided {
        return vec![lot(islands)];
    }
    let (mut alone, mut together) = (Vec::new(), Vec::new());
    for island in islands {
        let is_alone = choice.bulk.is_some() && island.bonds.len() > MOST_OF_A_CROWD;
        if is_alone { alone.push(lot(vec![island])) } else { together.push(island) }
    }
    if choice.bulk.is_some() {
        alone.extend((!together.is_empty()).then(|| lot(together)));
        return alone;
    }
    let mut lots = vec![lot(Vec::new())];
    let mut count = 0;
    for island in together {
        if count >= FULL {
            lots.push(lot(Vec::new()));
            count = 0;
        }
        count += island.points.len();
        if let Some(last) = lots.last_mut() {
            last.islands.push(island);
        }
    }
    lots
}
