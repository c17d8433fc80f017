//! Masses and springs that are led to other numbers over a while, in place of having them at once.
//!
//! A spring that is loaded holds k d^2/2: at once ten times as stiff it would hold ten times that, and throw the body. Led there, it lifts its
//! load by its sag, evenly, for the sag goes by what the stiffness is the inverse of:
//!
//! ```text
//! 1/stiffness = (1 - s)/from + s/to,   s = 3 r^2 - 2 r^3, r the share of the time that has gone
//! masses and damping = from^(1 - s) to^s
//! ```
//! A spring that is to be rigid is led to [`NEARLY_RIGID`] times its stiffness, and is rigid then.

use serde::{Deserialize, Serialize};

use super::command::{OneOrEach, SetKeys, keep};
use crate::scene::KindName;
use crate::sim::{BondKind, Dynamics, PointId};

/// How much stiffer a spring gets before it is rigid: what is left of its stretch is put right at once, and is not seen.
const NEARLY_RIGID: f64 = 200.0;
/// So often it gets other numbers on the way: each time what hangs on it is compiled anew, which of so much takes longer.
const TIMES: f64 = 24.0;
const FEW_TIMES: f64 = 8.0;
const MUCH: usize = 2000;
/// Where a number begins that is 0, of the one that it is led to `[1]`.
const FIRST: f64 = 1e-3;
/// Longest while `[s]`: what is asked for is to be there some time.
const LONGEST: f64 = 1e4;

/// What is led, by its numbers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
enum Led {
    /// Masses of points `[kg]`.
    Masses,
    /// Stiffness `[N/m]` and damping `[N s/m]` of springs.
    Springs,
}

/// Numbers on their way.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Eased {
    led: Led,
    /// Points or bonds.
    numbers: Vec<u32>,
    from: Vec<[f64; 2]>,
    to: Vec<[f64; 2]>,
    /// When it began, how long it takes, and when it gets other numbers next `[s]`.
    since: f64,
    over: f64,
    due: f64,
    /// What is set at the end, of all that are named.
    end: SetKeys,
}

/// What of a `set` with `over` is done at once, and what is on its way.
pub(super) struct Parted {
    pub(super) now: Option<SetKeys>,
    pub(super) eased: Option<Eased>,
}

/// Parts what is to be set over a while `[s]`.
///
/// Errors: in words, a key that is not led, or a time that is none.
pub(super) fn part(keys: &SetKeys, world: &dyn Dynamics) -> Result<Parted, String> {
    let over = keys.over.filter(|over| (f64::MIN_POSITIVE..=LONGEST).contains(over));
    let over = over.ok_or_else(|| format!("over: give a time [s] above 0, up to {LONGEST:e}"))?;
    let end = SetKeys { over: None, ..keys.clone() };
    let known = ["points", "mass", "bonds", "kind", "stiffness", "compliance", "damping", "break_strain"];
    let is_led = keys.mass.is_some() || keys.kind.is_some() || keys.stiffness.is_some() || keys.compliance.is_some();
    if let Some(other) = end.given().find(|key| !known.contains(key)).or((!is_led).then_some("over")) {
        return Err(format!("{other}: `over` is for masses of points, or for kind, stiffness and damping of bonds"));
    }
    let led = if keys.points.is_some() { Led::Masses } else { Led::Springs };
    let list = keys.points.as_ref().or(keys.bonds.as_ref()).cloned().unwrap_or_default();
    let ways: Vec<Option<[[f64; 2]; 2]>> = match led {
        Led::Masses => list.iter().enumerate().map(|(k, &point)| mass_way(&end, (k, point), world)).collect(),
        Led::Springs => list.iter().enumerate().map(|(k, &bond)| spring_way(&end, (k, bond), world)).collect(),
    };
    let goes: Vec<bool> = ways.iter().map(Option::is_some).collect();
    let stays: Vec<bool> = goes.iter().map(|goes| !goes).collect();
    let of = |is: &[bool]| is.contains(&true).then(|| end.clone().among(is));
    let eased = of(&goes).map(|end| {
        let (from, to) = ways.into_iter().flatten().map(|[from, to]| (from, to)).unzip();
        let numbers = end.points.as_ref().or(end.bonds.as_ref()).cloned().unwrap_or_default();
        let since = world.time();
        Eased { due: since + tick(over, numbers.len()), led, numbers, from, to, since, over, end }
    });
    Ok(Parted { now: of(&stays), eased })
}

fn tick(over: f64, count: usize) -> f64 {
    over / if count > MUCH { FEW_TIMES } else { TIMES }
}

fn number(list: Option<&OneOrEach>, k: usize) -> Option<f64> {
    match list? {
        OneOrEach::One(one) => Some(*one),
        OneOrEach::Each(list) => list.get(k).copied(),
    }
}

/// From where to where a mass goes; `None`: it is set at once.
fn mass_way(end: &SetKeys, (k, point): (usize, u32), world: &dyn Dynamics) -> Option<[[f64; 2]; 2]> {
    let (from, to) = (*world.masses().get(point as usize)?, number(end.mass.as_ref(), k)?);
    (from != to).then_some([[from, 0.0], [to, 0.0]])
}

