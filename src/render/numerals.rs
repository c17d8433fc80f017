//! Numbers as strokes: short texts of digits and units, for the grid. They need no font and are sharp at any scale.

use glam::DVec2;

/// Height of a digit; other lengths are in the same unit.
pub(super) const TALL: f64 = 7.0;
/// From a sign to the next.
const ADVANCE: f64 = 5.9;
const DOT_ADVANCE: f64 = 3.2;
const WIDE_ADVANCE: f64 = 7.8;

/// Strokes of a text whose lower left corner is the origin, y up, with digits [`TALL`] high times `size`, and how wide it is.
///
/// Valid range: digits, `.`, `-`, `m`, `k`, `n`, `µ`, `e`; others are blanks.
pub(super) fn strokes(text: &str, size: f64) -> (Vec<[DVec2; 2]>, f64) {
    let mut list = Vec::new();
    let mut at = 0.0;
    for sign in text.chars() {
        for line in lines(sign) {
            let place = |&(x, y): &(f64, f64)| size * DVec2::new(at + x, y);
            list.extend(line.windows(2).map(|ends| [place(&ends[0]), place(&ends[1])]));
        }
        at += match sign {
            '.' => DOT_ADVANCE,
            'm' => WIDE_ADVANCE,
            ' ' => 0.5 * ADVANCE,
            _ => ADVANCE,
        };
    }
    (list, size * at)
}

/// Half the width of a digit, and the radius of its bowls.
const R: f64 = 2.1;

/// An arc about a middle, between two angles `[degrees]`, anticlockwise where the second is larger.
fn arc(x: f64, y: f64, [across, up]: [f64; 2], [from, to]: [f64; 2]) -> Vec<(f64, f64)> {
    let steps = ((from - to).abs() / 36.0).ceil().max(1.0) as usize;
    let angle = |k: usize| (from + (to - from) * k as f64 / steps as f64).to_radians();
    (0..=steps).map(|k| (x + across * angle(k).cos(), y + up * angle(k).sin())).collect()
}

/// The lines of a sign.
fn lines(sign: char) -> Vec<Vec<(f64, f64)>> {
    let low = 0.27 * TALL;
    let high = TALL - 0.25 * TALL;
    let joined = |mut first: Vec<(f64, f64)>, rest: &[(f64, f64)]| {
        first.extend_from_slice(rest);
        first
    };
    match sign {
        '0' => vec![arc(R, 0.5 * TALL, [R, 0.5 * TALL], [90.0, 450.0])],
        '1' => vec![vec![(0.7, TALL - 1.4), (2.3, TALL), (2.3, 0.0)]],
        '2' => vec![joined(arc(R, high, [R, TALL - high], [170.0, -35.0]), &[(0.1, 0.0), (2.0 * R, 0.0)])],
        '3' => vec![
            arc(R - 0.1, high, [R - 0.2, TALL - high], [150.0, -90.0]),
            arc(R - 0.1, low, [R, low], [90.0, -150.0]),
        ],
        '4' => vec![vec![(3.2, 0.0), (3.2, TALL), (0.0, 2.0), (4.4, 2.0)]],
        '5' => {
            let bowl = arc(R - 0.2, 2.2, [R + 0.1, 2.2], [125.0, -145.0]);
            vec![joined(vec![(3.9, TALL), (0.8, TALL), (0.5, 3.7)], &bowl)]
        }
        '6' => vec![
            arc(R, 2.1, [R, 2.1], [90.0, 450.0]),
            joined(vec![(3.4, TALL - 0.2)], &[(1.6, TALL - 1.5), (0.4, 4.0), (0.05, 2.4)]),
        ],
        '7' => vec![vec![(0.0, TALL), (4.2, TALL), (1.6, 0.0)]],
        '8' => vec![arc(R, high, [R - 0.3, TALL - high], [270.0, 630.0]), arc(R, low, [R, low], [90.0, 450.0])],
        '9' => vec![
            arc(R, TALL - 2.1, [R, 2.1], [90.0, 450.0]),
            vec![(4.15, TALL - 2.4), (3.8, 3.0), (2.6, 1.5), (0.8, 0.2)],
        ],
        '.' => vec![vec![(0.7, 0.0), (0.7, 0.35)]],
        '-' => vec![vec![(0.5, 0.46 * TALL), (3.7, 0.46 * TALL)]],
        'm' => vec![
            vec![(0.0, 0.0), (0.0, 4.6)],
            joined(arc(1.6, 3.0, [1.6, 1.6], [180.0, 0.0]), &[(3.2, 0.0)]),
            joined(arc(4.8, 3.0, [1.6, 1.6], [180.0, 0.0]), &[(6.4, 0.0)]),
        ],
        'n' => vec![vec![(0.0, 0.0), (0.0, 4.6)], joined(arc(1.9, 2.9, [1.9, 1.7], [180.0, 0.0]), &[(3.8, 0.0)])],
        'k' => vec![vec![(0.0, 0.0), (0.0, TALL)], vec![(3.4, 4.6), (0.0, 1.9)], vec![(1.3, 2.9), (3.6, 0.0)]],
        'µ' => vec![
            joined(vec![(0.0, 4.6)], &arc(1.9, 1.7, [1.9, 1.7], [180.0, 360.0])),
            vec![(3.8, 4.6), (3.8, 0.0)],
            vec![(0.0, 4.6), (0.0, -1.8)],
        ],
        'e' => vec![joined(vec![(0.1, 2.4), (3.8, 2.4)], &arc(1.95, 2.3, [1.95, 2.3], [0.0, 310.0]))],
        _ => Vec::new(),
    }
}

