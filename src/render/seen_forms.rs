//! What of the forms of bonds is seen in a picture: where it is nothing, or no more than a colour, a simpler shader draws them.
//!
//! A driver without a GPU works out what every form would be for every pixel of a stroke, which is most of what a net costs.

use super::forms::{COIL, ROD, STRUT};
use super::gpu_bond::{GpuBond, OF_WIDTH};

/// Springs and rods from which on they are not measured: it would take longer than it spares.
const MOST: usize = 200_000;
/// Share of the length from which on a spring is a coil that counts as that: lengths are rounded `[1]`.
const NEARLY: f64 = 0.99;
/// Width of a rod beside its length `[1]`, twice `ROD_SHARE` in bonds.wgsl; shorter ones are as wide as any bond.
const ROD_WIDTH: f64 = 0.07;
/// Width up to which a rod has no bright middle `[px]`.
const ROUND_FROM: f32 = 2.4;

/// What of the forms of bonds is seen: `FORMS` in common.wgsl.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Forms {
    /// Nothing: all are plain strokes.
    #[default]
    None,
    /// The colour of what keeps its length and is stretched all the same.
    Stretched,
    /// Whatever there is.
    All,
}

/// How large a picture shows bonds.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scale {
    pub(super) pixels_per_metre: f64,
    /// Length of a spring from which on it is a coil `[px]`; 0: nothing has a form.
    pub(super) coil_length: f32,
    /// Width of a plain stroke `[px]`.
    pub(super) bond_width: f32,
}

/// What of a world's bonds may have a form.
#[derive(Debug, Default)]
pub(super) struct SeenForms {
    /// Some that are neither plain strokes nor springs nor rods, or more of these than are measured.
    has_others: bool,
    /// Ends of springs, and of rods and struts.
    springs: Vec<[u32; 2]>,
    rods: Vec<[u32; 2]>,
    /// Length of the longest of either in both states `[m]`, where it has been measured since they moved.
    longest: Option<[f64; 2]>,
}

impl SeenForms {
    /// Of these bonds.
    pub(super) fn of(bonds: &[GpuBond]) -> Self {
        let is_rod = |bond: &&GpuBond| matches!(bond.form, ROD | STRUT) && bond.own & OF_WIDTH == 0;
        let is_spring = |bond: &&GpuBond| bond.form == COIL;
        let measured = bonds.iter().filter(|bond| is_spring(bond) || is_rod(bond)).count();
        let plain = bonds.iter().filter(|bond| bond.form == 0).count();
        if measured > MOST || measured + plain < bonds.len() {
            return SeenForms { has_others: true, ..SeenForms::default() };
        }
        let ends = |bond: &GpuBond| [bond.a, bond.b];
        let springs = bonds.iter().filter(is_spring).map(ends).collect();
        SeenForms { springs, rods: bonds.iter().filter(is_rod).map(ends).collect(), ..SeenForms::default() }
    }

    /// Points moved.
    pub(super) fn forget_motion(&mut self) {
        self.longest = None;
    }

    /// What may be seen in a picture.
    ///
    /// Shapes: both states as they lie on the GPU. In space a bond may be as near as any: each counts as long enough.
    pub(super) fn seen(&mut self, states: [&[f32]; 2], dimensions: usize, scale: Scale) -> Forms {
        let has_none = !self.has_others && self.springs.is_empty() && self.rods.is_empty();
        if scale.coil_length == 0.0 || has_none {
            return Forms::None;
        }
        if self.has_others || dimensions != 2 {
            return Forms::All;
        }
        let lists = [&self.springs, &self.rods];
        // Between both states none is longer than in the one or the other.
        let longest = *self.longest.get_or_insert_with(|| lists.map(|list| longest(list, states)));
        let [spring, rod] = longest.map(|metres| metres * scale.pixels_per_metre);
        let are_rods_seen = ROD_WIDTH * rod >= f64::from(scale.bond_width) || scale.bond_width > ROUND_FROM;
        let has_rods = !self.rods.is_empty();
        match has_rods {
            _ if spring >= NEARLY * f64::from(scale.coil_length) => Forms::All,
            true if are_rods_seen => Forms::All,
            true => Forms::Stretched,
            false => Forms::None,
        }
    }
}

