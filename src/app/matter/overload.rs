//! How weight goes down through soft bodies, bond by bond: what gives way under what lies on it, with what it stands on, and the stiffness
//! that bears it.

use super::carried::{Carried, Grounds};
use crate::app::player::Shown;
use crate::picture::Tint;
use crate::sim::bond::lower_first;
use crate::sim::vector::{cross3, dot, length, sub};
use crate::sim::{Bond, BondKind, Limit, PointId};

/// A point that sinks by more than this share of its height above the foot of its body folds what it stands on `[1]`: an even body does so
/// near its foot where its top sinks by three tenths.
const GIVES_WAY: f64 = 0.5;
/// So far does what is meant of its body sink all in all, as a share of its height `[1]`: an even body does where it gives way. Where one
/// that is borne lies on its side, points that overhang stand on flat bonds alone, and those beside them hold them.
const SINKS: f64 = 0.3;
/// What bears it lets it sink by this share `[1]`: what is heavy and stands on something softer beside it keels over where it sinks by more.
const BORNE: f64 = 0.015;
/// What is no higher than this share of its body stands by itself; heights count as this share at least.
const STANDS: f64 = 0.1;
const LEAST: f64 = 0.25;
/// Bonds that lie flatter bear nothing: the cosine to gravity `[1]`.
const FLAT: f64 = 0.15;
/// Young's modulus over the stiffness against strain along one axis alone: as of [`Bearing`](super::borne::Bearing).
const FREE: f64 = 8.0 / 9.0;
/// Where so much of the springs of a body is too soft, all of them are made stiffer.
const MOST: f64 = 0.8;

/// What is made stiffer as it is bent now stores no more than so many times what lifts its bodies by their heights `[1]`.
const LEAP: f64 = 2.0;

/// A part of soft bodies that gives way.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::app) struct Overload {
    /// By what share of its height it sinks `[1]`.
    pub(in crate::app) share: f64,
    /// It is all of these bodies: their own weight is too much for them.
    pub(in crate::app) is_whole: bool,
    /// It takes more stiffness to bear it, which would throw what is bent now.
    pub(in crate::app) is_first: bool,
    /// Springs of what gives way and of what that stands on, ascending by their numbers.
    pub(in crate::app) bonds: Vec<u32>,
    /// So stiff they bear it, or rise without a leap `[N/m]`.
    pub(in crate::app) stiffness: f64,
}

/// A bond on which its upper end stands.
#[derive(Clone, Copy, Debug, Default)]
struct Strut {
    lower: u32,
    /// Its place in the list of bonds.
    place: u32,
    /// The square of its cosine to gravity `[1]`.
    upright: f64,
}

/// How the points of a world stand on each other.
///
/// Model: a point hands what it bears, its weight and what it was handed, to the points below that it is bonded to, by shares of k c^2 for
/// stiffness k and cosine c to gravity, and sinks relative to them by what it bears over 8/9 Σ k c^2; rigid bonds, where it has any, bear
/// all of it and give no way. Heights are those of bodies at rest: where they are pressed flat, as much higher as their triangles are
/// larger at rest.
/// Valid range: small strains; what hangs is not borne by anything.
/// Accuracy: as of an upright bar, see the tests.
#[derive(Debug, Default)]
struct Standing {
    /// Above the foot of its body `[m]`.
    height: Vec<f64>,
    weight: Vec<f64>,
    /// The body of each point, and how high each body is `[m]`.
    body: Vec<u32>,
    high: Vec<f64>,
    /// The struts of each point, one point's after another's, and where each point's begin.
    struts: Vec<Strut>,
    begins: Vec<u32>,
    /// The acceleration against what is up `[m/s^2]`.
    gravity: (f64, [f64; 3]),
    /// Points of soft bodies, from above.
    order: Vec<u32>,
    /// Stiffness of springs by their places `[N/m]`; `None` of what is rigid.
    springs: Vec<Option<f64>>,
    numbers: Vec<u32>,
    ends: Vec<[u32; 2]>,
}

