//! Which bodies may meet in a step: boxes, how fast they may come at each other, and blows that are passed on from one to the next.
//!
//! What flies side by side does not meet, however fast it flies: of two bodies only what one does beside the other counts. So each has a box
//! where it is, and the velocities that it may take: those of its points alone as long as it is free; all up to its speed, where something
//! that stays may throw it back; and where two may strike each other those of both, and beyond them, for what is light is thrown back.

mod velocities;

use super::points::Points;
use super::real::Real;
use super::sets::Sets;
use super::vector::sub;
use velocities::Velocities;

/// How much faster a body may get within a step, or go askew, about.
const FASTER: f64 = 1.5;
/// Bodies in a row that a blow goes through within a step.
const ROW: u32 = 16;
/// Couples that are looked at for blows for each body, and at least in all: of a crowd in one place each is struck by what is fastest.
const MOST_LOOKS: [usize; 2] = [256, 4_000_000];
/// Boxes that a box is looked at against until those that hang together are looked at as the box around them.
const MOST_OPEN: usize = 512;

/// A time, and what pushes bodies in it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Span {
    /// `[s]`.
    pub(crate) h: f64,
    /// What gives all the same, as long as nothing holds them `[m/s^2]`.
    pub(crate) fall: f64,
    /// What else is given to them at most `[m/s^2]`.
    pub(crate) pushed: f64,
}

/// Where a body is, and where it may get to in some time.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Swept<S, const D: usize> {
    /// The box in which it stays.
    pub(crate) low: [S; D],
    pub(crate) high: [S; D],
    /// The box around it at first, and what is left there around it `[m]`.
    first: [[S; D]; 2],
    margin: S,
    /// What it has, and what strikes it; and what it may take of that.
    struck: Velocities<S, D>,
    velocities: Velocities<S, D>,
    /// How far it is pushed at most, and how far all fall `[m]`.
    pushed: S,
    falls: S,
    /// Something may keep it from falling with the others.
    is_held: bool,
    /// Time by [`FASTER`] `[s]`.
    time: S,
}

impl<S: Real, const D: usize> Swept<S, D> {
    /// Of points, each with its velocity, which meet nothing that stays where it is, and `margin` around them `[m]`; `None` where there is
    /// no point.
    pub(crate) fn new(points: impl Iterator<Item = ([S; D], [S; D])>, span: Span, margin: S) -> Option<Self> {
        let none = ([S::INFINITY; D], [-S::INFINITY; D]);
        let ((mut low, mut high), (mut slow, mut fast)) = (none, none);
        for (x, v) in points {
            for k in 0..D {
                (low[k], high[k]) = (low[k].min(x[k]), high[k].max(x[k]));
                (slow[k], fast[k]) = (slow[k].min(v[k]), fast[k].max(v[k]));
            }
        }
        let time = S::from_f64(FASTER * span.h);
        let way = |push: f64| time * S::from_f64(span.h * push);
        let middle = std::array::from_fn(|k| S::HALF * (slow[k] + fast[k]));
        let around = (0..D).fold(S::ZERO, |most, k| most.max(S::HALF * (fast[k] - slow[k])));
        let swept = Swept {
            low,
            high,
            first: [low.map(|x| x - margin), high.map(|x| x + margin)],
            margin,
            struck: Velocities { middle, around },
            velocities: Velocities { middle, around },
            pushed: way(span.pushed),
            falls: way(span.fall),
            is_held: false,
            time,
        };
        (low[0] <= high[0]).then(|| swept.gone())
    }

    /// Of some points of a group, by their slots: held, where one of them is pinned.
    pub(crate) fn of(
        points: &Points<S, D>,
        slots: impl Iterator<Item = usize> + Clone,
        span: Span,
        margin: S,
    ) -> Option<Self> {
        let swept = Swept::new(slots.clone().map(|i| (points.position[i], points.velocity[i])), span, margin)?;
        let is_pinned = slots.into_iter().any(|i| points.inverse_mass[i] == S::ZERO);
        Some(if is_pinned { swept.held() } else { swept })
    }

    /// Held, if something in the box in which it stays may throw it back.
    pub(crate) fn settled(self, may_touch: impl FnOnce([[S; D]; 2]) -> bool) -> Self {
        if may_touch(self.bounds()) { self.held() } else { self }
    }

