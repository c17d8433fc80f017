//! Three experiments that lectures on integrators show, measured: explicit Euler spirals out of a circle, a step too
//! long makes decay oscillate and then diverge, and methods converge with their order.

mod integrators;

use serde::Serialize;

use super::fit::slope;
use integrators::{backward_euler, euler, implicit_midpoint, rk2, rk4};

/// A step of x' = f(x) for the state (x, y) by `h`.
type Explicit = fn(fn([f64; 2]) -> [f64; 2], [f64; 2], f64) -> [f64; 2];

/// The explicit methods, by name, with their order.
const EXPLICIT: [(&str, Explicit, f64); 3] = [("RK1 (Euler)", euler, 1.0), ("RK2", rk2, 2.0), ("RK4", rk4, 4.0)];

/// A step of x' = -k x: (x, k, h).
type Decay = fn(f64, f64, f64) -> f64;

/// A closed form in z = h k.
type Factor = fn(f64) -> f64;

/// The methods whose factor on x' = -k x is measured, with the closed form of that factor in z = h k.
const DECAY: [(&str, Decay, Factor); 5] = [
    ("Euler", |x, k, h| decayed(euler, x, k, h), |z| 1.0 - z),
    ("RK2", |x, k, h| decayed(rk2, x, k, h), |z| 1.0 - z + z * z / 2.0),
    ("RK4", |x, k, h| decayed(rk4, x, k, h), |z| 1.0 - z + z * z / 2.0 - z.powi(3) / 6.0 + z.powi(4) / 24.0),
    ("backward Euler", backward_euler, |z| 1.0 / (1.0 + z)),
    ("implicit midpoint", implicit_midpoint, |z| (1.0 - z / 2.0) / (1.0 + z / 2.0)),
];

/// Steps of the circle `[s]`.
const CIRCLE_STEPS: [f64; 5] = [0.2, 0.1, 0.05, 0.02, 0.01];

/// Largest h k that decay is measured at `[1]`.
const LARGEST_Z: f64 = 3.0;

/// Steps of h k between two measurements `[1]`.
const Z_STEP: f64 = 0.05;

/// Decay rate that h is chosen for `[1/s]`; the factors depend on h k alone.
const RATE: f64 = 4.0;

/// Explicit Euler on the circle x' = -y, y' = x.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct CircleRow {
    /// Step `[s]`.
    pub h: f64,
    /// Factor of the radius in a step, measured `[1]`.
    pub growth_step: f64,
    /// sqrt(1 + h^2).
    pub expected_step: f64,
    /// Factor of the radius over the whole steps that complete a turn, measured `[1]`.
    pub growth_turn: f64,
    /// (1 + h^2)^(n/2) for n = ceil(2 pi/h).
    pub expected_turn: f64,
}

/// The factor that a step of x' = -k x multiplies x with.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct DecayRow {
    /// The method.
    pub method: &'static str,
    /// h k `[1]`.
    pub hk: f64,
    /// The factor, measured `[1]`.
    pub factor: f64,
    /// Its closed form.
    pub expected: f64,
}

/// The error of a method on the circle after a time of 1 s.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct OrderRow {
    /// The method.
    pub method: &'static str,
    /// Step `[s]`.
    pub h: f64,
    /// Distance from the truth `[m]`.
    pub error: f64,
}

/// The observed order of a method.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ObservedOrder {
    /// The method.
    pub method: &'static str,
    /// Slope of log error against log h `[1]`.
    pub order: f64,
    /// The method's order.
    pub expected: f64,
}

/// All three experiments.
#[derive(Clone, Debug, Serialize)]
pub struct Slides {
    /// Growth on the circle.
    pub circle: Vec<CircleRow>,
    /// The path of explicit Euler on the circle at h = 0.1 s over three turns, for the plot.
    pub spiral: Vec<[f64; 2]>,
    /// Factors on decay.
    pub decay: Vec<DecayRow>,
    /// Errors on the circle.
    pub errors: Vec<OrderRow>,
    /// Orders fitted through them.
    pub orders: Vec<ObservedOrder>,
}

/// Runs the experiments; they take no time worth a bar.
pub fn slides() -> Slides {
    let errors: Vec<OrderRow> = EXPLICIT.iter().flat_map(|&(name, step, _)| order_rows(name, step)).collect();
    Slides {
        circle: CIRCLE_STEPS.map(circle_row).to_vec(),
        spiral: spiral(0.1, 3),
        decay: DECAY.iter().flat_map(|&(method, step, expected)| decay_rows(method, step, expected)).collect(),
        orders: EXPLICIT.iter().filter_map(|&(method, _, order)| observed(method, order, &errors)).collect(),
        errors,
    }
}

