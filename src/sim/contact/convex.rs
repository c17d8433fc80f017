//! Balls and boxes in space that points cannot enter.

use crate::sim::vector::{add, cross3, dot, length, scale, span_in_box, sub};

/// A ball or a box, in space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Convex {
    /// Which of both, and where.
    pub figure: Figure,
    /// v_n -> -restitution v_n on touching `[1]`, >= 0.
    pub restitution: f64,
    /// |change of v_t| <= friction |change of v_n| `[1]`, >= 0.
    pub friction: f64,
}

/// The figure of a [`Convex`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Figure {
    /// All within a radius.
    Ball {
        /// Centre `[m]`.
        center: [f64; 3],
        /// Radius `[m]`, > 0.
        radius: f64,
    },
    /// A box, turned about its centre.
    Box {
        /// Lower corner before it is turned `[m]`.
        min: [f64; 3],
        /// Upper corner before it is turned `[m]`, above `min` on every axis.
        max: [f64; 3],
        /// The axis that it is turned about, of any length above 0.
        axis: [f64; 3],
        /// By so much `[rad]`.
        angle: f64,
    },
}

impl Figure {
    /// Whether its numbers are in their ranges.
    pub(crate) fn is_fine(&self) -> bool {
        let is_finite = |x: &[f64; 3]| x.iter().all(|c| c.is_finite());
        match self {
            Figure::Ball { center, radius } => is_finite(center) && *radius > 0.0 && radius.is_finite(),
            Figure::Box { min, max, axis, angle } => {
                let is_wide = (0..3).all(|k| min[k] < max[k] && (max[k] - min[k]).is_finite());
                let is_axis = is_finite(axis) && axis.iter().any(|&c| c != 0.0);
                is_finite(min) && is_finite(max) && is_wide && is_axis && angle.is_finite()
            }
        }
    }

    /// The box as its centre, half its sides `[m]` and the unit vectors along them; `None` of a ball.
    pub fn frame(&self) -> Option<Frame> {
        let &Figure::Box { min, max, axis, angle } = self else { return None };
        let rotation = Rotation::about(axis, angle);
        let half = scale(sub(max, min), 0.5);
        let mut axes = [[0.0; 3]; 3];
        for (k, unit) in axes.iter_mut().enumerate() {
            unit[k] = 1.0;
            *unit = rotation.turned(*unit);
        }
        Some(Frame { center: add(min, half), half, axes })
    }

    /// Its middle `[m]`.
    pub fn center(&self) -> [f64; 3] {
        match *self {
            Figure::Ball { center, .. } => center,
            Figure::Box { min, max, .. } => add(min, scale(sub(max, min), 0.5)),
        }
    }

    /// The box along the axes around it `[m]`.
    pub fn extent(&self) -> [[f64; 3]; 2] {
        let reach = match self.frame() {
            None => [self.radius(); 3],
            Some(frame) => {
                std::array::from_fn(|k| (0..3).map(|side| (frame.axes[side][k] * frame.half[side]).abs()).sum())
            }
        };
        [sub(self.center(), reach), add(self.center(), reach)]
    }

    fn radius(&self) -> f64 {
        match self {
            Figure::Ball { radius, .. } => *radius,
            Figure::Box { .. } => 0.0,
        }
    }

    /// Whether a place is inside, or no further from it than `apart` `[m]`: of a box along its sides; below 0, deeper inside than that.
    pub(crate) fn holds(&self, x: [f64; 3], apart: f64) -> bool {
        match self.frame() {
            None => length(sub(x, self.center())) <= self.radius() + apart,
            Some(frame) => frame.within(x).iter().zip(frame.half).all(|(at, half)| at.abs() <= half + apart),
        }
    }

    /// How deep a place is inside `[m]`, and the way out that is the shortest; `None` outside.
    pub(crate) fn depth(&self, x: [f64; 3]) -> Option<(f64, [f64; 3])> {
        let Some(frame) = self.frame() else {
            let from = sub(x, self.center());
            let far = length(from);
            let out = if far > 0.0 { scale(from, 1.0 / far) } else { [0.0, 1.0, 0.0] };
            return (far < self.radius()).then_some((self.radius() - far, out));
        };
        let at = frame.within(x);
        let mut nearest: Option<(f64, [f64; 3])> = None;
        for k in 0..3 {
            let depth = frame.half[k] - at[k].abs();
            if depth <= 0.0 {
                return None;
            }
            if nearest.is_none_or(|(least, _)| depth < least) {
                nearest = Some((depth, scale(frame.axes[k], if at[k] < 0.0 { -1.0 } else { 1.0 })));
            }
        }
        nearest
    }

