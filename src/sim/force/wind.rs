//! Moving air: drag is relative to it.
//!
//! ```text
//! a = -drag_rate (v - u(x, t)),   u = U + u',   u' = sum over j of a_j e_j cos(k_j . x - w_j t + p_j)
//! ```
//!
//! U is the mean velocity. The gusts u' are eight waves across their own direction, e_j . k_j = 0, so that air neither gathers nor thins
//! out anywhere. Wavelengths go from `LONGEST` down by a factor of sqrt(2); a_j grows with the cube root of the wavelength,
//! which gives each octave the share that Kolmogorov's spectrum has, and the mean square of u' is (turbulence |U|)^2. Waves are carried
//! by the mean wind, and each goes along itself at the speed of the gusts, one way or the other: w_j = k_j . U +- |k_j| turbulence |U|.
//! Directions, ways and phases come from the seed. The field is smooth and depends on place and time alone, not on substeps.
//! Sources: R. H. Kraichnan, Phys. Fluids 13, 22 (1970), eq. (9) and (10), waves across their direction; G. I. Taylor, Proc. R. Soc.
//! A 164, 476 (1938), gusts that the mean wind carries.

use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

use crate::sim::vector::{add, dot, length, scale, truncate};

/// Wind and its gusts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wind<const D: usize> {
    /// Mean velocity `[m/s]`.
    pub velocity: [f64; D],
    /// Root mean square of the gusts, as a share of the mean speed `[1]`, >= 0.
    pub turbulence: f64,
    /// Seed of the gusts.
    pub seed: u64,
}

/// How many waves gusts are made of.
const WAVES: usize = 8;
/// Counted work of the gusts at a place.
pub(crate) const OF_A_GUST: u64 = 300;
/// The longest wave `[m]`.
const LONGEST: f64 = 8.0;

/// Air that moves, ready to be asked.
#[derive(Clone, Debug)]
pub(crate) struct Air<const D: usize> {
    /// `[m/s]`
    pub(crate) mean: [f64; D],
    gusts: Option<Gusts<D>>,
}

/// Waves: turns for each metre and second, and where they begin `[turns]`; how they swing `[m/s]`.
#[derive(Clone, Debug)]
struct Gusts<const D: usize> {
    along: [[f64; WAVES]; D],
    pace: [f64; WAVES],
    phase: [f64; WAVES],
    swing: [[f64; WAVES]; D],
    /// A bound on their sum `[m/s]`.
    most: f64,
    /// How fast a point in the wind sees them change at the most `[rad/s]`.
    rate: f64,
}

impl<const D: usize> Air<D> {
    pub(crate) fn new(wind: &Wind<D>) -> Self {
        let speed = length(wind.velocity);
        let gusts = (speed > 0.0 && wind.turbulence > 0.0).then(|| Gusts::new(wind, speed));
        Air { mean: wind.velocity, gusts }
    }

    /// Whether it has gusts.
    pub(crate) fn has_gusts(&self) -> bool {
        self.gusts.is_some()
    }

    /// What gusts add to the mean at a place `[m]` and a time `[s]`.
    #[inline]
    pub(crate) fn gust(&self, x: [f64; D], t: f64) -> [f64; D] {
        self.gusts.as_ref().map_or([0.0; D], |gusts| gusts.at(x, t))
    }

    /// The velocity of the air at a place `[m]` and a time `[s]`.
    pub(crate) fn at(&self, x: [f64; D], t: f64) -> [f64; D] {
        add(self.mean, self.gust(x, t))
    }

    /// The fastest that gusts are `[m/s]`, and how fast they change where a point is at the most `[rad/s]`; 0 without.
    pub(crate) fn bounds(&self) -> [f64; 2] {
        self.gusts.as_ref().map_or([0.0; 2], |gusts| [gusts.most, gusts.rate])
    }
}

impl<const D: usize> Gusts<D> {
    fn new(wind: &Wind<D>, speed: f64) -> Self {
        let mut random = Pcg64::seed_from_u64(wind.seed);
        const STEP: f64 = 1.0 / (1_u64 << 53) as f64;
        let mut draw = || (random.next_u64() >> 11) as f64 * STEP;
        let lengths: [f64; WAVES] = std::array::from_fn(|j| LONGEST * libm::exp2(-0.5 * j as f64));
        let sizes = lengths.map(libm::cbrt);
        let norm = wind.turbulence * speed / (0.5 * sizes.iter().map(|size| size * size).sum::<f64>()).sqrt();
        let mut gusts = Gusts {
            along: [[0.0; WAVES]; D],
            pace: [0.0; WAVES],
            phase: [0.0; WAVES],
            swing: [[0.0; WAVES]; D],
            most: norm * sizes.iter().sum::<f64>(),
            rate: std::f64::consts::TAU / lengths[WAVES - 1] * speed * (1.0 + 2.0 * wind.turbulence),
        };
        for j in 0..WAVES {
            // One direction in each eighth, waves of like length far apart.
            let share = ((3 * j % WAVES) as f64 + draw()) / WAVES as f64;
            let [along, across] = directions::<D>(share, [draw(), draw()]);
            let own = if draw() < 0.5 { -1.0 } else { 1.0 } * wind.turbulence * speed;
            for k in 0..D {
                gusts.along[k][j] = along[k] / lengths[j];
                gusts.swing[k][j] = norm * sizes[j] * across[k];
            }
            gusts.pace[j] = (dot(along, wind.velocity) + own) / lengths[j];
            gusts.phase[j] = draw();
        }
        gusts
    }

