//! What skins are made of, where bodies have their own.

use super::body::Span;
use super::build::Bodies;
use crate::sim::contact::skin::{Contact, SkinMaterial};
use crate::sim::real::Real;

/// The material of a skin at a point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Skin<S> {
    friction: S,
    restitution: S,
    radius: S,
    /// It is of a layer that passes the others of its body.
    is_layer: bool,
}

impl<S: Real> Skin<S> {
    /// What a material says, and where it says nothing what holds for all; `radius`, `most`: that of the body and the
    /// largest one that it bears `[m]`.
    pub(super) fn new(material: SkinMaterial, contact: &Contact, [radius, most]: [S; 2]) -> Self {
        Skin {
            friction: S::from_f64(material.friction.unwrap_or(contact.friction)),
            restitution: S::from_f64(material.restitution.unwrap_or(contact.restitution)),
            radius: material.radius.map_or(radius, |own| S::from_f64(own).min(most)),
            is_layer: material.is_layer(),
        }
    }
}

impl<S: Real> Bodies<S> {
    /// Friction, restitution and distance `[m]` between two skins at points that are numbered for ever; `None`: nothing is said of any.
    pub(super) fn between(&self, points: [u32; 2]) -> Option<[S; 3]> {
        let [a, b] = [self.skins.get(points[0] as usize)?, self.skins.get(points[1] as usize)?];
        let friction = (a.friction * b.friction).sqrt();
        Some([friction, a.restitution.max(b.restitution), a.radius + b.radius])
    }

    /// Whether points of one body, numbered for ever, are all of layers that pass each other.
    pub(super) fn are_layers<const N: usize>(&self, points: [u32; N]) -> bool {
        !self.skins.is_empty() && points.iter().all(|&point| self.skins[point as usize].is_layer)
    }

    /// Notes the materials of the points of a new body, which begin at `first` of all. Returns the largest radius of its skin `[m]`.
    pub(super) fn note_skins(
        &mut self,
        (points, corners): (&[u32], Span),
        materials: &[SkinMaterial],
        (contact, radius, most): (&Contact, S, S),
    ) -> S {
        if materials.is_empty() {
            return radius;
        }
        let first = self.skins.len();
        self.skins.extend(points.iter().map(|&slot| Skin::new(materials[slot as usize], contact, [radius, most])));
        let of = |&corner: &u32| self.skins[first + corner as usize].radius;
        self.corners[corners.range()].iter().map(of).fold(S::ZERO, S::max)
    }
}
