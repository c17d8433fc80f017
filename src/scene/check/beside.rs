//! The keys of what is drawn beside a scene.

use super::super::error::{Fault, Within};
use super::super::keys::{BesideKeys, BondList, Scene, SolverName};
use super::super::support;
use super::check_method;

/// So many are drawn beside a scene at most: more would be too small to be compared.
pub(crate) const MOST_BESIDE: usize = 5;

/// Errors: too many entries; a title of no letters; bonds between other points than the scene's; keys or a method that the form excludes, or
/// by which the scene cannot be run.
pub(super) fn check(scene: &Scene) -> Result<(), Fault> {
    if scene.beside.len() > MOST_BESIDE {
        let message = format!("has {} entries: there is room for {MOST_BESIDE} beside a scene", scene.beside.len());
        return Err(Fault::invalid(message));
    }
    // What is wrong with the scene itself is said of it.
    let is_fine = !scene.beside.is_empty() && can_run(scene).is_ok();
    for (i, entry) in scene.beside.iter().enumerate() {
        if entry.title.as_ref().is_some_and(|title| title.trim().is_empty()) {
            return Err(Fault::invalid("is empty: give it words, or leave it out").at("title").item(i));
        }
        let title = scene.companion_title(entry);
        check_method(&entry.method).map_err(|fault| fault.at("method").of(&title)).item(i)?;
        if let Some(bonds) = &entry.bonds {
            same_ends(bonds, &scene.bonds).at("bonds").map_err(|fault| fault.of(&title)).item(i)?;
        }
        if is_fine {
            let other = scene.companion(entry);
            if entry.own().next().is_some() {
                check_own(entry, &other).map_err(|fault| fault.of(&title)).item(i)?;
            }
            can_run(&other).map_err(|fault| fault.elsewhere().of(&title)).item(i)?;
        }
    }
    Ok(())
}

/// Commands name bonds by their numbers, which must mean the same in both worlds.
///
/// Errors: another number of bonds, or one between other points.
fn same_ends(bonds: &BondList, scene: &BondList) -> Result<(), Fault> {
    if bonds.len() != scene.len() {
        let message =
            format!("has {}, where the scene lists {}: give one for each", count(bonds.len()), count(scene.len()));
        return Err(Fault::invalid(message));
    }
    match (0..bonds.len()).find(|&k| bonds.ends(k) != scene.ends(k)) {
        None => Ok(()),
        Some(k) => {
            let ([a, b], [c, d]) = (bonds.ends(k), scene.ends(k));
            let message = format!("joins points {a} and {b}, where the scene's joins {c} and {d}: give these");
            Err(Fault::invalid(message)).item(k)
        }
    }
}

fn count(bonds: usize) -> String {
    if bonds == 1 { "1 bond".to_owned() } else { format!("{bonds} bonds") }
}

/// Errors: what the form excludes of the scene under the keys of an entry; where these are at fault it is said at their place.
fn check_own(entry: &BesideKeys, other: &Scene) -> Result<(), Fault> {
    let is_of_entry = |fault: &Fault| entry.own().any(|key| fault.is_in(key));
    super::check(other).map_err(|fault| if is_of_entry(&fault) { fault } else { fault.elsewhere() })
}

fn can_run(scene: &Scene) -> Result<(), Fault> {
    support::check(scene).and_then(|()| support::method(scene).map(|_| ()))
}

impl Scene {
    /// Why each of some solvers cannot run the scene, in words without its keys; `None` where it can, or where the scene cannot be run anyway.
    pub fn misfits(&self, solvers: &[SolverName]) -> Vec<Option<String>> {
        let mut scene = Scene { beside: Vec::new(), ..self.clone() };
        if can_run(&scene).is_err() {
            return vec![None; solvers.len()];
        }
        let why = |solver: &SolverName| {
            scene.method = BesideKeys::by(*solver).method.over(&self.method);
            can_run(&scene).err().map(plain)
        };
        solvers.iter().map(why).collect()
    }
}

