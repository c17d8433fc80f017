//! The tool for constant forces: a drag from a body is an arrow that stays, a click on one takes it away.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::{DVec2, DVec3};

use super::Deed;
use super::build::short;
use super::chosen::Chosen;
use super::marks::{Mark, Role};
use super::pick::Scope;
use super::segments::distance_to_segment;
use super::selecting::is_drag;
use crate::history::{DeleteKeys, Do, SetKeys};
use crate::scene::{AddKeys, ForceKeys, Vector};
use crate::sim::{ForceView, PointId};

/// A force of 10 N has an arrow of 100 px, one of 40 N has 200: the length goes with the root, so that small ones and large ones are seen
/// and drawn beside each other `[N]`, `[logical px]`.
const USUAL: f64 = 10.0;
const LONG: f64 = 100.0;
/// Arrows are no longer than this, whatever their force is `[logical px]`.
const LONGEST: f64 = 420.0;
/// A press this near to an arrow is on it `[logical px]`.
const NEAR: f64 = 7.0;
/// Radius of the arc of a torque, and how far it goes around at most `[logical px]`, `[rad]`.
const ARC: f64 = 34.0;
const AROUND: f64 = 1.75 * PI;
/// Sides of an arrow's head `[logical px]`.
const HEAD: f64 = 11.0;
/// Arrows that are drawn at most, and numbers beside them.
const MOST: usize = 400;
const MOST_WORDS: usize = 40;

/// Said of a click where an arrow is drawn.
const CLICKED: &str = "drag an arrow out: its length is the force";

/// Why no arrow begins somewhere.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum NoPush {
    OfThePlane,
    NoBody,
    Solid,
    Pinned,
    Alone,
}

impl NoPush {
    pub(super) fn words(self) -> &'static str {
        match self {
            NoPush::OfThePlane => "torques are of the plane: in space a drag is a force",
            NoPush::NoBody => "no body lies here that could be pushed",
            NoPush::Solid => "an obstacle stands: no force moves it",
            NoPush::Pinned => "a pin stands: no force moves it",
            NoPush::Alone => "a single point does not turn: choose a body of more points",
        }
    }

    /// Whether it is said before a press: beside bodies it would be in the way.
    fn is_said_before(self) -> bool {
        matches!(self, NoPush::OfThePlane | NoPush::Pinned | NoPush::Alone)
    }
}

/// What a drag makes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::app) enum PushWay {
    /// A force on the point that is pressed on.
    #[default]
    Point,
    /// A force on all of the body, shared by mass.
    Body,
    /// A torque about the middle of the body.
    Turn,
    /// No force: the velocity of the body.
    Speed,
    /// Wind over all bodies.
    Wind,
}

impl PushWay {
    /// All of them.
    pub(in crate::app) const ALL: [PushWay; 5] =
        [PushWay::Point, PushWay::Body, PushWay::Turn, PushWay::Speed, PushWay::Wind];
}

/// How long an arrow is for a force or a torque `[px]`.
fn length(scope: Scope<'_>, force: f64) -> f64 {
    force.signum() * LONG * scope.scale * (force.abs() / USUAL).sqrt()
}

/// The force of an arrow so long `[px]`, with three digits.
fn force(scope: Scope<'_>, length: f64) -> f64 {
    let all = USUAL * (length / (LONG * scope.scale)).powi(2);
    let digit = 10f64.powf(all.max(1e-9).log10().floor() - 2.0);
    length.signum() * (all / digit).round() * digit
}

/// What an arrow says.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Form {
    /// A force: which way, and how long for its strength `[px]`.
    Straight(DVec2),
    /// A torque: how long its arc is, above 0 anticlockwise `[px]`.
    Round(f64),
}

/// A force as it is drawn.
#[derive(Clone, Debug, PartialEq)]
struct Arrow {
    /// The points that it acts on.
    points: Vec<PointId>,
    /// The middle of these `[px]`.
    from: DVec2,
    form: Form,
}

