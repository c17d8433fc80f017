//! What is plotted: a series of measurements, the points that are probed, and which of it is looked at.

mod figure;
mod series;
#[cfg(test)]
mod tests;

use super::player::{Measured, Probe, Probed, Probes, REACH, Shown};
use crate::lessons::{self, Plot};
use crate::sim::PointId;
pub(super) use figure::{Curve, svg};
pub(super) use series::Series;

/// Said where the force of a bond is asked for that nobody knows.
const UNKNOWN: &str = "The force of this bond is not known: where bodies meet, where a frame is braced more than it takes, and in methods that sweep, \
                       no state tells it.";
/// Said where force or strain are to be plotted against each other, and there are not two bonds that have them.
const NO_FORCE: &str = "A point has no force and no strain: against each other there are those of two bonds.";

/// What the panel shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Subject {
    /// The energies of the world.
    #[default]
    Energies,
    /// A quantity of the probed points over time.
    Probes,
    /// The same quantity of both points against each other.
    Phase,
    /// A coordinate of each probed point, and its velocity along that axis upwards.
    Orbit,
}

/// What is plotted of a point, or of a bond.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Quantity {
    /// Its first coordinate.
    X,
    /// Its second coordinate.
    Y,
    /// Its third coordinate, in space.
    Z,
    /// Its velocity along the first axis.
    VelocityX,
    /// Its velocity along the second axis.
    VelocityY,
    /// Its velocity along the third axis, in space.
    VelocityZ,
    /// The length of its velocity.
    #[default]
    Speed,
    /// Of a bond: its strain.
    Strain,
    /// Of a spring: its force.
    Force,
}

impl Quantity {
    pub(super) const ALL: [Quantity; 9] = [
        Quantity::X,
        Quantity::Y,
        Quantity::Z,
        Quantity::VelocityX,
        Quantity::VelocityY,
        Quantity::VelocityZ,
        Quantity::Speed,
        Quantity::Strain,
        Quantity::Force,
    ];

    /// Whether space alone has it.
    pub(super) fn is_of_space(self) -> bool {
        matches!(self, Quantity::Z | Quantity::VelocityZ)
    }

    /// Of a coordinate how fast it changes.
    pub(super) fn rate(self) -> Option<Quantity> {
        match self {
            Quantity::X => Some(Quantity::VelocityX),
            Quantity::Y => Some(Quantity::VelocityY),
            Quantity::Z => Some(Quantity::VelocityZ),
            _ => None,
        }
    }

    /// Whether bonds alone have it.
    pub(super) fn is_of_bonds(self) -> bool {
        matches!(self, Quantity::Strain | Quantity::Force)
    }

    /// Its name and its unit.
    pub(super) fn words(self) -> [&'static str; 2] {
        match self {
            Quantity::X => ["x", "m"],
            Quantity::Y => ["y", "m"],
            Quantity::Z => ["z", "m"],
            Quantity::VelocityX => ["velocity x", "m/s"],
            Quantity::VelocityY => ["velocity y", "m/s"],
            Quantity::VelocityZ => ["velocity z", "m/s"],
            Quantity::Speed => ["speed", "m/s"],
            Quantity::Strain => ["strain", "%"],
            Quantity::Force => ["force", "N"],
        }
    }

    /// Of what was probed, in its unit; `None` where that has none of it.
    pub(super) fn of(self, probed: &Probed) -> Option<f64> {
        match self {
            Quantity::X => Some(probed.position[0]),
            Quantity::Y => Some(probed.position[1]),
            Quantity::Z => Some(probed.position[2]),
            Quantity::VelocityX => Some(probed.velocity[0]),
            Quantity::VelocityY => Some(probed.velocity[1]),
            Quantity::VelocityZ => Some(probed.velocity[2]),
            Quantity::Speed => Some(probed.speed()),
            Quantity::Strain => probed.strain.map(|strain| 100.0 * strain),
            Quantity::Force => probed.force,
        }
    }
}

