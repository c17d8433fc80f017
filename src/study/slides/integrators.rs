//! Integrators of two numbers at most, as a lecture writes them down. They are the study's own: the simulation's are
//! for points and bonds.

type Flow = fn([f64; 2]) -> [f64; 2];

/// x + s k.
fn along(x: [f64; 2], s: f64, k: [f64; 2]) -> [f64; 2] {
    [x[0] + s * k[0], x[1] + s * k[1]]
}

/// Explicit Euler.
pub(super) fn euler(f: Flow, x: [f64; 2], h: f64) -> [f64; 2] {
    along(x, h, f(x))
}

/// Runge and Kutta's method of order 2 (the midpoint rule).
pub(super) fn rk2(f: Flow, x: [f64; 2], h: f64) -> [f64; 2] {
    along(x, h, f(along(x, h / 2.0, f(x))))
}

/// Runge and Kutta's classical method of order 4.
pub(super) fn rk4(f: Flow, x: [f64; 2], h: f64) -> [f64; 2] {
    let k1 = f(x);
    let k2 = f(along(x, h / 2.0, k1));
    let k3 = f(along(x, h / 2.0, k2));
    let k4 = f(along(x, h, k3));
    let mean = along(along(along(k1, 2.0, k2), 2.0, k3), 1.0, k4);
    along(x, h / 6.0, mean)
}

/// Backward Euler on x' = -k x: y = x + h f(y).
pub(super) fn backward_euler(x: f64, k: f64, h: f64) -> f64 {
    solve(x, |y| y - x + h * k * y)
}

/// The implicit midpoint rule on x' = -k x: y = x + h f((x + y)/2).
pub(super) fn implicit_midpoint(x: f64, k: f64, h: f64) -> f64 {
    solve(x, |y| y - x + h * k * (x + y) / 2.0)
}

/// A root by the secant method, from `start` on.
fn solve(start: f64, residual: impl Fn(f64) -> f64) -> f64 {
    /// Linear equations take one; the rest is for rounding.
    const MOST: usize = 8;
    let (mut before, mut y) = (start, start + 1.0);
    for _ in 0..MOST {
        let (r0, r1) = (residual(before), residual(y));
        if r1 == 0.0 || r0 == r1 {
            break;
        }
        (before, y) = (y, y - r1 * (y - before) / (r1 - r0));
    }
    y
}
