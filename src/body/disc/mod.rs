//! A disc: a mesh of triangles of one size, even along the rim.

mod band;
mod rows;

use std::f64::consts::TAU;

use super::{Body, BodyError, MAX_POINTS, length};
use band::{Band, DEEP_SHARE, WIDEST, is_deep};
use rows::{Cell, ROW_HEIGHT, Rows, later_neighbours, position};

/// A full circle about the origin: points evenly on the rim, a triangular lattice inside, and every side of a triangle
/// a bond. No angle of a triangle is below 30 degrees.
///
/// Points are numbered along the rim from angle 0 anticlockwise, then those of the lattice row by row from below, then,
/// likewise, the few that fill gaps between lattice and rim.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disc {
    /// Radius `[m]`.
    pub radius: f64,
    /// Distance of neighbours `[m]`, at most the radius: exact in the lattice, the nearest that fits around on the rim.
    pub spacing: f64,
}

/// The points of a disc in spacings, and its band.
struct Mesh {
    rim: Vec<[f64; 2]>,
    rows: Rows,
    band: Band,
}

impl Disc {
    /// How many points it makes. The band along the rim has to be meshed for that: the inside costs next to nothing.
    ///
    /// Errors: lengths that are not positive; a spacing above the radius, or so small that there would be more points
    /// than [`MAX_POINTS`].
    pub fn point_count(&self) -> Result<u32, BodyError> {
        let mesh = self.mesh()?;
        Ok(mesh.rim.len() as u32 + mesh.rows.len() + mesh.band.added.len() as u32)
    }

    /// Radius in spacings.
    ///
    /// Errors: as of [`Disc::point_count`].
    fn size(&self) -> Result<f64, BodyError> {
        length("radius", self.radius)?;
        length("spacing", self.spacing)?;
        if self.spacing > self.radius {
            let (spacing, radius) = (self.spacing, self.radius);
            return Err(BodyError::new("spacing", format!("is {spacing:?}: it must be at most radius, {radius:?}")));
        }
        let size = self.radius / self.spacing;
        // A point of the lattice has two triangles to itself.
        let points = 0.5 * TAU * size * size / ROW_HEIGHT;
        if points > MAX_POINTS as f64 {
            return Err(BodyError::new(
                "spacing",
                format!("is {:?}, which makes about {points:.1e} points: {MAX_POINTS} is the most", self.spacing),
            ));
        }
        Ok(size)
    }

    fn mesh(&self) -> Result<Mesh, BodyError> {
        let size = self.size()?;
        let rim = rim(size);
        let rows = Rows::new(size - WIDEST);
        let band = Band::new(size, &rim, &rows)
            .map_err(|error| BodyError::new("spacing", format!("makes no mesh ({error}): give another")))?;
        Ok(Mesh { rim, rows, band })
    }

    pub(super) fn make(&self) -> Result<Body, BodyError> {
        let Mesh { rim, rows, band } = self.mesh()?;
        let size = self.radius / self.spacing;
        let inner = rows.cells().map(position).chain(band.added.iter().copied());
        let place = |[x, y]: [f64; 2], scale: f64| [x * scale, y * scale, 0.0];
        let scale = self.radius / size;
        let positions: Vec<[f64; 3]> = rim.iter().copied().chain(inner).map(|p| place(p, scale)).collect();
        let mut weights = vec![DEEP_SHARE; positions.len()];
        for (point, share) in band.shares {
            weights[point as usize] = share;
        }
        let mut sides = band.sides;
        sides.extend(deep_sides(&rows, rim.len() as u32, size));
        for side in &mut sides {
            side.sort_unstable();
        }
        sides.sort_unstable();
        let mut triangles = band.triangles;
        triangles.extend(deep_triangles(&rows, rim.len() as u32, size));
        for corners in &mut triangles {
            let least = (0..3).min_by_key(|&k| corners[k]).unwrap_or(0);
            corners.rotate_left(least);
        }
        triangles.sort_unstable();
        let mut body =
            Body { positions, triangles, links: Vec::with_capacity(sides.len()), weights, ..Body::default() };
        for [a, b] in sides {
            body.link(a, b);
        }
        Ok(body)
    }
}

/// Points on a circle of this radius `[spacings]`, as many as bring their distance nearest to 1 along it.
fn rim(radius: f64) -> Vec<[f64; 2]> {
    let count = (TAU * radius).round() as u32;
    let at = |k: u32| {
        let angle = TAU * (f64::from(k) / f64::from(count));
        [radius * libm::cos(angle), radius * libm::sin(angle)]
    };
    (0..count).map(at).collect()
}

/// Sides between two deep points, by their numbers from `first` on.
fn deep_sides(rows: &Rows, first: u32, radius: f64) -> impl Iterator<Item = [u32; 2]> + '_ {
    let deep = rows.cells().zip(first..).filter(move |(cell, _)| is_deep(position(*cell), radius));
    deep.flat_map(move |(cell, number)| {
        let others = later_neighbours(cell).into_iter().filter(move |other| is_deep(position(*other), radius));
        others.filter_map(move |other| rows.number(other).map(|other| [number, first + other]))
    })
}

/// Triangles of the lattice between deep points alone, by their numbers from `first` on.
fn deep_triangles(rows: &Rows, first: u32, radius: f64) -> impl Iterator<Item = [u32; 3]> + '_ {
    let number = move |cell: Cell| rows.number(cell).filter(|_| is_deep(position(cell), radius));
    rows.cells().flat_map(move |cell| {
        let [right, above_left, above_right] = later_neighbours(cell);
        let of = move |corners: [Cell; 3]| {
            let [a, b, c] = corners.map(number);
            Some([first + a?, first + b?, first + c?])
        };
        [[cell, right, above_right], [cell, above_right, above_left]].into_iter().filter_map(of)
    })
}

#[cfg(test)]
#[allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]
mod tests;
