//! The bonds of a file as a list that takes little memory: a scene may have millions.

use std::borrow::Cow;
use std::fmt;

use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::de::{Deserialize, Deserializer, SeqAccess, Visitor};
use serde::ser::{Serialize, Serializer};

use super::bond::BondKeys;
use crate::sim::shared::{Bits, Shared};

/// What stands for a rest length that is not said: a bit pattern that [`BondList::push`] keeps to itself.
const UNSAID: f64 = f64::from_bits(0x7FFA_0000_0000_0000);

/// The bonds of a scene, as the file says them; [`BondKeys`] is what goes in and comes out.
///
/// Shapes: ends and rest lengths have one entry a bond; all other keys are kept once for all bonds that say the same.
#[derive(Clone, Debug, Default)]
pub struct BondList {
    ends: Vec<[u32; 2]>,
    rests: Vec<f64>,
    /// All keys but these: `a` and `b` are 0, `rest` is not said.
    materials: Shared<BondKeys>,
}

impl Bits for BondKeys {
    type Key = [u64; 16];

    #[inline]
    fn bits(&self) -> [u64; 16] {
        let numbers = [
            self.stiffness,
            self.compliance,
            self.axial_stiffness,
            self.damping,
            self.relaxation,
            self.max_correction,
            self.break_strain,
        ];
        let mut bits = [0; 16];
        bits[7] = self.kind.map_or(0, |kind| 1 + kind as u64) + (self.limit.map_or(0, |limit| 1 + limit as u64) << 8);
        for (k, number) in numbers.into_iter().enumerate() {
            bits[7] |= u64::from(number.is_some()) << (16 + k);
            bits[k] = number.unwrap_or(0.0).to_bits();
        }
        if let Some(drive) = &self.drive {
            bits[7] |= 1 << 32;
            bits[8..].copy_from_slice(&drive.bits());
        }
        bits
    }
}

impl BondList {
    /// No bonds.
    pub fn new() -> Self {
        BondList::default()
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// Bond `k`, below [`BondList::len`].
    #[inline]
    pub fn get(&self, k: usize) -> BondKeys {
        let [a, b] = self.ends[k];
        BondKeys { a, b, rest: self.rest(k), ..*self.materials.get(k) }
    }

    /// All bonds, in order, by value.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = BondKeys> + '_ {
        (0..self.len()).map(|k| self.get(k))
    }

    /// Adds a bond.
    #[inline]
    pub fn push(&mut self, bond: BondKeys) {
        let rest = match bond.rest {
            None => UNSAID,
            // No number at all is refused, whatever its bits.
            Some(rest) if rest.is_nan() => f64::NAN,
            Some(rest) => rest,
        };
        self.ends.push([bond.a, bond.b]);
        self.rests.push(rest);
        self.materials.push(BondKeys { a: 0, b: 0, rest: None, ..bond });
    }

    /// Makes room for `count` more.
    pub fn reserve(&mut self, count: usize) {
        self.ends.reserve(count);
        self.rests.reserve(count);
    }

    /// The ends of bond `k`.
    #[inline]
    pub(in crate::scene) fn ends(&self, k: usize) -> [u32; 2] {
        self.ends[k]
    }

    /// What bond `k` says of its rest length `[m]`.
    #[inline]
    pub(in crate::scene) fn rest(&self, k: usize) -> Option<f64> {
        let rest = self.rests[k];
        (rest.to_bits() != UNSAID.to_bits()).then_some(rest)
    }

    /// What the bonds are made of: keys but for ends and rest length, each once.
    pub(in crate::scene) fn materials(&self) -> &[BondKeys] {
        self.materials.table()
    }

    /// Where what bond `k` is made of stands in [`BondList::materials`].
    #[inline]
    pub(in crate::scene) fn material(&self, k: usize) -> usize {
        self.materials.place(k)
    }
}

impl PartialEq for BondList {
    /// Whether the bonds say the same, one by one.
    fn eq(&self, other: &Self) -> bool {
        self.iter().eq(other.iter())
    }
}

impl Extend<BondKeys> for BondList {
    fn extend<I: IntoIterator<Item = BondKeys>>(&mut self, bonds: I) {
        bonds.into_iter().for_each(|bond| self.push(bond));
    }
}

impl FromIterator<BondKeys> for BondList {
    fn from_iter<I: IntoIterator<Item = BondKeys>>(bonds: I) -> Self {
        let mut list = BondList::new();
        list.extend(bonds);
        list
    }
}

impl From<Vec<BondKeys>> for BondList {
    fn from(bonds: Vec<BondKeys>) -> Self {
        bonds.into_iter().collect()
    }
}

impl<'de> Deserialize<'de> for BondList {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        struct List;

        impl<'de> Visitor<'de> for List {
            type Value = BondList;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a sequence")
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<BondList, A::Error> {
                let mut bonds = BondList::new();
                while let Some(bond) = list.next_element()? {
                    bonds.push(bond);
                }
                Ok(bonds)
            }
        }

        from.deserialize_seq(List)
    }
}

impl Serialize for BondList {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.collect_seq(self.iter())
    }
}

impl JsonSchema for BondList {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        Vec::<BondKeys>::schema_name()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        Vec::<BondKeys>::json_schema(generator)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;
    use crate::scene::keys::{KindName, LimitName};

    fn various() -> Vec<BondKeys> {
        let plain = BondKeys::new(0, 1);
        vec![
            plain,
            BondKeys { rest: Some(0.0), ..plain },
            BondKeys { kind: Some(KindName::Rigid), a: 5, ..plain },
            BondKeys { kind: Some(KindName::Spring), stiffness: Some(0.0), rest: Some(2.5), ..plain },
            BondKeys { kind: Some(KindName::Spring), compliance: Some(0.0), ..plain },
            BondKeys { limit: Some(LimitName::Both), ..plain },
            BondKeys { break_strain: Some(0.5), b: 7, ..plain },
            plain,
        ]
    }

    #[test]
    fn what_goes_in_comes_out_and_through_a_text() {
        let list = BondList::from(various());
        assert_eq!(list.iter().collect::<Vec<_>>(), various());
        assert_eq!(list.materials().len(), 6);
        let text = serde_json::to_string(&list).unwrap();
        assert_eq!(text, serde_json::to_string(&various()).unwrap());
        assert_eq!(serde_json::from_str::<BondList>(&text).unwrap(), list);
    }

    #[test]
    fn no_number_is_taken_for_a_length_that_is_not_said() {
        let list: BondList = [BondKeys { rest: Some(UNSAID), ..BondKeys::new(0, 1) }].into_iter().collect();
        assert!(list.get(0).rest.unwrap().is_nan());
    }
}
