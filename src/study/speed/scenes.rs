//! The scenes of the study of speed: rigid bonds under gravity, in shapes that the rules tell apart.
//!
//! Gravity 9.8 m/s^2, unit masses, neighbours 0.1 m apart, at rest at their rest lengths. A scene runs for 2 s.

use super::super::error::StudyError;
use crate::body::{Disc, Maker};
use crate::sim::{Bond, Model, PointId};

/// Distance of neighbours in ropes, sheets and discs `[m]`.
const SPACING: f64 = 0.1;
/// Gravity `[m/s^2]`.
const GRAVITY: f64 = 9.8;
/// Points on each ring of a rim.
const SECTORS: u32 = 13;

/// Where a sheet is pinned.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Hung {
    /// The whole top row.
    Row,
    /// Its two ends.
    Corners,
}

/// What a scene is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Shape {
    /// So many points in a level row, the first pinned.
    Rope(u32),
    /// A square sheet in rows and columns.
    Net(u32, Hung),
    /// The same with both diagonals of each cell.
    Hard(u32, Hung),
    /// Columns and rows of braced rims, each pinned at its rightmost point.
    Rims(u32, u32),
    /// A disc of triangles of about so many points, hung at the top of its rim.
    Disc(u32),
}

/// A scene by its name.
#[derive(Clone, Copy, Debug)]
pub struct SpeedScene {
    /// What it is called by.
    pub name: &'static str,
    /// Scenes that differ only in size have this in common.
    pub family: &'static str,
    /// What it is called in the table of other engines, if they run it.
    pub peer: Option<&'static str>,
    pub(super) shape: Shape,
}

const fn scene(name: &'static str, family: &'static str, peer: Option<&'static str>, shape: Shape) -> SpeedScene {
    SpeedScene { name, family, peer, shape }
}

static SCENES: [SpeedScene; 17] = [
    scene("rope-1000", "rope", Some("rope 1,000"), Shape::Rope(1_000)),
    scene("rope-10k", "rope", None, Shape::Rope(10_000)),
    scene("rope-100k", "rope", None, Shape::Rope(100_000)),
    scene("net-32", "net", None, Shape::Net(32, Hung::Row)),
    scene("net-100", "net", None, Shape::Net(100, Hung::Row)),
    scene("net-316", "net", None, Shape::Net(316, Hung::Row)),
    scene("hard-32", "hard", Some("hung 32^2"), Shape::Hard(32, Hung::Row)),
    scene("hard-100", "hard", Some("hung 100^2"), Shape::Hard(100, Hung::Row)),
    scene("hard-316", "hard", Some("hung 316^2"), Shape::Hard(316, Hung::Row)),
    scene("hard-1000", "hard", None, Shape::Hard(1_000, Hung::Row)),
    scene("net-corners-100", "net-corners", None, Shape::Net(100, Hung::Corners)),
    scene("hard-corners-100", "hard-corners", None, Shape::Hard(100, Hung::Corners)),
    scene("rims-40", "rims", None, Shape::Rims(8, 5)),
    scene("rims-1000", "rims", Some("1,000 rims"), Shape::Rims(40, 25)),
    scene("disc-10k", "disc", None, Shape::Disc(10_000)),
    scene("disc-100k", "disc", None, Shape::Disc(100_000)),
    scene("disc-1m", "disc", None, Shape::Disc(1_000_000)),
];

/// Every scene, small ones of a family first.
pub fn speed_scenes() -> &'static [SpeedScene] {
    &SCENES
}

/// The scene of a name.
///
/// Errors: one line with all names.
pub fn find_speed_scene(name: &str) -> Result<&'static SpeedScene, String> {
    SCENES.iter().find(|scene| scene.name == name).ok_or_else(|| {
        let names: Vec<&str> = SCENES.iter().map(|scene| scene.name).collect();
        format!("`{name}` is no scene of this study: use one of {}", names.join(", "))
    })
}

impl SpeedScene {
    /// Its points and bonds, with the automatic method.
    ///
    /// Errors: a disc that cannot be meshed, which a test excludes.
    pub fn model(&self) -> Result<Model<2>, StudyError> {
        self.shape.model()
    }
}

impl Shape {
    /// Errors: a disc that cannot be meshed.
    pub(super) fn model(self) -> Result<Model<2>, StudyError> {
        match self {
            Shape::Rope(count) => Ok(rope(count)),
            Shape::Net(side, hung) => Ok(sheet(side, false, hung)),
            Shape::Hard(side, hung) => Ok(sheet(side, true, hung)),
            Shape::Rims(columns, rows) => Ok(rims(columns, rows)),
            Shape::Disc(points) => disc(points),
        }
    }
}

/// Points at rest under gravity, without bonds.
fn points(position: Vec<[f64; 2]>, pinned: Vec<PointId>) -> Model<2> {
    let count = position.len();
    Model {
        position,
        velocity: vec![[0.0; 2]; count],
        mass: vec![1.0; count],
        pinned,
        gravity: [0.0, -GRAVITY],
        ..Model::default()
    }
}

