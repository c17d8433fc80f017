//! What belongs to a world and no step knows of: skins, and points that are named together.

use std::sync::Arc;

use super::pack::Packed;
use crate::picture::{self, Picture, Skin};
use crate::scene::{Scene, SceneError};
use crate::sim::{Dynamics, PointId};

/// Points that are selected and deleted as one.
#[derive(Clone, Debug, PartialEq)]
pub struct Group {
    /// What they are called.
    pub name: String,
    /// Those that are left.
    pub points: Vec<PointId>,
}

/// No bond: a side of a triangle that was never held.
const FREE: u32 = u32::MAX;

/// A skin with the bonds along the sides of its triangles.
#[derive(Clone, Debug)]
struct Worn {
    skin: Skin,
    /// One a triangle: bonds by their numbers, or [`FREE`].
    sides: Vec<[u32; 3]>,
}

/// Skins and groups of a world. Copies share what they have.
#[derive(Clone, Debug, Default)]
pub(super) struct Dress {
    worn: Arc<Vec<Worn>>,
    /// So many of them are the scene's own.
    of_scene: usize,
    /// Numbers of points and names, newest last.
    groups: Arc<Vec<Group>>,
}

impl Dress {
    /// That of a scene at its start.
    ///
    /// Errors: a picture that is not there or is none.
    pub(super) fn new(scene: &Scene, world: &dyn Dynamics) -> Result<Self, SceneError> {
        let mut dress = Dress::default();
        dress.wear(scene.skins()?, world);
        dress.of_scene = dress.worn.len();
        Ok(dress)
    }

    /// Skins come, with the bonds that the world has now.
    pub(super) fn wear(&mut self, skins: Vec<Skin>, world: &dyn Dynamics) {
        if skins.is_empty() {
            return;
        }
        let bonds = world.bonds();
        let numbers = world.bond_numbers();
        let of = |(place, [a, b]): (usize, &[PointId; 2])| {
            let number = numbers.map_or(place as u32, |numbers| numbers[place]);
            ([a.0.min(b.0), a.0.max(b.0)], number)
        };
        let mut by_ends: Vec<([u32; 2], u32)> = bonds.ends().iter().enumerate().map(of).collect();
        by_ends.sort_unstable();
        let side = |a: u32, b: u32| {
            let ends = [a.min(b), a.max(b)];
            let place = by_ends.partition_point(|(other, _)| *other < ends);
            by_ends.get(place).filter(|(other, _)| *other == ends).map_or(FREE, |(_, number)| *number)
        };
        let sides = |&[a, b, c]: &[u32; 3]| [side(a, b), side(b, c), side(c, a)];
        let worn = |skin: Skin| Worn { sides: skin.triangles.iter().map(sides).collect(), skin };
        Arc::make_mut(&mut self.worn).extend(skins.into_iter().map(worn));
    }

    /// Whether anything is drawn on triangles.
    pub(super) fn has_skins(&self) -> bool {
        !self.worn.is_empty()
    }

    /// The skins as they are now: a triangle with a deleted corner is gone, and one of whose sides was a bond that is gone.
    pub(super) fn skins(&self, world: &dyn Dynamics) -> Vec<Skin> {
        let (gone, numbers) = (world.gone(), world.bond_numbers());
        let is_point = |corner: &u32| gone.binary_search(&PointId(*corner)).is_err();
        let is_bond =
            |&number: &u32| number == FREE || numbers.is_none_or(|numbers| numbers.binary_search(&number).is_ok());
        let left = |worn: &Worn| {
            let both = worn.skin.triangles.iter().zip(&worn.sides);
            let is_left =
                |(corners, sides): &(&[u32; 3], &[u32; 3])| corners.iter().all(is_point) && sides.iter().all(is_bond);
            let triangles: Vec<[u32; 3]> = both.filter(is_left).map(|(corners, _)| *corners).collect();
            (!triangles.is_empty()).then(|| Skin { triangles, ..worn.skin.clone() })
        };
        self.worn.iter().filter_map(left).collect()
    }

    /// Points get a name; what was called so before is no more.
    pub(super) fn group(&mut self, name: &str, points: &[PointId]) {
        let groups = Arc::make_mut(&mut self.groups);
        groups.retain(|group| group.name != name);
        groups.push(Group { name: name.to_owned(), points: points.to_vec() });
    }

    /// The groups, of the points that are left; none without.
    pub(super) fn groups(&self, world: &dyn Dynamics) -> Vec<Group> {
        let is_left = |point: &PointId| world.gone().binary_search(point).is_err();
        let left = |group: &Group| Group {
            name: group.name.clone(),
            points: group.points.iter().copied().filter(is_left).collect(),
        };
        self.groups.iter().map(left).filter(|group| !group.points.is_empty()).collect()
    }

    /// Puts what came after the start of the scene behind the bytes: each picture once, then what is drawn of them.
    ///
    /// Errors: in words, a picture that cannot be written.
    pub(super) fn put_added(&self, to: &mut Vec<u8>) -> Result<(), String> {
        let added = &self.worn[self.of_scene..];
        let mut pictures: Vec<&Arc<Picture>> = Vec::new();
        for worn in added {
            if !pictures.iter().any(|other| Arc::ptr_eq(other, &worn.skin.picture)) {
                pictures.push(&worn.skin.picture);
            }
        }
        pictures.len().put(to);
        for one in &pictures {
            picture::encode(one).map_err(|error| error.to_string())?.put(to);
        }
        added.len().put(to);
        for Worn { skin, sides } in added {
            let Skin { picture, first, triangles, texture } = skin;
            pictures.iter().position(|other| Arc::ptr_eq(other, picture)).unwrap_or_default().put(to);
            first.put(to);
            texture.put(to);
            triangles.put(to);
            sides.put(to);
        }
        Ok(())
    }

    /// Takes what came after the start of the scene from the front of the bytes, of a world of `points` points; `None` where they are not
    /// enough, or none of it.
    pub(super) fn take_added(&mut self, from: &mut &[u8], points: usize) -> Option<()> {
        let mut pictures = Vec::new();
        for _ in 0..usize::take(from)? {
            pictures.push(Arc::new(picture::decode(&Vec::take(from)?).ok()?));
        }
        for _ in 0..usize::take(from)? {
            let picture = Arc::clone(pictures.get(usize::take(from)?)?);
            let (first, texture) = (u32::take(from)?, Vec::<[f32; 2]>::take(from)?);
            let (triangles, sides) = (Vec::<[u32; 3]>::take(from)?, Vec::<[u32; 3]>::take(from)?);
            let end = (first as usize).checked_add(texture.len())?.min(points);
            let fits = |corner: &u32| (first as usize..end).contains(&(*corner as usize));
            if sides.len() != triangles.len() || !triangles.iter().flatten().all(fits) {
                return None;
            }
            Arc::make_mut(&mut self.worn).push(Worn { skin: Skin { picture, first, triangles, texture }, sides });
        }
        Some(())
    }
}
