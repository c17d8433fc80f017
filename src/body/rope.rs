//! A rope: a row of points, each bonded to the next.

use super::{Body, BodyError, count, length};

/// A straight row of points from the origin on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rope {
    /// How many points, >= 1; >= 2 where the end is given.
    pub count: u64,
    /// How far it reaches.
    pub stretch: Stretch,
}

/// How far a rope reaches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stretch {
    /// Along x, with this distance from point to point `[m]`.
    Spacing(f64),
    /// To this point, seen from the body's origin `[m]`, in equal pieces.
    To([f64; 3]),
    /// The same along an arc that hangs below, which is longer than the straight way by a share, > 0 `[1]`.
    Hanging([f64; 3], f64),
}

/// The corners of a chain of equal pieces, 2 or more, on an arc of a circle from the origin to `end` `[m]` that is longer than the straight way by
/// a share, >= 0 `[1]`. It hangs towards -y, below what stands upright towards x.
///
/// Model: n pieces of length c on an arc over an angle t have n c = (1 + share) |end| where n sin(t/2n) = (1 + share) sin(t/2).
pub fn hanging(end: [f64; 3], pieces: u64, share: f64) -> Vec<[f64; 3]> {
    let n = pieces as f64;
    let straight = |k: f64| end.map(|x| x * (k / n));
    let ratio = |t: f64| n * libm::sin(0.5 * t / n) / libm::sin(0.5 * t);
    let (mut least, mut most) = (0.0, std::f64::consts::TAU);
    for _ in 0..200 {
        let t = 0.5 * (least + most);
        if ratio(t) < 1.0 + share { least = t } else { most = t }
    }
    let t = 0.5 * (least + most);
    if share <= 0.0 || t < 1e-6 {
        return (0..=pieces).map(|k| straight(k as f64)).collect();
    }
    let long = end.iter().map(|x| x * x).sum::<f64>().sqrt();
    let along = end.map(|x| x / long);
    // What of -y, or of x, is across.
    let across = |way: [f64; 3]| {
        let share = (0..3).map(|k| way[k] * along[k]).sum::<f64>();
        let rest: [f64; 3] = std::array::from_fn(|k| way[k] - share * along[k]);
        let size = rest.iter().map(|x| x * x).sum::<f64>().sqrt();
        (size > 1e-6).then(|| rest.map(|x| x / size))
    };
    let down = across([0.0, -1.0, 0.0]).or_else(|| across([1.0, 0.0, 0.0])).unwrap_or([0.0; 3]);
    let radius = 0.5 * long / libm::sin(0.5 * t);
    let place = |k: u64| {
        let angle = t * (k as f64 / n - 0.5);
        let (far, low) = (0.5 * long + radius * libm::sin(angle), radius * (libm::cos(angle) - libm::cos(0.5 * t)));
        std::array::from_fn(|axis| far * along[axis] + low * down[axis])
    };
    (0..=pieces).map(|k| if k == 0 || k == pieces { straight(k as f64) } else { place(k) }).collect()
}

impl Rope {
    /// How many points it makes.
    ///
    /// Errors: a count out of range; a spacing that is not positive; an end that is not finite or at the origin.
    pub fn point_count(&self) -> Result<u32, BodyError> {
        match self.stretch {
            Stretch::Spacing(spacing) => {
                length("spacing", spacing)?;
                count("count", self.count, 1)
            }
            Stretch::To(end) | Stretch::Hanging(end, _) => {
                if let Stretch::Hanging(_, share) = self.stretch
                    && !(share.is_finite() && share > 0.0)
                {
                    return Err(BodyError::new("slack", format!("is {share:?}: give a finite number above 0")));
                }
                if !end.iter().all(|x| x.is_finite()) {
                    return Err(BodyError::new("to", "is not finite: give ordinary numbers"));
                }
                if end == [0.0; 3] {
                    return Err(BodyError::new(
                        "to",
                        "is the rope's own origin: `to` counts from there, so give where it ends",
                    ));
                }
                let least = if matches!(self.stretch, Stretch::Hanging(..)) { 3 } else { 2 };
                count("count", self.count, least)
            }
        }
    }

