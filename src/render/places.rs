//! Positions as they lie on the GPU: those of an `f32` world as they are, those of an `f64` world relative to an origin.

use glam::DVec3;

use super::view::View;
use crate::sim::Positions;

/// Positions of an `f64` world as they were uploaded, of both states.
pub(super) type Staging = [Vec<f32>; 2];

/// Works out both states relative to an origin, where they are to be.
pub(super) fn stage(view: &View<'_>, origin: DVec3, staging: &mut Staging) {
    for (positions, staging) in [view.previous, view.current].into_iter().zip(staging) {
        if let Positions::F64(x) = positions {
            relative(x, origin, view.dimensions, staging);
        }
    }
}

/// The two states as they lie on the GPU.
pub(super) fn states<'a>(view: &View<'a>, staging: &'a Staging) -> [&'a [f32]; 2] {
    let flat = |positions: Positions<'a>, staging: &'a [f32]| match positions {
        Positions::F32(x) => x,
        Positions::F64(_) => staging,
    };
    [flat(view.previous, &staging[0]), flat(view.current, &staging[1])]
}

/// What lies between two states of the same points, 0 the first and 1 the second; worked out in `to` where it is not the second.
pub(super) fn mixed<'a>([before, now]: [&'a [f32]; 2], mix: f32, to: &'a mut Vec<f32>) -> &'a [f32] {
    if mix == 1.0 || before.len() != now.len() {
        return now;
    }
    to.clear();
    to.extend(before.iter().zip(now).map(|(before, now)| before * (1.0 - mix) + now * mix));
    to
}

/// Positions relative to an origin.
fn relative(x: &[f64], origin: DVec3, dimensions: usize, to: &mut Vec<f32>) {
    to.resize(x.len(), 0.0);
    let [a, b, c] = origin.to_array();
    if dimensions == 2 {
        subtract([a, b], x, to);
    } else {
        subtract([a, b, c], x, to);
    }
}

fn subtract<const D: usize>(origin: [f64; D], x: &[f64], to: &mut [f32]) {
    for (to, x) in to.as_chunks_mut::<D>().0.iter_mut().zip(x.as_chunks::<D>().0) {
        *to = std::array::from_fn(|axis| (x[axis] - origin[axis]) as f32);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_drawn_lies_between_both_states() {
        let states = [&[1.0, 2.0, f32::NAN][..], &[3.0, 2.0, f32::NAN][..]];
        let mut to = vec![9.0; 7];
        assert!(std::ptr::eq(mixed(states, 1.0, &mut to), states[1]), "as it is, without a copy");
        let between = mixed(states, 0.25, &mut to);
        assert!(between[..2] == [1.5, 2.0] && between[2].is_nan() && between.len() == 3, "{between:?}");
        assert_eq!(mixed(states, 0.0, &mut to)[..2], [1.0, 2.0]);
    }

    #[test]
    fn positions_are_relative_to_the_origin() {
        let mut to = vec![9.0; 7];
        relative(&[1.0, 2.0, 3.0, 1e9, 5.0, 6.0], DVec3::new(1.0, 1.0, 3.0), 3, &mut to);
        assert_eq!(to, [0.0, 1.0, 0.0, 999_999_999.0_f64 as f32, 4.0, 3.0]);
        relative(&[1.0, 2.0, 3.0, 4.0], DVec3::new(1.0, 1.0, 7.0), 2, &mut to);
        assert_eq!(to, [0.0, 1.0, 2.0, 3.0]);
    }
}