/// An arrow that is being drawn or changed.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Pull {
    /// `[px]`
    pressed: DVec2,
    /// As it was when it was pressed; a new one has no length.
    arrow: Arrow,
    /// The force that is changed; `None`: a new one.
    number: Option<u32>,
}

impl Arrow {
    /// From the middle of points. `None`: none of them is seen.
    fn new(scope: Scope<'_>, points: &[PointId], form: Form) -> Option<Self> {
        let there: Vec<PointId> = points.iter().copied().filter(|point| scope.is_there(*point)).collect();
        let places = there.iter().map(|point| DVec3::from(scope.shown.place(point.index())));
        let middle = places.sum::<DVec3>() / there.len().max(1) as f64;
        let from = scope.camera.screen_from_world(middle).map(DVec2::from).filter(|_| !there.is_empty())?;
        Some(Arrow { points: points.to_vec(), from, form })
    }

    /// Those of a force: one for the force, one for the torque.
    fn of(scope: Scope<'_>, view: &ForceView) -> Vec<Self> {
        let [x, y, z] = view.force;
        let size = DVec3::new(x, y, z).length();
        let along = match scope.shown.dimensions {
            2 => DVec2::new(x, -y).normalize_or_zero(),
            _ => seen_along(scope, view).unwrap_or_default(),
        };
        let straight = (size > 0.0).then(|| Form::Straight(length(scope, size) * along));
        let round = (view.torque != 0.0).then(|| Form::Round(length(scope, view.torque)));
        straight.into_iter().chain(round).filter_map(|form| Arrow::new(scope, &view.points, form)).collect()
    }

    /// The corners of its line, the last of them at its head `[px]`.
    fn line(&self, scope: Scope<'_>) -> Vec<DVec2> {
        match self.form {
            Form::Straight(way) => vec![self.from, self.from + way.clamp_length_max(LONGEST * scope.scale)],
            Form::Round(long) => {
                let radius = ARC * scope.scale;
                let swept = (long / radius).clamp(-AROUND, AROUND);
                let at = |k: i32| {
                    let angle = FRAC_PI_2 + swept * f64::from(k) / 24.0;
                    self.from + radius * DVec2::new(angle.cos(), -angle.sin())
                };
                (0..=24).map(at).collect()
            }
        }
    }

    fn is_at(&self, scope: Scope<'_>, at: DVec2) -> bool {
        let line = self.line(scope);
        line.windows(2).any(|pair| distance_to_segment(at, pair[0], pair[1]) <= NEAR * scope.scale)
    }

    /// Its number with its unit.
    fn words(&self, scope: Scope<'_>) -> String {
        match self.form {
            Form::Straight(way) => format!("{} N", short(force(scope, way.length()))),
            Form::Round(long) => format!("{} N m", short(force(scope, long))),
        }
    }

    fn marks(&self, scope: Scope<'_>, role: Role, width: f64) -> Vec<Mark> {
        let line = self.line(scope);
        let width = width * scope.scale;
        let [.., before, head] = line[..] else { return Vec::new() };
        let mut marks: Vec<Mark> = line.windows(2).map(|pair| Mark::Line(role, pair[0], pair[1], width)).collect();
        let back = head + line[0].distance(head) * (before - head).normalize_or_zero();
        marks.extend(self::head(scope, [back, head]).map(|side| Mark::Line(role, head, side, width)));
        marks
    }

    /// Where its number stands.
    fn beside(&self, scope: Scope<'_>) -> DVec2 {
        match self.form {
            // Where no arc goes before it is nearly whole.
            Form::Round(_) => self.from + DVec2::new(0.8 * ARC, 0.8 * ARC + 8.0) * scope.scale,
            Form::Straight(_) => {
                let head = self.line(scope).last().copied().unwrap_or(self.from);
                head + DVec2::new(12.0, -6.0) * scope.scale
            }
        }
    }
}