    /// With the box in which it stays.
    fn gone(self) -> Self {
        let Swept { first: [low, high], velocities: Velocities { middle, around }, time, .. } = self;
        let room = self.pushed + self.falls;
        Swept {
            low: std::array::from_fn(|k| low[k] + time * (middle[k] - around).min(S::ZERO) - room),
            high: std::array::from_fn(|k| high[k] + time * (middle[k] + around).max(S::ZERO) + room),
            ..self
        }
    }

    /// The same of a body that is pinned, or that what does not move may throw back.
    pub(crate) fn held(self) -> Self {
        let [struck, velocities] = [self.struck, self.velocities].map(Velocities::held);
        Swept { struck, velocities, is_held: true, ..self }.gone()
    }

    /// The same of a body that these velocities strike too, which takes it further than what is left around it; `None`: no further.
    fn struck_by(self, other: Velocities<S, D>) -> Option<Self> {
        let struck = self.struck.with(other);
        let velocities = self.velocities.with(struck.thrown());
        self.goes_further(velocities).then(|| Swept { struck, velocities, ..self }.gone())
    }

    /// The same of what does not fall.
    pub(crate) fn staying(self) -> Self {
        Swept { is_held: true, ..self }
    }

    pub(crate) fn bounds(&self) -> [[S; D]; 2] {
        [self.low, self.high]
    }

    /// The same with more left around it `[m]`.
    pub(crate) fn around(self, margin: S) -> Self {
        let [low, high] = self.first;
        let first = [low.map(|x| x - margin), high.map(|x| x + margin)];
        Swept { first, margin: self.margin + margin, ..self }.gone()
    }

    /// Whether all that meets the other one meets this one.
    fn covers(&self, other: &Self) -> bool {
        let has_all = |k: usize| self.first[0][k] <= other.first[0][k] && other.first[1][k] <= self.first[1][k];
        (0..D).all(has_all)
            && self.velocities.contain(other.velocities)
            && other.pushed <= self.pushed
            && (self.is_held || !other.is_held)
    }

    /// The box around both, of bodies that go together.
    pub(crate) fn with(self, other: Self) -> Self {
        let [[low, high], [others_low, others_high]] = [self.first, other.first];
        let first =
            [std::array::from_fn(|k| low[k].min(others_low[k])), std::array::from_fn(|k| high[k].max(others_high[k]))];
        let (struck, velocities) = (self.struck.with(other.struck), self.velocities.with(other.velocities));
        let is_held = self.is_held || other.is_held;
        Swept { first, struck, velocities, is_held, pushed: self.pushed.max(other.pushed), ..self }.gone()
    }

    /// Of two of the same body the one that it is more closely in.
    pub(crate) fn or_smaller(self, other: Self) -> Self {
        let size = |one: &Self| (0..D).fold(S::ZERO, |sum, k| sum + one.high[k] - one.low[k]);
        if size(&other) < size(&self) { other } else { self }
    }

    /// Whether the boxes in which they stay overlap, and they may come that far at each other.
    pub(crate) fn meets(&self, other: &Self) -> bool {
        let is_near = (0..D).all(|k| self.low[k] <= other.high[k] && other.low[k] <= self.high[k]);
        is_near && {
            let fall = |one: &Self| if one.is_held { one.falls } else { S::ZERO };
            let room = self.pushed + other.pushed + fall(self) + fall(other);
            let around = self.velocities.around + other.velocities.around;
            let comes = sub(self.velocities.middle, other.velocities.middle);
            (0..D).all(|k| {
                let [below, above] =
                    [other.first[0][k] - self.first[1][k], self.first[0][k] - other.first[1][k]].map(|gap| gap - room);
                below <= self.time * (around + comes[k]).max(S::ZERO)
                    && above <= self.time * (around - comes[k]).max(S::ZERO)
            })
        }
    }

    /// The same, wider.
    pub(crate) fn widen(&self) -> Swept<f64, D> {
        let wide = |x: [S; D]| x.map(Real::to_f64);
        Swept {
            low: wide(self.low),
            high: wide(self.high),
            first: self.first.map(wide),
            margin: self.margin.to_f64(),
            struck: self.struck.widen(),
            velocities: self.velocities.widen(),
            pushed: self.pushed.to_f64(),
            falls: self.falls.to_f64(),
            is_held: self.is_held,
            time: self.time.to_f64(),
        }
    }

    /// Whether other velocities than its own take it further than what is left around it.
    fn goes_further(&self, velocities: Velocities<S, D>) -> bool {
        self.time * self.velocities.lack(velocities) > self.margin
    }
}

