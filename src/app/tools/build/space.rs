//! What is built in space: ropes, cloths, balls and boxes, drawn in the plane that faces who plays, as deep as what was pressed on.

use glam::{DVec2, DVec3};

use super::form::{ALL_PIECES, CLOTH, Hold, PIECES, short};
use super::grid::Grid;
use super::matter::{CLOTH_MASS, FRICTION, ROPE_MASS, rigid};
use super::{CLICK, Drag, LEAST, Maker, OF_THE_PLANE, TOO_SMALL, outline, pins_of, usual_size};
use crate::app::action::Primitive;
use crate::app::tools::Deed;
use crate::app::tools::marks::{Mark, Role};
use crate::app::tools::pick::Scope;
use crate::body::hanging;
use crate::history::Do;
use crate::scene::{
    AddKeys, BodyKeys, BondKeys, BoxKeys, CircleKeys, DiagonalsName, KindName, MakerName, ObstacleKeys, Vector,
};
use crate::sim::{BOX_EDGES, PointId};

/// A box is as thick as this share of its longest side at least `[1]`.
const THICK: f64 = 0.3;
/// Half of what a click makes of a box, in what a click makes.
const USUAL_BOX: [f64; 3] = [1.0, 0.25, 0.6];

/// A primitive in its place.
#[derive(Clone, Debug, PartialEq)]
enum Form {
    /// From one end to the other, each on what it hangs on.
    Rope {
        ends: [(DVec3, Hold); 2],
        pieces: u32,
    },
    /// From its upper left corner along its rows and its columns, one cell each.
    Cloth {
        corner: DVec3,
        cell: [DVec3; 2],
        cells: [u32; 2],
        hangs: bool,
    },
    Ball {
        center: DVec3,
        radius: f64,
    },
    Box([DVec3; 2]),
}

/// What a release at a pixel adds to the world; words where that is nothing.
pub(super) fn build(maker: Maker, scope: Scope<'_>, drag: &Drag, at: DVec2) -> Deed {
    match form(maker, scope, Some(drag), at) {
        Ok(form) => {
            let keys = form.keys(scope.shown.point_count() as u32);
            let words = pins_of(maker.primitive, &keys).map(str::to_owned);
            Deed { words, ..Deed::edit(maker.primitive.name(), Do::Add(Box::new(keys))) }
        }
        Err(words) => Deed::words(words),
    }
}

/// The outline of what would be added, and its size in words.
pub(super) fn marks(maker: Maker, scope: Scope<'_>, drag: Option<&Drag>, at: DVec2) -> Vec<Mark> {
    match form(maker, scope, drag, at) {
        Ok(form) => {
            let mut marks = form.lines(scope);
            marks.push(outline::off(&marks, scope, at, form.words()));
            marks
        }
        Err(words) => vec![outline::label(scope, at, words)],
    }
}

/// Whether it is built in space.
pub(in crate::app) fn is_of_space(primitive: Primitive) -> bool {
    matches!(primitive, Primitive::Rope | Primitive::Cloth | Primitive::SolidBox | Primitive::SolidCircle)
}

/// What a drag that ends at a pixel comes to; without one, or with one that is a click, one of the usual size.
///
/// Errors: in words, that it is of the plane, or too small.
fn form(maker: Maker, scope: Scope<'_>, drag: Option<&Drag>, at: DVec2) -> Result<Form, String> {
    if !is_of_space(maker.primitive) {
        return Err(OF_THE_PLANE.to_owned());
    }
    let begun = drag.copied().unwrap_or_else(|| Drag::new(scope, at));
    let usual = usual_size(scope.camera.height());
    let [right, down] = axes(scope, begun.deep, begun.pressed);
    let is_click = begun.pressed.distance(at) < CLICK * scope.scale;
    if !is_click && begun.pressed.distance(at) < LEAST * scope.scale {
        return Err(TOO_SMALL.to_owned());
    }
    let way =
        if is_click { DVec3::ZERO } else { scope.facing(begun.deep, at) - scope.facing(begun.deep, begun.pressed) };
    let from = begun.deep;
    let [across, along] = [way.dot(right), way.dot(down)];
    Ok(match maker.primitive {
        Primitive::Rope => rope(maker, scope, (begun, at), (way, is_click, usual)),
        Primitive::Cloth => {
            let [across, along] = if is_click { [2.0 * usual, 1.5 * usual] } else { [across, along] };
            let from = if is_click { from - 0.5 * (across * right + along * down) } else { from };
            let grid = Grid::fit(DVec2::ZERO, DVec2::new(across, along), &CLOTH);
            if grid.size().min_element() <= 0.0 {
                return Err(TOO_SMALL.to_owned());
            }
            let corner = from + across.min(0.0) * right + along.min(0.0) * down;
            let cell = [right, down].map(|axis| grid.spacing * axis);
            Form::Cloth { corner, cell, cells: grid.cells, hangs: !maker.is_free }
        }
        Primitive::SolidCircle => {
            let half = 0.5 * across.abs().max(along.abs());
            let (center, radius) = match (is_click, maker.is_from_middle) {
                (true, _) => (lifted(scope, begun, 0.5 * usual), 0.5 * usual),
                (false, true) => (from, 2.0 * half),
                (false, false) => (from + half * (across.signum() * right + along.signum() * down), half),
            };
            Form::Ball { center, radius }
        }
        _ => {
            let half = match is_click {
                true => usual * DVec3::from(USUAL_BOX),
                false => {
                    let half = if maker.is_from_middle { way.abs() } else { 0.5 * way.abs() };
                    half.max(DVec3::splat(THICK * half.max_element()))
                }
            };
            let middle = match (is_click, maker.is_from_middle) {
                (true, _) => lifted(scope, begun, half.y),
                (false, true) => from,
                (false, false) => from + 0.5 * way,
            };
            Form::Box([middle - half, middle + half])
        }
    })
}

