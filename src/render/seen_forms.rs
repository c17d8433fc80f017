//! Whether any bond in a picture is drawn as more than a stroke: where none is, its shader is one that knows no forms.
//!
//! A driver without a GPU works out what every form would be for every pixel of a stroke, which is most of what a net of springs costs.

use super::forms::COIL;
use super::gpu_bond::GpuBond;

/// Springs from which on they are not measured: it would take longer than it spares.
const MOST: usize = 200_000;
/// Share of the length from which on a spring is a coil that counts as that: lengths are rounded `[1]`.
const NEARLY: f64 = 0.99;

/// What of a world's bonds may have a form.
#[derive(Debug, Default)]
pub(super) struct SeenForms {
    /// Some that are neither plain strokes nor springs, or more springs than are measured.
    has_others: bool,
    /// Ends of springs.
    springs: Vec<[u32; 2]>,
    /// Length of the longest of them in both states `[m]`, where it has been measured since they moved.
    longest: Option<f64>,
}

impl SeenForms {
    /// Of these bonds.
    pub(super) fn of(bonds: &[GpuBond]) -> Self {
        let springs = || bonds.iter().filter(|bond| bond.form == COIL);
        let has_others = bonds.iter().any(|bond| bond.form != 0 && bond.form != COIL) || springs().count() > MOST;
        let springs = if has_others { Vec::new() } else { springs().map(|bond| [bond.a, bond.b]).collect() };
        SeenForms { has_others, springs, longest: None }
    }

    /// Points moved.
    pub(super) fn forget_motion(&mut self) {
        self.longest = None;
    }

    /// Whether one may have a form in a picture of so many pixels a metre, where springs of that length `[px]` are coils; 0: nothing has a form.
    ///
    /// Shapes: both states as they lie on the GPU. In space a spring may be as near as any: each counts as long enough.
    pub(super) fn are_seen(
        &mut self,
        states: [&[f32]; 2],
        dimensions: usize,
        (pixels_per_metre, coil_length): (f64, f32),
    ) -> bool {
        if coil_length == 0.0 || (!self.has_others && self.springs.is_empty()) {
            return false;
        }
        if self.has_others || dimensions != 2 {
            return true;
        }
        let springs = &self.springs;
        let longest = *self.longest.get_or_insert_with(|| longest(springs, states));
        // Between both states none is longer than in the one or the other.
        longest * pixels_per_metre >= NEARLY * f64::from(coil_length)
    }
}

/// The longest of pairs of points of the plane in any of the states.
fn longest(springs: &[[u32; 2]], states: [&[f32]; 2]) -> f64 {
    let of_state = |places: &[f32]| {
        let places = places.as_chunks::<2>().0;
        let square = |&[a, b]: &[u32; 2]| match (places.get(a as usize), places.get(b as usize)) {
            (Some([x, y]), Some([u, v])) => (x - u) * (x - u) + (y - v) * (y - v),
            _ => 0.0,
        };
        springs.iter().map(square).fold(0.0, f32::max)
    };
    f64::from(states.map(of_state).into_iter().fold(0.0, f32::max)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::forms::ROD;

    fn bond(form: u32) -> GpuBond {
        GpuBond { form, ..GpuBond::new(0, 1, 1.0) }
    }

    #[test]
    fn springs_have_a_form_where_one_is_long_enough_in_either_state() {
        let (short, long) = ([0.0_f32, 0.0, 0.3, 0.4], [0.0_f32, 0.0, 3.0, 4.0]);
        let mut forms = SeenForms::of(&[bond(COIL), bond(0)]);
        let mut seen = |states: [&[f32]; 2], scale: f64| {
            forms.forget_motion();
            forms.are_seen(states, 2, (scale, 90.0))
        };
        assert!(!seen([&short, &short], 100.0), "50 px");
        assert!(seen([&short, &long], 100.0) && seen([&long, &short], 100.0), "500 px");
        assert!(seen([&short, &short], 180.0), "just as long");
        assert!(!seen([&[0.0, 0.0, f32::NAN, 0.0], &short], 100.0), "what is no number is not drawn");
        assert!(!forms.are_seen([&long, &long], 2, (100.0, 0.0)), "forms are off");
    }

    #[test]
    fn other_forms_are_seen_however_small_and_plain_strokes_have_none() {
        let places = [0.0_f32; 6];
        let seen = |forms: &[u32], dimensions: usize| {
            let bonds: Vec<GpuBond> = forms.iter().map(|form| bond(*form)).collect();
            SeenForms::of(&bonds).are_seen([&places, &places], dimensions, (1.0, 36.0))
        };
        assert!(seen(&[0, COIL, ROD], 2) && !seen(&[0, COIL], 2) && !seen(&[0, 0], 2) && !seen(&[], 3));
        assert!(seen(&[COIL], 3), "in space it may be near");
    }

    #[test]
    fn lengths_are_measured_once_while_nothing_moves() {
        let (short, long) = ([0.0_f32, 0.0, 0.1, 0.0], [0.0_f32, 0.0, 9.0, 0.0]);
        let mut forms = SeenForms::of(&[bond(COIL)]);
        assert!(!forms.are_seen([&short, &short], 2, (100.0, 36.0)));
        assert!(!forms.are_seen([&long, &long], 2, (100.0, 36.0)), "nobody said that they moved");
        forms.forget_motion();
        assert!(forms.are_seen([&long, &long], 2, (100.0, 36.0)));
    }
}
