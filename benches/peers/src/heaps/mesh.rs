//! What every engine is given: the points, springs, triangles and skins that wobble makes of a scene.

use std::collections::BTreeMap;

use anyhow::{Result, ensure};
use serde::Deserialize;

/// Radius of wobble's skins, in mean edges of a skin: what SCENE.md says where a scene says nothing.
pub(crate) const SKIN: f64 = 0.05;
/// Friction between two bodies: likewise.
pub(crate) const FRICTION: f64 = 0.5;

/// Equal bodies of springs, each inside one closed skin.
pub(crate) struct Mesh {
    /// Place of each point at the start [m]; body after body, as many points each.
    pub(crate) positions: Vec<[f64; 2]>,
    /// Velocity of each point at the start [m/s].
    pub(crate) velocities: Vec<[f64; 2]>,
    /// Mass of each point [kg].
    pub(crate) masses: Vec<f64>,
    /// Springs, at rest at the start.
    pub(crate) springs: Vec<Spring>,
    /// Anticlockwise corners.
    pub(crate) triangles: Vec<[usize; 3]>,
    /// The points around each body, anticlockwise.
    pub(crate) skins: Vec<Vec<usize>>,
    /// L, the mean edge of the skins at the start [m].
    pub(crate) edge: f64,
    /// The box around all.
    pub(crate) walls: Walls,
    /// Downward acceleration [m/s^2].
    pub(crate) gravity: f64,
}

/// A spring with a damper along it.
#[derive(Clone, Copy, Deserialize)]
pub(crate) struct Spring {
    a: usize,
    b: usize,
    /// Length at rest [m].
    pub(crate) rest: f64,
    /// Force over stretch [N/m].
    pub(crate) stiffness: f64,
    /// Force over speed of stretching [N s/m].
    pub(crate) damping: f64,
}

impl Spring {
    /// The points that it joins.
    pub(crate) fn ends(self) -> [usize; 2] {
        [self.a, self.b]
    }

    /// Natural frequency [Hz] and damping ratio of two masses on this spring: how both engines want it said.
    pub(crate) fn softness(self, masses: &[f64]) -> [f64; 2] {
        let mass = 1.0 / (1.0 / masses[self.a] + 1.0 / masses[self.b]);
        let omega = (self.stiffness / mass).sqrt();
        [omega / std::f64::consts::TAU, self.damping / (2.0 * mass * omega)]
    }
}

/// A box in which all stay.
#[derive(Clone, Copy, Deserialize)]
pub(crate) struct Walls {
    /// Its lower left corner [m].
    pub(crate) min: [f64; 2],
    /// Its upper right corner [m].
    pub(crate) max: [f64; 2],
    /// Friction of points on it.
    pub(crate) friction: f64,
}

impl Walls {
    /// Half the thickness of [`Walls::slabs`] [m].
    const HALF: f64 = 1.0;

    /// Middle and half extents of the floor and both walls, `skin` outside the box so that points inside a skin reach it.
    pub(crate) fn slabs(self, skin: f64) -> [([f64; 2], [f64; 2]); 3] {
        let ([left, low], [right, high]) = (self.min, self.max);
        let (out, middle) = (skin + Self::HALF, [(left + right) / 2.0, (low + high) / 2.0]);
        let upright = [Self::HALF, (high - low) / 2.0 + 2.0 * out];
        let floor = ([middle[0], low - out], [(right - left) / 2.0 + 2.0 * out, Self::HALF]);
        [floor, ([left - out, middle[1]], upright), ([right + out, middle[1]], upright)]
    }
}

impl Mesh {
    /// Reads a scene file whose bodies are points and bonds.
    ///
    /// Errors: what is missing, and bodies that aren't equal.
    pub(crate) fn parse(text: &[u8], bodies: usize) -> Result<Self> {
        let File { points, bonds, triangles, gravity, bounds } = serde_json::from_slice(text)?;
        let count = points.position.len();
        ensure!(bodies > 0 && count % bodies == 0, "{count} points don't make {bodies} equal bodies");
        let triangles: Vec<_> = triangles.into_iter().map(|corners| anticlockwise(corners, &points.position)).collect();
        let mut mesh = Mesh {
            velocities: points.velocity.unwrap_or_else(|| vec![[0.0; 2]; count]),
            skins: skins(&triangles, count / bodies),
            positions: points.position,
            masses: points.mass,
            springs: bonds,
            triangles,
            edge: 0.0,
            walls: bounds,
            gravity: -gravity[1],
        };
        ensure!(mesh.skins.len() == bodies, "{} skins around {bodies} bodies", mesh.skins.len());
        let edges = mesh.skins.iter().flat_map(|skin| skin.iter().zip(skin.iter().cycle().skip(1)));
        let lengths: Vec<f64> = edges.map(|(&i, &j)| mesh.distance(i, j)).collect();
        mesh.edge = lengths.iter().sum::<f64>() / lengths.len().max(1) as f64;
        Ok(mesh)
    }

    /// Number of points of each body.
    pub(crate) fn points_a_body(&self) -> usize {
        self.positions.len() / self.skins.len()
    }

    /// Places at the start for skins of radius `skin`, of which some would overlap where bodies are `gap` apart.
    ///
    /// Bodies are listed from below: each is raised by what is missing to the one before.
    pub(crate) fn raised(&self, skin: f64, gap: f64) -> Vec<[f64; 2]> {
        let missing = (2.0 * skin - gap).max(0.0);
        let each = self.points_a_body();
        self.positions.iter().enumerate().map(|(i, p)| [p[0], p[1] + missing * (i / each) as f64]).collect()
    }