/// What of some points, ascending, gives way in a world as it is shown; nothing in space, where nothing falls, of what stands on nothing, and
/// of what springs bear already, as what they are pressed by tells.
pub(in crate::app) fn overload(shown: &Shown, among: &[PointId]) -> Option<Overload> {
    let standing = Standing::of(shown)?;
    let now = standing.sinks(|place| standing.springs[place]);
    let share = |sinks: &[f64], point: usize| sinks[point] / standing.counted_height(point);
    let is_meant = |point: &u32| among.binary_search(&PointId(*point)).is_ok();
    let meant: Vec<usize> =
        standing.order.iter().filter(|point| is_meant(point)).map(|&point| point as usize).collect();
    let sink = standing.sinking(&meant, &now);
    let gives_way = |point: &usize| sink[standing.body[*point] as usize] && share(&now, *point) > GIVES_WAY;
    let mut gives: Vec<usize> = meant.into_iter().filter(gives_way).collect();
    if gives.is_empty() {
        return None;
    }
    let carried = Carried::of(shown, (&standing.body, standing.high.len()), standing.gravity);
    let grounds = Grounds::of(shown, (&standing.body, standing.high.len()));
    let feet = standing.feet();
    let mut judged: Vec<Option<bool>> = vec![None; standing.high.len()];
    gives.retain(|&point| {
        let own = standing.body[point];
        let stands_on = (&*feet[own as usize], standing.high[own as usize]);
        let gives = || !carried.bears_itself(own as usize) && grounds.bear(shown, own, stands_on);
        *judged[own as usize].get_or_insert_with(gives)
    });
    let most = gives.iter().map(|&point| share(&now, point)).fold(0.0, f64::max);
    let part = standing.under(&gives);
    let is_of_it = |place: usize| standing.ends[place].iter().all(|&end| part[end as usize]);
    let alike =
        standing.sinks(|place| standing.springs[place].map(|stiffness| if is_of_it(place) { 1.0 } else { stiffness }));
    let least = gives.iter().map(|&point| share(&alike, point)).fold(0.0, f64::max) / BORNE;
    let stiffness = in_two_digits(least, f64::ceil);
    let without_leap = standing.without_leap(shown, &carried, (&is_of_it, stiffness));
    let is_first = without_leap < stiffness;
    let of_it = (0..standing.ends.len()).filter(|&place| is_of_it(place));
    let softest = of_it.filter_map(|place| standing.springs[place]).fold(f64::INFINITY, f64::min);
    let stiffness = if is_first { rounded_down(without_leap, softest) } else { stiffness };
    let softer = (0..standing.ends.len()).filter(|&place| is_of_it(place));
    let softer = softer.filter(|&place| standing.springs[place].is_some_and(|own| own < stiffness));
    let mut bonds: Vec<u32> = softer.map(|place| standing.numbers[place]).collect();
    bonds.sort_unstable();
    let is_giving = |point: &&u32| judged[standing.body[**point as usize] as usize] == Some(true);
    let is_whole = standing.order.iter().filter(is_giving).all(is_meant);
    (!bonds.is_empty() && stiffness.is_finite()).then_some(Overload {
        share: most,
        is_whole,
        is_first,
        bonds,
        stiffness,
    })
}

/// A number in two digits.
fn in_two_digits(x: f64, to_whole: impl Fn(f64) -> f64) -> f64 {
    let digit = 10_f64.powf(x.max(f64::MIN_POSITIVE).log10().floor() - 1.0);
    to_whole(x / digit) * digit
}

/// A stiffness in two digits, no higher; as it is where that would be no more than the softest has.
fn rounded_down(stiffness: f64, softest: f64) -> f64 {
    let rounded = in_two_digits(stiffness, f64::floor);
    if rounded > softest { rounded } else { stiffness }
}

