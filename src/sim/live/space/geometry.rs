//! Where points lie of triangles and segments, in space.

use crate::sim::real::Real;
use crate::sim::vector::{add, cross3, dot, scale, sub};

/// A vector in space.
pub(super) type Vec3<S> = [S; 3];

/// The place of a triangle that is nearest to a point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Nearest<S> {
    /// Shares of the corners `[1]`: the place is their mean.
    pub(super) shares: [S; 3],
    /// From it to the point `[m]`.
    pub(super) from: Vec3<S>,
    /// It lies within, not on a side.
    pub(super) is_within: bool,
}

/// The place of the triangle a, b, c that is nearest to p.
///
/// Source: C. Ericson, Real-Time Collision Detection, 2005, 5.1.5.
#[inline(always)]
pub(super) fn nearest<S: Real>([p, a, b, c]: [Vec3<S>; 4]) -> Nearest<S> {
    let (ab, ac, ap) = (sub(b, a), sub(c, a), sub(p, a));
    let on = |shares: [S; 3]| {
        let from = sub(ap, add(scale(ab, shares[1]), scale(ac, shares[2])));
        Nearest { shares, from, is_within: false }
    };
    let (d1, d2) = (dot(ab, ap), dot(ac, ap));
    if d1 <= S::ZERO && d2 <= S::ZERO {
        return on([S::ONE, S::ZERO, S::ZERO]);
    }
    let bp = sub(p, b);
    let (d3, d4) = (dot(ab, bp), dot(ac, bp));
    if d3 >= S::ZERO && d4 <= d3 {
        return on([S::ZERO, S::ONE, S::ZERO]);
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= S::ZERO && d1 >= S::ZERO && d3 <= S::ZERO {
        let v = d1 / (d1 - d3);
        return on([S::ONE - v, v, S::ZERO]);
    }
    let cp = sub(p, c);
    let (d5, d6) = (dot(ab, cp), dot(ac, cp));
    if d6 >= S::ZERO && d5 <= d6 {
        return on([S::ZERO, S::ZERO, S::ONE]);
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= S::ZERO && d2 >= S::ZERO && d6 <= S::ZERO {
        let w = d2 / (d2 - d6);
        return on([S::ONE - w, S::ZERO, w]);
    }
    let va = d3 * d6 - d5 * d4;
    if va <= S::ZERO && d4 - d3 >= S::ZERO && d5 - d6 >= S::ZERO {
        let w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return on([S::ZERO, S::ONE - w, w]);
    }
    let sum = va + vb + vc;
    let (v, w) = (vb / sum, vc / sum);
    Nearest { is_within: true, ..on([S::ONE - v - w, v, w]) }
}

/// Where a point is beside a triangle, on the side that it belongs to.
#[derive(Clone, Copy, Debug)]
pub(super) struct Beside<S> {
    pub(super) shares: [S; 3],
    /// From the triangle to the point.
    pub(super) normal: Vec3<S>,
    /// Below 0 where it went through `[m]`.
    pub(super) gap: S,
}

/// Where p is beside the triangle a, b, c; `None`: beyond a side and on the wrong side of its plane, or it has no area.
#[inline(always)]
pub(super) fn beside<S: Real>(places: [Vec3<S>; 4], side: S) -> Option<Beside<S>> {
    let [p, a, b, c] = places;
    let normal = cross3(sub(b, a), sub(c, a));
    let square = dot(normal, normal);
    if square == S::ZERO {
        return None;
    }
    let across = side * dot(normal, sub(p, a));
    let found = nearest(places);
    if found.is_within {
        let length = square.sqrt();
        return Some(Beside { shares: found.shares, normal: scale(normal, side / length), gap: across / length });
    }
    if across < S::ZERO {
        return None;
    }
    let gap = dot(found.from, found.from).sqrt();
    (gap > S::ZERO).then(|| Beside { shares: found.shares, normal: scale(found.from, S::ONE / gap), gap })
}

/// Six times the volume of p above the triangle a, b, c: its sign says on which side p is.
#[inline(always)]
pub(super) fn volume<S: Real>([p, a, b, c]: [Vec3<S>; 4]) -> S {
    dot(cross3(sub(b, a), sub(c, a)), sub(p, a))
}

/// How p goes through the plane of a triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Passage {
    /// It stays on its side.
    None,
    /// Through the triangle.
    Through,
    /// Beside it.
    Around,
}

/// How far beyond a side a passage counts as one through the triangle: shares of its size.
const SLACK: f64 = 1e-3;
/// Halvings with which the time of a passage is found.
const HALVINGS: u32 = 40;

/// How p goes through the plane of a triangle on straight ways from `start` to `end`.
///
/// The volume of the four is a cubic of the time: its stretches between extrema are looked at one by one.
pub(super) fn passage<S: Real>(start: [Vec3<S>; 4], end: [Vec3<S>; 4]) -> Passage {
    let wide = |x: [Vec3<S>; 4]| x.map(|x| x.map(S::to_f64));
    let (start, end) = (wide(start), wide(end));
    let at = |t: f64| -> [Vec3<f64>; 4] { std::array::from_fn(|k| add(start[k], scale(sub(end[k], start[k]), t))) };
    let value = |t: f64| volume(at(t));
    // Through four places.
    let [f0, f1, f2, f3] = [0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0].map(value);
    let c1 = -5.5 * f0 + 9.0 * f1 - 4.5 * f2 + f3;
    let c2 = 9.0 * f0 - 22.5 * f1 + 18.0 * f2 - 4.5 * f3;
    let c3 = -4.5 * f0 + 13.5 * f1 - 13.5 * f2 + 4.5 * f3;
    let mut times = [0.0, 1.0, 1.0, 1.0];
    let root = (c2 * c2 - 3.0 * c3 * c1).max(0.0).sqrt();
    let half = if c2 < 0.0 { -c2 + root } else { -c2 - root };
    let mut extrema = [if c3 == 0.0 { 2.0 } else { half / (3.0 * c3) }, if half == 0.0 { 2.0 } else { c1 / half }];
    extrema.sort_by(f64::total_cmp);
    let within = extrema.into_iter().filter(|t| *t > 0.0 && *t < 1.0);
    within.enumerate().for_each(|(k, t)| times[k + 1] = t);
    let mut found = Passage::None;
    for stretch in times.windows(2) {
        let [mut low, mut high] = [stretch[0], stretch[1]];
        let sign = value(low);
        if (sign >= 0.0) == (value(high) >= 0.0) {
            continue;
        }
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            *(if (value(middle) >= 0.0) == (sign >= 0.0) { &mut low } else { &mut high }) = middle;
        }
        if is_over(at(high)) {
            return Passage::Through;
        }
        found = Passage::Around;
    }
    found
}

