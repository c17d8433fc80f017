//! Discs of many sizes: every triangle well shaped, every side a bond once.

use std::collections::BTreeSet;

use super::*;
use crate::body::distance;

fn disc(size: f64) -> Disc {
    Disc { radius: size, spacing: 1.0 }
}

/// The triangles of a body: three points that are bonded to each other with no point inside their circle.
fn triangles(body: &Body) -> Vec<[usize; 3]> {
    let mut later: Vec<BTreeSet<usize>> = vec![BTreeSet::new(); body.positions.len()];
    for link in &body.links {
        later[link.a as usize].insert(link.b as usize);
    }
    let mut found = Vec::new();
    for a in 0..later.len() {
        for &b in &later[a] {
            found.extend(later[a].intersection(&later[b]).map(|&c| [a, b, c]));
        }
    }
    found
}

/// The sharpest angle of a triangle `[degrees]`.
fn sharpest(body: &Body, [a, b, c]: [usize; 3]) -> f64 {
    let p = &body.positions;
    let (x, y, z) = (distance(p[b], p[c]), distance(p[c], p[a]), distance(p[a], p[b]));
    let angle = |x: f64, y: f64, z: f64| ((y * y + z * z - x * x) / (2.0 * y * z)).acos().to_degrees();
    angle(x, y, z).min(angle(y, z, x)).min(angle(z, x, y))
}

/// Sizes from the least on: small ones closely, for their shapes differ most.
fn sizes() -> impl Iterator<Item = f64> {
    (0..200).map(|k| 1.0 + 0.037 * f64::from(k)).chain([11.3, 23.0, 52.4, 140.7])
}

#[test]
fn angles_are_30_degrees_at_least_in_every_size() {
    for size in sizes() {
        let body = disc(size).make().unwrap();
        let all = triangles(&body);
        let worst = all.iter().map(|&corners| sharpest(&body, corners)).fold(90.0, f64::min);
        assert!(worst >= 30.0 - 1e-9, "{worst} degrees in a disc of {size}");
        // Euler's formula: the mesh is one piece without holes.
        assert_eq!(body.positions.len() + all.len(), body.links.len() + 1, "size {size}");
        let mut covered: Vec<[usize; 3]> = body.triangles.iter().map(|corners| corners.map(|k| k as usize)).collect();
        covered.iter_mut().for_each(|corners| corners.sort_unstable());
        covered.sort_unstable();
        assert_eq!(covered, all, "size {size}");
    }
}

#[test]
fn the_rim_comes_first_and_every_side_is_a_bond_once() {
    for size in sizes() {
        let body = disc(size).make().unwrap();
        let rim = rim(size).len();
        assert_eq!(disc(size).point_count(), Ok(body.positions.len() as u32));
        assert_eq!(body.positions[0], [size, 0.0, 0.0]);
        let outside = body.positions.iter().position(|p| p[0].hypot(p[1]) < size - 0.1);
        assert_eq!(outside, Some(rim));
        let pairs: Vec<[u32; 2]> = body.links.iter().map(|link| [link.a, link.b]).collect();
        assert!(pairs.windows(2).all(|pair| pair[0] < pair[1]) && pairs.iter().all(|[a, b]| a < b));
        let around = (0..rim as u32).filter(|&k| pairs.contains(&[k, k + 1])).count();
        assert!(around >= rim - 1 && pairs.contains(&[0, rim as u32 - 1]), "the rim is closed");
        let lengths = body.links.iter().map(|link| link.rest_length);
        assert!(lengths.clone().fold(f64::INFINITY, f64::min) >= WIDEST - 1e-9, "size {size}");
        assert!(lengths.fold(0.0, f64::max) <= 2.0 * WIDEST, "size {size}");
    }
}

#[test]
fn mass_is_shared_by_area() {
    let size = 30.0;
    let body = disc(size).make().unwrap();
    let count = rim(size).len() as f64;
    let area = 0.5 * count * size * size * (TAU / count).sin();
    assert!((body.weights.iter().sum::<f64>() - area).abs() < 1e-9 * area);
    assert!(body.weights.iter().all(|&w| w > 0.15 && w < 1.7));
}

#[test]
fn the_scale_changes_nothing_but_lengths() {
    let body = Disc { radius: 5e-200, spacing: 1e-200 }.make().unwrap();
    let large = Disc { radius: 5e200, spacing: 1e200 }.make().unwrap();
    let pairs = |body: &Body| body.links.iter().map(|link| [link.a, link.b]).collect::<Vec<_>>();
    assert_eq!(pairs(&body), pairs(&large));
    assert_eq!(body, Disc { radius: 5e-200, spacing: 1e-200 }.make().unwrap());
}

#[test]
fn lengths_that_make_no_mesh_are_refused() {
    let wrong = |radius, spacing| Disc { radius, spacing }.point_count().unwrap_err().to_string();
    assert_eq!(wrong(2.0, 2.5), "spacing: is 2.5: it must be at most radius, 2.0");
    assert_eq!(wrong(0.0, 1.0), "radius: is 0.0: give a finite number above 0");
    assert_eq!(wrong(1.0, f64::NAN), "spacing: is NaN: give a finite number above 0");
    assert_eq!(wrong(1.0, 1e-4), "spacing: is 0.0001, which makes about 3.6e8 points: 20000000 is the most");
    assert_eq!(Disc { radius: 1.0, spacing: 1.0 }.point_count(), Ok(7));
}
