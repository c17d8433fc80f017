//! Files whole in memory.

use std::fs::{File, Metadata};
use std::io::{ErrorKind, Read};
use std::path::Path;

/// The bytes of a file.
///
/// Errors, as what follows the file's name on the line: it is not there or may not be read; it is no file but a folder, a
/// pipe or a device, which might never end; it has more than `most` bytes, whatever it says of itself.
pub(super) fn file_bytes(path: &Path, most: u64) -> Result<Vec<u8>, String> {
    bytes(path, most, |_| false)
}

/// The same of a scene, which may come from a pipe: one that bears no name, or a scene's.
pub(super) fn scene_bytes(path: &Path, most: u64) -> Result<Vec<u8>, String> {
    bytes(path, most, |about| is_pipe(about) && path.extension().is_none_or(|ending| ending == "json"))
}

#[cfg(unix)]
fn is_pipe(about: &Metadata) -> bool {
    std::os::unix::fs::FileTypeExt::is_fifo(&about.file_type())
}

#[cfg(not(unix))]
fn is_pipe(_: &Metadata) -> bool {
    false
}

fn bytes(path: &Path, most: u64, is_stream: impl Fn(&Metadata) -> bool) -> Result<Vec<u8>, String> {
    let unread = |error: std::io::Error| match error.kind() {
        ErrorKind::NotFound => "cannot be found: check the path".to_owned(),
        ErrorKind::PermissionDenied => "may not be read: change its permissions".to_owned(),
        // The system's words, without its number of them.
        _ => format!("cannot be read: {}", error.to_string().split(" (os error").next().unwrap_or_default()),
    };
    // Opening a pipe would already wait for its writer.
    let about = std::fs::metadata(path).map_err(unread)?;
    if about.is_dir() {
        return Err("is a directory: name a file in it".to_owned());
    }
    if !about.is_file() && !is_stream(&about) {
        return Err("is no regular file but a pipe or a device: save what comes from it in a file".to_owned());
    }
    let mut bytes = Vec::with_capacity(usize::try_from(about.len().min(most)).unwrap_or(0));
    File::open(path).and_then(|file| file.take(most + 1).read_to_end(&mut bytes)).map_err(unread)?;
    if bytes.len() as u64 > most {
        return Err(format!("is larger than {} MiB: make it smaller", most >> 20));
    }
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_files_of_a_size_are_read() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("ten");
        std::fs::write(&path, [7; 10]).unwrap();
        assert_eq!(file_bytes(&path, 10), Ok(vec![7; 10]));
        assert!(file_bytes(&path, 9).unwrap_err().starts_with("is larger than"));
        assert!(file_bytes(folder.path(), 10).unwrap_err().starts_with("is a directory"));
        assert!(file_bytes(&folder.path().join("none"), 10).unwrap_err().starts_with("cannot be found"));
        if cfg!(unix) {
            assert!(file_bytes(Path::new("/dev/zero"), 10).unwrap_err().starts_with("is no regular file"));
        }
    }
}