/// A rope from where it was pressed: it hangs there, and on the point or the surface that it ends on.
fn rope(
    maker: Maker,
    scope: Scope<'_>,
    (begun, at): (Drag, DVec2),
    (way, is_click, usual): (DVec3, bool, f64),
) -> Form {
    let place = |point: PointId| DVec3::from(scope.shown.place(point.index()));
    let tied = |point: Option<PointId>| point.map(|point| (place(point), Hold::Point(point)));
    let free = |at: DVec3| (at, if maker.is_free { Hold::None } else { Hold::Pin });
    let from = tied(begun.point).unwrap_or_else(|| free(begun.deep));
    let to = match is_click {
        true => (from.0 + 2.0 * usual * below(scope), Hold::None),
        false => tied(point_at(scope, at).filter(|point| begun.point != Some(*point))).unwrap_or_else(|| {
            let surface = scope.entry(at).filter(|_| scope.solid(at).is_some());
            surface.map_or((begun.deep + way, Hold::None), free)
        }),
    };
    let ends =
        if matches!(to.1, Hold::Point(_)) && !matches!(from.1, Hold::Point(_)) { [to, from] } else { [from, to] };
    let [least, most] = ALL_PIECES;
    let pieces = (PIECES * ends[0].0.distance(ends[1].0) / usual).round().clamp(least, most) as u32;
    Form::Rope { ends, pieces }
}

/// The point that a rope is tied to which begins or ends at a pixel.
pub(super) fn point_at(scope: Scope<'_>, at: DVec2) -> Option<PointId> {
    scope.reached(at).first().copied()
}

/// Which way things fall.
fn below(scope: Scope<'_>) -> DVec3 {
    DVec3::from(scope.shown.settings.gravity.unwrap_or_default()).try_normalize().unwrap_or(DVec3::NEG_Y)
}

/// Where the middle of what is so high `[m]` is that stands on the surface that was pressed on; on none, where it was pressed.
fn lifted(scope: Scope<'_>, begun: Drag, half: f64) -> DVec3 {
    if scope.entry(begun.pressed).is_some() { begun.deep - half * below(scope) } else { begun.deep }
}

/// To the right and down as it is seen at a place, each of length 1.
fn axes(scope: Scope<'_>, at: DVec3, pixel: DVec2) -> [DVec3; 2] {
    let here = scope.facing(at, pixel);
    [DVec2::X, DVec2::Y].map(|way| (scope.facing(at, pixel + 10.0 * way) - here).normalize_or_zero())
}

fn vector(at: DVec3) -> Vector {
    Vector::Space(at.to_array())
}

