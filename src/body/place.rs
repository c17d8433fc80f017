//! Where a body stands in the world, and how it moves as a whole.

use super::Body;

/// Rotation, shift and rigid motion of a body.
///
/// Model: x = origin + R(angle) p, v = velocity + spin × (x - origin), both about the axis z through the body's own
/// origin.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Placement {
    /// Where the body's own origin goes `[m]`.
    pub origin: [f64; 3],
    /// Rotation, anticlockwise `[rad]`.
    pub angle: f64,
    /// Velocity of the body's own origin `[m/s]`.
    pub velocity: [f64; 3],
    /// Rate of rotation, anticlockwise `[rad/s]`.
    pub spin: f64,
}

impl Placement {
    /// Positions and velocities in the world, one entry a point of the body.
    ///
    /// Numbers too large come out as not finite, which the caller refuses.
    pub fn place(&self, body: &Body) -> (Vec<[f64; 3]>, Vec<[f64; 3]>) {
        body.positions
            .iter()
            .map(|p| {
                let [x, y] = turned([p[0], p[1]], self.angle);
                let r = [x, y, p[2]];
                let turn = [-self.spin * r[1], self.spin * r[0], 0.0];
                (std::array::from_fn(|k| self.origin[k] + r[k]), std::array::from_fn(|k| self.velocity[k] + turn[k]))
            })
            .unzip()
    }
}

/// A vector of the plane turned anticlockwise by an angle `[rad]`.
pub fn turned([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    let (sin, cos) = (libm::sin(angle), libm::cos(angle));
    [cos * x - sin * y, sin * x + cos * y]
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    fn near(a: [f64; 3], b: [f64; 3]) -> bool {
        crate::body::distance(a, b) < 1e-15
    }

    #[test]
    fn a_body_turns_about_its_own_origin() {
        let body = Body { positions: vec![[0.0; 3], [2.0, 1.0, 5.0]], ..Body::default() };
        let placement = Placement { origin: [1.0, 1.0, 1.0], angle: FRAC_PI_2, velocity: [0.5, 0.0, 0.0], spin: 3.0 };
        let (x, v) = placement.place(&body);
        assert!(near(x[0], [1.0, 1.0, 1.0]) && near(v[0], [0.5, 0.0, 0.0]));
        assert!(near(x[1], [0.0, 3.0, 6.0]) && near(v[1], [0.5 - 6.0, -3.0, 0.0]));
    }

    #[test]
    fn no_placement_changes_nothing() {
        let body = Body { positions: vec![[0.1, -0.7, 0.3]], ..Body::default() };
        let (x, v) = Placement::default().place(&body);
        assert_eq!(x, body.positions);
        assert_eq!(v, [[0.0; 3]]);
    }
}
