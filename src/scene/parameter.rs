//! Parameters: numbers of a scene that it names, with a range and a unit, to be set by sliders while it runs.

mod check;

use std::ops::{Range, RangeInclusive};
use std::sync::Arc;

use super::check::copies;
use super::keys::{ContactKeys, Meeting, ParameterKeys, Scene};
use super::start::Start;
use crate::body::Link;
pub(super) use check::check;

/// A number that sliders set.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// What it is called.
    pub label: String,
    /// Its unit; empty: none.
    pub unit: String,
    /// The ends of its range.
    pub range: RangeInclusive<f64>,
    /// What it is.
    pub target: Target,
}

/// What of a running world a parameter is.
#[derive(Clone, Debug, PartialEq)]
pub enum Target {
    /// A component of gravity `[m/s^2]`.
    Gravity(usize),
    /// Rate at which velocities decay `[1/s]`.
    DragRate,
    /// A component of the wind `[m/s]`.
    Wind(usize),
    /// Of the wind `[1]`.
    Turbulence,
    /// Of the walls `[1]`.
    WallFriction,
    /// Of the walls `[1]`.
    WallRestitution,
    /// Between bodies `[1]`.
    Friction,
    /// Between bodies `[1]`.
    Restitution,
    /// Of the push of the mouse `[1/s^2]`.
    MouseStrength,
    /// Of the push of the mouse `[m]`.
    MouseRadius,
    /// Of explicit springs, by their numbers `[N/m]`.
    Stiffness(RangeInclusive<u32>),
    /// Of explicit springs, by their numbers `[N s/m]`.
    Damping(RangeInclusive<u32>),
    /// Of explicit bonds, by their numbers `[m]`.
    Rest(RangeInclusive<u32>),
    /// Whether bodies meet: 0 or 1.
    Meets,
    /// What skins keep from the middle of their edges `[m]`.
    ContactRadius,
    /// Of obstacles, by their numbers `[1]`.
    ObstacleFriction(RangeInclusive<u32>),
    /// Of obstacles, by their numbers `[1]`.
    ObstacleRestitution(RangeInclusive<u32>),
    /// Of planes that push out what gets into them, by their numbers: which number, and both of each plane as they are `[N/m]`,
    /// `[N s/m]`; a command sets both.
    Penalty(RangeInclusive<u32>, OfPenalty, Vec<(u32, [f64; 2])>),
    /// Of the material of a body, by its place among `bodies`; or whether its diagonals hold: 0 or 1.
    Body(usize, OfBody, Arc<BodyPart>),
}

/// A key of a penalty that a slider sets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OfPenalty {
    /// By how much a depth pushes out `[N/m]`.
    Stiffness,
    /// By how much a speed into it does `[N s/m]`.
    Damping,
}

/// A key of a material that a slider sets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OfBody {
    /// Of its springs `[N/m]`.
    Stiffness,
    /// Of its springs `[N s/m]`.
    Damping,
    /// Of one copy of it `[kg]`.
    Mass,
    /// Of its skin `[1]`.
    Friction,
    /// Of its skin `[1]`.
    Restitution,
    /// Whether the diagonals of its cells hold.
    Diagonals,
}

/// What a body is made of, counted over the scene; empty until it is made.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BodyPart {
    /// Its points, those of all copies.
    pub points: Range<u32>,
    /// Its bonds.
    pub bonds: Range<u32>,
    /// What each point has of the mass of its copy `[1]`.
    pub masses: Vec<f64>,
    /// How stiff each bond is for the stiffness of the material `[1]`.
    pub shares: Vec<f64>,
    /// The diagonals of its cells among the bonds, and stiffness `[N/m]` and damping `[N s/m]` of each while they hold.
    pub diagonals: Vec<u32>,
    /// See there.
    pub braced: [f64; 2],
}

/// What is longer than this in sides of its cell is a diagonal.
const DIAGONAL: f64 = 1.2;

/// One number, or several as `first-last`; `None`: it is neither.
fn numbers_of(text: &str) -> Option<RangeInclusive<u32>> {
    let (first, last) = text.split_once('-').unwrap_or((text, text));
    Some(first.parse().ok()?..=last.parse().ok()?)
}

