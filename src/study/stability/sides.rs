//! Sides that cross: pairs of segments without a common end.

/// A box about a side.
struct Span {
    low: [f64; 2],
    high: [f64; 2],
    side: usize,
}

/// Tells `found` of each pair of sides that cross, the earlier one first; sides with an end that is gone cross none.
///
/// Boxes about the sides are swept along x: as dear as there are sides that overlap there, however many there are.
pub(super) fn crossings(sides: &[[u32; 2]], position: &[[f64; 3]], mut found: impl FnMut(usize, usize)) {
    let at = |side: usize| sides[side].map(|end| position[end as usize]);
    let span = |side: usize| {
        let [a, b] = at(side);
        let [low, high] = [[a[0].min(b[0]), a[1].min(b[1])], [a[0].max(b[0]), a[1].max(b[1])]];
        (a.iter().chain(&b).all(|x| x.is_finite())).then_some(Span { low, high, side })
    };
    let mut spans: Vec<Span> = (0..sides.len()).filter_map(span).collect();
    spans.sort_by(|a, b| a.low[0].total_cmp(&b.low[0]));
    let mut open: Vec<usize> = Vec::new();
    for k in 0..spans.len() {
        let own = &spans[k];
        open.retain(|&other| spans[other].high[0] >= own.low[0]);
        for other in open.iter().map(|&other| &spans[other]) {
            let is_near = other.low[1] <= own.high[1] && other.high[1] >= own.low[1];
            let is_apart = || !sides[own.side].iter().any(|end| sides[other.side].contains(end));
            if is_near && is_apart() && crosses(&at(own.side), &at(other.side)) {
                found(own.side.min(other.side), own.side.max(other.side));
            }
        }
        open.push(k);
    }
}

/// Whether two segments cross; not where one merely ends on the other.
fn crosses([a, b]: &[[f64; 3]; 2], [c, d]: &[[f64; 3]; 2]) -> bool {
    let side = |p: &[f64; 3], q: &[f64; 3], r: &[f64; 3]| (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
    let is_through = |x: f64, y: f64| (x < 0.0 && y > 0.0) || (x > 0.0 && y < 0.0);
    is_through(side(a, b, c), side(a, b, d)) && is_through(side(c, d, a), side(c, d, b))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::draw::Draw;

    #[test]
    fn the_sweep_finds_what_looking_at_every_pair_finds() {
        let mut draw = Draw::new(3);
        let position: Vec<[f64; 3]> = (0..300).map(|_| [draw.unit(), 3.0 * draw.unit(), 0.0]).collect();
        let sides: Vec<[u32; 2]> = (0..400).map(|_| [(); 2].map(|()| draw.below(300) as u32)).collect();
        let at = |side: usize| sides[side].map(|end| position[end as usize]);
        let is_pair =
            |a: usize, b: usize| !sides[a].iter().any(|end| sides[b].contains(end)) && crosses(&at(a), &at(b));
        let mut every: Vec<[usize; 2]> =
            (0..400).flat_map(|b| (0..b).map(move |a| [a, b])).filter(|[a, b]| is_pair(*a, *b)).collect();
        let mut swept = Vec::new();
        crossings(&sides, &position, |a, b| swept.push([a, b]));
        every.sort_unstable();
        swept.sort_unstable();
        assert!(every.len() > 100 && swept == every, "{} for {}", swept.len(), every.len());
    }

    #[test]
    fn ten_thousand_sides_are_looked_at() {
        let position: Vec<[f64; 3]> = (0..20_000).map(|i| [f64::from(i / 2), f64::from(i % 2), 0.0]).collect();
        let mut sides: Vec<[u32; 2]> = (0..10_000).map(|i| [2 * i, 2 * i + 1]).collect();
        sides.push([0, 7]);
        let mut count = 0;
        crossings(&sides, &position, |_, _| count += 1);
        assert_eq!(count, 2, "from the foot of the first to the head of the fourth");
    }
}