/// Whether p lies over the inside of the triangle, or all but.
fn is_over(places: [Vec3<f64>; 4]) -> bool {
    let found = nearest(places);
    let [_, a, b, c] = places;
    let size = dot(sub(b, a), sub(b, a)).max(dot(sub(c, a), sub(c, a)));
    let normal = cross3(sub(b, a), sub(c, a));
    let square = dot(normal, normal);
    let off = dot(found.from, found.from) - if square > 0.0 { dot(normal, found.from).powi(2) / square } else { 0.0 };
    found.is_within || off <= SLACK * SLACK * size
}

/// The places of two segments, from their first ends on, at which their lines are nearest; `None` where those are beyond an end, or the
/// lines all but parallel.
#[inline(always)]
pub(super) fn lines<S: Real>([a, b]: [Vec3<S>; 2], [c, d]: [Vec3<S>; 2]) -> Option<[S; 2]> {
    let (u, v, r) = (sub(b, a), sub(d, c), sub(a, c));
    let (uu, uv, vv) = (dot(u, u), dot(u, v), dot(v, v));
    let (ur, vr) = (dot(u, r), dot(v, r));
    let determinant = uu * vv - uv * uv;
    if determinant <= S::from_f64(1e-6) * uu * vv {
        return None;
    }
    let s = (uv * vr - vv * ur) / determinant;
    let t = (uu * vr - uv * ur) / determinant;
    let is_within = |x: S| x > S::ZERO && x < S::ONE;
    (is_within(s) && is_within(t)).then_some([s, t])
}

