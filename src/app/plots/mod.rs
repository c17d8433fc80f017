//! What is plotted: a series of measurements, the points that are probed, and which of it is looked at.

mod series;
#[cfg(test)]
mod tests;

use super::player::{Probed, Probes, Shown};
use crate::lessons::{self, Plot};
use crate::sim::PointId;
pub(super) use series::Series;

/// The series reaches back so many seconds of wall time at the scene's own pace `[s]`.
const REACH: f64 = 20.0;

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
}

/// What is plotted of a point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Quantity {
    /// Its first coordinate.
    X,
    /// Its second coordinate.
    #[default]
    Y,
    /// The length of its velocity.
    Speed,
}

impl Quantity {
    pub(super) const ALL: [Quantity; 3] = [Quantity::X, Quantity::Y, Quantity::Speed];

    /// Its name and its unit.
    pub(super) fn words(self) -> [&'static str; 2] {
        match self {
            Quantity::X => ["x", "m"],
            Quantity::Y => ["y", "m"],
            Quantity::Speed => ["speed", "m/s"],
        }
    }

    pub(super) fn of(self, probed: &Probed) -> f64 {
        match self {
            Quantity::X => probed.position[0],
            Quantity::Y => probed.position[1],
            Quantity::Speed => probed.speed,
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
}

impl Plots {
    /// Of a scene that plays so many of its seconds a second of wall time.
    pub(super) fn new(rate: f64) -> Self {
        Plots {
            series: Series::new(REACH * rate),
            probes: [None; 2],
            subject: Subject::default(),
            quantity: Quantity::default(),
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
        let probes = std::array::from_fn(|place| points.get(place).copied().map(PointId));
        Plots { probes, subject, quantity, ..Plots::new(rate) }
    }

    /// Another scene: nothing was measured yet, and no point of it is probed.
    pub(super) fn begin(&mut self, rate: f64) {
        (self.series, self.probes) = (Series::new(REACH * rate), [None; 2]);
    }

    pub(super) fn series(&self) -> &Series {
        &self.series
    }

    pub(super) fn probes(&self) -> Probes {
        self.probes
    }

    /// Takes what a frame brings. Returns whether there is anything new, and whether probes dropped out with their points.
    pub(super) fn take(&mut self, shown: &Shown) -> [bool; 2] {
        let mut is_new = self.series.cut(shown.figures.time);
        let is_there =
            |point: &PointId| point.index() < shown.point_count() && shown.scenery.gone.binary_search(point).is_err();
        let gone: Vec<PointId> = self.probes.into_iter().flatten().filter(|point| !is_there(point)).collect();
        gone.iter().for_each(|&point| self.take_off(point));
        if let Some(mut measured) = shown.measured {
            // What was asked for last may not have been measured yet.
            for (probed, point) in measured.probes.iter_mut().zip(self.probes) {
                probed.take_if(|probed| Some(probed.point) != point);
            }
            is_new |= self.series.push(measured);
        }
        [is_new, !gone.is_empty()]
    }

    /// Puts a probe on a point, in place of the second if there are two; takes it off where there is one.
    pub(super) fn toggle(&mut self, point: PointId) {
        if self.probes.contains(&Some(point)) {
            return self.take_off(point);
        }
        let place = self.probes.iter().position(Option::is_none).unwrap_or(self.probes.len() - 1);
        self.series.forget(place);
        self.probes[place] = Some(point);
        if self.subject == Subject::Energies {
            self.subject = Subject::Probes;
        }
    }

    fn take_off(&mut self, point: PointId) {
        for (place, probe) in self.probes.iter_mut().enumerate() {
            if probe.take_if(|probe| *probe == point).is_some() {
                self.series.forget(place);
            }
        }
        self.subject = match (self.subject, self.probes) {
            (Subject::Phase, [Some(_), None] | [None, Some(_)]) => Subject::Probes,
            (Subject::Phase | Subject::Probes, [None, None]) => Subject::Energies,
            (subject, _) => subject,
        };
    }
}