impl Standing {
    fn of(shown: &Shown) -> Option<Self> {
        let gravity = shown.settings.gravity.unwrap_or_default();
        let g = gravity[0].hypot(gravity[1]);
        let scenery = &shown.scenery;
        if shown.dimensions != 2 || g == 0.0 || scenery.triangles.is_empty() {
            return None;
        }
        let up = [-gravity[0] / g, -gravity[1] / g, 0.0];
        let count = shown.point_count();
        let body = Tint::hanging(count, scenery.bonds.ends().iter().map(|ends| ends.map(|end| end.0)));
        let bodies = body.iter().max().map_or(0, |last| *last as usize + 1);
        let of = |point: PointId| body[point.index()] as usize;
        let place = |point: PointId| shown.place(point.index());
        let mut is_soft = vec![false; bodies];
        scenery.triangles.iter().for_each(|corners| is_soft[of(corners[0])] = true);
        scenery.pinned.iter().for_each(|&pin| is_soft[of(pin)] = false);
        let mut springs = Vec::with_capacity(scenery.bonds.len());
        for bond in scenery.bonds.iter() {
            springs.push(match bond.kind {
                BondKind::Rigid => None,
                BondKind::Spring { stiffness, .. } => Some(stiffness),
                BondKind::Relaxed { .. } => {
                    is_soft[of(bond.a)] = false;
                    None
                }
            });
        }
        let higher = higher(shown, &body, bodies);
        let mut foot = vec![f64::INFINITY; bodies];
        let mut height: Vec<f64> = (0..count as u32).map(|point| dot(place(PointId(point)), up)).collect();
        (0..count).for_each(|point| foot[body[point] as usize] = foot[body[point] as usize].min(height[point]));
        let mut high = vec![0.0_f64; bodies];
        for point in 0..count {
            let own = body[point] as usize;
            height[point] = higher[own] * (height[point] - foot[own]);
            high[own] = high[own].max(height[point]);
        }
        let mut order: Vec<u32> = (0..count as u32).filter(|&point| is_soft[of(PointId(point))]).collect();
        order.retain(|point| scenery.gone.binary_search(&PointId(*point)).is_err());
        order.sort_by(|a, b| height[*b as usize].total_cmp(&height[*a as usize]).then(a.cmp(b)));
        let mut struts: Vec<(u32, Strut)> = Vec::new();
        // What only pulls, or only holds apart, is not counted on.
        let both = scenery.bonds.iter().enumerate().filter(|(_, bond)| bond.limit == Limit::Both);
        for (place_of, Bond { a, b, .. }) in both {
            let [upper, lower] = if height[a.index()] > height[b.index()] { [a, b] } else { [b, a] };
            let rise = height[upper.index()] - height[lower.index()];
            let along = sub(place(upper), place(lower));
            let across = length(sub(along, up.map(|x| x * dot(along, up))));
            let cosine = rise / rise.hypot(across);
            if cosine > FLAT && is_soft[of(upper)] {
                let strut = Strut { lower: lower.0, place: place_of as u32, upright: cosine * cosine };
                struts.push((upper.0, strut));
            }
        }
        struts.sort_by_key(|(upper, _)| *upper);
        let begins =
            (0..=count as u32).map(|point| struts.partition_point(|(upper, _)| *upper < point) as u32).collect();
        Some(Standing {
            weight: scenery.masses.iter().map(|mass| g * mass).collect(),
            height,
            high,
            struts: struts.into_iter().map(|(_, strut)| strut).collect(),
            begins,
            gravity: (g, up),
            order,
            springs,
            numbers: (0..scenery.bonds.len()).map(|place| scenery.bond_number(place)).collect(),
            ends: scenery.bonds.ends().iter().map(|ends| ends.map(|end| end.0)).collect(),
            body,
        })
    }

    fn struts_of(&self, point: usize) -> &[Strut] {
        &self.struts[self.begins[point] as usize..self.begins[point + 1] as usize]
    }