impl OfPenalty {
    /// The number of both that it is.
    pub fn of(self, [stiffness, damping]: [f64; 2]) -> f64 {
        match self {
            OfPenalty::Stiffness => stiffness,
            OfPenalty::Damping => damping,
        }
    }

    /// Both numbers, this one of which is another.
    pub fn put(self, [stiffness, damping]: [f64; 2], to: f64) -> [f64; 2] {
        match self {
            OfPenalty::Stiffness => [to, damping],
            OfPenalty::Damping => [stiffness, to],
        }
    }
}

impl Target {
    /// What a path means; `None`: nothing.
    fn of(path: &str) -> Option<Target> {
        let axis = |rest: &str| rest.strip_suffix(']').and_then(|axis| axis.parse().ok());
        if let Some(rest) = path.strip_prefix("gravity[") {
            return axis(rest).map(Target::Gravity);
        }
        if let Some(rest) = path.strip_prefix("wind.velocity[") {
            return axis(rest).map(Target::Wind);
        }
        if let Some((numbers, key)) = path.strip_prefix("bonds[").and_then(|rest| rest.split_once("].")) {
            let numbers = numbers_of(numbers)?;
            return match key {
                "stiffness" => Some(Target::Stiffness(numbers)),
                "damping" => Some(Target::Damping(numbers)),
                "rest" => Some(Target::Rest(numbers)),
                _ => None,
            };
        }
        if let Some((numbers, key)) = path.strip_prefix("obstacles[").and_then(|rest| rest.split_once("].")) {
            let numbers = numbers_of(numbers)?;
            return match key {
                "friction" => Some(Target::ObstacleFriction(numbers)),
                "restitution" => Some(Target::ObstacleRestitution(numbers)),
                "penalty.stiffness" => Some(Target::Penalty(numbers, OfPenalty::Stiffness, Vec::new())),
                "penalty.damping" => Some(Target::Penalty(numbers, OfPenalty::Damping, Vec::new())),
                _ => None,
            };
        }
        if let Some(body) = path.strip_prefix("bodies[").and_then(|rest| rest.strip_suffix("].diagonals")) {
            return Some(Target::Body(body.parse().ok()?, OfBody::Diagonals, Arc::default()));
        }
        if let Some((body, key)) = path.strip_prefix("bodies[").and_then(|rest| rest.split_once("].material.")) {
            let of = match key {
                "stiffness" => OfBody::Stiffness,
                "damping" => OfBody::Damping,
                "mass" => OfBody::Mass,
                "friction" => OfBody::Friction,
                "restitution" => OfBody::Restitution,
                _ => return None,
            };
            return Some(Target::Body(body.parse().ok()?, of, Arc::default()));
        }
        Some(match path {
            "contact" => Target::Meets,
            "contact.radius" => Target::ContactRadius,
            "drag_rate" => Target::DragRate,
            "wind.turbulence" => Target::Turbulence,
            "bounds.friction" => Target::WallFriction,
            "bounds.restitution" => Target::WallRestitution,
            "contact.friction" => Target::Friction,
            "contact.restitution" => Target::Restitution,
            "mouse.strength" => Target::MouseStrength,
            "mouse.radius" => Target::MouseRadius,
            _ => return None,
        })
    }

    /// The least and the greatest number that it can be.
    fn bounds(&self) -> [f64; 2] {
        match self {
            Target::Gravity(_) | Target::Wind(_) | Target::MouseStrength => [f64::NEG_INFINITY, f64::INFINITY],
            Target::Restitution
            | Target::Meets
            | Target::ObstacleRestitution(_)
            | Target::Body(_, OfBody::Restitution | OfBody::Diagonals, _) => [0.0, 1.0],
            Target::MouseRadius | Target::Body(_, OfBody::Mass, _) => [f64::MIN_POSITIVE, f64::INFINITY],
            _ => [0.0, f64::INFINITY],
        }
    }

