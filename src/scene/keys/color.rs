//! Colours as a file writes them.

use std::fmt;
use std::str::FromStr;

/// A colour in sRGB: `#` and six hexadecimal digits, red, green and blue.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ColorKey(pub [u8; 3]);

impl FromStr for ColorKey {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let digits = text.strip_prefix('#').filter(|digits| digits.len() == 6);
        let digits = digits.filter(|digits| digits.bytes().all(|byte| byte.is_ascii_hexdigit()));
        let number = digits.and_then(|digits| u32::from_str_radix(digits, 16).ok());
        let number = number.ok_or_else(|| {
            format!("`{text}` is no colour: write # and six hexadecimal digits, as in \"#ff8800\" for orange")
        })?;
        let [_, red, green, blue] = number.to_be_bytes();
        Ok(ColorKey([red, green, blue]))
    }
}

impl fmt::Display for ColorKey {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [red, green, blue] = self.0;
        write!(f, "#{red:02x}{green:02x}{blue:02x}")
    }
}

impl<'de> serde::Deserialize<'de> for ColorKey {
    fn deserialize<T: serde::Deserializer<'de>>(from: T) -> Result<Self, T::Error> {
        from.deserialize_str(super::Name::new("a colour such as \"#ff8800\""))
    }
}

impl serde::Serialize for ColorKey {
    fn serialize<T: serde::Serializer>(&self, to: T) -> Result<T::Ok, T::Error> {
        to.collect_str(self)
    }
}

impl schemars::JsonSchema for ColorKey {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "ColorKey".into()
    }

    fn json_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
        schemars::json_schema!({ "type": "string", "pattern": "^#[0-9a-fA-F]{6}$" })
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;

    #[test]
    fn colours_are_read_as_they_are_written_and_others_are_refused() {
        let color: ColorKey = "#fF8801".parse().unwrap();
        assert_eq!((color.0, color.to_string()), ([255, 136, 1], "#ff8801".to_owned()));
        for text in ["ff8801", "#ff880", "#ff88011", "#gg8801", "#+f8801", "orange", ""] {
            assert!(text.parse::<ColorKey>().unwrap_err().contains("six hexadecimal digits"), "{text}");
        }
    }
}