/// Bonds two points at the distance that they have.
fn link(model: &mut Model<2>, a: u32, b: u32) {
    let [p, q] = [a, b].map(|end| model.position[end as usize]);
    let rest = (p[0] - q[0]).hypot(p[1] - q[1]);
    model.bonds.push(Bond::new(PointId(a), PointId(b), rest));
}

fn rope(count: u32) -> Model<2> {
    let mut model = points((0..count).map(|i| [SPACING * f64::from(i), 0.0]).collect(), vec![PointId(0)]);
    (1..count).for_each(|i| link(&mut model, i - 1, i));
    model
}

/// Row r lies at y = -0.1 r; bonds are listed cell by cell.
fn sheet(side: u32, has_diagonals: bool, hung: Hung) -> Model<2> {
    let place = |i: u32| [SPACING * f64::from(i % side), -SPACING * f64::from(i / side)];
    let pinned = match hung {
        Hung::Row => (0..side).map(PointId).collect(),
        Hung::Corners => vec![PointId(0), PointId(side - 1)],
    };
    let mut model = points((0..side * side).map(place).collect(), pinned);
    for i in 0..side * side {
        let (right, below) = (i % side + 1 < side, i / side + 1 < side);
        if right {
            link(&mut model, i, i + 1);
        }
        if below {
            link(&mut model, i, i + side);
        }
        if right && below && has_diagonals {
            link(&mut model, i, i + side + 1);
            link(&mut model, i + 1, i + side);
        }
    }
    model
}

/// Two rings of 13 points a rim, at 1.0 and 0.7 m, with spokes and a brace on the outer one; rims are 3 m apart.
fn rims(columns: u32, rows: u32) -> Model<2> {
    let (mut position, mut pinned) = (Vec::new(), Vec::new());
    for k in 0..columns * rows {
        let centre = [3.0 * f64::from(k % columns), 3.0 * f64::from(k / columns)];
        pinned.push(PointId(position.len() as u32));
        for radius in [1.0, 0.7] {
            for i in 0..SECTORS {
                let (sin, cos) = (std::f64::consts::TAU * f64::from(i) / f64::from(SECTORS)).sin_cos();
                position.push([centre[0] + radius * cos, centre[1] + radius * sin]);
            }
        }
    }
    let mut model = points(position, pinned);
    for k in 0..columns * rows {
        let (outer, inner) = (2 * SECTORS * k, 2 * SECTORS * k + SECTORS);
        for i in 0..SECTORS {
            let next = (i + 1) % SECTORS;
            link(&mut model, outer + i, outer + next);
            link(&mut model, inner + i, inner + next);
            link(&mut model, outer + i, inner + i);
            link(&mut model, outer + i, inner + next);
            if i < 10 {
                link(&mut model, outer + i, outer + (i + 2) % SECTORS);
            }
        }
    }
    model
}

/// Pinned are the points of the rim within 0.3 rad of its top.
fn disc(count: u32) -> Result<Model<2>, StudyError> {
    // A point of the lattice has two triangles of area sqrt(3)/4 to itself.
    let area = f64::from(count) * 0.75_f64.sqrt() * SPACING * SPACING;
    let radius = (area / std::f64::consts::PI).sqrt();
    let body = Maker::Disc(Disc { radius, spacing: SPACING }).make()?;
    let is_top = |[x, y, _]: [f64; 3]| x.hypot(y) > radius * (1.0 - 1e-9) && y > radius * 0.3_f64.cos();
    let pinned = (0..).zip(&body.positions).filter(|(_, x)| is_top(**x)).map(|(i, _)| PointId(i)).collect();
    let mut model = points(body.positions.iter().map(|&[x, y, _]| [x, y]).collect(), pinned);
    for side in &body.links {
        model.bonds.push(Bond::new(PointId(side.a), PointId(side.b), side.rest_length));
    }
    Ok(model)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn counts(shape: Shape) -> (usize, usize, usize) {
        let model = shape.model().unwrap();
        (model.position.len(), model.bonds.len(), model.pinned.len())
    }

    #[test]
    fn scenes_have_their_points_bonds_and_pins() {
        assert_eq!(counts(Shape::Rope(1_000)), (1_000, 999, 1));
        assert_eq!(counts(Shape::Net(100, Hung::Row)), (10_000, 19_800, 100));
        assert_eq!(counts(Shape::Hard(100, Hung::Row)), (10_000, 39_402, 100));
        assert_eq!(counts(Shape::Hard(100, Hung::Corners)), (10_000, 39_402, 2));
        assert_eq!(counts(Shape::Rims(40, 25)), (26_000, 62_000, 1_000));
        let (points, bonds, pinned) = counts(Shape::Disc(10_000));
        assert!((9_500..10_500).contains(&points) && bonds > 28_000 && pinned > 20, "{points} {bonds} {pinned}");
    }

    #[test]
    fn names_are_found_or_told() {
        for scene in speed_scenes() {
            assert_eq!(find_speed_scene(scene.name).unwrap().name, scene.name);
        }
        assert!(find_speed_scene("rim").unwrap_err().contains("rims-1000"));
    }
}
