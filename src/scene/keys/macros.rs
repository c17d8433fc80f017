//! How the objects and names of the file are declared: once, for reading, writing, checking and the JSON Schema.

/// Declares an object of the file: its keys, and how each may be missing.
///
/// `required` keys must be there, `optional` ones become `Option`s, `lists` are empty where they are missing, `beside`
/// takes fields as they stand (these three may repeat, for the order in which keys are written). Unknown and repeated
/// keys, `null` and arrays in place of the object are refused (derived code alone would take the last two).
macro_rules! object {
    (
        $(#[$meta:meta])*
        $name:ident: $expecting:literal {
            $(required { $( $(#[$rmeta:meta])* $rkey:ident: $rtype:ty, )* })?
            $(
                optional { $( $(#[$ometa:meta])* $okey:ident: $otype:ty, )* }
                $(lists { $( $(#[$lmeta:meta])* $lkey:ident: $ltype:ty, )* })?
                $(beside { $( $(#[$bmeta:meta])* $bkey:ident: $btype:ty, )* })?
            )*
        }
    ) => {
        $(#[$meta])*
        #[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
        #[serde(remote = "Self", deny_unknown_fields, expecting = $expecting)]
        pub struct $name {
            $($( $(#[$rmeta])* pub $rkey: $rtype, )*)?
            $(
                $(
                    $(#[$ometa])*
                    #[serde(
                        default,
                        deserialize_with = "crate::scene::present",
                        skip_serializing_if = "Option::is_none"
                    )]
                    pub $okey: Option<$otype>,
                )*
                $($(
                    $(#[$lmeta])*
                    #[serde(default, skip_serializing_if = "Vec::is_empty")]
                    pub $lkey: Vec<$ltype>,
                )*)?
                $($( $(#[$bmeta])* pub $bkey: $btype, )*)?
            )*
        }

        impl<'de> serde::Deserialize<'de> for $name {
            fn deserialize<T: serde::Deserializer<'de>>(from: T) -> Result<Self, T::Error> {
                $name::deserialize(crate::scene::ObjectOnly(from))
            }
        }

        impl serde::Serialize for $name {
            fn serialize<T: serde::Serializer>(&self, to: T) -> Result<T::Ok, T::Error> {
                $name::serialize(self, to)
            }
        }

        impl $name {
            /// The optional keys that are there, in the order of the specification.
            #[allow(dead_code, reason = "only objects whose keys exclude each other ask")]
            pub(crate) fn given(&self) -> impl Iterator<Item = &'static str> {
                [$($( (stringify!($okey), self.$okey.is_some()), )*)*]
                    .into_iter()
                    .filter(|(_, given)| *given)
                    .map(|(key, _): (&str, _)| key.trim_start_matches("r#"))
            }
        }
    };
}

/// Declares a set of names that stand as a string in the file and on the command line.
macro_rules! names {
    (
        $(#[$meta:meta])*
        $name:ident: $what:literal {
            $( $(#[$vmeta:meta])* $variant:ident = $text:literal, )*
        }
    ) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum $name {
            $( $(#[$vmeta])* $variant, )*
        }

        impl $name {
            /// All names, in the order of the specification.
            pub const NAMES: &'static [&'static str] = &[$($text),*];

            /// The name as it is written.
            pub fn name(self) -> &'static str {
                match self {
                    $( $name::$variant => $text, )*
                }
            }
        }

        impl std::str::FromStr for $name {
            type Err = String;

            fn from_str(text: &str) -> Result<Self, String> {
                match text {
                    $( $text => Ok($name::$variant), )*
                    _ => Err(crate::scene::nearest::unknown($what, text, Self::NAMES)),
                }
            }
        }

        impl std::fmt::Display for $name {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str(self.name())
            }
        }

        impl<'de> serde::Deserialize<'de> for $name {
            fn deserialize<T: serde::Deserializer<'de>>(from: T) -> Result<Self, T::Error> {
                from.deserialize_str(crate::scene::keys::Name::new(concat!("the name of ", $what)))
            }
        }

        impl serde::Serialize for $name {
            fn serialize<T: serde::Serializer>(&self, to: T) -> Result<T::Ok, T::Error> {
                to.serialize_str(self.name())
            }
        }

        impl schemars::JsonSchema for $name {
            fn schema_name() -> std::borrow::Cow<'static, str> {
                stringify!($name).into()
            }

            fn json_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
                schemars::json_schema!({ "type": "string", "enum": Self::NAMES })
            }
        }
    };
}

pub(crate) use {names, object};
