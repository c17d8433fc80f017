//! What a drawing or a picture adds to a world that runs: keys of bodies and obstacles, with the place where they find room.

use std::sync::Arc;

use glam::DVec2;

use super::error::{Fault, SceneError};
use super::keys::{AddKeys, BodyKeys, MakerName, ObstacleKeys, PictureKeys, Scene, Vector};
use super::obstacle::outlines;
use super::pictures::inline_picture;
use super::room::{Drawing, in_view_or_not};
use super::start;
use crate::picture::Picture;
use crate::sim::Dynamics;

impl Scene {
    /// A body of a picture, which the keys hold themselves, as it is added to `world`, which began as this scene: where nothing is now, inside the walls and of what
    /// is `seen` (lower and upper corner `[m]`) if it fits there; with `apart`, each connected part becomes a body of its own.
    ///
    /// Errors: as of [`Scene::of_picture`]; a world in space; more than 64 parts.
    pub fn body_to_add(
        &self,
        world: &dyn Dynamics,
        (picture, keys): (&Arc<Picture>, BodyKeys),
        seen: [[f64; 2]; 2],
        apart: bool,
    ) -> Result<AddKeys, SceneError> {
        let file = Some(self.source.keep(Arc::clone(picture)));
        let mut alone = self.emptied();
        alone.bodies = vec![BodyKeys { make: MakerName::Picture, file, ..keys }];
        alone.check()?;
        let origin = alone.find_room(world, seen).map_err(|fault| self.source.error(fault))?;
        alone.bodies[0].origin = Some(Vector::Plane(origin));
        let alone = alone.with_firm_strokes()?;
        let mut bodies = if apart { alone.in_parts(0)?.bodies } else { alone.bodies };
        let inside = inline_picture(picture).map_err(|fault| self.source.error(fault))?;
        bodies.iter_mut().for_each(|body| body.file = Some(inside.clone()));
        Ok(AddKeys { bodies, ..AddKeys::default() })
    }

    /// The ink of a picture as an obstacle that is added to `world`, placed as a body would be.
    ///
    /// Errors: as of [`Scene::of_picture`]; a world in space.
    pub fn obstacle_to_add(
        &self,
        world: &dyn Dynamics,
        (picture, keys): (&Arc<Picture>, &BodyKeys),
        seen: [[f64; 2]; 2],
    ) -> Result<AddKeys, SceneError> {
        let error = |fault: Fault| self.source.error(fault);
        let file = self.source.keep(Arc::clone(picture));
        let cut = PictureKeys { file, origin: None, ..PictureKeys::of_body(keys) };
        let ink = Drawing::default().with([outlines(&cut, &self.source).map_err(error)?].into_iter());
        let origin = placed(world, &ink, seen);
        let file = inline_picture(picture).map_err(error)?;
        let cut = PictureKeys { file, origin: Some(Vector::Plane(origin)), ..cut };
        let obstacle = ObstacleKeys { picture: Some(cut), ..ObstacleKeys::default() };
        Ok(AddKeys { obstacles: vec![obstacle], ..AddKeys::default() })
    }

    /// This scene with more bodies and obstacles at its start.
    ///
    /// Errors: it is not in order with it.
    pub fn with(&self, added: AddKeys) -> Result<Scene, SceneError> {
        let mut scene = self.clone();
        scene.bodies.extend(added.bodies);
        scene.obstacles.extend(added.obstacles);
        scene.check()?;
        Ok(scene)
    }

    /// This scene's walls, without anything between them.
    fn emptied(&self) -> Scene {
        let planes = self.obstacles.iter().filter(|obstacle| obstacle.plane.is_some()).cloned().collect();
        Scene {
            bounds: self.bounds.clone(),
            gravity: self.gravity,
            obstacles: planes,
            source: self.source.clone(),
            ..Scene::default()
        }
    }

    /// Where the only body of this scene finds room in a world.
    fn find_room(&self, world: &dyn Dynamics, seen: [[f64; 2]; 2]) -> Result<[f64; 2], Fault> {
        let body = start::make(&self.bodies[0], self)?;
        let places: Vec<DVec2> = body.positions.iter().map(|x| DVec2::new(x[0], x[1])).collect();
        let bonds = body.links.iter().map(|link| [link.a, link.b]);
        Ok(placed(world, &Drawing::bodies(&places, bonds, body.triangles.iter().copied()), seen))
    }
}

/// Where the origin of what lies about (0, 0) goes: see [`in_view_or_not`].
fn placed(world: &dyn Dynamics, own: &Drawing, seen: [[f64; 2]; 2]) -> [f64; 2] {
    in_view_or_not(world, own, seen.map(DVec2::from)).to_array()
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;
    use crate::picture::Settings;
    use crate::scene::Matter;

    /// Two blots side by side.
    fn blots() -> Arc<Picture> {
        let mut picture = Picture::filled(200, 100, [0; 4]);
        for i in 0..200 * 100 {
            let [x, y] = [i % 200, i / 200].map(f64::from);
            let is_ink = (x - 50.0).hypot(y - 50.0) < 40.0 || (x - 150.0).hypot(y - 50.0) < 30.0;
            picture.rgba[4 * i as usize + 3] = if is_ink { 255 } else { 0 };
        }
        Arc::new(picture)
    }

    #[test]
    fn a_body_is_put_where_the_world_has_room_now() {
        let scene = Scene::parse(
            r#"{"wobble": 1, "points": {"position": [[0, 0], [1, 0], [1, 1], [5, 5]], "velocity": [[4, 0], [4, 0], [4, 0], [0, 0]]},
                "bonds": [{"a": 0, "b": 1}, {"a": 1, "b": 2}, {"a": 0, "b": 2}], "triangles": [[0, 1, 2]],
                "bounds": {"min": [-6, -3], "max": [9, 9]}}"#,
            "x.json",
        )
        .unwrap();
        let picture = blots();
        let keys = || BodyKeys {
            material: Some(Matter::Soft.material(None)),
            ..BodyKeys::cut(&Settings::default(), 2.0, &picture)
        };
        let mut world = scene.world(None).unwrap();
        let seen = [[-2.0, -2.0], [4.0, 3.0]];
        let place = |world: &dyn Dynamics| {
            let added = scene.body_to_add(world, (&picture, keys()), seen, false).unwrap();
            assert!(added.bodies[0].file.as_ref().is_some_and(|file| file.starts_with("data:image/png;base64,")));
            added.bodies[0].origin.unwrap().embed()
        };
        let at_first = place(&*world);
        let away = (at_first[0] - 1.0).hypot(at_first[1] - 0.5);
        assert!((0.5..2.0).contains(&away), "not on what lies in the middle, and near it: {at_first:?}");
        while world.time() < 1.0 {
            world.step();
        }
        let later = place(&*world);
        assert!((later[0] - 1.0).abs() < 0.2 && (later[1] - 0.5).abs() < 0.2, "the middle is free now: {later:?}");
        let parts = scene.body_to_add(&*world, (&picture, keys()), seen, true).unwrap().bodies;
        assert_eq!(parts.iter().map(|body| body.part).collect::<Vec<_>>(), [Some(0), Some(1)]);
        let obstacle = scene.obstacle_to_add(&*world, (&picture, &keys()), seen).unwrap().obstacles;
        assert!(obstacle[0].picture.as_ref().is_some_and(|cut| cut.origin.is_some()));
    }
}