    /// The number that the scene begins with; `None`: it does not say so itself.
    fn start(&self, scene: &Scene) -> Option<f64> {
        let contact = scene.contact.and_then(Meeting::resolve);
        let contact_keys = contact.map(ContactKeys::from);
        let bond = |number: u32| scene.bonds.iter().nth(number as usize);
        let obstacle = |number: u32| scene.obstacles.get(number as usize);
        match self {
            Target::Gravity(axis) => Some(scene.gravity.map_or(0.0, |gravity| gravity.embed()[*axis])),
            Target::DragRate => Some(scene.drag_rate.unwrap_or(0.0)),
            Target::Wind(axis) => scene.wind.as_ref().map(|wind| wind.velocity.embed()[*axis]),
            Target::Turbulence => scene.wind.as_ref().map(|wind| wind.turbulence.unwrap_or(0.0)),
            Target::WallFriction => scene.bounds.as_ref().map(|bounds| bounds.friction.unwrap_or(0.0)),
            Target::WallRestitution => scene.bounds.as_ref().map(|bounds| bounds.restitution.unwrap_or(0.0)),
            Target::Friction => contact_keys?.friction,
            Target::Restitution => contact_keys?.restitution,
            Target::ContactRadius => contact_keys?.radius,
            Target::Meets => Some(f64::from(u8::from(contact.is_some()))),
            Target::MouseStrength => scene.mouse.as_ref().map(|mouse| mouse.strength),
            Target::MouseRadius => scene.mouse.as_ref().map(|mouse| mouse.radius),
            Target::Stiffness(numbers) => bond(*numbers.start())?.stiffness,
            Target::Damping(numbers) => Some(bond(*numbers.start())?.damping.unwrap_or(0.0)),
            Target::Rest(numbers) => bond(*numbers.start())?.rest,
            Target::ObstacleFriction(numbers) => Some(obstacle(*numbers.start())?.friction.unwrap_or(0.0)),
            Target::ObstacleRestitution(numbers) => Some(obstacle(*numbers.start())?.restitution.unwrap_or(0.0)),
            Target::Penalty(numbers, of, _) => Some(of.of(penalty(scene, *numbers.start())?)),
            Target::Body(body, of, _) => {
                let material = scene.bodies.get(*body)?.material.as_ref()?;
                match of {
                    OfBody::Stiffness => material.stiffness,
                    OfBody::Damping => Some(material.damping.unwrap_or(0.0)),
                    OfBody::Mass => material.mass,
                    OfBody::Friction => material.friction,
                    OfBody::Restitution => material.restitution,
                    OfBody::Diagonals => Some(1.0),
                }
            }
        }
    }

    /// Whether it is on or off, 1 or 0.
    pub fn is_switch(&self) -> bool {
        matches!(self, Target::Meets | Target::Body(_, OfBody::Diagonals, _))
    }

    /// Whether it is of what can be switched off and on while the world runs: of walls, or of how bodies meet.
    pub fn is_of_switch(&self) -> bool {
        matches!(
            self,
            Target::WallFriction
                | Target::WallRestitution
                | Target::Friction
                | Target::Restitution
                | Target::ContactRadius
        )
    }

    /// Whether both set some number.
    fn meets(&self, other: &Target) -> bool {
        let overlap = |a: &RangeInclusive<u32>, b: &RangeInclusive<u32>| a.start() <= b.end() && b.start() <= a.end();
        match (self, other) {
            (Target::Stiffness(a), Target::Stiffness(b))
            | (Target::Damping(a), Target::Damping(b))
            | (Target::Rest(a), Target::Rest(b))
            | (Target::ObstacleFriction(a), Target::ObstacleFriction(b))
            | (Target::ObstacleRestitution(a), Target::ObstacleRestitution(b)) => overlap(a, b),
            (Target::Penalty(a, of, _), Target::Penalty(b, other, _)) => of == other && overlap(a, b),
            _ => self == other,
        }
    }
}

/// By how much an obstacle pushes out what gets into it, if it does `[N/m]`, `[N s/m]`.
fn penalty(scene: &Scene, number: u32) -> Option<[f64; 2]> {
    let keys = scene.obstacles.get(number as usize)?.penalty?;
    Some([keys.stiffness, keys.damping.unwrap_or(0.0)])
}

