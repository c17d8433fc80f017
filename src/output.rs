//! Files that are written whole or not at all.

use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// A file that could not be written; what stood there before is untouched.
#[derive(Debug, thiserror::Error)]
#[error("{}: cannot be written: {reason}", path.display())]
pub struct OutputError {
    /// The file.
    path: PathBuf,
    /// Why, and what to do.
    reason: String,
}

/// Held while a file is written.
static WRITING: Mutex<()> = Mutex::new(());
/// Held while files that belong together are written.
static TOGETHER: Mutex<()> = Mutex::new(());

fn wait(lock: &'static Mutex<()>) -> MutexGuard<'static, ()> {
    lock.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Waits until the file that is being written is whole, and those that belong to it; while what is returned lives, none is begun.
/// For a program that is about to end.
pub fn pause() -> [MutexGuard<'static, ()>; 2] {
    // In the order in which those who write take them.
    [wait(&TOGETHER), wait(&WRITING)]
}

/// While what is returned lives, [`pause`] waits: files that belong together are written all or none.
pub fn together() -> MutexGuard<'static, ()> {
    wait(&TOGETHER)
}

/// Whether files can be made in a folder, by making one and taking it away again.
///
/// Errors: there is no such folder, or none can be made in it.
pub fn probe(folder: &Path) -> Result<(), OutputError> {
    let _writing = wait(&WRITING);
    let made = tempfile::Builder::new().prefix(".wobble-").tempfile_in(folder).map_err(|error| plain(&error, folder));
    made.map(drop).map_err(|error| OutputError { path: folder.to_owned(), reason: error.to_string() })
}

/// Writes a file beside `path` and renames it to `path` when all of it is on the disk.
///
/// Errors: whatever `write` or the file system answers; an older file at `path` then stays as it was.
pub fn replace(path: &Path, write: impl FnOnce(&mut dyn Write) -> std::io::Result<()>) -> Result<(), OutputError> {
    let _writing = wait(&WRITING);
    let attempt = || {
        // Through a link the file behind it is meant; a rename would put a file in the link's place.
        let target = std::fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
        let folder = match target.parent() {
            Some(folder) if !folder.as_os_str().is_empty() => folder,
            _ => Path::new("."),
        };
        if !folder.is_dir() {
            return Err(std::io::Error::other(format!("there is no folder {}: make it first", folder.display())));
        }
        if target.is_dir() {
            return Err(std::io::Error::from(std::io::ErrorKind::IsADirectory));
        }
        let mut builder = tempfile::Builder::new();
        builder.prefix(".wobble-");
        // As any new file, for all whom the user's mask allows; a temporary file alone would be private.
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        let mut file = builder.tempfile_in(folder).map_err(|error| plain(&error, folder))?;
        let mut buffer = BufWriter::new(file.as_file_mut());
        write(&mut buffer)?;
        buffer.flush()?;
        drop(buffer);
        if let Ok(old) = std::fs::metadata(&target) {
            file.as_file().set_permissions(old.permissions())?;
        }
        file.as_file().sync_all()?;
        file.persist(&target).map_err(|error| error.error)?;
        Ok(())
    };
    attempt().map_err(|error| OutputError { path: path.to_owned(), reason: error.to_string() })
}

/// Why no file can be made in a folder, without the name of the one that was tried.
fn plain(error: &std::io::Error, folder: &Path) -> std::io::Error {
    match error.kind() {
        std::io::ErrorKind::PermissionDenied => {
            std::io::Error::other(format!("no file may be made in {}: name another folder", folder.display()))
        }
        kind => std::io::Error::from(kind),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_failed_write_leaves_the_old_file_and_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("x.json");
        replace(&path, |w| w.write_all(b"old")).unwrap();
        let failed = replace(&path, |w| {
            w.write_all(b"half of the ne")?;
            Err(std::io::Error::from(std::io::ErrorKind::StorageFull))
        });
        assert!(failed.unwrap_err().to_string().contains("x.json: cannot be written"));
        assert_eq!(std::fs::read(&path).unwrap(), b"old");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn a_probe_leaves_nothing_and_says_where_no_file_can_be_made() {
        let folder = tempfile::tempdir().unwrap();
        probe(folder.path()).unwrap();
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
        let error = probe(&folder.path().join("none")).unwrap_err().to_string();
        assert!(error.contains("none: cannot be written"), "{error}");
    }

    #[test]
    fn a_folder_that_does_not_exist_is_named() {
        let error = replace(Path::new("/no/such/folder/x.png"), |w| w.write_all(b"")).unwrap_err();
        assert!(error.to_string().starts_with("/no/such/folder/x.png: cannot be written"), "{error}");
    }
}