/// x' = -y, y' = x: once round in 2 pi.
fn circle([x, y]: [f64; 2]) -> [f64; 2] {
    [-y, x]
}

fn radius([x, y]: [f64; 2]) -> f64 {
    x.hypot(y)
}

/// Whole steps that complete a turn.
fn steps_a_turn(h: f64) -> u32 {
    (std::f64::consts::TAU / h).ceil() as u32
}

fn circle_row(h: f64) -> CircleRow {
    let steps = steps_a_turn(h);
    let start = [1.0, 0.0];
    let after_turn = (0..steps).fold(start, |x, _| euler(circle, x, h));
    CircleRow {
        h,
        growth_step: radius(euler(circle, start, h)),
        expected_step: (1.0 + h * h).sqrt(),
        growth_turn: radius(after_turn),
        expected_turn: (1.0 + h * h).powf(f64::from(steps) / 2.0),
    }
}

fn spiral(h: f64, turns: u32) -> Vec<[f64; 2]> {
    let next = |x: &[f64; 2]| Some(euler(circle, *x, h));
    std::iter::successors(Some([1.0, 0.0]), next).take((steps_a_turn(h) * turns) as usize + 1).collect()
}

/// x' = -k x by an explicit method: time is scaled so that the rate is 1.
fn decayed(step: Explicit, x: f64, k: f64, h: f64) -> f64 {
    step(|[x, _]| [-x, 0.0], [x, 0.0], h * k)[0]
}

fn decay_rows(method: &'static str, step: Decay, expected: Factor) -> impl Iterator<Item = DecayRow> {
    let count = (LARGEST_Z / Z_STEP).round() as u32;
    (0..=count).map(move |i| {
        let hk = f64::from(i) * Z_STEP;
        DecayRow { method, hk, factor: step(1.0, RATE, hk / RATE), expected: expected(hk) }
    })
}

fn order_rows(method: &'static str, step: Explicit) -> impl Iterator<Item = OrderRow> {
    (2..=9).map(move |i| {
        let steps = 1_u32 << i;
        let h = 1.0 / f64::from(steps);
        let [x, y] = (0..steps).fold([1.0, 0.0], |x, _| step(circle, x, h));
        OrderRow { method, h, error: radius([x - 1.0_f64.cos(), y - 1.0_f64.sin()]) }
    })
}

fn observed(method: &'static str, expected: f64, errors: &[OrderRow]) -> Option<ObservedOrder> {
    let of_method = errors.iter().filter(|row| row.method == method && row.error > 1e-13);
    let points: Vec<(f64, f64)> = of_method.map(|row| (row.h.ln(), row.error.ln())).collect();
    // The finest half: the coarse steps are not yet on the line.
    slope(&points[points.len() / 2..]).map(|order| ObservedOrder { method, order, expected })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn euler_grows_on_the_circle_as_the_closed_form_says() {
        for row in slides().circle {
            assert!((row.growth_step - row.expected_step).abs() < 1e-15);
            assert!((row.growth_turn / row.expected_turn - 1.0).abs() < 1e-12);
        }
        assert!((circle_row(0.1).growth_turn - 1.368).abs() < 5e-4);
    }

    #[test]
    fn factors_of_decay_are_those_of_the_closed_forms() {
        for row in slides().decay {
            assert!((row.factor - row.expected).abs() < 1e-12, "{row:?}");
        }
    }

    #[test]
    fn euler_oscillates_past_1_and_diverges_past_2_and_the_implicit_ones_never_do() {
        for row in slides().decay {
            match row.method {
                "Euler" => {
                    assert_eq!(row.factor < -1e-12, row.hk > 1.0 + 1e-12, "{row:?}");
                    assert_eq!(row.factor.abs() > 1.0 + 1e-12, row.hk > 2.0 + 1e-12, "{row:?}");
                }
                "backward Euler" => assert!(row.factor > 0.0 && row.factor <= 1.0, "{row:?}"),
                "implicit midpoint" => assert!(row.factor.abs() <= 1.0, "{row:?}"),
                _ => {}
            }
        }
    }

    #[test]
    fn orders_are_1_2_and_4() {
        let orders = slides().orders;
        assert_eq!(orders.len(), 3);
        for (order, expected) in orders.iter().zip([1.0, 2.0, 4.0]) {
            assert!((order.order - expected).abs() < 0.05, "{order:?}");
            assert_eq!(order.expected, expected);
        }
    }
}
