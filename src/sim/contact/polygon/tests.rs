use super::Polygon;
use super::solids::Solids;
use crate::sim::vector::{cross, sub};
use rand::{RngExt as _, SeedableRng};
use rand_pcg::Pcg64;

fn polygon(loops: &[&[[f64; 2]]]) -> Polygon {
    Polygon { loops: loops.iter().map(|corners| corners.to_vec()).collect(), restitution: 0.0, friction: 0.0 }
}

/// Whether a point is inside by the even-odd rule, by all sides.
fn is_inside(polygon: &Polygon, x: [f64; 2]) -> bool {
    let mut inside = false;
    for corners in &polygon.loops {
        for (k, &a) in corners.iter().enumerate() {
            let b = corners[(k + 1) % corners.len()];
            if (a[1] > x[1]) != (b[1] > x[1]) && x[0] < a[0] + (x[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]) {
                inside = !inside;
            }
        }
    }
    inside
}

fn star() -> Polygon {
    let corner = |k: i32| {
        let angle = 0.1 + f64::from(2 * k) * 0.4 * std::f64::consts::PI;
        [2.0 * angle.cos(), 2.0 * angle.sin()]
    };
    polygon(&[&[0, 1, 2, 3, 4].map(corner)])
}

fn frame() -> Polygon {
    polygon(&[
        &[[-3.0, -2.0], [3.0, -2.0], [3.0, 2.0], [-3.0, 2.0]],
        &[[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]],
        &[[-0.5, -0.5], [-0.5, 0.5], [0.5, 0.5], [0.5, -0.5]],
        &[[2.5, 0.0], [4.0, 1.0], [4.0, -1.0]],
    ])
}

#[test]
fn inside_is_even_odd_whatever_crosses() {
    let mut random = Pcg64::seed_from_u64(1);
    for shape in [star(), frame()] {
        let solids = Solids::new(std::slice::from_ref(&shape)).unwrap();
        let mut count = [0, 0];
        for _ in 0..20_000 {
            let x = [random.random_range(-4.5..4.5), random.random_range(-2.5..2.5)];
            let is_in = is_inside(&shape, x);
            assert_eq!(solids.around(x, 0.0, f64::INFINITY).is_some(), is_in, "{x:?}");
            count[usize::from(is_in)] += 1;
        }
        assert!(count[0] > 1_000 && count[1] > 1_000, "{count:?}");
    }
}

#[test]
fn a_way_meets_a_wall_where_it_first_gets_inside() {
    let mut random = Pcg64::seed_from_u64(2);
    for shape in [star(), frame()] {
        let solids = Solids::new(std::slice::from_ref(&shape)).unwrap();
        let mut met = 0;
        for _ in 0..4_000 {
            let mut x = || [random.random_range(-4.5..4.5), random.random_range(-2.5..2.5)];
            let (a, b) = (x(), x());
            if is_inside(&shape, a) {
                continue;
            }
            let at = |share: f64| [a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])];
            let first = (0..=2_000).map(|k| f64::from(k) / 2_000.0).find(|&share| is_inside(&shape, at(share)));
            let meeting = solids.meeting([a, b], 1e-12, |_| true);
            match (first, meeting) {
                (Some(share), Some(meeting)) => {
                    met += 1;
                    assert!(meeting.share <= share, "{meeting:?} {share}");
                    let x = at(meeting.share + 1e-9);
                    assert!(is_inside(&shape, x), "{a:?} {b:?} {meeting:?}");
                }
                (Some(share), None) => panic!("{a:?} to {b:?} gets inside at {share}"),
                // A corner thinner than the steps.
                (None, Some(meeting)) => assert!(is_inside(&shape, at(meeting.share + 1e-9)), "{a:?} {b:?}"),
                (None, None) => {}
            }
        }
        assert!(met > 500, "{met}");
    }
}

#[test]
fn the_nearest_wall_is_the_nearest_of_all() {
    let mut random = Pcg64::seed_from_u64(3);
    let shape = frame();
    let solids = Solids::new(std::slice::from_ref(&shape)).unwrap();
    for _ in 0..2_000 {
        let x = [random.random_range(-3.0..4.0), random.random_range(-2.0..2.0)];
        let Some(wall) = solids.around(x, 0.0, f64::INFINITY) else { continue };
        let least = shape.loops.iter().flat_map(|corners| {
            corners.iter().enumerate().map(|(k, &a)| {
                let b = corners[(k + 1) % corners.len()];
                let (along, from) = (sub(b, a), sub(x, a));
                let length = along[0].hypot(along[1]);
                let at = ((along[0] * from[0] + along[1] * from[1]) / length).clamp(0.0, length);
                (from[0] - along[0] / length * at).hypot(from[1] - along[1] / length * at)
            })
        });
        let least = least.fold(f64::INFINITY, f64::min);
        let found = solids.wall(wall);
        let distance = found.square_distance(x).sqrt();
        assert!((distance - least).abs() < 1e-12, "{x:?}: {distance} of {least}");
    }
}

#[test]
fn tiles_side_by_side_have_no_wall_between_them() {
    let tile = |left: f64| polygon(&[&[[left, 0.0], [left + 1.0, 0.0], [left + 1.0, 1.0], [left, 1.0]]]);
    let solids = Solids::new(&[tile(0.0), tile(1.0)]).unwrap();
    assert_eq!(solids.planes::<2>(&[tile(0.0), tile(1.0)]).len(), 6);
    assert!(solids.meeting([[0.5, 0.5], [1.5, 0.5]], 1e-12, |_| true).is_none());
    assert!(solids.around([1.0, 0.5], 1e-9, 9.0).is_some(), "inside of both");
}

#[test]
fn walls_have_their_normals_towards_the_free_side() {
    let shape = frame();
    let solids = Solids::new(std::slice::from_ref(&shape)).unwrap();
    for plane in solids.planes::<2>(std::slice::from_ref(&shape)) {
        let along = [plane.normal[1], -plane.normal[0]];
        assert!(cross(along, plane.normal) > 0.0);
        let beside = |way: f64| [0, 1].map(|k| plane.point[k] + 1e-4 * along[k] + way * 1e-6 * plane.normal[k]);
        assert!(!is_inside(&shape, beside(1.0)) && is_inside(&shape, beside(-1.0)), "{plane:?}");
    }
}
