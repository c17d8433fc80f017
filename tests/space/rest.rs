//! Cloth in space at rest: what its motion comes to, and the equilibrium that is looked for without one, are where forces are in balance by a
//! plain Newton's method of this file; what is symmetric hangs symmetric.

use serde_json::{Value, json};
use wobble::equilibrium::settle;
use wobble::scene::{Scene, gallery};
use wobble::sim::{BondKind, Limit, Model};
use wobble::study::find;

use super::{length, run, sub};

/// Newton's last step is shorter than this `[m]`.
const LAST: f64 = 1e-12;

/// Energy of springs, and of the even pull of gravity and of wind by drag, of the points that are free, three numbers each.
struct Energy {
    model: Model<3>,
    /// The place of each point among the free ones.
    free: Vec<Option<usize>>,
    /// Where the first number stands that a row of the second derivatives has, in each row.
    first: Vec<usize>,
}

/// A spring between two places among the free points.
struct Ends {
    places: [Option<usize>; 2],
    /// From the second to the first, and how far that is `[m]`.
    way: [f64; 3],
    far: f64,
}

impl Ends {
    /// Adds the second derivatives of its energy, of these stiffnesses along it and across `[N/m]`.
    fn add_second(&self, rows: &mut [Vec<f64>], [along, across]: [f64; 2]) {
        for (e, f) in [(0, 0), (1, 1), (0, 1), (1, 0)] {
            let [Some(a), Some(b)] = [self.places[e], self.places[f]] else { continue };
            let sign = if e == f { 1.0 } else { -1.0 };
            for (k, l) in (0..9).map(|at| (at / 3, at % 3)).filter(|(k, l)| 3 * b + l <= 3 * a + k) {
                let share = self.way[k] * self.way[l] / (self.far * self.far);
                let all = f64::from(u8::from(k == l));
                rows[3 * a + k][3 * b + l] += sign * (along * share + across * (all - share));
            }
        }
    }
}

impl Energy {
    fn new(model: Model<3>) -> Self {
        let is_pinned = |i: usize| model.pinned.iter().any(|pin| pin.index() == i);
        let (mut free, mut count) = (vec![None; model.position.len()], 0);
        for (_, place) in free.iter_mut().enumerate().filter(|(i, _)| !is_pinned(*i)) {
            *place = Some(count);
            count += 1;
        }
        let mut first: Vec<usize> = (0..3 * count).map(|row| row / 3 * 3).collect();
        for bond in &model.bonds {
            assert!(matches!(bond.kind, BondKind::Spring { .. }) && bond.limit == Limit::Both);
            if let [Some(a), Some(b)] = [bond.a, bond.b].map(|end| free[end.index()]) {
                (0..3).for_each(|k| first[3 * a.max(b) + k] = first[3 * a.max(b) + k].min(3 * a.min(b)));
            }
        }
        Energy { model, free, first }
    }

    /// The energy `[J]`, its slope along each number `[N]`, and how that changes `[N/m]`: rows up to the diagonal.
    fn at(&self, x: &[[f64; 3]]) -> (f64, Vec<f64>, Vec<Vec<f64>>) {
        let mut energy = 0.0;
        let mut slope = vec![0.0; self.first.len()];
        let mut rows: Vec<Vec<f64>> = (0..slope.len()).map(|row| vec![0.0; row + 1]).collect();
        let wind = self.model.wind.map_or([0.0; 3], |wind| wind.velocity);
        let pull = [0, 1, 2].map(|k| self.model.gravity[k] + self.model.drag_rate * wind[k]);
        for (i, free) in self.free.iter().enumerate() {
            let Some(free) = free else { continue };
            for (k, pull) in pull.iter().enumerate() {
                energy -= self.model.mass[i] * pull * x[i][k];
                slope[3 * free + k] -= self.model.mass[i] * pull;
            }
        }
        for bond in &self.model.bonds {
            let BondKind::Spring { stiffness, .. } = bond.kind else { continue };
            let ends = [bond.a, bond.b].map(|end| end.index());
            let way = sub(x[ends[0]], x[ends[1]]);
            let far = length(way);
            let longer = far - bond.rest_length;
            energy += 0.5 * stiffness * longer * longer;
            let places = ends.map(|end| self.free[end]);
            for (k, along) in way.iter().enumerate() {
                let pull = stiffness * longer * along / far;
                let signs = [1.0, -1.0];
                (0..2).for_each(|e| places[e].into_iter().for_each(|at| slope[3 * at + k] += signs[e] * pull));
            }
            let ends = Ends { places, way, far };
            ends.add_second(&mut rows, [stiffness, stiffness * longer / far]);
        }
        (energy, slope, rows)
    }