    fn distance(&self, i: usize, j: usize) -> f64 {
        let [a, b] = [self.positions[i], self.positions[j]];
        (a[0] - b[0]).hypot(a[1] - b[1])
    }
}

/// Twice the area of a triangle [m^2], negative if its corners are clockwise.
pub(crate) fn double_area(corners: [usize; 3], positions: &[[f64; 2]]) -> f64 {
    let [a, b, c] = corners.map(|i| positions[i]);
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

pub(crate) fn anticlockwise([a, b, c]: [usize; 3], positions: &[[f64; 2]]) -> [usize; 3] {
    if double_area([a, b, c], positions) < 0.0 { [a, c, b] } else { [a, b, c] }
}

/// The loop around each body of `each` points: edges that one triangle has, from the body's lowest point on.
pub(crate) fn skins(triangles: &[[usize; 3]], each: usize) -> Vec<Vec<usize>> {
    let sides = || triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    let all: std::collections::BTreeSet<[usize; 2]> = sides().collect();
    let mut next: BTreeMap<usize, usize> =
        sides().filter(|&[a, b]| !all.contains(&[b, a])).map(|[a, b]| (a, b)).collect();
    let mut loops: Vec<Vec<usize>> = Vec::new();
    while let Some((start, mut at)) = next.pop_first() {
        // A second loop of the same body is a hole: none of these has one, and the count of loops then says so.
        let mut around = vec![start];
        while let Some(after) = next.remove(&at) {
            around.push(at);
            at = after;
        }
        debug_assert!(around.iter().all(|i| i / each == start / each), "a skin around two bodies");
        loops.push(around);
    }
    loops
}

/// What is read of a scene file.
#[derive(Deserialize)]
struct File {
    points: Points,
    bonds: Vec<Spring>,
    triangles: Vec<[usize; 3]>,
    gravity: [f64; 2],
    bounds: Walls,
}

#[derive(Deserialize)]
struct Points {
    position: Vec<[f64; 2]>,
    velocity: Option<Vec<[f64; 2]>>,
    mass: Vec<f64>,
}

/// A disc of a hub and 16 spokes above a floor, for tests that have no wobble to ask.
#[cfg(test)]
pub(crate) fn wheel(radius: f64, height: f64) -> Result<Mesh> {
    use serde_json::json;
    const RIM: usize = 16;
    let corner = |i: usize| {
        // A side below, not a corner: the wheel stands on two points.
        let (sin, cos) = (std::f64::consts::TAU * (i as f64 + 0.5) / RIM as f64).sin_cos();
        [radius * cos, height + radius * sin]
    };
    let mut positions: Vec<[f64; 2]> = (0..RIM).map(corner).collect();
    positions.push([0.0, height]);
    let bond = |a: usize, b: usize| {
        let rest = (positions[a][0] - positions[b][0]).hypot(positions[a][1] - positions[b][1]);
        json!({"a": a, "b": b, "rest": rest, "stiffness": 3000.0, "damping": 2.0})
    };
    let bonds: Vec<_> = (0..RIM).flat_map(|i| [bond(i, (i + 1) % RIM), bond(i, RIM)]).collect();
    let triangles: Vec<_> = (0..RIM).map(|i| [RIM, (i + 1) % RIM, i]).collect();
    let file = json!({"points": {"position": positions, "mass": vec![1.0 / (RIM + 1) as f64; RIM + 1]},
        "bonds": bonds, "triangles": triangles, "gravity": [0.0, -9.81],
        "bounds": {"min": [-5.0, 0.0], "max": [5.0, 10.0], "friction": 0.5}});
    Mesh::parse(&serde_json::to_vec(&file)?, 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wheel_has_one_skin_around_its_rim() -> Result<()> {
        let mesh = wheel(1.0, 2.0)?;
        assert_eq!(mesh.skins, [(0..16).collect::<Vec<_>>()]);
        assert!((mesh.edge - 2.0 * (std::f64::consts::PI / 16.0).sin()).abs() < 1e-12);
        assert!(mesh.triangles.iter().all(|&corners| double_area(corners, &mesh.positions) > 0.0));
        Ok(())
    }

    #[test]
    fn softness_is_that_of_two_masses_on_a_spring() {
        let spring = Spring { a: 0, b: 1, rest: 1.0, stiffness: 8.0, damping: 4.0 };
        let [frequency, ratio] = spring.softness(&[4.0, 4.0]);
        assert!((frequency * std::f64::consts::TAU - 2.0).abs() < 1e-12 && (ratio - 0.5).abs() < 1e-12);
    }

    #[test]
    fn thick_skins_start_apart() -> Result<()> {
        let mesh = wheel(1.0, 2.0)?;
        let two = Mesh {
            positions: mesh.positions.repeat(2),
            skins: vec![mesh.skins[0].clone(), mesh.skins[0].iter().map(|i| i + 17).collect()],
            ..mesh
        };
        let raised = two.raised(0.5, 0.4);
        assert_eq!(raised[..17], two.positions[..17]);
        assert!((raised[17][1] - two.positions[17][1] - 0.6).abs() < 1e-12);
        Ok(())
    }
}
