//! Vectors of the file, two numbers in the plane and three in space, and other short lists of a fixed length.

use std::borrow::Cow;
use std::fmt;
use std::marker::PhantomData;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{Deserialize, Deserializer, Error, SeqAccess, Visitor};
use serde::ser::{Serialize, Serializer};

/// Two numbers in the plane, three in space, as the file has them; which of them it must be is checked once the
/// dimensions are known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Vector {
    /// x, y.
    Plane([f64; 2]),
    /// x, y, z.
    Space([f64; 3]),
}

impl Vector {
    /// The vector of a scene with `dimensions` dimensions: a plane drops z.
    pub fn new(components: [f64; 3], dimensions: usize) -> Self {
        let [x, y, _] = components;
        if dimensions == 2 { Vector::Plane([x, y]) } else { Vector::Space(components) }
    }

    /// Its numbers.
    pub fn components(&self) -> &[f64] {
        match self {
            Vector::Plane(v) => v,
            Vector::Space(v) => v,
        }
    }

    /// Three components, z = 0 in the plane.
    pub fn embed(&self) -> [f64; 3] {
        match *self {
            Vector::Plane([x, y]) => [x, y, 0.0],
            Vector::Space(v) => v,
        }
    }
}

impl<'de> Deserialize<'de> for Vector {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        struct Numbers;

        impl<'de> Visitor<'de> for Numbers {
            type Value = Vector;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a vector: [x, y], in space [x, y, z]")
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Vector, A::Error> {
                let mut numbers = [0.0; 3];
                let mut count = 0;
                while let Some(number) = list.next_element()? {
                    if count == 3 {
                        return Err(Error::invalid_length(4, &self));
                    }
                    numbers[count] = number;
                    count += 1;
                }
                match count {
                    2 => Ok(Vector::Plane([numbers[0], numbers[1]])),
                    3 => Ok(Vector::Space(numbers)),
                    _ => Err(Error::invalid_length(count, &self)),
                }
            }
        }

        from.deserialize_seq(Numbers)
    }
}

impl Serialize for Vector {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        self.components().serialize(to)
    }
}

impl JsonSchema for Vector {
    fn schema_name() -> Cow<'static, str> {
        "Vector".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "Two numbers; three in space.",
            "type": "array",
            "items": { "type": "number" },
            "minItems": 2,
            "maxItems": 3
        })
    }
}

/// A list of exactly `N` numbers.
///
/// An array would do but for its errors: one item too many is reported as broken JSON.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Row<T, const N: usize>(pub [T; N]);

impl<'de, T: Deserialize<'de> + Copy + Default, const N: usize> Deserialize<'de> for Row<T, N> {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        struct Items<T, const N: usize>(PhantomData<T>);

        impl<'de, T: Deserialize<'de> + Copy + Default, const N: usize> Visitor<'de> for Items<T, N> {
            type Value = Row<T, N>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, "a list of {N} numbers")
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Row<T, N>, A::Error> {
                let mut items = [T::default(); N];
                let mut count = 0;
                while let Some(item) = list.next_element()? {
                    if count == N {
                        return Err(Error::invalid_length(N + 1, &self));
                    }
                    items[count] = item;
                    count += 1;
                }
                if count < N {
                    return Err(Error::invalid_length(count, &self));
                }
                Ok(Row(items))
            }
        }

        from.deserialize_seq(Items(PhantomData))
    }
}

impl<T: Serialize, const N: usize> Serialize for Row<T, N> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        self.0.as_slice().serialize(to)
    }
}

impl<T: JsonSchema, const N: usize> JsonSchema for Row<T, N> {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        format!("{}_{N}", T::schema_name()).into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let item = generator.subschema_for::<T>();
        json_schema!({ "type": "array", "items": item, "minItems": N, "maxItems": N })
    }
}