/// The longest of pairs of points of the plane in any of the states.
fn longest(pairs: &[[u32; 2]], states: [&[f32]; 2]) -> f64 {
    let of_state = |places: &[f32]| {
        let places = places.as_chunks::<2>().0;
        let square = |&[a, b]: &[u32; 2]| match (places.get(a as usize), places.get(b as usize)) {
            (Some([x, y]), Some([u, v])) => (x - u) * (x - u) + (y - v) * (y - v),
            _ => 0.0,
        };
        pairs.iter().map(square).fold(0.0, f32::max)
    };
    f64::from(states.map(of_state).into_iter().fold(0.0, f32::max)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::forms::MUSCLE;

    fn bond(form: u32) -> GpuBond {
        GpuBond { form, ..GpuBond::new(0, 1, 1.0) }
    }

    fn scale(pixels_per_metre: f64, coil_length: f32) -> Scale {
        Scale { pixels_per_metre, coil_length, bond_width: 1.8 }
    }

    #[test]
    fn springs_have_a_form_where_one_is_long_enough_in_either_state() {
        let (short, long) = ([0.0_f32, 0.0, 0.3, 0.4], [0.0_f32, 0.0, 3.0, 4.0]);
        let mut forms = SeenForms::of(&[bond(COIL), bond(0)]);
        let mut is_seen = |states: [&[f32]; 2], pixels_per_metre: f64| {
            forms.forget_motion();
            forms.seen(states, 2, scale(pixels_per_metre, 90.0)) == Forms::All
        };
        assert!(!is_seen([&short, &short], 100.0), "50 px");
        assert!(is_seen([&short, &long], 100.0) && is_seen([&long, &short], 100.0), "500 px");
        assert!(is_seen([&short, &short], 180.0), "just as long");
        assert!(!is_seen([&[0.0, 0.0, f32::NAN, 0.0], &short], 100.0), "what is no number is not drawn");
        assert_eq!(forms.seen([&long, &long], 2, scale(100.0, 0.0)), Forms::None, "forms are off");
    }

    /// A rod of half a metre: as wide as its length makes it from 25.7 px on, and round where all strokes are wide.
    #[test]
    fn rods_that_are_as_wide_as_any_stroke_have_a_colour_alone() {
        let places = [0.0_f32, 0.0, 0.3, 0.4];
        let seen = |bonds: &[GpuBond], pixels_per_metre: f64, bond_width: f32| {
            let scale = Scale { bond_width, ..scale(pixels_per_metre, 36.0) };
            SeenForms::of(bonds).seen([&places, &places], 2, scale)
        };
        for form in [ROD, STRUT] {
            assert_eq!([50.0, 52.0].map(|near| seen(&[bond(form)], near, 1.8)), [Forms::Stretched, Forms::All]);
            assert_eq!(seen(&[bond(form), bond(COIL), bond(0)], 50.0, 1.8), Forms::Stretched);
            assert_eq!(seen(&[bond(form), bond(COIL)], 50.0, 2.5), Forms::All, "wide strokes");
            assert_eq!(seen(&[GpuBond { own: OF_WIDTH, ..bond(form) }], 1.0, 1.8), Forms::All, "of a width of its own");
        }
        let shaders = [include_str!("../../shaders/bonds.wgsl"), include_str!("../../shaders/common.wgsl")];
        assert!(shaders[0].contains("const ROD_SHARE: f32 = 0.035;") && ROD_WIDTH == 2.0 * 0.035);
        assert!(shaders[0].contains("kind == ROD && in.size.y > 1.2") && ROUND_FROM == 2.0 * 1.2);
        assert!(shaders[1].contains("override FORMS: u32 = 2u;"));
        assert_eq!([Forms::None, Forms::Stretched, Forms::All].map(|forms| forms as u32), [0, 1, 2]);
    }

    #[test]
    fn other_forms_are_seen_however_small_and_plain_strokes_have_none() {
        let places = [0.0_f32; 6];
        let seen = |forms: &[u32], dimensions: usize| {
            let bonds: Vec<GpuBond> = forms.iter().map(|form| bond(*form)).collect();
            SeenForms::of(&bonds).seen([&places, &places], dimensions, scale(1.0, 36.0))
        };
        assert_eq!(seen(&[0, COIL, MUSCLE], 2), Forms::All);
        assert_eq!([seen(&[0, COIL], 2), seen(&[0, 0], 2), seen(&[], 3)], [Forms::None; 3]);
        assert_eq!([seen(&[COIL], 3), seen(&[ROD], 3)], [Forms::All; 2], "in space it may be near");
    }

    #[test]
    fn lengths_are_measured_once_while_nothing_moves() {
        let (short, long) = ([0.0_f32, 0.0, 0.1, 0.0], [0.0_f32, 0.0, 9.0, 0.0]);
        let mut forms = SeenForms::of(&[bond(COIL)]);
        let seen = |forms: &mut SeenForms, state: &[f32]| forms.seen([state, state], 2, scale(100.0, 36.0));
        assert_eq!(seen(&mut forms, &short), Forms::None);
        assert_eq!(seen(&mut forms, &long), Forms::None, "nobody said that they moved");
        forms.forget_motion();
        assert_eq!(seen(&mut forms, &long), Forms::All);
    }
}
