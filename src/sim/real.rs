//! The scalar that a world is made of: `f32` or `f64`.

use std::fmt::{Debug, Display};
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use fearless_simd::SimdFloatElement;

/// A real number with the exactly rounded operations that the kernels need.
///
/// Only operations that IEEE 754 rounds correctly are here (+, -, *, /, square root, comparison), so that a run
/// yields the same bits on every machine. No fused multiply-add: `a * b + c` is two roundings everywhere.
pub trait Real:
    Copy
    + Debug
    + Display
    + Default
    + PartialEq
    + PartialOrd
    + Send
    + Sync
    + bytemuck::Pod
    + SimdFloatElement
    + Neg<Output = Self>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
    + DivAssign
    + 'static
{
    /// 0.
    const ZERO: Self;
    /// 1.
    const ONE: Self;
    /// 1/2.
    const HALF: Self;
    /// Positive infinity.
    const INFINITY: Self;
    /// Distance from 1 to the next larger number.
    const EPSILON: Self;
    /// The name of this scalar in a method.
    const PRECISION: Precision;

    /// The nearest number of this type.
    fn from_f64(value: f64) -> Self;
    /// The same number, exactly.
    fn to_f64(self) -> f64;
    /// Square root, correctly rounded.
    fn sqrt(self) -> Self;
    /// Absolute value.
    fn abs(self) -> Self;
    /// The smaller of two numbers.
    fn min(self, other: Self) -> Self;
    /// The larger of two numbers.
    fn max(self, other: Self) -> Self;
    /// Neither infinite nor NaN.
    fn is_finite(self) -> bool;
    /// Positions of this scalar, for those who take either.
    fn flat(positions: &[Self]) -> Positions<'_>;
}

macro_rules! real {
    ($scalar:ty, $precision:ident) => {
        impl Real for $scalar {
            const ZERO: Self = 0.0;
            const ONE: Self = 1.0;
            const HALF: Self = 0.5;
            const INFINITY: Self = <$scalar>::INFINITY;
            const EPSILON: Self = <$scalar>::EPSILON;
            const PRECISION: Precision = Precision::$precision;

            #[inline(always)]
            fn from_f64(value: f64) -> Self {
                value as $scalar
            }
            #[inline(always)]
            fn to_f64(self) -> f64 {
                f64::from(self)
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                self.sqrt()
            }
            #[inline(always)]
            fn abs(self) -> Self {
                self.abs()
            }
            #[inline(always)]
            fn min(self, other: Self) -> Self {
                if other < self { other } else { self }
            }
            #[inline(always)]
            fn max(self, other: Self) -> Self {
                if other > self { other } else { self }
            }
            #[inline(always)]
            fn is_finite(self) -> bool {
                self.is_finite()
            }
            fn flat(positions: &[Self]) -> Positions<'_> {
                Positions::$precision(positions)
            }
        }
    };
}

real!(f32, F32);
real!(f64, F64);

/// The scalar of a world.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Precision {
    /// `f64` for small scenes, `f32` for large ones.
    #[default]
    Auto,
    /// 32 bits, compensated.
    F32,
    /// 64 bits.
    F64,
}

/// Positions of all points as they lie in memory: D numbers a point, one point after another `[m]`.
#[derive(Clone, Copy, Debug)]
pub enum Positions<'a> {
    /// Of an `f32` world.
    F32(&'a [f32]),
    /// Of an `f64` world.
    F64(&'a [f64]),
}

impl Positions<'_> {
    /// How many numbers there are: D for every point.
    pub fn len(&self) -> usize {
        match self {
            Positions::F32(x) => x.len(),
            Positions::F64(x) => x.len(),
        }
    }

    /// Whether there is no point.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Component `index` of the flat list.
    pub fn get(&self, index: usize) -> f64 {
        match self {
            Positions::F32(x) => f64::from(x[index]),
            Positions::F64(x) => x[index],
        }
    }
}
