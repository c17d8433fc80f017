//! A figure as a list of shapes, and its two forms: SVG and PNG from the same list.

use image::RgbImage;
use image::imageops::{FilterType, resize};
use plotters::coord::Shift;
use plotters::drawing::DrawingAreaErrorKind;
use plotters::prelude::{
    BitMapBackend, Color, DrawingArea, DrawingBackend, FontStyle, IntoDrawingArea, IntoFont, PathElement, Polygon,
    RGBColor, SVGBackend, Text, WHITE,
};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{FontTransform, register_font};

/// Coordinates of the drawing in a unit of the figure: the drawing's are whole numbers, and lines are not.
const FINE: f64 = 4.0;

/// Pixels of a PNG in a unit of the figure: twice what a screen shows, for print.
const PIXELS: f64 = 2.0;

/// The family that text is set in: the program's own font where it is drawn, the reader's in an SVG.
const FAMILY: &str = "sans-serif";

/// How much lower than its place text is set in a PNG, as a share of its size: there a line with its descenders is put
/// in the middle, in an SVG the small letters are.
const DROP: f64 = 0.17;

/// Which end of a text stands at its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// One shape, in units of the figure from its upper left corner.
#[derive(Clone, Debug)]
enum Shape {
    Line { points: Vec<[f64; 2]>, colour: RGBColor, width: f64 },
    Area { corners: Vec<[f64; 2]>, colour: RGBColor },
    Text { at: [f64; 2], text: String, size: f64, anchor: Anchor, colour: RGBColor, climbs: bool },
}

/// A figure: a size and what is drawn, in order.
#[derive(Clone, Debug)]
pub(crate) struct Figure {
    width: f64,
    height: f64,
    shapes: Vec<Shape>,
}

impl Figure {
    pub(super) fn new(width: f64, height: f64) -> Self {
        Figure { width, height, shapes: Vec::new() }
    }

    /// A line through points.
    pub(super) fn line(&mut self, points: Vec<[f64; 2]>, colour: RGBColor, width: f64) {
        let mut start = 0;
        for i in 1..points.len().saturating_sub(1) {
            // Joined there, its corner would end in a long spike.
            if is_sharp(points[i - 1], points[i], points[i + 1]) {
                self.shapes.push(Shape::Line { points: points[start..=i].to_vec(), colour, width });
                start = i;
            }
        }
        self.shapes.push(Shape::Line { points: points[start..].to_vec(), colour, width });
    }

    /// A straight line in dashes.
    pub(super) fn dashes(&mut self, [from, to]: [[f64; 2]; 2], colour: RGBColor, width: f64) {
        const DASH: f64 = 4.0;
        let [dx, dy] = [to[0] - from[0], to[1] - from[1]];
        let length = dx.hypot(dy);
        let at = |s: f64| [from[0] + dx * s / length, from[1] + dy * s / length];
        let mut s = 0.0;
        while s < length {
            self.line(vec![at(s), at((s + DASH).min(length))], colour, width);
            s += 2.0 * DASH;
        }
    }

    /// A filled polygon.
    pub(super) fn area(&mut self, corners: Vec<[f64; 2]>, colour: RGBColor) {
        self.shapes.push(Shape::Area { corners, colour });
    }

    /// A filled rectangle.
    pub(super) fn block(&mut self, [left, top]: [f64; 2], [right, bottom]: [f64; 2], colour: RGBColor) {
        self.area(vec![[left, top], [right, top], [right, bottom], [left, bottom]], colour);
    }

    /// A text, its middle at the height of its place.
    pub(super) fn text(&mut self, at: [f64; 2], text: impl Into<String>, size: f64, anchor: Anchor, colour: RGBColor) {
        self.shapes.push(Shape::Text { at, text: text.into(), size, anchor, colour, climbs: false });
    }

    /// A text that reads upwards, its middle at its place.
    pub(super) fn climbing_text(&mut self, at: [f64; 2], text: &str, size: f64, colour: RGBColor) {
        let text = text.to_owned();
        self.shapes.push(Shape::Text { at, text, size, anchor: Anchor::Middle, colour, climbs: true });
    }

    fn fine_size(&self) -> (u32, u32) {
        ((self.width * FINE).round() as u32, (self.height * FINE).round() as u32)
    }

