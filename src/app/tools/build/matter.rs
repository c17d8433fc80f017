//! What primitives are made of: the keys of the `add` that brings them.

use std::f64::consts::{PI, TAU};

use glam::DVec2;

use super::fibre::{BuiltOf, Fibre};
use super::figure::Figure;
use super::form::{End, Form, Hold, Round, chain};
use super::grain::Grain;
use super::grid::Grid;
use crate::app::matter::Preset;
use crate::scene::{
    AddKeys, BodyKeys, BondKeys, BoxKeys, BraceName, CircleKeys, DiagonalsName, KindName, MakerName, Material,
    ObstacleKeys, PlaneKeys, Vector,
};

/// Mass of a figure `[kg/m^2]`.
const FIGURE_MASS: f64 = 1.0;
/// Mass of a cloth `[kg/m^2]`: a thin sheet.
pub(super) const CLOTH_MASS: f64 = 0.3;
/// Mass of a rope `[kg/m]`.
pub(super) const ROPE_MASS: f64 = 0.15;
/// Springs of a rim are so many times as stiff as those of what is filled: it is thin and bends by far more.
const OF_RIM: f64 = 16.0;
/// How a disc is turned `[rad]`: so that a load on its middle squashes it along a row of its points. Across, it would roll until it is so.
const TURNED: f64 = PI / 6.0;
/// Inner over outer radius of a rim.
pub(super) const INNER: f64 = 0.75;
/// Friction of obstacles `[1]`.
pub(super) const FRICTION: f64 = 0.5;

