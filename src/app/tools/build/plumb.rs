//! How high over the floor something is that is built in space: a line straight down from it, and where on the floor it stands above.

use glam::{DVec2, DVec3};

use super::space::Form;
use crate::app::tools::marks::{Mark, Role};
use crate::app::tools::pick::Scope;
use crate::render::level_floor;

/// Sides of the outline of a ball on the floor.
const ROUND: u32 = 32;
/// What is seen to stand no higher over the floor stands on it `[logical px]`.
const ON_IT: f64 = 3.0;
/// Width of the lines `[logical px]`.
const WIDTH: f64 = 1.2;
/// Radius of the mark where the line ends `[logical px]`.
const FOOT: f64 = 3.0;

/// The line down to the floor and the outline there, of what is built, where `below` is which way things fall; nothing where there is no floor
/// below it, or where it stands on the floor.
pub(super) fn marks(scope: Scope<'_>, form: &Form, below: DVec3) -> Vec<Mark> {
    let scenery = &scope.shown.scenery;
    let Some([place, normal]) = level_floor(&scenery.planes, scenery.bounds) else { return Vec::new() };
    let fall = -below.dot(normal);
    let foot = |at: DVec3| {
        let high = (at - place).dot(normal);
        (fall > 0.0 && high >= 0.0).then(|| at + (high / fall) * below)
    };
    let pixel = |at: DVec3| scope.camera.screen_from_world(at).map(DVec2::from);
    let from = lowest(form, below);
    let Some((above, end)) = pixel(from).zip(foot(from).and_then(pixel)) else { return Vec::new() };
    if above.distance(end) < ON_IT * scope.scale {
        return Vec::new();
    }
    let line = |from: DVec2, to: DVec2| Mark::Line(Role::Ghost, from, to, WIDTH * scope.scale);
    let outline: Vec<Option<DVec2>> = around(form, below).into_iter().map(|at| foot(at).and_then(pixel)).collect();
    let sides = outline.windows(2).filter_map(|pair| Some(line(pair[0]?, pair[1]?)));
    [line(above, end), Mark::Knob(Role::Ghost, end, FOOT * scope.scale)].into_iter().chain(sides).collect()
}

/// Two directions across the one in which things fall.
fn across(below: DVec3) -> [DVec3; 2] {
    let first = below.any_orthonormal_vector();
    [first, below.cross(first)]
}

/// The place of something from which a line goes down `[m]`: its middle, as low as it is.
fn lowest(form: &Form, below: DVec3) -> DVec3 {
    match form {
        Form::Ball { center, radius } => *center + *radius * below,
        Form::Box([low, high]) => {
            let half = 0.5 * (*high - *low);
            0.5 * (*low + *high) + half.dot(below.abs()) * below
        }
        Form::Cloth { corner, cell: [u, v], cells: [columns, rows], .. } => {
            *corner + 0.5 * (f64::from(*columns) * *u + f64::from(*rows) * *v)
        }
        Form::Rope { corners, .. } => corners.last().copied().unwrap_or(DVec3::NAN),
    }
}