    pub(super) fn make(&self) -> Body {
        let last = self.count - 1;
        let mut body = Body {
            positions: match self.stretch {
                Stretch::Hanging(end, share) => hanging(end, last, share),
                _ => (0..self.count).map(|i| self.position(i, last)).collect(),
            },
            links: Vec::new(),
            weights: vec![1.0; self.count as usize],
            ..Body::default()
        };
        // An end point carries half a piece, all others two halves.
        if last > 0 {
            body.weights[0] = 0.5;
            body.weights[last as usize] = 0.5;
        }
        for i in 0..last as u32 {
            body.link(i, i + 1);
        }
        body
    }

    fn position(&self, i: u64, last: u64) -> [f64; 3] {
        match self.stretch {
            Stretch::Spacing(spacing) => [spacing * i as f64, 0.0, 0.0],
            Stretch::To(end) | Stretch::Hanging(end, _) => end.map(|x| x * (i as f64 / last as f64)),
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;

    #[test]
    fn a_rope_runs_from_the_origin_on() {
        let rope = Rope { count: 5, stretch: Stretch::Spacing(0.5) };
        let body = rope.make();
        assert_eq!(body.positions[0], [0.0; 3]);
        assert_eq!(body.positions[4], [2.0, 0.0, 0.0]);
        let pairs: Vec<_> = body.links.iter().map(|l| (l.a, l.b)).collect();
        assert_eq!(pairs, [(0, 1), (1, 2), (2, 3), (3, 4)]);
        assert!(body.links.iter().all(|l| l.rest_length == 0.5));
        assert_eq!(body.masses(8.0), [1.0, 2.0, 2.0, 2.0, 1.0]);
    }

    #[test]
    fn a_rope_to_a_point_ends_there() {
        let rope = Rope { count: 4, stretch: Stretch::To([0.3, -0.4, 0.0]) };
        let body = rope.make();
        assert_eq!(body.positions[3], [0.3, -0.4, 0.0]);
        assert!(body.links.iter().all(|l| (l.rest_length - 0.5 / 3.0).abs() < 1e-16));
    }

    #[test]
    fn a_rope_with_slack_hangs_in_equal_pieces() {
        for (end, low) in [([3.0, 1.0, 0.0], [0.0, -1.0]), ([0.0, -2.0, 0.0], [1.0, 0.0])] {
            for slack in [0.02, 0.5, 4.0] {
                let body = Rope { count: 9, stretch: Stretch::Hanging(end, slack) }.make();
                let long = (end[0] * end[0] + end[1] * end[1]).sqrt();
                let piece = (1.0 + slack) * long / 8.0;
                assert!(body.links.iter().all(|link| (link.rest_length - piece).abs() < 1e-9 * long), "{slack}");
                assert_eq!((body.positions[0], body.positions[8]), ([0.0; 3], end));
                let off = [0, 1].map(|axis| body.positions[4][axis] - 0.5 * end[axis]);
                assert!(off[0] * low[0] + off[1] * low[1] > 0.0, "{off:?}");
            }
        }
        let error = |count, slack| Rope { count, stretch: Stretch::Hanging([1.0, 0.0, 0.0], slack) }.point_count();
        assert_eq!(
            [error(5, 0.0), error(5, f64::NAN), error(2, 0.1)].map(|error| error.unwrap_err().key),
            ["slack", "slack", "count"]
        );
    }

    #[test]
    fn one_point_is_a_rope_only_without_an_end() {
        let one = Rope { count: 1, stretch: Stretch::Spacing(1.0) };
        assert_eq!(one.point_count(), Ok(1));
        assert_eq!(one.make().masses(3.0), [3.0]);
        let to = |end| Rope { count: 1, stretch: Stretch::To(end) };
        assert_eq!(to([1.0, 0.0, 0.0]).point_count().unwrap_err().key, "count");
        assert_eq!(to([0.0; 3]).point_count().unwrap_err().key, "to");
        assert_eq!(to([f64::NAN, 0.0, 0.0]).point_count().unwrap_err().key, "to");
        let flat = Rope { count: 3, stretch: Stretch::Spacing(-1.0) };
        assert_eq!(flat.point_count().unwrap_err().to_string(), "spacing: is -1.0: give a finite number above 0");
    }
}
