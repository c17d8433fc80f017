//! Rim: two rings of points and the bonds between them.

use super::{Body, BodyError, cos, counted, positive, sin};

/// One family of a rim's bonds, a bond a sector.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Bracing {
    /// Along the outer ring.
    Outer,
    /// Along the inner ring.
    Inner,
    /// From the outer ring to the inner one at the same angle.
    Spoke,
    /// From the inner ring to the next outer point anticlockwise.
    Rising,
    /// From the outer ring to the next inner point anticlockwise.
    Falling,
}

/// Two concentric rings of `sectors` points each, at the same angles, from angle 0 anticlockwise; outer ring first.
///
/// Shapes: 2 `sectors` points, `sectors` bonds for each kind of bracing.
/// Valid range: `sectors` >= 3, 0 < `inner_radius` < `radius`.
#[derive(Clone, Debug, PartialEq)]
pub struct Rim {
    /// Radius of the outer ring [m].
    pub radius: f64,
    /// Radius of the inner ring [m].
    pub inner_radius: f64,
    /// Points on each ring.
    pub sectors: u64,
    /// Which bonds there are.
    pub bracing: Vec<Bracing>,
}

impl Rim {
    /// The rim about the origin.
    ///
    /// Errors: a parameter out of its range.
    pub fn make(&self) -> Result<Body, BodyError> {
        positive("radius", self.radius)?;
        positive("inner_radius", self.inner_radius)?;
        if self.inner_radius >= self.radius {
            let problem = format!("{} is not below radius {}", self.inner_radius, self.radius);
            return Err(BodyError::new("inner_radius", problem));
        }
        counted("sectors", self.sectors, 3)?;
        counted("sectors", 2 * self.sectors, 6)?;
        let n = self.sectors as u32;
        let mut body = Body::default();
        for radius in [self.radius, self.inner_radius] {
            for i in 0..n {
                let angle = std::f64::consts::TAU * f64::from(i) / f64::from(n);
                body.position.push([radius * cos(angle), radius * sin(angle), 0.0]);
            }
        }
        for i in 0..n {
            let next = (i + 1) % n;
            let all = [Bracing::Outer, Bracing::Inner, Bracing::Spoke, Bracing::Rising, Bracing::Falling];
            for bracing in all.into_iter().filter(|bracing| self.bracing.contains(bracing)) {
                body.bonds.push(match bracing {
                    Bracing::Outer => [i, next],
                    Bracing::Inner => [n + i, n + next],
                    Bracing::Spoke => [i, n + i],
                    Bracing::Rising => [n + i, next],
                    Bracing::Falling => [i, n + next],
                });
            }
        }
        Ok(body)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::distance;

    fn rim(sectors: u64, bracing: Vec<Bracing>) -> Result<Body, BodyError> {
        Rim { radius: 2.0, inner_radius: 1.8, sectors, bracing }.make()
    }

    #[test]
    fn a_rim_closes_and_no_two_points_coincide() {
        let body = rim(12, vec![Bracing::Outer, Bracing::Inner, Bracing::Spoke, Bracing::Rising]).unwrap();
        assert_eq!((body.position.len(), body.bonds.len()), (24, 48));
        assert_eq!(body.position[0], [2.0, 0.0, 0.0]);
        assert!((body.position[3][1] - 2.0).abs() < 1e-15, "a quarter turn anticlockwise");
        assert!(body.bonds.contains(&[11, 0]) && body.bonds.contains(&[23, 12]));
        for [a, b] in body.bonds {
            assert!(distance(body.position[a as usize], body.position[b as usize]) > 0.19);
        }
    }

    #[test]
    fn bracing_is_selectable() {
        assert_eq!(rim(3, vec![Bracing::Spoke]).unwrap().bonds, [[0, 3], [1, 4], [2, 5]]);
        assert_eq!(rim(3, vec![Bracing::Rising]).unwrap().bonds, [[3, 1], [4, 2], [5, 0]]);
        assert_eq!(rim(3, vec![Bracing::Falling]).unwrap().bonds, [[0, 4], [1, 5], [2, 3]]);
    }

    #[test]
    fn impossible_rims_are_refused() {
        assert_eq!(rim(2, vec![]).unwrap_err().key, "sectors");
        let inside_out = Rim { radius: 1.0, inner_radius: 1.0, sectors: 5, bracing: vec![] };
        assert_eq!(inside_out.make().unwrap_err().key, "inner_radius");
    }
}