    /// Solves (rows + shift) step = -slope by Cholesky's method; `None` where that is not positive.
    fn step(&self, mut rows: Vec<Vec<f64>>, shift: f64, slope: &[f64]) -> Option<Vec<f64>> {
        for i in 0..slope.len() {
            rows[i][i] += shift;
            for j in self.first[i]..=i {
                let from = self.first[i].max(self.first[j]);
                let known: f64 = (from..j).map(|k| rows[i][k] * rows[j][k]).sum();
                let left = rows[i][j] - known;
                if i == j && left <= 0.0 {
                    return None;
                }
                rows[i][j] = if i == j { left.sqrt() } else { left / rows[j][j] };
            }
        }
        let mut step: Vec<f64> = slope.iter().map(|s| -s).collect();
        for i in 0..step.len() {
            let known: f64 = (self.first[i]..i).map(|k| rows[i][k] * step[k]).sum();
            step[i] = (step[i] - known) / rows[i][i];
        }
        for i in (0..step.len()).rev() {
            step[i] /= rows[i][i];
            for k in self.first[i]..i {
                step[k] -= rows[i][k] * step[i];
            }
        }
        Some(step)
    }

    fn moved(&self, x: &[[f64; 3]], step: &[f64]) -> Vec<[f64; 3]> {
        let by = |at: usize| [0, 1, 2].map(|k| step[3 * at + k]);
        let place = |(x, free): (&[f64; 3], &Option<usize>)| free.map_or(*x, |at| [0, 1, 2].map(|k| x[k] + by(at)[k]));
        x.iter().zip(&self.free).map(place).collect()
    }

    /// Down from a place to a least energy, where second derivatives are positive: a shape that is stable.
    fn least(&self, start: &[[f64; 3]]) -> Vec<[f64; 3]> {
        let (mut x, mut shift) = (start.to_vec(), 0.0);
        for _ in 0..2000 {
            let (energy, slope, rows) = self.at(&x);
            let Some(step) = self.step(rows, shift, &slope) else {
                shift = (4.0 * shift).max(1e-6);
                continue;
            };
            if shift == 0.0 && step.iter().all(|by| by.abs() < LAST) {
                return x;
            }
            let next = self.moved(&x, &step);
            if self.at(&next).0 <= energy + 1e-13 * energy.abs() {
                (x, shift) = (next, if shift < 1e-6 { 0.0 } else { 0.25 * shift });
            } else {
                shift = (4.0 * shift).max(1e-6);
            }
        }
        panic!("no balance was found");
    }
}

/// The largest distance of a point from its place in a reference [m].
fn apart(x: &[[f64; 3]], y: &[[f64; 3]]) -> f64 {
    x.iter().zip(y).map(|(x, y)| length(sub(*x, *y))).fold(0.0, f64::max)
}

/// How far a sheet of so many columns is from its mirror image across the plane x = `middle` [m].
fn crooked(x: &[[f64; 3]], columns: usize, middle: f64) -> f64 {
    let mirror = |i: usize| {
        let [a, b, c] = x[i / columns * columns + columns - 1 - i % columns];
        [2.0 * middle - a, b, c]
    };
    (0..x.len()).map(|i| length(sub(x[i], mirror(i)))).fold(0.0, f64::max)
}

fn model(scene: &Value) -> Model<3> {
    Scene::parse(&scene.to_string(), "scene").unwrap().model::<3>().unwrap()
}

