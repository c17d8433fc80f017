//! The keys of how bodies meet.

use std::fmt;

use serde::de::value::MapAccessDeserializer;
use serde::de::{Deserialize, Deserializer, MapAccess, Visitor};

use super::color::ColorKey;
use super::macros::object;
use crate::sim::Contact;

object! {
    /// How bodies meet.
    #[derive(Default, Copy)]
    ContactKeys: "contact: true, or an object with keys such as `friction`" {
        optional {
            /// Between two skins `[1]`, >= 0: 0.5 if not said.
            friction: f64,
            /// Between two skins `[1]`, from 0 to 1: 0 if not said.
            restitution: f64,
            /// What a skin keeps from the middle of its edges `[m]`, >= 0: 0.05 of the mean edge of each skin, or of its body's thickness where that is less, if not said.
            radius: f64,
            /// Whether bodies meet themselves: true if not said.
            #[serde(rename = "self")]
            with_itself: bool,
            /// Whether bodies meet each other: true if not said.
            bodies: bool,
        }
    }
}

object! {
    /// What the skins of points are made of, where it is not as `contact` says. Between two skins friction is the root of the product of both,
    /// restitution the larger one, and radii add up.
    #[derive(Default)]
    SkinKeys: "a skin: an object with the key `points`" {
        required {
            /// The points, counted over the scene.
            points: Vec<u32>,
        }
        optional {
            /// `[1]`, >= 0.
            friction: f64,
            /// `[1]`, from 0 to 1.
            restitution: f64,
            /// `[m]`, >= 0.
            radius: f64,
            /// Whether they are of layers that pass each other, where bodies meet themselves: false if not said.
            layered: bool,
            /// What they are filled in, and the picture is tinted by that is drawn on them: "#rrggbb"; one of a palette if not said.
            color: ColorKey,
            /// How wide their bonds are drawn `[m]`, >= 0; 0: as is usual.
            width: f64,
            /// Whether they are drawn.
            visible: bool,
        }
    }
}

/// Whether bodies meet, and how.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, schemars::JsonSchema)]
#[serde(untagged)]
pub enum Meeting {
    /// As nothing more is said, or not at all.
    Is(bool),
    /// As the keys say.
    As(ContactKeys),
}

impl<'de> Deserialize<'de> for Meeting {
    // Not derived: an untagged enum loses the place of a wrong key.
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        struct Form;

        impl<'de> Visitor<'de> for Form {
            type Value = Meeting;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("true, or an object with keys such as `friction`")
            }

            fn visit_bool<E>(self, is: bool) -> Result<Meeting, E> {
                Ok(Meeting::Is(is))
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Meeting, A::Error> {
                ContactKeys::deserialize(MapAccessDeserializer::new(map)).map(Meeting::As)
            }
        }

        from.deserialize_any(Form)
    }
}

impl From<Contact> for ContactKeys {
    fn from(contact: Contact) -> Self {
        ContactKeys {
            friction: Some(contact.friction),
            restitution: Some(contact.restitution),
            radius: contact.radius,
            with_itself: Some(contact.with_itself),
            bodies: Some(contact.with_others),
        }
    }
}

impl Meeting {
    /// The same in the engine's words; `None`: bodies do not meet.
    pub(crate) fn resolve(self) -> Option<Contact> {
        let usual = Contact::default();
        match self {
            Meeting::Is(is) => is.then_some(usual),
            Meeting::As(keys) => Some(Contact {
                friction: keys.friction.unwrap_or(usual.friction),
                restitution: keys.restitution.unwrap_or(usual.restitution),
                radius: keys.radius.or(usual.radius),
                with_itself: keys.with_itself.unwrap_or(usual.with_itself),
                with_others: keys.bodies.unwrap_or(usual.with_others),
            }),
        }
    }
}
