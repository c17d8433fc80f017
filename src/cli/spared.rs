//! What a call reads is never written over by it.

use std::path::{Path, PathBuf};

/// Looks, before anything is written, whether a file to write to is one that is read, or is written to twice, by whatever names.
///
/// Errors: the first file that is.
pub(super) fn spare(read: &[&Path], written: &[&Path]) -> anyhow::Result<()> {
    let sources: Vec<PathBuf> = read.iter().filter_map(|path| std::fs::canonicalize(path).ok()).collect();
    let mut targets = Vec::new();
    for path in written {
        let Some(target) = real(path) else { continue };
        if sources.contains(&target) {
            anyhow::bail!("{}: is what is read, and would be lost: give another name to write to", path.display());
        }
        if targets.contains(&target) {
            anyhow::bail!("{}: would be written twice: give each its own name", path.display());
        }
        targets.push(target);
    }
    Ok(())
}

/// Where a file lies, or would lie if there were one; `None`: in no folder that there is.
fn real(path: &Path) -> Option<PathBuf> {
    std::fs::canonicalize(path).ok().or_else(|| {
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        Some(std::fs::canonicalize(folder).ok()?.join(path.file_name()?))
    })
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_the_same_by_any_name() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        std::fs::write(at("x.json"), b"{}").unwrap();
        std::fs::create_dir(at("in")).unwrap();
        let again = at("in/../x.json");
        let said = |read: &Path, written: &[&Path]| spare(&[read], written).map_err(|error| error.to_string());
        assert!(said(&at("x.json"), &[&again]).unwrap_err().contains("in/../x.json: is what is read"));
        assert!(said(&at("x.json"), &[&at("y.json"), &at("in/../y.json")]).unwrap_err().contains("twice"));
        said(&at("x.json"), &[&at("y.json"), &at("in/x.json")]).unwrap();
        said(Path::new("rim"), &[&at("rim.json")]).unwrap();
    }

    #[cfg(unix)]
    #[test]
    fn a_link_to_what_is_read_is_what_is_read() {
        let folder = tempfile::tempdir().unwrap();
        let [file, link] = ["x.json", "y.json"].map(|name| folder.path().join(name));
        std::fs::write(&file, b"{}").unwrap();
        std::os::unix::fs::symlink(&file, &link).unwrap();
        assert!(spare(&[&file], &[&link]).is_err());
        assert!(spare(&[&link], &[&file]).is_err());
    }
}
