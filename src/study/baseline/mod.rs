//! The baseline: the method that the tutorials of this field share, as a plain program of its own.
//!
//! Model: x' = 2x - x_prev + a h^2, started with x_prev = x - v h; springs, dampers, drag and the mouse as
//! accelerations, velocities as backward differences (x - x_prev)/h; then rigid bonds in a fixed number of sweeps along
//! their present direction, listed or shuffled; then points behind a wall are put on it and turned round.
//! Accuracy: first order, for its start is half a step off and its sweeps turn with the bonds.
//!
//! It shares no code with the simulation, so that it stays what it is while that gets better.

mod program;
mod read;

use std::time::Instant;

use crate::scene::Scene;
use crate::study::problems::Truth;
use crate::study::run::{Run, Work, median_seconds};
use program::Program;

/// Sweeps over the rigid bonds, each a variant.
const SWEEPS: [u32; 5] = [1, 4, 15, 50, 200];

/// How the rigid bonds are swept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Variant {
    /// Sweeps in a step; 0 where there is no rigid bond.
    pub sweeps: u32,
    /// Whether the bonds are shuffled anew for every sweep instead of taken as listed.
    pub is_shuffled: bool,
}

impl Variant {
    /// In words.
    pub(super) fn label(&self) -> String {
        match (self.sweeps, self.is_shuffled) {
            (0, _) => "sources' method".to_owned(),
            (1, false) => "sources' method, 1 sweep".to_owned(),
            (1, true) => "sources' method, 1 sweep, shuffled".to_owned(),
            (n, false) => format!("sources' method, {n} sweeps"),
            (n, true) => format!("sources' method, {n} sweeps, shuffled"),
        }
    }
}

/// A scene as the baseline runs it.
#[derive(Clone, Debug)]
pub(super) enum Baseline {
    /// In the plane.
    Plane(Program<2>),
    /// In space.
    Space(Program<3>),
}

impl Baseline {
    /// The baseline of a scene.
    ///
    /// Errors: what the sources' method does not have, in words.
    pub(super) fn new(scene: &Scene) -> Result<Self, String> {
        Ok(if scene.dimensions() == 2 {
            Baseline::Plane(read::program(scene)?)
        } else {
            Baseline::Space(read::program(scene)?)
        })
    }

    /// All ways to run it: the cheapest of them at an error is the baseline there.
    pub(super) fn variants(&self) -> Vec<Variant> {
        let rods = match self {
            Baseline::Plane(program) => program.rigid_bonds(),
            Baseline::Space(program) => program.rigid_bonds(),
        };
        let each = |is_shuffled: bool| SWEEPS.map(|sweeps| Variant { sweeps, is_shuffled });
        match rods {
            0 => vec![Variant { sweeps: 0, is_shuffled: false }],
            // One bond has one order.
            1 => each(false).to_vec(),
            _ => [each(false), each(true)].concat(),
        }
    }

    /// Runs it in `steps` equal steps, which the samples of the truth divide evenly.
    pub(super) fn run(&self, variant: Variant, truth: &Truth, steps: u64) -> Run {
        match self {
            Baseline::Plane(program) => run(program, variant, truth, steps),
            Baseline::Space(program) => run(program, variant, truth, steps),
        }
    }
}

fn run<const D: usize>(start: &Program<D>, variant: Variant, truth: &Truth, steps: u64) -> Run {
    let end = truth.samples.last().map_or(0.0, |sample| sample.t);
    let h = end / steps as f64;
    let every = steps / truth.samples.len() as u64;
    let mut errors = Vec::new();
    let begun = Instant::now();
    let mut program = start.start(h, variant);
    for sample in &truth.samples {
        program.run(every);
        errors.push(sample.error(&program.positions()));
    }
    // Looking at it on the way costs a long run next to nothing.
    let first = begun.elapsed().as_secs_f64();
    let seconds = median_seconds(first, || {
        let mut again = start.start(h, variant);
        let begun = Instant::now();
        again.run(steps);
        std::hint::black_box(&again);
        begun.elapsed().as_secs_f64()
    });
    let (points, bonds) = start.size();
    let bonds_solved = match variant.sweeps {
        0 => steps * bonds,
        n => steps * bonds * u64::from(n),
    };
    Run {
        steps,
        substep: h,
        seconds,
        cost: seconds / end,
        error: errors.last().copied().unwrap_or(f64::INFINITY),
        largest_error: errors.iter().copied().fold(0.0, f64::max),
        energy_drift: None,
        work: Work {
            substeps: steps,
            bonds_solved,
            points_moved: steps * points,
            iterations: steps * u64::from(variant.sweeps),
            ..Work::default()
        },
    }
}

#[cfg(test)]
mod tests;
