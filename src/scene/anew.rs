//! Bodies of pictures in a scene that is open: one cut out anew, one in its parts.

use std::sync::Arc;

use super::check;
use super::error::{Fault, SceneError, Within};
use super::keys::{BodyKeys, MakerName, Material, Scene};
use crate::picture::{Picture, PictureMesh, Settings};

/// Most parts that become bodies of their own: a picture of more has specks that nobody meant.
const MOST_PARTS: usize = 64;

/// How a body of a scene is cut out of its picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Cut {
    /// The picture.
    pub picture: Arc<Picture>,
    /// The settings of its mesh.
    pub settings: Settings,
    /// Height of the whole picture `[m]`.
    pub height: f64,
}

impl Scene {
    /// The number of the first body that is cut out of a picture.
    pub fn picture_body(&self) -> Option<usize> {
        self.bodies.iter().position(|keys| keys.make == MakerName::Picture)
    }

    /// How a body of a picture is cut out.
    ///
    /// Errors: it is no body of a picture; the picture is not there or is none.
    pub fn cut(&self, body: usize) -> Result<Cut, SceneError> {
        self.find_cut(body).item(body).at("bodies").map_err(|fault| self.source.error(fault))
    }

    fn find_cut(&self, body: usize) -> Result<Cut, Fault> {
        let none = || Fault::invalid("is no body of a picture: give one");
        let keys = self.bodies.get(body).ok_or_else(none)?;
        let picture = self.source.picture(keys.file.as_deref().ok_or_else(none)?).at("file")?;
        let (height, settings) = check::wanted(keys, &picture)?;
        Ok(Cut { picture, settings, height })
    }

    /// The mesh of a body of a picture, before its part is taken: the same that its world is made of.
    ///
    /// Errors: those of [`Scene::cut`]; no ink.
    pub fn picture_mesh(&self, body: usize) -> Result<Arc<PictureMesh>, SceneError> {
        let mesh = self.find_cut(body).and_then(|cut| {
            let file = self.bodies[body].file.as_deref().unwrap_or_default();
            self.source.mesh(file, &cut.settings).at("file")
        });
        mesh.item(body).at("bodies").map_err(|fault| self.source.error(fault))
    }

    /// This scene with another body in place of one of a picture: it lies and moves as that did. A material that `keys` do not
    /// give stays too; of one that they give, masses, breaking and how its skin meets others stay.
    ///
    /// Errors: as of [`Scene::of_picture`]; something in the scene names points by numbers that would be others.
    pub fn with_picture_anew(&self, body: usize, picture: Arc<Picture>, keys: BodyKeys) -> Result<Scene, SceneError> {
        let error = |fault: Fault| self.source.error(fault.item(body).at("bodies"));
        self.check_unnamed(body).map_err(error)?;
        let mut scene = self.clone();
        let old = &self.bodies[body];
        scene.bodies[body] = BodyKeys {
            make: MakerName::Picture,
            file: Some(self.source.keep(picture)),
            part: old.part,
            origin: old.origin,
            angle: old.angle,
            velocity: old.velocity,
            spin: old.spin,
            repeat: old.repeat.clone(),
            material: match (keys.material, &old.material) {
                (Some(new), Some(old)) => {
                    let (mass, point_mass, break_strain) = (old.mass, old.point_mass, old.break_strain);
                    let (friction, restitution, radius) = (old.friction, old.restitution, old.radius);
                    let (color, width, visible) = (old.color, old.width, old.visible);
                    let new = Material { mass, point_mass, break_strain, friction, restitution, radius, ..new };
                    Some(Material { color, width, visible, ..new })
                }
                (new, old) => new.or_else(|| old.clone()),
            },
            ..keys
        };
        scene.check()?;
        Ok(scene)
    }

    /// Errors: no body of a picture; something names its points, or later ones, by their numbers.
    fn check_unnamed(&self, body: usize) -> Result<(), Fault> {
        self.find_cut(body)?;
        let mut first = self.points.as_ref().map_or(0, |points| points.position.len() as u32);
        for keys in &self.bodies[..body] {
            first += check::count(keys, self)?;
        }
        let is_named = !self.bodies[body].pinned.is_empty()
            || (0..self.bonds.len()).any(|k| self.bonds.ends(k).iter().any(|&end| end >= first))
            || self.triangles.iter().any(|corners| corners.0.iter().any(|&corner| corner >= first))
            || self.angles.iter().any(|angle| angle.points.0.iter().any(|&point| point >= first))
            || self.pin_motion.iter().any(|motion| motion.point >= first)
            || self.cursor_pin.is_some_and(|pin| pin >= first)
            || self.click_start.is_some_and(|point| point >= first)
            || self.forces.iter().any(|force| force.points.iter().any(|&point| point >= first))
            || self.labels.iter().any(|label| label.point.is_some_and(|point| point >= first))
            || self.groups.iter().any(|group| group.points.iter().any(|&point| point >= first))
            || self.skins.iter().any(|skin| skin.points.iter().any(|&point| point >= first));
        if is_named {
            let message = "pins, bonds, triangles, angles, groups, labels, skins or forces of the scene name its points or later ones by number, and cut out \
                           anew it has others: make it a body of its own";
            return Err(Fault::invalid(message));
        }
        Ok(())
    }

    /// This scene with the connected parts of a body of a picture as bodies of their own, the largest first; a mass of the whole
    /// is shared by area. A body in one part stays as it is.
    ///
    /// Errors: those of [`Scene::picture_mesh`]; more than 64 parts.
    pub fn in_parts(mut self, body: usize) -> Result<Scene, SceneError> {
        let mesh = self.picture_mesh(body)?;
        let parts = mesh.parts();
        if parts.len() < 2 || self.bodies[body].part.is_some() {
            return Ok(self);
        }
        if parts.len() > MOST_PARTS {
            let count = parts.len();
            let message = format!("the picture has {count} parts: {MOST_PARTS} are the most; give a larger least area");
            return Err(self.source.error(Fault::invalid(message).item(body).at("bodies")));
        }
        let area: f64 = parts.iter().map(|part| part.1).sum();
        let whole = self.bodies.remove(body);
        for (number, &(_, of_it)) in parts.iter().enumerate() {
            let mut keys = BodyKeys { part: Some(number as u32), ..whole.clone() };
            if let Some(mass) = keys.material.as_mut().and_then(|material| material.mass.as_mut()) {
                *mass *= of_it / area;
            }
            self.bodies.insert(body + number, keys);
        }
        Ok(self)
    }
}
