//! The shape in which rigid bonds hold a body in space, and what resists its motion.

use super::hull::corners_of;
use super::layout::{Held, Net};
use super::place::{Matrix, times, unit};
use super::rank::is_rigid;
use crate::sim::rigid::shape::FITS;
use crate::sim::vector::{add, cross3, dot, length, scale, sub};

/// Share of its length by which places in `f64` leave a bond off that is said exactly.
const EXACT: f64 = 1e-12;
/// The same of places that are laid out one by one, where rounding piles up.
const CLOSE: f64 = 1e-10;
/// Least share that the smallest principal moment of inertia is of the largest: of less nothing is left after rounding.
const LEAST_INERTIA: f64 = 1e-9;
/// Share of its way from the first pin by which another one may be off their line.
const IN_LINE: f64 = 1e-6;
/// Pins that each one is tied to.
const TIES: usize = 3;
/// Rounds of Jacobi's method.
const ROUNDS: u32 = 32;

/// What pins leave of six degrees of freedom.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Hold {
    /// All of them.
    Free,
    /// Three: it turns about its origin.
    Point,
    /// One: it turns about this unit vector of the shape through its origin.
    Hinge([f64; 3]),
    /// None.
    Fixed,
}

/// What a rigid body is by itself. Its axes are the principal ones of the weights that it is fitted by.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Shape {
    /// Where its points are, from its middle, or from the first of its pins `[m]`.
    pub(super) places: Vec<[f64; 3]>,
    /// Of its points `[kg]`; 0 of those that are pinned.
    pub(super) masses: Vec<f64>,
    /// What each point counts where the shape is fitted to points `[kg]`: as much as it weighs, pins as much as the mean.
    pub(super) weights: Vec<f64>,
    /// Sums of the weights times the squares of places along each axis, descending `[kg m^2]`.
    pub(super) spread: [f64; 3],
    pub(super) mass: f64,
    /// Where the middle of the mass is from the origin `[m]`.
    pub(super) centre: [f64; 3],
    /// About the origin `[kg m^2]`.
    pub(super) inertia: Matrix,
    /// What an angular momentum makes of a spin `[1/(kg m^2)]`, as pins allow.
    pub(super) inverse: Matrix,
    pub(super) hold: Hold,
    /// Which of its points are pinned, ascending.
    pub(super) pins: Vec<u32>,
    /// The corners of its convex hull, ascending: what can meet planes. None where there are none to meet.
    pub(super) corners: Vec<u32>,
}

impl Shape {
    /// The shape in which bonds hold all points; `None`: they leave some of them loose, are too few, lie in one plane, or contradict each other.
    ///
    /// Places give their side alone, and lengths the rest; where rounding piles up in that, or rank says that they hold, places that fit all lengths
    /// to rounding are the shape itself.
    pub(crate) fn of(mut held: Held) -> Option<Self> {
        let count = held.now.len();
        let pins: Vec<u32> = (0..count as u32).filter(|&k| !held.masses[k as usize].is_finite()).collect();
        tie(&mut held, &pins);
        if count < 4 || pins.len() == count || held.bonds.len() + 6 < 3 * count {
            return None;
        }
        let is_exact = held.misfit(&held.now) <= EXACT;
        let laid = Net::new(&held).laid_out().map(|laid| (held.misfit(&laid), laid));
        let places = match laid {
            // Lengths alone say what it is, so that one that is compiled anew in the middle of a run goes on with the same bits.
            Some((off, laid)) if off <= CLOSE => laid,
            Some(_) if is_exact => held.now,
            Some((off, laid)) => (off <= FITS).then_some(laid)?,
            None => (is_exact && is_rigid(&held)).then_some(held.now)?,
        };
        Self::new(places, held.masses, pins)
    }

    /// Of places and masses, infinite where they are pinned; `None`: hardly anything resists its turning.
    fn new(mut places: Vec<[f64; 3]>, mut masses: Vec<f64>, pins: Vec<u32>) -> Option<Self> {
        pins.iter().for_each(|&pin| masses[pin as usize] = 0.0);
        let mass: f64 = masses.iter().sum();
        let sum = places.iter().zip(&masses).fold([0.0; 3], |sum, (&x, &m)| add(sum, scale(x, m)));
        let middle = scale(sum, 1.0 / mass);
        let origin = pins.first().map_or(middle, |&pin| places[pin as usize]);
        places.iter_mut().for_each(|x| *x = sub(*x, origin));
        let mean = mass / (places.len() - pins.len()) as f64;
        let mut weights = masses.clone();
        pins.iter().for_each(|&pin| weights[pin as usize] = mean);
        let (spread, axes) = principal(second_moments(&places, &weights));
        let seen = |x: [f64; 3]| axes.map(|axis| dot(axis, x));
        places.iter_mut().for_each(|x| *x = seen(*x));
        let inertia = inertia(second_moments(&places, &masses));
        let hold = hold(&places, &pins);
        let inverse = inverse(&inertia, hold)?;
        let centre = if pins.is_empty() { [0.0; 3] } else { seen(sub(middle, origin)) };
        let corners = Vec::new();
        Some(Shape { places, masses, weights, spread, mass, centre, inertia, inverse, hold, pins, corners })
    }

