//! What is plotted: a series of measurements, the points that are probed, and which of it is looked at.

mod figure;
mod kinds;
mod series;
#[cfg(test)]
mod tests;

use super::player::{Apart, Measured, Probe, Probed, Probes, REACH, Shown};
use crate::lessons::{self, Plot};
use crate::sim::PointId;
pub(super) use figure::{Curve, svg};
pub(super) use kinds::Kind;
pub(super) use series::Series;

/// Said where the force of a bond is asked for that nobody knows.
const UNKNOWN: &str = "The force of this bond is not known: where bodies meet, where a frame is braced more than it takes, and in methods that sweep, \
                       no state tells it.";
/// Said where force or strain are to be plotted against each other, and there are not two bonds that have them.
const NO_FORCE: &str = "A point has no force and no strain: against each other there are those of two bonds.";

/// Said of other quantities that one of the two lacks.
const NOT_OF_BOTH: &str = "One of the two has none of it: against each other there is what both have.";
/// Said where it is asked how far points are from where another world has them, and there is none.
const NOTHING_BESIDE: &str = "Nothing stands beside this world: Compare… puts the same start there by another method.";

/// What the panel shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Subject {
    /// The energies of the world.
    #[default]
    Energies,
    /// What brought energy from outside, by the ledger.
    Brought,
    /// What took energy, by the ledger.
    Taken,
    /// The largest strain of a bond.
    Strain,
    /// A quantity of the probed points over time.
    Probes,
    /// The same quantity of both points against each other.
    Phase,
    /// A coordinate of each probed point, and its velocity along that axis upwards.
    Orbit,
}

impl Subject {
    /// Those that ask for no probe.
    pub(super) const OF_WORLD: [Subject; 4] = [Subject::Energies, Subject::Brought, Subject::Taken, Subject::Strain];

    /// Whether it is of the whole world.
    pub(super) fn is_of_world(self) -> bool {
        Subject::OF_WORLD.contains(&self)
    }

    /// Whether a ledger alone has it.
    pub(super) fn is_of_ledger(self) -> bool {
        matches!(self, Subject::Brought | Subject::Taken)
    }

    /// Its name.
    pub(super) fn words(self) -> &'static str {
        match self {
            Subject::Energies => "energies",
            Subject::Brought => "brought",
            Subject::Taken => "taken",
            Subject::Strain => "largest strain",
            Subject::Probes => "probes",
            Subject::Phase => "against each other",
            Subject::Orbit => "phase portrait",
        }
    }
}

/// What is plotted of a point, of a bond or of an angle, or of two of them.
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
    /// Of a bond: its length.
    Length,
    /// Of a bond in the plane how it is turned; of three points the angle at the second.
    Angle,
    /// Of a point: how far it is from where the first world beside has it.
    Error,
    /// Of two: how far apart they are.
    Distance,
    /// Of two bonds in the plane: the angle from the first to the second.
    Between,
}

impl Quantity {
    pub(super) const ALL: [Quantity; 14] = [
        Quantity::X,
        Quantity::Y,
        Quantity::Z,
        Quantity::VelocityX,
        Quantity::VelocityY,
        Quantity::VelocityZ,
        Quantity::Speed,
        Quantity::Strain,
        Quantity::Force,
        Quantity::Length,
        Quantity::Angle,
        Quantity::Error,
        Quantity::Distance,
        Quantity::Between,
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

    /// Whether the plane alone has it.
    pub(super) fn is_of_plane(self) -> bool {
        matches!(self, Quantity::Angle | Quantity::Between)
    }

    /// Whether it is one number of two probes.
    pub(super) fn is_of_both(self) -> bool {
        matches!(self, Quantity::Distance | Quantity::Between)
    }

    /// Whether it is an angle, which goes on beyond 360 degrees.
    pub(super) fn is_angle(self) -> bool {
        matches!(self, Quantity::Angle | Quantity::Between)
    }

    /// Whether points have none of it.
    pub(super) fn is_of_bonds(self) -> bool {
        use Quantity::{Angle, Between, Force, Length, Strain};
        matches!(self, Strain | Force | Length | Angle | Between)
    }

    /// Whether what is probed has it by itself.
    pub(super) fn is_of(self, probe: Probe) -> bool {
        match probe {
            _ if self.is_of_both() => false,
            Probe::Point(_) => !self.is_of_bonds(),
            Probe::Bond(_) => self != Quantity::Error,
            Probe::Corner(_) => self == Quantity::Angle || !(self.is_of_bonds() || self == Quantity::Error),
        }
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
            Quantity::Length => ["length", "m"],
            Quantity::Angle => ["angle", "°"],
            Quantity::Error => ["error", "m"],
            Quantity::Distance => ["distance of both", "m"],
            Quantity::Between => ["angle of both", "°"],
        }
    }