/// The same of a spring: one that gets no stiffer holds no more for it.
fn spring_way(end: &SetKeys, (k, bond): (usize, u32), world: &dyn Dynamics) -> Option<[[f64; 2]; 2]> {
    let BondKind::Spring { stiffness, damping } = world.bonds().get(world.bond_place(bond)?).kind else { return None };
    let to = match end.kind {
        Some(KindName::Relaxed) => return None,
        Some(KindName::Rigid) => [NEARLY_RIGID * stiffness, NEARLY_RIGID.sqrt() * damping],
        Some(KindName::Spring) | None => {
            let soft = number(end.compliance.as_ref(), k).map(|compliance| 1.0 / compliance);
            let stiff = number(end.stiffness.as_ref(), k).or(soft).unwrap_or(stiffness);
            [stiff, number(end.damping.as_ref(), k).unwrap_or(damping)]
        }
    };
    (to[0] > stiffness).then_some([[stiffness, damping], to])
}

fn between(from: f64, to: f64, s: f64) -> f64 {
    let from = from.max(FIRST * to);
    if from > 0.0 && to > 0.0 { from * libm::pow(to / from, s) } else { from + s * (to - from) }
}

/// The same of a stiffness.
fn stiffness_between(from: f64, to: f64, s: f64) -> f64 {
    let from = from.max(FIRST * to);
    if from > 0.0 && to > 0.0 { 1.0 / ((1.0 - s) / from + s / to) } else { between(from, to, s) }
}

impl Eased {
    /// Whether it is springs that are led.
    pub(super) fn leads_springs(&self) -> bool {
        self.led == Led::Springs
    }

    /// Whether it gets other numbers at a time `[s]`.
    pub(super) fn is_due(&self, time: f64) -> bool {
        time >= self.due
    }

    /// Whether it is there at a time `[s]`.
    pub(super) fn is_over(&self, time: f64) -> bool {
        time >= self.since + self.over
    }

    /// What is set now, of what is still there; `None`: nothing is.
    pub(super) fn pass(&mut self, world: &dyn Dynamics) -> Option<SetKeys> {
        let time = world.time();
        self.due = time + tick(self.over, self.numbers.len());
        if self.is_over(time) {
            return self.end(world);
        }
        let r = ((time - self.since) / self.over).clamp(0.0, 1.0);
        let s = r * r * (3.0 - 2.0 * r);
        let (numbers, ways): (Vec<u32>, Vec<_>) = (self.numbers.iter().copied())
            .zip(self.from.iter().zip(&self.to))
            .filter(|(number, _)| self.is_there(world, *number))
            .unzip();
        let each = |part: usize, law: fn(f64, f64, f64) -> f64| {
            let now = ways.iter().map(|(from, to)| law(from[part], to[part], s));
            Some(OneOrEach::Each(now.collect()))
        };
        let keys = match self.led {
            Led::Masses => SetKeys { mass: each(0, between), points: Some(numbers.clone()), ..SetKeys::default() },
            Led::Springs => SetKeys {
                stiffness: each(0, stiffness_between),
                damping: each(1, between),
                bonds: Some(numbers.clone()),
                ..SetKeys::default()
            },
        };
        (!numbers.is_empty()).then_some(keys)
    }

    /// What is set at the end, of what is still there.
    pub(super) fn end(&self, world: &dyn Dynamics) -> Option<SetKeys> {
        let stays: Vec<bool> = self.numbers.iter().map(|&number| self.is_there(world, number)).collect();
        stays.contains(&true).then(|| self.end.clone().among(&stays))
    }

    fn is_there(&self, world: &dyn Dynamics, number: u32) -> bool {
        match self.led {
            Led::Masses => world.gone().binary_search(&PointId(number)).is_err(),
            // What became something else meanwhile is led no more.
            Led::Springs => world
                .bond_place(number)
                .is_some_and(|place| matches!(world.bonds().get(place).kind, BondKind::Spring { .. })),
        }
    }

    /// What is set otherwise meanwhile is led no more. Returns whether anything is left.
    pub(super) fn yields(&mut self, keys: &SetKeys) -> bool {
        let is_of_springs = keys.kind.is_some() || keys.stiffness.is_some() || keys.compliance.is_some();
        let set = match self.led {
            Led::Masses => keys.points.as_ref().filter(|_| keys.mass.is_some()),
            Led::Springs => keys.bonds.as_ref().filter(|_| is_of_springs || keys.damping.is_some()),
        };
        let Some(set) = set else { return true };
        let mut sorted = set.clone();
        sorted.sort_unstable();
        let stays: Vec<bool> = self.numbers.iter().map(|number| sorted.binary_search(number).is_err()).collect();
        keep(&mut self.numbers, &stays);
        [&mut self.from, &mut self.to].into_iter().for_each(|list| keep(list, &stays));
        self.end = std::mem::take(&mut self.end).among(&stays);
        !self.numbers.is_empty()
    }

    /// Whether all of it is such as may be, of a file.
    pub(super) fn is_fine(&self) -> bool {
        let count = self.numbers.len();
        let times = [self.since, self.over, self.due];
        self.from.len() == count
            && self.to.len() == count
            && times.iter().all(|time| time.is_finite())
            && self.over > 0.0
    }
}
