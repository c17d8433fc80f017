//! Plots of the lectures' experiments.

use plotters::prelude::RGBColor;

use super::axes::{Panel, Scale};
use super::figure::{Anchor, Figure};
use super::style::{BLACK, BLUE, GREEN, GREY, Look, Marker, ORANGE, PURPLE, TEXT, TITLE, VERMILION, mark};
use super::work::entry;
use crate::study::slides::Slides;

/// Explicit Euler spirals out of the circle.
pub(crate) fn circle(slides: &Slides) -> Figure {
    let mut figure = Figure::new(660.0, 480.0);
    let scale = Scale::Linear { from: -3.0, to: 3.0, step: 1.0, decimals: 0 };
    let panel = Panel { left: 78.0, top: 46.0, right: 454.0, bottom: 422.0, x: scale, y: scale };
    panel.grid(&mut figure);
    let turn = |i: u32| std::f64::consts::TAU * f64::from(i) / 180.0;
    let truth = (0..=180).map(|i| panel.place([turn(i).cos(), turn(i).sin()])).collect();
    figure.line(truth, BLACK, 1.6);
    let euler = plain(VERMILION, Marker::Disc);
    let path: Vec<[f64; 2]> = slides.spiral.iter().map(|&point| panel.place(point)).collect();
    figure.line(path.clone(), euler.colour, euler.width);
    for &at in path.iter().step_by(8) {
        mark(&mut figure, at, euler);
    }
    panel.frame(&mut figure, "x", "y");
    figure.text([panel.left, 24.0], "x' = −y, y' = x by explicit Euler, three turns", TITLE, Anchor::Start, TEXT);
    let left = panel.right + 22.0;
    figure.line(vec![[left, 54.0], [left + 24.0, 54.0]], BLACK, 1.6);
    figure.text([left + 32.0, 54.0], "truth", 12.5, Anchor::Start, TEXT);
    entry(&mut figure, [left, 76.0], "Euler, h = 0.1", euler);
    figure.text([left, 118.0], "h", 12.5, Anchor::Start, TEXT);
    figure.text([left + 160.0, 118.0], "growth a turn", 12.5, Anchor::End, TEXT);
    for (i, row) in slides.circle.iter().enumerate() {
        let y = 140.0 + 20.0 * i as f64;
        figure.text([left, y], row.h.to_string(), 12.5, Anchor::Start, TEXT);
        figure.text([left + 160.0, y], format!("{:.3}", row.growth_turn), 12.5, Anchor::End, TEXT);
    }
    figure
}

/// The factor of a step on x' = -k x against h k.
pub(crate) fn decay(slides: &Slides) -> Figure {
    let mut figure = Figure::new(760.0, 430.0);
    let x = Scale::Linear { from: 0.0, to: 3.0, step: 0.5, decimals: 1 };
    let y = Scale::Linear { from: -2.0, to: 2.0, step: 0.5, decimals: 1 };
    let panel = Panel { left: 78.0, top: 46.0, right: 530.0, bottom: 372.0, x, y };
    panel.grid(&mut figure);
    for one in [-1.0, 1.0] {
        figure.dashes(panel.level(one), GREY, 1.2);
    }
    figure.line(panel.level(0.0).to_vec(), GREY, 1.0);
    let looks = [
        ("Euler", plain(VERMILION, Marker::Disc)),
        ("RK2", plain(ORANGE, Marker::Square)),
        ("RK4", plain(BLUE, Marker::Diamond)),
        ("backward Euler", plain(PURPLE, Marker::Up)),
        ("implicit midpoint", plain(GREEN, Marker::Down)),
    ];
    for (i, (method, look)) in looks.into_iter().enumerate() {
        let of_method = slides.decay.iter().filter(|row| row.method == method && row.factor <= 2.0);
        let line: Vec<[f64; 2]> = of_method.map(|row| panel.place([row.hk, row.factor])).collect();
        figure.line(line.clone(), look.colour, look.width);
        // Markers apart from one another, for the curves start at one place.
        for &at in line.iter().skip(i + 4).step_by(8) {
            mark(&mut figure, at, look);
        }
        entry(&mut figure, [panel.right + 22.0, 54.0 + 22.0 * i as f64], method, look);
    }
    panel.frame(&mut figure, "h k", "factor of a step");
    figure.text([panel.left, 24.0], "x' = −k x, what a step multiplies x with", TITLE, Anchor::Start, TEXT);
    let left = panel.right + 22.0;
    figure.text([left, 190.0], "below 0: oscillates", 12.5, Anchor::Start, TEXT);
    figure.text([left, 210.0], "past the dashes: diverges", 12.5, Anchor::Start, TEXT);
    figure
}

/// Error on the circle against the step.
pub(crate) fn orders(slides: &Slides) -> Figure {
    let mut figure = Figure::new(680.0, 430.0);
    let panel = Panel {
        left: 78.0,
        top: 46.0,
        right: 460.0,
        bottom: 372.0,
        x: Scale::decades(slides.errors.iter().map(|row| row.h)),
        y: Scale::decades(slides.errors.iter().map(|row| row.error)),
    };
    panel.grid(&mut figure);
    let looks = [plain(VERMILION, Marker::Disc), plain(ORANGE, Marker::Square), plain(BLUE, Marker::Diamond)];
    figure.text([panel.right + 200.0, 54.0], "order", 12.5, Anchor::End, TEXT);
    for (i, (order, look)) in slides.orders.iter().zip(looks).enumerate() {
        let of_method = slides.errors.iter().filter(|row| row.method == order.method);
        let line: Vec<[f64; 2]> = of_method.map(|row| panel.place([row.h, row.error])).collect();
        figure.line(line.clone(), look.colour, look.width);
        for at in line {
            mark(&mut figure, at, look);
        }
        let y = 76.0 + 22.0 * i as f64;
        entry(&mut figure, [panel.right + 22.0, y], order.method, look);
        figure.text([panel.right + 200.0, y], format!("{:.2}", order.order), 12.5, Anchor::End, TEXT);
    }
    panel.frame(&mut figure, "h [s]", "error after 1 s");
    figure.text([panel.left, 24.0], "x' = −y, y' = x: error against step", TITLE, Anchor::Start, TEXT);
    figure
}

fn plain(colour: RGBColor, marker: Marker) -> Look {
    Look { colour, marker, width: 1.5 }
}
