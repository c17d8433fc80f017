//! The key `budget` of a method: a number, or the word "none".

use std::fmt;

use serde::de::{Deserialize, Deserializer, Error, Visitor};
use serde::{Serialize, Serializer};

/// The word for no budget.
const NONE: &str = "none";

/// Counted work that a frame of 1/60 s may take until islands are handed over to the live step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BudgetKeys {
    /// As much as it takes: nothing is ever handed over.
    None,
    /// Milliseconds, > 0.
    Ms(f64),
}

impl BudgetKeys {
    /// The milliseconds; `None`: as many as it takes.
    pub fn ms(self) -> Option<f64> {
        match self {
            BudgetKeys::None => None,
            BudgetKeys::Ms(ms) => Some(ms),
        }
    }
}

impl std::str::FromStr for BudgetKeys {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text.parse() {
            _ if text == NONE => Ok(BudgetKeys::None),
            Ok(ms) if ms > 0.0 && f64::is_finite(ms) => Ok(BudgetKeys::Ms(ms)),
            _ => Err(format!("`{text}` is no budget: give milliseconds above 0, or `none`")),
        }
    }
}

impl<'de> Deserialize<'de> for BudgetKeys {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        struct Form;

        impl Visitor<'_> for Form {
            type Value = BudgetKeys;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("milliseconds of counted work, or \"none\"")
            }

            fn visit_f64<E>(self, ms: f64) -> Result<BudgetKeys, E> {
                Ok(BudgetKeys::Ms(ms))
            }

            fn visit_u64<E>(self, ms: u64) -> Result<BudgetKeys, E> {
                Ok(BudgetKeys::Ms(ms as f64))
            }

            fn visit_i64<E>(self, ms: i64) -> Result<BudgetKeys, E> {
                Ok(BudgetKeys::Ms(ms as f64))
            }

            fn visit_str<E: Error>(self, text: &str) -> Result<BudgetKeys, E> {
                match text {
                    NONE => Ok(BudgetKeys::None),
                    _ => Err(E::custom(format!("`{text}` is no budget: give milliseconds, or \"{NONE}\""))),
                }
            }
        }

        from.deserialize_any(Form)
    }
}

impl Serialize for BudgetKeys {
    fn serialize<T: Serializer>(&self, to: T) -> Result<T::Ok, T::Error> {
        match self {
            BudgetKeys::None => to.serialize_str(NONE),
            BudgetKeys::Ms(ms) => to.serialize_f64(*ms),
        }
    }
}

impl schemars::JsonSchema for BudgetKeys {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "BudgetKeys".into()
    }

    fn json_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
        schemars::json_schema!({ "anyOf": [{ "type": "number" }, { "type": "string", "enum": [NONE] }] })
    }
}
