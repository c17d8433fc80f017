//! What one sweep over the bonds costs, by what a body is made of, beside the plain program in the same run.

use serde::Serialize;

use super::super::error::StudyError;
use super::clock::{in_turn, median};
use super::naive::{Naive, Number};
use super::run::{FRAME, paths, precision};
use super::scenes::{Hung, Shape};
use crate::sim::{Dynamics, InstructionSet, Method, Model, Precision, Solver, build};

/// The substep of sweeps `[s]`.
const SUBSTEP: f64 = FRAME / 16.0;
/// Sweeps of a substep that is compared with a substep of one.
const MANY: u32 = 9;
/// Strains that equal small bodies are held to, where sweeps of a substep cannot be asked for: one substep a frame, and
/// some dozens.
const LOOSE: f64 = 1e3;
const TIGHT: f64 = 1e-3;
/// Frames in which these settle.
const SETTLING: u32 = 40;

/// A row of `kernels.csv`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct KernelRow {
    /// What the body is.
    pub family: &'static str,
    /// Its points.
    pub points: usize,
    /// Its bonds.
    pub bonds: usize,
    /// `f32` or `f64`.
    pub precision: &'static str,
    /// The instruction set.
    pub instruction_set: &'static str,
    /// Threads that the process may use.
    pub threads: usize,
    /// How the program takes its bonds, in words.
    pub kernel: String,
    /// A sweep, a bond `[ns]`: the difference between a substep of nine sweeps and one of one, over eight. Of equal small
    /// bodies a substep with its integration, from frames of many substeps and of one.
    pub sweep_ns: f64,
    /// The rest of a step, a bond `[ns]`: integration, and the way from the order of the model and back. A difference of
    /// medians: where sweeps are dear, noise may leave less than 0.
    pub rest_ns: f64,
    /// A whole step with one sweep `[ms]`.
    pub step_ms: f64,
    /// A sweep of the plain program, a bond `[ns]`.
    pub naive_ns: f64,
    /// How many times quicker a sweep is than its.
    pub ratio: f64,
}

/// A kind of body in its sizes, of about a thousand points (somewhat more where fewer than 2,000 bonds would not count
/// as a large body), ten thousand, a hundred thousand and a million.
struct Family {
    name: &'static str,
    shapes: [Shape; 4],
}

const FAMILIES: [Family; 5] = [
    Family {
        name: "net",
        shapes: [
            Shape::Net(34, Hung::Row),
            Shape::Net(100, Hung::Row),
            Shape::Net(316, Hung::Row),
            Shape::Net(1_000, Hung::Row),
        ],
    },
    Family {
        name: "hard",
        shapes: [
            Shape::Hard(34, Hung::Row),
            Shape::Hard(100, Hung::Row),
            Shape::Hard(316, Hung::Row),
            Shape::Hard(1_000, Hung::Row),
        ],
    },
    Family {
        name: "rope",
        shapes: [Shape::Rope(2_100), Shape::Rope(10_000), Shape::Rope(100_000), Shape::Rope(1_000_000)],
    },
    Family {
        name: "rims",
        shapes: [Shape::Rims(8, 5), Shape::Rims(20, 20), Shape::Rims(80, 50), Shape::Rims(200, 200)],
    },
    Family {
        name: "disc",
        shapes: [Shape::Disc(1_000), Shape::Disc(10_000), Shape::Disc(100_000), Shape::Disc(1_000_000)],
    },
];

/// How many bodies there are to measure, up to a size (a place in [`Family::shapes`]).
pub(super) fn count(largest: usize) -> u64 {
    (FAMILIES.len() * (largest + 1)) as u64
}

/// Measures every kind of body up to a size, for about `seconds` `[s]` each, in both precisions, with each of some
/// instruction sets; `next` is told before each body. The chosen set is the one it was before.
///
/// Errors: a disc that cannot be meshed.
pub(super) fn measure(
    largest: usize,
    sets: &[InstructionSet],
    threads: usize,
    seconds: f64,
    next: &mut dyn FnMut(&str),
) -> Result<Vec<KernelRow>, StudyError> {
    let chosen = InstructionSet::chosen();
    let mut rows = Vec::new();
    for family in &FAMILIES {
        for shape in &family.shapes[..=largest] {
            next(&format!("sweeps: {}", family.name));
            let model = shape.model()?;
            let case = Case { family: family.name, model: &model, threads, seconds };
            rows.extend(case.measure::<f32>(Precision::F32, sets)?);
            rows.extend(case.measure::<f64>(Precision::F64, sets)?);
        }
    }
    chosen.choose();
    Ok(rows)
}

