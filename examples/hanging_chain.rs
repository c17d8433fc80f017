//! A chain of rigid links between two pins swings until it hangs still; its shape is compared with the closed form.
//!
//! `cargo run --release --example hanging_chain`
#![allow(clippy::print_stdout, reason = "a program that prints its result")]

use wobble::sim::{Bond, Method, Model, ModelError, PointId, build};

/// How many links the chain has: an even number.
const LINKS: u32 = 30;
/// Length of a link [m].
const LINK: f64 = 0.1;
/// Distance of the pins [m], below the length of the chain.
const SPAN: f64 = 2.0;
/// Mass of a point [kg].
const MASS: f64 = 0.01;
/// The time that drag has to take the swing away [s].
pub(crate) const TIME: f64 = 30.0;

fn main() -> Result<(), ModelError> {
    println!("{LINKS} links after {TIME} s: {:.1e} m from the closed form", error(TIME)?);
    Ok(())
}

/// The chain as a V between its pins, in air that slows it down.
fn chain() -> Model<2> {
    let run = SPAN / f64::from(LINKS);
    let fall = (LINK * LINK - run * run).sqrt();
    let place = |i: u32| [run * f64::from(i), -fall * f64::from(i.min(LINKS - i))];
    let position: Vec<[f64; 2]> = (0..=LINKS).map(place).collect();
    Model {
        velocity: vec![[0.0; 2]; position.len()],
        mass: vec![MASS; position.len()],
        position,
        pinned: vec![PointId(0), PointId(LINKS)],
        bonds: (0..LINKS).map(|i| Bond::new(PointId(i), PointId(i + 1), LINK)).collect(),
        gravity: [0.0, -9.81],
        drag_rate: 2.0,
        // What sleeps stays a little off the shape at rest.
        method: Method { sleeps: false, ..Method::default() },
        ..Model::default()
    }
}

/// Largest distance [m] of a point from where the closed form has it, after `time` [s].
pub(crate) fn error(time: f64) -> Result<f64, ModelError> {
    let mut world = build(&chain())?;
    while world.time() < time {
        world.step();
    }
    let sample = world.sample(world.time());
    let apart = |(found, truth): (&[f64; 3], [f64; 2])| (found[0] - truth[0]).hypot(found[1] - truth[1]);
    Ok(sample.position.iter().zip(hanging()).map(apart).fold(0.0, f64::max))
}

/// Where the points of the chain hang.
///
/// Model: the horizontal pull H is the same in all links, and each point adds its weight w to the vertical one. So link k has
/// the slope (k - (n - 1)/2) w/H, k from 0 to n - 1; w/H follows from the distance of the pins. For many short links
/// that is the catenary.
fn hanging() -> Vec<[f64; 2]> {
    let slope = |k: u32, ratio: f64| (f64::from(k) - 0.5 * f64::from(LINKS - 1)) * ratio;
    let run = |k: u32, ratio: f64| LINK / slope(k, ratio).hypot(1.0);
    let span = |ratio: f64| (0..LINKS).map(|k| run(k, ratio)).sum::<f64>();
    let (mut low, mut high) = (0.0, 1e3);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        *(if span(middle) > SPAN { &mut low } else { &mut high }) = middle;
    }
    let mut at = [0.0, 0.0];
    let links = (0..LINKS).map(|k| [run(k, low), run(k, low) * slope(k, low)]);
    let ends = links.map(|[x, y]| {
        at = [at[0] + x, at[1] + y];
        at
    });
    std::iter::once([0.0, 0.0]).chain(ends).collect()
}