impl Scene {
    /// The numbers that it names for sliders, in its order; bodies are made for those that are of them.
    pub fn named_parameters(&self) -> Vec<Parameter> {
        let is_of_a_body = |keys: &ParameterKeys| matches!(Target::of(&keys.path), Some(Target::Body(..)));
        let parts = if self.parameters.iter().any(is_of_a_body) { self.parts() } else { Vec::new() };
        let of = |keys: &ParameterKeys| {
            let target = match Target::of(&keys.path)? {
                Target::Body(body, of, _) => Target::Body(body, of, Arc::clone(parts.get(body)?)),
                Target::Penalty(numbers, of, _) => {
                    let both = numbers.clone().filter_map(|number| Some((number, penalty(self, number)?))).collect();
                    Target::Penalty(numbers, of, both)
                }
                target => target,
            };
            Some(Parameter {
                label: keys.label.clone().unwrap_or_else(|| keys.path.clone()),
                unit: keys.unit.clone().unwrap_or_default(),
                range: keys.min..=keys.max,
                target,
            })
        };
        self.parameters.iter().filter_map(of).collect()
    }

    /// What its bodies are made of; nothing where they cannot be made.
    fn parts(&self) -> Vec<Arc<BodyPart>> {
        let Ok(start) = Start::new(self) else { return Vec::new() };
        let mut next = self.bonds.len() as u32;
        let mut parts = Vec::with_capacity(start.bodies.len());
        for (keys, body) in self.bodies.iter().zip(&start.bodies) {
            let points = body.points();
            let bonds = next..next + body.len() as u32;
            next = bonds.end;
            let own = &start.mass[points.start as usize..points.end as usize];
            let whole = own.iter().sum::<f64>() / f64::from(copies(keys));
            let shortest = body.links().map(|link| link.rest_length).fold(f64::INFINITY, f64::min);
            let is_diagonal = |link: &Link| link.rest_length > DIAGONAL * shortest;
            let diagonals = bonds.clone().zip(body.links()).filter(|(_, link)| is_diagonal(link));
            let diagonals = diagonals.map(|(number, _)| number).collect();
            let material = keys.material.as_ref();
            let braced = [material.and_then(|of| of.stiffness), material.and_then(|of| of.damping)];
            let masses = own.iter().map(|mass| mass / whole).collect();
            parts.push(Arc::new(BodyPart {
                points,
                bonds,
                masses,
                shares: body.links().map(|link| link.share).collect(),
                diagonals,
                braced: braced.map(|number| number.unwrap_or(0.0)),
            }));
        }
        parts
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;

    fn read(parameters: &str) -> Result<Scene, String> {
        let text = format!(
            r#"{{"wobble": 1, "gravity": [0, -9.81], "contact": true,
            "points": {{"position": [[0, 0], [1, 0]]}}, "bonds": [{{"a": 0, "b": 1, "kind": "spring", "stiffness": 10}}],
            "obstacles": [{{"circle": {{"center": [9, 9], "radius": 1}}, "friction": 0.2}}],
            "bodies": [{{"make": "rope", "count": 3, "spacing": 0.5, "origin": [0, 3]}},
                {{"make": "lattice", "columns": 3, "rows": 2, "spacing": 0.5, "origin": [3, 0],
                "material": {{"kind": "spring", "stiffness": 300, "mass": 6}},
                "repeat": {{"count": [2, 1], "step": [3, 0]}}}}], "parameters": [{parameters}]}}"#
        );
        let scene = Scene::parse(&text, "x.json").map_err(|error| error.to_string())?;
        scene.check().map_err(|error| error.to_string()).map(|()| scene)
    }

    #[test]
    fn what_a_slider_cannot_set_is_refused_with_the_reason() {
        for (parameter, reason) in [
            (r#"{"path": "gravity[1]", "min": 2, "max": 2}"#, "max: is 2.0 beside a `min` of 2.0"),
            (r#"{"path": "gravity[1]", "min": -5, "max": 0}"#, "min: leaves out -9.81, with which the scene begins"),
            (r#"{"path": "bonds[0].stiffness", "min": 0, "max": 5}"#, "max: leaves out 10.0"),
            (
                r#"{"path": "gravity[1]", "min": -10, "max": 0}, {"path": "gravity[1]", "min": -20, "max": 0}"#,
                "parameters[1].path: sets what `parameters[0]` does",
            ),
            (r#"{"path": "method.tolerance", "min": 0.1, "max": 1}"#, "cannot change while a scene runs"),
            (r#"{"path": "colour", "min": 0, "max": 1}"#, "`colour` is no number that sliders set"),
            (r#"{"path": "contact", "min": 0, "max": 0.5}"#, "is on or off"),
            (
                r#"{"path": "obstacles[1].friction", "min": 0, "max": 1}"#,
                "names obstacle 1, and there is 1 explicit obstacle: ",
            ),
            (
                r#"{"path": "bodies[2].material.mass", "min": 1, "max": 9}"#,
                "names body 2, and there are 2 explicit bodies: ",
            ),
            (r#"{"path": "bonds[0].length", "min": 0, "max": 1}"#, "of `bonds` give `stiffness`, `damping` or `rest`"),
            (r#"{"path": "bodies[0].material.stiffness", "min": 0, "max": 9}"#, "whose material gives no `stiffness`"),
            (r#"{"path": "bodies[1].material.mass", "min": 0, "max": 9}"#, "min: is 0.0"),
            (r#"{"path": "bodies[0].diagonals", "min": 0, "max": 1}"#, "is of body 0, which has no diagonals"),
            (r#"{"path": "bodies[1].diagonals", "min": 0, "max": 2}"#, "max: is 2.0"),
            (
                r#"{"path": "obstacles[0].penalty.stiffness", "min": 0, "max": 2}"#,
                "is of obstacle 0, which has no `penalty`",
            ),
        ] {
            let line = read(parameter).unwrap_err();
            assert!(line.contains(reason), "{parameter}: {line}");
        }
    }

    #[test]
    fn whether_bodies_meet_is_no_slider_of_a_method_without_contact() {
        let said = |method: &str| {
            let text = format!(
                r#"{{"wobble": 1, "points": {{"position": [[0, 0]]}}, "method": {{{method}}},
                "parameters": [{{"path": "contact", "min": 0, "max": 1}}]}}"#
            );
            Scene::parse(&text, "x.json").map_err(|error| error.to_string())
        };
        assert!(said(r#""solver": "live""#).is_ok());
        for (method, words) in
            [(r#""solver": "rk4""#, "solver `rk4` does not know"), (r#""tolerance": 0.1"#, "`tolerance` out")]
        {
            let line = said(method).unwrap_err();
            assert!(line.contains("parameters[0].path: is of contact") && line.contains(words), "{line}");
        }
    }

    #[test]
    fn a_body_has_its_own_points_and_bonds() {
        let scene = read(
            r#"{"path": "bodies[1].material.stiffness", "min": 1, "max": 900},
            {"path": "bodies[1].material.mass", "min": 1, "max": 9}, {"path": "obstacles[0].friction", "min": 0, "max": 1}"#,
        )
        .unwrap();
        let named = scene.named_parameters();
        let Target::Body(1, OfBody::Stiffness, part) = &named[0].target else { panic!("{named:?}") };
        let model = scene.model::<2>().unwrap();
        assert_eq!(part.points, 5..17, "two explicit points, a rope of three, twice six");
        assert_eq!(part.bonds.end as usize, model.bonds.len());
        let bonds: Vec<_> = model.bonds.iter().collect();
        assert!(part.bonds.clone().all(|bond| part.points.contains(&bonds[bond as usize].a.0)));
        assert!((part.masses[..6].iter().sum::<f64>() - 1.0).abs() < 1e-12, "{:?}", part.masses);
        assert_eq!(part.shares.len(), part.bonds.len());
        // Two cells in each copy, braced both ways.
        assert_eq!((part.diagonals.len(), part.braced), (8, [300.0, 0.0]));
    }
}
