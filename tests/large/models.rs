//! Large bodies, listed bond by bond.

use serde_json::{Value, json};
use wobble::scene::Scene;
use wobble::sim::{
    Bond, BondKind, Bonds, Bounds, Dynamics, Limit, Method, Model, PointId, Precision, Sample, Solver, Track,
};

/// Gravity of all scenes here [m/s^2].
pub(crate) const G: f64 = 9.8;
/// A frame [s].
pub(crate) const FRAME: f64 = 1.0 / 60.0;

/// The bonds of a sheet, cell by cell: rows, columns, falling and rising diagonals.
pub(crate) fn cells([columns, rows]: [u32; 2], [falling, rising]: [bool; 2]) -> Vec<[u32; 2]> {
    let mut ends = Vec::new();
    for row in 0..rows {
        for column in 0..columns {
            let at = row * columns + column;
            let (has_right, has_below) = (column + 1 < columns, row + 1 < rows);
            let wanted = [
                (has_right, [at, at + 1]),
                (has_below, [at, at + columns]),
                (falling && has_right && has_below, [at, at + columns + 1]),
                (rising && has_right && has_below, [at + 1, at + columns]),
            ];
            ends.extend(wanted.iter().filter(|wanted| wanted.0).map(|wanted| wanted.1));
        }
    }
    ends
}

/// Points with bonds of one kind at the lengths of the start, masses 1, gravity down the second axis.
pub(crate) fn bonded<const D: usize>(position: Vec<[f64; D]>, ends: &[[u32; 2]], kind: BondKind) -> Model<D> {
    let bond = |&[a, b]: &[u32; 2]| {
        let [p, q] = [a, b].map(|end| position[end as usize]);
        let square: f64 = (0..D).map(|k| (p[k] - q[k]).powi(2)).sum();
        Bond { kind, ..Bond::new(PointId(a), PointId(b), square.sqrt()) }
    };
    let bonds: Bonds = ends.iter().map(bond).collect();
    let mut gravity = [0.0; D];
    gravity[1] = -G;
    let count = position.len();
    Model { velocity: vec![[0.0; D]; count], mass: vec![1.0; count], position, bonds, gravity, ..Model::default() }
}

/// The points of a sheet 0.1 m apart that hangs down, row r at y = -0.1 r.
pub(crate) fn places<const D: usize>([columns, rows]: [u32; 2]) -> Vec<[f64; D]> {
    let at = |i: u32| {
        let mut place = [0.0; D];
        (place[0], place[1]) = (0.1 * f64::from(i % columns), -0.1 * f64::from(i / columns));
        place
    };
    (0..columns * rows).map(at).collect()
}

/// A rigid sheet that nothing holds.
pub(crate) fn sheet<const D: usize>(size: [u32; 2], diagonals: [bool; 2]) -> Model<D> {
    bonded(places(size), &cells(size, diagonals), BondKind::Rigid)
}

/// A rigid sheet with its top row pinned.
pub(crate) fn hung<const D: usize>(size: [u32; 2], diagonals: [bool; 2]) -> Model<D> {
    Model { pinned: (0..size[0]).map(PointId).collect(), ..sheet(size, diagonals) }
}

/// A level rope of rigid bonds of 0.1 m, its first point pinned.
pub(crate) fn rope<const D: usize>(points: u32) -> Model<D> {
    let at = |i: u32| {
        let mut place = [0.0; D];
        place[0] = 0.1 * f64::from(i);
        place
    };
    let ends: Vec<[u32; 2]> = (1..points).map(|i| [i - 1, i]).collect();
    Model { pinned: vec![PointId(0)], ..bonded((0..points).map(at).collect(), &ends, BondKind::Rigid) }
}

/// Rims of two rings of 13 points, 3 m apart, each with a pin.
pub(crate) fn rims(count: u32) -> Model<2> {
    let (mut position, mut ends) = (Vec::new(), Vec::new());
    for rim in 0..count {
        let (first, left) = (26 * rim, 3.0 * f64::from(rim));
        for i in 0..26 {
            let angle = std::f64::consts::TAU * f64::from(i % 13) / 13.0;
            let radius = if i < 13 { 1.0 } else { 0.7 };
            position.push([left + radius * angle.cos(), radius * angle.sin()]);
        }
        for i in 0..13 {
            let (next, inner) = ((i + 1) % 13, i + 13);
            ends.extend([[i, next], [inner, next + 13], [i, inner], [i, next + 13]].map(|end| end.map(|k| first + k)));
        }
    }
    Model { pinned: (0..count).map(|rim| PointId(26 * rim)).collect(), ..bonded(position, &ends, BondKind::Rigid) }
}

