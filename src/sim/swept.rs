//! Which bodies may meet in a step: boxes swept by their ways, and blows that are passed on from one to the next.

use super::real::Real;
use super::sets::Sets;

/// How much faster a body may get within a step, or go askew, about.
const FASTER: f64 = 1.5;
/// Bodies in a row that a blow goes through within a step.
const ROW: u32 = 16;
/// Couples that are looked at for blows for each body, and at least in all: of a crowd in one place each is struck by what is fastest.
const MOST_LOOKS: [usize; 2] = [256, 4_000_000];
/// Boxes that a box is looked at against until those that hang together are looked at as the box around them.
const MOST_OPEN: usize = 512;

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

    /// Whether all that meets the other one, and begins no sooner along the first axis, meets this one.
    fn covers(&self, other: &Self) -> bool {
        self.high[0] >= other.high[0] && (1..D).all(|k| self.low[k] <= other.low[k] && self.high[k] >= other.high[k])
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

/// Bodies ascending along the first axis by their boxes, as [`chains`] takes them.
pub(crate) fn sort<T, S: Real, const D: usize>(list: &mut [T], swept: impl Fn(&T) -> &Swept<S, D>) {
    list.sort_by(|a, b| swept(a).low[0].partial_cmp(&swept(b).low[0]).unwrap_or(std::cmp::Ordering::Equal));
}

/// Tells of all couples in a sorted list whose boxes overlap, by their places there. Returns whether it could: it looks at so many at `most`.
fn meetings<T, S: Real, const D: usize>(
    list: &[T],
    swept: impl Fn(&T) -> &Swept<S, D>,
    mut most: usize,
    mut tell: impl FnMut([usize; 2]),
) -> bool {
    let mut open: Vec<usize> = Vec::new();
    for place in 0..list.len() {
        let own = swept(&list[place]);
        open.retain(|&other| swept(&list[other]).high[0] >= own.low[0]);
        if open.len() > most {
            return false;
        }
        most -= open.len();
        open.iter().filter(|&&other| swept(&list[other]).overlaps(own)).for_each(|&other| tell([other, place]));
        open.push(place);
    }
    true
}

/// Tells of couples in a sorted list whose boxes overlap, by their places there: of all, but for what others stand for.
///
/// `tell` says whether the two stand for each other from then on: then nobody has to be told of the one that lies within the other. Those that are
/// `loose` do not meet each other. So what lies in one place takes no more than what lies apart; where more than [`MOST_OPEN`] boxes lie beside
/// each other, those that stand for each other count as the box around them, which may meet more.
pub(crate) fn chains<T, S: Real, const D: usize>(
    list: &[T],
    swept: impl Fn(&T) -> &Swept<S, D>,
    is_loose: impl Fn(&T) -> bool,
    mut tell: impl FnMut([usize; 2]) -> bool,
) {
    // Those that are loose, and the others.
    let mut open: [Vec<(usize, Swept<S, D>)>; 2] = Default::default();
    for (place, of) in list.iter().enumerate() {
        let (mut own, is_loose) = (*swept(of), is_loose(of));
        let mut is_covered = false;
        for (kind, list) in open.iter_mut().enumerate() {
            if kind == 0 && is_loose {
                continue;
            }
            let is_crowd = list.len() > MOST_OPEN;
            list.retain(|(other, around)| {
                if around.high[0] < own.low[0] {
                    return false;
                }
                let is_one = around.overlaps(&own) && tell([*other, place]) && (kind == 0) == is_loose;
                if is_one && is_crowd {
                    own = own.with(around);
                    return false;
                }
                is_covered |= is_one && around.covers(&own);
                is_covered || !(is_one && own.covers(around))
            });
        }
        if !is_covered {
            open[usize::from(!is_loose)].push((place, own));
        }
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
        let most = (MOST_LOOKS[0] * list.len()).max(MOST_LOOKS[1]);
        let is_seen = meetings(list, &swept, most, |[a, b]| {
            for [from, to] in [[a, b], [b, a]] {
                let speed = swept(&list[from]).fastest;
                let is_harder = speed > blows[to] && swept(&list[to]).further(speed, h).is_some();
                if is_harder && strikes(&list[from], &list[to]) {
                    blows[to] = speed;
                }
            }
        });
        if !is_seen {
            blows.fill(fastest);
        }
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
    chains(
        &bodies,
        |body| &body.1,
        |_| false,
        |[a, b]| {
            together.join(of(a), of(b));
            true
        },
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Boxes of sizes up to `size` in the unit square, sorted.
    fn boxes(count: u32, size: f64) -> Vec<(usize, Swept<f64, 2>)> {
        let share = |k: u32, by: f64| (f64::from(k) * by).fract();
        let of = |k: u32| {
            let low = [share(k, 0.754_877_666), share(k, 0.569_840_29)];
            let wide = [share(k, 0.618_034) * size, share(k, 0.414_213_56) * size];
            Swept { low, high: [low[0] + wide[0], low[1] + wide[1]], fastest: 0.0, margin: 0.0 }
        };
        let mut list: Vec<_> = (0..count).map(|k| (k as usize, of(k))).collect();
        sort(&mut list, |body| &body.1);
        list
    }

    #[test]
    fn chains_put_together_what_all_couples_would() {
        for size in [0.01, 0.05, 0.1, 0.3] {
            let list = boxes(400, size);
            let [mut by_couples, mut by_chains] = [Sets::new(400), Sets::new(400)];
            let all = meetings(
                &list,
                |body| &body.1,
                usize::MAX,
                |[a, b]| by_couples.join(list[a].0 as u32, list[b].0 as u32),
            );
            join(&mut by_chains, list, 1.0);
            assert!(all);
            assert!((0..400).all(|k| by_couples.find(k) == by_chains.find(k)), "{size}");
        }
    }

    #[test]
    fn what_lies_in_one_place_is_looked_at_once_each() {
        let one = Swept { low: [0.0; 2], high: [1.0; 2], fastest: 0.0, margin: 0.0 };
        let list: Vec<(usize, Swept<f64, 2>)> = (0..10_000).map(|k| (k, one)).collect();
        let mut told = 0;
        chains(
            &list,
            |body| &body.1,
            |_| false,
            |_| {
                told += 1;
                true
            },
        );
        assert_eq!(told, 9_999);
        assert!(!meetings(&list, |body| &body.1, 1_000_000, |_| {}), "all couples are too many");
        chains(&list, |body| &body.1, |_| true, |_| unreachable!("what is loose does not meet"));
    }

    #[test]
    fn a_crowd_beside_each_other_hangs_together_as_the_box_around_it() {
        let of = |k: u32| Swept {
            low: [f64::from(k) * 1e-6, f64::from(k * 7 % 20_000) * 1e-5],
            high: [1.0 + f64::from(k) * 1e-6, f64::from(k * 7 % 20_000) * 1e-5 + 0.1],
            fastest: 0.0,
            margin: 0.0,
        };
        let list: Vec<(usize, Swept<f64, 2>)> = (0..20_000).map(|k| (k as usize, of(k))).collect();
        let mut sets = Sets::new(list.len());
        let mut told = 0;
        chains(
            &list,
            |body| &body.1,
            |_| false,
            |[a, b]| {
                told += 1;
                sets.join(a as u32, b as u32);
                true
            },
        );
        assert!((0..20_000).all(|k| sets.find(k) == 0));
        assert!(told < 20_000 * MOST_OPEN, "{told}");
    }
}
