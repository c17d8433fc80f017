//! The points and bonds of a scene: those listed, then its bodies'.

use super::error::Problem;
use super::file::{BondFile, PointsFile, SceneFile};
use super::maker::BodyFile;
use super::material::{BondKeys, above_zero, at_least_zero};
use super::numbers::{Masses, Vector};
use crate::body::{Body, cos, distance, sin};
use crate::sim::{Bond, Limit, PointId};

/// Points and bonds, checked; z = 0 in the plane.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Content {
    /// Positions [m].
    pub position: Vec<[f64; 3]>,
    /// Velocities [m/s].
    pub velocity: Vec<[f64; 3]>,
    /// Masses [kg].
    pub mass: Vec<f64>,
    /// Points that never move.
    pub pinned: Vec<PointId>,
    /// Bonds.
    pub bonds: Vec<Bond>,
}

impl Content {
    /// The content of a scene file.
    ///
    /// Errors: the first key that is wrong.
    pub(crate) fn of(file: &SceneFile) -> Result<Self, Problem> {
        let mut content = Content::default();
        let dimensions = file.dimensions as usize;
        if let Some(points) = &file.points {
            content.list_points(points, dimensions).map_err(|problem| problem.within("points"))?;
        }
        for (i, bond) in file.bonds.iter().enumerate() {
            let bond = content.bond(bond).map_err(|problem| problem.within(format_args!("bonds[{i}]")))?;
            content.bonds.push(bond);
        }
        for (i, body) in file.bodies.iter().enumerate() {
            content.add(body, dimensions).map_err(|problem| problem.within(format_args!("bodies[{i}]")))?;
        }
        Ok(content)
    }

    fn list_points(&mut self, points: &PointsFile, dimensions: usize) -> Result<(), Problem> {
        self.position = vectors("position", &points.position, dimensions)?;
        let count = self.position.len();
        self.velocity = match &points.velocity {
            Some(velocity) => vectors("velocity", velocity, dimensions)?,
            None => vec![[0.0; 3]; count],
        };
        one_a_point("velocity", self.velocity.len(), count)?;
        self.mass = match &points.mass {
            Some(Masses::Each(masses)) => masses.clone(),
            Some(Masses::All(mass)) => vec![*mass; count],
            None => vec![1.0; count],
        };
        one_a_point("mass", self.mass.len(), count)?;
        let each = matches!(points.mass, Some(Masses::Each(_)));
        if let Some(i) = self.mass.iter().position(|&mass| !(mass > 0.0 && mass.is_finite())) {
            let key = if each { format!("mass[{i}]") } else { "mass".to_owned() };
            above_zero(&key, self.mass[i])?;
        }
        self.pin(&points.pinned, 0)
    }

    /// Pins points counted from `first` on.
    fn pin(&mut self, pinned: &[u32], first: usize) -> Result<(), Problem> {
        let count = self.position.len() - first;
        for (i, &point) in pinned.iter().enumerate() {
            exists(&format!("pinned[{i}]"), point, count)?;
            self.pinned.push(PointId(first as u32 + point));
        }
        Ok(())
    }

    fn bond(&self, file: &BondFile) -> Result<Bond, Problem> {
        exists("a", file.a, self.position.len())?;
        exists("b", file.b, self.position.len())?;
        if file.a == file.b {
            return Err(Problem::new("b", format!("point {} is bonded to itself: give two points", file.a)));
        }
        if let Some(rest) = file.rest {
            at_least_zero("rest", rest)?;
        }
        let (a, b) = (PointId(file.a), PointId(file.b));
        let between = || distance(self.position[a.index()], self.position[b.index()]);
        let rest_length = file.rest.unwrap_or_else(between);
        let kind = BondKeys::from(file).kind()?;
        Ok(Bond { a, b, rest_length, kind, limit: file.limit.into() })
    }

