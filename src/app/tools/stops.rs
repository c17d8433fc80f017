//! The stops of joints, in the world: an arc from one to the other about the joint, and where in it the arm is that turns.

use std::f64::consts::TAU;

use glam::DVec2;

use super::marks::{Mark, Role};
use super::pick::Scope;
use crate::app::matter::{AngleAs, Joint};
use crate::sim::{Angle, PointId};

/// Radius of an arc in lengths of the shorter arm, and the least and the greatest one `[logical px]`.
const SHARE: f64 = 0.45;
const RADII: [f64; 2] = [16.0, 56.0];
/// A stop is a line across the arc, from this to that, in its radii.
pub(super) const ACROSS: [f64; 2] = [0.75, 1.25];
/// Numbers stand so far out, in radii.
const OUT: f64 = 1.5;
/// An arc is cut into pieces no longer than this `[rad]`.
const PIECE: f64 = TAU / 48.0;
/// Widths of the arc and of its stops, and the radius of the knob where the arm is `[logical px]`.
const WIDTHS: [f64; 2] = [1.6, 2.6];
const KNOB: f64 = 3.5;
/// So far beyond a stop it is pressed on, not just met `[rad]`.
const BEYOND: f64 = 0.02;
/// Arcs that are drawn at most, and those that have numbers.
pub(super) const MOST: usize = 64;
const NUMBERED: usize = 2;

/// The stops of all joints among points, which are ascending.
pub(super) fn marks(scope: Scope<'_>, points: &[PointId]) -> Vec<Mark> {
    let joint = |angle: &Angle| Some(Joint { points: angle.points, range: angle.range?, prop: None });
    let joints: Vec<Joint> = joints(scope, points).filter_map(joint).take(MOST).collect();
    all(scope, Role::Lead, &joints)
}

/// Those joints.
pub(super) fn joints<'a>(scope: Scope<'a>, points: &[PointId]) -> impl Iterator<Item = &'a Angle> {
    let props = &scope.shown.scenery.props;
    let is_meant = move |angle: &&Angle| angle.range.is_some() && AngleAs::Joint.is_meant(points, props, angle);
    scope.shown.scenery.angles.iter().filter(is_meant)
}

/// Where joints that have none would get them.
pub(in crate::app) fn would_be(scope: Scope<'_>, joints: &[Joint]) -> Vec<Mark> {
    all(scope, Role::Come, &joints[..joints.len().min(MOST)])
}

pub(super) fn all(scope: Scope<'_>, role: Role, joints: &[Joint]) -> Vec<Mark> {
    if scope.shown.dimensions != 2 {
        return Vec::new();
    }
    let is_numbered = joints.len() <= NUMBERED;
    joints.iter().filter_map(|joint| arc(scope, role, joint, is_numbered)).flatten().collect()
}

/// What angles of a joint are seen on.
pub(super) struct Dial {
    /// Where the joint is, and the second arm from there `[m]`.
    pub(super) middle: DVec2,
    second: DVec2,
    /// Where the first arm points, from which angles are counted `[rad]`.
    pub(super) from: f64,
    /// Radius of the arc `[m]`.
    radius: f64,
}

impl Dial {
    /// That of a joint that is there; `None` where an arm has no length.
    pub(super) fn of(scope: Scope<'_>, points: [PointId; 3]) -> Option<Self> {
        Dial::beside(scope, points, None)
    }

    /// The same, where a prop is still to come to this place `[m]`.
    fn beside(scope: Scope<'_>, [i, j, k]: [PointId; 3], prop: Option<[f64; 2]>) -> Option<Self> {
        let place = |point: PointId| DVec2::from_slice(&scope.shown.place(point.index())[..2]);
        let is_prop = prop.is_some() || scope.shown.scenery.props.binary_search(&i).is_ok();
        let middle = place(j);
        let (first, second) = (prop.map_or_else(|| place(i), DVec2::from) - middle, place(k) - middle);
        // A prop lies in its hub: it is no arm.
        let arm = if is_prop { second.length() } else { first.length().min(second.length()) };
        if !(arm > 0.0 && arm.is_finite()) {
            return None;
        }
        let [low, high] = RADII.map(|radius| radius * scope.scale / scope.camera.pixels_per_metre());
        Some(Dial { middle, second, from: first.to_angle(), radius: (SHARE * arm).clamp(low, high) })
    }

