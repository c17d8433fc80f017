//! The ledger of a world: what its groups book, and what changes between their steps.
//!
//! Books stay with their groups, so that one that is taken back to an earlier state forgets what it booked since; the world has those
//! of groups that are no more.

use super::World;
use crate::sim::account::kinetic;
use crate::sim::bond::PointId;
use crate::sim::command::{Applied, Command, CommandError};
use crate::sim::ledger::{Book, Totals};
use crate::sim::measure;
use crate::sim::real::Real;
use crate::sim::vector::length;

/// Speed that nobody sees `[m/s]`.
const UNSEEN: f64 = 0.01;

impl<S: Real, const D: usize> World<S, D> {
    /// The ledger begins with the energy that there is, if one is to be kept.
    pub(super) fn begin_ledger(&mut self) {
        if self.model.method.ledger {
            for account in self.plan.groups.iter_mut().filter_map(|group| group.account.as_mut()) {
                account.book = Book::default();
            }
            let (start, most_kinetic) = (self.energy_booked(), self.kinetic());
            let speed = UNSEEN.max(length(self.around.gravity) / 60.0);
            let mass: f64 = self.inverse_mass.iter().filter(|w| **w > 0.0).map(|w| 1.0 / w).sum();
            let unseen = 0.5 * mass * speed * speed;
            self.ledger = Some(Totals { start, book: Book::default(), most_kinetic, unseen });
        }
    }

    /// All that was booked since the start.
    pub(super) fn book(&self) -> Book {
        let mut book = self.ledger.map_or(Book::default(), |totals| totals.book);
        for account in self.plan.groups.iter().filter_map(|group| group.account.as_ref()) {
            book.add(&account.book, 1.0);
        }
        book
    }

    /// Energy between pins of which some are led `[J]`, where a ledger is kept: no group has what joins pins alone.
    pub(crate) fn energy_between_pins(&self) -> Option<f64> {
        self.ledger.as_ref().filter(|_| !self.model.pin_motion.is_empty())?;
        let is_pin = |point: &PointId| self.inverse_mass[point.index()] == 0.0;
        let place = |i: usize| self.place(i);
        let bonds = self.bonds.iter().filter(|bond| is_pin(&bond.a) && is_pin(&bond.b));
        let springs: f64 = bonds.map(|bond| measure::spring_energy(&bond, place)).sum();
        Some(
            springs + self.model.form_energy_of(|points| points.iter().all(is_pin), place, |i| self.stops_by_spring(i)),
        )
    }

    /// What changed between pins since `before`, as [`World::energy_between_pins`] said it, is work of those that are led.
    pub(crate) fn book_between_pins(&mut self, before: Option<f64>) {
        if let (Some(before), Some(now), Some(totals)) = (before, self.energy_between_pins(), &mut self.ledger) {
            totals.book.pins += now - before;
        }
    }

    /// After a step: the largest kinetic energy is known anew.
    pub(crate) fn note_kinetic(&mut self) {
        if self.ledger.is_some() {
            let kinetic = self.kinetic();
            if let Some(totals) = &mut self.ledger {
                // A maximum with what is no number is the other one.
                totals.most_kinetic = totals.most_kinetic.max(kinetic);
            }
        }
    }

    /// A group is about to be no more.
    pub(crate) fn close_account(&mut self, place: usize) {
        if let (Some(totals), Some(account)) = (&mut self.ledger, &self.plan.groups[place].account) {
            totals.book.add(&account.book, 1.0);
        }
    }

    /// Takes bonds away that broke: their springs' energy goes with them. Returns as `tear`.
    pub(crate) fn tear_booked(&mut self, torn: &[u32], t: f64) -> Vec<usize> {
        if self.ledger.is_none() {
            return self.tear(torn, t);
        }
        let before = self.springs_energy();
        let places = self.tear(torn, t);
        let after = self.springs_energy();
        if let Some(totals) = &mut self.ledger {
            totals.book.breaks += before - after;
        }
        places
    }

    /// Does a command; what it makes of the energy is from outside.
    pub(super) fn edit_booked(&mut self, command: &Command) -> Result<Applied, CommandError> {
        let leads = matches!(
            command,
            Command::Cursor { .. } | Command::Mouse(_) | Command::Grab(_) | Command::Release | Command::Key { .. }
        );
        if self.ledger.is_none() || leads {
            return self.edit(command);
        }
        // What is booked meanwhile, such as a pin that passes its velocity on, is not the command's.
        let left = |world: &Self| world.energy_booked() - world.book().brought() + world.book().taken();
        let before = left(self);
        let applied = self.edit(command)?;
        let after = left(self);
        if let Some(totals) = &mut self.ledger {
            totals.book.commands += after - before;
        }
        Ok(applied)
    }

    /// The energy of the present state as the ledger says it `[J]`: velocities of large bodies at the time of their places.
    fn energy_booked(&self) -> f64 {
        let mut copy = self.clone();
        let t = self.timeline.time();
        copy.plan.groups.iter_mut().for_each(|group| group.centre_velocity(&self.around, t));
        copy.present().energy
    }

    fn springs_energy(&self) -> f64 {
        measure::springs_energy(&self.bonds, |i| self.place(i))
            + self.model.form_energy(|i| self.place(i), |i| self.stops_by_spring(i))
            + self.model.penalty_energy(self.free_places(&|i| self.place(i)))
    }

    /// The places of all points that can move `[m]`.
    pub(super) fn free_places<'a>(
        &'a self,
        place: &'a impl Fn(usize) -> [f64; D],
    ) -> impl Iterator<Item = [f64; D]> + Clone + 'a {
        (0..self.inverse_mass.len()).filter(|&i| self.inverse_mass[i] > 0.0).map(place)
    }

    fn kinetic(&self) -> f64 {
        self.plan.groups.iter().map(|group| kinetic(&group.points.velocity, &group.points.inverse_mass)).sum()
    }
}
