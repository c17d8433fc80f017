//! Measurements of one world, ascending in time.

use std::collections::VecDeque;
use std::io::Write;

use super::kinds::{BROUGHT, ENERGIES, TAKEN};
use crate::app::player::{EVERY, Measured, Probe, REACH};

/// So many are kept at most: seven for each pixel of a plot's width.
pub(super) const MOST: usize = 2400;

/// The measurements of the last while.
#[derive(Clone, Debug)]
pub(in crate::app) struct Series {
    list: VecDeque<Measured>,
    /// How far back it reaches `[s]`.
    span: f64,
}

impl Series {
    /// An empty one that is to reach back so far `[s]`.
    pub(super) fn new(span: f64) -> Self {
        Series { list: VecDeque::new(), span }
    }

    /// All of them.
    pub(in crate::app) fn iter(&self) -> impl Iterator<Item = &Measured> {
        self.list.iter()
    }

    /// The world went to this time `[s]`: what is later has not been yet. Returns whether there was any.
    pub(super) fn cut(&mut self, time: f64) -> bool {
        let before = self.list.len();
        self.list.truncate(self.list.partition_point(|measured| measured.time <= time));
        self.list.len() < before
    }

    /// Adds a measurement after those of before its time, of which a passing one goes. Where one follows on the last but one closely, the last goes, so that what is
    /// kept is spread evenly over the span however small the steps are. Returns whether it was added: energies that are no finite numbers
    /// are not.
    pub(super) fn push(&mut self, mut measured: Measured) -> bool {
        if !measured.energies.sum().is_finite() {
            return false;
        }
        self.take_over_errors(&mut measured);
        let (now, gap) = (measured.time, self.span / (MOST - 2) as f64);
        self.list.truncate(self.list.partition_point(|earlier| earlier.time < now));
        if self.list.back().is_some_and(|last| last.is_passing) {
            self.list.pop_back();
        }
        if let [.., first, second] = self.list.make_contiguous()
            && second.time - first.time < gap
        {
            self.list.pop_back();
        }
        self.list.push_back(measured);
        while self.list.len() > MOST || self.list.front().is_some_and(|first| first.time < now - self.span) {
            self.list.pop_front();
        }
        true
    }

    /// What is measured anew at a time is as far from where another world has it as was known of the same probe in the same place then.
    fn take_over_errors(&self, measured: &mut Measured) {
        let place = self.list.partition_point(|earlier| earlier.time < measured.time);
        let Some(before) = self.list.get(place).filter(|before| before.time == measured.time) else { return };
        for (now, before) in measured.probes.iter_mut().zip(&before.probes) {
            if let (Some(now), Some(before)) = (now, before)
                && (now.probe, now.position) == (before.probe, before.position)
            {
                now.error = now.error.or(before.error);
            }
        }
    }

    /// Of something that was measured at this time `[s]` it is known how far each probe is from where another world has it `[m]`. Returns whether
    /// that is there still.
    pub(super) fn know(&mut self, time: f64, distances: [Option<f64>; 2]) -> bool {
        let place = self.list.partition_point(|measured| measured.time < time);
        let Some(measured) = self.list.get_mut(place).filter(|measured| measured.time == time) else { return false };
        for (probed, distance) in measured.probes.iter_mut().zip(distances) {
            if let Some(probed) = probed {
                probed.error = distance.or(probed.error);
            }
        }
        true
    }

    /// Adds measurements of times that had been before to those that are there, spread as those are.
    pub(super) fn fill(&mut self, list: Vec<Measured>) {
        let Some(now) = self.list.back().or(list.last()).map(|last| last.time) else { return };
        let present = self.list.back().copied().filter(|last| last.is_passing);
        if present.is_some() {
            self.list.pop_back();
        }
        let is_known = |measured: &Measured| measured.energies.sum().is_finite() && measured.time <= now;
        let mut all: Vec<Measured> = list.into_iter().filter(is_known).chain(std::mem::take(&mut self.list)).collect();
        all.sort_by(|a, b| a.time.total_cmp(&b.time));
        self.leave_out_between(&mut all);
        let gap = self.span / (MOST - 2) as f64;
        let count = |measured: &Measured| measured.probes.iter().flatten().count();
        for measured in all.into_iter().rev() {
            let is_full = self.list.len() == MOST;
            match self.list.front_mut() {
                // Of two that are near the one that knows more.
                Some(next) if next.time - measured.time < gap => {
                    if count(&measured) > count(next) {
                        *next = measured;
                    }
                }
                _ if measured.time < now - self.span || is_full => break,
                _ => self.list.push_front(measured),
            }
        }
        self.list.extend(present);
    }

