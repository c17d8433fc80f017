//! Models and measures for tests of the motion.

use wobble::sim::{Bond, BondKind, Dynamics, Model, PointId, Sample};

/// Runs substeps until `t` lies in the next one, and samples there.
///
/// What is no number would pass for the least of all errors, so it is looked for here.
pub fn run_to(world: &mut dyn Dynamics, t: f64) -> Sample {
    while world.time() + world.substep() <= t + 1e-12 {
        world.step();
    }
    assert!(world.is_finite(), "the motion left the finite numbers before {t} s");
    world.sample(t.max(world.time()))
}

/// Middle of some points of the plane, whatever their masses [m].
pub fn middle(world: &dyn Dynamics, points: std::ops::Range<usize>) -> [f64; 2] {
    let sample = world.sample(world.time());
    let count = points.len() as f64;
    [0, 1].map(|axis| sample.position[points.clone()].iter().map(|x| x[axis]).sum::<f64>() / count)
}

/// A spring bond.
pub fn spring(a: u32, b: u32, rest_length: f64, stiffness: f64, damping: f64) -> Bond {
    let kind = BondKind::Spring { stiffness, damping };
    Bond { kind, ..Bond::new(PointId(a), PointId(b), rest_length) }
}

/// Two rings with spokes and one diagonal a sector, at rest, masses 1.
pub fn rim(sectors: u32, kind: BondKind) -> Model<2> {
    let mut model = Model::<2>::default();
    for radius in [2.0, 1.8] {
        for i in 0..sectors {
            let angle = std::f64::consts::TAU * f64::from(i) / f64::from(sectors);
            model.position.push([radius * angle.cos(), radius * angle.sin()]);
        }
    }
    for i in 0..sectors {
        let (next, inner, inner_next) = ((i + 1) % sectors, i + sectors, (i + 1) % sectors + sectors);
        for (a, b) in [(i, next), (inner, inner_next), (i, inner), (i, inner_next)] {
            let [p, q] = [model.position[a as usize], model.position[b as usize]];
            let rest_length = (p[0] - q[0]).hypot(p[1] - q[1]);
            model.bonds.push(Bond { kind, ..Bond::new(PointId(a), PointId(b), rest_length) });
        }
    }
    model.velocity = vec![[0.0; 2]; model.position.len()];
    model.mass = vec![1.0; model.position.len()];
    model
}

/// Sum of m x / sum of m [m].
pub fn center_of_mass(sample: &Sample, mass: &[f64]) -> [f64; 3] {
    let total: f64 = mass.iter().sum();
    std::array::from_fn(|k| sample.position.iter().zip(mass).map(|(x, m)| m * x[k]).sum::<f64>() / total)
}

/// Sum of m v [kg m/s].
pub fn momentum(sample: &Sample, mass: &[f64]) -> [f64; 3] {
    std::array::from_fn(|k| sample.velocity.iter().zip(mass).map(|(v, m)| m * v[k]).sum())
}

/// Sum of m x cross v about the origin [kg m^2/s].
pub fn angular_momentum(sample: &Sample, mass: &[f64]) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for ((x, v), m) in sample.position.iter().zip(&sample.velocity).zip(mass) {
        sum[0] += m * (x[1] * v[2] - x[2] * v[1]);
        sum[1] += m * (x[2] * v[0] - x[0] * v[2]);
        sum[2] += m * (x[0] * v[1] - x[1] * v[0]);
    }
    sum
}
