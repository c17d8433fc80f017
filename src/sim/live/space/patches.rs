//! Patches of a cluster: points near each other, which go together. How far points may go until what is near what is looked for anew is
//! promised against the common way of their patch, and of patches against each other: a cloth that falls, turns or swings is no
//! crowd that runs through itself.

use crate::sim::real::Real;
use crate::sim::vector::{add, dot, scale, sub, zero};

/// Patches of a cluster, at most: what goes on between any two of them is kept in a table.
const MOST: usize = 64;
/// Points that a patch has in the mean, at least.
const LEAST_POINTS: usize = 16;

/// Which points go together, and how far patches go against each other.
#[derive(Clone, Debug, Default)]
pub(super) struct Patches<S> {
    /// Of every point.
    of: Vec<u8>,
    /// One over the number of points of each.
    shares: Vec<S>,
    /// Their common ways since then `[m]`.
    gone: Vec<[S; 3]>,
    /// How far any two may go against each other `[m]`: one row a patch.
    promised: Vec<S>,
    /// How far they get against each other within the substep `[m]`.
    apart: Vec<S>,
}

/// What a patch is at a look.
struct Room<S> {
    low: [S; 3],
    high: [S; 3],
    velocity: [S; 3],
    /// The most that one of its points may go against it `[m]`.
    promised: S,
}

impl<S: Real> Patches<S> {
    /// Points in cells of a coarse grid.
    pub(super) fn over(places: &[[S; 3]]) -> Self {
        let Some([low, high]) = crate::sim::measure::extent(places) else { return Patches::default() };
        let size = [0, 1, 2].map(|k| (high[k] - low[k]).to_f64());
        let most = (places.len() / LEAST_POINTS).clamp(1, MOST) as f64;
        let many = |side: f64| size.map(|size| (size / side).floor() + 1.0);
        let longest = size.iter().fold(0.0, |most: f64, &size| most.max(size));
        let mut side = longest.max(f64::MIN_POSITIVE);
        while many(0.8 * side).iter().product::<f64>() <= most && longest > 0.0 {
            side *= 0.8;
        }
        let counts = match many(side).iter().product::<f64>() <= most {
            true => many(side).map(|count| count as usize),
            // The whole is 2 cells wide at the least, along each axis that it is as long as.
            false => [1; 3],
        };
        let cell = |x: [S; 3]| {
            let along = |k: usize| (((x[k] - low[k]).to_f64() / side) as usize).min(counts[k] - 1);
            (along(2) * counts[1] + along(1)) * counts[0] + along(0)
        };
        let (mut numbers, mut members) = (vec![u8::MAX; counts.iter().product()], Vec::new());
        let of = places.iter().map(|&x| {
            let number = &mut numbers[cell(x)];
            if *number == u8::MAX {
                *number = members.len() as u8;
                members.push(0.0);
            }
            members[usize::from(*number)] += 1.0;
            *number
        });
        let of = of.collect();
        let shares: Vec<S> = members.iter().map(|&count: &f64| S::from_f64(1.0 / count)).collect();
        let table = vec![S::ZERO; shares.len() * shares.len()];
        Patches { of, gone: vec![zero(); shares.len()], promised: table.clone(), apart: table, shares }
    }

    /// Which patch a point is of.
    #[inline(always)]
    pub(super) fn of(&self, point: usize) -> usize {
        usize::from(self.of[point])
    }

    /// The mean of vectors of points, one a patch.
    pub(super) fn means(&self, list: &[[S; 3]]) -> Vec<[S; 3]> {
        let mut sums = vec![zero(); self.shares.len()];
        for (&patch, &vector) in self.of.iter().zip(list) {
            sums[usize::from(patch)] = add(sums[usize::from(patch)], vector);
        }
        sums.iter().zip(&self.shares).map(|(&sum, &share)| scale(sum, share)).collect()
    }

    /// Promises how far patches may go against each other until it is looked anew: as far as they do in `time` `[s]`, and `least` `[m]` more,
    /// and those that are too far from each other as far as it takes them to get near. `reach`: how near is near, beside what is
    /// promised of points; `means`: the velocities of the patches. Returns of every patch how far those that are near may come towards it.
    pub(super) fn promise(
        &mut self,
        (places, means, promised): (&[[S; 3]], &[[S; 3]], &[S]),
        (time, least, reach): (S, S, S),
    ) -> Vec<S> {
        let rooms = self.rooms((places, means, promised));
        let many = rooms.len();
        let mut nearing = vec![S::ZERO; many];
        for (a, own) in rooms.iter().enumerate() {
            for (b, other) in rooms.iter().enumerate() {
                let apart = sub(own.velocity, other.velocity);
                let way = if a == b { S::ZERO } else { least + dot(apart, apart).sqrt() * time };
                let gap = own.gap(other) - own.promised - other.promised - reach;
                if gap <= way {
                    nearing[a] = nearing[a].max(way);
                }
                self.promised[a * many + b] = way.max(gap);
            }
        }
        nearing
    }

    fn rooms(&self, (places, means, promised): (&[[S; 3]], &[[S; 3]], &[S])) -> Vec<Room<S>> {
        let empty =
            |&velocity: &[S; 3]| Room { low: [S::INFINITY; 3], high: [-S::INFINITY; 3], velocity, promised: S::ZERO };
        let mut rooms: Vec<Room<S>> = means.iter().map(empty).collect();
        for ((&patch, x), &promised) in self.of.iter().zip(places).zip(promised) {
            let room = &mut rooms[usize::from(patch)];
            for k in 0..3 {
                room.low[k] = room.low[k].min(x[k]);
                room.high[k] = room.high[k].max(x[k]);
            }
            room.promised = room.promised.max(promised);
        }
        rooms
    }

