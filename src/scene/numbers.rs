//! Vectors and lists of masses as a scene file writes them.

use std::fmt;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::error::Problem;

/// Two numbers in the plane, three in space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vector {
    components: [f64; 3],
    dimensions: u8,
}

impl Vector {
    /// The vector of a scene in `dimensions` (2 or 3); a third component is dropped in the plane.
    pub fn new(components: [f64; 3], dimensions: usize) -> Self {
        Vector { components, dimensions: dimensions.clamp(2, 3) as u8 }
    }

    /// Its components, if it has as many as the scene has dimensions and all are finite; z = 0 in the plane.
    pub(crate) fn components(&self, dimensions: usize) -> Result<[f64; 3], Problem> {
        if usize::from(self.dimensions) != dimensions {
            let problem =
                format!("has {} numbers: a scene in {dimensions} dimensions needs {dimensions}", self.dimensions);
            return Err(Problem::new("", problem));
        }
        if !self.components.iter().all(|c| c.is_finite()) {
            return Err(Problem::new("", "has a number that is not finite"));
        }
        Ok(self.components)
    }
}

impl Serialize for Vector {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.components[..usize::from(self.dimensions)].serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Vector {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Components;

        impl<'de> Visitor<'de> for Components {
            type Value = Vector;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, "a vector of 2 numbers, in space of 3")
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Vector, A::Error> {
                let mut components = [0.0; 3];
                let mut count = 0;
                while let Some(value) = list.next_element::<f64>()? {
                    if count == 3 {
                        return Err(serde::de::Error::invalid_length(4, &self));
                    }
                    components[count] = value;
                    count += 1;
                }
                if count < 2 {
                    return Err(serde::de::Error::invalid_length(count, &self));
                }
                Ok(Vector { components, dimensions: count as u8 })
            }
        }

        deserializer.deserialize_seq(Components)
    }
}

impl JsonSchema for Vector {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Vector".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": "array", "items": { "type": "number" }, "minItems": 2, "maxItems": 3 })
    }
}

/// One mass for all points, or one a point [kg].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "a mass in kg, or a list with one for every point")]
pub enum Masses {
    /// For all.
    All(f64),
    /// One a point.
    Each(Vec<f64>),
}