impl Form {
    /// The keys that bring it into a world where the next point gets the number `next`; bodies are of these matters.
    pub(super) fn keys(&self, next: u32, of: BuiltOf) -> AddKeys {
        let body = |body: BodyKeys| AddKeys { bodies: vec![body], ..AddKeys::default() };
        let obstacle = |obstacle: ObstacleKeys| AddKeys {
            obstacles: vec![ObstacleKeys { friction: Some(FRICTION), ..obstacle }],
            ..AddKeys::default()
        };
        match self {
            Form::Box(grid) => body(block(grid, of.filled)),
            Form::Disc(round) => body(disc(round, (of.filled, of.grain))),
            Form::Rope { ends, pieces, slack } => rope(ends, (*pieces, *slack, of.rope), next),
            Form::Cloth { grid, hangs } => body(cloth(grid, *hangs, of.cloth)),
            Form::Rim(round) => body(rim(round, (of.filled, of.grain))),
            Form::Figure(figure) => body(of_figure(figure)),
            Form::Frame(corners) => body(frame(*corners, of.filled)),
            Form::SolidBox([low, high]) => {
                let keys = BoxKeys { min: vector(*low), max: vector(*high), angle: None, rotation: None };
                obstacle(ObstacleKeys { r#box: Some(keys), ..ObstacleKeys::default() })
            }
            Form::SolidCircle(Round { center, radius }) => {
                let keys = CircleKeys { center: vector(*center), radius: *radius };
                obstacle(ObstacleKeys { circle: Some(keys), ..ObstacleKeys::default() })
            }
            Form::Plane([point, along]) => {
                let normal = vector(along.normalize_or(DVec2::X).perp());
                let keys = PlaneKeys { point: vector(*point), normal };
                obstacle(ObstacleKeys { plane: Some(keys), ..ObstacleKeys::default() })
            }
            Form::Slope(plank) => {
                let corners = plank.corners();
                let middle = 0.5 * (corners[0] + corners[2]);
                let half = 0.5 * DVec2::new(plank.along.length(), plank.thick);
                let angle = Some(plank.along.to_angle());
                let keys = BoxKeys { min: vector(middle - half), max: vector(middle + half), angle, rotation: None };
                obstacle(ObstacleKeys { r#box: Some(keys), ..ObstacleKeys::default() })
            }
        }
    }
}

fn vector(at: DVec2) -> Vector {
    Vector::Plane(at.to_array())
}

pub(super) fn rigid(mass: f64) -> Material {
    Material { kind: Some(KindName::Rigid), mass: Some(mass), ..Material::default() }
}

fn block(grid: &Grid, of: Preset) -> BodyKeys {
    let size = grid.size();
    BodyKeys {
        make: MakerName::Lattice,
        columns: Some(u64::from(grid.cells[0]) + 1),
        rows: Some(u64::from(grid.cells[1]) + 1),
        spacing: Some(grid.spacing),
        origin: Some(vector(grid.low)),
        material: Some(of.material(size.x * size.y, 1.0)),
        ..BodyKeys::default()
    }
}

/// Four corners, four sides and both diagonals.
fn frame([low, high]: [DVec2; 2], of: Preset) -> BodyKeys {
    let size = high - low;
    BodyKeys {
        make: MakerName::Box,
        width: Some(size.x),
        height: Some(size.y),
        supports: Some(2),
        origin: Some(vector(0.5 * (low + high))),
        material: Some(of.material(size.x * size.y, 1.0)),
        ..BodyKeys::default()
    }
}

fn disc(&Round { center, radius }: &Round, (of, grain): (Preset, Grain)) -> BodyKeys {
    BodyKeys {
        make: MakerName::Disc,
        radius: Some(radius),
        spacing: Some(TAU * radius / f64::from(grain.around())),
        angle: Some(TURNED),
        origin: Some(vector(center)),
        material: Some(of.material(PI * radius * radius, 1.0)),
        ..BodyKeys::default()
    }
}

fn rim(&Round { center, radius }: &Round, (of, grain): (Preset, Grain)) -> BodyKeys {
    let area = PI * radius * radius * (1.0 - INNER * INNER);
    use BraceName::{Falling, Inner, Outer, Rising, Spoke};
    BodyKeys {
        make: MakerName::Rim,
        radius: Some(radius),
        inner_radius: Some(INNER * radius),
        sectors: Some(u64::from(grain.around())),
        bracing: Some(vec![Outer, Inner, Spoke, Rising, Falling]),
        origin: Some(vector(center)),
        material: Some(of.material(area, OF_RIM * grain.of_rim())),
        ..BodyKeys::default()
    }
}

fn of_figure(figure: &Figure) -> BodyKeys {
    BodyKeys {
        make: MakerName::Ragdoll,
        height: Some(figure.height()),
        origin: Some(vector(figure.hip())),
        material: Some(rigid(FIGURE_MASS * figure.area())),
        ..BodyKeys::default()
    }
}

/// Its rows run from above.
fn cloth(grid: &Grid, hangs: bool, of: Fibre) -> BodyKeys {
    let size = grid.size();
    let columns = grid.cells[0] + 1;
    BodyKeys {
        make: MakerName::Cloth,
        columns: Some(u64::from(columns)),
        rows: Some(u64::from(grid.cells[1]) + 1),
        spacing: Some(grid.spacing),
        diagonals: Some(DiagonalsName::None),
        origin: Some(vector(grid.low + DVec2::new(0.0, size.y))),
        pinned: if hangs { vec![0, columns - 1] } else { Vec::new() },
        material: Some(of.cloth(size.x * size.y)),
        ..BodyKeys::default()
    }
}

/// A bond as those of a body of a material are.
pub(super) fn like(material: &Material, ends: BondKeys) -> BondKeys {
    let &Material { kind, stiffness, damping, break_strain, .. } = material;
    BondKeys { kind, stiffness, damping, break_strain, ..ends }
}

/// The material of a part of a rope, as stiff as the whole and as heavy as its share `[1]`.
pub(super) fn part(whole: &Material, share: f64) -> Material {
    Material { mass: whole.mass.map(|mass| share * mass), ..whole.clone() }
}

/// A chain of pieces of one length. A piece that ends on a point of the world is a bond to it, as long as it is far when the command is
/// done: a body that moves meanwhile is not jerked.
fn rope(&[from, to]: &[End; 2], (pieces, slack, of): (u32, f64, Fibre), next: u32) -> AddKeys {
    let corners = chain([from.at, to.at], pieces, slack);
    let bonded = |end: End| if let Hold::Point(point) = end.hold { Some(point) } else { None };
    let (at_first, at_last) = (bonded(from), bonded(to));
    let count = pieces + 1 - u32::from(at_first.is_some()) - u32::from(at_last.is_some());
    let own = &corners[usize::from(at_first.is_some())..][..count as usize];
    let (first, way) = (own[0], own[own.len() - 1] - own[0]);
    let piece = corners[0].distance(corners[1]);
    let whole = of.rope(f64::from(pieces) * piece, pieces);
    let bond = |a: u32, b: u32| like(&whole, BondKeys::new(a, b));
    let at_first = at_first.map(|point| bond(point.0, next));
    let at_last = at_last.map(|point| bond(next + count - 1, point.0));
    let pins = [(from, 0), (to, count - 1)].into_iter().filter(|(end, _)| end.hold == Hold::Pin);
    let long = f64::from(count - 1) * piece;
    // What lies on a part of the arc hangs by a part of its slack.
    let own_slack = (slack > 0.0).then(|| long / way.length() - 1.0);
    AddKeys {
        bonds: at_first.into_iter().chain(at_last).collect(),
        bodies: vec![BodyKeys {
            make: MakerName::Rope,
            count: Some(u64::from(count)),
            to: Some(vector(way)),
            slack: own_slack.filter(|slack| *slack > 0.0),
            origin: Some(vector(first)),
            pinned: pins.map(|(_, point)| point).collect(),
            material: Some(part(&whole, f64::from(count - 1) / f64::from(pieces))),
            ..BodyKeys::default()
        }],
        ..AddKeys::default()
    }
}
