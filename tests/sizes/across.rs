//! A scene just below a size and one just above it: what moves them, where to, and at what cost.

use serde_json::{Value, json};
use wobble::scene::Scene;
use wobble::sim::{Bond, BondKind, Model, PointId, Precision};

use crate::common::physics::run_to;
use crate::large::models::{self, Draw};
use crate::sizes::page;

/// A motion: what moved it, where its points were at four times, and what it cost by counting.
#[derive(Debug)]
pub(crate) struct Motion {
    /// The methods and kernels of its groups.
    pub(crate) by: String,
    pub(crate) places: Vec<Vec<[f64; 3]>>,
    pub(crate) work: f64,
    pub(crate) events: u64,
}

/// Two scenes whose first points move alike, on either side of a size.
pub(crate) struct Across {
    pub(crate) size: &'static str,
    pub(crate) below: Value,
    pub(crate) above: Value,
    /// How they are moved for an independent motion: keys that replace those of the scene below.
    pub(crate) fine: Value,
    pub(crate) seconds: f64,
    /// How many points are compared.
    pub(crate) points: usize,
}

impl Across {
    /// Looks whether both move as a finer run does, within the error on the page, for the work on the page. Returns both motions.
    pub(crate) fn check(&self) -> [Motion; 2] {
        let [below, above] = [&self.below, &self.above].map(|keys| moved(keys, self.seconds));
        let fine = moved(&with(self.below.clone(), &self.fine), self.seconds);
        let errors = [&below, &above].map(|motion| apart(motion, &fine, self.points));
        let (between, ratio) = (apart(&below, &above, self.points), above.work / below.work);
        let found = format!(
            "{}: errors {:.1e} and {:.1e} m, {between:.1e} m apart, work {ratio:.3}; {} / {}, events {} / {}",
            self.size, errors[0], errors[1], below.by, above.by, below.events, above.events
        );
        if std::env::var("WOBBLE_SHOW").is_ok() {
            crate::common::say(&found);
        }
        let row = page::row(self.size);
        let most = errors[0].max(errors[1]).max(between);
        assert!(most <= row.error && most >= 0.3 * row.error, "{found}; the page says {:e} m", row.error);
        assert!((ratio / row.work - 1.0).abs() <= 0.1, "{found}; the page says {}", row.work);
        [below, above]
    }

    /// The same where another method moves each of them, as named.
    pub(crate) fn check_methods(&self, by: [&str; 2]) {
        let motions = self.check();
        assert_eq!([0, 1].map(|side| &*motions[side].by), by, "{}", self.size);
    }
}

/// Keys of a scene changed: objects by their keys, all else as a whole; null takes a key away.
pub(crate) fn with(mut keys: Value, changes: &Value) -> Value {
    merge(&mut keys, changes);
    keys
}

fn merge(keys: &mut Value, changes: &Value) {
    match (keys, changes) {
        (Value::Object(keys), Value::Object(changes)) => {
            for (key, change) in changes {
                if change.is_null() {
                    keys.remove(key);
                    continue;
                }
                merge(keys.entry(key.clone()).or_insert(Value::Null), change);
            }
        }
        (keys, changes) => *keys = changes.clone(),
    }
}

/// The keys of a model, with some changed.
pub(crate) fn keys<const D: usize>(model: &Model<D>, changes: &Value) -> Value {
    with(models::keys(model), changes)
}

/// Another method, its frames cut into so many substeps.
pub(crate) fn fine(solver: &str, substeps: u32) -> Value {
    json!({ "method": { "solver": solver, "substep": models::FRAME / f64::from(substeps), "max_strain": null } })
}

/// A floor at this height `[m]`.
pub(crate) fn floor(height: f64) -> Value {
    json!({ "obstacles": [{ "plane": { "point": [0, height], "normal": [0, 1] }, "restitution": 0.3, "friction": 0.2 }] })
}

/// A spring.
pub(crate) fn spring(stiffness: f64) -> BondKind {
    BondKind::Spring { stiffness, damping: 0.0 }
}

/// The model with all bonds of this kind.
pub(crate) fn of(kind: BondKind, model: Model<2>) -> Model<2> {
    Model { bonds: model.bonds.iter().map(|bond| Bond { kind, ..bond }).collect(), ..model }
}

/// The model with its points thrown at up to half of this speed along each axis `[m/s]`.
pub(crate) fn thrown<const D: usize>(speed: f64, model: Model<D>) -> Model<D> {
    let mut draw = Draw(3);
    let velocity = model.velocity.iter().map(|_| std::array::from_fn(|_| speed * draw.next())).collect();
    Model { velocity, ..model }
}

/// The model with a row of so many further bonds 50 m off, one island with it by a spring that pulls by nothing.
pub(crate) fn tipped(model: &Model<2>, bonds: u32, kind: BondKind) -> Model<2> {
    let mut all = model.clone();
    let first = all.position.len() as u32;
    let [x, y] = all.position[first as usize - 1];
    for i in 0..=bonds {
        all.position.push([x + 50.0 + 0.1 * f64::from(i), y]);
        all.velocity.push([0.0; 2]);
        all.mass.push(1.0);
    }
    all.bonds.push(Bond { kind: spring(1e-9), ..Bond::new(PointId(first - 1), PointId(first), 50.0) });
    for i in first..first + bonds {
        all.bonds.push(Bond { kind, ..Bond::new(PointId(i), PointId(i + 1), 0.1) });
    }
    all
}

/// The model with so many loose points far off.
pub(crate) fn beside<const D: usize>(model: &Model<D>, points: u32) -> Model<D> {
    let mut all = model.clone();
    for i in 0..points {
        let mut place = [0.0; D];
        place[0] = -50.0 - 0.1 * f64::from(i);
        all.position.push(place);
        all.velocity.push([0.0; D]);
        all.mass.push(1.0);
    }
    all
}

/// What scalar a scene is made of.
pub(crate) fn precision(keys: &Value) -> Precision {
    Scene::parse(&keys.to_string(), "scene").unwrap().world(None).unwrap().precision()
}

/// Moves a scene for so long `[s]`.
pub(crate) fn moved(keys: &Value, seconds: f64) -> Motion {
    let mut world = Scene::parse(&keys.to_string(), "scene").unwrap().world(None).unwrap();
    let words = |part: &wobble::sim::PlanPart| format!("{} {}", part.solver.name(), part.kernel).trim().to_owned();
    let by = world.parts().iter().map(words).collect::<Vec<_>>().join(", ");
    let quarter = |part: u32| run_to(&mut *world, seconds * f64::from(part) / 4.0).position;
    let places = (1..=4).map(quarter).collect();
    Motion { by, places, work: world.counters().work as f64, events: world.counters().events }
}

/// The farthest that one of the first points is from where it is in another motion, at any of the four times `[m]`.
pub(crate) fn apart(a: &Motion, b: &Motion, points: usize) -> f64 {
    let pairs = a.places.iter().zip(&b.places).flat_map(|(a, b)| a[..points].iter().zip(&b[..points]));
    let distance = |(a, b): (&[f64; 3], &[f64; 3])| (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt();
    pairs.map(distance).fold(0.0, f64::max)
}
