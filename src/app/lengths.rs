//! Lengths in words: those that are seen beside each other have one unit.

/// A unit that lengths are told in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LengthUnit {
    name: &'static str,
    /// How many there are in a metre.
    per_metre: f64,
}

/// Units, each with the largest length that it is for `[m]`: centimetres stand in no file, so that none are said.
const UNITS: [(f64, LengthUnit); 4] = [
    (0.1, LengthUnit { name: "m", per_metre: 1.0 }),
    (1e-4, LengthUnit { name: "mm", per_metre: 1e3 }),
    (1e-7, LengthUnit { name: "µm", per_metre: 1e6 }),
    (f64::MIN_POSITIVE, LengthUnit { name: "nm", per_metre: 1e9 }),
];

impl LengthUnit {
    /// The unit for lengths of which this is the largest `[m]`.
    pub(super) fn of(largest: f64) -> Self {
        let fits = UNITS.into_iter().find(|(least, _)| largest >= *least);
        fits.map_or(UNITS[0].1, |(_, unit)| unit)
    }

    /// A length `[m]` as a number, of three digits where it has as many.
    pub(super) fn number(self, metres: f64) -> String {
        match self.per_metre * metres {
            0.0 => "0".to_owned(),
            huge if huge.abs() >= 1e5 => format!("{huge:.0e}"),
            x if x.abs() >= 99.95 => format!("{x:.0}"),
            x if x.abs() >= 9.995 => format!("{x:.1}"),
            x if x.abs() >= 0.9995 => format!("{x:.2}"),
            x if x.abs() >= 9.95e-4 => format!("{x:.3}"),
            tiny => format!("{tiny:.0e}"),
        }
    }

    /// The same with the unit.
    pub(super) fn words(self, metres: f64) -> String {
        format!("{} {}", self.number(metres), self.name)
    }

    /// What it is called.
    pub(super) fn name(self) -> &'static str {
        self.name
    }
}

/// A length that stands alone `[m]`.
pub(super) fn length(metres: f64) -> String {
    LengthUnit::of(metres.abs()).words(metres)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_short_and_those_beside_each_other_have_one_unit() {
        let alone = [0.0, 3.2e-6, 0.0042, 0.034, 0.1, 2.5, 3e6].map(length);
        assert_eq!(alone, ["0 m", "3.20 µm", "4.20 mm", "34.0 mm", "0.100 m", "2.50 m", "3e6 m"]);
        let unit = LengthUnit::of(0.5);
        assert_eq!([0.5, 0.034, 2e-5].map(|x| unit.words(x)), ["0.500 m", "0.034 m", "2e-5 m"]);
    }
}