    /// The same, to meet planes, if its hull has no more corners than so many.
    pub(crate) fn with_corners(mut self, most: usize) -> Option<Self> {
        self.corners = corners_of(&self.places);
        (self.corners.len() <= most).then_some(self)
    }

    /// How far its points are from its origin at most `[m]`.
    pub(super) fn reach(&self) -> f64 {
        self.places.iter().map(|q| dot(*q, *q)).fold(0.0, f64::max).sqrt()
    }

    /// Bytes that its lists take.
    pub(super) fn heap_bytes(&self) -> usize {
        self.places.capacity() * size_of::<[f64; 3]>()
            + (self.masses.capacity() + self.weights.capacity()) * size_of::<f64>()
            + (self.pins.capacity() + self.corners.capacity()) * size_of::<u32>()
    }

    /// What of an angular momentum or a torque pins do not take, seen in the shape.
    #[inline]
    pub(super) fn left(&self, v: [f64; 3]) -> [f64; 3] {
        match self.hold {
            Hold::Free | Hold::Point => v,
            Hold::Hinge(axis) => scale(axis, dot(axis, v)),
            Hold::Fixed => [0.0; 3],
        }
    }
}

/// Whether all points are laid out, and lengths contradict each other.
pub(crate) fn contradicts(held: &Held) -> bool {
    let laid = if held.bonds.len() < 6 { None } else { Net::new(held).laid_out() };
    laid.is_some_and(|places| held.misfit(&places) > FITS)
}

/// Pins stay as far from each other as they are, which bonds between them need not say.
fn tie(held: &mut Held, pins: &[u32]) {
    for (k, &pin) in pins.iter().enumerate() {
        for &other in pins.iter().take(k.min(TIES)) {
            let far = length(sub(held.now[pin as usize], held.now[other as usize]));
            held.bonds.push(([other, pin], far));
        }
    }
}

/// Sums of the weights times the products of coordinates.
fn second_moments(places: &[[f64; 3]], weights: &[f64]) -> Matrix {
    let mut sums = [[0.0; 3]; 3];
    for (q, w) in places.iter().zip(weights) {
        for r in 0..3 {
            for c in 0..3 {
                sums[r][c] += w * q[r] * q[c];
            }
        }
    }
    sums
}

/// The inertia tensor by the second moments of the mass.
fn inertia(moments: Matrix) -> Matrix {
    let trace = moments[0][0] + moments[1][1] + moments[2][2];
    std::array::from_fn(|r| std::array::from_fn(|c| if r == c { trace - moments[r][c] } else { -moments[r][c] }))
}

fn hold(places: &[[f64; 3]], pins: &[u32]) -> Hold {
    let from = |pin: &u32| places[*pin as usize];
    let [_, others @ ..] = pins else { return Hold::Free };
    let farthest = others.iter().map(from).max_by(|a, b| dot(*a, *a).total_cmp(&dot(*b, *b)));
    let Some(axis) = farthest.and_then(unit) else { return Hold::Point };
    let is_in_line = |pin: &u32| length(cross3(axis, from(pin))) <= IN_LINE * length(from(pin));
    if others.iter().all(is_in_line) { Hold::Hinge(axis) } else { Hold::Fixed }
}

/// What pins leave of the inverse of an inertia tensor; `None`: it has next to nothing about some axis that is left.
fn inverse(inertia: &Matrix, hold: Hold) -> Option<Matrix> {
    let (moments, axes) = principal(*inertia);
    let along = |axis: [f64; 3], share: f64| axis.map(|x| scale(axis, x * share));
    match hold {
        Hold::Fixed => Some([[0.0; 3]; 3]),
        Hold::Hinge(axis) => {
            let moment = dot(axis, times(inertia, axis));
            (moment > LEAST_INERTIA * moments[0]).then(|| along(axis, 1.0 / moment))
        }
        Hold::Free | Hold::Point => (moments[2] > LEAST_INERTIA * moments[0]).then(|| {
            let parts: [Matrix; 3] = std::array::from_fn(|k| along(axes[k], 1.0 / moments[k]));
            std::array::from_fn(|r| add(add(parts[0][r], parts[1][r]), parts[2][r]))
        }),
    }
}

