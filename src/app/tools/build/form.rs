//! What a drag comes to: a primitive with its place and its size.

use glam::DVec2;

use super::Maker;
use super::figure::Figure;
use super::grid::{Fineness, Grid};
use crate::app::action::Primitive;
use crate::app::count::counted;
use crate::body::hanging;
use crate::scene::{AddKeys, Scene};
use crate::sim::PointId;

/// A primitive in its place.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Form {
    Box(Grid),
    Disc(Round),
    Rope {
        /// The first is on a point of the world, if any is.
        ends: [End; 2],
        pieces: u32,
        /// By what share it is longer than the straight way `[1]`: where both ends are held.
        slack: f64,
    },
    Cloth {
        grid: Grid,
        /// It hangs by its upper corners.
        hangs: bool,
    },
    Rim(Round),
    Figure(Figure),
    /// Its lower and its upper corner `[m]`.
    Frame([DVec2; 2]),
    SolidBox([DVec2; 2]),
    SolidCircle(Round),
    Slope(Plank),
    /// A place of it, and which way it was drawn `[m]`: it is solid at the right hand of that.
    Plane([DVec2; 2]),
}

/// A solid plank.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Plank {
    /// Where its upper side begins, and which way it goes `[m]`: it lies at the right hand of that.
    pub(super) from: DVec2,
    pub(super) along: DVec2,
    /// `[m]`
    pub(super) thick: f64,
}

impl Plank {
    /// Its corners, from where it begins.
    pub(super) fn corners(&self) -> [DVec2; 4] {
        let down = -self.along.normalize_or(DVec2::X).perp() * self.thick;
        let Plank { from, along, .. } = *self;
        [from, from + along, from + along + down, from + down]
    }
}

/// A circle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Round {
    pub(super) center: DVec2,
    pub(super) radius: f64,
}

/// What an end of a rope hangs on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Hold {
    None,
    /// A pin of its own.
    Pin,
    /// A point of the world.
    Point(PointId),
}

/// An end of a drag.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct End {
    /// `[m]`
    pub(super) at: DVec2,
    pub(super) hold: Hold,
}

/// Height of a figure, in what a click makes `[1]`.
const TALL: f64 = 1.7;
/// Thickness of a slope, in what a click makes `[1]`.
const THICK: f64 = 0.25;
/// Cells of a cloth.
pub(super) const CLOTH: Fineness = Fineness { across: 2..=10, most: 16 };
/// Pieces of a rope as long as what a click makes.
pub(super) const PIECES: f64 = 6.0;
/// The fewest and the most pieces of a rope.
pub(super) const ALL_PIECES: [f64; 2] = [4.0, 40.0];

impl Form {
    /// What is drawn out between two ends, where what a click makes is so large `[m]`.
    /// `None`: it is drawn otherwise.
    pub(super) fn drawn(maker: Maker, ends: [End; 2], usual: f64) -> Option<Self> {
        let [from, to] = ends.map(|end| end.at);
        let round = Round { center: from, radius: from.distance(to) };
        Some(match maker.primitive {
            Primitive::Bonds | Primitive::Polygon => return None,
            Primitive::Box => Form::Box(Grid::fit(from, to, &maker.of.grain.of_box())),
            Primitive::Disc => Form::Disc(round),
            Primitive::Rope => Form::rope(ends, usual, maker.slack()),
            Primitive::Cloth => Form::Cloth { grid: Grid::fit(from, to, &CLOTH), hangs: !maker.is_free },
            Primitive::Rim => Form::Rim(round),
            Primitive::Figure => Form::Figure(Figure::between(from, to)),
            Primitive::Frame => Form::Frame([from.min(to), from.max(to)]),
            Primitive::SolidBox => Form::SolidBox([from.min(to), from.max(to)]),
            Primitive::SolidCircle => Form::SolidCircle(round),
            Primitive::Slope => Form::Slope(Plank { from, along: to - from, thick: THICK * usual }),
            Primitive::Plane => Form::Plane([from, to - from]),
        })
    }

    /// What a click makes, of a usual size `[m]`: about the place, a rope hanging down from it, a slope that is level.
    pub(super) fn usual(maker: Maker, at: End, usual: f64) -> Option<Self> {
        let about = |half: DVec2| [at.at + half * DVec2::new(-1.0, 1.0), at.at + half * DVec2::new(1.0, -1.0)];
        let beside = |by: DVec2| [at.at, at.at + by];
        let [from, to] = match maker.primitive {
            Primitive::Box | Primitive::Frame => about(DVec2::splat(0.5 * usual)),
            Primitive::SolidBox => about(DVec2::new(usual, 0.25 * usual)),
            Primitive::Cloth => about(DVec2::new(usual, 0.75 * usual)),
            Primitive::Disc | Primitive::SolidCircle => beside(DVec2::new(0.5 * usual, 0.0)),
            Primitive::Rim => beside(DVec2::new(0.75 * usual, 0.0)),
            Primitive::Rope => beside(down(usual)),
            Primitive::Figure => about(DVec2::new(0.0, 0.5 * TALL * usual)),
            Primitive::Slope | Primitive::Plane => beside(DVec2::new(usual, 0.0)),
            Primitive::Bonds | Primitive::Polygon => return None,
        };
        let end = |at: DVec2, hold: Hold| End { at, hold };
        Form::drawn(maker, [end(from, at.hold), end(to, Hold::None)], usual)
    }