/// What a fault says, without the place in the file and without the cure there.
fn plain(fault: Fault) -> String {
    let is_of_bonds = fault.is_in("bonds");
    let said = fault.message();
    let what = said.split(": ").next().unwrap_or(said).replace('`', "");
    match () {
        () if what.starts_with("relaxed bonds need") => {
            "it needs steps and sweeps of a length and a number that the scene does not say".to_owned()
        }
        () if is_of_bonds => format!("a bond {what}"),
        () => what,
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::super::super::keys::{BesideKeys, SolverName};
    use crate::scene::Scene;

    fn read(beside: &str, rest: &str) -> Result<Scene, String> {
        let text = format!(
            r#"{{"wobble": 1, "points": {{"position": [[0, 0], [1, 0]]}}, "bonds": [{{"a": 0, "b": 1, "kind": "relaxed"}}],
            "method": {{"solver": "velocity-verlet", "substep": 0.01, "iterations": 2}}, "beside": {beside}{rest}}}"#
        );
        Scene::parse(&text, "x.json").map_err(|error| error.to_string())
    }

    #[test]
    fn entries_are_read_and_written_back() {
        let scene = read(r#"[{"title": "finer", "method": {"substep": 0.001}}, {}]"#, "").unwrap();
        assert_eq!(Scene::parse(&scene.to_json().unwrap(), "y.json").unwrap(), scene);
        let titles: Vec<String> = scene.beside.iter().map(|entry| scene.companion_title(entry)).collect();
        assert_eq!(titles, ["finer", "velocity-verlet, h = 10 ms"]);
        let alone = scene.companion(&scene.beside[0]);
        assert_eq!((alone.method.solver, alone.method.substep), (scene.method.solver, Some(0.001)));
        assert!(alone.beside.is_empty());
    }

    #[test]
    fn solvers_that_cannot_run_a_scene_are_told_with_the_reason_in_plain_words() {
        use SolverName::{Auto, Relaxation, Rk4, Verlet};
        let relaxed = read("[]", "").unwrap();
        let why = relaxed.misfits(&[Auto, Verlet, Rk4]);
        assert_eq!(why[..2], [None, None]);
        assert_eq!(why[2].as_deref(), Some("a bond is relaxed, which solver rk4 refuses"));
        let discs = r#"{"wobble": 1, "contact": true, "bodies": [{"make": "disc", "radius": 1, "spacing": 0.5}]}"#;
        let meet = Scene::parse(discs, "x.json").unwrap();
        let why = meet.misfits(&[Auto, Rk4, Relaxation]);
        assert_eq!([&why[0], &why[1]], [&None, &Some("solver rk4 knows no contact".to_owned())]);
        let alone = Scene { contact: None, ..meet };
        assert!(alone.misfits(&[Relaxation])[0].as_deref().is_some_and(|why| !why.contains(['`', ':'])));
        for (solver, why) in [Auto, Verlet, Rk4].into_iter().zip(relaxed.misfits(&[Auto, Verlet, Rk4])) {
            let beside = Scene { beside: vec![BesideKeys::by(solver)], ..relaxed.clone() };
            assert_eq!(beside.check().is_err(), why.is_some(), "{solver}");
        }
    }

    #[test]
    fn what_cannot_stand_beside_a_scene_is_refused_with_its_title() {
        let said = |beside: &str| read(beside, "").unwrap_err();
        let many = format!("[{}]", ["{}"; 6].join(","));
        assert!(said(&many).ends_with("beside: has 6 entries: there is room for 5 beside a scene"), "{}", said(&many));
        assert!(said(r#"[{}, {"title": " "}]"#).contains("beside[1].title: is empty"));
        let wrong = said(r#"[{"title": "mine", "method": {"substep": -1}}]"#);
        assert!(wrong.contains("beside[0].method.substep: `mine`: "), "{wrong}");
        let springs_only = said(r#"[{"title": "mine", "method": {"solver": "rk4"}}]"#);
        assert!(springs_only.contains("beside[0]: `mine`: bonds[0]: is relaxed"), "{springs_only}");
        let swept = said(r#"[{"method": {"solver": "as-printed"}}]"#);
        assert!(swept.contains("beside[0]: `as-printed, h = 10 ms`: method.solver: "), "{swept}");
        assert!(said(r#"[{"method": {"solver": "rk5"}}]"#).contains("beside[0].method.solver"));
        assert!(said(r#"[{"name": "x"}]"#).contains("beside[0].name"));
        let two = said(r#"[{"title": "mine", "bonds": [{"a": 0, "b": 1}, {"a": 0, "b": 1}]}]"#);
        let message = "beside[0].bonds: `mine`: has 2 bonds, where the scene lists 1 bond: give one for each";
        assert!(two.ends_with(message), "{two}");
        let turned = said(r#"[{"title": "mine", "bonds": [{"a": 1, "b": 0}]}]"#);
        assert!(
            turned.contains("beside[0].bonds[0]: `mine`: joins points 1 and 0, where the scene's joins 0 and 1"),
            "{turned}"
        );
        let wrong = said(r#"[{"bonds": [{"a": 0, "b": 1, "kind": "spring", "stiffness": -1}]}]"#);
        assert!(wrong.contains("beside[0].bonds[0].stiffness: "), "{wrong}");
        assert!(said(r#"[{}, {"drag_rate": -1}]"#).contains("beside[1].drag_rate: "));
        assert!(said(r#"[{"wind": {"velocity": [1, 0, 0]}}]"#).contains("beside[0].wind.velocity: "));
        assert!(said(r#"[{"points": {"position": [[0, 0]]}}]"#).contains("beside[0].points: unknown key"));
        let wrong = read("[{}]", r#", "contact": true"#).unwrap().model::<2>().unwrap_err().to_string();
        assert!(wrong.contains("method.solver: ") && !wrong.contains("beside"), "the scene's own fault: {wrong}");
    }
}
