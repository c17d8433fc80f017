//! Values as little-endian bytes, one after another, each type's fields in their order.

use crate::body::MAX_POINTS;
use crate::sim::{
    Angle, AngleDrive, Angles, Areas, Bond, BondKind, Bonds, Bounds, Contact, Convex, Cursor, Drive, Figure, Force,
    HandedOver, Held, Key, Keys, Limit, Method, Model, MouseForce, Order, Penalty, Plane, PointId, Polygon, Precision,
    Profile, Ramp, Region, Saved, SavedWorld, Signal, SkinMaterial, SkinMaterials, Solver, Track, Wave, Why, Wind,
};

/// What can be put behind some bytes and taken from there again.
pub(super) trait Packed: Sized {
    /// Puts it behind the bytes.
    fn put(&self, to: &mut Vec<u8>);
    /// Takes it from the front; `None` where the bytes are not enough, or none of it.
    fn take(from: &mut &[u8]) -> Option<Self>;
}

macro_rules! numbers {
    ($($number:ty),*) => {
        $(impl Packed for $number {
            fn put(&self, to: &mut Vec<u8>) {
                to.extend(self.to_le_bytes());
            }

            fn take(from: &mut &[u8]) -> Option<Self> {
                let (bytes, rest) = from.split_first_chunk()?;
                *from = rest;
                Some(Self::from_le_bytes(*bytes))
            }
        })*
    };
}

numbers!(u8, u32, u64, f32, f64);

impl Packed for usize {
    fn put(&self, to: &mut Vec<u8>) {
        (*self as u64).put(to);
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        usize::try_from(u64::take(from)?).ok()
    }
}

impl Packed for bool {
    fn put(&self, to: &mut Vec<u8>) {
        u8::from(*self).put(to);
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        match u8::take(from)? {
            0 => Some(false),
            1 => Some(true),
            _ => None,
        }
    }
}

impl<T: Packed> Packed for Vec<T> {
    fn put(&self, to: &mut Vec<u8>) {
        self.len().put(to);
        self.iter().for_each(|item| item.put(to));
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        let count = usize::take(from)?;
        // A damaged count must not ask for more than there is.
        let mut list = Vec::with_capacity(count.min(from.len()));
        for _ in 0..count {
            list.push(T::take(from)?);
        }
        Some(list)
    }
}

impl<T: Packed, const N: usize> Packed for [T; N] {
    fn put(&self, to: &mut Vec<u8>) {
        self.iter().for_each(|item| item.put(to));
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        let mut items = Vec::with_capacity(N);
        for _ in 0..N {
            items.push(T::take(from)?);
        }
        items.try_into().ok()
    }
}

impl<T: Packed> Packed for Option<T> {
    fn put(&self, to: &mut Vec<u8>) {
        u8::from(self.is_some()).put(to);
        self.iter().for_each(|item| item.put(to));
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        match u8::take(from)? {
            0 => Some(None),
            1 => T::take(from).map(Some),
            _ => None,
        }
    }
}

impl<A: Packed, B: Packed> Packed for (A, B) {
    fn put(&self, to: &mut Vec<u8>) {
        self.0.put(to);
        self.1.put(to);
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        Some((A::take(from)?, B::take(from)?))
    }
}

/// The fields of a type, in order; `without` those that are not kept and then have these values.
macro_rules! fields {
    ($name:ident $(<$d:ident>)? { $($field:ident),* $(,)? } $(without { $($left:ident: $value:expr),* })?) => {
        impl $(<const $d: usize>)? Packed for $name $(<$d>)? {
            fn put(&self, to: &mut Vec<u8>) {
                let $name { $($field,)* $($($left: _),*)? } = self;
                $($field.put(to);)*
            }

            fn take(from: &mut &[u8]) -> Option<Self> {
                $(let $field = Packed::take(from)?;)*
                Some($name { $($field,)* $($($left: $value),*)? })
            }
        }
    };
}

/// What of a kept world every layout begins with, so that any version can go on from it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Core<const D: usize> {
    pub(super) time: f64,
    pub(super) position: Vec<[f64; D]>,
    pub(super) velocity: Vec<[f64; D]>,
    pub(super) mass: Vec<f64>,
    pub(super) pinned: Vec<PointId>,
    pub(super) bonds: Bonds,
    pub(super) gone: Vec<PointId>,
    pub(super) bond_numbers: Option<Vec<u32>>,
    pub(super) next_numbers: [u32; 2],
}

