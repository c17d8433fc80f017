//! Where a rigid body is in space, and how it is turned.

use crate::sim::rigid::motion::Pose;
use crate::sim::vector::{add, cross3, dot, length, scale, sub};

/// Three vectors: where the unit vectors of a shape point, or the columns of a symmetric matrix.
pub(crate) type Matrix = [[f64; 3]; 3];

/// The columns of a matrix, each by its share.
#[inline(always)]
pub(super) fn times(matrix: &Matrix, v: [f64; 3]) -> [f64; 3] {
    add(add(scale(matrix[0], v[0]), scale(matrix[1], v[1])), scale(matrix[2], v[2]))
}

/// A turn as a quaternion of length 1, its scalar first.
#[derive(Clone, Copy, Debug)]
pub(super) struct Turn(pub(super) [f64; 4]);

impl Turn {
    /// About a vector as long as the angle is large, where that is small `[rad]`: right to order 2, and no more than half a turn for any.
    pub(super) fn slight(by: [f64; 3]) -> Self {
        Turn([1.0, 0.5 * by[0], 0.5 * by[1], 0.5 * by[2]]).unit()
    }

    /// The shortest from one unit vector to another.
    pub(super) fn between(from: [f64; 3], to: [f64; 3]) -> Self {
        let [x, y, z] = cross3(from, to);
        Turn([1.0 + dot(from, to), x, y, z]).unit()
    }

    /// Of length 1; of no length it is none.
    pub(super) fn unit(self) -> Self {
        let size = dot(self.0, self.0).sqrt();
        if size > 0.0 { Turn(scale(self.0, 1.0 / size)) } else { Turn([1.0, 0.0, 0.0, 0.0]) }
    }

    /// A vector turned.
    #[inline(always)]
    fn turned(&self, x: [f64; 3]) -> [f64; 3] {
        let [w, v @ ..] = self.0;
        let twice = scale(cross3(v, x), 2.0);
        add(add(x, scale(twice, w)), cross3(v, twice))
    }
}

/// Where a rigid body is: places of its shape are turned, then carried along.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    /// Where the origin of the shape is `[m]`.
    pub(super) middle: [f64; 3],
    /// Where the unit vectors of the shape point.
    pub(super) axes: Matrix,
}

impl Pose<3> for Place {
    type Spin = [f64; 3];

    #[inline(always)]
    fn middle(&self) -> [f64; 3] {
        self.middle
    }

    #[inline(always)]
    fn turned(&self, q: [f64; 3]) -> [f64; 3] {
        times(&self.axes, q)
    }

    #[inline(always)]
    fn back(&self, v: [f64; 3]) -> [f64; 3] {
        let [x, y, z] = self.axes;
        [dot(x, v), dot(y, v), dot(z, v)]
    }

    #[inline(always)]
    fn shifted(&self, by: [f64; 3]) -> Self {
        Place { middle: add(self.middle, by), ..*self }
    }

    fn is_finite(&self) -> bool {
        self.middle.iter().chain(self.axes.iter().flatten()).all(|x| x.is_finite())
    }
}

impl Place {
    /// Moved on, and turned as its shape sees it.
    pub(super) fn moved(&self, by: [f64; 3], turn: Turn) -> Self {
        let unit = |k: usize| std::array::from_fn(|i| if i == k { 1.0 } else { 0.0 });
        let axes: Matrix = std::array::from_fn(|k| self.turned(turn.turned(unit(k))));
        Place { middle: add(self.middle, by), axes: square(axes) }
    }
}

/// Three vectors that are at right angles but for rounding, without that.
fn square([x, y, z]: Matrix) -> Matrix {
    let [xy, yz, zx] = [dot(x, y), dot(y, z), dot(z, x)];
    let own = |v: [f64; 3]| scale(v, 1.5 - 0.5 * dot(v, v));
    let less = |v: [f64; 3], a: [f64; 3], of_a: f64, b: [f64; 3], of_b: f64| {
        sub(sub(own(v), scale(a, 0.5 * of_a)), scale(b, 0.5 * of_b))
    };
    [less(x, y, xy, z, zx), less(y, z, yz, x, xy), less(z, x, zx, y, yz)]
}

/// The unit vector along another, if that has a length.
pub(super) fn unit(v: [f64; 3]) -> Option<[f64; 3]> {
    let size = length(v);
    (size > 0.0 && size.is_finite()).then(|| scale(v, 1.0 / size))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turns_add_up_and_stay_square() {
        let start = Place { middle: [1.0, 2.0, 3.0], axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] };
        let step = Turn([libm::cos(0.05), 0.0, 0.0, libm::sin(0.05)]);
        let end = (0..50).fold(start, |place, _| place.moved([0.0, 0.1, 0.0], step));
        // Fifty times 0.1 rad about the third axis.
        let [x, y] = [libm::cos(5.0), libm::sin(5.0)];
        let off = sub(end.out([1.0, 0.0, 2.0]), [1.0 + x, 7.0 + y, 5.0]);
        assert!(length(off) < 1e-13, "{off:?}");
        assert!(length(sub(end.back(end.turned([1.0, -2.0, 0.5])), [1.0, -2.0, 0.5])) < 1e-14);
    }

    #[test]
    fn the_shortest_turn_leads_there() {
        let [from, to] = [[0.6, 0.8, 0.0], [0.0, 0.6, -0.8]];
        assert!(length(sub(Turn::between(from, to).turned(from), to)) < 1e-15);
    }
}