impl Form {
    /// The keys that bring it into a world where the next point gets the number `next`.
    fn keys(&self, next: u32) -> AddKeys {
        let obstacle = |keys: ObstacleKeys| AddKeys {
            obstacles: vec![ObstacleKeys { friction: Some(FRICTION), ..keys }],
            ..AddKeys::default()
        };
        match self {
            Form::Ball { center, radius } => {
                let circle = Some(CircleKeys { center: vector(*center), radius: *radius });
                obstacle(ObstacleKeys { circle, ..ObstacleKeys::default() })
            }
            Form::Box([low, high]) => {
                let keys = BoxKeys { min: vector(*low), max: vector(*high), angle: None, rotation: None };
                obstacle(ObstacleKeys { r#box: Some(keys), ..ObstacleKeys::default() })
            }
            Form::Cloth { corner, cell: [u, v], cells: [columns, rows], hangs } => {
                let area = u.length() * v.length() * f64::from(columns * rows);
                let body = BodyKeys {
                    make: MakerName::Cloth,
                    columns: Some(u64::from(*columns) + 1),
                    rows: Some(u64::from(*rows) + 1),
                    spacing: Some(u.length()),
                    u: Some(vector(u.normalize_or_zero())),
                    v: Some(vector(v.normalize_or_zero())),
                    diagonals: Some(DiagonalsName::None),
                    origin: Some(vector(*corner)),
                    pinned: if *hangs { vec![0, *columns] } else { Vec::new() },
                    material: Some(rigid(CLOTH_MASS * area)),
                    ..BodyKeys::default()
                };
                AddKeys { bodies: vec![body], ..AddKeys::default() }
            }
            Form::Rope { ends, pieces } => of_rope(ends, *pieces, next),
        }
    }

    fn words(&self) -> String {
        match self {
            Form::Rope { ends: [from, to], .. } => format!("{} m", short(from.0.distance(to.0))),
            Form::Cloth { cell: [u, v], cells: [columns, rows], .. } => {
                let [wide, high] = [u.length() * f64::from(*columns), v.length() * f64::from(*rows)];
                format!("{} × {} m", short(wide), short(high))
            }
            Form::Ball { radius, .. } => format!("radius {} m", short(*radius)),
            Form::Box([low, high]) => {
                let [x, y, z] = (*high - *low).to_array().map(short);
                format!("{x} × {y} × {z} m")
            }
        }
    }

    fn lines(&self, scope: Scope<'_>) -> Vec<Mark> {
        let pixel = |at: DVec3| scope.camera.screen_from_world(at).map(DVec2::from);
        let line = |[a, b]: [DVec3; 2]| Some(outline::line(scope, Role::Come, [pixel(a)?, pixel(b)?]));
        let held = |at: DVec3, radius: f64| Some(Mark::Ring(Role::Hold, pixel(at)?, radius * scope.scale));
        match self {
            Form::Rope { ends, pieces } => {
                let corners = chain(ends, *pieces);
                let rings = ends.iter().filter_map(|(at, hold)| match hold {
                    Hold::None => None,
                    Hold::Pin => held(*at, 5.0),
                    Hold::Point(_) => held(*at, 9.0),
                });
                corners.windows(2).filter_map(|pair| line([pair[0], pair[1]])).chain(rings).collect()
            }
            Form::Cloth { corner, cell, cells, hangs } => {
                let [u, v] = [0, 1].map(|k| f64::from(cells[k]) * cell[k]);
                let corners = [*corner, corner + u, corner + u + v, corner + v];
                let sides = (0..4).filter_map(|k| line([corners[k], corners[(k + 1) % 4]]));
                sides.chain(corners[..2].iter().filter(|_| *hangs).filter_map(|at| held(*at, 5.0))).collect()
            }
            Form::Ball { center, radius } => {
                let seen = pixel(*center).unwrap_or_default();
                let [right, _] = axes(scope, *center, seen);
                let wide = pixel(*center + *radius * right).map_or(0.0, |rim| rim.distance(seen));
                vec![Mark::Ring(Role::Come, seen, wide)]
            }
            Form::Box([low, high]) => {
                let corner = |k: u32| {
                    let side = |axis: usize| if k >> axis & 1 == 0 { low[axis] } else { high[axis] };
                    DVec3::new(side(0), side(1), side(2))
                };
                BOX_EDGES.iter().filter_map(|ends| line(ends.map(corner))).collect()
            }
        }
    }
}

/// Where the corners of a rope are `[m]`.
fn chain([from, to]: &[(DVec3, Hold); 2], pieces: u32) -> Vec<DVec3> {
    hanging((to.0 - from.0).to_array(), u64::from(pieces), 0.0).into_iter().map(|x| from.0 + DVec3::from(x)).collect()
}

/// A chain of pieces of one length; one that ends on a point of the world is a bond to it.
fn of_rope(ends: &[(DVec3, Hold); 2], pieces: u32, next: u32) -> AddKeys {
    let corners = chain(ends, pieces);
    let [at_first, at_last] = ends.map(|(_, hold)| if let Hold::Point(point) = hold { Some(point) } else { None });
    let count = pieces + 1 - u32::from(at_first.is_some()) - u32::from(at_last.is_some());
    let own = &corners[usize::from(at_first.is_some())..][..count as usize];
    let bond = |a: u32, b: u32| BondKeys { kind: Some(KindName::Rigid), ..BondKeys::new(a, b) };
    let bonds = [at_first.map(|point| bond(point.0, next)), at_last.map(|point| bond(next + count - 1, point.0))];
    let pins = [(ends[0].1, 0), (ends[1].1, count - 1)].into_iter().filter(|(hold, _)| *hold == Hold::Pin);
    let way = own[own.len() - 1] - own[0];
    let body = BodyKeys {
        make: MakerName::Rope,
        count: Some(u64::from(count)),
        to: Some(vector(way)),
        origin: Some(vector(own[0])),
        pinned: pins.map(|(_, point)| point).collect(),
        material: Some(rigid(ROPE_MASS * way.length())),
        ..BodyKeys::default()
    };
    AddKeys { bonds: bonds.into_iter().flatten().collect(), bodies: vec![body], ..AddKeys::default() }
}