/// All of it. It is there while the panel is open.
#[derive(Clone, Debug)]
pub(super) struct Plots {
    series: Series,
    probes: Probes,
    pub(super) subject: Subject,
    pub(super) quantity: Quantity,
    /// Of the world: 2 or 3.
    dimensions: usize,
}

impl Plots {
    /// Of a scene that plays so many of its seconds a second of wall time.
    pub(super) fn new(rate: f64) -> Self {
        Plots {
            series: Series::new(REACH * rate),
            probes: [None; 2],
            subject: Subject::default(),
            quantity: Quantity::default(),
            dimensions: 2,
        }
    }

    /// The same with what a lesson asks for.
    pub(super) fn of(rate: f64, plot: &Plot) -> Self {
        let (subject, points, quantity) = match plot {
            Plot::Energies => return Plots::new(rate),
            Plot::Probes { points, quantity } => (Subject::Probes, &points[..], quantity),
            Plot::Phase { points, quantity } => (Subject::Phase, &points[..], quantity),
        };
        let quantity = match quantity {
            lessons::Quantity::X => Quantity::X,
            lessons::Quantity::Y => Quantity::Y,
            lessons::Quantity::Speed => Quantity::Speed,
        };
        let probes = std::array::from_fn(|place| points.get(place).copied().map(|point| PointId(point).into()));
        Plots { probes, subject, quantity, ..Plots::new(rate) }
    }

    /// Another scene: nothing was measured yet, and no point of it is probed.
    pub(super) fn begin(&mut self, rate: f64) {
        (self.series, self.probes) = (Series::new(REACH * rate), [None; 2]);
    }

    /// The same points and bonds are probed and the same of them is plotted, but nothing was measured yet.
    pub(super) fn emptied(self, rate: f64) -> Self {
        Plots { series: Series::new(REACH * rate), ..self }
    }

    pub(super) fn series(&self) -> &Series {
        &self.series
    }

    pub(super) fn probes(&self) -> Probes {
        self.probes
    }

    /// Takes what a frame brings. Returns whether there is anything new, and whether probes dropped out with their points.
    pub(super) fn take(&mut self, shown: &Shown) -> [bool; 2] {
        self.dimensions = shown.dimensions;
        if self.dimensions == 2 && self.quantity.is_of_space() {
            (self.quantity, self.subject) = (Quantity::default(), self.without_orbit());
        }
        let is_there = |probe: &Probe| match probe {
            Probe::Point(point) => {
                point.index() < shown.point_count() && shown.scenery.gone.binary_search(point).is_err()
            }
            Probe::Bond(number) => shown.scenery.bond_ends(*number).is_some(),
        };
        let gone: Vec<Probe> = self.probes.into_iter().flatten().filter(|probe| !is_there(probe)).collect();
        gone.iter().for_each(|&probe| self.take_off(probe));
        let mut is_new = false;
        for &measured in &shown.measured {
            let measured = self.of_probes(measured);
            is_new |= self.series.push(measured);
        }
        is_new |= self.series.cut(shown.figures.time);
        [is_new, !gone.is_empty()]
    }

    /// Takes what was before there was somebody to look.
    pub(super) fn take_before(&mut self, list: Vec<Measured>) {
        let list = list.into_iter().map(|measured| self.of_probes(measured)).collect();
        self.series.fill(list);
    }

    /// What was asked for last may not have been measured yet.
    fn of_probes(&self, mut measured: Measured) -> Measured {
        for (probed, probe) in measured.probes.iter_mut().zip(self.probes) {
            probed.take_if(|probed| Some(probed.probe) != probe);
        }
        measured
    }

    /// Whether the force of bonds is looked at, and was known of none of them of late; against each other: not of both.
    pub(super) fn lacks_force(&self) -> bool {
        let last = self.series.iter().last();
        let is_asked = self.quantity == Quantity::Force && self.subject != Subject::Energies;
        let is_of_both = self.subject == Subject::Phase;
        let known = |measured: &Measured| {
            let mut probed = measured.probes.iter().flatten().map(|probed| probed.force.is_some());
            if is_of_both { probed.all(|is_known| is_known) } else { probed.any(|is_known| is_known) }
        };
        is_asked && last.is_some_and(|last| last.probes.iter().any(Option::is_some) && !known(last))
    }