#[cfg(test)]
mod tests {
    use super::*;

    const FLAT: [Vec3<f64>; 3] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];

    fn with(p: Vec3<f64>) -> [Vec3<f64>; 4] {
        [p, FLAT[0], FLAT[1], FLAT[2]]
    }

    #[test]
    fn the_nearest_place_is_the_best_of_many() {
        for p in
            [[0.2, 0.3, 0.1], [2.0, 0.1, 0.3], [-1.0, 0.5, -1.0], [0.4, -0.2, -3.0], [0.9, 0.7, 0.9], [-2.0, 0.0, 0.5]]
        {
            let found = nearest(with(p));
            let far = dot(found.from, found.from).sqrt();
            let mut least = f64::INFINITY;
            for i in 0..=200 {
                for j in 0..=200 - i {
                    let [x, z] = [i, j].map(|k| f64::from(k) / 200.0);
                    least = least.min(dot(sub(p, [x, 0.0, z]), sub(p, [x, 0.0, z])).sqrt());
                }
            }
            assert!(far <= least + 1e-12 && far > least - 5e-3, "{p:?}: {far} for {least}");
            assert!((found.shares.iter().sum::<f64>() - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn ways_lead_through_a_triangle_around_it_or_stay() {
        let way = |from, to| passage(with(from), with(to));
        assert_eq!(way([0.2, 1.0, 0.2], [0.2, -1.0, 0.2]), Passage::Through);
        assert_eq!(way([0.2, 1.0, 0.2], [0.2, 0.5, 0.2]), Passage::None);
        assert_eq!(way([2.0, 1.0, 2.0], [2.0, -1.0, 2.0]), Passage::Around);
        // It comes back: the ends are on one side. The triangle swings through p.
        let swung = [[0.2, 0.0, 0.2], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 1.0]];
        let down = swung.map(|x: Vec3<f64>| [x[0], -x[1], x[2]]);
        assert_eq!(passage(swung, down), Passage::Through);
    }

    #[test]
    fn a_point_that_went_through_has_a_gap_below_0_on_its_side_alone() {
        let above = beside(with([0.2, 0.1, 0.2]), -1.0).map(|found| (found.gap, found.normal));
        let through = beside(with([0.2, -0.1, 0.2]), -1.0).map(|found| (found.gap, found.normal));
        // The normal of the three points down: its left is side -1.
        assert_eq!((above, through), (Some((0.1, [0.0, 1.0, 0.0])), Some((-0.1, [0.0, 1.0, 0.0]))));
        assert!(beside(with([2.0, -0.1, 2.0]), -1.0).is_none());
        assert!(beside(with([2.0, 0.1, 2.0]), -1.0).is_some_and(|found| found.gap > 1.0));
    }

    #[test]
    fn lines_that_cross_within_both_are_told() {
        let [s, t] = lines([[0.0, 1.0, 0.0], [4.0, 1.0, 0.0]], [[1.0, 0.0, -1.0], [1.0, 0.0, 3.0]]).unwrap_or([9.0; 2]);
        assert!((s - 0.25_f64).abs() < 1e-12 && (t - 0.25).abs() < 1e-12);
        assert!(lines([[0.0; 3], [1.0, 0.0, 0.0]], [[2.0, 1.0, -1.0], [2.0, 1.0, 1.0]]).is_none(), "beyond an end");
        assert!(lines([[0.0; 3], [1.0, 0.0, 0.0]], [[0.0, 1.0, 0.0], [1.0, 1.0, 0.0]]).is_none(), "parallel");
    }
}
