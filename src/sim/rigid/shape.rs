//! The shape in which rigid bonds hold a body.

use crate::sim::vector::{add, cross, dot, scale, sub};

/// Least share of the length of a bond by which a point that two bonds hold must be off the line through their other ends.
const LEAST_HEIGHT: f64 = 1e-2;
/// Share of its length by which a bond may differ from what the others say.
const FITS: f64 = 1e-6;

/// What a rigid body is by itself.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Shape {
    /// Where its points are, from its middle, or from the point that it is pinned at [m].
    pub(crate) places: Vec<[f64; 2]>,
    /// Of its points [kg]; 0 of one that is pinned.
    pub(crate) masses: Vec<f64>,
    pub(crate) mass: f64,
    /// About where its places are counted from [kg m^2].
    pub(crate) inertia: f64,
    /// Which of its points is pinned, and where its middle is from there [m].
    pub(crate) pin: Option<(u32, [f64; 2])>,
    /// The points that may touch something.
    pub(crate) surface: Vec<u32>,
}

/// Points as a shape is found from them: where they are now [m], masses [kg], infinite where they are pinned, and the rigid bonds between them.
pub(crate) struct Held<'a> {
    pub(crate) now: Vec<[f64; 2]>,
    pub(crate) masses: Vec<f64>,
    /// Points in the order of the lists above.
    pub(crate) bonds: Vec<([u32; 2], f64)>,
    pub(crate) surface: &'a [u32],
}

impl Shape {
    /// The shape in which bonds hold all points; `None`: they leave some of them loose, are too few, contradict each other, or more than one
    /// point is pinned.
    ///
    /// From one bond on, point after point is laid out that two bonds hold to what is there, on the side on which it is now: linear in
    /// the bonds.
    pub(crate) fn of(held: Held<'_>) -> Option<Self> {
        let count = held.now.len();
        if count < 3 || held.bonds.len() < 2 * count - 3 {
            return None;
        }
        let mut pinned = (0..count).filter(|&k| !held.masses[k].is_finite());
        let (pin, None) = (pinned.next(), pinned.next()) else { return None };
        let mut ends: Vec<(u32, u32, f64)> =
            held.bonds.iter().flat_map(|&([a, b], rest)| [(a, b, rest), (b, a, rest)]).collect();
        ends.sort_unstable_by_key(|entry| (entry.0, entry.1));
        let starts: Vec<usize> =
            (0..=count as u32).map(|point| ends.partition_point(|entry| entry.0 < point)).collect();
        let of = |point: u32| &ends[starts[point as usize]..starts[point as usize + 1]];
        let mut places = of(0).iter().find_map(|&seed| lay_out(seed, of, &held.now))?;
        let fits = |&([a, b], rest): &([u32; 2], f64)| {
            let d = sub(places[a as usize], places[b as usize]);
            (dot(d, d).sqrt() - rest).abs() <= FITS * rest
        };
        if !held.bonds.iter().all(fits) {
            return None;
        }
        let Held { mut masses, .. } = held;
        if let Some(pin) = pin {
            masses[pin] = 0.0;
        }
        let mass: f64 = masses.iter().sum();
        let sum = places.iter().zip(&masses).fold([0.0; 2], |sum, (&x, &m)| add(sum, scale(x, m)));
        let middle = scale(sum, 1.0 / mass);
        let origin = pin.map_or(middle, |pin| places[pin]);
        places.iter_mut().for_each(|x| *x = sub(*x, origin));
        let inertia = places.iter().zip(&masses).map(|(&x, &m)| m * dot(x, x)).sum();
        let pin = pin.map(|pin| (pin as u32, sub(middle, origin)));
        Some(Shape { places, masses, mass, inertia, pin, surface: held.surface.to_vec() })
    }
}

/// Lays points out from a bond on, as far as two bonds each hold them; `None`: not all.
fn lay_out<'a>(
    (a, b, rest): (u32, u32, f64),
    of: impl Fn(u32) -> &'a [(u32, u32, f64)],
    now: &[[f64; 2]],
) -> Option<Vec<[f64; 2]>> {
    let mut places: Vec<Option<[f64; 2]>> = vec![None; now.len()];
    (places[a as usize], places[b as usize]) = (Some([0.0; 2]), Some([rest, 0.0]));
    let mut list = vec![a, b];
    let mut next = 0;
    while let Some(&point) = list.get(next) {
        next += 1;
        for &(_, q, to) in of(point) {
            if places[q as usize].is_some() {
                continue;
            }
            let at = |i: u32| now[i as usize];
            let from = places[point as usize]?;
            let other = of(q).iter().filter(|entry| entry.1 != point);
            let found = other.filter_map(|&(_, other, rest)| Some((other, places[other as usize]?, rest))).find_map(
                |(other, place, rest)| {
                    let side = cross(sub(at(other), at(point)), sub(at(q), at(point)));
                    third((from, to), (place, rest), side)
                },
            );
            if found.is_some() {
                places[q as usize] = found;
                list.push(q);
            }
        }
    }
    places.into_iter().collect()
}

