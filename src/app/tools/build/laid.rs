//! Where what is built in space lies: on or before what is seen under the pointer, never within it, for who draws sees no depth. A cloth lies
//! before all balls and boxes that are seen where it is drawn.

use glam::{DVec2, DVec3};

use super::Drag;
use super::space::Form;
use crate::app::tools::pick::Scope;
use crate::sim::Figure;

/// Steps by which something is brought nearer until it is clear of all that stands there, each by this share of the way to the eye, and how
/// many of them: to a seventh of it.
const NEARER: f64 = 0.97;
const STEPS: u32 = 64;
/// Halvings of the last step.
const HALVINGS: u32 = 12;
/// What is no deeper in something touches it, in distances of the camera `[1]`.
const TOUCHES: f64 = 1e-6;
/// Places along a rope that are looked at.
const PLACES: u32 = 64;
/// A rope keeps so far off what it is laid over at first `[logical px]`; so often twice as far where its pieces would cut it.
const OFF: f64 = 2.0;
const DOUBLINGS: u32 = 5;
/// What a surface before this share of the way to it hides lies behind that, not on it `[1]`.
const HIDDEN: f64 = 0.98;
/// Nothing is laid nearer to the eye than this share of the way to it `[1]`.
const NEAREST: f64 = 0.1;

/// How what is built lies to what stands there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Lies {
    /// As deep as what was pressed on.
    There,
    /// Nearer than that, clear of all.
    Before,
    /// Nowhere on the way to the eye it would be clear.
    Within,
}

impl Lies {
    /// What is said of it behind its size.
    pub(super) fn words(self) -> &'static str {
        match self {
            Lies::There => "",
            Lies::Before => ", in front of what is there",
            Lies::Within => ": no room, something is in the way",
        }
    }
}

/// The place of the foremost surface that is seen at a pixel, of a body, a ball, a box, or of a plane as far as that is drawn `[m]`; `None` where
/// none is.
pub(super) fn surface(scope: Scope<'_>, at: DVec2) -> Option<DVec3> {
    let body = scope.nearest(at).map(|hit| scope.facing(DVec3::from(scope.shown.place(hit.point.index())), at));
    let all = body.into_iter().chain(scope.entry(at)).filter(|place| place.is_finite());
    all.min_by(|a, b| scope.camera.depth(*a).total_cmp(&scope.camera.depth(*b)))
}

/// Whether a ball or a box stands before a place that is seen about a pixel, by more than the place touches it.
pub(super) fn is_hidden(scope: Scope<'_>, at: DVec2, place: DVec3) -> bool {
    let eye = DVec3::from(scope.camera.cursor(at.to_array()).origin);
    let ray = [eye.to_array(), (place - eye).to_array()];
    let before = |figure: &Figure| figure.entry(ray, 0.0).is_some_and(|share| share < HIDDEN);
    scope.shown.scenery.convex.iter().any(|convex| before(&convex.figure))
}

/// What stands in a world of space.
pub(super) struct Solids {
    eye: DVec3,
    /// What is no deeper in something touches it `[m]`.
    slack: f64,
    figures: Vec<Figure>,
    /// A place and the unit normal of each plane that is seen from its free side.
    planes: Vec<[DVec3; 2]>,
    bounds: Option<[DVec3; 2]>,
}

impl Solids {
    pub(super) fn of(scope: Scope<'_>, at: DVec2) -> Self {
        let scenery = &scope.shown.scenery;
        let eye = DVec3::from(scope.camera.cursor(at.to_array()).origin);
        let plane = |[point, normal]: &[[f64; 3]; 2]| {
            let (point, normal) = (DVec3::from(*point), DVec3::from(*normal).try_normalize()?);
            ((eye - point).dot(normal) > 0.0).then_some([point, normal])
        };
        Solids {
            eye,
            slack: TOUCHES * scope.camera.distance(),
            figures: scenery.convex.iter().map(|convex| convex.figure).collect(),
            planes: scenery.planes.iter().filter_map(plane).collect(),
            bounds: scenery.bounds.map(|corners| corners.map(DVec3::from)),
        }
    }

