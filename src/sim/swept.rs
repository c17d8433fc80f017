//! Which bodies may meet in a step: boxes swept by their ways, and blows that are passed on from one to the next.

use super::real::Real;
use super::sets::Sets;

/// How much faster a body may get within a step, or go askew, about.
const FASTER: f64 = 1.5;
/// Bodies in a row that a blow goes through within a step.
const ROW: u32 = 16;

/// A box in which a body stays for some time.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Swept<S, const D: usize> {
    pub(crate) low: [S; D],
    pub(crate) high: [S; D],
    /// Its fastest point, along one axis `[m/s]`.
    fastest: S,
    /// What is left around it `[m]`.
    margin: S,
}

impl<S: Real, const D: usize> Swept<S, D> {
    /// The box that points, each with its velocity, may get to within `h` `[s]`, pushed by at most `pushed` `[m/s^2]`, and `margin` around
    /// it `[m]`; `None` where there is no point.
    pub(crate) fn new(
        points: impl Iterator<Item = ([S; D], [S; D])>,
        (h, pushed): (f64, f64),
        margin: S,
    ) -> Option<Self> {
        let (mut low, mut high, mut fastest) = ([S::INFINITY; D], [-S::INFINITY; D], S::ZERO);
        for (x, v) in points {
            for k in 0..D {
                low[k] = low[k].min(x[k]);
                high[k] = high[k].max(x[k]);
                fastest = fastest.max(v[k].abs());
            }
        }
        let way = S::from_f64(FASTER) * (fastest * S::from_f64(h) + S::from_f64(h * h * pushed)) + margin;
        (low[0] <= high[0]).then_some(Swept { low, high, fastest, margin }).map(|swept| swept.grown(way))
    }

    pub(crate) fn bounds(&self) -> [[S; D]; 2] {
        [self.low, self.high]
    }

    /// What it has in common with another one of the same body.
    pub(crate) fn within(self, other: &Self) -> Self {
        let (low, high) = (
            std::array::from_fn(|k| self.low[k].max(other.low[k])),
            std::array::from_fn(|k| self.high[k].min(other.high[k])),
        );
        Swept { low, high, ..self }
    }

    /// The box around both.
    pub(crate) fn with(self, other: &Self) -> Self {
        Swept {
            low: std::array::from_fn(|k| self.low[k].min(other.low[k])),
            high: std::array::from_fn(|k| self.high[k].max(other.high[k])),
            fastest: self.fastest.max(other.fastest),
            margin: self.margin.max(other.margin),
        }
    }

    pub(crate) fn overlaps(&self, other: &Self) -> bool {
        (0..D).all(|k| self.low[k] <= other.high[k] && other.low[k] <= self.high[k])
    }

    /// The same with more left around it `[m]`.
    pub(crate) fn around(self, margin: S) -> Self {
        Swept { margin: self.margin + margin, ..self }.grown(margin)
    }

    fn grown(self, by: S) -> Self {
        Swept { low: self.low.map(|x| x - by), high: self.high.map(|x| x + by), ..self }
    }

    /// The same, wider.
    pub(crate) fn widen(&self) -> Swept<f64, D> {
        let wide = |x: [S; D]| x.map(Real::to_f64);
        let (fastest, margin) = (self.fastest.to_f64(), self.margin.to_f64());
        Swept { low: wide(self.low), high: wide(self.high), fastest, margin }
    }

    /// How much further it gets in `h` `[s]` than its box says, if it is struck by what is so fast `[m/s]`; `None`: no further than what is
    /// left around it.
    fn further(&self, speed: S, h: f64) -> Option<S> {
        let further = S::from_f64(FASTER * h) * (speed - self.fastest);
        (further > self.margin).then_some(further)
    }
}

/// Bodies ascending along the first axis by their boxes, as [`meetings`] takes them.
pub(crate) fn sort<T, S: Real, const D: usize>(list: &mut [T], swept: impl Fn(&T) -> &Swept<S, D>) {
    list.sort_by(|a, b| swept(a).low[0].partial_cmp(&swept(b).low[0]).unwrap_or(std::cmp::Ordering::Equal));
}

/// Tells of all couples in a sorted list whose boxes overlap, by their places there.
pub(crate) fn meetings<T, S: Real, const D: usize>(
    list: &[T],
    swept: impl Fn(&T) -> &Swept<S, D>,
    mut tell: impl FnMut([usize; 2]),
) {
    let mut open: Vec<usize> = Vec::new();
    for place in 0..list.len() {
        let own = swept(&list[place]);
        open.retain(|&other| swept(&list[other]).high[0] >= own.low[0]);
        open.iter().filter(|&&other| swept(&list[other]).overlaps(own)).for_each(|&other| tell([other, place]));
        open.push(place);
    }
}

/// Boxes of what may be struck within `h` `[s]` get as wide as the blow carries; `strikes`: whether the first may strike the second.
/// Leaves the list sorted.
pub(crate) fn pass_on<T, S: Real, const D: usize>(
    list: &mut [T],
    swept: impl Fn(&T) -> &Swept<S, D>,
    mut put: impl FnMut(&mut T, Swept<S, D>),
    h: f64,
    strikes: impl Fn(&T, &T) -> bool,
) {
    let fastest = list.iter().fold(S::ZERO, |most, body| most.max(swept(body).fastest));
    for _ in 0..ROW {
        sort(list, &swept);
        if list.iter().all(|body| swept(body).further(fastest, h).is_none()) {
            return;
        }
        // The hardest blow of each counts.
        let mut blows = vec![S::ZERO; list.len()];
        meetings(list, &swept, |[a, b]| {
            for [from, to] in [[a, b], [b, a]] {
                let speed = swept(&list[from]).fastest;
                let is_harder = speed > blows[to] && swept(&list[to]).further(speed, h).is_some();
                if is_harder && strikes(&list[from], &list[to]) {
                    blows[to] = speed;
                }
            }
        });
        let mut is_done = true;
        for (body, speed) in list.iter_mut().zip(blows) {
            if let Some(further) = swept(body).further(speed, h) {
                let grown = Swept { fastest: speed, ..swept(body).grown(further) };
                put(body, grown);
                is_done = false;
            }
        }
        if is_done {
            return;
        }
    }
    sort(list, &swept);
}

/// Bodies, by their numbers, that may meet within `h` `[s]`, or strike each other through others, come together.
pub(crate) fn join<S: Real, const D: usize>(together: &mut Sets, mut bodies: Vec<(usize, Swept<S, D>)>, h: f64) {
    pass_on(&mut bodies, |body| &body.1, |body, grown| body.1 = grown, h, |_, _| true);
    let of = |place: usize| bodies[place].0 as u32;
    meetings(&bodies, |body| &body.1, |[a, b]| together.join(of(a), of(b)));
}