    /// Of an ascending list leaves out what is of no fixed time where there is something of a fixed time near it; what is left is as good as that.
    fn leave_out_between(&self, all: &mut Vec<Measured>) {
        let fixed: Vec<f64> = all.iter().filter(|one| !one.is_passing).map(|one| one.time).collect();
        let apart = 0.999 * self.span * EVERY / REACH;
        let is_alone = |time: f64| {
            let next = fixed.partition_point(|other| *other < time);
            let beside = &fixed[next.saturating_sub(1)..fixed.len().min(next + 1)];
            beside.iter().all(|other| *other == time || (other - time).abs() >= apart)
        };
        all.retain(|one| !one.is_passing || is_alone(one.time));
        all.iter_mut().for_each(|one| one.is_passing = false);
    }

    /// What was measured at one of the probes' places goes: another point is there from now on, or none.
    pub(super) fn forget(&mut self, place: usize) {
        self.list.iter_mut().for_each(|measured| measured.probes[place] = None);
    }

    /// Writes a table with a row for each measurement at a fixed time, of a world of so many dimensions; a column is left empty where nothing was
    /// probed that has it.
    ///
    /// Errors: whatever `to` answers.
    pub(in crate::app) fn write_csv(&self, dimensions: usize, to: &mut dyn Write) -> std::io::Result<()> {
        let axes = || ["x", "y", "z"].into_iter().take(dimensions);
        let components = |vector: [f64; 3]| {
            let all = vector.into_iter().take(dimensions).map(|number| format!(",{number}"));
            all.collect::<String>()
        };
        let books = [("brought", &BROUGHT[..]), ("taken", &TAKEN[..])];
        let has_ledger = self.list.iter().any(|measured| measured.book.is_some());
        let works = || {
            books.into_iter().filter(|_| has_ledger).flat_map(|(way, kinds)| kinds.iter().map(move |kind| (way, kind)))
        };
        write!(to, "time_s")?;
        ENERGIES.iter().try_for_each(|kind| write!(to, ",{}_J", kind.name))?;
        write!(to, ",largest_strain")?;
        for number in 1..=2 {
            write!(to, ",point_{number},bond_{number}")?;
            axes().try_for_each(|axis| write!(to, ",{axis}_{number}_m"))?;
            write!(to, ",speed_{number}_m/s")?;
            axes().try_for_each(|axis| write!(to, ",v{axis}_{number}_m/s"))?;
            write!(to, ",strain_{number},force_{number}_N,length_{number}_m,angle_{number}_degrees,beside_{number}_m")?;
        }
        write!(to, ",distance_m")?;
        works().try_for_each(|(way, kind)| write!(to, ",{way}_{}_J", kind.name))?;
        let at_their_times = self.list.iter().filter(|measured| !measured.is_passing);
        for measured in at_their_times {
            write!(to, "\n{}", measured.time)?;
            ENERGIES.iter().try_for_each(|kind| write!(to, ",{}", (kind.of)(measured)))?;
            write!(to, ",{}", measured.strain)?;
            let said = |number: Option<f64>| number.map_or(String::new(), |number| number.to_string());
            for probe in &measured.probes {
                match probe {
                    Some(probed) => {
                        let [position, velocity] = [probed.position, probed.velocity].map(components);
                        let names = match probed.probe {
                            Probe::Point(point) | Probe::Corner([_, point, _]) => format!("{},", point.0),
                            Probe::Bond(number) => format!(",{number}"),
                        };
                        let others = [probed.strain, probed.force, probed.length(), probed.angle, probed.error];
                        write!(to, ",{names}{position},{}{velocity}", probed.speed())?;
                        others.into_iter().try_for_each(|number| write!(to, ",{}", said(number)))?;
                    }
                    None => write!(to, "{}", ",".repeat(8 + 2 * dimensions))?,
                }
            }
            let [first, second] = &measured.probes;
            let apart = first.as_ref().zip(second.as_ref()).map(|(first, second)| first.distance(second));
            write!(to, ",{}", said(apart))?;
            works().try_for_each(|(_, kind)| write!(to, ",{}", (kind.of)(measured)))?;
        }
        writeln!(to)
    }
}
