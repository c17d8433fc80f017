//! A bond as it is drawn, and as the shader reads it.

use bytemuck::{Pod, Zeroable};

use super::forms::{form, packed};
use crate::sim::Bond;

/// A bond as it is drawn.
#[derive(Clone, Copy, Debug)]
pub(super) struct GpuBond {
    pub(super) a: u32,
    pub(super) b: u32,
    pub(super) rest_length: f32,
    /// What it is drawn as: forms.rs.
    pub(super) form: u32,
    /// What it has of its body's own, [`OF_COLOR`] and [`OF_WIDTH`], and whether it is [`COVERED`]: own.rs.
    pub(super) own: u32,
}

/// A bond has its body's own colour, and its own width; it lies on its body's fill or picture, where it has the colour only if these are not shown:
/// `OF_COLOR`, `OF_WIDTH` and `COVERED` in bonds.wgsl.
pub(super) const OF_COLOR: u32 = 1;
pub(super) const OF_WIDTH: u32 = 2;
pub(super) const COVERED: u32 = 4;

/// A bond as the shader reads it: `Packed` in bonds.wgsl. Its form lies in the upper bits of `b`, what it has of its body's own in those of `a`: the
/// positions of as many points as the others can count are more than a GPU's buffers hold.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(super) struct PackedBond {
    a: u32,
    b: u32,
    rest_length: f32,
}

const _: () = assert!(size_of::<PackedBond>() == 12);

/// Where the upper bits of a packed bond begin: `FORM` in bonds.wgsl.
const FORM: u32 = 29;

impl From<&GpuBond> for PackedBond {
    fn from(&GpuBond { a, b, rest_length, form, own }: &GpuBond) -> Self {
        let (form, rest_length) = packed(form, rest_length);
        let [a, b] = [(a, own), (b, form)].map(|(end, upper)| end & ((1 << FORM) - 1) | upper << FORM);
        PackedBond { a, b, rest_length }
    }
}

impl GpuBond {
    /// A plain stroke.
    #[cfg(test)]
    pub(super) fn new(a: u32, b: u32, rest_length: f32) -> Self {
        GpuBond { a, b, rest_length, form: 0, own: 0 }
    }
}

impl From<Bond> for GpuBond {
    fn from(bond: Bond) -> Self {
        GpuBond { a: bond.a.0, b: bond.b.0, rest_length: bond.rest_length as f32, form: form(&bond), own: 0 }
    }
}

/// The middle one of the rest lengths `[m]`; 0 without bonds.
pub(super) fn median_rest_length(bonds: &[GpuBond]) -> f64 {
    // A sample is enough to size points by.
    let step = (bonds.len() / 1000).max(1);
    let mut lengths: Vec<f32> = bonds.iter().step_by(step).map(|bond| bond.rest_length).collect();
    lengths.sort_by(f32::total_cmp);
    lengths.get(lengths.len() / 2).copied().map_or(0.0, f64::from)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_packed_can_be_told_apart_again() {
        let bond = GpuBond { form: 5, own: OF_COLOR | OF_WIDTH, ..GpuBond::new(7, 9, 0.5) };
        let packed = PackedBond::from(&bond);
        let low = |end: u32| end & ((1 << FORM) - 1);
        assert_eq!([low(packed.a), packed.a >> FORM, low(packed.b), packed.b >> FORM], [7, 3, 9, 5]);
        let source = include_str!("../../shaders/bonds.wgsl");
        for line in [
            format!("const FORM: u32 = {FORM}u;"),
            format!("const OF_COLOR: u32 = {OF_COLOR}u;"),
            format!("const OF_WIDTH: u32 = {OF_WIDTH}u;"),
            format!("const COVERED: u32 = {COVERED}u;"),
        ] {
            assert!(source.contains(&line), "{line}");
        }
    }
}
