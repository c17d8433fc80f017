//! What of a scene may be to blame, read off its keys.

use super::subject::Cause;
use crate::history::{Do, Recording};
use crate::scene::{BodyKeys, KindName, Material, Scene, Vector};

/// Speed from which a start is fast `[m/s]`.
const FAST: f64 = 20.0;
/// Gravity from which a scene is heavy `[m/s^2]`.
const HEAVY: f64 = 100.0;
/// Oscillations from which springs are stiff `[rad/s]`.
const STIFF: f64 = std::f64::consts::TAU * 1000.0;
/// Speed from which a cursor on a track is in another place in every frame `[m/s]`.
const WILD: f64 = 60.0;

/// The causes of a scene, ascending.
pub(super) fn of(recording: &Recording) -> Vec<Cause> {
    let scene = &recording.scene;
    let speed = |v: &Option<Vector>| v.is_some_and(|v| length(&v) >= FAST);
    let thrown = scene.points.iter().filter_map(|points| points.velocity.as_ref()).flatten().any(|v| length(v) >= FAST);
    let is_elastic = |e: Option<f64>| e.is_some_and(|e| e >= 1.0);
    let elastic = scene.bounds.iter().map(|bounds| bounds.restitution);
    let mut elastic = elastic.chain(scene.obstacles.iter().map(|obstacle| obstacle.restitution));
    let tracked = scene.mouse.as_ref().filter(|mouse| !mouse.track.is_empty());
    let wild = tracked.is_some_and(|mouse| fastest(&mouse.track.iter().map(|row| row.0).collect::<Vec<_>>()) >= WILD);
    let bends =
        |body: &BodyKeys| body.material.as_ref().and_then(|material| material.bending).is_some_and(|ei| ei > 0.0);
    let list = [
        (Cause::Walls, scene.bounds.is_some()),
        (Cause::Planes, scene.obstacles.iter().any(|obstacle| obstacle.plane.is_some())),
        (
            Cause::Polygons,
            scene.obstacles.iter().any(|obstacle| obstacle.polygon.is_some() || obstacle.r#box.is_some()),
        ),
        (Cause::Circles, scene.obstacles.iter().any(|obstacle| obstacle.circle.is_some())),
        (Cause::Pictures, scene.obstacles.iter().any(|obstacle| obstacle.picture.is_some())),
        (Cause::Mouse, (tracked.is_some() && !wild) || has_cursor(recording)),
        (Cause::WildMouse, wild),
        (Cause::LedPins, !scene.pin_motion.is_empty()),
        (Cause::Commands, !recording.commands.is_empty()),
        (Cause::Forces, !scene.forces.is_empty()),
        (Cause::Wind, scene.wind.is_some()),
        (Cause::Rigid, has_kind(scene, KindName::Rigid)),
        (Cause::Stiff, stiffest(scene) >= STIFF),
        (Cause::Relaxed, has_kind(scene, KindName::Relaxed)),
        (Cause::Heavy, scene.gravity.is_some_and(|g| length(&g) >= HEAVY)),
        (Cause::Fast, thrown || scene.bodies.iter().any(|body| speed(&body.velocity))),
        (Cause::Elastic, elastic.any(is_elastic)),
        (Cause::Bending, !scene.angles.is_empty() || scene.bodies.iter().any(bends)),
        (Cause::Areas, scene.areas.is_some_and(|areas| areas.kind.is_some() || areas.stiffness.is_some())),
        (Cause::Contact, scene.contact.is_some()),
    ];
    list.into_iter().filter(|(_, is_there)| *is_there).map(|(cause, _)| cause).collect()
}

fn length(vector: &Vector) -> f64 {
    vector.components().iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// The speed of the fastest stretch `[m/s]`.
fn fastest(track: &[[f64; 3]]) -> f64 {
    let speed = |pair: &[[f64; 3]]| {
        let ([t0, x0, y0], [t1, x1, y1]) = (pair[0], pair[1]);
        ((x1 - x0).powi(2) + (y1 - y0).powi(2)).sqrt() / (t1 - t0)
    };
    track.windows(2).map(speed).fold(0.0, f64::max)
}

fn has_cursor(recording: &Recording) -> bool {
    recording.scene.mouse.is_some() && recording.commands.iter().any(|entry| matches!(entry.act, Do::Cursor { .. }))
}

/// The kind that bonds of a material have.
fn kind(material: Option<&Material>) -> KindName {
    material.and_then(|material| material.kind).unwrap_or(KindName::Rigid)
}

fn has_kind(scene: &Scene, wanted: KindName) -> bool {
    let in_bonds = scene.bonds.iter().any(|bond| bond.kind.unwrap_or(KindName::Rigid) == wanted);
    let has_bonds = |make: crate::scene::MakerName| make != crate::scene::MakerName::Points;
    in_bonds || scene.bodies.iter().any(|body| has_bonds(body.make) && kind(body.material.as_ref()) == wanted)
}

/// The fastest swing that a spring of it may have `[rad/s]`, by its stiffness on two of its points' masses.
fn stiffest(scene: &Scene) -> f64 {
    let mass = |scene: &Scene| match scene.points.as_ref().and_then(|points| points.mass.clone()) {
        Some(crate::scene::MassKeys::Same(mass)) => mass,
        Some(crate::scene::MassKeys::Each(masses)) => masses.into_iter().fold(f64::INFINITY, f64::min),
        None => 1.0,
    };
    let own = scene.bonds.iter().filter_map(|bond| bond.stiffness).fold(0.0, f64::max) / mass(scene);
    let of_body = |material: &Material| {
        let stiffness = material.stiffness.or(material.young).unwrap_or(0.0);
        // A body shares its mass among points of which there are some hundred.
        stiffness / material.point_mass.or(material.mass.map(|mass| mass / 100.0)).unwrap_or(1.0)
    };
    let bodies = scene.bodies.iter().filter_map(|body| body.material.as_ref()).map(of_body);
    (2.0 * bodies.fold(own, f64::max)).sqrt()
}