    /// Whether nothing lies within so far of a place `[m]`.
    fn has_room(&self, place: DVec3, apart: f64) -> bool {
        let apart = apart - self.slack;
        !self.figures.iter().any(|figure| figure.holds(place.to_array(), apart))
            && self.planes.iter().all(|[point, normal]| (place - *point).dot(*normal) >= apart)
    }

    /// Whether a place of a body is free, and within the walls.
    fn is_free(&self, place: DVec3) -> bool {
        let is_in =
            |[low, high]: [DVec3; 2]| place.cmpge(low - self.slack).all() && place.cmple(high + self.slack).all();
        self.has_room(place, 0.0) && self.bounds.is_none_or(is_in)
    }

    /// Whether a ball or a box is seen before a place.
    fn is_hidden(&self, place: DVec3) -> bool {
        let ray = [self.eye.to_array(), (place - self.eye).to_array()];
        self.figures.iter().any(|figure| figure.entry(ray, 0.0).is_some_and(|share| share < HIDDEN))
    }

    /// Whether something would lie in nothing, and be seen: a cloth all over, what stands on the ground may stand behind something.
    fn is_clear(&self, form: &Form) -> bool {
        match form {
            Form::Rope { corners, .. } => self.is_clear_of(corners),
            Form::Cloth { corner, cell: [u, v], cells: [columns, rows], .. } => {
                let node = |i: u32, j: u32| *corner + f64::from(i) * *u + f64::from(j) * *v;
                let is_seen = |place: DVec3| self.is_free(place) && !self.is_hidden(place);
                (0..=*rows).all(|j| (0..=*columns).all(|i| is_seen(node(i, j))))
            }
            Form::Ball { center, radius } => self.has_room(*center, *radius),
            Form::Box([low, high]) => {
                let (middle, half) = (0.5 * (*low + *high), 0.5 * (*high - *low));
                let sides = || [-1.0, 0.0, 1.0].into_iter();
                let mut all =
                    sides().flat_map(|x| sides().flat_map(move |y| sides().map(move |z| DVec3::new(x, y, z))));
                let [min, max] = [low, high].map(|corner| corner.to_array());
                let own = Figure::Box { min, max, axis: [0.0, 0.0, 1.0], angle: 0.0 };
                let is_in = |figure: &Figure| match (figure, figure.frame()) {
                    (&Figure::Ball { center, radius }, _) => own.holds(center, radius - self.slack),
                    (_, Some(frame)) => frame.corners().into_iter().any(|corner| own.holds(corner, -self.slack)),
                    _ => false,
                };
                all.all(|of| self.has_room(middle + of * half, 0.0)) && !self.figures.iter().any(is_in)
            }
        }
    }

    /// Whether a chain lies in nothing, the middles of its pieces neither.
    fn is_clear_of(&self, corners: &[DVec3]) -> bool {
        let middles = corners.windows(2).map(|pair| pair[0].midpoint(pair[1]));
        corners.iter().copied().chain(middles).all(|place| self.is_free(place))
    }

    /// What a drag comes to by `make`, as deep as it was begun, or as much nearer as leaves it clear of all that stands there.
    pub(super) fn before(
        &self,
        begun: Drag,
        make: impl Fn(Drag) -> Result<Form, String>,
    ) -> Result<(Form, Lies), String> {
        let first = make(begun)?;
        if self.is_clear(&first) {
            return Ok((first, Lies::There));
        }
        let at = |share: f64| make(Drag { deep: self.eye + share * (begun.deep - self.eye), ..begun });
        let clear = |share: f64| at(share).ok().filter(|form| self.is_clear(form));
        let mut shares = (1..=STEPS).map(|step| NEARER.powf(f64::from(step)));
        let Some(mut near) = shares.find(|share| clear(*share).is_some()) else {
            return Ok((first, Lies::Within));
        };
        let mut far = near / NEARER;
        for _ in 0..HALVINGS {
            let middle = 0.5 * (near + far);
            *(if clear(middle).is_some() { &mut near } else { &mut far }) = middle;
        }
        Ok((at(near)?, Lies::Before))
    }

