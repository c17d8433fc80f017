//! The keys of what is drawn beside a scene: the same start by another method, or under keys of its own.
//!
//! What an entry says stands in place of what the scene says; points, the mouse and all that commands name by numbers are the same in both.

use super::bonds::BondList;
use super::macros::object;
use super::method::{MethodKeys, SolverName, of_time};
use super::scene::Scene;
use super::surroundings::{BoundsKeys, WindKeys};
use super::vector::Vector;

object! {
    /// The same start by another method, or under keys of its own, drawn beside the scene.
    #[derive(Default)]
    BesideKeys: "an entry of `beside`: an object with keys such as `title` and `method`" {
        optional {
            /// What stands above it: its method if not said, and what else is its own.
            title: String,
            /// In place of the scene's: as many explicit bonds, between the same points in the same order.
            bonds: BondList,
            /// In place of the scene's `[m/s^2]`.
            gravity: Vector,
            /// In place of the scene's `[1/s]`, >= 0.
            drag_rate: f64,
            /// In place of the scene's; still air has velocity 0.
            wind: WindKeys,
            /// In place of the scene's walls.
            bounds: BoundsKeys,
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
        let method = MethodKeys { solver: Some(solver), ..MethodKeys::default() };
        BesideKeys { method, ..BesideKeys::default() }
    }

    /// The keys of the scene that it has of its own, its method apart.
    pub(crate) fn own(&self) -> impl Iterator<Item = &'static str> {
        self.given().filter(|key| *key != "title")
    }

    /// What is said in words for a key that it may have of its own.
    pub(crate) fn in_words(key: &str) -> &str {
        match key {
            "drag_rate" => "drag",
            "bounds" => "walls",
            _ => key,
        }
    }

    /// Whether it has its own of a key of the scene.
    pub(crate) fn owns(&self, key: &str) -> bool {
        self.own().any(|own| own == key)
    }

    /// What stands above it: its title, else its method in these words and what else is its own.
    pub(crate) fn called(&self, method: impl FnOnce() -> String) -> String {
        self.title.clone().unwrap_or_else(|| {
            let own: Vec<&str> = self.own().map(BesideKeys::in_words).collect();
            let method = method();
            if own.is_empty() { method } else { format!("{method}, its own {}", own.join(", ")) }
        })
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
    /// The scene by the method and under the keys of an entry of its `beside`, alone.
    ///
    /// Its parameters stay behind: sliders are of the scene, and may name what the entry has otherwise.
    pub fn companion(&self, entry: &BesideKeys) -> Scene {
        let BesideKeys { title: _, bonds, gravity, drag_rate, wind, bounds, method } = entry;
        Scene {
            bonds: bonds.as_ref().unwrap_or(&self.bonds).clone(),
            gravity: gravity.or(self.gravity),
            drag_rate: drag_rate.or(self.drag_rate),
            wind: wind.as_ref().or(self.wind.as_ref()).cloned(),
            bounds: bounds.as_ref().or(self.bounds.as_ref()).cloned(),
            method: method.over(&self.method),
            parameters: Vec::new(),
            beside: Vec::new(),
            ..self.clone()
        }
    }

    /// What stands above an entry of its `beside`.
    pub fn companion_title(&self, entry: &BesideKeys) -> String {
        entry.called(|| entry.method.over(&self.method).title())
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
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

    #[test]
    fn what_an_entry_says_stands_in_place_of_the_scenes_and_all_else_is_the_scenes() {
        let text = r#"{"wobble": 1, "points": {"position": [[0, 0], [1, 0]], "pinned": [0]}, "gravity": [0, -1], "drag_rate": 0.5,
            "bonds": [{"a": 0, "b": 1, "kind": "spring", "stiffness": 4}], "mouse": {"strength": 3, "radius": 1},
            "bounds": {"min": [-3, -3], "max": [3, 3]},
            "parameters": [{"path": "bonds[0].stiffness", "min": 1, "max": 9}],
            "beside": [{"bonds": [{"a": 0, "b": 1}], "wind": {"velocity": [2, 0]}, "drag_rate": 2}]}"#;
        let scene = Scene::parse(text, "x.json").unwrap();
        let entry = &scene.beside[0];
        let other = scene.companion(entry);
        assert_eq!(
            (other.drag_rate, other.wind.as_ref(), other.bonds.get(0).kind),
            (Some(2.0), entry.wind.as_ref(), None)
        );
        assert_eq!((&other.points, other.gravity, &other.mouse), (&scene.points, scene.gravity, &scene.mouse));
        assert_eq!(
            (&other.bounds, other.parameters.len()),
            (&scene.bounds, 0),
            "a slider for springs has no bond here"
        );
        assert_eq!(scene.companion_title(entry), "auto, its own bonds, drag, wind");
        assert_eq!(entry.own().collect::<Vec<_>>(), ["bonds", "drag_rate", "wind"]);
        assert!(entry.owns("wind") && !entry.owns("gravity") && !entry.owns("method"));
        assert_eq!(Scene::parse(&scene.to_json().unwrap(), "y.json").unwrap(), scene);
    }
}
