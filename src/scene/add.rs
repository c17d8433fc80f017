//! What a drawing or a picture adds to a world that runs: keys of bodies and obstacles, with the place where they find room.

use std::sync::Arc;

use super::error::{Fault, SceneError};
use super::free_place::{Extent, around, free_place};
use super::keys::{AddKeys, BodyKeys, MakerName, ObstacleKeys, PictureKeys, Scene, Vector};
use super::obstacle::outlines;
use super::pictures::inline_picture;
use super::start;
use crate::picture::Picture;
use crate::sim::{Dynamics, Polygon};

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
        let ink = Polygon { loops: outlines(&cut, &self.source).map_err(error)?, restitution: 0.0, friction: 0.0 };
        let mut things = extents(world);
        things.extend(around(&ink));
        let origin = free_place(self, world.polygons(), &things, seen);
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
    fn find_room(&self, world: &dyn Dynamics, seen: Extent) -> Result<[f64; 2], Fault> {
        let body = start::make(&self.bodies[0], self)?;
        let mut things = extents(world);
        things.extend(hull(body.positions.iter().map(|x| [x[0], x[1]])));
        Ok(free_place(self, world.polygons(), &things, seen))
    }
}

/// The box around some places; none of no places.
fn hull(places: impl Iterator<Item = [f64; 2]>) -> Option<Extent> {
    places.fold(None, |extent, [x, y]| {
        let [low, high] = extent.unwrap_or([[x, y]; 2]);
        Some([[low[0].min(x), low[1].min(y)], [high[0].max(x), high[1].max(y)]])
    })
}

/// What each body of a world in the plane takes up now: points that bonds connect are a body.
fn extents(world: &dyn Dynamics) -> Vec<Extent> {
    let (positions, count) = (world.positions(), world.point_count());
    let mut parent: Vec<u32> = (0..count as u32).collect();
    for [a, b] in world.bonds().ends() {
        let [a, b] = [a, b].map(|end| root(&mut parent, end.0));
        parent[a.max(b) as usize] = a.min(b);
    }
    let mut extents: Vec<Option<Extent>> = vec![None; count];
    let mut is_gone = vec![false; count];
    world.gone().iter().for_each(|point| is_gone[point.0 as usize] = true);
    for i in (0..count).filter(|&i| !is_gone[i]) {
        let at = [positions.get(2 * i), positions.get(2 * i + 1)];
        let extent = &mut extents[root(&mut parent, i as u32) as usize];
        let corners = extent.unwrap_or([at; 2]);
        *extent = hull(corners.into_iter().chain([at]));
    }
    extents.into_iter().flatten().collect()
}

/// The lowest point that a point is connected with; what is passed on the way is shortened.
fn root(parent: &mut [u32], mut i: u32) -> u32 {
    while parent[i as usize] != i {
        parent[i as usize] = parent[parent[i as usize] as usize];
        i = parent[i as usize];
    }
    i
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
                "bonds": [{"a": 0, "b": 1}, {"a": 1, "b": 2}], "bounds": {"min": [-6, -3], "max": [9, 9]}}"#,
            "x.json",
        )
        .unwrap();
        let picture = blots();
        let keys = || BodyKeys {
            material: Some(Matter::Soft.material(None)),
            ..BodyKeys::cut(&Settings::default(), 2.0, &picture)
        };
        let mut world = scene.world(None).unwrap();
        assert_eq!(extents(&*world), [[[0.0, 0.0], [1.0, 1.0]], [[5.0, 5.0]; 2]]);
        let seen = [[-2.0, -2.0], [4.0, 3.0]];
        let place = |world: &dyn Dynamics| {
            let added = scene.body_to_add(world, (&picture, keys()), seen, false).unwrap();
            assert!(added.bodies[0].file.as_ref().is_some_and(|file| file.starts_with("data:image/png;base64,")));
            added.bodies[0].origin.unwrap().embed()
        };
        let at_first = place(&*world);
        assert!((at_first[0] - 1.0).hypot(at_first[1] - 0.5) > 1.0, "not on what lies in the middle: {at_first:?}");
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
