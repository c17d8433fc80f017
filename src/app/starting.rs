//! A click that starts a motion anew where it is, in scenes that say so: of their oscillators, by each method.

use glam::DVec2;

use crate::history::{Do, Factors, MoveKeys, SetKeys, VectorOrEach};
use crate::scene::{Scene, Vector};

/// All worlds side by side have the point there then, wherever theirs was: what is left of the way to it, as a share `[1]`.
const LEFT: f64 = 1e-12;

/// What puts the point that a scene starts by a click at a place `[m]`: its velocity turns and grows with its place about the origin, as it was
/// given. `None`: the scene has no such point.
pub(super) fn start(scene: &Scene, at: DVec2) -> Option<Vec<Do>> {
    let point = scene.click_start?;
    let points = scene.points.as_ref()?;
    let flat = |list: &[Vector]| match list.get(point as usize) {
        Some(Vector::Plane(x)) => Some(DVec2::from_array(*x)),
        _ => None,
    };
    let place = flat(&points.position)?;
    let velocity = points.velocity.as_deref().and_then(flat).unwrap_or_default();
    // As complex numbers: the velocity by the place, times the new one.
    let turned = DVec2::new(place.x, -place.y).rotate(velocity) / place.length_squared();
    let velocity = turned.rotate(at);
    let put = MoveKeys {
        points: vec![point],
        about: Some(Vector::Plane(at.to_array())),
        scale: Some(Factors::One(LEFT)),
        ..MoveKeys::default()
    };
    let throw = SetKeys {
        points: Some(vec![point]),
        velocity: Some(VectorOrEach::One(Vector::Plane(velocity.to_array()))),
        ..SetKeys::default()
    };
    let is_finite = velocity.is_finite() && at.is_finite();
    is_finite.then(|| vec![Do::Move(Box::new(put)), Do::Set(Box::new(throw))])
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;
    use crate::history::{History, Start};
    use crate::scene::gallery;

    #[test]
    fn a_click_starts_an_orbit_by_all_methods_and_is_undone() {
        let entry = gallery().iter().find(|entry| entry.name == "phase-portrait").unwrap();
        let scene = entry.scene().unwrap();
        let mut history = History::new(Start::from(scene.clone())).unwrap();
        (0..20).for_each(|_| history.step());
        let at = DVec2::new(-1.2, 0.5);
        let before = history.world().positions().get(0);
        history.give(start(&scene, at).unwrap(), Some("start")).unwrap();
        let sample = history.world().sample(history.world().time());
        let first = |list: &[[f64; 3]]| DVec2::new(list[0][0], list[0][1]);
        assert!((first(&sample.position) - at).length() < 1e-9);
        // Along the arrows of the field.
        assert!((first(&sample.velocity) - DVec2::new(at.y, -at.x)).length() < 1e-9);
        let turn = (std::f64::consts::TAU / 0.1).round() as usize;
        (0..turn).for_each(|_| history.step());
        let x = history.world().positions();
        let back = DVec2::new(x.get(0), x.get(1));
        assert!((back - at).length() < 0.05 * at.length(), "round a closed orbit: {back}");
        history.undo().unwrap();
        assert!((history.world().positions().get(0) - before).abs() < 1e-9);
    }

    #[test]
    fn other_scenes_have_none() {
        for entry in gallery().iter().filter(|entry| entry.name != "phase-portrait") {
            assert_eq!(entry.scene().unwrap().click_start, None, "{}", entry.name);
        }
        let none = gallery()[0].scene().unwrap();
        assert_eq!(start(&none, DVec2::ZERO), None);
    }
}