/// Bodies ascending along the first axis by their boxes, as [`chains`] takes them.
pub(crate) fn sort<T, S: Real, const D: usize>(list: &mut [T], swept: impl Fn(&T) -> &Swept<S, D>) {
    list.sort_by(|a, b| swept(a).low[0].partial_cmp(&swept(b).low[0]).unwrap_or(std::cmp::Ordering::Equal));
}

/// Tells of all couples in a sorted list that may meet, by their places there. Returns whether it could: it looks at so many at `most`.
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
        open.iter().filter(|&&other| swept(&list[other]).meets(own)).for_each(|&other| tell([other, place]));
        open.push(place);
    }
    true
}

/// Tells of couples in a sorted list that may meet, by their places there: of all, but for what others stand for.
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
                let is_one = around.meets(&own) && tell([*other, place]) && (kind == 0) == is_loose;
                if is_one && is_crowd {
                    own = own.with(*around);
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

/// What may be struck within the time takes the velocities that the blow may give it; `strikes`: whether the first may strike the second, so
/// that this one goes on; `put` says what comes of it. Leaves the list sorted.
pub(crate) fn pass_on<T, S: Real, const D: usize>(
    list: &mut [T],
    swept: impl Fn(&T) -> &Swept<S, D>,
    mut put: impl FnMut(&mut T, Swept<S, D>),
    strikes: impl Fn(&T, &T) -> bool,
) {
    sort(list, &swept);
    for _ in 0..ROW {
        let all = list.iter().map(|body| swept(body).struck).reduce(Velocities::with);
        let Some(all) = all.filter(|&all| list.iter().any(|body| swept(body).struck_by(all).is_some())) else { return };
        // What strikes each.
        let mut blows: Vec<Option<Velocities<S, D>>> = vec![None; list.len()];
        let most = (MOST_LOOKS[0] * list.len()).max(MOST_LOOKS[1]);
        let is_seen = meetings(list, &swept, most, |[a, b]| {
            for [from, to] in [[a, b], [b, a]] {
                if strikes(&list[from], &list[to]) {
                    let by = swept(&list[from]).struck;
                    blows[to] = Some(blows[to].map_or(by, |blow| blow.with(by)));
                }
            }
        });
        if !is_seen {
            blows.fill(Some(all));
        }
        let mut is_done = true;
        for (body, blow) in list.iter_mut().zip(blows) {
            if let Some(grown) = blow.and_then(|blow| swept(body).struck_by(blow)) {
                // What lies on something may be held by it.
                put(body, Swept { is_held: true, ..grown });
                is_done = false;
            }
        }
        if is_done {
            return;
        }
        sort(list, &swept);
    }
}

/// Bodies, by their numbers, that may meet, or strike each other through others, come together; `settled`: the same of a body, held if something
/// that stays may throw it back.
pub(crate) fn join<S: Real, const D: usize>(
    together: &mut Sets,
    mut bodies: Vec<(usize, Swept<S, D>)>,
    settled: impl Fn(Swept<S, D>) -> Swept<S, D>,
) {
    pass_on(&mut bodies, |body| &body.1, |body, grown| body.1 = settled(grown), |_, _| true);
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
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;

    /// What stays in a box for a second.
    fn still(low: [f64; 2], high: [f64; 2]) -> Swept<f64, 2> {
        let span = Span { h: 1.0, fall: 0.0, pushed: 0.0 };
        Swept::new([low, high].map(|x| (x, [0.0; 2])).into_iter(), span, 0.0).unwrap()
    }

    /// Boxes of sizes up to `size` in the unit square, sorted.
    fn boxes(count: u32, size: f64) -> Vec<(usize, Swept<f64, 2>)> {
        let share = |k: u32, by: f64| (f64::from(k) * by).fract();
        let of = |k: u32| {
            let low = [share(k, 0.754_877_666), share(k, 0.569_840_29)];
            let wide = [share(k, 0.618_034) * size, share(k, 0.414_213_56) * size];
            still(low, [low[0] + wide[0], low[1] + wide[1]])
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
            join(&mut by_chains, list, |swept| swept);
            assert!(all);
            assert!((0..400).all(|k| by_couples.find(k) == by_chains.find(k)), "{size}");
        }
    }

    #[test]
    fn what_lies_in_one_place_is_looked_at_once_each() {
        let one = still([0.0; 2], [1.0; 2]);
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
        let of = |k: u32| {
            still(
                [f64::from(k) * 1e-6, f64::from(k * 7 % 20_000) * 1e-5],
                [1.0 + f64::from(k) * 1e-6, f64::from(k * 7 % 20_000) * 1e-5 + 0.1],
            )
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