    /// The pixel of an angle `[rad]`, a share of the radius off the joint; `None` behind what is seen.
    pub(super) fn at(&self, scope: Scope<'_>, angle: f64, share: f64) -> Option<DVec2> {
        scope.on_screen(self.middle + share * self.radius * DVec2::from_angle(self.from + angle))
    }
}

/// One of them; `None` where an arm has no length or lies behind what is seen.
fn arc(scope: Scope<'_>, role: Role, joint: &Joint, is_numbered: bool) -> Option<Vec<Mark>> {
    let Joint { points, range: [least, most], prop } = joint;
    let dial = Dial::beside(scope, *points, *prop)?;
    let at = |angle: f64, share: f64| dial.at(scope, angle, share);
    let line = |[a, b]: [Option<DVec2>; 2], width: f64| Some(Mark::Line(role, a?, b?, width * scope.scale));
    let count = ((most - least) / PIECE).ceil().max(1.0);
    let along = |place: u32| at(least + (most - least) * f64::from(place) / count, 1.0);
    let pieces = (0..count as u32).filter_map(|place| line([along(place), along(place + 1)], WIDTHS[0]));
    let stops = [*least, *most].into_iter().filter_map(|stop| line(ACROSS.map(|share| at(stop, share)), WIDTHS[1]));
    let mut marks: Vec<Mark> = pieces.chain(stops).collect();
    let now = within(dial.second.to_angle() - dial.from, 0.5 * (least + most));
    let is_beyond = now < least - BEYOND || now > most + BEYOND;
    let knob = if is_beyond { Role::Away } else { role };
    marks.extend(at(now, 1.0).map(|place| Mark::Knob(knob, place, KNOB * scope.scale)));
    if is_numbered {
        let number = |stop: f64| Some(Mark::Words(at(stop, OUT)?, format!("{:.0}°", stop.to_degrees())));
        marks.extend([*least, *most].into_iter().filter_map(number));
    }
    Some(marks)
}

/// The angle that points the same way and is no more than half a turn from a middle `[rad]`.
pub(super) fn within(angle: f64, middle: f64) -> f64 {
    angle - TAU * ((angle - middle) / TAU).round()
}

#[cfg(test)]
#[allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]
mod tests {
    use super::super::Hand;
    use super::super::tests::{pixel, scope, shown};
    use super::*;
    use crate::app::action::Tool;
    use crate::history::{DeleteKeys, Do};
    use crate::scene::Scene;

