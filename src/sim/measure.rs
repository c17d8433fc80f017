//! What can be measured of a state: extent, energy, strain, momentum.

use super::bond::{Bond, BondKind};
use super::bonds::Bonds;
use super::drive::Keys;
use super::ledger::Energies;
use super::points::Points;
use super::real::Real;
use super::vector::{dot, length, sub};

/// Whether a place and a velocity are finite, their squares included: nothing can be worked out of what is so large.
#[inline(always)]
pub(crate) fn is_among_numbers<S: Real, const D: usize>(x: [S; D], v: [S; D]) -> bool {
    (dot(x, x) + dot(v, v)).is_finite()
}

/// The box around all positions: its lower and upper corner; `None` where there is no point.
pub(crate) fn extent<S: Real, const D: usize>(position: &[[S; D]]) -> Option<[[S; D]; 2]> {
    // So many numbers at once, of which a vector takes several: as often each axis.
    const AT_ONCE: usize = 24;
    let first = *position.first()?;
    let mut low: [S; AT_ONCE] = std::array::from_fn(|k| first[k % D]);
    let mut high = low;
    let mut hold = |numbers: &[S]| {
        for ((low, high), &x) in low.iter_mut().zip(&mut high).zip(numbers) {
            *low = if x < *low { x } else { *low };
            *high = if x > *high { x } else { *high };
        }
    };
    let (rows, rest) = position.as_flattened().as_chunks::<AT_ONCE>();
    rows.iter().for_each(|row| hold(row));
    hold(rest);
    let of = |list: &[S], pick: fn(S, S) -> S, k: usize| list[k..].iter().step_by(D).copied().fold(first[k], pick);
    let least = |a: S, b: S| if b < a { b } else { a };
    let most = |a: S, b: S| if b > a { b } else { a };
    Some([std::array::from_fn(|k| of(&low, least, k)), std::array::from_fn(|k| of(&high, most, k))])
}

/// A bound on the speed of all points `[m/s]`: the fastest is no slower than a share of sqrt(1/D) of it.
pub(crate) fn speed_bound<S: Real, const D: usize>(velocity: &[[S; D]]) -> S {
    let Some([low, high]) = extent(velocity) else { return S::ZERO };
    let most = (0..D).fold([S::ZERO; D], |mut most, k| {
        most[k] = high[k].max(-low[k]);
        most
    });
    length(most)
}

/// Kinetic, springs' and gravity's energy of the points that are not pinned `[J]`; gravity's is 0 at the origin.
///
/// Shapes: `w` has one entry a point, w = 0 is pinned; `position` and `velocity` say the state of each.
pub(crate) fn energies<const D: usize>(
    position: impl Fn(usize) -> [f64; D] + Copy,
    velocity: impl Fn(usize) -> [f64; D],
    w: &[f64],
    bonds: &Bonds,
    gravity: [f64; D],
) -> Energies {
    let mut energies = Energies { springs: springs_energy(bonds, position), ..Energies::default() };
    for (i, &w) in w.iter().enumerate() {
        if w > 0.0 {
            let (x, v) = (position(i), velocity(i));
            energies.kinetic += 0.5 * dot(v, v) / w;
            energies.gravity -= dot(gravity, x) / w;
        }
    }
    energies
}

/// Energy of every spring `[J]`.
pub(crate) fn springs_energy<const D: usize>(bonds: &Bonds, position: impl Fn(usize) -> [f64; D]) -> f64 {
    if bonds.may_have_springs() { bonds.iter().map(|bond| spring_energy(&bond, &position)).sum() } else { 0.0 }
}

/// Energy of a bond `[J]`: stiffness (|d| - rest)^2 / 2 where it is a spring and acts.
pub(crate) fn spring_energy<const D: usize>(bond: &Bond, position: impl Fn(usize) -> [f64; D]) -> f64 {
    let BondKind::Spring { stiffness, .. } = bond.kind else { return 0.0 };
    let d = sub(position(bond.a.index()), position(bond.b.index()));
    let stretch = dot(d, d).sqrt() - bond.rest_length;
    if bond.limit.acts(stretch, 0.0) { 0.5 * stiffness * stretch * stretch } else { 0.0 }
}

/// Largest |length/rest - 1| over the bonds that act `[1]`: slack strings and struts that are parted have no strain, nor have welds.
///
/// Lengths at rest are those of time `t` `[s]`.
pub(crate) fn max_strain<const D: usize>(
    position: impl Fn(usize) -> [f64; D],
    bonds: &Bonds,
    (t, keys): (f64, &Keys),
) -> f64 {
    let of = |bond: Bond| {
        let d = sub(position(bond.a.index()), position(bond.b.index()));
        let rest =
            bond.rest_length * bond.drive.map_or(1.0, |drive| 1.0 + drive.amplitude * drive.signal.level(t, keys));
        bond.strain(length(d), rest).abs()
    };
    bonds.iter().map(of).fold(0.0, f64::max)
}

/// Whether no point is faster than `speed` `[m/s]`. Stops at the first that is.
pub(crate) fn is_slower<S: Real, const D: usize>(points: &Points<S, D>, speed: f64) -> bool {
    let square = S::from_f64(speed * speed);
    points.velocity.iter().all(|&v| dot(v, v) <= square)
}