/// The far ends of the two sides of an arrow's head `[px]`.
pub(super) fn head(scope: Scope<'_>, [from, to]: [DVec2; 2]) -> [DVec2; 2] {
    let back = (from - to).normalize_or_zero();
    let long = (HEAD * scope.scale).min(0.6 * from.distance(to).max(6.0 * scope.scale));
    [0.5, -0.5].map(|turn| to + long * DVec2::from_angle(turn).rotate(back))
}

/// The way in the world that an arrow from its points is seen along `[m]`: in space in the plane through their middle that faces the camera.
fn seen_way(scope: Scope<'_>, arrow: &Arrow, way: DVec2) -> DVec3 {
    let points = arrow.points.iter().copied().filter(|point| scope.is_there(*point)).collect();
    let middle = Chosen { points, ..Chosen::default() }.middle(scope);
    scope.facing(middle, arrow.from + way) - scope.facing(middle, arrow.from)
}

/// Which way a force of space is seen.
fn seen_along(scope: Scope<'_>, view: &ForceView) -> Option<DVec2> {
    let from = DVec3::from(scope.shown.place(view.points.first()?.index()));
    let along = DVec3::from(view.force).normalize_or_zero();
    let ends = [from, from + 1e-3 * scope.camera.height() * along].map(|place| scope.camera.screen_from_world(place));
    let [Some(from), Some(to)] = ends else { return None };
    Some((DVec2::from(to) - DVec2::from(from)).normalize_or_zero())
}

impl PushWay {
    /// An arrow is taken, or one begins on the body that lies under the pixel.
    ///
    /// Errors: why there is none.
    pub(super) fn press(self, scope: Scope<'_>, at: DVec2) -> Result<Pull, NoPush> {
        if scope.shown.dimensions != 2 && self == PushWay::Turn {
            return Err(NoPush::OfThePlane);
        }
        if let Some((number, arrow)) = arrow_at(scope, at) {
            return Ok(Pull { pressed: at, arrow, number: Some(number) });
        }
        let Some(hit) = scope.nearest(at) else {
            return Err(if scope.solid(at).is_some() { NoPush::Solid } else { NoPush::NoBody });
        };
        let points = match self {
            PushWay::Point => vec![hit.point],
            PushWay::Body | PushWay::Turn | PushWay::Speed | PushWay::Wind => scope.body(hit.point),
        };
        match () {
            () if points.iter().all(|point| scope.is_pinned(*point)) => return Err(NoPush::Pinned),
            () if self == PushWay::Turn && points.len() < 2 => return Err(NoPush::Alone),
            () => {}
        }
        let form = if self == PushWay::Turn { Form::Round(0.0) } else { Form::Straight(DVec2::ZERO) };
        let arrow = Arrow::new(scope, &points, form).ok_or(NoPush::NoBody)?;
        Ok(Pull { pressed: at, arrow, number: None })
    }

    /// What a press at the pixel would do.
    pub(super) fn marks(self, scope: Scope<'_>, at: DVec2) -> Vec<Mark> {
        let words = |words: &str| Mark::Words(at + DVec2::new(16.0, -12.0) * scope.scale, words.to_owned());
        match self.press(scope, at) {
            Ok(Pull { arrow, number: Some(_), .. }) => {
                let mut marks = arrow.marks(scope, Role::Away, 4.0);
                marks.push(words("a click takes it away, a drag changes it"));
                marks
            }
            Ok(Pull { arrow, number: None, .. }) => {
                let said = match self {
                    PushWay::Point => "drag: a force on this point",
                    PushWay::Body | PushWay::Speed | PushWay::Wind => "drag: a force on the body",
                    PushWay::Turn => "drag around it: a torque",
                };
                vec![Mark::Ring(Role::Come, arrow.from, 7.0 * scope.scale), words(said)]
            }
            Err(why) if why.is_said_before() => vec![words(why.words())],
            Err(_) => Vec::new(),
        }
    }
}

