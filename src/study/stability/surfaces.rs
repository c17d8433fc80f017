//! How deep points are in what they cannot enter.

use crate::sim::contact::polygon::solids::Solids;
use crate::sim::{Dynamics, PointId};

/// Walls, planes and polygons of a world as they stand.
#[derive(Default)]
pub(super) struct Surfaces {
    topology: Option<u64>,
    /// Unit normals towards the free side with their offsets.
    planes: Vec<([f64; 3], f64)>,
    solids: Option<Solids>,
    /// How deep each point began `[m]`; empty where none did.
    began: Vec<f64>,
}

/// What began inside has to be led out at this speed at least `[m/s]`, half of what is tried.
const LED_OUT: f64 = 0.5;

impl Surfaces {
    /// Points begin at these places.
    pub(super) fn begin(&mut self, world: &dyn Dynamics, position: &[[f64; 3]]) {
        self.follow(world);
        self.began = position.iter().map(|x| self.of(x)).collect();
        if self.began.iter().all(|&depth| depth == 0.0) {
            self.began.clear();
        }
    }

    /// The deepest place of any point that moves `[m]`; 0 where all are outside. Of what began inside: how much deeper than it may still be.
    ///
    /// Shapes: positions, an entry a point, NaN of those that are gone.
    pub(super) fn depth(&mut self, world: &dyn Dynamics, position: &[[f64; 3]]) -> f64 {
        self.follow(world);
        let pinned = world.pinned();
        let is_free = |point: usize| !pinned.contains(&PointId(point as u32));
        let mut deepest = 0.0_f64;
        for (point, x) in position.iter().enumerate() {
            let began = self.began.get(point).map_or(0.0, |began| (began - LED_OUT * world.time()).max(0.0));
            let depth = self.of(x) - began;
            if depth > deepest && is_free(point) {
                deepest = depth;
            }
        }
        deepest
    }

    fn of(&self, x: &[f64; 3]) -> f64 {
        let behind = |(normal, offset): &([f64; 3], f64)| offset - (0..3).map(|k| normal[k] * x[k]).sum::<f64>();
        let deepest = self.planes.iter().map(behind).fold(0.0, f64::max);
        let Some(solids) = self.solids.as_ref().filter(|_| x[0].is_finite() && x[1].is_finite()) else {
            return deepest;
        };
        let at = [x[0], x[1]];
        if !solids.is_solid(at) {
            return deepest;
        }
        solids.nearest(at, f64::INFINITY).map_or(deepest, |(_, square)| deepest.max(square.sqrt()))
    }

    /// Reads the world's surfaces anew where something of it changed.
    fn follow(&mut self, world: &dyn Dynamics) {
        if self.topology == Some(world.topology()) {
            return;
        }
        self.topology = Some(world.topology());
        self.solids = Solids::new(world.polygons()).ok().flatten();
        self.planes.clear();
        for [point, normal] in world.planes() {
            let length = normal.iter().map(|n| n * n).sum::<f64>().sqrt();
            let normal = normal.map(|n| n / length);
            self.planes.push((normal, (0..3).map(|k| normal[k] * point[k]).sum()));
        }
        if let Some([low, high]) = world.bounds() {
            for k in 0..world.dimensions() {
                let axis = |sign: f64| std::array::from_fn(|i| if i == k { sign } else { 0.0 });
                self.planes.push((axis(1.0), low[k]));
                self.planes.push((axis(-1.0), -high[k]));
            }
        }
    }
}