/// The cloth of the gallery below its bar, above all that it could touch, in a wind without gusts from behind: flat it is not stable, for
/// its middle is pressed together.
fn on_its_bar() -> Value {
    let entry = gallery().iter().find(|entry| entry.name == "cloth-space").unwrap();
    let mut scene: Value = serde_json::from_str(entry.json).unwrap();
    scene["wind"] = json!({"velocity": [0, 0, 1.5]});
    ["pin_motion", "parameters"].iter().for_each(|key| drop(scene.as_object_mut().unwrap().remove(*key)));
    // No step of the motion is left out.
    scene["method"] = json!({"sleep": false});
    scene
}

/// A level sheet that is held at two corners swings down, and comes to rest by drag.
fn by_two_corners() -> Value {
    json!({"wobble": 1, "dimensions": 3, "gravity": [0, -9.81, 0], "drag_rate": 1.5, "method": {"sleep": false},
        "bodies": [{"make": "cloth", "columns": 9, "rows": 9, "spacing": 0.25, "u": [1, 0, 0], "v": [0, 0, 1], "pinned": [0, 8],
            "material": {"kind": "spring", "stiffness": 400, "damping": 1, "point_mass": 0.03}}]})
}

/// A scene in which nothing can be touched.
fn alone(mut scene: Value) -> Value {
    ["contact", "obstacles", "mouse"].iter().for_each(|key| drop(scene.as_object_mut().unwrap().remove(*key)));
    scene
}

/// How far the motion ends from the balance that is nearest to it, and how crooked it hangs there, is bounded by the method: what can meet
/// other bodies is moved by the live step, which keeps no tolerance.
#[test]
fn a_cloth_at_rest_hangs_where_forces_are_in_balance_and_symmetric() {
    for (name, scene, (columns, middle), seconds, most) in [
        ("on its bar among obstacles", on_its_bar(), (11, 0.0), 40.0, 1e-3),
        ("on its bar", alone(on_its_bar()), (11, 0.0), 40.0, 1e-6),
        ("by two corners", by_two_corners(), (9, 1.0), 40.0, 1e-9),
    ] {
        let (rest, _) = run(&scene, seconds);
        let model = model(&alone(scene));
        let energy = Energy::new(model.clone());
        let balance = energy.least(&rest.position);
        let settled = settle(&model).unwrap();
        let least = energy.least(&settled.position);
        assert!(apart(&rest.position, &balance) < most, "{name}: {} m", apart(&rest.position, &balance));
        assert!(crooked(&rest.position, columns, middle) < most, "{name}");
        assert!(settled.is_settled && apart(&settled.position, &least) < 1e-9, "{name}");
        assert!(crooked(&settled.position, columns, middle) < 1e-9, "{name}");
        let low = rest.position.iter().map(|x| x[1]).fold(f64::INFINITY, f64::min);
        assert!(low < model.position.iter().map(|x| x[1]).fold(f64::INFINITY, f64::min), "{name}: it sags");
    }
}

/// One that swung down from a level start hangs where Newton's method gets from there too.
#[test]
fn a_cloth_by_two_corners_swings_down_to_the_least_energy() {
    let scene = by_two_corners();
    let (rest, _) = run(&scene, 40.0);
    let model = model(&scene);
    let truth = Energy::new(model.clone()).least(&model.position);
    assert!(apart(&rest.position, &truth) < 1e-9, "{} m", apart(&rest.position, &truth));
}

/// The truth was worked out elsewhere, in 40 digits.
#[test]
fn a_cloth_on_four_corners_settles_where_its_reference_does() {
    let problem = find("N8_cloth11_corners").unwrap();
    let truth = problem.truth().unwrap();
    let model = problem.scene().unwrap().model::<3>().unwrap();
    let settled = settle(&model).unwrap();
    let sample = &truth.samples[0];
    let energy = Energy::new(model.clone());
    assert!(settled.is_settled && sample.t > 0.0);
    assert!(sample.error(&settled.position) < 1e-9, "{} m", sample.error(&settled.position));
    assert!(sample.error(&energy.least(&settled.position)) < 1e-9);
}