/// The place at these distances from two others, on the left of the way from the first to the second where `side` > 0; `None`: there is
/// none, or hardly beside it.
fn third((a, to_a): ([f64; 2], f64), (b, to_b): ([f64; 2], f64), side: f64) -> Option<[f64; 2]> {
    let u = sub(b, a);
    let square = dot(u, u);
    let along = (square + to_a * to_a - to_b * to_b) / (2.0 * square);
    let height = to_a * to_a - along * along * square;
    let least = LEAST_HEIGHT * to_a;
    // NaN is beside nothing.
    let is_beside = height > least * least;
    if !is_beside || side == 0.0 {
        return None;
    }
    let out = scale([-u[1], u[0]], side.signum() * (height / square).sqrt());
    Some(add(a, add(scale(u, along), out)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points with the bonds between these ends, as long as they are apart.
    fn shape(now: &[[f64; 2]], ends: &[[u32; 2]], longer: f64) -> Option<Shape> {
        let length = |[a, b]: [u32; 2]| {
            let d = sub(now[a as usize], now[b as usize]);
            dot(d, d).sqrt()
        };
        let mut bonds: Vec<([u32; 2], f64)> = ends.iter().map(|&ends| (ends, length(ends))).collect();
        if let Some(last) = bonds.last_mut() {
            last.1 *= longer;
        }
        let masses = (0..now.len()).map(|i| 1.0 + i as f64).collect();
        Shape::of(Held { now: now.to_vec(), masses, bonds, surface: &[] })
    }

    const SQUARE: [[f64; 2]; 4] = [[2.0, 1.0], [3.0, 1.0], [3.0, 2.0], [2.0, 2.0]];
    const SIDES: [[u32; 2]; 4] = [[0, 1], [1, 2], [2, 3], [3, 0]];

    #[test]
    fn a_square_needs_its_diagonal() {
        assert!(shape(&SQUARE, &SIDES, 1.0).is_none());
        let braced = [SIDES.to_vec(), vec![[0, 2]]].concat();
        let found = shape(&SQUARE, &braced, 1.0).unwrap_or_else(|| unreachable!("it is rigid"));
        // Its points weigh 1 to 4.
        assert!((found.mass - 10.0).abs() < 1e-12);
        let middle = [2.5, 1.7];
        let inertia: f64 = (1..=4).zip(SQUARE).map(|(m, x)| f64::from(m) * dot(sub(x, middle), sub(x, middle))).sum();
        assert!((found.inertia - inertia).abs() < 1e-12, "{} and {inertia}", found.inertia);
    }

    #[test]
    fn lengths_that_contradict_each_other_make_no_shape() {
        let all = [SIDES.to_vec(), vec![[0, 2], [1, 3]]].concat();
        assert!(shape(&SQUARE, &all, 1.0).is_some());
        assert!(shape(&SQUARE, &all, 1.001).is_none());
    }

    #[test]
    fn what_moves_is_no_shape() {
        // Two triangles with a common corner, and with three parallel bars between them.
        let bow = [[0.0, 0.0], [1.0, 0.5], [1.0, -0.5], [-1.0, 0.5], [-1.0, -0.5]];
        assert!(shape(&bow, &[[0, 1], [1, 2], [2, 0], [0, 3], [3, 4], [4, 0], [3, 0]], 1.0).is_none());
        let bars = [[0.0, 0.0], [1.0, 0.0], [0.5, 1.0], [0.0, 3.0], [1.0, 3.0], [0.5, 4.0]];
        let ends = [[0, 1], [1, 2], [2, 0], [3, 4], [4, 5], [5, 3], [0, 3], [1, 4], [2, 5]];
        assert!(shape(&bars, &ends, 1.0).is_none());
        // In a row: a bond's length says nothing across it.
        assert!(shape(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]], &[[0, 1], [1, 2], [0, 2]], 1.0).is_none());
    }
}
