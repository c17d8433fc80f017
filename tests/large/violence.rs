//! Starts and settings that no one should ask for: whatever comes of them is finite.

use wobble::sim::{BondKind, Model, PointId};

use super::models::{
    Draw, bonded, cells, disc, frames, hung, path, places, rims, rope, scene, sheet, single, to_strain,
};

/// Runs so many frames: nothing may become infinite.
fn run(what: &str, model: &Model<2>, count: usize) {
    for model in [model.clone(), single(model)] {
        let mut world = scene(&model).world(None).unwrap();
        let mut is_sound = true;
        frames(&mut *world, count, |sample| {
            is_sound &= sample.position.iter().chain(&sample.velocity).flatten().all(|c| c.is_finite());
        });
        assert!(is_sound, "{what} in {:?}", world.precision());
    }
}

fn bodies() -> Vec<(&'static str, Model<2>)> {
    vec![
        ("rope", rope(600)),
        ("sheet", hung([30, 27], [true; 2])),
        ("net", hung([30, 27], [false; 2])),
        ("crowd", rims(20)),
        ("mesh", disc(0.9)),
    ]
}

#[test]
fn all_points_at_one_place() {
    for (what, model) in bodies() {
        let mut model = path(&model);
        model.position.fill([0.3, 0.2]);
        run(&format!("coincident {what}"), &model, 3);
        // Two of them.
        let mut model = path(&bodies().into_iter().find(|body| body.0 == what).unwrap().1);
        model.position[30] = model.position[29];
        run(&format!("two coincident {what}"), &model, 3);
    }
}

#[test]
fn points_anywhere() {
    for (what, model) in bodies() {
        let mut model = path(&model);
        Draw(4).shuffle(&mut model.position);
        run(&format!("shuffled {what}"), &model, 3);
    }
}

#[test]
fn velocities_of_ten_kilometres_a_second() {
    for (what, model) in bodies() {
        let mut model = path(&model);
        let mut draw = Draw(6);
        model.velocity.iter_mut().for_each(|v| *v = [2e4 * draw.next(), 2e4 * draw.next()]);
        run(&format!("fast {what}"), &model, 3);
    }
}

#[test]
fn long_substeps() {
    for (what, model) in bodies() {
        for h in [0.5, 1.0] {
            let mut model = path(&model);
            model.method.substep = Some(h);
            run(&format!("substep {h} {what}"), &model, 120);
        }
    }
}

#[test]
fn masses_a_million_apart() {
    for (what, model) in bodies() {
        let mut model = path(&model);
        model.mass.iter_mut().step_by(3).for_each(|m| *m = 1e6);
        run(&format!("heavy {what}"), &model, 5);
    }
}

#[test]
fn strains_of_nothing_and_of_ten() {
    for (what, model) in bodies() {
        for strain in [1e-12, 10.0] {
            run(
                &format!("strain {strain} {what}"),
                &to_strain(&path(&model), strain),
                if strain > 1.0 { 30 } else { 2 },
            );
        }
    }
}

#[test]
fn a_point_of_three_thousand_bonds() {
    let mut position = vec![[0.0, 0.0]];
    let mut ends = Vec::new();
    for i in 1..=3_000_u32 {
        let (sin, cos) = (f64::from(i) * 0.1).sin_cos();
        position.push([0.01 * f64::from(i).sqrt() * cos, 0.01 * f64::from(i).sqrt() * sin]);
        ends.push([0, i]);
    }
    run("free star", &path(&bonded(position.clone(), &ends, BondKind::Rigid)), 2);
    let star = Model { pinned: vec![PointId(0)], ..bonded(position, &ends, BondKind::Rigid) };
    run("star about a pin", &path(&star), 2);
}

#[test]
fn narrow_cloths() {
    for n in [1, 2, 3, 4, 5, 7, 8, 9, 15, 16, 17, 31, 32, 33, 34, 40] {
        for size in [[1, n], [n, 1], [2, n], [n, 2], [3, n], [n, 3]] {
            for diagonals in [[true; 2], [true, false], [false; 2]] {
                if size == [1, 1] {
                    continue;
                }
                let mut model = path(&bonded::<2>(places(size), &cells(size, diagonals), BondKind::Rigid));
                model.pinned = vec![PointId(0)];
                let mut world = scene(&model).world(None).unwrap();
                let sample = frames(&mut *world, 4, |_| {});
                assert!(world.is_finite() && sample.max_strain < 0.02, "{size:?} {diagonals:?}: {}", sample.max_strain);
            }
        }
    }
}

#[test]
fn everything_pinned() {
    let mut model = path(&sheet::<2>([30, 27], [true; 2]));
    model.pinned = (0..model.mass.len() as u32).map(PointId).collect();
    let mut world = scene(&model).world(None).unwrap();
    let sample = frames(&mut *world, 4, |_| {});
    assert!(sample.position.iter().zip(&model.position).all(|(x, start)| x[..2] == start[..]));
}
