//! Lessons: every file is in order, and every number that a lesson claims is measured.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use wobble::lessons::{Claim, Lesson, LessonError, Measure, Plot, Quantity, files, lessons};

#[test]
fn every_file_is_a_lesson_whose_scenes_open_with_the_points_that_are_plotted() {
    for (name, text) in files() {
        let lesson = Lesson::parse(name, text).unwrap_or_else(|error| panic!("{error}"));
        for (number, step) in lesson.steps.iter().enumerate() {
            let scene = lesson.scene(number).unwrap().unwrap_or_else(|error| panic!("{error}"));
            let own = if step.patch.is_some() { format!("{name}-{}", number + 1) } else { step.scene.clone() };
            assert_eq!(scene.name(), own);
            let world = scene.world(scene.duration).unwrap_or_else(|error| panic!("{error}"));
            let (count, bonds) = (world.point_count() as u32, world.bonds().len() as u32);
            let (probes, count) = match &step.plot {
                Some(Plot::Probes { points, .. }) => (points.clone(), count),
                Some(Plot::Phase { points, .. }) => (points.to_vec(), count),
                Some(Plot::Bonds { bonds: probed, .. }) => (probed.clone(), bonds),
                Some(Plot::Angle { points }) => (points[1..].to_vec(), count),
                Some(Plot::Energies | Plot::Strain) | None => (Vec::new(), count),
            };
            assert!(probes.len() <= 2 && probes.iter().all(|&point| point < count), "{own}: {probes:?} of {count}");
            let is_error = matches!(step.plot, Some(Plot::Probes { quantity: Quantity::Error, .. }));
            assert!(!is_error || !scene.beside.is_empty(), "{own}: there is nothing beside it to be off from");
        }
    }
    assert_eq!(lessons().len(), files().len());
}

/// Whether a plot shows what a claim is of: counts of points have no curve.
fn shows(plot: &Plot, claim: &Claim) -> bool {
    let is_of = |quantities: &[Quantity]| match plot {
        Plot::Probes { quantity, .. } | Plot::Phase { quantity, .. } => quantities.contains(quantity),
        _ => false,
    };
    match claim.measure {
        Measure::Points => false,
        Measure::EnergyRatio { .. } | Measure::EnergySpan { .. } => *plot == Plot::Energies,
        Measure::Error { .. } | Measure::ErrorRatio { .. } => is_of(&[Quantity::Error]),
        Measure::StepErrorRatio { .. } | Measure::Moved { .. } => is_of(&[Quantity::X, Quantity::Y]),
        Measure::Speed { .. } => is_of(&[Quantity::Speed]),
        Measure::Lowest { .. } => is_of(&[Quantity::Y]),
        Measure::Strain { .. } | Measure::PeakStrain { .. } => *plot == Plot::Strain,
        Measure::LeastAngle { .. } | Measure::GreatestAngle { .. } => matches!(plot, Plot::Angle { .. }),
    }
}

#[test]
fn every_step_plots_something_that_it_claims() {
    for lesson in lessons() {
        for (number, step) in lesson.steps.iter().enumerate() {
            let is_shown = step.plot.as_ref().is_some_and(|plot| step.claims.iter().any(|claim| shows(plot, claim)));
            assert!(is_shown, "{}-{}: {:?}", lesson.name, number + 1, step.plot);
        }
    }
}

#[test]
fn what_is_claimed_is_measured() {
    let mut count = 0;
    for lesson in lessons() {
        for (number, step) in lesson.steps.iter().enumerate() {
            let scene = lesson.scene(number).unwrap().unwrap();
            for claim in &step.claims {
                let place = format!("{}-{}: {}", lesson.name, number + 1, claim.words);
                let measured = claim.measure.of(&scene).unwrap_or_else(|error| panic!("{place}: {error}"));
                assert!(claim.holds(measured), "{place}: {measured} instead of {}", claim.expected);
                assert!(says(claim), "{place}: says no number like {}", claim.expected);
                count += 1;
            }
        }
    }
    assert!(count >= 30, "{count} claims");
}

/// Whether the words have a number, or one of per cent, that is what is expected, as exactly as it is printed.
fn says(claim: &Claim) -> bool {
    let words: Vec<&str> = claim.words.split_whitespace().collect();
    words.iter().zip(words.iter().skip(1).chain([&""])).any(|(word, next)| {
        let Ok(value) = word.parse::<f64>() else { return false };
        let digits = word.split_once('.').map_or(0, |(_, digits)| digits.len());
        let printed = if word.contains('e') { 0.0 } else { 0.5 * 0.1_f64.powi(digits as i32) };
        let unit = if *next == "%" { 0.01 } else { 1.0 };
        (value * unit - claim.expected).abs() <= claim.within * (1.0 + 1e-9) + printed * unit
    })
}

#[test]
fn what_is_wrong_with_a_file_is_said() {
    let step = r#"{"heading": "h", "text": "t", "scene": "SCENE", "patch": PATCH, "try": "t", "see": "s"}"#;
    let lesson = |scene: &str, patch: &str, count: usize| {
        let steps = vec![step.replace("SCENE", scene).replace("PATCH", patch); count].join(",");
        let text = format!(r#"{{"title": "t", "about": "a", "source": "s", "steps": [{steps}]}}"#);
        Lesson::parse("mine", &text)
    };
    let said = |error: LessonError| error.to_string();
    assert!(lesson("rope", "null", 3).unwrap().scene(3).is_none());
    assert_eq!(said(lesson("rope", "null", 2).unwrap_err()), "mine.json: steps: there are 2: write 3 to 6");
    let error = lesson("rpoe", "null", 3).unwrap().scene(1).unwrap().unwrap_err();
    assert_eq!(said(error), "mine.json: steps[1].scene: the gallery has no `rpoe`: `wobble scenes` lists them");
    let error = said(lesson("rope", r#"{"method": {"solver": "rk5"}}"#, 3).unwrap().scene(0).unwrap().unwrap_err());
    assert!(error.starts_with("mine-1.json:1: method.solver: "), "{error}");
    let error = said(Lesson::parse("mine", r#"{"title": "t", "abuot": "a"}"#).unwrap_err());
    assert!(error.starts_with("mine.json: unknown field `abuot`") && error.contains("line 1"), "{error}");
    let scene = lesson("rope", "null", 3).unwrap().scene(0).unwrap().unwrap();
    let measure = |text: &str| serde_json::from_str::<Measure>(text).unwrap().of(&scene);
    let error = said(measure(r#"{"what": "moved", "point": 1000, "time": 0.01}"#).unwrap_err());
    assert_eq!(error, "the scene has no point 1000: it has 1000");
    let error = said(measure(r#"{"what": "error-ratio", "point": 1, "time": 0.01}"#).unwrap_err());
    assert!(error.starts_with("the order of a method shows with its substep"), "{error}");
}
