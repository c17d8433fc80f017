//! What is built in space: ropes, cloths, balls and boxes, drawn in the plane that faces who plays, as deep as what was pressed on.

use glam::{DVec2, DVec3};

use super::fibre::{BuiltOf, Fibre};
use super::form::{ALL_PIECES, CLOTH, Hold, PIECES, short};
use super::grid::Grid;
use super::laid::{Lies, Solids, is_hidden, surface};
use super::matter::{FRICTION, like, part};
use super::{CLICK, Drag, LEAST, Maker, OF_THE_PLANE, TOO_SMALL, ends_said, outline, plumb, usual_size};
use crate::app::action::Primitive;
use crate::app::tools::Deed;
use crate::app::tools::marks::{Mark, Role};
use crate::app::tools::pick::Scope;
use crate::history::Do;
use crate::picture::Coat;
use crate::scene::{
    AddKeys, BodyKeys, BondKeys, BoxKeys, CircleKeys, ColorKey, DiagonalsName, MakerName, MassKeys, Material,
    ObstacleKeys, PointKeys, SkinKeys, Vector,
};
use crate::sim::{BOX_EDGES, PointId};

/// A box is as thick as this share of its longest side at least `[1]`.
const THICK: f64 = 0.3;
/// Said where something finds no place before what stands there.
const WITHIN: &str = "no room here: something is in the way. Draw it elsewhere, or turn the view";
/// Half of what a click makes of a box, in what a click makes.
const USUAL_BOX: [f64; 3] = [1.0, 0.25, 0.6];

/// A primitive in its place.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Form {
    /// From one end to the other in pieces of one length, each end on what it hangs on.
    Rope {
        corners: Vec<DVec3>,
        holds: [Hold; 2],
        /// It goes round something.
        is_bent: bool,
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
        Ok((_, Lies::Within)) => Deed::words(WITHIN.to_owned()),
        Ok((form, _)) => {
            let keys = form.keys(scope.shown.point_count() as u32, maker.of);
            let words = form.ends(scope);
            Deed { words, ..Deed::edit(maker.primitive.name(), Do::Add(Box::new(keys))) }
        }
        Err(words) => Deed::words(words),
    }
}

