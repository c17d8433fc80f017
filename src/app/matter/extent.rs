//! How large bodies are at rest, however they are pressed or drawn out now: what the mass of a matter goes by.

use crate::sim::bond::lower_first;
use crate::sim::vector::{cross3, length, sub};
use crate::sim::{Bond, Dynamics, Limit, PointId};

/// How long a bond is at rest `[m]`; one that only holds apart is as long as it is now.
pub(super) fn rest_length(world: &dyn Dynamics, bond: &Bond) -> f64 {
    match bond.limit {
        Limit::Min => length(sub(place(world, bond.b), place(world, bond.a))),
        Limit::Both | Limit::Max => bond.rest_length,
    }
}

/// The triangles all of whose corners are among some points, ascending, with their areas at rest `[m^2]`.
///
/// Model: of three sides by bonds that act both ways the area that their rest lengths span; where a side has no such bond, the area now
/// by as much as the other sides are longer or shorter at rest.
pub(super) fn areas(world: &dyn Dynamics, points: &[PointId]) -> Vec<([PointId; 3], f64)> {
    let has = |point: &PointId| points.binary_search(point).is_ok();
    let triangles: Vec<[PointId; 3]> =
        world.triangles().iter().filter(|corners| corners.iter().all(has)).copied().collect();
    if triangles.is_empty() {
        return Vec::new();
    }
    let sides = world.bonds().iter().filter(|bond| bond.limit == Limit::Both && has(&bond.a) && has(&bond.b));
    let mut sides: Vec<([PointId; 2], f64)> =
        sides.map(|bond| (lower_first([bond.a, bond.b]), bond.rest_length)).collect();
    sides.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let rest = |a: PointId, b: PointId| {
        let found = sides.binary_search_by(|side| side.0.cmp(&lower_first([a, b])));
        found.ok().map(|place| sides[place].1)
    };
    let area = |corners: &[PointId; 3]| {
        let [a, b, c] = *corners;
        let at = corners.map(|corner| place(world, corner));
        match [rest(a, b), rest(b, c), rest(c, a)] {
            [Some(ab), Some(bc), Some(ca)] => spanned([ab, bc, ca]),
            sides => {
                let [p, q, r]: [[f64; 3]; 3] = [sub(at[1], at[0]), sub(at[2], at[1]), sub(at[0], at[2])];
                let longer = [p, q, r].map(length).into_iter().zip(sides);
                let longer = longer.filter_map(|(now, rest)| Some(rest? / now)).filter(|share| share.is_finite());
                0.5 * length(cross3(p, q)) * longer.product::<f64>()
            }
        }
    };
    triangles.iter().map(|corners| (*corners, area(corners))).collect()
}

/// The area of a triangle of such sides `[m]`; 0 where they do not close.
///
/// Source: W. Kahan, Miscalculating Area and Angles of a Needle-like Triangle (2014), section 2.
pub(super) fn spanned(mut sides: [f64; 3]) -> f64 {
    sides.sort_by(|a, b| b.total_cmp(a));
    let [a, b, c] = sides;
    0.25 * ((a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c))).max(0.0).sqrt()
}

/// Where a point of a world is `[m]`.
pub(super) fn place(world: &dyn Dynamics, point: PointId) -> [f64; 3] {
    let (positions, dimensions) = (world.positions(), world.dimensions());
    let at = |axis: usize| positions.get(point.index() * dimensions + axis);
    std::array::from_fn(|axis| if axis < dimensions { at(axis) } else { 0.0 })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_sides_span_an_area_or_do_not_close() {
        assert!((spanned([3.0, 5.0, 4.0]) - 6.0).abs() < 1e-12);
        assert_eq!([spanned([1.0, 1.0, 2.0]), spanned([1.0, 1.0, 3.0]), spanned([0.0; 3])], [0.0; 3]);
    }
}
