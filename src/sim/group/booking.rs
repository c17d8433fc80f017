//! What a group books: along its way, and where velocities change at once.

use super::Group;
use super::engine::Engine;
use crate::sim::account::{Account, driven, kinetic, middle, power_of, pushed};
use crate::sim::bond::Limit;
use crate::sim::counters::Counters;
use crate::sim::environment::Environment;
use crate::sim::ledger::Book;
use crate::sim::pull::Pull;
use crate::sim::real::Real;
use crate::sim::vector::{dot, length, sub, widen, zero};

/// Share of its length by which a string may be shorter and yet is taut.
const TAUT: f64 = 1e-9;

/// What changes velocities at once.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Cause {
    Grab,
    Pins,
    /// Bonds that get taut.
    Jerk,
}

impl<S: Real, const D: usize> Group<S, D> {
    /// Kinetic energy where an account is kept `[J]`.
    pub(super) fn energy_if_kept(&self) -> Option<f64> {
        self.account.is_some().then(|| kinetic(&self.points.velocity, &self.points.inverse_mass))
    }

    /// Books the change of the kinetic energy since it was `before`, as [`Group::energy_if_kept`] said it.
    pub(super) fn book_change(&mut self, before: Option<f64>, cause: Cause) {
        let (Some(before), Some(now)) = (before, self.energy_if_kept()) else { return };
        let Some(account) = &mut self.account else { return };
        let book = &mut account.book;
        match cause {
            Cause::Grab => book.grab += now - before,
            Cause::Pins => book.pins += now - before,
            // What a jerk made would be the method's own.
            Cause::Jerk => book.impacts += (before - now).max(0.0),
        }
    }

    /// Notes the state at the start of a substep that nothing else needs.
    pub(super) fn note_start(&mut self) {
        if self.account.is_some() {
            self.points.save(&mut self.before);
        }
    }

    /// Books what acted on the way from the state before, at `t` `[s]`, to the present one, `h` later.
    pub(super) fn book_path(&mut self, around: &Environment<D>, (t, h): (f64, f64)) {
        let Some(mut account) = self.account.take() else { return };
        let before = account.book;
        if h > 0.0 {
            let mut pull = self.reacts(&account).then(|| self.pull.clone());
            let mut power =
                |time: f64, x: &[[S; D]], v: &[[S; D]]| self.power(&account, (around, time), (x, v), &mut pull);
            if let Engine::Implicit(implicit) = &self.engine {
                // What it is moved by is that of its stage, and nothing else of what is too fast for the substep.
                if let Some(stage) = implicit.stage() {
                    let mut at_stage = power(t + stage.share * h, stage.place, stage.speed);
                    if stage.is_mean {
                        let way = (&self.before.position[..], stage.place);
                        account.amend_pins(way, (stage.speed, &self.points.inverse_mass), &mut at_stage);
                    }
                    account.book.add(&at_stage, h);
                    let [friction, impacts] = implicit.touches.taken;
                    account.book.friction += friction;
                    account.book.impacts += impacts;
                }
            } else {
                let middle = middle(&self.before, &self.points, h);
                let start = power(t, &self.before.position, &self.before.velocity);
                let half = power(t + 0.5 * h, &middle.position, &middle.velocity);
                let end = power(t + h, &self.points.position, &self.points.velocity);
                for (power, share) in [(start, 1.0), (half, 4.0), (end, 1.0)] {
                    account.book.add(&power, share * h / 6.0);
                }
            }
            let [taken, drawn] = self.engine.tallied();
            account.book.relaxation += taken;
            account.book.pins += drawn;
        }
        if h > 0.0 && self.gets_taut() {
            let at = |state: (&[[S; D]], &[[S; D]])| stored(&self.pull, state, &self.points.inverse_mass);
            let had = at((&self.before.position, &self.before.velocity));
            let has = at((&self.points.position, &self.points.velocity));
            let done = |book: &Book| book.brought() - book.taken();
            account.book.impacts += (had - has + done(&account.book) - done(&before)).max(0.0);
        }
        self.account = Some(account);
    }

    /// Whether a string that the solver decides on was slack before and is not any more: it takes what its ends had of velocity from each other.
    fn gets_taut(&self) -> bool {
        let Some(rigid) = self.pull.rigid.as_ref().filter(|rigid| rigid.chooses_itself()) else { return false };
        let mut strings = rigid.strings();
        strings.any(|(_, row)| {
            let slack = |x: &[[S; D]]| {
                let over = length(sub(x[row.a as usize], x[row.b as usize])) - row.rest_length;
                if row.limit == Limit::Max { -over } else { over }
            };
            let none = row.rest_length * S::from_f64(TAUT);
            slack(&self.before.position) > none && slack(&self.points.position) <= none
        })
    }

    /// Whether what bonds and surfaces answer does work.
    fn reacts(&self, account: &Account) -> bool {
        account.pulls_rigid || !self.engine.meets_surfaces() && self.pull.contacts.rubs()
    }

    /// What acts at a state `[W]`. `pull` is a copy to ask what bonds and surfaces answer, where that does work.
    fn power(
        &self,
        account: &Account,
        (around, t): (&Environment<D>, f64),
        (x, v): (&[[S; D]], &[[S; D]]),
        pull: &mut Option<Pull<S, D>>,
    ) -> Book {
        let w = &self.points.inverse_mass[..];
        let mut power = Book::default();
        account.add_bonds((x, v, w), self.pull.drag_rate, &mut power);
        power.mouse = pushed(&self.pull, around, t, (x, v, w));
        driven((&self.pull, around), t, (x, v, w), &mut power);
        for &i in &self.pull.led {
            power.grab += dot(widen(self.pull.lead), widen(v[i as usize])) / w[i as usize].to_f64();
        }
        let Some(pull) = pull else { return power };
        let mut before = vec![zero(); x.len()];
        let mut counters = Counters::default();
        pull.act(around, t, (x, v, w), &mut before, &mut counters);
        let mut after = before.clone();
        pull.react((x, v), &mut after, &mut counters);
        let rests = if self.engine.meets_surfaces() { &[][..] } else { &pull.contacts.rests };
        for rest in rests {
            let i = rest.point as usize;
            let rubbed = pull.contacts.friction(rest, v[i], rest.pressing);
            power.friction -= dot(widen(rubbed), widen(v[i])) / w[i].to_f64();
        }
        if account.pulls_rigid {
            // All that bonds and surfaces do is done by pins and friction.
            let answers: Vec<[S; D]> = after.iter().zip(&before).map(|(after, before)| sub(*after, *before)).collect();
            power.pins += power_of(&answers, v, w) + power.friction;
        }
        power
    }
}

/// Kinetic energy, that of springs, angles and areas, and gravity's, of points in this state `[J]`.
fn stored<S: Real, const D: usize>(pull: &Pull<S, D>, (x, v): (&[[S; D]], &[[S; D]]), w: &[S]) -> f64 {
    let fall = |i: usize| if w[i] == S::ZERO { 0.0 } else { dot(pull.gravity, widen(x[i])) / w[i].to_f64() };
    kinetic(v, w) + pull.elastic(x) - (0..x.len()).map(fall).sum::<f64>()
}
