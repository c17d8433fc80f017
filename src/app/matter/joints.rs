//! Angles of a selection: where they are at rest, and the stops of joints.

use super::{Among, AngleAs, Common, Former, hinges, hung};
use crate::app::alike::alike;
use crate::history::{DeleteKeys, Do, DriveOrNone, OneOrEach, RangeOrNone, SetKeys};
use crate::scene::{AddKeys, AngleKeys, DriveKeys, MassKeys, PointKeys, Row, Vector};
use crate::sim::vector::sub;
use crate::sim::{Angle, Dynamics, PointId};

use super::extent::place;

/// A joint that gets stops turns so far to both sides of its angle at rest at first `[rad]`.
const SWING: f64 = std::f64::consts::FRAC_PI_3;
/// Of more joints it is not shown where their stops would be.
const MOST: usize = 64;
/// Where the stops of one joint are.
const ORDER: &str = "the least angle is below the largest, and they are less than a full turn apart";

/// A prop weighs so much less than its pin that its body weighs what it did `[1]`.
const LIGHT: f64 = 1e-6;

/// A joint with stops.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::app) struct Joint {
    /// i, j, k as [`Angle`] has them.
    pub(in crate::app) points: [PointId; 3],
    /// Its least and its largest angle `[rad]`.
    pub(in crate::app) range: [f64; 2],
    /// Where i is to be pinned `[m]`; `None`: it is there.
    pub(in crate::app) prop: Option<[f64; 2]>,
}

/// Three points that turn freely.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Knee {
    /// i, j, k as [`Angle`] has them.
    pub(super) points: [PointId; 3],
    /// The angle at j, no more than half a turn `[rad]`.
    pub(super) rest: f64,
    /// Where i is to be pinned `[m]`, with the next number; `None`: it is there.
    pub(super) prop: Option<[f64; 2]>,
}

/// The stops of joints.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stops {
    /// Some, for those that have none: the former ones, or on both sides of where they are at rest.
    Some,
    /// None: they turn freely. Those on the background go, and their props with them.
    None,
    /// The least angle of those that have stops `[rad]`.
    Least(f64),
    /// The largest angle of those `[rad]`.
    Most(f64),
}

impl Among {
    /// The joints without an angle: what two bonds alone make, or hinges between bodies and pins that bodies hang on.
    pub(super) fn knees_of(&self, world: &dyn Dynamics) -> Vec<Knee> {
        let hinges = || hinges::free(world, self).into_iter().chain(hung::hung(world, self)).collect();
        self.knee_of(world).map_or_else(hinges, |knee| vec![knee])
    }

    /// The joint without an angle that two bonds alone make.
    fn knee_of(&self, world: &dyn Dynamics) -> Option<Knee> {
        let bonds = self.bonds_of(world);
        let [(_, first), (_, second)] = bonds[..] else { return None };
        let (first, second) = ([first.a, first.b], [second.a, second.b]);
        let middle = first.into_iter().find(|end| second.contains(end))?;
        let other = |ends: [PointId; 2]| ends.into_iter().find(|end| *end != middle);
        let (i, k) = (other(first)?, other(second)?);
        let is_free = i != k && world.dimensions() == 2 && self.angles_of(world, AngleAs::Joint).is_empty();
        if is_free { knee(world, [i, k], middle) } else { None }
    }
}

/// The angle of two arms about a middle, the way that it is no more than half a turn; `None` where they point the same way.
pub(super) fn knee(world: &dyn Dynamics, [i, k]: [PointId; 2], middle: PointId) -> Option<Knee> {
    let [p, q] = [i, k].map(|end| sub(place(world, end), place(world, middle)));
    let angle = (p[0] * q[1] - p[1] * q[0]).atan2(p[0] * q[0] + p[1] * q[1]);
    let (points, rest) = if angle < 0.0 { ([k, middle, i], -angle) } else { ([i, middle, k], angle) };
    (rest > 0.0).then_some(Knee { points, rest, prop: None })
}

/// The joints that would get stops, and where.
pub(super) fn coming((world, former): (&dyn Dynamics, &Former), angles: &[Angle], knees: &[Knee]) -> Vec<Joint> {
    let free = angles.iter().filter(|angle| angle.range.is_none()).take(MOST);
    let free = free.map(|angle| Joint { points: angle.points, range: again(world, former, angle), prop: None });
    let knee = |&Knee { points, rest, prop }: &Knee| Joint { points, range: about(rest), prop };
    free.chain(knees.iter().take(MOST).map(knee)).collect()
}

/// The stops at both sides of an angle at rest at first `[rad]`.
fn about(rest: f64) -> [f64; 2] {
    [rest - SWING, rest + SWING]
}

/// The stops that a joint without any gets: those that it had, else some about where it is at rest. Where it stands now is always
/// between them, so that nothing is pushed `[rad]`.
fn again(world: &dyn Dynamics, former: &Former, angle: &Angle) -> [f64; 2] {
    let range = former.of(angle).unwrap_or_else(|| about(angle.rest));
    let mut angle = Angle { range: Some(range), ..*angle };
    angle.reach(angle.points.map(|point| place(world, point)), f64::INFINITY);
    angle.range.unwrap_or(range)
}