    /// What is meant by its name, where that alone does not say.
    pub(super) fn explained(self) -> Option<&'static str> {
        (self == Quantity::Error).then_some("how far the first world beside has the point from where it is here")
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
            Quantity::Length => probed.length(),
            Quantity::Angle => probed.angle,
            Quantity::Error => probed.error,
            Quantity::Distance | Quantity::Between => None,
        }
    }

    /// The same of two.
    fn of_both(self, [first, second]: [&Probed; 2]) -> Option<f64> {
        match self {
            Quantity::Distance => Some(first.distance(second)),
            Quantity::Between => first.angle_to(second),
            _ => None,
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
    /// Another world stands beside it; not known before a frame was taken.
    has_beside: Option<bool>,
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
            has_beside: None,
        }
    }

    /// The same with what a lesson asks for.
    pub(super) fn of(rate: f64, plot: &Plot) -> Self {
        let of_points = |points: &[u32]| points.iter().map(|&point| PointId(point).into()).collect::<Vec<Probe>>();
        let (subject, probes, quantity) = match plot {
            Plot::Energies => return Plots::new(rate),
            Plot::Strain => return Plots { subject: Subject::Strain, ..Plots::new(rate) },
            Plot::Probes { points, quantity } => (Subject::Probes, of_points(points), quantity),
            Plot::Bonds { bonds, quantity } => {
                (Subject::Probes, bonds.iter().copied().map(Probe::Bond).collect(), quantity)
            }
            Plot::Angle { points } => {
                (Subject::Probes, vec![Probe::Corner(points.map(PointId))], &lessons::Quantity::Angle)
            }
            Plot::Phase { points, quantity } => (Subject::Phase, of_points(points), quantity),
        };
        let quantity = match quantity {
            lessons::Quantity::X => Quantity::X,
            lessons::Quantity::Y => Quantity::Y,
            lessons::Quantity::Speed => Quantity::Speed,
            lessons::Quantity::Strain => Quantity::Strain,
            lessons::Quantity::Force => Quantity::Force,
            lessons::Quantity::Length => Quantity::Length,
            lessons::Quantity::Angle => Quantity::Angle,
            lessons::Quantity::Error => Quantity::Error,
            lessons::Quantity::Distance => Quantity::Distance,
            lessons::Quantity::Between => Quantity::Between,
        };
        let probes = std::array::from_fn(|place| probes.get(place).copied());
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
        (self.dimensions, self.has_beside) = (shown.dimensions, Some(!shown.beside.is_empty()));
        let is_elsewhere = match self.dimensions {
            2 => self.quantity.is_of_space(),
            3 => self.quantity.is_of_plane(),
            _ => false,
        };
        if is_elsewhere {
            (self.quantity, self.subject) = (Quantity::default(), self.without_orbit());
        }
        let is_there = |probe: &Probe| match probe {
            Probe::Point(point) => has_point(shown, *point),
            Probe::Bond(number) => shown.scenery.bond_ends(*number).is_some(),
            Probe::Corner(points) => points.iter().all(|point| has_point(shown, *point)),
        };
        let gone: Vec<Probe> = self.probes.into_iter().flatten().filter(|probe| !is_there(probe)).collect();
        gone.iter().for_each(|&probe| self.take_off(probe));
        let mut is_new = false;
        for &measured in &shown.measured {
            let measured = self.of_probes(measured);
            is_new |= self.series.push(measured);
        }
        for Apart { time, distances } in &shown.apart {
            is_new |= self.series.know(*time, *distances);
        }
        if self.subject.is_of_ledger() && self.series.iter().last().is_some() && !self.has_ledger() {
            self.subject = Subject::default();
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
        let is_asked = self.quantity == Quantity::Force && !self.subject.is_of_world();
        let is_of_both = self.subject == Subject::Phase;
        let known = |measured: &Measured| {
            let mut probed = measured.probes.iter().flatten().map(|probed| probed.force.is_some());
            if is_of_both { probed.all(|is_known| is_known) } else { probed.any(|is_known| is_known) }
        };
        is_asked && last.is_some_and(|last| last.probes.iter().any(Option::is_some) && !known(last))
    }

    /// Whether the world keeps a ledger.
    pub(super) fn has_ledger(&self) -> bool {
        self.series.iter().last().is_some_and(|last| last.book.is_some())
    }

    /// The kinds of energy that are plotted: those that there were any of, and the usual ones.
    pub(super) fn kinds(&self) -> Vec<Kind> {
        let all = match self.subject {
            Subject::Energies => &kinds::ENERGIES[..],
            Subject::Brought => &kinds::BROUGHT[..],
            Subject::Taken => &kinds::TAKEN[..],
            Subject::Strain | Subject::Probes | Subject::Phase | Subject::Orbit => &[],
        };
        all.iter().filter(|kind| kind.is_seen(self.series.iter())).copied().collect()
    }

    /// Whether what is probed at a place has a curve of the quantity that is plotted: points have no force and no strain, and what is of both is the first's.
    pub(super) fn has_curve(&self, place: usize) -> bool {
        match self.quantity {
            Quantity::Distance => place == 0 && self.probes.iter().all(Option::is_some),
            Quantity::Between => place == 0 && self.probes.iter().all(|probe| matches!(probe, Some(Probe::Bond(_)))),
            quantity => self.probes[place].is_some_and(|probe| quantity.is_of(probe)),
        }
    }

    /// The quantity that is plotted of what is probed at a place, or of both for the first place.
    pub(super) fn value(&self, measured: &Measured, place: usize) -> Option<f64> {
        match (self.quantity.is_of_both(), &measured.probes) {
            (true, [Some(first), Some(second)]) if place == 0 => self.quantity.of_both([first, second]),
            (true, _) => None,
            (false, probes) => self.quantity.of(probes[place].as_ref()?),
        }
    }

    /// That over time, in s and its unit; an angle goes on beyond 0 and 360 degrees.
    pub(super) fn over_time(&self, place: usize) -> Vec<[f64; 2]> {
        let mut last: Option<f64> = None;
        let mut on = |value: f64| {
            let turns = last.filter(|_| self.quantity.is_angle()).map_or(0.0, |last| ((last - value) / 360.0).round());
            let value = value + 360.0 * turns;
            last = Some(value);
            value
        };
        let times = self.series.iter().filter_map(|measured| Some((measured.time, self.value(measured, place)?)));
        times.map(|(time, value)| [time, on(value)]).collect()
    }

    /// Why nothing is plotted, where there are probes.
    pub(super) fn why_empty(&self) -> Option<&'static str> {
        let lacks = |place: usize| self.probes[place].is_some() && !self.has_curve(place);
        match (self.subject, self.quantity) {
            (Subject::Phase, quantity) if lacks(0) || lacks(1) => {
                Some(if matches!(quantity, Quantity::Strain | Quantity::Force) { NO_FORCE } else { NOT_OF_BOTH })
            }
            (Subject::Phase | Subject::Probes, Quantity::Error) if self.has_beside == Some(false) => {
                Some(NOTHING_BESIDE)
            }
            _ => self.lacks_force().then_some(UNKNOWN),
        }
    }

    /// Of the world: 2 or 3.
    pub(super) fn dimensions(&self) -> usize {
        self.dimensions
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
        if self.subject.is_of_world() {
            self.subject = Subject::Probes;
        }
        let is_alone = self.probes.iter().flatten().count() == 1;
        self.quantity = match (probe, self.quantity) {
            (Probe::Bond(bond), Quantity::Strain) if is_alone && is_rigid(bond) => Quantity::Force,
            // The middle of a bond has an orbit as a point has.
            (Probe::Bond(bond), quantity)
                if !(quantity.is_of_bonds() || quantity.is_of_both()) && self.subject != Subject::Orbit =>
            {
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
        let (probes, is_in_space, has_beside) = (self.probes, self.dimensions == 3, self.has_beside == Some(true));
        let of_each = move |quantity: Quantity| match quantity {
            Quantity::Distance => probes.iter().all(Option::is_some),
            Quantity::Between => probes.iter().all(|probe| matches!(probe, Some(Probe::Bond(_)))),
            Quantity::Error if !has_beside => false,
            _ => probes.into_iter().flatten().any(|probe| quantity.is_of(probe)),
        };
        let has = move |quantity: &Quantity| {
            of_each(*quantity) && if is_in_space { !quantity.is_of_plane() } else { !quantity.is_of_space() }
        };
        Quantity::ALL.into_iter().filter(has)
    }

    /// A quantity is plotted over time from now on, or of both probes against each other.
    pub(super) fn choose(&mut self, quantity: Quantity) {
        self.subject = if quantity.is_of_both() { Subject::Probes } else { self.without_orbit() };
        self.quantity = quantity;
    }

    /// Both probes are plotted against each other from now on: each by a quantity of its own.
    pub(super) fn oppose(&mut self) {
        self.subject = Subject::Phase;
        if self.quantity.is_of_both() {
            self.quantity = Quantity::default();
        }
    }

    /// A coordinate is plotted with how fast it changes from now on.
    pub(super) fn choose_orbit(&mut self, coordinate: Quantity) {
        (self.quantity, self.subject) = (coordinate, Subject::Orbit);
    }

    /// What none of the probes has is not plotted: of points alone no strain, of one alone no distance.
    fn suit_quantity(&mut self) {
        let is_there = |place: usize| self.has_curve(place);
        let is_lost = self.quantity.is_of_bonds() || self.quantity.is_of_both();
        if is_lost && !(is_there(0) || is_there(1)) {
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

/// Whether a point is there.
fn has_point(shown: &Shown, point: PointId) -> bool {
    point.index() < shown.point_count() && shown.scenery.gone.binary_search(&point).is_err()
}
