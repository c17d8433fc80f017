//! Points side by side, one a lane of a vector.

use fearless_simd::{Select, Simd, SimdBase, SimdFloatElement, SimdMask};

use crate::sim::real::Real;

/// A vector of as many numbers as the instruction set takes at once.
pub(crate) type Lanes<M, S> = <S as SimdFloatElement>::Native<M>;

/// Which lanes something is true for.
pub(crate) type Mask<M, S> = <Lanes<M, S> as SimdBase<M>>::Mask;

/// Numbers of the widest vector of any instruction set, for either scalar: lists are padded to multiples of it.
pub(crate) const WIDEST: usize = 16;

/// How many numbers a vector holds.
#[inline(always)]
pub(crate) fn width<M: Simd, S: Real>(_: M) -> usize {
    Lanes::<M, S>::LEN
}

/// The same number in every lane.
#[inline(always)]
pub(crate) fn splat<M: Simd, S: Real>(m: M, value: S) -> Lanes<M, S> {
    Lanes::<M, S>::splat(m, value)
}

/// The numbers from `at` on.
#[inline(always)]
pub(crate) fn load<M: Simd, S: Real>(m: M, list: &[S], at: usize) -> Lanes<M, S> {
    Lanes::<M, S>::from_slice(m, &list[at..at + Lanes::<M, S>::LEN])
}

/// Writes the numbers from `at` on.
#[inline(always)]
pub(crate) fn store<M: Simd, S: Real>(value: Lanes<M, S>, list: &mut [S], at: usize) {
    value.store_slice(&mut list[at..at + Lanes::<M, S>::LEN]);
}

/// The lanes of a range [from, to), which may begin before the first and end after the last.
#[inline(always)]
pub(crate) fn between<M: Simd, S: Real>(m: M, from: isize, to: isize) -> Mask<M, S> {
    let width = Lanes::<M, S>::LEN as isize;
    let (from, to) = (from.clamp(0, width), to.clamp(0, width));
    let below = |count: isize| (1_u64 << count) - 1;
    Mask::<M, S>::from_bitmask(m, if from < to { below(to) & !below(from) } else { 0 })
}

/// Components of vectors, one point a lane.
pub(crate) type Vectors<M, S, const D: usize> = [Lanes<M, S>; D];

/// One vector for each axis.
///
/// `std::array::from_fn` would do, but is not always inlined, and what it calls is then compiled without the
/// instruction set.
#[inline(always)]
pub(crate) fn each<M: Simd, S: Real, const D: usize>(
    m: M,
    mut of: impl FnMut(usize) -> Lanes<M, S>,
) -> Vectors<M, S, D> {
    let mut list = [splat(m, S::ZERO); D];
    for k in 0..D {
        list[k] = of(k);
    }
    list
}

/// a + b, lane by lane.
#[inline(always)]
pub(crate) fn add<M: Simd, S: Real, const D: usize>(mut a: Vectors<M, S, D>, b: Vectors<M, S, D>) -> Vectors<M, S, D> {
    for k in 0..D {
        a[k] += b[k];
    }
    a
}

/// a - b, lane by lane.
#[inline(always)]
pub(crate) fn sub<M: Simd, S: Real, const D: usize>(mut a: Vectors<M, S, D>, b: Vectors<M, S, D>) -> Vectors<M, S, D> {
    for k in 0..D {
        a[k] -= b[k];
    }
    a
}

/// a times the number s of the same lane.
#[inline(always)]
pub(crate) fn scale<M: Simd, S: Real, const D: usize>(mut a: Vectors<M, S, D>, s: Lanes<M, S>) -> Vectors<M, S, D> {
    for k in 0..D {
        a[k] *= s;
    }
    a
}

/// Scalar products, summed from the first axis to the last.
#[inline(always)]
pub(crate) fn dot<M: Simd, S: Real, const D: usize>(a: Vectors<M, S, D>, b: Vectors<M, S, D>) -> Lanes<M, S> {
    let mut sum = a[0] * b[0];
    for k in 1..D {
        sum += a[k] * b[k];
    }
    sum
}

/// `new` where the mask says so, else `old`.
#[inline(always)]
pub(crate) fn select<M: Simd, S: Real, const D: usize>(
    mask: Mask<M, S>,
    mut new: Vectors<M, S, D>,
    old: Vectors<M, S, D>,
) -> Vectors<M, S, D> {
    for k in 0..D {
        new[k] = mask.select(new[k], old[k]);
    }
    new
}

/// The largest number of a vector of numbers that are not negative; NaN counts as infinite.
#[inline(always)]
pub(crate) fn largest<M: Simd, S: Real>(vector: Lanes<M, S>) -> S {
    let mut most = S::ZERO;
    for &value in vector.as_slice() {
        most = if value <= most {
            most
        } else if Real::is_finite(value) {
            value
        } else {
            S::INFINITY
        };
    }
    most
}