    /// The height above the foot of its body that sinking is compared with `[m]`.
    fn counted_height(&self, point: usize) -> f64 {
        self.height[point].max(LEAST * self.high[self.body[point] as usize])
    }

    /// Whether of each body, by itself, what is meant of it sinks all in all, its points counted by their weights.
    fn sinking(&self, meant: &[usize], sinks: &[f64]) -> Vec<bool> {
        let mut all = vec![[0.0_f64; 2]; self.high.len()];
        for &point in meant {
            let own = &mut all[self.body[point] as usize];
            own[0] += self.weight[point] * sinks[point];
            own[1] += self.weight[point] * self.counted_height(point);
        }
        all.into_iter().map(|[sunk, height]| sunk > SINKS * height).collect()
    }

    /// What stands on the ground by itself.
    fn stands(&self, point: usize) -> bool {
        self.height[point] <= STANDS * self.high[self.body[point] as usize]
    }

    /// What each body stands on the ground with.
    fn feet(&self) -> Vec<Vec<PointId>> {
        let mut feet = vec![Vec::new(); self.high.len()];
        let all = self.order.iter().filter(|point| self.stands(**point as usize));
        all.for_each(|&point| feet[self.body[point as usize] as usize].push(PointId(point)));
        feet
    }

    /// The stiffness `[N/m]`, up to one that is wished, that the softer ones of some springs can have as they are stretched and pressed now: they
    /// store so much more then, Σ (k - k_b) d_b^2 / 2, as [`LEAP`] says. An estimate from the safe side: none is softer than the softest.
    fn without_leap(&self, shown: &Shown, carried: &Carried, (is_of_it, wished): (impl Fn(usize) -> bool, f64)) -> f64 {
        let (mut squares, mut softest) = (0.0, wished);
        let mut is_of = vec![false; self.high.len()];
        for (place, bond) in shown.scenery.bonds.iter().enumerate() {
            let Some(own) = self.springs[place].filter(|&own| is_of_it(place) && own < wished) else { continue };
            let long = length(sub(shown.place(bond.a.index()), shown.place(bond.b.index())));
            let short = bond.rest_length - long;
            if bond.limit.acts(-short, 0.0) {
                squares += 0.5 * short * short;
            }
            softest = softest.min(own);
            is_of[self.body[bond.a.index()] as usize] = true;
        }
        let lifts: f64 = (0..is_of.len()).filter(|&body| is_of[body]).map(|body| carried.weight(body)).sum();
        (softest + LEAP * lifts / squares).min(wished)
    }

    /// How far each point sinks `[m]`, with springs so stiff by their places `[N/m]`, `None`: rigid.
    fn sinks(&self, stiffness: impl Fn(usize) -> Option<f64>) -> Vec<f64> {
        let mut load = self.weight.clone();
        let mut shares = vec![0.0; self.struts.len()];
        let mut sinks = vec![0.0; load.len()];
        for &point in &self.order {
            let point = point as usize;
            let struts = self.struts_of(point);
            if self.stands(point) || struts.is_empty() {
                continue;
            }
            let is_rigid = struts.iter().any(|strut| stiffness(strut.place as usize).is_none());
            let bears = |strut: &Strut| match stiffness(strut.place as usize) {
                None => strut.upright,
                Some(_) if is_rigid => 0.0,
                Some(own) => own * strut.upright,
            };
            let all: f64 = struts.iter().map(bears).sum();
            if all <= 0.0 {
                // Springs without any stiffness bear nothing.
                sinks[point] = f64::INFINITY;
                continue;
            }
            sinks[point] = if is_rigid { 0.0 } else { load[point] / (FREE * all) };
            for (strut, share) in struts.iter().zip(self.begins[point] as usize..) {
                shares[share] = bears(strut) / all;
                load[strut.lower as usize] += shares[share] * load[point];
            }
        }
        for &point in self.order.iter().rev() {
            let point = point as usize;
            let own = self.struts_of(point).iter().zip(self.begins[point] as usize..);
            let below: f64 =
                own.filter(|(_, k)| shares[*k] > 0.0).map(|(strut, k)| shares[k] * sinks[strut.lower as usize]).sum();
            sinks[point] += below;
        }
        sinks
    }

