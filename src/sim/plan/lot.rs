//! Islands that go together: what one method moves at one substep, in groups that step and sleep each for itself.

use super::choice::{self, Choice, Setting};
use super::drive::gust_rate;
use super::island::Island;
use crate::sim::bulk::control::FRAME;
use crate::sim::model::{Method, Model};
use crate::sim::sizes::{MOST_ALIKE_BONDS, MOST_LOOSE};
use crate::sim::solver::{Order, Solver};

/// Of islands that their own methods move.
pub(crate) const OWN: u32 = u32::MAX;

/// Islands that make a group.
pub(super) struct Lot {
    pub(super) choice: Choice,
    pub(super) islands: Vec<Island>,
    /// Which islands have one method and substep: groups of one class count as one for those who ask.
    pub(super) class: usize,
    /// Points that can move: its own; of loose points those of all of its class.
    pub(super) points: usize,
}

/// Islands by method and substep, in the order of their first points.
///
/// A method that was asked for by name moves all islands at the substep of the fastest; large bodies apart from what is
/// none, and from those that follow another strain.
///
/// `scene_points` is how many points the scene had when the world began: what is added elsewhere later changes no choice. Islands with
/// points that have a number in `live` are moved by the live step, each for itself, or, where bodies may meet, all of a number together.
pub(super) fn lots<const D: usize>(
    model: &Model<D>,
    (has_surfaces, scene_points): (bool, usize),
    islands: Vec<Island>,
    live: &[u32],
) -> Vec<Lot> {
    if model.is_live() {
        return vec![together(live_choice(model.method), 0, islands)];
    }
    let setting = Setting {
        has_surfaces,
        mouse: model.mouse.as_ref().map(|mouse| mouse.strength),
        drag_rate: model.drag_rate,
        gusts: gust_rate(model),
        points: scene_points,
    };
    let needs_live = |island: &Island| {
        D == 2 && model.method.solver == Solver::Auto && island.needs_live(has_surfaces || model.contact.is_some())
    };
    let number = |island: &Island| {
        let handed = island.points.iter().filter_map(|&i| live.get(i as usize)).min().copied();
        handed.filter(|&number| number != OWN).or_else(|| needs_live(island).then(|| island.points[0]))
    };
    let is_forced = |island: &Island| number(island).is_some();
    let (forced, islands): (Vec<Island>, Vec<Island>) = islands.into_iter().partition(is_forced);
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
    if classes.is_empty() && forced.is_empty() {
        classes.push((choice::choose(&Island::default(), &model.method, setting), Vec::new()));
    }
    // A shuffled order is one of all bonds.
    let is_divided = !matches!(model.method.order, Order::Shuffled);
    let meets = model.meets_on_demand();
    if meets && !model.pinned.is_empty() {
        // Pins that nothing is fastened to are with nobody: they would make the box of a body large.
        classes.insert(0, (choice::choose(&Island::default(), &model.method, setting), Vec::new()));
    }
    let mut met: Vec<(u32, Vec<Island>)> = Vec::new();
    if !meets && !forced.is_empty() {
        classes.push((live_choice(model.method), forced));
    } else {
        for island in forced {
            let of = number(&island).unwrap_or(OWN);
            match met.iter_mut().find(|group| group.0 == of) {
                Some(group) => group.1.push(island),
                None => met.push((of, vec![island])),
            }
        }
    }
    let last = classes.len();
    let classes = classes.into_iter().enumerate();
    let own = classes.flat_map(|(class, (choice, islands))| divide((class, choice), islands, (is_divided, meets)));
    let met = met.into_iter().map(|(_, islands)| together(live_choice(model.method), last, islands));
    own.chain(met).collect()
}

/// Islands that may meet.
fn together(choice: Choice, class: usize, islands: Vec<Island>) -> Lot {
    Lot { choice, points: islands.iter().map(|island| island.points.len()).sum(), islands, class }
}

fn live_choice(method: Method) -> Choice {
    let substep = method.substep.map_or(FRAME, |given| given.min(FRAME));
    Choice { solver: Solver::Live, substep, is_direct: false, plain: None, bulk: None }
}

/// The groups of a class: bodies one by one, but for crowds of what does not meet and loose points, so that what happens to one leaves
/// the others as they are.
fn divide((class, choice): (usize, Choice), islands: Vec<Island>, (is_divided, meets): (bool, bool)) -> Vec<Lot> {
    let count = |islands: &[Island]| islands.iter().map(|island| island.points.len()).sum();
    let lot = |islands: Vec<Island>| together(choice, class, islands);
    if !is_divided && !meets {
        return vec![lot(islands)];
    }
    let is_alone = |island: &Island| match choice.bulk {
        Some(_) => meets || island.bonds.len() > MOST_ALIKE_BONDS,
        None => !island.bonds.is_empty() || island.has_form(),
    };
    let (alone, together): (Vec<Island>, Vec<Island>) = islands.into_iter().partition(is_alone);
    let mut lots: Vec<Lot> = alone.into_iter().map(|island| lot(vec![island])).collect();
    if choice.bulk.is_some() {
        lots.extend((!together.is_empty()).then(|| lot(together)));
        return lots;
    }
    let points = count(&together);
    // Loose points are islands of one: handed out in order.
    let mut together = together.into_iter().peekable();
    while together.peek().is_some() {
        lots.push(Lot { points, ..lot(together.by_ref().take(MOST_LOOSE).collect()) });
    }
    if lots.is_empty() { vec![lot(Vec::new())] } else { lots }
}
