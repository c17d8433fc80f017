//! Running states in files: compressed little-endian numbers in base64, layout 1.
//!
//! Every type says its fields once, in order; a field that comes or goes breaks the build here and needs another layout.

use std::io::{Read, Write};

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use flate2::Compression;
use flate2::read::ZlibDecoder;
use flate2::write::ZlibEncoder;
use serde_json::{Value, json};

use super::pack::Packed;
use crate::sim::{Dynamics, SavedWorld, resume};

/// How the numbers are laid out.
const LAYOUT: u64 = 1;

/// Largest state that is unpacked [bytes]: some bytes may unpack to any size.
const LARGEST: u64 = 4 << 30;

/// A running world as a file has it.
///
/// Errors: in words, why it cannot be kept.
pub(super) fn keep(world: &dyn Dynamics) -> Result<Value, String> {
    let saved = world.save().ok_or("a world of these dimensions cannot be kept")?;
    let mut bytes = Vec::new();
    saved.put(&mut bytes);
    let mut packed = ZlibEncoder::new(Vec::new(), Compression::default());
    let packed = packed.write_all(&bytes).and_then(|()| packed.finish()).map_err(|error| error.to_string())?;
    let version = env!("CARGO_PKG_VERSION");
    Ok(json!({ "wobble": version, "layout": LAYOUT, "data": BASE64_STANDARD.encode(packed) }))
}

/// The world of a file goes on.
///
/// Errors: in words, what of it is damaged or unknown.
pub(super) fn go_on(state: &Value) -> Result<Box<dyn Dynamics>, String> {
    let layout = state.get("layout").and_then(Value::as_u64).ok_or("state: the key `layout` is missing")?;
    if layout != LAYOUT {
        let message = format!("state: has layout {layout}: this program reads layout {LAYOUT}, so get a newer wobble");
        return Err(message);
    }
    let data = state.get("data").and_then(Value::as_str).ok_or("state: the key `data` is missing")?;
    let damaged = |_| "state: is damaged: get the file anew".to_owned();
    let packed = BASE64_STANDARD.decode(data).map_err(|error| damaged(error.to_string()))?;
    let mut bytes = Vec::new();
    let unpacked = ZlibDecoder::new(&packed[..]).take(LARGEST).read_to_end(&mut bytes);
    unpacked.map_err(|error| damaged(error.to_string()))?;
    let mut rest = &bytes[..];
    let saved = SavedWorld::take(&mut rest).filter(|_| rest.is_empty()).ok_or_else(|| damaged(String::new()))?;
    resume(&saved).map_err(|error| format!("state: {error}"))
}