    fn add(&mut self, file: &BodyFile, dimensions: usize) -> Result<(), Problem> {
        let kind = BondKeys::from(&file.material).kind().map_err(|problem| problem.within("material"))?;
        let body = file.make.make(dimensions)?;
        let mass = masses(&body, file).map_err(|problem| problem.within("material"))?;
        let place = Placement::of(file, dimensions)?;
        let first = self.position.len();
        if first + body.position.len() > u32::MAX as usize {
            return Err(Problem::new("", "makes more points than can be numbered: make fewer"));
        }
        for &x in &body.position {
            let (position, velocity) = place.put(x);
            self.position.push(position);
            self.velocity.push(velocity);
        }
        self.mass.extend(mass);
        for pair in &body.bonds {
            // Lengths as made, not as placed: far from the origin the placed ones are rounded.
            let [p, q] = pair.map(|point| body.position[point as usize]);
            let [a, b] = pair.map(|point| PointId(first as u32 + point));
            self.bonds.push(Bond { a, b, rest_length: distance(p, q), kind, limit: Limit::Both });
        }
        self.pin(&file.pinned, first)
    }
}

/// Where a body stands and how it moves.
struct Placement {
    origin: [f64; 3],
    velocity: [f64; 3],
    cos: f64,
    sin: f64,
    spin: f64,
}

impl Placement {
    fn of(file: &BodyFile, dimensions: usize) -> Result<Self, Problem> {
        let vector = |key: &str, vector: &Option<Vector>| match vector {
            Some(vector) => vector.components(dimensions).map_err(|problem| problem.within(key)),
            None => Ok([0.0; 3]),
        };
        for (key, value) in [("angle", file.angle), ("spin", file.spin)] {
            if !value.is_finite() {
                return Err(Problem::new(key, "is not finite"));
            }
        }
        let (cos, sin) = if file.angle == 0.0 { (1.0, 0.0) } else { (cos(file.angle), sin(file.angle)) };
        Ok(Placement {
            origin: vector("origin", &file.origin)?,
            velocity: vector("velocity", &file.velocity)?,
            cos,
            sin,
            spin: file.spin,
        })
    }

    /// Position and velocity of a point of the body's own frame.
    fn put(&self, x: [f64; 3]) -> ([f64; 3], [f64; 3]) {
        let turned = [self.cos * x[0] - self.sin * x[1], self.sin * x[0] + self.cos * x[1], x[2]];
        let swirl = [-self.spin * turned[1], self.spin * turned[0], 0.0];
        let sum = |a: [f64; 3], b: [f64; 3]| std::array::from_fn(|k| a[k] + b[k]);
        (sum(self.origin, turned), sum(self.velocity, swirl))
    }
}

/// The masses of a body's points [kg].
fn masses(body: &Body, file: &BodyFile) -> Result<Vec<f64>, Problem> {
    let count = body.position.len();
    match (file.material.mass, file.material.point_mass) {
        (Some(_), Some(_)) => Err(Problem::new("point_mass", "excludes `mass`: give one of them")),
        (Some(mass), None) => {
            above_zero("mass", mass)?;
            let whole: f64 = body.share.iter().sum();
            if body.share.is_empty() {
                return Ok(vec![mass / count as f64; count]);
            }
            Ok(body.share.iter().map(|share| mass * share / whole).collect())
        }
        (None, Some(mass)) => {
            above_zero("point_mass", mass)?;
            Ok(vec![mass; count])
        }
        (None, None) => Ok(vec![1.0; count]),
    }
}

fn vectors(key: &str, list: &[Vector], dimensions: usize) -> Result<Vec<[f64; 3]>, Problem> {
    let read = |(i, vector): (usize, &Vector)| {
        vector.components(dimensions).map_err(|problem| problem.within(format_args!("{key}[{i}]")))
    };
    list.iter().enumerate().map(read).collect()
}

fn one_a_point(key: &str, found: usize, points: usize) -> Result<(), Problem> {
    if found == points {
        return Ok(());
    }
    Err(Problem::new(key, format!("has {found} entries for {points} points: give one a point")))
}

/// Refuses a point that there isn't.
pub(crate) fn exists(key: &str, point: u32, count: usize) -> Result<(), Problem> {
    if (point as usize) < count {
        return Ok(());
    }
    let problem = match count {
        0 => format!("point {point} does not exist: there are no points"),
        1 => format!("point {point} does not exist: there is 1 point, so use 0"),
        _ => format!("point {point} does not exist: there are {count} points, so use 0 to {}", count - 1),
    };
    Err(Problem::new(key, problem))
}
