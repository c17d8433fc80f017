//! A scene with its bodies turned into explicit points and bonds.

use super::check;
use super::error::SceneError;
use super::keys::{AngleKeys, BondKeys, KindName, MassKeys, Material, PointKeys, Row, Scene, SkinKeys, Vector};
use super::model::skins;
use super::start::Start;
use crate::sim::{BondKind, SkinMaterial};

impl Scene {
    /// The same scene without bodies: every point and bond is listed. Its model is the same, bit for bit, but for triangles of bodies
    /// that neither meet others, nor resist, nor are drawn on: these are left out, as are `parameters` that name bodies.
    ///
    /// Errors: those of [`Scene::check`]; numbers that overflow.
    pub fn expanded(&self) -> Result<Scene, SceneError> {
        self.check()?;
        let mut scene = self.clone();
        scene.with_polygons().map_err(|fault| self.source.error(fault))?;
        if self.bodies.is_empty() {
            return Ok(scene);
        }
        let start = Start::new(self).map_err(|fault| self.source.error(fault))?;
        let vectors = |list: &[[f64; 3]]| {
            let vector = |&x: &[f64; 3]| Vector::new(x, self.dimensions());
            list.iter().map(vector).collect::<Vec<_>>()
        };
        let at_rest = start.velocity.iter().flatten().all(|v| v.to_bits() == 0);
        let points = PointKeys {
            position: vectors(&start.position),
            velocity: (!at_rest).then(|| vectors(&start.velocity)),
            mass: masses(&start.mass),
            pinned: start.pinned.clone(),
        };
        let mut scene = Scene { points: Some(points), bodies: Vec::new(), ..scene };
        scene.parameters.retain(|keys| !keys.path.starts_with("bodies["));
        for (keys, body) in self.bodies.iter().zip(&start.bodies) {
            let material = keys.material.clone().unwrap_or_default();
            scene.bonds.extend(body.links().map(|link| {
                let said = BondKeys {
                    a: link.a,
                    b: link.b,
                    rest: Some(link.rest_length),
                    kind: material.kind,
                    stiffness: material.stiffness,
                    compliance: material.compliance,
                    axial_stiffness: None,
                    damping: material.damping,
                    relaxation: material.relaxation,
                    max_correction: material.max_correction,
                    break_strain: material.break_strain,
                    limit: None,
                    drive: None,
                };
                match body.kind(&link) {
                    BondKind::Spring { stiffness, damping } if link.share != 1.0 || material.young.is_some() => {
                        let (kind, damping) = (Some(KindName::Spring), (damping > 0.0).then_some(damping));
                        BondKeys { kind, stiffness: Some(stiffness), compliance: None, damping, ..said }
                    }
                    _ => said,
                }
            }));
        }
        // What stands beside it lists the same bonds.
        for entry in &mut scene.beside {
            if let Some(bonds) = &mut entry.bonds {
                bonds.extend(scene.bonds.iter().skip(self.bonds.len()));
            }
        }
        scene.skins = skins(&self.skins, &start)
            .lists()
            .into_iter()
            .map(|(SkinMaterial { friction, restitution, radius, layered }, points)| SkinKeys {
                points,
                friction,
                restitution,
                radius,
                layered,
                ..SkinKeys::default()
            })
            .collect();
        scene.skins.extend(self.coated());
        for body in &start.bodies {
            // What is at rest as it stands need not say so.
            scene.angles.extend(body.bends().map(|bend| AngleKeys {
                points: Row(bend.points),
                stiffness: Some(bend.stiffness),
                rest: None,
                damping: None,
                min: bend.range.map(|[least, _]| least),
                max: bend.range.map(|[_, most]| most),
                drive: None,
            }));
        }
        self.dress(&mut scene, &start.bodies).map_err(|fault| self.source.error(fault))?;
        Ok(scene)
    }
}

/// One mass where all are the same.
fn masses(each: &[f64]) -> Option<MassKeys> {
    match each.first() {
        Some(&first) if each.iter().all(|&mass| mass == first) => Some(MassKeys::Same(first)),
        _ => Some(MassKeys::Each(each.to_vec())),
    }
}

impl Scene {
    /// How bodies are to be drawn, each with its points, as skins say it.
    fn coated(&self) -> Vec<SkinKeys> {
        let mut list: Vec<SkinKeys> = self
            .skins
            .iter()
            .filter(|skin| !skin.coat().is_empty())
            .map(|skin| SkinKeys::of_coat(skin.points.clone(), skin.coat()))
            .collect();
        let mut first = self.points.as_ref().map_or(0, |points| points.position.len() as u32);
        let mut of_bodies = Vec::new();
        for keys in &self.bodies {
            let end = first + check::count(keys, self).unwrap_or(0);
            let coat = keys.material.as_ref().map(Material::coat).unwrap_or_default();
            if !coat.is_empty() {
                of_bodies.push(SkinKeys::of_coat((first..end).collect(), coat));
            }
            first = end;
        }
        of_bodies.extend(
            self.stroke_coats().unwrap_or_default().into_iter().map(|(points, coat)| SkinKeys::of_coat(points, coat)),
        );
        // What is listed comes after what bodies say.
        of_bodies.append(&mut list);
        of_bodies
    }
}
