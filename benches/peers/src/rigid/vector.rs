//! Vectors of the plane.

/// A place [m], a direction or a velocity [m/s].
pub(super) type Vector = [f64; 2];

/// The sum.
pub(super) fn add(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1]]
}

/// What leads from `b` to `a`.
pub(super) fn minus(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1]]
}

/// `a` times a number.
pub(super) fn times(a: Vector, factor: f64) -> Vector {
    a.map(|coordinate| coordinate * factor)
}

/// The scalar product.
pub(super) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// The cross product: positive if `b` lies anticlockwise of `a`.
pub(super) fn cross(a: Vector, b: Vector) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// The length.
pub(super) fn length(a: Vector) -> f64 {
    a[0].hypot(a[1])
}

/// `a` turned by an angle [rad], anticlockwise.
pub(super) fn turned(a: Vector, angle: f64) -> Vector {
    let (sin, cos) = angle.sin_cos();
    [cos * a[0] - sin * a[1], sin * a[0] + cos * a[1]]
}