    /// Whether what is probed at a place has the quantity that is plotted: points have no force and no strain.
    pub(super) fn has_curve(&self, place: usize) -> bool {
        match self.probes[place] {
            Some(Probe::Point(_)) => !self.quantity.is_of_bonds(),
            Some(Probe::Bond(_)) => true,
            None => false,
        }
    }

    /// Why nothing is plotted, where there are probes.
    pub(super) fn why_empty(&self) -> Option<&'static str> {
        match self.subject {
            Subject::Phase if !(self.has_curve(0) && self.has_curve(1)) => Some(NO_FORCE),
            _ => self.lacks_force().then_some(UNKNOWN),
        }
    }

    /// Of the world: 2 or 3.
    pub(super) fn dimensions(&self) -> usize {
        self.dimensions
    }

    /// Whether a bond is probed.
    pub(super) fn has_bond(&self) -> bool {
        self.probes.iter().any(|probe| matches!(probe, Some(Probe::Bond(_))))
    }

    /// Puts a probe on a point or a bond, in place of the second if there are two; takes it off where there is one. What is plotted of the
    /// first one is what can change of it: of a bond that keeps its length, as `is_rigid` says, the force.
    pub(super) fn toggle(&mut self, probe: impl Into<Probe>, is_rigid: impl Fn(u32) -> bool) {
        let probe = probe.into();
        if self.probes.contains(&Some(probe)) {
            return self.take_off(probe);
        }
        let place = self.probes.iter().position(Option::is_none).unwrap_or(self.probes.len() - 1);
        self.series.forget(place);
        self.probes[place] = Some(probe);
        if self.subject == Subject::Energies {
            self.subject = Subject::Probes;
        }
        let is_alone = self.probes.iter().flatten().count() == 1;
        self.quantity = match (probe, self.quantity) {
            (Probe::Bond(bond), Quantity::Strain) if is_alone && is_rigid(bond) => Quantity::Force,
            // The middle of a bond has an orbit as a point has.
            (Probe::Bond(bond), quantity) if !quantity.is_of_bonds() && self.subject != Subject::Orbit => {
                if is_rigid(bond) { Quantity::Force } else { Quantity::Strain }
            }
            (_, quantity) => quantity,
        };
        self.suit_quantity();
    }

    /// What is looked at, without orbits.
    fn without_orbit(&self) -> Subject {
        if self.subject == Subject::Orbit { Subject::Probes } else { self.subject }
    }

    /// The quantities that what is probed has.
    pub(super) fn quantities(&self) -> impl Iterator<Item = Quantity> {
        let (has_bond, is_in_space) = (self.has_bond(), self.dimensions == 3);
        let has = move |quantity: &Quantity| {
            (has_bond || !quantity.is_of_bonds()) && (is_in_space || !quantity.is_of_space())
        };
        Quantity::ALL.into_iter().filter(has)
    }

    /// A quantity is plotted over time from now on, or of both probes against each other.
    pub(super) fn choose(&mut self, quantity: Quantity) {
        (self.quantity, self.subject) = (quantity, self.without_orbit());
    }

    /// A coordinate is plotted with how fast it changes from now on.
    pub(super) fn choose_orbit(&mut self, coordinate: Quantity) {
        (self.quantity, self.subject) = (coordinate, Subject::Orbit);
    }

    /// Of points alone no strain is plotted.
    fn suit_quantity(&mut self) {
        if self.quantity.is_of_bonds() && !self.has_bond() {
            self.quantity = Quantity::default();
        }
    }

    fn take_off(&mut self, probe: Probe) {
        for (place, own) in self.probes.iter_mut().enumerate() {
            if own.take_if(|own| *own == probe).is_some() {
                self.series.forget(place);
            }
        }
        self.subject = match (self.subject, self.probes) {
            (Subject::Phase, [Some(_), None] | [None, Some(_)]) => Subject::Probes,
            (Subject::Phase | Subject::Probes | Subject::Orbit, [None, None]) => Subject::Energies,
            (subject, _) => subject,
        };
        self.suit_quantity();
    }
}
