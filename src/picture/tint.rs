//! Which body points belong to, and how it is drawn.

/// How many colours there are for bodies that have none of their own.
pub const HUES: u32 = 7;
/// Each round through them begins so many colours on: copies in rows of that length do not stand in columns of one colour.
const SHIFT: u32 = 3;

/// Which of the colours the body of a number has, from 0 to [`HUES`] - 1.
pub fn hue(body: u32) -> u32 {
    (body % HUES + SHIFT * (body / HUES % HUES)) % HUES
}

/// A run of points of one body, up to where the next run begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tint {
    /// The first point of the run.
    pub first: u32,
    /// The number of the body: it picks a colour of the palette.
    pub body: u32,
    /// The colour that the body has of its own: red, green, blue as stored (sRGB).
    pub color: Option<[u8; 3]>,
    /// How wide its bonds are drawn `[m]`; 0: as is usual.
    pub width: f64,
    /// It is not drawn.
    pub is_hidden: bool,
}

/// How points are drawn from now on, where it is said.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Coat {
    /// Red, green, blue as stored (sRGB).
    pub color: Option<[u8; 3]>,
    /// Of bonds `[m]`, >= 0; 0: as is usual.
    pub width: Option<f64>,
    /// Whether they are drawn.
    pub visible: Option<bool>,
}

impl Coat {
    /// A colour alone.
    pub fn of_color(color: [u8; 3]) -> Self {
        Coat { color: Some(color), ..Coat::default() }
    }

    /// Whether it says nothing.
    pub fn is_empty(&self) -> bool {
        *self == Coat::default()
    }
}

impl Tint {
    /// A run that is drawn as is usual.
    pub fn new(first: u32, body: u32) -> Self {
        Tint { first, body, color: None, width: 0.0, is_hidden: false }
    }

    /// The same run with a coat.
    #[must_use]
    pub fn with(self, coat: Coat) -> Self {
        Tint {
            color: coat.color.or(self.color),
            width: coat.width.unwrap_or(self.width),
            is_hidden: coat.visible.map_or(self.is_hidden, |visible| !visible),
            ..self
        }
    }

    /// The run that a point is in. Valid range: runs ascend by `first`; `None` before the first of them.
    pub fn of(runs: &[Tint], point: u32) -> Option<&Tint> {
        runs[..runs.partition_point(|run| run.first <= point)].last()
    }

    /// Whether a point is of a run that is not drawn. Valid range: as of [`Tint::of`].
    pub fn hides(runs: &[Tint], point: u32) -> bool {
        Tint::of(runs, point).is_some_and(|run| run.is_hidden)
    }

    /// Gives points a coat. Those before the first run stay without one.
    pub fn paint(runs: &mut Vec<Tint>, points: &[u32], coat: Coat) {
        Tint::change(runs, points, |run| run.with(coat));
    }

    /// Makes points those of the body of this number. Those before the first run stay of none.
    pub fn part(runs: &mut Vec<Tint>, points: &[u32], body: u32) {
        Tint::change(runs, points, |run| Tint { body, ..run });
    }

    /// Changes the runs of points.
    fn change(runs: &mut Vec<Tint>, points: &[u32], to: impl Fn(Tint) -> Tint) {
        let mut points = points.to_vec();
        points.sort_unstable();
        points.dedup();
        for stretch in points.chunk_by(|a, b| a + 1 == *b) {
            let (first, end) = (stretch[0], stretch[stretch.len() - 1].saturating_add(1));
            let Some(beyond) = Tint::of(runs, end).map(|run| Tint { first: end, ..*run }) else { continue };
            let inside = |run: &Tint| (first..end).contains(&run.first);
            let mut painted: Vec<Tint> = Tint::of(runs, first).map(|run| Tint { first, ..*run }).into_iter().collect();
            painted.extend(runs.iter().copied().filter(|run| inside(run) && run.first > first));
            painted.iter_mut().for_each(|run| *run = to(*run));
            runs.retain(|run| !inside(run) && run.first != end);
            painted.push(beyond);
            let place = runs.partition_point(|run| run.first < first);
            runs.splice(place..place, painted);
        }
    }