    /// Two arms at a right angle with stops, and a pair that has none.
    const KNEES: &str = r#"{"wobble": 1, "gravity": [0, 0], "view": {"center": [2, 0], "height": 8},
        "points": {"position": [[1, 0], [0, 0], [0, 1], [4, 0], [5, 0], [6, 0]]},
        "bonds": [{"a": 0, "b": 1}, {"a": 1, "b": 2}, {"a": 3, "b": 4}, {"a": 4, "b": 5}],
        "angles": [{"points": [0, 1, 2], "min": 0.5, "max": 2.5}]}"#;

    #[test]
    fn a_selected_joint_has_an_arc_from_stop_to_stop_about_it_and_a_knob_where_its_arm_is() {
        let seen = shown(Scene::parse(KNEES, "x.json").unwrap());
        let mut hand = Hand::default();
        hand.take(Tool::Select);
        let arcs = |hand: &Hand| {
            let marks = hand.marks(scope(&seen), None);
            let is_lead = |mark: &&Mark| matches!(mark, Mark::Line(Role::Lead, ..) | Mark::Knob(Role::Lead, ..));
            (marks.iter().filter(is_lead).cloned().collect::<Vec<_>>(), marks)
        };
        let at = pixel(&seen, 2);
        hand.press(scope(&seen), at);
        hand.release(scope(&seen), at);
        let (own, all) = arcs(&hand);
        let joint = pixel(&seen, 1);
        // On the screen up is down: an angle from the arm to the right, anticlockwise, goes up.
        let angle = |place: DVec2| (joint.y - place.y).atan2(place.x - joint.x);
        let ends = own.iter().filter_map(|mark| match mark {
            Mark::Line(_, a, b, _) => Some([angle(*a), angle(*b)]),
            _ => None,
        });
        let (least, most) = ends.flatten().fold((f64::MAX, f64::MIN), |(low, high), x| (low.min(x), high.max(x)));
        assert!((least - 0.5).abs() < 1e-3 && (most - 2.5).abs() < 1e-3, "{least} to {most}");
        let knobs: Vec<f64> = own
            .iter()
            .filter_map(|mark| if let Mark::Knob(_, at, _) = mark { Some(angle(*at)) } else { None })
            .collect();
        assert!(knobs.len() == 1 && (knobs[0] - 0.5 * std::f64::consts::PI).abs() < 1e-3, "{knobs:?}");
        let says = |words: &str| all.iter().any(|mark| matches!(mark, Mark::Words(_, said) if said == words));
        assert!(says("29°") && says("143°"), "{all:?}");
        // What has no stops has no arc.
        let at = pixel(&seen, 5);
        hand.press(scope(&seen), at);
        hand.release(scope(&seen), at);
        assert!(hand.chosen(scope(&seen)).is_some() && arcs(&hand).0.is_empty());
    }

    /// A box that hangs on one pin, with stops that push against a prop beside that.
    const HANGING: &str = r#"{"wobble": 1, "gravity": [0, -9.81], "view": {"center": [0.5, -0.2], "height": 4},
        "points": {"position": [[0, 0], [0, -0.4], [1, -0.4], [1, 0], [-0.02, -0.05]], "pinned": [0, 4]},
        "bonds": [{"a": 0, "b": 1}, {"a": 1, "b": 2}, {"a": 2, "b": 3}, {"a": 3, "b": 0}, {"a": 0, "b": 2}],
        "triangles": [[0, 1, 2], [0, 2, 3]], "angles": [{"points": [4, 0, 2], "min": 0.5, "max": 2.6}]}"#;

    #[test]
    fn a_prop_is_selected_led_and_let_go_with_the_pin_that_it_is_beside() {
        let seen = shown(Scene::parse(HANGING, "x.json").unwrap());
        assert_eq!(seen.0.scenery.props, [PointId(4)]);
        let on_pin = pixel(&seen, 0);
        let mut hand = Hand::default();
        hand.take(Tool::Select);
        hand.press(scope(&seen), pixel(&seen, 3));
        hand.release(scope(&seen), pixel(&seen, 3));
        assert_eq!(hand.chosen(scope(&seen)).unwrap().points, (0..5).map(PointId).collect::<Vec<_>>());
        // Its arc is as large as those of other joints, though the prop lies in the hub.
        let dial = Dial::of(scope(&seen), [4, 0, 2].map(PointId)).unwrap();
        let metre = scope(&seen).camera.pixels_per_metre();
        let radius = (SHARE * 1.16_f64.sqrt() * metre).clamp(RADII[0], RADII[1]);
        assert!(radius > RADII[0] && (dial.radius * metre - radius).abs() < 0.5, "{} of {radius}", dial.radius * metre);
        hand.take(Tool::Hand);
        hand.press(scope(&seen), on_pin);
        let way = hand.lead(scope(&seen), on_pin + DVec2::new(60.0, 0.0), 1.0).unwrap();
        let [(PointId(0), pin), (PointId(4), prop)] = way.pins[..] else { panic!("{way:?}") };
        assert!((prop[0] - pin[0] + 0.02).abs() < 1e-6 && (prop[1] - pin[1] + 0.05).abs() < 1e-6, "{way:?}");
        assert!(pin[0] > 0.1);
        let deed = super::super::unpin(scope(&seen), on_pin);
        let away = Do::Delete(DeleteKeys { points: vec![4], ..DeleteKeys::default() });
        assert_eq!((deed.commands, deed.edit), (vec![Do::Unpin(vec![PointId(0)]), away], Some("unpin")));
        assert_eq!(deed.words.as_deref(), Some("unpinned: it falls"), "the prop holds nothing");
    }

    #[test]
    fn a_pin_that_is_selected_alone_has_its_prop_and_means_its_stops() {
        let seen = shown(Scene::parse(HANGING, "x.json").unwrap());
        let points = super::super::hub::with_props(scope(&seen), vec![PointId(0)]);
        assert_eq!(points, [0, 4].map(PointId), "it is moved and deleted with it");
        assert_eq!(joints(scope(&seen), &points).count(), 1);
        let other = super::super::hub::with_props(scope(&seen), vec![PointId(2)]);
        assert_eq!(other, [PointId(2)], "the arm alone has none");
    }

    #[test]
    fn an_arm_that_presses_on_its_stop_is_seen_to() {
        let text = KNEES.replace("\"max\": 2.5", "\"max\": 1.4");
        let seen = shown(Scene::parse(&text, "x.json").unwrap());
        let points: Vec<PointId> = (0..3).map(PointId).collect();
        assert!(marks(scope(&seen), &points).iter().any(|mark| matches!(mark, Mark::Knob(Role::Away, ..))));
    }
}