/// The outline of what would be added, and its size in words.
pub(super) fn marks(maker: Maker, scope: Scope<'_>, drag: Option<&Drag>, at: DVec2) -> Vec<Mark> {
    match form(maker, scope, drag, at) {
        Ok((form, lies)) => {
            let lines = form.lines(scope);
            let words = outline::off(&lines, scope, at, format!("{}{}", form.words(), lies.words()));
            // Below the outline, as it is seen.
            let mut marks = plumb::marks(scope, &form, below(scope));
            marks.extend(lines);
            marks.push(words);
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
fn form(maker: Maker, scope: Scope<'_>, drag: Option<&Drag>, at: DVec2) -> Result<(Form, Lies), String> {
    if !is_of_space(maker.primitive) {
        return Err(OF_THE_PLANE.to_owned());
    }
    let begun = drag.copied().unwrap_or_else(|| Drag::new(scope, at));
    let solids = Solids::of(scope, at);
    if maker.primitive == Primitive::Rope {
        return rope(maker, scope, &solids, (begun, at));
    }
    solids.before(begun, |begun| solid_or_cloth(maker, scope, begun, at))
}

/// The least way of a drag `[px]`, and whether it is a click.
fn is_click(scope: Scope<'_>, begun: Drag, at: DVec2) -> Result<bool, String> {
    let far = begun.pressed.distance(at);
    let is_click = far < CLICK * scope.scale;
    if !is_click && far < LEAST * scope.scale { Err(TOO_SMALL.to_owned()) } else { Ok(is_click) }
}

/// A cloth, a ball or a box as deep as a drag was begun.
fn solid_or_cloth(maker: Maker, scope: Scope<'_>, begun: Drag, at: DVec2) -> Result<Form, String> {
    let usual = usual_size(scope.camera.height());
    let [right, down] = axes(scope, begun.deep, begun.pressed);
    let is_click = is_click(scope, begun, at)?;
    let way = if is_click { DVec3::ZERO } else { way(scope, begun, at) };
    let from = begun.deep;
    let [across, along] = [way.dot(right), way.dot(down)];
    Ok(match maker.primitive {
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

/// How far a drag goes, as deep as it was begun `[m]`.
fn way(scope: Scope<'_>, begun: Drag, at: DVec2) -> DVec3 {
    scope.facing(begun.deep, at) - scope.facing(begun.deep, begun.pressed)
}

/// A rope from where it was pressed: it hangs there, and on the point or the surface that it ends on. It lies before what is on its way.
fn rope(maker: Maker, scope: Scope<'_>, solids: &Solids, (begun, at): (Drag, DVec2)) -> Result<(Form, Lies), String> {
    let usual = usual_size(scope.camera.height());
    let place = |point: PointId| DVec3::from(scope.shown.place(point.index()));
    let tied = |point: Option<PointId>| point.map(|point| (place(point), Hold::Point(point)));
    let free = |at: DVec3| (at, if maker.is_free { Hold::None } else { Hold::Pin });
    let from = tied(begun.point).unwrap_or_else(|| free(begun.deep));
    let to = match is_click(scope, begun, at)? {
        true => (from.0 + 2.0 * usual * below(scope), Hold::None),
        false => tied(point_at(scope, at).filter(|point| begun.point != Some(*point))).unwrap_or_else(|| {
            let solid = surface(scope, at).filter(|_| scope.solid(at).is_some());
            solid.map_or((begun.deep + way(scope, begun, at), Hold::None), free)
        }),
    };
    let is_tied = |hold: Hold| matches!(hold, Hold::Point(_));
    let ends = if is_tied(to.1) && !is_tied(from.1) { [to, from] } else { [from, to] };
    let [least, most] = ALL_PIECES;
    let pieces = |long: f64| (PIECES * long / usual).round().clamp(least, most) as u32;
    let holds = ends.map(|(_, hold)| hold);
    let (corners, lies) = solids.laid(scope, (ends.map(|(at, _)| at), holds.map(is_tied)), pieces);
    Ok((Form::Rope { corners, holds, is_bent: lies == Lies::Before }, lies))
}

/// The point that a rope is tied to which begins or ends at a pixel: none that an obstacle hides.
pub(super) fn point_at(scope: Scope<'_>, at: DVec2) -> Option<PointId> {
    scope.reached(at).into_iter().find(|&point| !is_hidden(scope, at, scope.shown.place(point.index()).into()))
}

/// Which way things fall.
fn below(scope: Scope<'_>) -> DVec3 {
    DVec3::from(scope.shown.settings.gravity.unwrap_or_default()).try_normalize().unwrap_or(DVec3::NEG_Y)
}

/// Where the middle of what is so high `[m]` is that stands on the surface that was pressed on; on none, where it was pressed.
fn lifted(scope: Scope<'_>, begun: Drag, half: f64) -> DVec3 {
    if surface(scope, begun.pressed).is_some() { begun.deep - half * below(scope) } else { begun.deep }
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
    /// The keys that bring it into a world where the next point gets the number `next`, of these matters.
    fn keys(&self, next: u32, of: BuiltOf) -> AddKeys {
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
                    material: Some(bare(of.cloth.cloth(area))),
                    ..BodyKeys::default()
                };
                AddKeys { bodies: vec![body], ..AddKeys::default() }
            }
            Form::Rope { corners, holds, is_bent } => of_rope((corners, *is_bent, of.rope), *holds, next),
        }
    }

    /// What the ends of a rope hang on, in words.
    fn ends(&self, scope: Scope<'_>) -> Option<String> {
        let Form::Rope { holds, .. } = self else { return None };
        ends_said(scope, *holds)
    }

    fn words(&self) -> String {
        match self {
            Form::Rope { corners, .. } => format!("{} m", short(length(corners))),
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
            Form::Rope { corners, holds, .. } => {
                let ends = corners.first().into_iter().chain(corners.last()).zip(holds);
                let rings = ends.filter_map(|(at, hold)| match hold {
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

/// How long a chain is `[m]`.
fn length(corners: &[DVec3]) -> f64 {
    corners.windows(2).map(|pair| pair[0].distance(pair[1])).sum()
}

/// A material without what the skins of the plane alone have.
fn bare(material: Material) -> Material {
    Material { friction: None, restitution: None, ..material }
}

/// A chain of pieces of one length; one that ends on a point of the world is a bond to it.
fn of_rope((corners, is_bent, of): (&[DVec3], bool, Fibre), holds: [Hold; 2], next: u32) -> AddKeys {
    let [at_first, at_last] = holds.map(|hold| if let Hold::Point(point) = hold { Some(point) } else { None });
    let own = &corners[usize::from(at_first.is_some())..corners.len() - usize::from(at_last.is_some())];
    let count = own.len() as u32;
    let (pieces, long) = (corners.len() as u32 - 1, length(corners));
    let whole = bare(of.rope(long, pieces));
    let own_part = part(&whole, length(own) / long);
    let bond = |a: u32, b: u32| like(&whole, BondKeys::new(a, b));
    let tied = [at_first.map(|point| bond(point.0, next)), at_last.map(|point| bond(next + count - 1, point.0))];
    let tied = tied.into_iter().flatten();
    let pins = [(holds[0], 0), (holds[1], count - 1)].into_iter().filter(|(hold, _)| *hold == Hold::Pin);
    let pinned: Vec<u32> = pins.map(|(_, point)| point).collect();
    if is_bent {
        let points = PointKeys {
            position: own.iter().copied().map(vector).collect(),
            mass: own_part.mass.map(|mass| MassKeys::Same(mass / f64::from(count))),
            velocity: None,
            // Points are numbered over the world, those of a body within it.
            pinned: pinned.into_iter().map(|point| next + point).collect(),
        };
        let pieces = (1..count).map(|k| bond(next + k - 1, next + k));
        let skin = |ColorKey(color)| SkinKeys::of_coat((next..next + count).collect(), Coat::of_color(color));
        let skins = own_part.color.map(skin).into_iter().collect();
        return AddKeys { points: Some(points), bonds: pieces.chain(tied).collect(), skins, ..AddKeys::default() };
    }
    let way = own[own.len() - 1] - own[0];
    let body = BodyKeys {
        make: MakerName::Rope,
        count: Some(u64::from(count)),
        to: Some(vector(way)),
        origin: Some(vector(own[0])),
        pinned,
        material: Some(own_part),
        ..BodyKeys::default()
    };
    AddKeys { bonds: tied.collect(), bodies: vec![body], ..AddKeys::default() }
}