    /// The number of the body of each of `count` points, where what these pairs hold together is one, counted by lowest points. Pairs of
    /// points that there are not are left out.
    pub fn hanging(count: usize, pairs: impl Iterator<Item = [u32; 2]>) -> Vec<u32> {
        let mut up: Vec<u32> = (0..count as u32).collect();
        for [a, b] in pairs {
            if (a.max(b) as usize) < count {
                let [a, b] = [top(&mut up, a), top(&mut up, b)];
                up[a.max(b) as usize] = a.min(b);
            }
        }
        let mut next = 0;
        let mut numbers = vec![0; count];
        for point in 0..count {
            let lowest = top(&mut up, point as u32) as usize;
            if lowest == point {
                numbers[point] = next;
                next += 1;
            } else {
                numbers[point] = numbers[lowest];
            }
        }
        numbers
    }
}

/// The lowest point that a point hangs on.
fn top(up: &mut [u32], mut point: u32) -> u32 {
    while up[point as usize] != point {
        up[point as usize] = up[up[point as usize] as usize];
        point = up[point as usize];
    }
    point
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(first: u32, color: Option<[u8; 3]>) -> Tint {
        Tint { color, ..Tint::new(first, first) }
    }

    #[test]
    fn a_point_is_in_the_last_run_that_begins_before_it() {
        let runs = [2, 5].map(|first| run(first, None));
        let body = |point| Tint::of(&runs, point).map(|run| run.body);
        assert_eq!([1, 2, 4, 5, 99].map(body), [None, Some(2), Some(2), Some(5), Some(5)]);
        assert_eq!(Tint::of(&[], 0), None);
    }

    #[test]
    fn painted_points_have_the_colour_and_others_what_they_had() {
        let red = [255, 0, 0];
        for points in [vec![6, 4, 5], vec![3], vec![0, 9], (0..12).collect(), vec![5, 6, 7, 8, 9]] {
            let mut runs = [0, 5, 9].map(|first| run(first, (first == 9).then_some([1; 3]))).to_vec();
            let before = runs.clone();
            Tint::paint(&mut runs, &points, Coat::of_color(red));
            for point in 0..20 {
                let [was, is] = [&before, &runs].map(|runs| *Tint::of(runs, point).unwrap_or(&runs[0]));
                let color = if points.contains(&point) { Some(red) } else { was.color };
                assert_eq!((is.body, is.color), (was.body, color), "{points:?}: {point}");
            }
            assert!(runs.is_sorted_by(|a, b| a.first < b.first), "{runs:?}");
        }
    }

    #[test]
    fn a_coat_changes_what_it_says_alone() {
        let mut runs = vec![run(0, Some([7; 3]))];
        let coats = [
            Coat { width: Some(0.2), ..Coat::default() },
            Coat { visible: Some(false), ..Coat::default() },
            Coat::of_color([9; 3]),
        ];
        coats.into_iter().for_each(|coat| Tint::paint(&mut runs, &[1, 2], coat));
        let is = Tint { first: 1, body: 0, color: Some([9; 3]), width: 0.2, is_hidden: true };
        assert_eq!(runs, [run(0, Some([7; 3])), is, Tint { first: 3, ..run(0, Some([7; 3])) }]);
        Tint::paint(&mut runs, &[1, 2], Coat { width: Some(0.0), visible: Some(true), ..Coat::default() });
        assert_eq!(Tint::of(&runs, 2), Some(&Tint { first: 1, ..run(0, Some([9; 3])) }));
        assert!(Coat::default().is_empty() && !Coat::of_color([0; 3]).is_empty());
    }

    #[test]
    fn points_become_those_of_another_body_in_the_coat_that_they_have() {
        let mut runs = vec![run(0, Some([7; 3])), run(4, None)];
        Tint::part(&mut runs, &[2, 3, 4], 9);
        let of = |point| Tint::of(&runs, point).map(|run| (run.body, run.color));
        let own = Some([7; 3]);
        assert_eq!([1, 2, 3, 4, 5].map(of), [(0, own), (9, own), (9, own), (9, None), (4, None)].map(Some));
    }

    #[test]
    fn bodies_have_all_hues_in_turn() {
        let mut round: Vec<u32> = (3 * HUES..4 * HUES).map(hue).collect();
        round.sort_unstable();
        assert!(round.into_iter().eq(0..HUES));
    }

    #[test]
    fn what_hangs_together_is_one_body() {
        let pairs = [[4, 2], [2, 1], [5, 3], [9, 0]];
        assert_eq!(Tint::hanging(6, pairs.into_iter()), [0, 1, 1, 2, 1, 2]);
    }
}