    /// A chain between two places, laid before what its straight way leads through, in pieces of one length: `pieces` says how many there
    /// are along so far `[m]`. Ends that are tied stay.
    pub(super) fn laid(
        &self,
        scope: Scope<'_>,
        (ends, is_tied): ([DVec3; 2], [bool; 2]),
        pieces: impl Fn(f64) -> u32,
    ) -> (Vec<DVec3>, Lies) {
        let straight = |count: u32| -> Vec<DVec3> {
            (0..=count).map(|k| ends[0].lerp(ends[1], f64::from(k) / f64::from(count))).collect()
        };
        let places = straight(PLACES);
        let own = straight(pieces(ends[0].distance(ends[1])));
        let inner = &places[usize::from(is_tied[0])..places.len() - usize::from(is_tied[1])];
        if inner.iter().all(|place| self.is_free(*place)) {
            return (own, Lies::There);
        }
        let figures: Vec<&Figure> = self
            .figures
            .iter()
            .filter(|figure| inner.iter().any(|place| figure.holds(place.to_array(), -self.slack)))
            .collect();
        for doubling in 0..=DOUBLINGS {
            let off = OFF * f64::from(1 << doubling) * scope.scale / scope.camera.pixels_per_metre();
            let way: Option<Vec<DVec3>> = (0..=PLACES)
                .zip(&places)
                .map(|(k, &place)| {
                    let stays = k == 0 && is_tied[0] || k == PLACES && is_tied[1];
                    if stays { Some(place) } else { self.brought(place, &figures, off) }
                })
                .collect();
            let Some(way) = way else { break };
            let long = way.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
            let chain = along(&way, pieces(long));
            let free = &chain[usize::from(is_tied[0])..chain.len() - usize::from(is_tied[1])];
            if self.is_clear_of(free) {
                return (chain, Lies::Before);
            }
        }
        (own, Lies::Within)
    }

    /// A place brought towards the eye until it is off some figures and all planes by so far `[m]`; `None`: that would be too near.
    fn brought(&self, place: DVec3, figures: &[&Figure], off: f64) -> Option<DVec3> {
        let ray = [self.eye.to_array(), (place - self.eye).to_array()];
        let fronts = figures.iter().filter_map(|figure| figure.entry(ray, -off));
        let gap = |at: DVec3, [point, normal]: &[DVec3; 2]| (at - *point).dot(*normal) - off;
        let planes = self.planes.iter().filter_map(|plane| {
            let [here, there] = [self.eye, place].map(|at| gap(at, plane));
            (there < 0.0 && here > 0.0).then(|| here / (here - there))
        });
        let share = fronts.chain(planes).fold(1.0, f64::min);
        (share > NEAREST).then(|| self.eye + share * (place - self.eye))
    }
}

/// Places along a way, so many pieces of it, each as long.
fn along(way: &[DVec3], pieces: u32) -> Vec<DVec3> {
    let lengths: Vec<f64> = way.windows(2).map(|pair| pair[0].distance(pair[1])).collect();
    let long: f64 = lengths.iter().sum();
    let at = |far: f64| {
        let mut left = far;
        for (pair, &length) in way.windows(2).zip(&lengths) {
            if left <= length {
                return pair[0].lerp(pair[1], left / length.max(f64::MIN_POSITIVE));
            }
            left -= length;
        }
        way[way.len() - 1]
    };
    (0..=pieces).map(|k| at(long * f64::from(k) / f64::from(pieces))).collect()
}
