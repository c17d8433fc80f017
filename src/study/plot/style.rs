//! Colours, markers and sizes that all plots share.

use plotters::prelude::RGBColor;

use super::figure::Figure;

/// Colours that the colour-blind tell apart too.
///
/// Source: M. Okabe, K. Ito, "Color universal design" (2008); their yellow is left out, which is too light for lines.
pub(super) const BLACK: RGBColor = RGBColor(0, 0, 0);
pub(super) const ORANGE: RGBColor = RGBColor(230, 159, 0);
pub(super) const SKY: RGBColor = RGBColor(86, 180, 233);
pub(super) const GREEN: RGBColor = RGBColor(0, 158, 115);
pub(super) const BLUE: RGBColor = RGBColor(0, 114, 178);
pub(super) const VERMILION: RGBColor = RGBColor(213, 94, 0);
pub(super) const PURPLE: RGBColor = RGBColor(204, 121, 167);
pub(super) const GREY: RGBColor = RGBColor(130, 130, 130);

/// Of text that is no data.
pub(super) const TEXT: RGBColor = RGBColor(40, 40, 40);
/// Of grid lines at labelled places.
pub(super) const MAJOR: RGBColor = RGBColor(216, 216, 216);
/// Of grid lines between these.
pub(super) const MINOR: RGBColor = RGBColor(241, 241, 241);

/// Sizes of text.
pub(super) const TITLE: f64 = 15.0;
pub(super) const LABEL: f64 = 12.5;
pub(super) const SMALL: f64 = 11.5;

/// The shape that marks a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Marker {
    Disc,
    Square,
    Diamond,
    Up,
    Down,
    Cross,
    Plus,
}

/// How a line looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Look {
    pub(super) colour: RGBColor,
    pub(super) marker: Marker,
    pub(super) width: f64,
}

/// The look of a solver, the same in every plot: a colour a family, a marker each.
pub(super) fn look(solver: &str) -> Look {
    let (colour, marker) = match solver {
        "baseline" => (BLACK, Marker::Disc),
        "euler" => (GREY, Marker::Down),
        "symplectic-euler" => (GREY, Marker::Up),
        "verlet" => (SKY, Marker::Disc),
        "velocity-verlet" => (BLUE, Marker::Square),
        "pefrl" => (GREEN, Marker::Up),
        "blanes-moan-4" => (GREEN, Marker::Diamond),
        "blanes-moan-6" => (GREEN, Marker::Square),
        "rk2" => (ORANGE, Marker::Disc),
        "rk4" => (ORANGE, Marker::Square),
        "rk8" => (ORANGE, Marker::Diamond),
        "implicit-midpoint" => (PURPLE, Marker::Disc),
        "backward-euler" => (PURPLE, Marker::Square),
        "xpbd" => (VERMILION, Marker::Plus),
        "relaxation" => (VERMILION, Marker::Cross),
        "live" => (VERMILION, Marker::Diamond),
        _ => (GREY, Marker::Plus),
    };
    Look { colour, marker, width: if solver == "baseline" { 2.0 } else { 1.3 } }
}

/// Draws a marker about a place.
pub(super) fn mark(figure: &mut Figure, [x, y]: [f64; 2], look: Look) {
    const SIZE: f64 = 3.2;
    let corner = |dx: f64, dy: f64| [x + SIZE * dx, y + SIZE * dy];
    let corners = match look.marker {
        Marker::Disc => {
            let turn = |i: u32| std::f64::consts::TAU * f64::from(i) / 20.0;
            (0..20).map(|i| corner(turn(i).cos(), turn(i).sin())).collect()
        }
        Marker::Square => vec![corner(-0.9, -0.9), corner(0.9, -0.9), corner(0.9, 0.9), corner(-0.9, 0.9)],
        Marker::Diamond => vec![corner(0.0, -1.3), corner(1.3, 0.0), corner(0.0, 1.3), corner(-1.3, 0.0)],
        Marker::Up => vec![corner(0.0, -1.3), corner(1.2, 0.9), corner(-1.2, 0.9)],
        Marker::Down => vec![corner(0.0, 1.3), corner(1.2, -0.9), corner(-1.2, -0.9)],
        Marker::Cross => {
            figure.line(vec![corner(-1.0, -1.0), corner(1.0, 1.0)], look.colour, 1.4);
            figure.line(vec![corner(-1.0, 1.0), corner(1.0, -1.0)], look.colour, 1.4);
            return;
        }
        Marker::Plus => {
            figure.line(vec![corner(-1.3, 0.0), corner(1.3, 0.0)], look.colour, 1.4);
            figure.line(vec![corner(0.0, -1.3), corner(0.0, 1.3)], look.colour, 1.4);
            return;
        }
    };
    figure.area(corners, look.colour);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::methods::solvers;

    #[test]
    fn no_two_solvers_look_alike() {
        let mut looks: Vec<Look> = solvers().map(|solver| look(solver.name())).collect();
        looks.push(look("baseline"));
        for (i, one) in looks.iter().enumerate() {
            assert!(looks[..i].iter().all(|other| other != one), "{one:?}");
        }
    }
}