/// Eigenvalues of a symmetric matrix, descending, and unit vectors along which it has them, a right-handed three (Jacobi's method).
fn principal(mut m: Matrix) -> ([f64; 3], Matrix) {
    let mut axes: Matrix = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    for _ in 0..ROUNDS {
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            if m[p][q] == 0.0 {
                continue;
            }
            let theta = (m[q][q] - m[p][p]) / (2.0 * m[p][q]);
            let t = theta.signum() / (theta.abs() + (theta * theta + 1.0).sqrt());
            let c = 1.0 / (t * t + 1.0).sqrt();
            let s = t * c;
            for row in &mut m {
                let (a, b) = (row[p], row[q]);
                (row[p], row[q]) = (c * a - s * b, s * a + c * b);
            }
            let (a, b) = (m[p], m[q]);
            (m[p], m[q]) = (sub(scale(a, c), scale(b, s)), add(scale(a, s), scale(b, c)));
            (m[p][q], m[q][p]) = (0.0, 0.0);
            let (a, b) = (axes[p], axes[q]);
            (axes[p], axes[q]) = (sub(scale(a, c), scale(b, s)), add(scale(a, s), scale(b, c)));
        }
    }
    let mut order = [0, 1, 2];
    order.sort_by(|&a, &b| m[b][b].total_cmp(&m[a][a]));
    let [x, y, _] = order.map(|k| axes[k]);
    (order.map(|k| m[k][k]), [x, y, cross3(x, y)])
}

#[cfg(test)]
mod tests {
    use super::super::layout::tests::{SIX, TETRAHEDRON, held};
    use super::*;

    fn tetrahedron(pins: &[u32]) -> Option<Shape> {
        let mut held = held(&TETRAHEDRON, &SIX);
        pins.iter().for_each(|&pin| held.masses[pin as usize] = f64::INFINITY);
        Shape::of(held)
    }

    #[test]
    fn principal_axes_are_those_of_the_matrix() {
        let m = [[4.0, 1.0, -0.5], [1.0, 3.0, 0.25], [-0.5, 0.25, 1.0]];
        let (values, axes) = principal(m);
        for (value, axis) in values.iter().zip(axes) {
            assert!(length(sub(times(&m, axis), scale(axis, *value))) < 1e-14, "{value}");
        }
        assert!(values[0] >= values[1] && values[1] >= values[2]);
        assert!((dot(axes[2], cross3(axes[0], axes[1])) - 1.0).abs() < 1e-15);
    }

    #[test]
    fn pins_leave_six_three_one_or_no_degrees_of_freedom() {
        let hold = |pins: &[u32]| tetrahedron(pins).map(|shape| shape.hold);
        assert_eq!(hold(&[]), Some(Hold::Free));
        assert_eq!(hold(&[2]), Some(Hold::Point));
        assert!(matches!(hold(&[0, 1]), Some(Hold::Hinge(_))));
        assert_eq!(hold(&[0, 1, 3]), Some(Hold::Fixed));
        assert_eq!(hold(&[0, 1, 2, 3]), None);
    }

    #[test]
    fn an_inverse_undoes_the_inertia() {
        let shape = tetrahedron(&[2]).unwrap_or_else(|| unreachable!("it is rigid"));
        let v = [0.3, -1.0, 2.0];
        assert!(length(sub(times(&shape.inverse, times(&shape.inertia, v)), v)) < 1e-14);
        // About the pin: by Steiner's theorem m r^2 more than about the middle.
        let free = tetrahedron(&[]).unwrap_or_else(|| unreachable!("it is rigid"));
        let trace = |m: &Matrix| m[0][0] + m[1][1] + m[2][2];
        let about = |x: [f64; 3]| {
            let all = TETRAHEDRON.iter().enumerate().filter(|(k, _)| *k != 2);
            all.map(|(_, p)| 2.0 * dot(sub(*p, x), sub(*p, x))).sum::<f64>()
        };
        assert!((trace(&shape.inertia) - about(TETRAHEDRON[2])).abs() < 1e-13);
        assert!((free.mass, shape.mass) == (4.0, 3.0));
    }

    #[test]
    fn lengths_that_contradict_each_other_make_no_shape() {
        let five = [&TETRAHEDRON[..], &[[0.5, 0.4, -1.0]]].concat();
        let ends = [&SIX[..], &[[0, 4], [1, 4], [2, 4], [3, 4]]].concat();
        assert!(Shape::of(held(&five, &ends)).is_some());
        let mut off = held(&five, &ends);
        off.bonds[9].1 *= 1.001;
        assert!(contradicts(&off));
        assert!(Shape::of(off).is_none());
    }

    #[test]
    fn lengths_are_kept_where_places_are_rounded() {
        let mut rounded = held(&TETRAHEDRON, &SIX);
        rounded.now.iter_mut().flatten().for_each(|x| *x = f64::from(*x as f32));
        let lengths = rounded.bonds.clone();
        let shape = Shape::of(rounded).unwrap_or_else(|| unreachable!("it is rigid"));
        for ([a, b], rest) in lengths {
            let far = length(sub(shape.places[a as usize], shape.places[b as usize]));
            assert!((far - rest).abs() < 1e-14, "{far} {rest}");
        }
    }
}