/// A length on a grid `[m]` with its unit: as many places as from one to the next takes, in the unit that suits the lines of the grid, which
/// are as far apart as `lines` `[m]`.
pub(super) fn length(value: f64, [step, lines]: [f64; 2]) -> String {
    let (unit, scale) = match lines {
        step if step >= 1e3 => ("km", 1e-3),
        step if step >= 1e-2 => ("m", 1.0),
        step if step >= 1e-5 => ("mm", 1e3),
        step if step >= 1e-8 => ("µm", 1e6),
        _ => ("nm", 1e9),
    };
    let places = (-(step * scale).log10() - 1e-9).ceil().clamp(0.0, 9.0) as usize;
    let value = value * scale;
    // Minus nothing is nothing.
    let value = if value.abs() < 0.5 * 0.1_f64.powi(places as i32) { 0.0 } else { value };
    if value.abs() >= 1e7 { format!("{value:e} {unit}") } else { format!("{value:.places$} {unit}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_have_as_many_places_as_their_grid_and_a_unit_that_fits() {
        let said = |value, step| length(value, [step; 2]);
        assert_eq!(length(3.0, [1.0, 0.5]), "3 m");
        assert_eq!(length(0.01, [0.01, 0.005]), "10 mm");
        assert_eq!(said(-2.5, 0.5), "-2.5 m");
        assert_eq!(said(3.0, 1.0), "3 m");
        assert_eq!(said(-1e-17, 0.2), "0.0 m");
        assert_eq!(said(0.35, 0.05), "0.35 m");
        assert_eq!(said(0.012, 0.002), "12 mm");
        assert_eq!(said(5000.0, 1000.0), "5 km");
        assert_eq!(said(2e-6, 1e-6), "2 µm");
    }

    #[test]
    fn every_sign_that_lengths_need_has_strokes_within_its_place() {
        for sign in "0123456789.-mknµe".chars() {
            let (list, width) = strokes(&sign.to_string(), 1.0);
            assert!(!list.is_empty() && width > 2.0, "{sign}");
            for end in list.iter().flatten() {
                assert!((-0.4..=width).contains(&end.x) && (-2.0..=TALL + 0.1).contains(&end.y), "{sign}: {end}");
            }
        }
        assert!(strokes(" x", 2.0).0.is_empty());
    }
}
