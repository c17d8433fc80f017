//! The keys of what is drawn beside a scene: the same start by another method.

use super::macros::object;
use super::method::{MethodKeys, SolverName, of_time};
use super::scene::Scene;

object! {
    /// The same start by another method, drawn beside the scene.
    #[derive(Default)]
    BesideKeys: "an entry of `beside`: an object with the keys `title` and `method`" {
        optional {
            /// What stands above it: its method if not said.
            title: String,
        }
        beside {
            /// What is different from the method of the scene.
            #[serde(default, skip_serializing_if = "MethodKeys::is_empty")]
            method: MethodKeys,
        }
    }
}

impl BesideKeys {
    /// The same start by a solver.
    pub fn by(solver: SolverName) -> Self {
        BesideKeys { title: None, method: MethodKeys { solver: Some(solver), ..MethodKeys::default() } }
    }
}

impl MethodKeys {
    /// These keys where they are said, else those of `base`. A solver that is said takes the loop of a source away.
    pub fn over(&self, base: &MethodKeys) -> MethodKeys {
        let source = if self.solver.is_some() { self.source } else { self.source.or(base.source) };
        MethodKeys {
            solver: self.solver.or(base.solver),
            source,
            substep: self.substep.or(base.substep),
            iterations: self.iterations.or(base.iterations),
            order: self.order.or(base.order),
            seed: self.seed.or(base.seed),
            precision: self.precision.or(base.precision),
            tolerance: self.tolerance.or(base.tolerance),
            max_strain: self.max_strain.or(base.max_strain),
            budget: self.budget.or(base.budget),
            sleep: self.sleep.or(base.sleep),
            settle: self.settle.or(base.settle),
            ledger: self.ledger.or(base.ledger),
        }
    }

    /// The method in a few words: solver, source, substep.
    pub fn title(&self) -> String {
        let solver = self.solver.unwrap_or(SolverName::Auto);
        let source = self.source.map_or_else(String::new, |source| format!(" {source}"));
        let substep = self.substep.map_or_else(String::new, |substep| format!(", h = {}", of_time(substep)));
        format!("{solver}{source}{substep}")
    }
}

impl Scene {
    /// The scene by the method of an entry of its `beside`, alone.
    pub fn companion(&self, entry: &BesideKeys) -> Scene {
        Scene { method: entry.method.over(&self.method), beside: Vec::new(), ..self.clone() }
    }

    /// What stands above an entry of its `beside`.
    pub fn companion_title(&self, entry: &BesideKeys) -> String {
        entry.title.clone().unwrap_or_else(|| entry.method.over(&self.method).title())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::SourceName;

    #[test]
    fn what_an_entry_leaves_out_is_the_scenes_but_for_a_source() {
        let base = MethodKeys {
            solver: Some(SolverName::AsPrinted),
            source: Some(SourceName::Spring),
            substep: Some(0.02),
            seed: Some(7),
            ..MethodKeys::default()
        };
        let by = BesideKeys::by(SolverName::Verlet).method.over(&base);
        assert_eq!((by.source, by.substep, by.seed), (None, Some(0.02), Some(7)));
        assert_eq!([base.title(), by.title()], ["as-printed 003, h = 20 ms", "verlet, h = 20 ms"]);
        let finer = MethodKeys { substep: Some(0.125), ..MethodKeys::default() }.over(&base);
        assert_eq!(finer.title(), "as-printed 003, h = 0.125 s");
        assert_eq!([finer.words(), by.words()], ["as printed: springs, steps of 0.125 s", "Verlet, steps of 20 ms"]);
    }
}
