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
        let solids = Solids::new(std::slice::from_ref(&shape)).unwrap().unwrap();
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
        let solids = Solids::new(std::slice::from_ref(&shape)).unwrap().unwrap();
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
    let solids = Solids::new(std::slice::from_ref(&shape)).unwrap().unwrap();
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
    let solids = Solids::new(&[tile(0.0), tile(1.0)]).unwrap().unwrap();
    assert_eq!(solids.planes::<2>(&[tile(0.0), tile(1.0)]).len(), 6);
    assert!(solids.meeting([[0.5, 0.5], [1.5, 0.5]], 1e-12, |_| true).is_none());
    assert!(solids.around([1.0, 0.5], 1e-9, 9.0).is_some(), "inside of both");
}

#[test]
fn walls_have_their_normals_towards_the_free_side() {
    let shape = frame();
    let solids = Solids::new(std::slice::from_ref(&shape)).unwrap().unwrap();
    for plane in solids.planes::<2>(std::slice::from_ref(&shape)) {
        let along = [plane.normal[1], -plane.normal[0]];
        assert!(cross(along, plane.normal) > 0.0);
        let beside = |way: f64| [0, 1].map(|k| plane.point[k] + 1e-4 * along[k] + way * 1e-6 * plane.normal[k]);
        assert!(!is_inside(&shape, beside(1.0)) && is_inside(&shape, beside(-1.0)), "{plane:?}");
    }
}

/// Points all over a box that are inside of one polygon or more are in the solid, and no others.
fn assert_covers(shapes: &[Polygon], [low, high]: [[f64; 2]; 2]) {
    let solids = Solids::new(shapes).unwrap().unwrap();
    let mut random = Pcg64::seed_from_u64(4);
    for _ in 0..4_000 {
        let x = [0, 1].map(|k| random.random_range(low[k]..high[k]));
        let is_in = shapes.iter().any(|shape| is_inside(shape, x));
        assert_eq!(solids.is_solid(x), is_in, "{x:?}");
        // No wall inside: the nearest one leads out.
        if let Some(wall) = solids.around(x, 1e-9, f64::INFINITY) {
            let at = solids.wall(wall).nearest(x);
            let is_free = |k: i32| {
                let (sin, cos) = (0.1 * f64::from(k)).sin_cos();
                !shapes.iter().any(|shape| is_inside(shape, [at[0] + 1e-7 * cos, at[1] + 1e-7 * sin]))
            };
            assert!((0..63).any(is_free), "{x:?} is led to {at:?}");
        }
    }
}

fn rectangle([left, low]: [f64; 2], [right, high]: [f64; 2]) -> Vec<[f64; 2]> {
    vec![[left, low], [right, low], [right, high], [left, high]]
}

#[test]
fn polygons_that_overlap_are_one_solid() {
    let area = [[-2.0, -2.0], [8.0, 8.0]];
    let of = |loops: &[Vec<[f64; 2]>]| Polygon { loops: loops.to_vec(), restitution: 0.0, friction: 0.0 };
    let boxes = [of(&[rectangle([0.0, 0.0], [3.0, 4.0])]), of(&[rectangle([1.0, 1.0], [6.0, 3.0])])];
    assert_covers(&boxes, area);
    let hidden = [of(&[rectangle([0.0, 0.0], [5.0, 4.0])]), of(&[rectangle([1.0, 2.0], [3.0, 4.0])])];
    assert_covers(&hidden, area);
    let above = Solids::new(&hidden).unwrap().unwrap();
    let mut tops = 0;
    above.touching([2.0, 4.0], 1e-9, |_| tops += 1);
    assert_eq!(tops, 1, "where tops are flush there is one wall");
    // An obstacle in the hole of another, over its rim.
    assert_covers(&[frame(), of(&[rectangle([0.4, 0.0], [1.5, 1.2])]), star()], [[-4.5, -2.5], [4.5, 2.5]]);
}

#[test]
fn sides_that_touch_in_part_or_lead_there_and_back_are_no_walls() {
    let mut random = Pcg64::seed_from_u64(5);
    for _ in 0..40 {
        let (angle, split, height) =
            (random.random_range(0.0..6.0_f64), random.random_range(0.5..3.0), random.random_range(0.5..3.0));
        let turned = |corners: Vec<[f64; 2]>| -> Vec<[f64; 2]> {
            let turn = |[x, y]: [f64; 2]| [x * angle.cos() - y * angle.sin(), x * angle.sin() + y * angle.cos()];
            corners.into_iter().map(turn).collect()
        };
        let (left, right) = (rectangle([-2.0, 0.0], [split, 4.0]), rectangle([split, 4.0 - height], [4.0, 4.0]));
        let of = |loops: Vec<Vec<[f64; 2]>>| Polygon { loops, restitution: 0.0, friction: 0.0 };
        let abutting = of(vec![turned(left), turned(right)]);
        // The top is one line: nothing stands up where they meet.
        let solids = Solids::new(std::slice::from_ref(&abutting)).unwrap().unwrap();
        let along = turned(vec![[-1.5, 4.001], [3.5, 4.001], [-1.5, 3.999], [3.5, 3.999]]);
        assert!(solids.meeting([along[0], along[1]], 1e-12, |_| true).is_none());
        assert!(solids.meeting([along[2], along[3]], 1e-12, |_| true).is_none(), "no wall within");
        let spike = turned(vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [split, 5.0], [1.0, 1.0], [0.0, 1.0]]);
        let other = turned(rectangle([5.0, 0.0], [6.0, 5.0]));
        let solids = Solids::new(&[of(vec![spike]), of(vec![other])]).unwrap().unwrap();
        let between = turned(vec![[3.0 + 0.1 * split, 0.5], [4.0, 3.0], [2.5, 4.9]]);
        assert!(between.iter().all(|&x| !solids.is_solid(x)), "{between:?}");
    }
}

#[test]
fn points_level_with_corners_are_on_their_side() {
    for slope in [0.0, 0.1, 0.37, 1.3] {
        let corners: Vec<[f64; 2]> = [[-0.3, 0.0], [-0.1, 0.3], [-0.2 + slope, 0.7], [-0.5, 0.3]].to_vec();
        let shape = Polygon { loops: vec![corners.clone()], restitution: 0.0, friction: 0.0 };
        let solids = Solids::new(std::slice::from_ref(&shape)).unwrap().unwrap();
        for [_, y] in corners {
            for x in [0.05, 0.7, 2.0, -0.6] {
                assert!(slope > 0.0 && x < 1.2 || !solids.is_solid([x, y]), "{x} {y}");
            }
        }
    }
}

#[test]
fn a_scribble_of_thousands_is_refused_and_one_of_hundreds_is_right() {
    let mut random = Pcg64::seed_from_u64(6);
    let mut scribble = |count: usize| {
        let corners: Vec<[f64; 2]> = (0..count).map(|_| [0, 1].map(|_| random.random_range(0.0..6.0))).collect();
        polygon(&[&corners])
    };
    assert!(Solids::new(&[scribble(6_000)]).is_err());
    let shape = scribble(300);
    let solids = Solids::new(std::slice::from_ref(&shape)).unwrap().unwrap();
    for _ in 0..4_000 {
        let x = [0, 1].map(|_| random.random_range(-0.5..6.5));
        assert_eq!(solids.is_solid(x), is_inside(&shape, x), "{x:?}");
    }
}