impl Pull {
    /// The arrow as a release at a pixel leaves it.
    fn arrow(&self, scope: Scope<'_>, at: DVec2) -> Arrow {
        let now = Arrow::new(scope, &self.arrow.points, self.arrow.form).unwrap_or_else(|| self.arrow.clone());
        let way = at - self.pressed;
        let form = match now.form {
            // What is on one point is drawn from there.
            Form::Straight(_) if self.number.is_none() && now.points.len() == 1 => Form::Straight(at - now.from),
            Form::Straight(before) => Form::Straight(before + way),
            Form::Round(before) => {
                let arm = (self.pressed - self.arrow.from).normalize_or(DVec2::new(0.0, -1.0));
                // Anticlockwise as it is seen, y down.
                Form::Round(before + way.dot(DVec2::new(arm.y, -arm.x)))
            }
        };
        Arrow { form, ..now }
    }

    /// What a release at a pixel does.
    pub(super) fn release(&self, scope: Scope<'_>, at: DVec2) -> Deed {
        if !is_drag(scope, [self.pressed, at]) {
            let away = |number| Do::Delete(DeleteKeys { forces: vec![number], ..DeleteKeys::default() });
            return self.number.map_or_else(|| Deed::words(CLICKED.to_owned()), |k| Deed::edit("force away", away(k)));
        }
        let arrow = self.arrow(scope, at);
        let (given, torque) = match arrow.form {
            Form::Straight(way) => {
                let size = force(scope, way.length());
                let along = seen_way(scope, &arrow, way).normalize_or_zero() * size;
                (Some(Vector::new(along.to_array(), scope.shown.dimensions)), None)
            }
            Form::Round(long) => (None, Some(force(scope, long))),
        };
        let name = if torque.is_some() { "torque" } else { "force" };
        let act = match self.number {
            Some(number) => {
                Do::Set(Box::new(SetKeys { forces: Some(vec![number]), force: given, torque, ..SetKeys::default() }))
            }
            None => {
                let points = arrow.points.iter().map(|point| point.0).collect();
                let forces = vec![ForceKeys { points, force: given, torque }];
                Do::Add(Box::new(AddKeys { forces, ..AddKeys::default() }))
            }
        };
        Deed::edit(name, act)
    }

    /// What it looks like now, with its number.
    pub(super) fn marks(&self, scope: Scope<'_>, at: DVec2) -> Vec<Mark> {
        let arrow = self.arrow(scope, at);
        let mut marks = arrow.marks(scope, Role::Come, 3.0);
        marks.push(Mark::Words(at + DVec2::new(16.0, -12.0) * scope.scale, arrow.words(scope)));
        marks
    }
}

/// The arrow that a pixel lies on, the one that came last, with the number of its force.
fn arrow_at(scope: Scope<'_>, at: DVec2) -> Option<(u32, Arrow)> {
    let forces = scope.shown.scenery.forces.iter().rev();
    let arrows = forces.flat_map(|view| Arrow::of(scope, view).into_iter().map(|arrow| (view.number, arrow)));
    arrows.into_iter().find(|(_, arrow)| arrow.is_at(scope, at))
}

/// The forces of the world as arrows with their numbers, but for the one that is being changed.
pub(super) fn arrows(scope: Scope<'_>, pull: Option<&Pull>) -> Vec<Mark> {
    let forces = &scope.shown.scenery.forces;
    let is_shown = |view: &&ForceView| pull.is_none_or(|pull| pull.number != Some(view.number));
    let all = forces.iter().filter(is_shown).take(MOST).flat_map(|view| Arrow::of(scope, view));
    let has_words = forces.len() <= MOST_WORDS;
    let marks = all.flat_map(|arrow| {
        let words = has_words.then(|| Mark::Words(arrow.beside(scope), arrow.words(scope)));
        arrow.marks(scope, Role::Push, 2.5).into_iter().chain(words).collect::<Vec<_>>()
    });
    marks.collect()
}
