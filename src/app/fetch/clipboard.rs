//! What lies on the clipboard: a file, a picture, or the path of one.

use std::path::{Path, PathBuf};

use arboard::{Clipboard, Error, ImageData};

use super::{Fetch, Found};
use crate::picture::{Picture, PictureError};
use crate::scene::Fragment;

/// What is said where there is nothing of use.
const EMPTY: &str = "there is no picture on the clipboard, and no bodies: copy some, or a picture file, or its path";

/// What lies on the clipboard after more bodies were copied than a text has: they themselves stay in the program.
const COPIED: &str = "bodies copied in a window of wobble: paste them there";

/// Puts bodies on the clipboard as text, for any program. Those that are too many for a text stay in this one: the clipboard is told so, or
/// an older picture would be pasted in their place. Where there is no clipboard there is none to be pasted either.
pub(in crate::app) fn copy(fragment: Fragment) {
    std::thread::spawn(move || {
        let text = fragment.to_text().unwrap_or_else(|| COPIED.to_owned());
        drop(fragment);
        let Ok(mut clipboard) = Clipboard::new() else { return };
        let set = clipboard.set();
        // Some systems ask for it when it is pasted: it is there until something else is copied.
        #[cfg(all(unix, not(target_os = "macos")))]
        let set = arboard::SetExtLinux::wait(set);
        // What cannot be written is not pasted either.
        let _ = set.text(text);
    });
}

/// Looks what lies on the clipboard.
///
/// Errors: nothing that is a picture or names a file; a picture that is too large or damaged; no clipboard.
pub(in crate::app) fn paste(wake: impl Fn() + Send + 'static) -> Fetch {
    Fetch::new(wake, || {
        let mut clipboard = Clipboard::new().map_err(|error| format!("the clipboard cannot be read: {error}"))?;
        // Files come first: where one is copied, some systems add a picture of its icon.
        let files = clipboard.get().file_list().unwrap_or_default();
        if let Some(file) = files.into_iter().find(|file| file.is_file()) {
            return Ok(Found::File(file));
        }
        match clipboard.get_image() {
            Ok(image) => return picture(image).map(Found::Picture).map_err(|error| error.to_string()),
            Err(Error::ConversionFailure) => return Err("the picture on the clipboard cannot be read".to_owned()),
            Err(_) => {}
        }
        let text = clipboard.get_text().unwrap_or_default();
        if text.trim() == COPIED {
            return Ok(Found::Copied);
        }
        if Fragment::is_one(&text) {
            let read = Fragment::parse(&text);
            return Ok(read.map_or_else(Found::Broken, |fragment| Found::Bodies(Box::new(fragment))));
        }
        let path = path(&text).ok_or_else(|| EMPTY.to_owned())?;
        if path.is_file() { Ok(Found::File(path)) } else { Err(no_file(&path)) }
    })
}

/// What is said of text that names no file: of a path that there is none, of anything else that it is no picture.
fn no_file(path: &Path) -> String {
    let is_path = path.is_absolute() || path.extension().is_some() && path.components().count() > 1;
    if is_path { format!("`{}` on the clipboard is no file: check the path", path.display()) } else { EMPTY.to_owned() }
}

/// Errors: no pixels; too many.
fn picture(image: ImageData<'_>) -> Result<Picture, PictureError> {
    let side = |length: usize| u32::try_from(length).unwrap_or(u32::MAX);
    Picture::new(side(image.width), side(image.height), image.bytes.into_owned())
}

/// The path that a text of one line is, as such or as a file's address.
fn path(text: &str) -> Option<PathBuf> {
    let line = text.trim();
    if line.is_empty() || line.lines().count() > 1 {
        return None;
    }
    match line.strip_prefix("file://") {
        Some(address) => decoded(address).map(PathBuf::from),
        None => Some(Path::new(line.trim_matches('"')).to_owned()),
    }
}

/// An address with its %20 and the like as the characters that they stand for; `None` if they make no text.
fn decoded(address: &str) -> Option<String> {
    let mut bytes = Vec::with_capacity(address.len());
    let mut rest = address.as_bytes();
    while let Some((&first, after)) = rest.split_first() {
        let digits = after.get(..2).filter(|_| first == b'%').and_then(|digits| std::str::from_utf8(digits).ok());
        let byte = digits.and_then(|digits| u8::from_str_radix(digits, 16).ok());
        bytes.push(byte.unwrap_or(first));
        rest = if byte.is_some() { &after[2..] } else { after };
    }
    String::from_utf8(bytes).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_is_one_line_as_it_stands_or_an_address() {
        for (text, meant) in [
            ("/tmp/a b.png\n", Some("/tmp/a b.png")),
            ("\"C:\\x.png\"", Some("C:\\x.png")),
            ("file:///tmp/a%20b%C3%A9.png", Some("/tmp/a bé.png")),
            ("file:///tmp/100%.png", Some("/tmp/100%.png")),
            ("file:///tmp/%ff.png", None),
            ("two\nlines", None),
            (" \n", None),
        ] {
            assert_eq!(path(text), meant.map(PathBuf::from), "{text}");
        }
    }

    #[test]
    fn what_is_said_of_text_depends_on_whether_it_is_a_path() {
        assert!(no_file(Path::new("/tmp/none.png")).contains("`/tmp/none.png`"));
        assert!(no_file(Path::new("pictures/none.png")).contains("no file"));
        assert_eq!(no_file(Path::new("hello there")), EMPTY);
        assert_eq!(no_file(Path::new("Mr. Smith")), EMPTY);
    }

    #[test]
    fn pictures_of_bad_sizes_are_refused_in_the_usual_words() {
        let of = |width, height, bytes: usize| picture(ImageData { width, height, bytes: vec![0; bytes].into() });
        assert_eq!(of(0, 3, 0), Err(PictureError::NoPixels { width: 0, height: 3 }));
        assert!(matches!(of(16_385, 1, 4 * 16_385), Err(PictureError::TooLarge { width: 16_385, .. })));
        assert!(matches!(of(usize::MAX, 1, 0), Err(PictureError::TooLarge { .. })));
        assert!(matches!(of(2, 2, 15), Err(PictureError::Damaged { .. })));
        assert_eq!(of(2, 1, 8).map(|picture| picture.rgba.len()), Ok(8));
    }
}
