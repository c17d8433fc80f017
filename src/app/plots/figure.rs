//! A plot as a file: curves on white with axes, as SVG.

use std::fmt::Write;

/// A curve.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::app) struct Curve {
    pub(in crate::app) name: String,
    /// Red, green, blue, opacity.
    pub(in crate::app) color: [u8; 4],
    /// How wide it is drawn.
    pub(in crate::app) width: f32,
    pub(in crate::app) points: Vec<[f64; 2]>,
}

/// Width and height of the picture, and its margins: left, top, right, bottom.
const SIZE: [f64; 2] = [720.0, 420.0];
const MARGINS: [f64; 4] = [78.0, 34.0, 18.0, 52.0];
/// Lines of the grid along an axis, about.
const LINES: f64 = 6.0;

/// Curves between axes with names, which show all of them. Points that are no finite numbers are left out.
pub(in crate::app) fn svg([across, up]: [&str; 2], curves: &[Curve]) -> String {
    let [left, top, right, bottom] = MARGINS;
    let (width, height) = (SIZE[0] - left - right, SIZE[1] - top - bottom);
    let spans = [0, 1].map(|axis| span(curves, axis, if axis == 1 { 0.05 } else { 0.0 }));
    let x = |value: f64| left + width * (value - spans[0][0]) / (spans[0][1] - spans[0][0]);
    let y = |value: f64| top + height * (1.0 - (value - spans[1][0]) / (spans[1][1] - spans[1][0]));
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" font-family=\"sans-serif\" font-size=\"13\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
        SIZE[0], SIZE[1]
    );
    for (axis, [low, high]) in spans.into_iter().enumerate() {
        for (value, words) in ticks(low, high) {
            let (from, to, at, anchor) = match axis {
                0 => ([x(value), top], [x(value), top + height], [x(value), top + height + 17.0], "middle"),
                _ => ([left, y(value)], [left + width, y(value)], [left - 7.0, y(value) + 4.5], "end"),
            };
            let _ = writeln!(
                text,
                "<path d=\"M{:.2} {:.2}L{:.2} {:.2}\" stroke=\"#ddd\"/>\
                 <text x=\"{:.2}\" y=\"{:.2}\" text-anchor=\"{anchor}\">{words}</text>",
                from[0], from[1], to[0], to[1], at[0], at[1]
            );
        }
    }
    for Curve { color: [red, green, blue, _], width, points, .. } in curves {
        let places = points.iter().filter(|point| point.iter().all(|number| number.is_finite()));
        let way: Vec<String> = places.map(|&[a, b]| format!("{:.2} {:.2}", x(a), y(b))).collect();
        if !way.is_empty() {
            let _ = writeln!(
                text,
                "<path d=\"M{}\" fill=\"none\" stroke=\"#{red:02x}{green:02x}{blue:02x}\" stroke-width=\"{width}\" \
                 stroke-linejoin=\"round\"/>",
                way.join("L")
            );
        }
    }
    let mut at = left;
    for Curve { name, color: [red, green, blue, _], .. } in curves {
        let _ = writeln!(
            text,
            "<text x=\"{at:.2}\" y=\"22\" fill=\"#{red:02x}{green:02x}{blue:02x}\" font-weight=\"bold\">{}</text>",
            escaped(name)
        );
        at += 9.0 * name.chars().count() as f64 + 16.0;
    }
    let (middle, half) = (left + 0.5 * width, top + 0.5 * height);
    let _ = writeln!(
        text,
        "<path d=\"M{left} {top}V{}H{}\" fill=\"none\" stroke=\"#555\"/>\n\
         <text x=\"{middle:.2}\" y=\"{:.2}\" text-anchor=\"middle\">{}</text>\n\
         <text transform=\"translate(18 {half:.2}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n</svg>",
        top + height,
        left + width,
        SIZE[1] - 12.0,
        escaped(across),
        escaped(up)
    );
    text
}

/// From the least to the greatest of all finite points along an axis, with a margin; never empty.
fn span(curves: &[Curve], axis: usize, margin: f64) -> [f64; 2] {
    let all = curves.iter().flat_map(|curve| &curve.points).filter(|point| point.iter().all(|x| x.is_finite()));
    let all = all.map(|point| point[axis]);
    let [low, high] = all.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)]);
    match high - low {
        wide if wide > 1e-12 * (low.abs() + high.abs()) && wide.is_finite() => {
            [low - margin * wide, high + margin * wide]
        }
        _ if low.is_finite() => [low - 0.5 * low.abs().max(1.0), low + 0.5 * low.abs().max(1.0)],
        _ => [0.0, 1.0],
    }
}

/// Round numbers from one to another, 1, 2 or 5 times a power of ten apart, as they are written.
fn ticks(low: f64, high: f64) -> Vec<(f64, String)> {
    let least = (high - low) / LINES;
    let power = 10_f64.powf(least.log10().floor());
    let step = [1.0, 2.0, 5.0].map(|digit| digit * power).into_iter().find(|step| *step >= least);
    let step = step.unwrap_or(10.0 * power);
    if !step.is_normal() {
        return Vec::new();
    }
    let places = (-(step.log10() + 1e-9).floor()).clamp(0.0, 9.0) as usize;
    let words = |value: f64| match value.abs().max(step) {
        size if (1e-4..1e6).contains(&size) => format!("{value:.places$}"),
        _ => format!("{value:.2e}"),
    };
    let first = (low / step).ceil();
    let all = (0..=2 * LINES as i64).map(|k| (first + k as f64) * step).take_while(|value| *value <= high);
    all.map(|value| if value == 0.0 { 0.0 } else { value }).map(|value| (value, words(value))).collect()
}

fn escaped(words: &str) -> String {
    words.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curves_fill_the_place_between_their_axes() {
        let curve = |name: &str, points: &[[f64; 2]]| Curve {
            name: name.to_owned(),
            color: [0, 114, 178, 255],
            width: 1.6,
            points: points.to_vec(),
        };
        let text = svg(["t [s]", "a < b"], &[curve("one", &[[0.0, -1.0], [f64::NAN, 3.0], [10.0, 1.0]])]);
        assert!(text.contains("stroke-width=\"1.6\""), "{text}");
        assert!(text.contains("M78.00 352.82L702.00 49.18"), "{text}");
        assert!(text.contains("a &lt; b") && text.contains("#0072b2") && text.contains(">10</text>"), "{text}");
        assert!(!text.contains("NaN") && text.trim_end().ends_with("</svg>"));
        for points in [&[][..], &[[1.0, 5.0]], &[[0.0, 1e300], [1.0, -1e300]]] {
            let text = svg(["", ""], &[curve("", points)]);
            assert!(!text.contains("NaN") && !text.contains("inf"), "{text}");
        }
        let words: Vec<String> = ticks(-0.21, 0.4).into_iter().map(|(_, words)| words).collect();
        assert_eq!(words, ["-0.2", "0.0", "0.2", "0.4"]);
    }
}
