//! All points of a scene, the explicit ones and those of its bodies, in their numbering.

use super::bending::{Bend, bends, joints};
use super::check::{self, Resistance};
use super::error::{Fault, Within};
use super::keys::{BodyKeys, MakerName, MassKeys, Material, Scene};
use super::material;
use crate::body::{Body, Link, MAX_BONDS, Placement};
use crate::sim::{BondKind, SkinMaterial};

/// Points and bonds of a scene with its bodies made and placed.
///
/// Shapes: one entry a point in `position`, `velocity` and `mass`; z = 0 in the plane.
pub(super) struct Start {
    pub(super) position: Vec<[f64; 3]>,
    pub(super) velocity: Vec<[f64; 3]>,
    pub(super) mass: Vec<f64>,
    /// Ascending, each once.
    pub(super) pinned: Vec<u32>,
    /// Bonds and triangles of the bodies, body by body, counted within the body.
    pub(super) bodies: Vec<PlacedBody>,
}

/// Bonds and triangles of a body whose points start at `first`, copy by copy.
pub(super) struct PlacedBody {
    first: u32,
    /// Points of a copy.
    each: u32,
    copies: u32,
    /// Bonds of a copy, counted within it.
    links: Vec<Link>,
    /// What a copy covers, counted within it.
    triangles: Vec<[u32; 3]>,
    /// Angles of a copy, counted within it.
    bends: Vec<Bend>,
    /// How they resist, each by its share.
    kind: BondKind,
    /// What its skin is made of.
    skin: SkinMaterial,
    /// How far its strokes keep others off `[m]`, with their points over all copies, counted within it.
    strokes: Vec<(f64, Vec<u32>)>,
}

impl PlacedBody {
    /// How many bonds there are.
    pub(super) fn len(&self) -> usize {
        self.copies as usize * self.links.len()
    }

    /// Its points, counted over the scene.
    pub(super) fn points(&self) -> std::ops::Range<u32> {
        self.first..self.first + self.copies * self.each
    }

    /// What its skin is made of, where it says so, with its points, counted over the scene.
    pub(super) fn skin(&self) -> Option<(SkinMaterial, std::ops::Range<u32>)> {
        (self.skin != SkinMaterial::default()).then_some((self.skin, self.points()))
    }

    /// How far its strokes keep others off where nothing is said `[m]`, with their points, counted over the scene.
    pub(super) fn strokes(&self) -> impl Iterator<Item = (f64, impl Iterator<Item = u32>)> {
        self.strokes.iter().map(|(radius, points)| (*radius, points.iter().map(|point| self.first + point)))
    }

    /// How a bond of it resists.
    pub(super) fn kind(&self, link: &Link) -> BondKind {
        match self.kind {
            BondKind::Spring { stiffness, damping } if link.share != 1.0 => {
                BondKind::Spring { stiffness: link.share * stiffness, damping: link.share * damping }
            }
            kind => kind,
        }
    }

    /// The bonds, their ends counted over the scene.
    pub(super) fn links(&self) -> impl Iterator<Item = Link> {
        (0..self.copies).flat_map(|copy| {
            let first = self.first + copy * self.each;
            self.links.iter().map(move |link| Link { a: first + link.a, b: first + link.b, ..*link })
        })
    }

    /// The triangles, their corners counted over the scene.
    pub(super) fn triangles(&self) -> impl Iterator<Item = [u32; 3]> {
        (0..self.copies).flat_map(|copy| {
            let first = self.first + copy * self.each;
            self.triangles.iter().map(move |corners| corners.map(|corner| first + corner))
        })
    }
}

impl PlacedBody {
    /// The angles, their points counted over the scene.
    pub(super) fn bends(&self) -> impl Iterator<Item = Bend> {
        (0..self.copies).flat_map(|copy| {
            let first = self.first + copy * self.each;
            self.bends.iter().map(move |bend| Bend { points: bend.points.map(|point| first + point), ..*bend })
        })
    }
}

/// How the bonds of a body resist.
pub(super) fn resistance(body: &BodyKeys) -> Resistance {
    Resistance::from(&body.material.clone().unwrap_or_default())
}

impl Start {
    /// Makes and places everything; the scene has been checked.
    ///
    /// Errors: a body whose positions, velocities or masses are too large for a number.
    pub(super) fn new(scene: &Scene) -> Result<Self, Fault> {
        let mut start = Start::explicit(scene);
        for (i, body) in scene.bodies.iter().enumerate() {
            start.append(body, scene).item(i).at("bodies")?;
        }
        start.pinned.sort_unstable();
        start.pinned.dedup();
        Ok(start)
    }

