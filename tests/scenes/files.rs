//! Files, names and saving.

use std::fs;
use std::path::Path;

use wobble::scene::{Scene, SceneErrorKind, gallery};

fn refusal(path: &Path) -> String {
    let path = path.to_str().unwrap();
    let error = Scene::load(path).unwrap_err().to_string();
    error.replace(path, "FILE")
}

#[test]
fn files_that_cannot_be_read_say_why() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str, bytes: &[u8]| {
        let path = folder.path().join(name);
        fs::write(&path, bytes).unwrap();
        path
    };
    assert_eq!(refusal(folder.path()), "FILE: is a directory: give a scene file in it, or the name of a gallery scene");
    let missing = folder.path().join("none.json");
    assert_eq!(refusal(&missing), "FILE: no such file: check the path");
    assert_eq!(refusal(&at("empty.json", b"")), "FILE: is empty: a scene starts with {\"wobble\": 1, …}");
    assert_eq!(
        refusal(&at("latin.json", b"{ \"wobble\": 1,\n\"name\": \"\xe9\" }")),
        "FILE:2: is not text in UTF-8 nor a picture: give a scene file in UTF-8, or a PNG, JPEG, GIF, BMP, WebP or TIFF"
    );
    assert_eq!(refusal(&at("wide.json", b"\xff\xfe{\0}\0")), "FILE: is UTF-16: save it as UTF-8");
    assert_eq!(
        refusal(&at("bom.json", "\u{feff}{\"wobble\":1}".as_bytes())),
        "FILE:1: starts with a byte order mark: save it as UTF-8 without one"
    );
}

#[test]
fn a_name_is_looked_up_in_the_gallery_and_a_slip_is_recognised() {
    assert_eq!(Scene::load("rim").unwrap().name(), "rim");
    let error = Scene::load("rimm").unwrap_err();
    assert_eq!(error.kind, SceneErrorKind::NotFound);
    assert_eq!(
        error.to_string(),
        "rimm: no file or gallery scene of this name: did you mean `rim`? `wobble scenes` lists them"
    );
    assert_eq!(
        Scene::load("zork").unwrap_err().to_string(),
        "zork: no file or gallery scene of this name: `wobble scenes` lists them"
    );
}

#[test]
fn a_scene_without_a_name_is_called_after_its_file() {
    let name = |label: &str| {
        let scene = Scene::parse("{ \"wobble\": 1 }", label).unwrap();
        scene.name().to_owned()
    };
    assert_eq!(name("some/where/B1_osc.scene.json"), "B1_osc");
    assert_eq!(name("v1.2.json"), "v1.2");
    assert_eq!(name(""), "scene");
    let named = Scene::parse("{ \"wobble\": 1, \"name\": \"n\" }", "x.json").unwrap();
    assert_eq!(named.name(), "n");
}

#[test]
fn a_saved_scene_is_whole_and_leaves_nothing_beside_it() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.json");
    for entry in gallery() {
        let scene = entry.scene().unwrap();
        scene.save(&path).unwrap();
        assert_eq!(Scene::read(&path).unwrap(), scene);
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
}

#[test]
fn a_scene_that_cannot_be_saved_leaves_the_old_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.json");
    fs::write(&path, "old").unwrap();
    let mut scene = Scene::load("points").unwrap();
    scene.drag_rate = Some(f64::NAN);
    let error = scene.save(&path).unwrap_err().to_string();
    assert_eq!(error, "points.json: drag_rate: is NaN: give a number of 0 or more");
    assert_eq!(fs::read_to_string(&path).unwrap(), "old");
    scene.drag_rate = None;
    let error = scene.save(folder.path()).unwrap_err().to_string();
    assert!(error.contains("cannot be written: is a directory"), "{error}");
    let nowhere = folder.path().join("none").join("scene.json");
    let error = scene.save(&nowhere).unwrap_err().to_string();
    assert!(error.contains("cannot be written"), "{error}");
}

#[cfg(unix)]
#[test]
fn a_saved_scene_keeps_the_files_permissions_and_follows_links() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let folder = tempfile::tempdir().unwrap();
    let (path, link) = (folder.path().join("scene.json"), folder.path().join("link.json"));
    fs::write(&path, "old").unwrap();
    fs::set_permissions(&path, fs::Permissions::from_mode(0o640)).unwrap();
    symlink(&path, &link).unwrap();
    Scene::load("rim").unwrap().save(&link).unwrap();
    assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
    assert_eq!(fs::metadata(&path).unwrap().permissions().mode() & 0o777, 0o640);
    assert_eq!(Scene::read(&path).unwrap().name(), "rim");
}