    /// How far those of a point and of three corners may go against each other, at most `[m]`.
    #[inline(always)]
    pub(super) fn promised(&self, p: u32, corners: [u32; 3]) -> S {
        self.most(&self.promised, p, corners)
    }

    /// How far those of a point and of three corners have gone against each other by the end of the substep, at most `[m]`.
    #[inline(always)]
    pub(super) fn apart(&self, p: u32, corners: [u32; 3]) -> S {
        self.most(&self.apart, p, corners)
    }

    #[inline(always)]
    fn most(&self, table: &[S], p: u32, [a, b, c]: [u32; 3]) -> S {
        let row = &table[self.of(p as usize) * self.shares.len()..];
        row[self.of(a as usize)].max(row[self.of(b as usize)]).max(row[self.of(c as usize)])
    }

    /// Works out how far patches have gone against each other with these common ways `[m]` more.
    pub(super) fn part(&mut self, ways: &[[S; 3]]) {
        let ends: Vec<[S; 3]> = self.gone.iter().zip(ways).map(|(&gone, &way)| add(gone, way)).collect();
        for (row, &a) in self.apart.chunks_mut(ends.len().max(1)).zip(&ends) {
            for (apart, &b) in row.iter_mut().zip(&ends) {
                let d = sub(a, b);
                *apart = dot(d, d).sqrt();
            }
        }
    }

    /// Whether two would go further against each other than was promised, with these common ways `[m]` more.
    pub(super) fn leave(&self, ways: &[[S; 3]]) -> bool {
        let ends: Vec<[S; 3]> = self.gone.iter().zip(ways).map(|(&gone, &way)| add(gone, way)).collect();
        self.promised.chunks(ends.len().max(1)).zip(&ends).any(|(row, &a)| {
            row.iter().zip(&ends).any(|(&promised, &b)| {
                let d = sub(a, b);
                // NaN is looked at.
                let stays = dot(d, d) <= promised * promised;
                !stays
            })
        })
    }

    /// Counts the common ways of a substep `[m]`.
    pub(super) fn go(&mut self, ways: &[[S; 3]]) {
        self.gone.iter_mut().zip(ways).for_each(|(gone, &way)| *gone = add(*gone, way));
    }
}

impl<S: Real> Room<S> {
    /// How far apart the boxes around two are `[m]`.
    fn gap(&self, other: &Room<S>) -> S {
        let along = |k: usize| (self.low[k] - other.high[k]).max(other.low[k] - self.high[k]).max(S::ZERO);
        let d = [0, 1, 2].map(along);
        dot(d, d).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A flat cloth of 40 x 40 points.
    fn cloth() -> Vec<[f64; 3]> {
        (0..1600).map(|i| [0.1 * f64::from(i % 40), 0.0, 0.1 * f64::from(i / 40)]).collect()
    }

    #[test]
    fn patches_are_few_and_near() {
        let places = cloth();
        let patches = Patches::over(&places);
        assert!((16..=MOST).contains(&patches.shares.len()), "{}", patches.shares.len());
        let rooms = patches.rooms((&places, &patches.means(&places), &vec![0.0; places.len()]));
        assert!(rooms.iter().all(|room| (0..3).all(|k| room.high[k] - room.low[k] < 1.0)));
        // Few points are one, and so is a single place.
        assert_eq!(Patches::over(&places[..20]).shares.len(), 1);
        assert_eq!(Patches::over(&[[1.0; 3]; 200]).shares.len(), 1);
        assert_eq!(Patches::<f64>::over(&[]).shares.len(), 0);
    }

    #[test]
    fn what_turns_goes_little_against_its_patch() {
        let places = cloth();
        let velocities: Vec<[f64; 3]> = places.iter().map(|x| [-x[2], 0.0, x[0]]).collect();
        let patches = Patches::over(&places);
        let means = patches.means(&velocities);
        let most = (0..places.len()).map(|i| {
            let d = sub(velocities[i], means[patches.of(i)]);
            dot(d, d).sqrt()
        });
        assert!(most.fold(0.0, f64::max) < 0.5, "of 5.5 m/s");
    }

    #[test]
    fn far_patches_may_come_as_far_as_there_is_room_and_near_ones_as_they_do() {
        let places = cloth();
        let fast = |x: &[f64; 3]| if x[0] < 2.0 { [1.0, 0.0, 0.0] } else { [0.0; 3] };
        let velocities: Vec<[f64; 3]> = places.iter().map(fast).collect();
        let mut patches = Patches::over(&places);
        let promised = vec![0.01; places.len()];
        let means = patches.means(&velocities);
        let nearing = patches.promise((&places, &means, &promised), (0.01, 0.001, 0.1));
        let most = nearing.iter().copied().fold(0.0, f64::max);
        // A patch that goes in part does so by its mean.
        assert!((0.006..=0.011).contains(&most), "1 m/s for 0.01 s, and 1 mm: {most}");
        let far = patches.promised(0, [39; 3]);
        assert!(far > 2.0 && far < 3.9, "{far}");
        let ways = |by: f64| means.iter().map(|&v| scale(v, by)).collect::<Vec<_>>();
        assert!(!patches.leave(&ways(0.010)) && patches.leave(&ways(0.012)));
        let (half, gone) = (ways(0.006), ways(0.003));
        patches.go(&half);
        assert!(patches.leave(&half) && !patches.leave(&gone));
        patches.part(&gone);
        assert!((patches.apart(0, [39, 38, 37]) - 0.009).abs() < 1e-12);
    }
}