    /// Points, and all that they stand on; where that is most of a body, all of it.
    fn under(&self, points: &[usize]) -> Vec<bool> {
        let mut part = vec![false; self.weight.len()];
        points.iter().for_each(|&point| part[point] = true);
        for &point in &self.order {
            if part[point as usize] && !self.stands(point as usize) {
                self.struts_of(point as usize).iter().for_each(|strut| part[strut.lower as usize] = true);
            }
        }
        let mut counts = vec![[0_usize; 2]; self.high.len()];
        for [a, b] in &self.ends {
            let own = &mut counts[self.body[*a as usize] as usize];
            own[0] += usize::from(part[*a as usize] && part[*b as usize]);
            own[1] += 1;
        }
        let is_most = |body: u32| counts[body as usize][0] as f64 > MOST * counts[body as usize][1] as f64;
        part.iter_mut().zip(&self.body).for_each(|(is, body)| *is |= is_most(*body));
        part
    }
}

/// By how much each body is higher at rest than it is now `[1]`, at least 1: as its triangles are larger.
fn higher(shown: &Shown, body: &[u32], bodies: usize) -> Vec<f64> {
    let scenery = &shown.scenery;
    let both = scenery.bonds.iter().filter(|bond| bond.limit == Limit::Both);
    let mut sides: Vec<([PointId; 2], f64)> =
        both.map(|bond| (lower_first([bond.a, bond.b]), bond.rest_length)).collect();
    sides.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let rest = |a: PointId, b: PointId| {
        let found = sides.binary_search_by(|side| side.0.cmp(&lower_first([a, b])));
        found.ok().map(|place| sides[place].1)
    };
    let mut areas = vec![[0.0; 2]; bodies];
    for &[a, b, c] in &scenery.triangles {
        let (Some(ab), Some(bc), Some(ca)) = (rest(a, b), rest(b, c), rest(c, a)) else { continue };
        let [p, q, r] = [a, b, c].map(|corner| shown.place(corner.index()));
        let own = &mut areas[body[a.index()] as usize];
        own[0] += super::extent::spanned([ab, bc, ca]);
        own[1] += 0.5 * cross3(sub(q, p), sub(r, p))[2].abs();
    }
    areas
        .into_iter()
        .map(|[rest, now]| if now > 0.0 && rest.is_finite() { (rest / now).max(1.0) } else { 1.0 })
        .collect()
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;
    use crate::app::matter::{Among, MatterChange};
    use crate::app::player::{Order, Stage};
    use crate::scene::{Scene, gallery};

    fn shown(stage: &mut Stage) -> Shown {
        let mut shown = Shown::default();
        stage.show(&mut shown);
        shown
    }

    /// A soft block, 1.2 m wide and 1 m high, on the ground.
    fn block() -> Stage {
        let text = r#"{"wobble": 1, "gravity": [0, -9.81], "contact": true, "bounds": {"min": [-9, 0], "max": [9, 9]}, "drag_rate": 1,
            "bodies": [{"make": "lattice", "columns": 13, "rows": 11, "spacing": 0.1, "origin": [0, 0.01],
            "material": {"kind": "spring", "stiffness": 60, "damping": 0.5, "mass": 1.2}}]}"#;
        let mut stage = Stage::new(Scene::parse(text, "x.json").unwrap().into()).unwrap();
        (0..120).for_each(|_| _ = stage.obey(Order::Step(None)));
        stage
    }

    /// Points between two places across that are no lower than some height `[m]`, with the bonds between them.
    fn part(shown: &Shown, [left, right]: [f64; 2], low: f64) -> Among {
        let is_in = |point: &PointId| {
            let [x, y, _] = shown.place(point.index());
            x > left && x < right && y > low
        };
        let points: Vec<PointId> = (0..shown.point_count() as u32).map(PointId).filter(is_in).collect();
        let ends = shown.scenery.bonds.ends().iter().enumerate();
        let own = ends.filter(|(_, ends)| ends.iter().all(|end| points.contains(end)));
        Among { bonds: Some(own.map(|(place, _)| place as u32).collect()), points, obstacles: Vec::new() }
    }

    /// The mean height of some points `[m]`.
    fn height(stage: &mut Stage, points: &[PointId]) -> f64 {
        let shown = shown(stage);
        points.iter().map(|point| shown.place(point.index())[1]).sum::<f64>() / points.len() as f64
    }

    #[test]
    fn what_was_painted_heavy_stands_after_the_click_and_sinks_without_it() {
        let change = MatterChange::Density(40.0);
        // A slab on top, a part of it, and one column in the middle.
        for (left, right, low) in [(-1.0, 2.0, 0.75), (0.35, 0.85, 0.6), (0.45, 0.75, 0.3)] {
            let sunk = |is_mended: bool| {
                let mut stage = block();
                let painted = part(&shown(&mut stage), [left, right], low);
                let before = height(&mut stage, &painted.points);
                let order = Order::Change { among: painted.clone(), change, goes_on: false };
                assert_eq!(stage.obey(order), None);
                // As it is looked at in the next frame.
                stage.obey(Order::Step(None));
                let found = overload(&shown(&mut stage), &painted.points);
                let found = found.unwrap_or_else(|| unreachable!("at {left} to {right}, {low} it gives way"));
                let all = shown(&mut stage).scenery.bonds.len();
                assert!(left < 0.0 || found.bonds.len() < all, "a part of it: {} of {all}", found.bonds.len());
                if is_mended {
                    let among = Among { bonds: Some(found.bonds), ..Among::default() };
                    let change = MatterChange::Bears(found.stiffness);
                    assert_eq!(stage.obey(Order::Change { among, change, goes_on: false }), None);
                }
                let low = (0..300).fold(before, |low: f64, _| {
                    stage.obey(Order::Step(None));
                    low.min(height(&mut stage, &painted.points))
                });
                let told = overload(&shown(&mut stage), &painted.points).map(|told| told.share);
                assert!(!is_mended || told.is_none(), "at {left} to {right}, {low}: {told:?}");
                1.0 - low / before
            };
            let (with, without) = (sunk(true), sunk(false));
            assert!(with < 0.25, "at {left} to {right}, {low} it stands, sunk by {with}");
            assert!(without > 0.3, "at {left} to {right}, {low} it does not without it, sunk by {without}");
        }
    }

    fn points(stage: &mut Stage) -> Vec<PointId> {
        (0..shown(stage).point_count() as u32).map(PointId).collect()
    }

    #[test]
    fn what_stands_on_nothing_is_not_told_and_what_stands_by_itself_is_told_of_itself() {
        for (height, is_told) in [(3.0, false), (0.01, true)] {
            let text = format!(
                r#"{{"wobble": 1, "gravity": [0, -9.81], "contact": true, "bounds": {{"min": [-9, 0], "max": [9, 9]}},
                "bodies": [{{"make": "lattice", "columns": 13, "rows": 11, "spacing": 0.1, "origin": [0, {height}],
                "material": {{"kind": "spring", "stiffness": 60, "damping": 0.5, "mass": 48}}}}]}}"#
            );
            let mut stage = Stage::new(Scene::parse(&text, "x.json").unwrap().into()).unwrap();
            let all = points(&mut stage);
            let found = overload(&shown(&mut stage), &all);
            assert_eq!(found.as_ref().map(|found| (found.is_whole, found.is_first)), is_told.then_some((true, false)));
            let part = overload(&shown(&mut stage), &all[100..]);
            assert_eq!(part.map(|found| found.is_whole), is_told.then_some(false), "the rest is what it stands on");
        }
    }

    #[test]
    fn what_is_bent_already_is_made_only_so_stiff_that_it_does_not_leap() {
        let mut stage = block();
        let all = points(&mut stage);
        let whole = Among { points: all.clone(), ..Among::default() };
        stage.obey(Order::Change { among: whole, change: MatterChange::Density(30.0), goes_on: false });
        // It has begun to sink.
        (0..12).for_each(|_| _ = stage.obey(Order::Step(None)));
        let now = shown(&mut stage);
        let found = overload(&now, &all).unwrap();
        assert!(found.is_first && found.stiffness > 60.0, "{} N/m", found.stiffness);
        let short = |bond: Bond| bond.rest_length - length(sub(now.place(bond.a.index()), now.place(bond.b.index())));
        let squares: f64 = now.scenery.bonds.iter().map(|bond| 0.5 * short(bond).powi(2)).sum();
        let standing = Standing::of(&now).unwrap();
        let weight = Carried::of(&now, (&standing.body, standing.high.len()), standing.gravity).weight(0);
        let more = (found.stiffness - 60.0) * squares;
        assert!(more <= LEAP * weight, "{more} J more, of something that {weight} J lift");
        assert!(more > 0.8 * LEAP * weight, "as much as may be, in two digits: {more} J");
    }

    #[test]
    fn what_rounds_down_to_what_is_there_is_not_rounded() {
        let cases = [(73.9, 60.0, 73.0), (60.4, 60.0, 60.4), (69.95, 69.9, 69.95), (71.3, 69.9, 71.0)];
        for (stiffness, softest, expected) in cases {
            let rounded = rounded_down(stiffness, softest);
            assert!((rounded - expected).abs() < 1e-9 && rounded > softest, "{stiffness} N/m: {rounded} N/m");
        }
    }

    #[test]
    fn what_the_gallery_has_bears_itself() {
        for entry in gallery().iter().filter(|entry| entry.point_count < 20_000) {
            let mut stage = Stage::new(entry.scene().unwrap().into()).unwrap();
            let shown = shown(&mut stage);
            let all: Vec<PointId> = (0..shown.point_count() as u32).map(PointId).collect();
            assert_eq!(overload(&shown, &all).map(|found| found.share), None, "{}", entry.name);
        }
    }

    #[test]
    fn a_stack_at_rest_bears_itself_all_of_it_and_each_body() {
        let stack = gallery().iter().find(|entry| entry.name == "jelly-stack").unwrap();
        let mut stage = Stage::new(stack.scene().unwrap().into()).unwrap();
        for _ in 0..4 {
            (0..120).for_each(|_| _ = stage.obey(Order::Step(None)));
            let shown = shown(&mut stage);
            let all: Vec<PointId> = (0..shown.point_count() as u32).map(PointId).collect();
            for among in std::iter::once(&*all).chain(all.chunks(all.len() / 9)) {
                assert_eq!(overload(&shown, among).map(|found| found.share), None, "{:?}", among.first());
            }
        }
    }

    #[test]
    fn nothing_is_said_of_what_is_not_meant_and_one_number_bears_a_heavy_block_as_a_whole() {
        let mut stage = block();
        let all: Vec<PointId> = (0..143).map(PointId).collect();
        assert_eq!(overload(&shown(&mut stage), &all), None, "1 kg/m^2 is borne");
        let whole = Among { points: all.clone(), ..Among::default() };
        stage.obey(Order::Change { among: whole, change: MatterChange::Density(30.0), goes_on: false });
        let now = shown(&mut stage);
        assert_eq!(overload(&now, &[]), None);
        let found = overload(&now, &all).unwrap();
        assert_eq!(found.bonds.len(), now.scenery.bonds.len(), "all of it");
    }
}
