//! Vectors of a world: `[S; D]` with D = 2 or 3, and the few operations on them that the kernels use.
//!
//! They are loops and not `std::array::from_fn` or `map`, which are not always inlined and then cost more than the sum itself.

use super::real::Real;

/// The zero vector.
#[inline(always)]
pub fn zero<S: Real, const D: usize>() -> [S; D] {
    [S::ZERO; D]
}

/// a + b.
#[inline(always)]
pub fn add<S: Real, const D: usize>(mut a: [S; D], b: [S; D]) -> [S; D] {
    for k in 0..D {
        a[k] += b[k];
    }
    a
}

/// a - b.
#[inline(always)]
pub fn sub<S: Real, const D: usize>(mut a: [S; D], b: [S; D]) -> [S; D] {
    for k in 0..D {
        a[k] -= b[k];
    }
    a
}

/// a times the scalar s.
#[inline(always)]
pub fn scale<S: Real, const D: usize>(mut a: [S; D], s: S) -> [S; D] {
    for k in 0..D {
        a[k] *= s;
    }
    a
}

/// Scalar product, summed from the first axis to the last.
#[inline(always)]
pub fn dot<S: Real, const D: usize>(a: [S; D], b: [S; D]) -> S {
    let mut sum = a[0] * b[0];
    for k in 1..D {
        sum += a[k] * b[k];
    }
    sum
}

/// Euclidean length.
#[inline(always)]
pub fn length<S: Real, const D: usize>(a: [S; D]) -> S {
    dot(a, a).sqrt()
}

/// The part of the vector product across the plane: above 0 where `b` is anticlockwise of `a`.
#[inline(always)]
pub fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// The vector product.
#[inline(always)]
pub fn cross3<S: Real>(a: [S; 3], b: [S; 3]) -> [S; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The vector in another scalar, each component rounded to nearest.
#[inline(always)]
pub fn convert<S: Real, const D: usize>(a: [f64; D]) -> [S; D] {
    let mut converted = [S::ZERO; D];
    for k in 0..D {
        converted[k] = S::from_f64(a[k]);
    }
    converted
}

/// The vector in `f64`, exactly.
#[inline(always)]
pub fn widen<S: Real, const D: usize>(a: [S; D]) -> [f64; D] {
    let mut wide = [0.0; D];
    for k in 0..D {
        wide[k] = a[k].to_f64();
    }
    wide
}

/// The components in the plane, in `f64`, exactly.
#[inline(always)]
pub fn flat<S: Real, const D: usize>(a: [S; D]) -> [f64; 2] {
    [a[0].to_f64(), a[1].to_f64()]
}

/// The first D components of a vector in space: a plane drops z.
#[inline(always)]
pub fn truncate<const D: usize>(a: [f64; 3]) -> [f64; D] {
    resized(a)
}

/// The vector in space with the missing components zero.
#[inline(always)]
pub fn embed<const D: usize>(a: [f64; D]) -> [f64; 3] {
    resized(a)
}

/// The vector in so many dimensions: what it has more is dropped, what it lacks is zero.
#[inline(always)]
pub(crate) fn resized<const D: usize, const N: usize>(a: [f64; D]) -> [f64; N] {
    let (mut resized, shared) = ([0.0; N], N.min(D));
    resized[..shared].copy_from_slice(&a[..shared]);
    resized
}

/// From which share of a way on to which one it lies in a box along the axes, of all shares from 0 to `most`; `None`: nowhere.
///
/// Shapes: where the way begins and how it leads on from there; the lower and the upper corner of the box, in the same unit.
/// Valid range: the faces of a box are not in it, so a way along a face, or to one, is not; one of no length lies in it from 0 to
/// `most`, or nowhere. `most` may be infinite.
#[inline(always)]
pub(crate) fn span_in_box<const D: usize>(
    [from, way]: [[f64; D]; 2],
    [low, high]: [[f64; D]; 2],
    most: f64,
) -> Option<[f64; 2]> {
    let [mut enters, mut leaves] = [0.0, most];
    for k in 0..D {
        if way[k] == 0.0 {
            if from[k] <= low[k] || from[k] >= high[k] {
                return None;
            }
            continue;
        }
        let ends = [(low[k] - from[k]) / way[k], (high[k] - from[k]) / way[k]];
        enters = f64::max(enters, ends[0].min(ends[1]));
        leaves = f64::min(leaves, ends[0].max(ends[1]));
    }
    (enters < leaves).then_some([enters, leaves])
}

/// sum += increment, with what rounding took from earlier sums paid back first (Kahan).
///
/// Source: W. Kahan, Comm. ACM 8, 40 (1965).
#[inline(always)]
pub(crate) fn accumulate<S: Real, const D: usize>(sum: &mut [S; D], lost: &mut [S; D], increment: [S; D]) {
    for k in 0..D {
        let owed = increment[k] + lost[k];
        let next = sum[k] + owed;
        lost[k] = owed - (next - sum[k]);
        sum[k] = next;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_way_is_in_a_box_from_where_it_enters_to_where_it_leaves() {
        let corners = [[1.0, 1.0], [2.0, 3.0]];
        for (way, span) in [
            ([[0.0, 2.0], [4.0, 0.0]], Some([0.25, 0.5])),
            ([[4.0, 2.0], [-4.0, 0.0]], Some([0.5, 0.75])),
            ([[1.5, 2.0], [8.0, 8.0]], Some([0.0, 0.0625])),
            ([[1.5, 2.0], [0.125, 0.0]], Some([0.0, 1.0])),
            ([[1.5, 2.0], [0.0, 0.0]], Some([0.0, 1.0])),
            ([[0.0, 2.0], [0.0, 0.0]], None),
            ([[0.0, 2.0], [0.5, 0.0]], None),
            ([[0.0, 2.0], [1.0, 0.0]], None),
            ([[0.0, 2.0], [2.0, 2.0]], None),
            ([[1.0, 0.0], [0.0, 4.0]], None),
            ([[2.0, 0.0], [0.0, 4.0]], None),
        ] {
            assert_eq!(span_in_box(way, corners, 1.0), span, "{way:?}");
        }
        assert_eq!(span_in_box([[0.0, 2.0], [0.5, 0.0]], corners, f64::INFINITY), Some([2.0, 4.0]), "a ray");
        assert_eq!(span_in_box([[0.0; 3], [1.0; 3]], [[0.25, 0.0, 0.0], [2.0, 0.5, 1.0]], 1.0), Some([0.25, 0.5]));
    }

    #[test]
    fn a_million_small_increments_add_up() {
        let (mut sum, mut lost) = ([100.0_f32], [0.0]);
        for _ in 0..1_000_000 {
            accumulate(&mut sum, &mut lost, [1e-6]);
        }
        assert!((sum[0] - 101.0).abs() < 1e-5, "{}", sum[0]);
    }
}
