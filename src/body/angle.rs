//! Sine and cosine that give the same bits on every machine; the standard library's are the system's.

/// Cosine of an angle [rad].
pub fn cos(angle: f64) -> f64 {
    libm::cos(angle)
}

/// Sine of an angle [rad].
pub fn sin(angle: f64) -> f64 {
    libm::sin(angle)
}
