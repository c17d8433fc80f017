//! Points that are doubled along a slit.

use super::*;

/// Points of the sixth row of the cloth in space, which has eleven columns, and the bonds from them to the row below.
fn slit(world: &dyn Dynamics) -> (Vec<PointId>, Vec<BondId>) {
    let points: Vec<PointId> = (57..64).map(PointId).collect();
    let goes = |ends: &[PointId; 2]| {
        let is_below = |end: &PointId| (66..77).contains(&end.0);
        ends.iter().any(|end| points.contains(end)) && ends.iter().any(is_below)
    };
    let bonds = world.bonds().ends().iter().zip(0..).filter(|(ends, _)| goes(ends)).map(|(_, k)| BondId(k));
    let bonds = bonds.collect();
    (points, bonds)
}

#[test]
fn a_slit_in_a_cloth_loses_nothing_opens_and_tears_no_further_by_itself() {
    let mut world = Scene::load("cloth-space").unwrap().world(None).unwrap();
    run_to(&mut *world, 5.0);
    let (points, bonds) = slit(&*world);
    let (before, count) = (now(&*world), world.bonds().len());
    let [triangles, mass] = [world.triangles().len() as f64, world.masses().iter().sum()];
    let applied = world.apply(&Command::Split { points: points.clone(), bonds: bonds.clone() }).unwrap();
    assert_eq!(applied.points, 121..128);
    assert_eq!(world.triangles().len() as f64, triangles);
    // Between seven points and to both tips.
    assert_eq!(world.bonds().len(), count + 8);
    assert!((world.masses().iter().sum::<f64>() - mass).abs() < 1e-12 && world.torn().is_empty());
    let after = now(&*world);
    let own: Vec<usize> = (0..121).chain(points.iter().map(|point| point.index())).collect();
    for (k, point) in own.into_iter().enumerate() {
        let apart = |a: [f64; 3], b: [f64; 3]| (0..3).map(|axis| (a[axis] - b[axis]).abs()).fold(0.0, f64::max);
        assert!(apart(after.position[k], before.position[point]) < 1e-12, "{k}");
        assert!(apart(after.velocity[k], before.velocity[point]) < 1e-9, "{k}");
    }
    let late = run_to(&mut *world, 8.0);
    let gap =
        |k: usize| (0..3).map(|axis| (late.position[60][axis] - late.position[k][axis]).powi(2)).sum::<f64>().sqrt();
    assert!(gap(124) > 0.05, "it opens: {} m", gap(124));
    assert_eq!(world.counters().bonds_torn, 0);
}

#[test]
fn what_cannot_be_split_is_refused_and_leaves_the_world_as_it_was() {
    let mut world = Scene::load("cloth-space").unwrap().world(None).unwrap();
    let (points, bonds) = slit(&*world);
    let before = (now(&*world).position, world.bonds().len());
    for (points, bonds, why) in [
        (vec![PointId(5)], bonds.clone(), "is held"),
        (vec![PointId(900)], bonds.clone(), "no point 900"),
        (points.clone(), vec![BondId(9000)], "no bond 9000"),
        (points.clone(), vec![BondId(0)], "ends at none"),
    ] {
        let error = world.apply(&Command::Split { points, bonds }).unwrap_err();
        assert!(error.to_string().contains(why), "{error}");
        assert_eq!((now(&*world).position, world.bonds().len()), before);
    }
    assert!(!world.apply(&Command::Split { points: Vec::new(), bonds: Vec::new() }).unwrap().is_something);
    assert!(!world.apply(&Command::Split { points, bonds: Vec::new() }).unwrap().is_something);
}