/// Commands that give joints among some points these stops.
///
/// Errors: in words, why they cannot be so.
pub(super) fn stops(
    (world, former): (&dyn Dynamics, &Former),
    among: &Among,
    stops: Stops,
) -> Result<Vec<Do>, &'static str> {
    let mut angles = among.angles_of(world, AngleAs::Joint);
    let gone = if stops == Stops::None { unpropped(world, &mut angles) } else { None };
    let ranges = angles.iter().filter_map(|angle| {
        let range = match (stops, angle.range) {
            (Stops::Some, None) => Some(again(world, former, angle)),
            (Stops::Least(least), Some([_, most])) => Some([least, most]),
            (Stops::Most(most), Some([least, _])) => Some([least, most]),
            (Stops::None, Some(_)) => None,
            (Stops::Some, Some(_)) | (Stops::None | Stops::Least(_) | Stops::Most(_), None) => return None,
        };
        Some((range, angle.number))
    });
    let groups = alike(ranges);
    let is_range = |[least, most]: [f64; 2]| least < most && most - least < 2.0 * std::f64::consts::PI;
    if groups.iter().any(|(range, _)| range.is_some_and(|range| !is_range(range))) {
        return Err(ORDER);
    }
    let knees = if stops == Stops::Some { among.knees_of(world) } else { Vec::new() };
    let set = |(range, numbers): (Option<[f64; 2]>, Vec<u32>)| {
        let range = Some(range.map_or(RangeOrNone::None(()), RangeOrNone::These));
        Do::Set(Box::new(SetKeys { angles: Some(numbers), range, ..SetKeys::default() }))
    };
    Ok(groups.into_iter().map(set).chain(gone).chain(jointed(world, &knees)).collect())
}

/// Takes those with stops against the background out of some angles, and deletes them: without stops they are nothing. A prop that nothing else pushes
/// against goes with its angles. `None`: there are none.
fn unpropped(world: &dyn Dynamics, angles: &mut Vec<Angle>) -> Option<Do> {
    let all = world.props();
    let is_hung = |angle: &mut Angle| angle.range.is_some() && all.binary_search(&angle.points[0]).is_ok();
    let hung: Vec<Angle> = angles.extract_if(.., is_hung).collect();
    let is_hung = |angle: &Angle| hung.iter().any(|own| own.number == angle.number);
    let is_used = |prop: PointId| world.angles().iter().any(|angle| angle.points[0] == prop && !is_hung(angle));
    let (kept, gone): (Vec<&Angle>, Vec<&Angle>) = hung.iter().partition(|angle| is_used(angle.points[0]));
    let mut points: Vec<u32> = gone.iter().map(|angle| angle.points[0].0).collect();
    points.sort_unstable();
    points.dedup();
    let angles = kept.iter().map(|angle| angle.number).collect();
    (!hung.is_empty()).then(|| Do::Delete(DeleteKeys { points, angles, ..DeleteKeys::default() }))
}

/// What turns freely gets stops on both sides of where it stands, and the props that these push against; `None`: nothing does.
fn jointed(world: &dyn Dynamics, knees: &[Knee]) -> Option<Do> {
    let angle = |&Knee { points, rest, .. }: &Knee| {
        let [min, max] = about(rest).map(Some);
        AngleKeys {
            points: Row(points.map(|point| point.0)),
            rest: None,
            stiffness: None,
            damping: None,
            min,
            max,
            drive: None,
        }
    };
    let angles: Vec<AngleKeys> = knees.iter().map(angle).collect();
    let points = propped(world, knees);
    (!angles.is_empty()).then(|| Do::Add(Box::new(AddKeys { points, angles, ..AddKeys::default() })))
}

/// The props of joints on the background, pinned; `None`: none needs one.
fn propped(world: &dyn Dynamics, knees: &[Knee]) -> Option<PointKeys> {
    let props = || knees.iter().filter_map(|knee| Some((knee.points, knee.prop?)));
    let mass = |([_, pin, _], _): ([PointId; 3], [f64; 2])| LIGHT * world.masses()[pin.index()];
    let keys = PointKeys {
        position: props().map(|(_, at)| Vector::Plane(at)).collect(),
        velocity: None,
        mass: Some(MassKeys::Each(props().map(mass).collect())),
        pinned: props().map(|([prop, ..], _)| prop.0).collect(),
    };
    (!keys.position.is_empty()).then_some(keys)
}

/// The angles that resist being elsewhere than at rest.
pub(super) fn held(angles: &[Angle]) -> impl Iterator<Item = &Angle> {
    angles.iter().filter(|angle| angle.stiffness > 0.0)
}

/// The command that gives those another angle at rest `[rad]`.
pub(super) fn rest(world: &dyn Dynamics, among: &Among, rest: f64) -> Do {
    let angles = among.angles_of(world, AngleAs::Joint);
    let numbers = held(&angles).map(|angle| angle.number).collect();
    Do::Set(Box::new(SetKeys { angles: Some(numbers), rest: Some(OneOrEach::One(rest)), ..SetKeys::default() }))
}

/// The command that damps all angles but motors by so much `[N m s]`.
pub(super) fn damped(world: &dyn Dynamics, among: &Among, damping: f64) -> Do {
    let numbers = among.angles_of(world, AngleAs::Joint).iter().map(|angle| angle.number).collect();
    Do::Set(Box::new(SetKeys { angles: Some(numbers), damping: Some(OneOrEach::One(damping)), ..SetKeys::default() }))
}

/// The command that gives angles that resist this servo, or takes theirs away.
pub(super) fn swinging(world: &dyn Dynamics, among: &Among, drive: Option<DriveKeys>) -> Do {
    let angles = among.angles_of(world, AngleAs::Joint);
    let numbers = held(&angles).map(|angle| angle.number).collect();
    let drive = Some(drive.map_or(DriveOrNone::None(()), DriveOrNone::This));
    Do::Set(Box::new(SetKeys { angles: Some(numbers), drive, ..SetKeys::default() }))
}

/// The servo of each of the angles that resist, if it has one; `None` where none resists.
pub(super) fn swings(angles: &[Angle]) -> Option<Common<Option<DriveKeys>>> {
    Some(Common::of(held(angles).map(|angle| angle.drive))?.map(|drive| drive.map(DriveKeys::from)))
}