/// A disc of triangles about (0, 0): the points of a triangular lattice 0.1 m apart, the topmost one pinned.
pub(crate) fn disc(radius: f64) -> Model<2> {
    let reach = (radius / 0.08) as i32;
    let (mut position, mut name) = (Vec::new(), std::collections::BTreeMap::new());
    for row in -reach..=reach {
        for column in -2 * reach..=2 * reach {
            let place = [0.1 * f64::from(column) + 0.05 * f64::from(row), 0.0075_f64.sqrt() * f64::from(row)];
            if place[0].hypot(place[1]) <= radius {
                name.insert((row, column), position.len() as u32);
                position.push(place);
            }
        }
    }
    let mut ends = Vec::new();
    for (&(row, column), &a) in &name {
        let near = [(row, column + 1), (row + 1, column), (row + 1, column - 1)];
        ends.extend(near.iter().filter_map(|other| name.get(other)).map(|&b| [a, b]));
    }
    let top = (0..position.len()).max_by(|&a, &b| position[a][1].total_cmp(&position[b][1])).unwrap();
    Model { pinned: vec![PointId(top as u32)], ..bonded(position, &ends, BondKind::Rigid) }
}

/// A hub with so many spokes of 1 m, every third of them thrown up; with a felloe it is a wheel, pinned at its rim.
pub(crate) fn hub(spokes: u32, has_felloe: bool) -> Model<2> {
    let place = |i: u32| {
        let angle = std::f64::consts::TAU * f64::from(i) / f64::from(spokes);
        [angle.cos(), angle.sin()]
    };
    let position = std::iter::once([0.0; 2]).chain((0..spokes).map(place)).collect();
    let mut ends: Vec<[u32; 2]> = (1..=spokes).map(|i| [0, i]).collect();
    if has_felloe {
        ends.extend((0..spokes).map(|i| [1 + i, 1 + (i + 1) % spokes]));
    }
    let mut model = bonded(position, &ends, BondKind::Rigid);
    if has_felloe {
        model.pinned = vec![PointId(1)];
    } else {
        (1..=spokes as usize).for_each(|i| model.velocity[i] = [0.0, if i % 3 == 1 { 3.0 } else { -1.0 }]);
    }
    model
}

/// A tree of bonds of 0.3 m in all directions, its root pinned: so many branches at every point.
pub(crate) fn tree(branches: usize, points: usize) -> Model<2> {
    let (mut position, mut ends, mut draw) = (vec![[0.0, 0.0]], Vec::new(), Draw(5));
    for i in 1..points {
        let parent = (i - 1) / branches;
        let angle = std::f64::consts::TAU * draw.next();
        let [x, y]: [f64; 2] = position[parent];
        position.push([x + 0.3 * angle.cos(), y + 0.3 * angle.sin()]);
        ends.push([parent as u32, i as u32]);
    }
    Model { pinned: vec![PointId(0)], ..bonded(position, &ends, BondKind::Rigid) }
}

/// So many copies of a model, 3 m apart.
pub(crate) fn copies(model: &Model<2>, count: u32) -> Model<2> {
    let points = model.position.len() as u32;
    let mut all = Model { position: Vec::new(), velocity: Vec::new(), mass: Vec::new(), ..model.clone() };
    (all.pinned, all.bonds) = (Vec::new(), Bonds::new());
    for copy in 0..count {
        let of = |point: PointId| PointId(point.0 + copy * points);
        all.position.extend(model.position.iter().map(|[x, y]| [x + 3.0 * f64::from(copy), *y]));
        all.velocity.extend(&model.velocity);
        all.mass.extend(&model.mass);
        all.pinned.extend(model.pinned.iter().map(|&pin| of(pin)));
        model.bonds.iter().for_each(|bond| all.bonds.push(Bond { a: of(bond.a), b: of(bond.b), ..bond }));
    }
    all
}

/// The model with substeps that follow this strain.
pub(crate) fn to_strain<const D: usize>(model: &Model<D>, strain: f64) -> Model<D> {
    Model { method: Method { max_strain: Some(strain), ..model.method }, ..model.clone() }
}

/// The model by paths, however small it is.
pub(crate) fn path<const D: usize>(model: &Model<D>) -> Model<D> {
    Model { method: Method { solver: Solver::Path, ..model.method }, ..model.clone() }
}

/// The model in single precision.
pub(crate) fn single<const D: usize>(model: &Model<D>) -> Model<D> {
    Model { method: Method { precision: Precision::F32, ..model.method }, ..model.clone() }
}

/// The scene file of a model.
pub(crate) fn scene<const D: usize>(model: &Model<D>) -> Scene {
    Scene::parse(&keys(model).to_string(), "scene").unwrap()
}