fields!(Core<D> { time, position, velocity, mass, pinned, bonds, gone, bond_numbers, next_numbers });

/// The layouts from which on a kept world has what came later.
pub(super) const FIRST_WITH_TRIANGLES: u64 = 3;
pub(super) const FIRST_WITH_FORCES: u64 = 4;
pub(super) const FIRST_WITH_HAND_OVERS: u64 = 5;
const FIRST_WITH_ANGLES: u64 = 6;
const FIRST_WITH_SETTLING: u64 = 7;
const FIRST_WITH_PENALTIES: u64 = 8;
const FIRST_WITH_DRIVES: u64 = 8;
const FIRST_WITH_LAYERS: u64 = 12;
const FIRST_WITH_PATCHES: u64 = 13;

/// A kept world of any layout that is known.
trait KeptWorld: Sized {
    /// Puts it behind the bytes, in the present layout.
    fn put(&self, to: &mut Vec<u8>);
    /// Takes one of a layout from the front; `None` where the bytes are not enough, or none of it.
    fn take(from: &mut &[u8], layout: u64) -> Option<Self>;
}

/// A kept world is its core, then what the first layout has besides, then what came later: missing in earlier layouts.
macro_rules! saved {
    (
        core: $($core:ident)*; of its model: $($model:ident)*; model: $($more:ident)*; rest: $($rest:ident)*;
        $(from $first:ident on: model: $($later:ident)*; rest: $($last:ident)*;)*
    ) => {
        impl<const D: usize> KeptWorld for Saved<D> {
            fn put(&self, to: &mut Vec<u8>) {
                let Saved { model, keys, $($core,)* $($rest,)* $($($last,)*)* } = self;
                let Model { $($model,)* $($more,)* $($($later,)*)* } = model;
                let core = Core { $($core: $core.clone(),)* $($model: $model.clone(),)* };
                core.put(to);
                $($more.put(to);)*
                $($rest.put(to);)*
                $($($later.put(to);)* $($last.put(to);)*)*
                model.method.budget.put(to);
                model.method.settles.put(to);
                model.planes.iter().map(|plane| plane.penalty).collect::<Vec<_>>().put(to);
                drives_of(model).put(to);
                keys.put(to);
                layers_of(&model.skins).put(to);
            }

            fn take(from: &mut &[u8], layout: u64) -> Option<Self> {
                let Core { $($core,)* $($model,)* } = Core::take(from)?;
                $(let $more = Packed::take(from)?;)*
                $(let $rest = Packed::take(from)?;)*
                $(
                    $(let $later = if layout >= $first { Packed::take(from)? } else { Default::default() };)*
                    $(let $last = if layout >= $first { Packed::take(from)? } else { Default::default() };)*
                )*
                let mut model = Model { $($model,)* $($more,)* $($($later,)*)* };
                if layout >= FIRST_WITH_HAND_OVERS {
                    model.method.budget = Packed::take(from)?;
                }
                if layout >= FIRST_WITH_SETTLING {
                    model.method.settles = Packed::take(from)?;
                }
                if layout >= FIRST_WITH_PENALTIES {
                    let penalties = Vec::<Option<Penalty>>::take(from)?;
                    model.planes.iter_mut().zip(penalties).for_each(|(plane, penalty)| plane.penalty = penalty);
                }
                let mut keys = Keys::default();
                if layout >= FIRST_WITH_DRIVES {
                    drive(&mut model, Packed::take(from)?)?;
                    keys = Packed::take(from)?;
                }
                if layout >= FIRST_WITH_LAYERS {
                    layer(&mut model.skins, Packed::take(from)?);
                }
                Some(Saved { model, keys, $($core,)* $($rest,)* $($($last,)*)* })
            }
        }
    };
}

saved! {
    core: time gone bond_numbers next_numbers;
    of its model: position velocity mass pinned bonds;
    model: gravity drag_rate mouse bounds duration planes polygons obstacle_numbers pin_motion method;
    rest: precision substep scene_points lost cursor grabbed lead;
    from FIRST_WITH_TRIANGLES on: model: triangles contact; rest: ;
    from FIRST_WITH_FORCES on: model: skins forces wind; rest: force_numbers next_force;
    from FIRST_WITH_HAND_OVERS on: model: ; rest: handed_over;
    from FIRST_WITH_ANGLES on: model: areas rest_areas angles convex; rest: ;
    from FIRST_WITH_PATCHES on: model: ; rest: torn_beyond;
}