/// A body that is measured.
struct Case<'a> {
    family: &'static str,
    model: &'a Model<2>,
    threads: usize,
    seconds: f64,
}

impl Case<'_> {
    fn measure<F: Number>(&self, precision: Precision, sets: &[InstructionSet]) -> Result<Vec<KernelRow>, StudyError> {
        let mut worlds = self.worlds(precision)?;
        let mut naive = Naive::<F>::new(self.model, SUBSTEP);
        naive.advance();
        let available = sets.iter().filter(|set| set.choose());
        Ok(available.map(|&set| self.row(&mut worlds, &mut naive, set)).collect())
    }

    /// A world that sweeps once a step and one that sweeps often.
    fn worlds(&self, precision: Precision) -> Result<[Box<dyn Dynamics>; 2], StudyError> {
        let is_crowd = self.family == "rims";
        let method = |is_many: bool| match (is_crowd, is_many) {
            (true, false) => paths(LOOSE),
            (true, true) => paths(TIGHT),
            (false, _) => {
                let iterations = Some(if is_many { MANY } else { 1 });
                Method { solver: Solver::Xpbd, substep: Some(SUBSTEP), iterations, ..Method::default() }
            }
        };
        let world = |is_many| {
            let method = Method { precision, ..method(is_many) };
            build(&Model { method, ..self.model.clone() })
        };
        let mut worlds = [world(false)?, world(true)?];
        if is_crowd {
            (0..SETTLING).for_each(|_| worlds.iter_mut().for_each(|world| world.step()));
        }
        Ok(worlds)
    }

    /// With t = r + p s for a step of p sweeps, r and s follow from the two worlds.
    fn row<F: Number>(
        &self,
        [one, many]: &mut [Box<dyn Dynamics>; 2],
        naive: &mut Naive<F>,
        set: InstructionSet,
    ) -> KernelRow {
        let bonds = self.model.bonds.len();
        let (mut p_one, mut p_many) = (Vec::new(), Vec::new());
        let tasks: &mut [super::clock::Task<'_>] = &mut [
            &mut || p_one.push(sweeps_of_a_step(&mut **one, bonds)),
            &mut || p_many.push(sweeps_of_a_step(&mut **many, bonds)),
            &mut || naive.sweep(),
        ];
        let [t_one, t_many, t_naive] = medians(in_turn(self.seconds, tasks));
        let (p_one, p_many) = (median(p_one), median(p_many));
        let sweep = (t_many - t_one) / (p_many - p_one);
        let ns = 1e9 / bonds as f64;
        KernelRow {
            family: self.family,
            points: self.model.position.len(),
            bonds,
            precision: precision(&**one),
            instruction_set: set.name(),
            threads: self.threads,
            kernel: one.parts().first().map_or(String::new(), |part| part.kernel.clone()),
            sweep_ns: ns * sweep,
            rest_ns: ns * (t_one - p_one * sweep),
            step_ms: 1e3 * t_one,
            naive_ns: ns * t_naive,
            ratio: t_naive / sweep,
        }
    }
}

/// Takes a step; returns how many sweeps over all bonds it took.
fn sweeps_of_a_step(world: &mut dyn Dynamics, bonds: usize) -> f64 {
    let before = world.counters().bonds_solved;
    world.step();
    (world.counters().bonds_solved - before) as f64 / bonds as f64
}

fn medians<const N: usize>(readings: Vec<Vec<f64>>) -> [f64; N] {
    let mut each = readings.into_iter().map(median);
    std::array::from_fn(|_| each.next().unwrap_or(f64::NAN))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_of_body_is_moved_as_a_large_one() {
        let rows = measure(0, &[InstructionSet::best()], 1, 0.0, &mut |_| ()).unwrap();
        assert_eq!(rows.len(), 10);
        for row in &rows {
            assert!(!row.kernel.is_empty() && row.naive_ns > 0.0 && row.sweep_ns.is_finite(), "{row:?}");
        }
    }
}
