//! Pins of a copy that were led where it was copied: each goes on along the rest of its track, moved along with the copy.

use crate::scene::PinMotionKeys;
use crate::sim::{Dynamics, PointId};

/// The ways that pins of a copy have still to go from where they are now, by their places in it; times are counted from now.
pub(super) fn ways(world: &dyn Dynamics, place: impl Fn(PointId) -> Option<u32>) -> Vec<PinMotionKeys> {
    let (now, dimensions) = (world.time(), world.dimensions());
    let row = |t: f64, x: [f64; 3]| std::iter::once(t).chain(x.into_iter().take(dimensions)).collect::<Vec<f64>>();
    let of = |(pin, knots): (PointId, Vec<(f64, [f64; 3])>)| {
        let point = place(pin)?;
        let here = std::array::from_fn(|axis| {
            if axis < dimensions { world.positions().get(dimensions * pin.index() + axis) } else { 0.0 }
        });
        let ahead: Vec<Vec<f64>> = knots.iter().filter(|(t, _)| *t > now).map(|&(t, x)| row(t - now, x)).collect();
        let has_begun = knots.first().is_some_and(|(t, _)| *t <= now);
        // Before its first knot a pin stands where that is.
        let first = (has_begun || ahead.is_empty()).then(|| row(0.0, here));
        (!ahead.is_empty()).then(|| PinMotionKeys { point, track: first.into_iter().chain(ahead).collect() })
    };
    world.pin_tracks().into_iter().filter_map(of).collect()
}

/// The same ways of a copy that comes `now` `[s]`, `by` `[m]` from where it was, and whose first point gets the number `next`.
pub(super) fn put(ways: &mut [PinMotionKeys], (now, by, next): (f64, [f64; 3], u32)) {
    for PinMotionKeys { point, track } in ways {
        *point += next;
        for knot in track {
            knot[0] += now;
            knot[1..].iter_mut().zip(by).for_each(|(x, by)| *x += by);
        }
    }
}