fields!(Method { solver, substep, iterations, order, seed, precision, tolerance, max_strain, sleeps } without { ledger: false, budget: None, settles: true });
fields!(HandedOver { first, since, why, until, times });
fields!(Contact { friction, restitution, radius, with_itself, with_others });
fields!(Force<D> { points, force, torque });
fields!(Wind<D> { velocity, turbulence, seed });
fields!(SkinMaterial { friction, restitution, radius } without { layered: None });
fields!(Areas { stiffness, least });
fields!(Angle { number, points, rest, stiffness, damping, range, arms, stop } without { drive: None });
fields!(Angles { list, next });
fields!(MouseForce { strength, radius, region, profile, track });
fields!(Track<D> { knots });
fields!(Bounds<D> { min, max, restitution, friction });
fields!(Plane<D> { point, normal, restitution, friction } without { penalty: None });
fields!(Penalty { stiffness, damping });
fields!(Polygon { loops, restitution, friction });
fields!(Convex { figure, restitution, friction });
fields!(Cursor { origin, direction });
fields!(Bond { a, b, rest_length, kind, limit, break_strain } without { drive: None });
fields!(Drive { amplitude, signal });
fields!(Signal { wave, held });
fields!(Wave { period, phase });
fields!(Held { forth, back, rate });
fields!(Ramp { key, rate, from, since, to });
fields!(Keys { held, ramps });

/// Drives of bonds and of angles, each with its place in its list.
type Drives = (Vec<(u32, Drive)>, Vec<(u32, AngleDrive)>);

fn drives_of<const D: usize>(model: &Model<D>) -> Drives {
    let bonds = model.bonds.iter().zip(0..).filter_map(|(bond, place)| Some((place, bond.drive?)));
    let angles = model.angles.list.iter().zip(0..).filter_map(|(angle, place)| Some((place, angle.drive?)));
    (bonds.collect(), angles.collect())
}

/// `None` of a drive of what is not there.
fn drive<const D: usize>(model: &mut Model<D>, (bonds, angles): Drives) -> Option<()> {
    for (place, drive) in bonds {
        let place = Some(place as usize).filter(|&place| place < model.bonds.len())?;
        model.bonds.set(place, Bond { drive: Some(drive), ..model.bonds.get(place) });
    }
    for (place, drive) in angles {
        model.angles.list.get_mut(place as usize)?.drive = Some(drive);
    }
    Some(())
}

/// The points of which is said whether they are of layers, those of either together.
fn layers_of(skins: &SkinMaterials) -> Vec<(bool, Vec<u32>)> {
    skins.lists().into_iter().filter_map(|(material, points)| Some((material.layered?, points))).collect()
}

/// Points by their numbers: a damaged one must not ask for more than there can be.
fn possible(points: Vec<u32>) -> impl Iterator<Item = PointId> {
    points.into_iter().filter(|&point| u64::from(point) < MAX_POINTS).map(PointId)
}

fn layer(skins: &mut SkinMaterials, lists: Vec<(bool, Vec<u32>)>) {
    for (is_layered, points) in lists {
        for point in possible(points) {
            skins.set([point], SkinMaterial { layered: Some(is_layered), ..skins.of(point) });
        }
    }
}

impl Packed for Key {
    fn put(&self, to: &mut Vec<u8>) {
        self.number().put(to);
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        Key::numbered(u8::take(from)?)
    }
}

impl Packed for AngleDrive {
    fn put(&self, to: &mut Vec<u8>) {
        match *self {
            AngleDrive::Servo { amplitude, signal } => {
                0_u8.put(to);
                (amplitude, signal).put(to);
            }
            AngleDrive::Motor { speed, torque, signal } => {
                1_u8.put(to);
                ([speed, torque], signal).put(to);
            }
        }
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        Some(match u8::take(from)? {
            0 => {
                let (amplitude, signal) = Packed::take(from)?;
                AngleDrive::Servo { amplitude, signal }
            }
            1 => {
                let ([speed, torque], signal) = Packed::take(from)?;
                AngleDrive::Motor { speed, torque, signal }
            }
            _ => return None,
        })
    }
}

impl Packed for PointId {
    fn put(&self, to: &mut Vec<u8>) {
        self.0.put(to);
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        u32::take(from).map(PointId)
    }
}

impl Packed for SkinMaterials {
    fn put(&self, to: &mut Vec<u8>) {
        self.lists().put(to);
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        let mut skins = SkinMaterials::default();
        for (material, points) in Vec::<(SkinMaterial, Vec<u32>)>::take(from)? {
            skins.set(possible(points), material);
        }
        Some(skins)
    }
}