    fn explicit(scene: &Scene) -> Self {
        let mut start = Start {
            position: Vec::new(),
            velocity: Vec::new(),
            mass: Vec::new(),
            pinned: Vec::new(),
            bodies: Vec::new(),
        };
        if let Some(points) = &scene.points {
            let count = points.position.len();
            start.position = points.position.iter().map(|x| x.embed()).collect();
            start.velocity = match &points.velocity {
                Some(velocities) => velocities.iter().map(|v| v.embed()).collect(),
                None => vec![[0.0; 3]; count],
            };
            start.mass = match &points.mass {
                Some(MassKeys::Each(masses)) => masses.clone(),
                Some(MassKeys::Same(mass)) => vec![*mass; count],
                None => vec![1.0; count],
            };
            start.pinned.clone_from(&points.pinned);
        }
        start
    }

    fn append(&mut self, keys: &BodyKeys, scene: &Scene) -> Result<(), Fault> {
        let body = make(keys, scene)?;
        let (each, copies) = (body.positions.len() as u32, check::copies(keys));
        let bonds = body.links.len() as u64 * u64::from(copies);
        if bonds > MAX_BONDS {
            let message = format!("makes {bonds} bonds: {MAX_BONDS} are the most");
            return Err(Fault::invalid(message).at("repeat"));
        }
        let mass = masses(keys, &body)?;
        let first = self.position.len();
        let origin = keys.origin.map_or([0.0; 3], |x| x.embed());
        for offset in check::offsets(keys) {
            let placement = Placement {
                origin: std::array::from_fn(|axis| origin[axis] + offset[axis]),
                angle: keys.angle.unwrap_or(0.0),
                velocity: keys.velocity.map_or([0.0; 3], |v| v.embed()),
                spin: keys.spin.unwrap_or(0.0),
            };
            let start = self.position.len() as u32;
            let (position, mut velocity) = placement.place(&body);
            if keys.pinned.len() < position.len() {
                // What turns about its pins, or tears at them, is thrown without them.
                keys.pinned.iter().for_each(|&pin| velocity[pin as usize] = [0.0; 3]);
            }
            self.position.extend(position);
            self.velocity.extend(velocity);
            self.mass.extend(&mass);
            self.pinned.extend(keys.pinned.iter().map(|pin| start + pin));
        }
        let made = self.position[first..].iter().chain(&self.velocity[first..]);
        if !made.flatten().all(|x| x.is_finite()) {
            let message = "its points are too far or too fast for a number: make it smaller";
            return Err(Fault::invalid(message));
        }
        let kind = material::kind(keys, &body, &mass);
        let bending = keys.material.as_ref().and_then(|material| material.bending);
        let mut bends = bends(&body, bending.unwrap_or(0.0));
        bends.extend(joints(&body));
        let Body { links, mut triangles, .. } = body;
        let is_own = |corner: &u32| (first..self.position.len()).contains(&(*corner as usize));
        if keys.make != MakerName::Picture && scene.triangles.iter().any(|corners| corners.0.iter().all(is_own)) {
            // What the scene lists stands in place of them.
            triangles.clear();
        }
        let of_skin = |material: &Material| SkinMaterial {
            friction: material.friction,
            restitution: material.restitution,
            radius: material.radius,
            layered: material.layered,
        };
        // Limbs of a figure begin across each other.
        let layered = (keys.make == MakerName::Ragdoll).then_some(true);
        let usual = SkinMaterial { layered, ..SkinMaterial::default() };
        let skin = keys.material.as_ref().map_or(usual, |material| usual.overlaid(of_skin(material)));
        let strokes = scene.stroke_radii(keys)?;
        self.bodies.push(PlacedBody {
            first: first as u32,
            each,
            copies,
            links,
            triangles,
            bends,
            kind,
            skin,
            strokes,
        });
        Ok(())
    }
}

/// A copy of a body about its own origin; the scene has been checked.
///
/// Errors: it is too large for a number.
pub(super) fn make(keys: &BodyKeys, scene: &Scene) -> Result<Body, Fault> {
    let maker = check::maker(keys, scene.dimensions(), &scene.source)?;
    maker.make().map_err(|error| Fault::invalid(error.message).at(error.key))
}

/// The masses of one copy of a body `[kg]`.
///
/// Errors: the mass of the body is too small to be shared.
fn masses(keys: &BodyKeys, body: &Body) -> Result<Vec<f64>, Fault> {
    let material = keys.material.as_ref();
    let mass = match material.and_then(|material| material.mass) {
        Some(total) => body.masses(total),
        None => {
            let each = material.and_then(|material| material.point_mass);
            vec![each.unwrap_or(1.0); body.positions.len()]
        }
    };
    if !mass.iter().all(|&m| m > 0.0) {
        let message = "is too small to be shared by so many points: make it larger";
        return Err(Fault::invalid(message).at("mass").at("material"));
    }
    Ok(mass)
}
