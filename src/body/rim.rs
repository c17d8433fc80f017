//! A rim: two rings of points with bracing between them, closed.

use std::f64::consts::TAU;

use super::{Body, BodyError, MAX_POINTS, length};

/// Two rings of `sectors` points each about the origin, at the same angles from 0 anticlockwise.
#[derive(Clone, Debug, PartialEq)]
pub struct Rim {
    /// Radius of the outer ring `[m]`.
    pub radius: f64,
    /// Radius of the inner ring `[m]`, in (0, radius).
    pub inner_radius: f64,
    /// Points on each ring, >= 3.
    pub sectors: u64,
    /// Which bonds each sector has.
    pub bracing: Vec<Brace>,
}

/// A bond that every sector of a rim has, from its angle i to the next, i + 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Brace {
    /// Outer i to outer i + 1.
    Outer,
    /// Inner i to inner i + 1.
    Inner,
    /// Outer i to inner i.
    Spoke,
    /// Inner i to outer i + 1.
    Rising,
    /// Outer i to inner i + 1.
    Falling,
}

impl Default for Rim {
    /// Radii 2 and 1.8, a sector every 30 degrees, one diagonal.
    fn default() -> Self {
        Rim {
            radius: 2.0,
            inner_radius: 1.8,
            sectors: 12,
            bracing: vec![Brace::Outer, Brace::Inner, Brace::Spoke, Brace::Rising],
        }
    }
}

impl Rim {
    /// How many points it makes: two a sector.
    ///
    /// Errors: radii that are not positive or not in order; fewer than 3 sectors; a brace named twice.
    pub fn point_count(&self) -> Result<u32, BodyError> {
        length("radius", self.radius)?;
        length("inner_radius", self.inner_radius)?;
        if self.inner_radius >= self.radius {
            let (inner, outer) = (self.inner_radius, self.radius);
            return Err(BodyError::new("inner_radius", format!("is {inner:?}: it must be below radius, {outer:?}")));
        }
        let most = MAX_POINTS / 2;
        if !(3..=most).contains(&self.sectors) {
            return Err(BodyError::new("sectors", format!("is {}: give a number from 3 to {most}", self.sectors)));
        }
        for (i, brace) in self.bracing.iter().enumerate() {
            if self.bracing[..i].contains(brace) {
                return Err(BodyError::new("bracing", "names a bond twice: name each once"));
            }
        }
        Ok(2 * self.sectors as u32)
    }

    pub(super) fn make(&self) -> Body {
        let sectors = self.sectors as u32;
        let mut body = Body::default();
        for radius in [self.radius, self.inner_radius] {
            for i in 0..sectors {
                let angle = TAU * (f64::from(i) / f64::from(sectors));
                let (sin, cos) = (libm::sin(angle), libm::cos(angle));
                body.positions.push([radius * cos, radius * sin, 0.0]);
            }
        }
        body.weights = self.weights();
        for i in 0..sectors {
            let next = (i + 1) % sectors;
            for brace in &self.bracing {
                let (a, b) = match brace {
                    Brace::Outer => (i, next),
                    Brace::Inner => (sectors + i, sectors + next),
                    Brace::Spoke => (i, sectors + i),
                    Brace::Rising => (sectors + i, next),
                    Brace::Falling => (i, sectors + next),
                };
                body.link(a, b);
            }
            // Along the diagonal that is bonded, if there is one.
            let is_falling = self.bracing.contains(&Brace::Falling) && !self.bracing.contains(&Brace::Rising);
            let (inner, inner_next) = (sectors + i, sectors + next);
            body.cover(if is_falling { [i, next, inner_next, inner] } else { [next, inner_next, inner, i] });
        }
        body
    }

    /// Shares of the mass by area: the ring between the radii, cut halfway between them.
    fn weights(&self) -> Vec<f64> {
        let ratio = self.inner_radius / self.radius;
        let middle = 0.5 * (1.0 + ratio);
        let outer = 1.0 - middle * middle;
        let inner = middle * middle - ratio * ratio;
        // Radii one rounding apart leave no area to share by.
        let (outer, inner) = if outer > 0.0 && inner > 0.0 { (outer, inner) } else { (1.0, 1.0) };
        let sectors = self.sectors as usize;
        let mut weights = vec![outer; sectors];
        weights.resize(2 * sectors, inner);
        weights
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;
    use crate::body::distance;

    #[test]
    fn the_default_rim_is_closed_and_numbered_outer_ring_first() {
        let body = Rim::default().make();
        assert_eq!((body.positions.len(), body.links.len()), (24, 48));
        assert_eq!(body.positions[0], [2.0, 0.0, 0.0]);
        assert_eq!(body.positions[12], [1.8, 0.0, 0.0]);
        assert!(distance(body.positions[3], [0.0, 2.0, 0.0]) < 1e-15);
        assert!(body.links.iter().any(|l| (l.a, l.b) == (11, 0)));
        assert!(body.links.iter().any(|l| (l.a, l.b) == (23, 12)));
        for point in 0..24 {
            let bonds = body.links.iter().filter(|l| l.a == point || l.b == point);
            assert_eq!(bonds.count(), 4, "point {point}");
        }
        assert!(body.links.iter().all(|l| l.rest_length > 0.1));
    }

    #[test]
    fn bracing_is_any_subset() {
        let mut rim = Rim { sectors: 3, bracing: vec![Brace::Falling], ..Rim::default() };
        let links = rim.make().links;
        let pairs: Vec<_> = links.iter().map(|l| (l.a, l.b)).collect();
        assert_eq!(pairs, [(0, 4), (1, 5), (2, 3)]);
        rim.bracing = vec![Brace::Rising];
        let links = rim.make().links;
        let pairs: Vec<_> = links.iter().map(|l| (l.a, l.b)).collect();
        assert_eq!(pairs, [(3, 1), (4, 2), (5, 0)]);
        rim.bracing.clear();
        assert!(rim.make().links.is_empty());
        assert_eq!(rim.point_count(), Ok(6));
    }

    #[test]
    fn mass_is_shared_by_area() {
        let masses = Rim::default().make().masses(24.0);
        assert!((masses.iter().sum::<f64>() - 24.0).abs() < 1e-12);
        assert!((masses[0] / masses[12] - 0.39 / 0.37).abs() < 1e-12);
    }

    #[test]
    fn radii_out_of_order_and_too_few_sectors_are_refused() {
        let rim = Rim::default();
        let thick = Rim { inner_radius: 2.0, ..rim.clone() };
        assert_eq!(thick.point_count().unwrap_err().to_string(), "inner_radius: is 2.0: it must be below radius, 2.0");
        for (sectors, key) in [(2, "sectors"), (u64::MAX, "sectors")] {
            let few = Rim { sectors, ..rim.clone() };
            assert_eq!(few.point_count().unwrap_err().key, key);
        }
        let twice = Rim { bracing: vec![Brace::Outer, Brace::Outer], ..rim };
        assert_eq!(twice.point_count().unwrap_err().key, "bracing");
    }
}