impl Packed for Bonds {
    fn put(&self, to: &mut Vec<u8>) {
        self.len().put(to);
        self.iter().for_each(|bond| bond.put(to));
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        let count = usize::take(from)?;
        let mut bonds = Bonds::new();
        for _ in 0..count {
            bonds.push(Bond::take(from)?);
        }
        Some(bonds)
    }
}

/// One of a few, by its place in a list that only ever grows.
macro_rules! one_of {
    ($($name:ident: $list:expr;)*) => {
        $(impl Packed for $name {
            fn put(&self, to: &mut Vec<u8>) {
                let place = $list.iter().position(|one| one == self);
                place.map_or(u8::MAX, |place| place as u8).put(to);
            }

            fn take(from: &mut &[u8]) -> Option<Self> {
                $list.get(usize::from(u8::take(from)?)).copied()
            }
        })*
    };
}

one_of! {
    Limit: [Limit::Both, Limit::Max, Limit::Min];
    Region: [Region::Round, Region::Square];
    Profile: [Profile::Smooth, Profile::Linear];
    Precision: [Precision::Auto, Precision::F32, Precision::F64];
    Why: Why::ALL;
    Order: [Order::Auto, Order::Fixed, Order::Symmetric, Order::Coloured, Order::Shuffled];
}

impl Packed for Solver {
    fn put(&self, to: &mut Vec<u8>) {
        self.to_string().into_bytes().put(to);
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        let name = Vec::<u8>::take(from)?;
        Solver::of_label(std::str::from_utf8(&name).ok()?)
    }
}

impl Packed for Figure {
    fn put(&self, to: &mut Vec<u8>) {
        match *self {
            Figure::Ball { center, radius } => {
                0u8.put(to);
                center.put(to);
                radius.put(to);
            }
            Figure::Box { min, max, axis, angle } => {
                1u8.put(to);
                [min, max, axis].put(to);
                angle.put(to);
            }
        }
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        Some(match u8::take(from)? {
            0 => Figure::Ball { center: Packed::take(from)?, radius: Packed::take(from)? },
            1 => {
                let [min, max, axis] = Packed::take(from)?;
                Figure::Box { min, max, axis, angle: Packed::take(from)? }
            }
            _ => return None,
        })
    }
}

impl Packed for BondKind {
    fn put(&self, to: &mut Vec<u8>) {
        match *self {
            BondKind::Rigid => 0u8.put(to),
            BondKind::Spring { stiffness, damping } => {
                1u8.put(to);
                [stiffness, damping].put(to);
            }
            BondKind::Relaxed { relaxation, max_correction } => {
                2u8.put(to);
                [relaxation, max_correction].put(to);
            }
        }
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        Some(match u8::take(from)? {
            0 => BondKind::Rigid,
            1 => {
                let [stiffness, damping] = Packed::take(from)?;
                BondKind::Spring { stiffness, damping }
            }
            2 => {
                let [relaxation, max_correction] = Packed::take(from)?;
                BondKind::Relaxed { relaxation, max_correction }
            }
            _ => return None,
        })
    }
}

/// A core of any dimension.
pub(super) enum AnyCore {
    Plane(Core<2>),
    Space(Core<3>),
}

/// What a world of each dimension begins with.
const PLANE: u8 = 2;
const SPACE: u8 = 3;

impl AnyCore {
    /// Takes it from the front of a kept world of whatever layout, and leaves what follows.
    pub(super) fn take(from: &mut &[u8]) -> Option<Self> {
        match u8::take(from)? {
            PLANE => Core::take(from).map(AnyCore::Plane),
            SPACE => Core::take(from).map(AnyCore::Space),
            _ => None,
        }
    }
}

/// Puts a kept world behind the bytes, in the present layout.
pub(super) fn put_world(world: &SavedWorld, to: &mut Vec<u8>) {
    match world {
        SavedWorld::Plane(saved) => {
            PLANE.put(to);
            saved.put(to);
        }
        SavedWorld::Space(saved) => {
            SPACE.put(to);
            saved.put(to);
        }
    }
}

/// Takes a kept world of a layout that is known from the front of the bytes; `None` where they are none of it.
pub(super) fn take_world(from: &mut &[u8], layout: u64) -> Option<SavedWorld> {
    match u8::take(from)? {
        PLANE => Saved::take(from, layout).map(SavedWorld::Plane),
        SPACE => Saved::take(from, layout).map(SavedWorld::Space),
        _ => None,
    }
}