    fn rope(ends: [End; 2], usual: f64, slack: f64) -> Self {
        let [from, to] = ends;
        let is_on_a_point = |end: End| matches!(end.hold, Hold::Point(_));
        let slack = if has_slack(&ends) { slack } else { 0.0 };
        let ends = if is_on_a_point(to) && !is_on_a_point(from) { [to, from] } else { ends };
        let pieces = PIECES * (1.0 + slack) * from.at.distance(to.at) / usual;
        Form::Rope { ends, pieces: pieces.round().clamp(ALL_PIECES[0], ALL_PIECES[1]) as u32, slack }
    }

    /// Its size, as one says it, and of how many points it is where that is chosen.
    pub(super) fn said(&self, keys: &AddKeys) -> String {
        let size = self.words();
        match self {
            Form::Box(_) | Form::Frame(_) | Form::Disc(_) | Form::Rim(_) => {
                format!("{size}, {}", counted(keys.point_count(&Scene::default()), "point"))
            }
            _ => size,
        }
    }

    /// What the start and the end of a rope hang on that was drawn from a place `[m]`: its points are numbered from the end that is tied.
    pub(super) fn holds(&self, from: DVec2) -> Option<[Hold; 2]> {
        let Form::Rope { ends: [first, last], .. } = self else { return None };
        let is_turned = last.at.distance(from) < first.at.distance(from);
        Some(if is_turned { [last.hold, first.hold] } else { [first.hold, last.hold] })
    }

    /// Its size, as one says it.
    pub(super) fn words(&self) -> String {
        let sides = |size: DVec2| format!("{} × {} m", short(size.x), short(size.y));
        match self {
            Form::Box(grid) | Form::Cloth { grid, .. } => sides(grid.size()),
            Form::SolidBox([low, high]) | Form::Frame([low, high]) => sides(*high - *low),
            Form::Disc(round) | Form::Rim(round) | Form::SolidCircle(round) => {
                format!("radius {} m", short(round.radius))
            }
            Form::Rope { ends: [from, to], slack, .. } => {
                let long = short((1.0 + slack) * from.at.distance(to.at));
                let more = if has_slack(&[*from, *to]) {
                    format!(", {:.0} % slack (wheel)", 100.0 * slack)
                } else {
                    String::new()
                };
                format!("{long} m{more}")
            }
            Form::Figure(figure) => format!("{} m tall", short(figure.tall)),
            Form::Slope(Plank { along, .. }) => {
                format!("{} m, {:.0}°", short(along.length()), along.to_angle().to_degrees() + 0.0)
            }
            Form::Plane([_, along]) => {
                format!("{:.0}°, without an end, solid where it is hatched", along.to_angle().to_degrees() + 0.0)
            }
        }
    }
}

/// Whether a rope is longer than the straight way: between two points, or two pins.
fn has_slack(ends: &[End; 2]) -> bool {
    let both = |is: fn(&End) -> bool| ends.iter().all(is);
    both(|end| matches!(end.hold, Hold::Point(_))) || both(|end| end.hold == Hold::Pin)
}

/// Where the corners of a rope between two places are, `pieces` of them of one length `[m]`.
pub(super) fn chain([from, to]: [DVec2; 2], pieces: u32, slack: f64) -> Vec<DVec2> {
    let way = to - from;
    hanging([way.x, way.y, 0.0], u64::from(pieces), slack)
        .into_iter()
        .map(|[x, y, _]| from + DVec2::new(x, y))
        .collect()
}

/// From where a rope is clicked to its end, where what a click makes is so large `[m]`.
fn down(usual: f64) -> DVec2 {
    DVec2::new(0.0, -2.0 * usual)
}

/// A length `[m]`, or a force `[N]`, in as many digits as are of use.
pub(in crate::app::tools) fn short(number: f64) -> String {
    match number.abs() {
        small if small < 0.1 => format!("{number:.3}"),
        usual if usual < 10.0 => format!("{number:.2}"),
        large if large < 100.0 => format!("{number:.1}"),
        _ => format!("{number:.0}"),
    }
}