    /// Whether a segment leads through more than its skin, which is `slack` `[m]` thick.
    pub(crate) fn is_pierced(&self, [a, b]: [[f64; 3]; 2], slack: f64) -> bool {
        self.entry([a, sub(b, a)], slack).is_some_and(|t| t <= 1.0)
    }

    /// Where a ray from outside or inside first is inside: in lengths of its direction, >= 0; `slack` `[m]` is taken off all around.
    pub fn entry(&self, [origin, direction]: [[f64; 3]; 2], slack: f64) -> Option<f64> {
        let Some(frame) = self.frame() else {
            let radius = (self.radius() - slack).max(0.0);
            let from = sub(origin, self.center());
            let (a, b, c) = (dot(direction, direction), dot(from, direction), dot(from, from) - radius * radius);
            if c < 0.0 {
                return Some(0.0);
            }
            let root = b * b - a * c;
            return (root > 0.0 && b < 0.0).then(|| (-b - root.sqrt()) / a);
        };
        let from = frame.within(origin);
        let way = frame.axes.map(|axis| dot(axis, direction));
        let half = frame.half.map(|half| half - slack);
        span_in_box([from, way], [half.map(|half| -half), half], f64::INFINITY).map(|[enters, _]| enters)
    }

    /// The same scaled about its middle by a factor, turned about an axis, and put with its middle at a place.
    pub(crate) fn placed(&self, center: [f64; 3], (about, turn): ([f64; 3], f64), factor: f64) -> Figure {
        match *self {
            Figure::Ball { radius, .. } => Figure::Ball { center, radius: radius * factor },
            Figure::Box { min, max, axis, angle } => {
                let half = scale(sub(max, min), 0.5 * factor);
                let (axis, angle) = match turn {
                    0.0 => (axis, angle),
                    _ => Rotation::about(about, turn).after(Rotation::about(axis, angle)).parts(),
                };
                Figure::Box { min: sub(center, half), max: add(center, half), axis, angle }
            }
        }
    }
}

/// Where a box lies.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Frame {
    /// Its middle `[m]`.
    pub center: [f64; 3],
    /// Half its sides `[m]`.
    pub half: [f64; 3],
    /// Unit vectors along its sides.
    pub axes: [[f64; 3]; 3],
}

impl Frame {
    /// A place, seen from its middle along its sides `[m]`.
    fn within(&self, x: [f64; 3]) -> [f64; 3] {
        let from = sub(x, self.center);
        self.axes.map(|axis| dot(axis, from))
    }

    /// Its corners `[m]`: bit k of the number says on which side along axis k.
    pub fn corners(&self) -> [[f64; 3]; 8] {
        std::array::from_fn(|number| {
            (0..3).fold(self.center, |x, k| {
                let side = if number >> k & 1 == 1 { self.half[k] } else { -self.half[k] };
                add(x, scale(self.axes[k], side))
            })
        })
    }
}

/// The edges of a box, by the numbers of its corners.
pub const BOX_EDGES: [[u32; 2]; 12] =
    [[0, 1], [2, 3], [4, 5], [6, 7], [0, 2], [1, 3], [4, 6], [5, 7], [0, 4], [1, 5], [2, 6], [3, 7]];

/// A rotation as a unit quaternion.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rotation {
    w: f64,
    v: [f64; 3],
}

impl Rotation {
    /// About an axis of any length above 0 `[rad]`.
    pub(crate) fn about(axis: [f64; 3], angle: f64) -> Self {
        // Scaled first, so that no square overflows.
        let largest = axis.iter().fold(0.0_f64, |most, c| most.max(c.abs()));
        let axis = scale(axis, 1.0 / largest);
        let unit = scale(axis, 1.0 / length(axis));
        Rotation { w: libm::cos(0.5 * angle), v: scale(unit, libm::sin(0.5 * angle)) }
    }

    /// This one after another.
    fn after(self, first: Rotation) -> Rotation {
        let v = add(add(scale(first.v, self.w), scale(self.v, first.w)), cross3(self.v, first.v));
        Rotation { w: self.w * first.w - dot(self.v, first.v), v }
    }