    #[inline]
    fn at(&self, x: [f64; D], t: f64) -> [f64; D] {
        let mut turns = self.phase;
        for j in 0..WAVES {
            turns[j] -= self.pace[j] * t;
        }
        for k in 0..D {
            for j in 0..WAVES {
                turns[j] += self.along[k][j] * x[k];
            }
        }
        let waves = turns.map(cosine);
        std::array::from_fn(|k| {
            // Pairs, in a fixed order, side by side.
            let parts: [f64; WAVES] = std::array::from_fn(|j| self.swing[k][j] * waves[j]);
            ((parts[0] + parts[4]) + (parts[2] + parts[6])) + ((parts[1] + parts[5]) + (parts[3] + parts[7]))
        })
    }
}

/// A direction of the half plane (in space: of all) that a share in [0, 1) says, and one across it.
fn directions<const D: usize>(share: f64, [turn, tilt]: [f64; 2]) -> [[f64; D]; 2] {
    if D == 2 {
        let (sin, cos) = libm::sincos(std::f64::consts::PI * share);
        return [[cos, sin, 0.0], [-sin, cos, 0.0]].map(truncate);
    }
    let height = 2.0 * share - 1.0;
    let flat = (1.0 - height * height).max(0.0).sqrt();
    let (sin, cos) = libm::sincos(std::f64::consts::TAU * turn);
    let (lean, upright) = libm::sincos(std::f64::consts::TAU * tilt);
    let (beside, above) = ([-sin, cos, 0.0], [-height * cos, -height * sin, flat]);
    [[flat * cos, flat * sin, height], add(scale(beside, upright), scale(above, lean))].map(truncate)
}

/// cos(2 pi x) of x turns, to rounding: by + and * alone, and without a branch, so that several go side by side.
#[inline(always)]
fn cosine(turns: f64) -> f64 {
    /// 1.5 2^52: what is added to it keeps no fraction.
    const WHOLE: f64 = 6_755_399_441_055_744.0;
    /// Turns beyond which a number has no fraction.
    const FAR: f64 = 1_125_899_906_842_624.0;
    /// 1/n! of n = 21, 19, … 1, signs in turn.
    const SERIES: [f64; 11] = [
        1.0 / 51_090_942_171_709_440_000.0,
        -1.0 / 121_645_100_408_832_000.0,
        1.0 / 355_687_428_096_000.0,
        -1.0 / 1_307_674_368_000.0,
        1.0 / 6_227_020_800.0,
        -1.0 / 39_916_800.0,
        1.0 / 362_880.0,
        -1.0 / 5_040.0,
        1.0 / 120.0,
        -1.0 / 6.0,
        1.0,
    ];
    let part = if turns.abs() < FAR { turns - ((turns + WHOLE) - WHOLE) } else { 0.0 };
    // The sine of what is left to a quarter, in [-pi/2, pi/2].
    let z = std::f64::consts::TAU * (0.25 - part.abs());
    let square = z * z;
    let mut sum = SERIES[0];
    for term in &SERIES[1..] {
        sum = sum * square + term;
    }
    sum * z
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cosine_is_one() {
        for k in -4000..4000 {
            let turns = f64::from(k) * 0.000_731;
            let true_one = libm::cos(std::f64::consts::TAU * turns);
            assert!((cosine(turns) - true_one).abs() < 4e-15, "{turns}");
        }
        assert!([1e15, 1e16, -1e300, f64::INFINITY].into_iter().all(|far| cosine(far).abs() <= 1.0));
    }

    /// Mean square of the gusts over a wide field, the mean of each component, and the largest divergence.
    fn statistics<const D: usize>(turbulence: f64, seed: u64) -> (f64, f64) {
        let mut velocity = [0.0; D];
        (velocity[0], velocity[1]) = (3.0, 4.0);
        let air = Air::new(&Wind { velocity, turbulence, seed });
        let (mut square, mut divergence, mut count) = (0.0, 0.0_f64, 0.0);
        for i in 0..40_000 {
            let f = f64::from(i);
            let x: [f64; D] = std::array::from_fn(|k| 377.7 * libm::sin(f * [0.618, 0.414, 0.732][k]));
            let u = air.gust(x, 0.37 * f);
            square += dot(u, u);
            count += 1.0;
            let step = 1e-4;
            let slope = |k: usize| {
                let at = |by: f64| {
                    let mut y = x;
                    y[k] += by;
                    air.gust(y, 0.37 * f)[k]
                };
                (at(step) - at(-step)) / (2.0 * step)
            };
            if i % 100 == 0 {
                divergence = divergence.max((0..D).map(slope).sum::<f64>().abs());
            }
        }
        (square / count, divergence)
    }

    #[test]
    fn gusts_have_the_strength_that_was_asked_for_and_no_divergence() {
        for (square, divergence) in [statistics::<2>(0.4, 1), statistics::<2>(0.4, 99), statistics::<3>(0.4, 7)] {
            assert!((square.sqrt() / 2.0 - 1.0).abs() < 0.03, "rms {}", square.sqrt());
            assert!(divergence < 1e-5, "{divergence}");
        }
    }

    #[test]
    fn seeds_differ_and_still_air_has_no_gusts() {
        let at = |seed: u64| Air::new(&Wind { velocity: [5.0, 0.0], turbulence: 0.3, seed }).at([1.0, 2.0], 3.0);
        assert!(at(0) != at(1) && at(1) == at(1) && at(u64::MAX).iter().all(|u| u.is_finite()));
        let still = Air::new(&Wind { velocity: [0.0, 0.0], turbulence: 0.3, seed: 0 });
        assert!(!still.has_gusts() && still.at([1.0, 2.0], 3.0) == [0.0; 2]);
        let even = Air::new(&Wind { velocity: [5.0, 0.0], turbulence: 0.0, seed: 0 });
        assert!(!even.has_gusts() && even.at([1.0, 2.0], 3.0) == [5.0, 0.0]);
    }
}
