//! What the window is handed of a moment: states, figures, and what stands about the points.

use std::sync::Arc;
use std::time::{Duration, Instant};

use super::super::movers::movers;
use super::super::named::in_world;
use super::super::shown::{Figures, Scenery, Shown};
use super::Stage;
use crate::app::matter::{Matter, Placed, mean_velocity};
use crate::scene::{MethodKeys, SolverName};
use crate::sim::Dynamics;

/// How often figures are taken that cost something: nobody reads faster.
const FIGURES_EVERY: Duration = Duration::from_millis(100);

/// So many methods of a world are named at most.
const MOST_NAMED: usize = 2;

/// What moves the islands of a world, by its name; `""`: too many.
fn methods(world: &dyn Dynamics) -> String {
    let mut names: Vec<&str> = world.moved_by().iter().map(|one| one.method.name()).collect();
    names.sort_unstable();
    names.dedup();
    if names.len() > MOST_NAMED { String::new() } else { names.join(" and ") }
}

/// A method in words, with what it comes to where rules choose.
fn titled(method: &MethodKeys, by: &str) -> String {
    let (words, chosen) = (method.words(), SolverName::Auto.words());
    if by.is_empty() { words } else { words.replacen(chosen, &format!("{chosen} ({by})"), 1) }
}

impl Stage {
    /// Looks what is shown is made of now.
    pub(super) fn inspect(&mut self) {
        let is_wanted = !self.among.is_empty();
        let known = (&**self.history.tints(), self.history.body_names());
        // What is led there is shown as it will be.
        let ahead = if is_wanted { self.history.ahead() } else { None };
        let world = ahead.as_deref().unwrap_or(self.history.world());
        let matter = is_wanted.then(|| Matter::of((world, &self.former), known, &self.among)).flatten();
        self.matter = matter.map(Arc::new);
        self.velocity = mean_velocity(self.history.world(), &self.among.points);
        self.placed = Placed::of(self.history.world(), &self.among);
    }

    /// Looks what undo would take back and redo would bring again.
    pub(super) fn look_for_ways(&mut self) {
        self.ways = [self.history.undoes(), self.history.redoes()];
    }

    /// What stands about the points is looked at again if it changed.
    pub(super) fn look(&mut self) {
        let world = self.history.world();
        let (tints, groups) = (self.history.tints(), self.history.named());
        let is_dressed = Arc::ptr_eq(tints, &self.scenery.tints) && Arc::ptr_eq(groups, &self.scenery.groups);
        let is_dressed = is_dressed && self.worn == self.history.worn();
        if self.topology != Some(world.topology()) || !is_dressed {
            self.topology = Some(world.topology());
            self.sceneries += 1;
            self.worn = self.history.worn();
            let mut scenery = Scenery::of(world, self.history.skins(), (tints, groups));
            scenery.named = self.named.iter().map(|parameter| in_world(&parameter.target, world)).collect();
            scenery.warnings.splice(0..0, self.history.notes().iter().cloned());
            self.scenery = Arc::new(scenery);
            self.inspect();
        }
    }

    /// Puts the present moment into `shown`, whose memory is used again.
    pub fn show(&mut self, shown: &mut Shown) {
        let moves = self.pace.is_moving(&self.history);
        let world = self.history.world();
        if !moves || self.figures_at.is_none_or(|at| at.elapsed() >= FIGURES_EVERY) {
            self.energy = world.energy();
            self.velocity = mean_velocity(world, &self.among.points);
            self.placed = Placed::of(world, &self.among);
            self.movers = movers(world);
            self.by = if self.history.companions().is_empty() { String::new() } else { methods(world) };
            self.relaxed.look(&self.history);
            self.acts = self.deeds.look(world.counters(), Instant::now());
            self.yielded = self.rungs.yielded(&self.history);
            self.ways = [self.history.undoes(), self.history.redoes()];
            self.figures_at = Some(Instant::now());
            if self.has_gone {
                self.branches = self.history.branches().into();
            }
        }
        shown.dimensions = world.dimensions();
        shown.current.copy(world.positions());
        shown.previous.clone_from(&self.pace.previous);
        // What was added since has no place before.
        if shown.previous.view().len() != shown.current.view().len() {
            shown.previous.clone_from(&shown.current);
        }
        shown.mix = self.pace.mix(world);
        (shown.motion, shown.topology) = (self.pace.motion, self.sceneries);
        (shown.latest, self.is_latest_shown) = (self.latest, true);
        shown.scenery = Arc::clone(&self.scenery);
        let mouse = world.mouse();
        if let Some((force, _)) = mouse
            && self.force.as_ref() != Some(force)
        {
            self.force = Some(force.clone());
        }
        shown.mouse.clone_from(&self.force);
        (shown.cursor, shown.grab) = (mouse.map(|(_, cursor)| cursor), world.grab());
        shown.starts = self.history.scene().click_start.is_some();
        shown.jam = self.jam.clone().filter(|_| self.is_dragging());
        (shown.base, shown.settings, shown.driving) = (self.base, world.settings(), world.driving());
        shown.figures = self.figures(world);
        self.pace.watch.hand_out((self.history.world(), moves), &mut shown.measured);
        self.pace.watch.hand_out_apart(&mut shown.apart);
        shown.matter.clone_from(&self.matter);
        shown.labels = Arc::clone(self.history.labels());
        let has_beside = !self.history.companions().is_empty();
        shown.title = if has_beside { titled(&self.history.method(), &self.by) } else { String::new() };
        shown.rests = world.is_asleep();
        self.escort.show(&self.history, &self.pace, shown.mix, &mut shown.beside);
    }

    pub(super) fn figures(&self, world: &dyn Dynamics) -> Figures {
        let [undoes, redoes] = self.ways.clone();
        Figures {
            time: world.time(),
            end: self.history.end(),
            follows: self.history.has_future(),
            playing: self.pace.playing,
            asleep: self.history.rests(),
            behind: self.escort.is_behind(&self.history),
            ended: self.pace.is_at_end(&self.history),
            rate: self.pace.rate,
            clock: self.clock,
            pace: self.reached.value(),
            step: self.steps.value(),
            work: self.works.value(),
            cost: self.costs.value(),
            points: world.point_count() - world.gone().len(),
            bonds: world.bonds().len(),
            energy: self.energy,
            velocity: self.velocity,
            placed: self.placed,
            movers: Arc::clone(&self.movers),
            relaxed: self.relaxed.stiffness(),
            yielded: self.yielded,
            acts: self.acts,
            substeps: self.substeps,
            branches: Arc::clone(&self.branches),
            undoes,
            redoes,
        }
    }
}
