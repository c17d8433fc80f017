//! Vectors of a world: `[S; D]` with D = 2 or 3, and the few operations on them that the kernels use.
//!
//! They are loops and not `std::array::from_fn`, which is not always inlined and then costs more than the sum itself.

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
    a.map(S::from_f64)
}

/// The vector in `f64`, exactly.
#[inline(always)]
pub fn widen<S: Real, const D: usize>(a: [S; D]) -> [f64; D] {
    a.map(S::to_f64)
}

/// The components in the plane, in `f64`, exactly.
#[inline(always)]
pub fn flat<S: Real, const D: usize>(a: [S; D]) -> [f64; 2] {
    [a[0].to_f64(), a[1].to_f64()]
}

/// The first D components of a vector in space: a plane drops z.
#[inline(always)]
pub fn truncate<const D: usize>(a: [f64; 3]) -> [f64; D] {
    std::array::from_fn(|k| a[k])
}

/// The vector in space with the missing components zero.
#[inline(always)]
pub fn embed<const D: usize>(a: [f64; D]) -> [f64; 3] {
    std::array::from_fn(|k| if k < D { a[k] } else { 0.0 })
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
    fn a_million_small_increments_add_up() {
        let (mut sum, mut lost) = ([100.0_f32], [0.0]);
        for _ in 0..1_000_000 {
            accumulate(&mut sum, &mut lost, [1e-6]);
        }
        assert!((sum[0] - 101.0).abs() < 1e-5, "{}", sum[0]);
    }
}
