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
            Stretch::To(end) => {
                if !end.iter().all(|x| x.is_finite()) {
                    return Err(BodyError::new("to", "is not finite: give ordinary numbers"));
                }
                if end == [0.0; 3] {
                    return Err(BodyError::new(
                        "to",
                        "is the rope's own origin: `to` counts from there, so give where it ends",
                    ));
                }
                count("count", self.count, 2)
            }
        }
    }

    pub(super) fn make(&self) -> Body {
        let last = self.count - 1;
        let mut body = Body {
            positions: (0..self.count).map(|i| self.position(i, last)).collect(),
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
            Stretch::To(end) => end.map(|x| x * (i as f64 / last as f64)),
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