/// Places along it whose feet outline it on the floor `[m]`: of what is closed the first comes again at the end.
fn around(form: &Form, below: DVec3) -> Vec<DVec3> {
    match form {
        Form::Ball { center, radius } => {
            let [right, back] = across(below).map(|side| *radius * side);
            let turn = |k: u32| std::f64::consts::TAU * f64::from(k) / f64::from(ROUND);
            (0..=ROUND).map(|k| *center + turn(k).cos() * right + turn(k).sin() * back).collect()
        }
        Form::Box([low, high]) => {
            // The side that it lies on: across the axis that is nearest to straight down.
            let axis = (0..3).max_by(|a, b| below[*a].abs().total_cmp(&below[*b].abs())).unwrap_or(1);
            let [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
            let corner = |[x, y]: [bool; 2]| {
                let mut at = if below[axis] < 0.0 { *low } else { *high };
                at[u] = if x { high[u] } else { low[u] };
                at[v] = if y { high[v] } else { low[v] };
                at
            };
            [[false, false], [true, false], [true, true], [false, true], [false, false]].map(corner).to_vec()
        }
        Form::Cloth { corner, cell: [u, v], cells: [columns, rows], .. } => {
            let (u, v) = (f64::from(*columns) * *u, f64::from(*rows) * *v);
            vec![*corner, *corner + u, *corner + u + v, *corner + v, *corner]
        }
        Form::Rope { corners, .. } => corners.clone(),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]
mod tests {
    use super::super::form::Hold;
    use super::*;
    use crate::app::player::Shown;
    use crate::app::tools::tests::{scope, shown};
    use crate::render::Camera;
    use crate::scene::Scene;

    type Seen = (Shown, Camera, Scene);

    /// Space with a floor at y = -2, or none.
    fn seen(floor: &str) -> Seen {
        let text = format!(
            r#"{{"wobble": 1, "dimensions": 3, "gravity": [0, -9.81, 0], {floor}
                "view": {{"target": [0, 0, 0], "distance": 12, "yaw": 0.6, "pitch": 0.4}}}}"#
        );
        shown(Scene::parse(&text, "x.json").unwrap())
    }

    const PLANE: &str = r#""obstacles": [{"plane": {"point": [0, -2, 0], "normal": [0, 1, 0]}}],"#;
    const WALLS: &str = r#""bounds": {"min": [-4, -2, -4], "max": [4, 4, 4]},"#;

    fn pixel(seen: &Seen, at: [f64; 3]) -> DVec2 {
        seen.1.screen_from_world(at.into()).unwrap().into()
    }

    #[test]
    fn what_is_built_over_a_floor_has_a_line_down_to_it_and_an_outline_on_it() {
        let (ball, low, high) = ([0.5, 1.0, 0.0], DVec3::new(0.0, 0.0, -1.0), DVec3::new(1.0, 0.5, 1.0));
        for floor in [PLANE, WALLS] {
            let seen = seen(floor);
            let of = |form: &Form| marks(scope(&seen), form, DVec3::NEG_Y);
            let all = of(&Form::Ball { center: ball.into(), radius: 0.5 });
            let Mark::Line(Role::Ghost, from, to, _) = all[0] else { panic!("{all:?}") };
            assert!(from.distance(pixel(&seen, [0.5, 0.5, 0.0])) < 1e-6, "its lowest place");
            assert!(to.distance(pixel(&seen, [0.5, -2.0, 0.0])) < 1e-6, "straight below that");
            // The outline lies on the floor, as wide as the ball.
            let rim = [[1.0, -2.0, 0.0], [0.0, -2.0, 0.0], [0.5, -2.0, 0.5]].map(|at| pixel(&seen, at));
            let off = |at: DVec2, mark: &Mark| match mark {
                Mark::Line(_, a, b, _) => a.distance(at) + at.distance(*b) - a.distance(*b),
                _ => f64::INFINITY,
            };
            let is_on = |at: &DVec2| all[2..].iter().any(|mark| off(*at, mark) < 0.5);
            assert!(all.len() > 20 && rim.iter().all(is_on), "{all:?}");
            let all = of(&Form::Box([low, high]));
            let Mark::Line(_, from, to, _) = all[0] else { panic!("{all:?}") };
            assert!(from.distance(pixel(&seen, [0.5, 0.0, 0.0])) < 1e-6);
            assert!(to.distance(pixel(&seen, [0.5, -2.0, 0.0])) < 1e-6);
            assert_eq!(all.len(), 2 + 4, "four sides");
        }
    }

    #[test]
    fn what_stands_on_the_floor_or_has_none_below_it_has_no_line() {
        let ball = |y: f64| Form::Ball { center: DVec3::new(0.0, y, 0.0), radius: 0.5 };
        let of = |floor: &str, y: f64| marks(scope(&seen(floor)), &ball(y), DVec3::NEG_Y);
        assert!(of(PLANE, -1.5).is_empty(), "it stands there");
        assert!(of(PLANE, -4.0).is_empty(), "it is below it");
        assert!(of("", 1.0).is_empty(), "there is no floor");
        let wall = r#""obstacles": [{"plane": {"point": [-2, 0, 0], "normal": [1, 0, 0]}}],"#;
        assert!(of(wall, 1.0).is_empty(), "a wall is no floor");
        assert!(!of(PLANE, 1.0).is_empty());
    }

    #[test]
    fn ropes_and_cloths_have_one_too() {
        let seen = seen(PLANE);
        let corners = vec![DVec3::new(0.0, 2.0, 0.0), DVec3::new(0.0, 1.0, 0.0), DVec3::new(0.5, 0.0, 0.0)];
        let holds = [Hold::Pin, Hold::None];
        let rope = marks(scope(&seen), &Form::Rope { corners, holds, is_bent: false }, DVec3::NEG_Y);
        assert!(matches!(rope[0], Mark::Line(_, from, ..) if from.distance(pixel(&seen, [0.5, 0.0, 0.0])) < 1e-6));
        let cell = [DVec3::X * 0.5, DVec3::NEG_Y * 0.5];
        let cloth = Form::Cloth { corner: DVec3::new(-1.0, 2.0, 0.0), cell, cells: [4, 2], hangs: true };
        let cloth = marks(scope(&seen), &cloth, DVec3::NEG_Y);
        assert!(matches!(cloth[0], Mark::Line(_, _, to, _) if to.distance(pixel(&seen, [0.0, -2.0, 0.0])) < 1e-6));
    }
}