    /// Its axis and angle.
    fn parts(self) -> ([f64; 3], f64) {
        let sine = length(self.v);
        if sine > 0.0 { (self.v, 2.0 * libm::atan2(sine, self.w)) } else { ([0.0, 0.0, 1.0], 0.0) }
    }

    pub(crate) fn turned(self, x: [f64; 3]) -> [f64; 3] {
        let twice = scale(cross3(self.v, x), 2.0);
        add(add(x, scale(twice, self.w)), cross3(self.v, twice))
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;

    fn near(a: [f64; 3], b: [f64; 3]) -> bool {
        length(sub(a, b)) < 1e-12
    }

    #[test]
    fn a_box_lies_where_its_axis_and_angle_turn_it() {
        let quarter = std::f64::consts::FRAC_PI_2;
        let figure = Figure::Box { min: [0.0; 3], max: [4.0, 2.0, 6.0], axis: [0.0, 0.0, 7.0], angle: quarter };
        let frame = figure.frame().unwrap();
        assert_eq!((frame.center, frame.half), ([2.0, 1.0, 3.0], [2.0, 1.0, 3.0]));
        assert!(near(frame.axes[0], [0.0, 1.0, 0.0]) && near(frame.axes[1], [-1.0, 0.0, 0.0]));
        assert!(near(figure.extent()[0], [1.0, -1.0, 0.0]) && near(figure.extent()[1], [3.0, 3.0, 6.0]));
        let (depth, out) = figure.depth([2.9, 1.0, 3.0]).unwrap();
        assert!((depth - 0.1).abs() < 1e-12 && near(out, [1.0, 0.0, 0.0]));
        assert!(figure.depth([3.1, 1.0, 3.0]).is_none());
        let entry = figure.entry([[9.0, 0.0, 3.0], [-2.0, 0.0, 0.0]], 0.0).unwrap();
        assert!((entry - 3.0).abs() < 1e-12);
        assert!(figure.entry([[9.0, 4.0, 3.0], [-2.0, 0.0, 0.0]], 0.0).is_none());
    }

    #[test]
    fn turns_follow_on_each_other() {
        let figure = Figure::Box { min: [-1.0; 3], max: [1.0, 2.0, 3.0], axis: [1.0, 0.0, 0.0], angle: 0.7 };
        let turned = figure.placed(figure.center(), ([0.0, 0.0, 1.0], 0.4), 2.0);
        let (before, after) = (figure.frame().unwrap(), turned.frame().unwrap());
        let (cos, sin) = (0.4_f64.cos(), 0.4_f64.sin());
        for k in 0..3 {
            let [x, y, z] = before.axes[k];
            assert!(near(after.axes[k], [cos * x - sin * y, sin * x + cos * y, z]));
            assert!((after.half[k] - 2.0 * before.half[k]).abs() < 1e-12);
        }
        assert_eq!(figure.placed(figure.center(), ([0.0, 0.0, 1.0], 0.0), 1.0).frame(), figure.frame());
    }

    #[test]
    fn a_segment_pierces_a_ball_or_passes_it() {
        let ball = Figure::Ball { center: [0.0, 1.0, 0.0], radius: 1.0 };
        assert!(ball.is_pierced([[-3.0, 1.0, 0.0], [3.0, 1.5, 0.0]], 0.0));
        assert!(!ball.is_pierced([[-3.0, 2.1, 0.0], [3.0, 2.1, 0.0]], 0.0));
        assert!(!ball.is_pierced([[-3.0, 1.0, 0.0], [-2.0, 1.0, 0.0]], 0.0), "it ends before");
        assert_eq!(ball.depth([0.0, 1.0, 0.0]).unwrap(), (1.0, [0.0, 1.0, 0.0]), "from its middle upwards");
    }

    #[test]
    fn numbers_out_of_their_ranges_are_told() {
        let ball = |radius| Figure::Ball { center: [0.0; 3], radius };
        assert!(ball(1.0).is_fine() && !ball(0.0).is_fine() && !ball(-1.0).is_fine() && !ball(f64::NAN).is_fine());
        let block = |max, axis| Figure::Box { min: [0.0; 3], max, axis, angle: 1.0 };
        assert!(block([1.0; 3], [0.0, 1.0, 0.0]).is_fine());
        assert!(!block([1.0, 0.0, 1.0], [0.0, 1.0, 0.0]).is_fine());
        assert!(!block([1.0; 3], [0.0; 3]).is_fine());
    }
}