/// What the scene file of a model says.
pub(crate) fn keys<const D: usize>(model: &Model<D>) -> Value {
    let bond = |bond: Bond| {
        let mut keys = json!({ "a": bond.a.0, "b": bond.b.0, "rest": bond.rest_length });
        match bond.kind {
            BondKind::Rigid => keys["kind"] = "rigid".into(),
            BondKind::Spring { stiffness, damping } => {
                (keys["kind"], keys["stiffness"], keys["damping"]) =
                    ("spring".into(), stiffness.into(), damping.into());
            }
            BondKind::Relaxed { relaxation, .. } => {
                (keys["kind"], keys["relaxation"]) = ("relaxed".into(), relaxation.into());
            }
        }
        if bond.limit == Limit::Max {
            keys["limit"] = "max".into();
        }
        if bond.break_strain.is_finite() {
            keys["break_strain"] = bond.break_strain.into();
        }
        keys
    };
    let list = |vectors: &[[f64; D]]| vectors.iter().map(|v| v.to_vec()).collect::<Vec<_>>();
    let number = |point: &PointId| point.0;
    let mut keys =
        json!({ "wobble": 1, "dimensions": D, "gravity": model.gravity.to_vec(), "drag_rate": model.drag_rate });
    keys["points"] = json!({
        "position": list(&model.position), "velocity": list(&model.velocity), "mass": model.mass,
        "pinned": model.pinned.iter().map(number).collect::<Vec<_>>(),
    });
    keys["bonds"] = model.bonds.iter().map(bond).collect();
    let track = |track: &Track<D>| -> Vec<Vec<f64>> {
        track.knots.iter().map(|(t, x)| std::iter::once(t).chain(x).copied().collect()).collect()
    };
    if !model.pin_motion.is_empty() {
        let motion = |(point, path): &(PointId, Track<D>)| json!({ "point": point.0, "track": track(path) });
        keys["pin_motion"] = model.pin_motion.iter().map(motion).collect();
    }
    if let Some(mouse) = &model.mouse {
        let knots: Vec<[f64; 3]> = mouse.track.knots.iter().map(|&(t, [x, y])| [t, x, y]).collect();
        keys["mouse"] = json!({ "strength": mouse.strength, "radius": mouse.radius });
        if !knots.is_empty() {
            keys["mouse"]["track"] = json!(knots);
        }
    }
    if let Some(Bounds { min, max, restitution, friction }) = &model.bounds {
        let (min, max) = (min.to_vec(), max.to_vec());
        keys["bounds"] = json!({ "min": min, "max": max, "restitution": restitution, "friction": friction });
    }
    let Method { solver, substep, iterations, precision, max_strain, .. } = model.method;
    // What is not asked for in single precision is held to closed forms, which 32 bits blur.
    let precision = if precision == Precision::F32 { "f32" } else { "f64" };
    // Each method is looked at by itself: nothing is handed over.
    keys["method"] = json!({ "solver": solver.name(), "precision": precision, "budget": "none" });
    let numbers = [("substep", substep), ("max_strain", max_strain)];
    for (key, value) in numbers.into_iter().filter_map(|(key, value)| Some((key, value?))) {
        keys["method"][key] = value.into();
    }
    if let Some(iterations) = iterations {
        keys["method"]["iterations"] = iterations.into();
    }
    keys
}

/// A world of a model: made by the library, so that its kernels are compiled once.
pub(crate) fn world<const D: usize>(model: &Model<D>) -> Box<dyn Dynamics> {
    scene(model).world(None).unwrap()
}

/// What moves the first part of a world, in words.
pub(crate) fn kernel(world: &dyn Dynamics) -> &str {
    &world.parts()[0].kernel
}

/// The same sequence of numbers in [-0.5, 0.5) for the same seed.
pub(crate) struct Draw(pub u64);

impl Draw {
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    }

    /// A list in another order.
    pub(crate) fn shuffle<T>(&mut self, list: &mut [T]) {
        for i in (1..list.len()).rev() {
            list.swap(i, ((self.next() + 0.5) * (i + 1) as f64) as usize);
        }
    }
}

/// Takes so many frames, with a look at the state after each.
pub(crate) fn frames(world: &mut dyn Dynamics, count: usize, mut look: impl FnMut(&Sample)) -> Sample {
    for frame in 1..=count {
        let end = frame as f64 * FRAME;
        while world.time() + 0.5 * world.substep() < end {
            world.step();
        }
        // What is no number would pass for the least of all errors.
        assert!(world.is_finite(), "the motion left the finite numbers before {end} s");
        look(&world.sample(world.time()));
    }
    world.sample(world.time())
}

/// The largest speed of any point [m/s].
pub(crate) fn fastest(sample: &Sample) -> f64 {
    sample.velocity.iter().map(|v| v.iter().map(|c| c * c).sum::<f64>().sqrt()).fold(0.0, f64::max)
}

/// The largest distance between points of two samples [m].
pub(crate) fn apart(a: &Sample, b: &Sample) -> f64 {
    let distance = |(p, q): (&[f64; 3], &[f64; 3])| (0..3).map(|k| (p[k] - q[k]).powi(2)).sum::<f64>().sqrt();
    a.position.iter().zip(&b.position).map(distance).fold(0.0, f64::max)
}