    /// As SVG.
    ///
    /// Errors: the font cannot be read, which a test excludes.
    pub(crate) fn svg(&self) -> Result<String, String> {
        let (width, height) = self.fine_size();
        let mut text = String::new();
        self.draw(&SVGBackend::with_string(&mut text, (width, height)).into_drawing_area(), 0.0)?;
        // The fine coordinates stay; what changes is the size that the figure is shown at.
        let fine = format!("width=\"{width}\" height=\"{height}\"");
        Ok(text.replacen(&fine, &format!("width=\"{}\" height=\"{}\"", self.width, self.height), 1))
    }

    /// As an image.
    ///
    /// Errors: the font cannot be read, which a test excludes.
    pub(crate) fn image(&self) -> Result<RgbImage, String> {
        let (width, height) = self.fine_size();
        let mut fine = RgbImage::new(width, height);
        self.draw(&BitMapBackend::with_buffer(&mut fine, (width, height)).into_drawing_area(), DROP)?;
        // Lines are drawn without smooth edges: they get theirs here.
        let pixels = |length: f64| (length * PIXELS).round() as u32;
        Ok(resize(&fine, pixels(self.width), pixels(self.height), FilterType::Triangle))
    }

    /// Draws all shapes, text lower than its place by `drop` of its size.
    fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>, drop: f64) -> Result<(), String> {
        register_font(FAMILY, FontStyle::Normal, epaint_default_fonts::UBUNTU_LIGHT)
            .map_err(|_| "its font cannot be read".to_owned())?;
        let drawn = || {
            area.fill(&WHITE)?;
            for shape in &self.shapes {
                draw_shape(area, shape, drop)?;
            }
            area.present()
        };
        drawn().map_err(|error| error.to_string())
    }
}

/// Whether a line turns by more than a right angle at `b`.
fn is_sharp(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> bool {
    (b[0] - a[0]) * (c[0] - b[0]) + (b[1] - a[1]) * (c[1] - b[1]) < 0.0
}

fn fine(length: f64) -> i32 {
    (length * FINE).round() as i32
}

fn draw_shape<B: DrawingBackend>(
    area: &DrawingArea<B, Shift>,
    shape: &Shape,
    drop: f64,
) -> Result<(), DrawingAreaErrorKind<B::ErrorType>> {
    let place = |p: &[f64; 2]| (fine(p[0]), fine(p[1]));
    match shape {
        Shape::Line { points, colour, width } => {
            let style = colour.stroke_width(fine(*width).max(1) as u32);
            area.draw(&PathElement::new(points.iter().map(place).collect::<Vec<_>>(), style))
        }
        Shape::Area { corners, colour } => {
            area.draw(&Polygon::new(corners.iter().map(place).collect::<Vec<_>>(), colour.filled()))
        }
        Shape::Text { at, text, size, anchor, colour, climbs } => {
            let across = match anchor {
                Anchor::Start => HPos::Left,
                Anchor::Middle => HPos::Center,
                Anchor::End => HPos::Right,
            };
            let font = (FAMILY, size * FINE).into_font();
            let font = if *climbs { font.transform(FontTransform::Rotate270) } else { font };
            let style = font.color(colour).pos(Pos::new(across, VPos::Center));
            let [right, down] = if *climbs { [drop * size, 0.0] } else { [0.0, drop * size] };
            area.draw(&Text::new(text.as_str(), place(&[at[0] + right, at[1] + down]), style))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_forms_show_the_same_shapes_at_their_size() {
        let mut figure = Figure::new(60.0, 40.0);
        figure.block([10.0, 10.0], [30.0, 30.0], RGBColor(0, 114, 178));
        figure.text([45.0, 20.0], "a < b", 8.0, Anchor::Middle, RGBColor(0, 0, 0));
        let svg = figure.svg().unwrap();
        assert!(svg.starts_with("<svg width=\"60\" height=\"40\" viewBox=\"0 0 240 160\""), "{svg}");
        assert!(svg.contains("a &lt; b") && svg.contains("#0072B2"), "{svg}");
        let image = figure.image().unwrap();
        assert_eq!(image.dimensions(), (120, 80));
        assert_eq!(image.get_pixel(40, 40).0, [0, 114, 178]);
        assert_eq!(image.get_pixel(10, 10).0, [255, 255, 255]);
        let ink = image.enumerate_pixels().filter(|(x, _, p)| *x > 64 && p.0[0] < 128).count();
        assert!(ink > 20, "the text is drawn: {ink}");
    }
}
