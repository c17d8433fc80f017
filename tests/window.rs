//! The real window under a virtual display, moved through by synthetic mouse events.
#![cfg(unix)]
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test that cannot go on stops")]

mod common;

use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use image::RgbaImage;

/// A virtual display of its own.
struct Display {
    server: Child,
    name: String,
    /// Where its programs keep what is to outlive them.
    state: tempfile::TempDir,
}

impl Drop for Display {
    fn drop(&mut self) {
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}

impl Display {
    /// Starts one, or says why the test is skipped.
    fn start() -> Option<Self> {
        for tool in ["Xvfb", "xdotool", "import"] {
            let found = Command::new("sh").args(["-c", &format!("command -v {tool}")]).output().unwrap();
            if !found.status.success() {
                common::skip("window", &format!("{tool} is not installed"));
                return None;
            }
        }
        common::gpu()?;
        // The server picks a free display and writes its number to standard output. It would put the pointer back into
        // the middle whenever its last client leaves. Keys do not repeat: on a busy machine one stroke would be several.
        let mut server = Command::new("Xvfb")
            .args(["-displayfd", "1", "-screen", "0", "1280x800x24", "-nolisten", "tcp", "-noreset", "-r"])
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let mut number = String::new();
        BufReader::new(server.stdout.take().unwrap()).read_line(&mut number).unwrap();
        let display = Display { server, name: format!(":{}", number.trim()), state: tempfile::tempdir().unwrap() };
        // Out of every window's way until a test wants it.
        display.xdotool(&["mousemove", "1279", "799"]);
        Some(display)
    }

    fn command(&self, program: impl AsRef<std::ffi::OsStr>) -> Command {
        let mut command = Command::new(program);
        command.env("DISPLAY", &self.name).env("WOBBLE_STATE_DIR", self.state.path());
        command.env_remove("WAYLAND_DISPLAY").env_remove("WAYLAND_SOCKET");
        command
    }

    fn xdotool(&self, arguments: &[&str]) -> String {
        let done = self.command("xdotool").args(arguments).output().unwrap();
        String::from_utf8(done.stdout).unwrap().trim().to_owned()
    }

    fn screenshot(&self) -> RgbaImage {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("x.png");
        let done = self.command("import").args(["-window", "root"]).arg(&path).status().unwrap();
        assert!(done.success());
        image::open(path).unwrap().to_rgba8()
    }

    fn open(&self, scene: &Path) -> App<'_> {
        self.open_with(scene, None)
    }

    /// Opens a scene where programs are looked for in `programs`, if it is given, and no portal is there.
    fn open_with(&self, scene: &Path, programs: Option<&Path>) -> App<'_> {
        self.open_recorded(scene, programs, None)
    }

    /// The same, recorded to a file.
    fn open_recorded(&self, scene: &Path, programs: Option<&Path>, record: Option<&Path>) -> App<'_> {
        let mut command = self.command(env!("CARGO_BIN_EXE_wobble"));
        if let Some(record) = record {
            command.arg("--record").arg(record);
        }
        command.env("DBUS_SESSION_BUS_ADDRESS", "unix:path=/nowhere");
        if let Some(programs) = programs {
            command.env("PATH", format!("{}:/usr/bin:/bin", programs.display()));
        }
        let process = command.arg(scene).arg("--stats").stdout(Stdio::piped()).spawn().unwrap();
        let window = self.xdotool(&["search", "--sync", "--onlyvisible", "--name", "wobble"]);
        self.xdotool(&["windowfocus", "--sync", &window]);
        App { display: self, process, window }
    }
}

/// The program, running.
struct App<'a> {
    display: &'a Display,
    process: Child,
    window: String,
}

/// What it did, as it says itself.
#[derive(Debug)]
struct Stats {
    frames: u64,
    advances: u64,
    substeps: u64,
    submits: u64,
}

impl App<'_> {
    fn move_mouse(&self, x: u32, y: u32) {
        self.display.xdotool(&["mousemove", "--window", &self.window, &x.to_string(), &y.to_string()]);
    }

    fn key(&self, key: &str) {
        // Keys sent to a window by name are synthetic and ignored; those that go to the focus are not.
        self.display.xdotool(&["windowfocus", "--sync", &self.window]);
        self.display.xdotool(&["key", key]);
    }

    /// Waits until the picture changes no more, at most half a minute.
    fn wait_until_still(&self) -> RgbaImage {
        self.still_within(Duration::from_secs(30)).expect("the picture does not come to rest")
    }

    /// The picture once it changes no more; `None`: it still does after so long.
    fn still_within(&self, most: Duration) -> Option<RgbaImage> {
        let start = Instant::now();
        let mut last = self.display.screenshot();
        let mut still = 0;
        while start.elapsed() < most {
            std::thread::sleep(Duration::from_millis(300));
            let next = self.display.screenshot();
            still = if next == last { still + 1 } else { 0 };
            last = next;
            if still == 3 {
                return Some(last);
            }
        }
        None
    }

    /// Waits until the picture is another than this, at most half a minute.
    fn wait_for_change(&self, before: &RgbaImage) {
        let start = Instant::now();
        while self.display.screenshot() == *before {
            assert!(start.elapsed() < Duration::from_secs(30), "the picture does not change");
            std::thread::sleep(Duration::from_millis(50));
        }
    }

    /// Whether the program has left after so long at most.
    fn has_left(&mut self, most: Duration) -> bool {
        let start = Instant::now();
        while start.elapsed() < most {
            if self.process.try_wait().unwrap().is_some() {
                return true;
            }
            std::thread::sleep(Duration::from_millis(50));
        }
        false
    }

    /// Leaves by the key, and reads what the program says of itself. Where something was changed, it is pressed once more.
    fn quit(mut self) -> Stats {
        self.key("ctrl+q");
        if !self.has_left(Duration::from_secs(3)) {
            self.key("ctrl+q");
        }
        if !self.has_left(Duration::from_secs(10)) {
            self.process.kill().unwrap();
            panic!("Ctrl+Q does not leave");
        }
        let done = self.process.wait_with_output().unwrap();
        assert!(done.status.success(), "it ends with {}", done.status);
        let text = String::from_utf8(done.stdout).unwrap();
        let words: Vec<&str> = text.split_whitespace().collect();
        let value = |name: &str| {
            let at = words.iter().position(|&word| word == name).unwrap();
            words[at + 1].parse().unwrap()
        };
        Stats {
            frames: value("frames"),
            advances: value("advances"),
            substeps: value("substeps"),
            submits: value("submits"),
        }
    }
}

/// Pixels of the world's part of the window that are clearly another colour.
fn changed(a: &RgbaImage, b: &RgbaImage) -> usize {
    let differs = |x: u32, y: u32| {
        let (p, q) = (a.get_pixel(x, y), b.get_pixel(x, y));
        (0..3).any(|k| p[k].abs_diff(q[k]) > 40)
    };
    // Left of the rim's middle the mouse never comes in this test, below the figures and above what is said.
    (200..540).flat_map(|x| (130..580).map(move |y| (x, y))).filter(|&(x, y)| differs(x, y)).count()
}

#[test]
fn a_mouse_through_the_rim_deforms_it_and_it_recovers() {
    let Some(display) = Display::start() else { return };
    let app = display.open(&common::file("rim-still.json"));
    app.move_mouse(1090, 20);
    let before = app.wait_until_still();
    for x in (560..=1000).rev().step_by(40) {
        app.move_mouse(x, 360);
        std::thread::sleep(Duration::from_millis(40));
    }
    std::thread::sleep(Duration::from_millis(300));
    let pushed = display.screenshot();
    let moved = changed(&before, &pushed);
    assert!(moved > 800, "the rim moves where the mouse has not been: {moved} pixels");
    app.move_mouse(1090, 20);
    app.wait_until_still();
    app.key("r");
    let reset = app.wait_until_still();
    assert_eq!(changed(&before, &reset), 0, "R brings the start back");
    app.quit();
}

/// Pixels of bluish green, as the outlines of meshes are in the import panel.
fn outlined(picture: &RgbaImage) -> usize {
    picture
        .pixels()
        .filter(|pixel| pixel[1] > 180 && pixel[0] < 160 && pixel[2] < 190 && pixel[1] > pixel[2] + 50)
        .count()
}

impl App<'_> {
    /// Waits until the import panel shows the outline of a mesh, at most half a minute.
    fn wait_for_outline(&self) {
        let start = Instant::now();
        while outlined(&self.display.screenshot()) < 300 {
            assert!(start.elapsed() < Duration::from_secs(30), "the import panel shows no mesh");
            std::thread::sleep(Duration::from_millis(200));
        }
    }
}

/// A program of this name that does what the lines say.
fn script(folder: &Path, name: &str, lines: &str) {
    use std::os::unix::fs::PermissionsExt;
    let path = folder.join(name);
    std::fs::write(&path, format!("#!/bin/sh\n{lines}\n")).unwrap();
    std::fs::set_permissions(&path, std::fs::Permissions::from_mode(0o755)).unwrap();
}

#[test]
fn a_chosen_picture_opens_the_import_panel_and_there_is_one_dialog_at_a_time() {
    let Some(display) = Display::start() else { return };
    let folder = tempfile::tempdir().unwrap();
    let gear = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/pictures/gear.png");
    let (log, gear) = (folder.path().join("log"), gear.display());
    let lines = format!("echo shown >> {}\nsleep 2\necho {gear}", log.display());
    script(folder.path(), "zenity", &lines);
    let app = display.open_with(&common::file("rim-still.json"), Some(folder.path()));
    app.key("ctrl+o");
    app.key("ctrl+o");
    app.wait_for_outline();
    assert_eq!(std::fs::read_to_string(&log).unwrap(), "shown\n");
    // Escape closes the panel first.
    app.key("Escape");
    std::thread::sleep(Duration::from_millis(500));
    assert!(outlined(&display.screenshot()) < 300);
    app.quit();
}

#[test]
fn a_window_without_a_dialog_stays_open() {
    let Some(display) = Display::start() else { return };
    let folder = tempfile::tempdir().unwrap();
    script(folder.path(), "zenity", "exit 1");
    let app = display.open_with(&common::file("rim-still.json"), Some(folder.path()));
    app.move_mouse(1090, 20);
    let before = app.wait_until_still();
    app.key("ctrl+o");
    // A caret blinks there: it never comes to rest.
    let changed = || {
        let after = display.screenshot();
        let differs = |x: u32, y: u32| before.get_pixel(x, y) != after.get_pixel(x, y);
        (400..780).flat_map(|x| (200..450).map(move |y| (x, y))).filter(|&(x, y)| differs(x, y)).count()
    };
    let start = Instant::now();
    while changed() <= 20_000 {
        assert!(start.elapsed() < Duration::from_secs(30), "no path can be written in its place: {} pixels", changed());
        std::thread::sleep(Duration::from_millis(300));
    }
    app.key("Escape");
    app.quit();
}

/// Holds a picture on the clipboard until it is ended: a process of its own, for the window asks who holds it.
#[test]
#[ignore = "a part of the next test"]
fn hold_a_picture_on_the_clipboard() {
    let Ok(path) = std::env::var("WOBBLE_TEST_PICTURE") else { return };
    let picture = image::open(path).unwrap().to_rgba8();
    let (width, height) = (picture.width() as usize, picture.height() as usize);
    let bytes = picture.into_raw().into();
    let mut clipboard = arboard::Clipboard::new().unwrap();
    clipboard.set_image(arboard::ImageData { width, height, bytes }).unwrap();
    std::thread::sleep(Duration::from_secs(600));
}

/// A rigid body of so many points that another one would make the scene slow, by what a point that meets others costs at least.
const FULL: &str = r#"{"wobble": 1, "name": "full", "contact": true, "view": {"center": [0.5, 0.5], "height": 4},
    "bodies": [{"make": "lattice", "columns": 90, "rows": 90, "spacing": 0.01, "material": {"kind": "rigid", "mass": 1}}]}"#;

#[test]
fn copies_that_would_make_a_scene_slow_come_by_enter_and_are_left_by_esc() {
    let Some(display) = Display::start() else { return };
    let folder = tempfile::tempdir().unwrap();
    let [scene, record] = ["full.json", "copies.jsonl"].map(|name| folder.path().join(name));
    std::fs::write(&scene, FULL).unwrap();
    let app = display.open_recorded(&scene, None, Some(&record));
    app.move_mouse(900, 200);
    app.wait_until_still();
    app.key("ctrl+a");
    // Without a question the second of each would be there too, and Enter and Esc would mean nothing.
    for (copy, answer, edits) in [
        ("ctrl+d", "Return", 1),
        ("ctrl+d", "Escape", 1),
        ("ctrl+c", "", 1),
        ("ctrl+v", "Return", 2),
        ("ctrl+v", "Escape", 2),
    ] {
        let before = app.display.screenshot();
        app.key(copy);
        if answer.is_empty() {
            app.still_within(LITTLE);
            continue;
        }
        // What lies on the clipboard is asked for elsewhere.
        app.wait_for_change(&before);
        app.still_within(LITTLE);
        // An answer that came before its question meant nothing: it is given again.
        let is_done = (0..8).any(|_| {
            app.key(answer);
            comes_within(2 * LITTLE, || recorded_edits(&record).len() >= edits)
        });
        assert!(is_done, "{copy}, {answer}: {:?}", recorded_edits(&record));
        app.still_within(LITTLE);
    }
    app.quit();
    assert_eq!(recorded_edits(&record), ["duplicate", "paste"]);
}

/// So long a picture may take to come to rest where it need not.
const LITTLE: Duration = Duration::from_secs(3);

/// Whether something comes to be so within this time.
fn comes_within(most: Duration, is_so: impl Fn() -> bool) -> bool {
    let start = Instant::now();
    while !is_so() && start.elapsed() < most {
        std::thread::sleep(Duration::from_millis(100));
    }
    is_so()
}

/// What the edits of a recording are called that may still be written, in their order.
fn recorded_edits(record: &Path) -> Vec<String> {
    let text = std::fs::read_to_string(record).unwrap_or_default();
    // The last line may not be whole yet.
    let lines = text.lines().filter_map(|line| serde_json::from_str::<serde_json::Value>(line).ok());
    let edits = lines.filter_map(|line| Some((line["edit"].as_u64()?, line["name"].as_str()?.to_owned())));
    let edits: std::collections::BTreeMap<u64, String> = edits.collect();
    edits.into_values().collect()
}

#[test]
fn a_picture_on_the_clipboard_is_pasted() {
    let Some(display) = Display::start() else { return };
    let gear = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/pictures/gear.png");
    let app = display.open(&common::file("rim-still.json"));
    let mut holder = display
        .command(std::env::current_exe().unwrap())
        .args(["--ignored", "--exact", "hold_a_picture_on_the_clipboard"])
        .env("WOBBLE_TEST_PICTURE", gear)
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    std::thread::sleep(Duration::from_millis(1500));
    app.key("ctrl+v");
    app.wait_for_outline();
    holder.kill().unwrap();
    holder.wait().unwrap();
    app.key("Escape");
    app.quit();
}

impl App<'_> {
    fn title(&self) -> String {
        self.display.xdotool(&["getwindowname", &self.window])
    }

    /// Whether the window comes to be called so within this time.
    fn comes_to_be_called(&self, title: &str, within: Duration) -> bool {
        let start = Instant::now();
        while self.title() != title && start.elapsed() < within {
            std::thread::sleep(Duration::from_millis(50));
        }
        self.title() == title
    }

    /// Waits until the window is called so: by the name of a scene alone, once that is there.
    fn wait_for_title(&self, title: &str) {
        let is_called = self.comes_to_be_called(title, Duration::from_secs(20));
        assert!(is_called, "it is called {:?}, not {title:?}", self.title());
    }

    /// Presses a key until the window is called so.
    fn key_until_title(&self, key: &str, title: &str) {
        let is_called = (0..4).any(|_| {
            self.key(key);
            self.comes_to_be_called(title, Duration::from_secs(5))
        });
        assert!(is_called, "it is called {:?}, not {title:?}", self.title());
    }
}

/// The pixels of a region.
fn pixels([left, top, right, bottom]: [u32; 4]) -> impl Iterator<Item = (u32, u32)> {
    (left..right).flat_map(move |x| (top..bottom).map(move |y| (x, y)))
}

/// Pixels of a region that are the same in both pictures are left out.
fn differing(a: &RgbaImage, b: &RgbaImage, region: [u32; 4]) -> usize {
    pixels(region).filter(|&(x, y)| a.get_pixel(x, y) != b.get_pixel(x, y)).count()
}

/// Where the bar below lies in a window on this display, without the time in it.
const BAR: [u32; 4] = [0, 640, 120, 665];

#[test]
fn keys_live_after_tab_and_escape_never_leaves() {
    let Some(display) = Display::start() else { return };
    let app = display.open(&common::file("rim-still.json"));
    app.move_mouse(1090, 300);
    let with = app.wait_until_still();
    app.key("Tab");
    let without = app.wait_until_still();
    assert!(differing(&with, &without, BAR) > 1_000, "Tab hides the panels");
    app.key("Tab");
    let again = app.wait_until_still();
    assert_eq!(differing(&with, &again, BAR), 0, "and brings them back");
    app.key("space");
    let paused = app.wait_until_still();
    assert!(differing(&with, &paused, BAR) > 20, "the space bar pauses: no button has the focus");
    app.key("space");
    for _ in 0..3 {
        app.key("Escape");
    }
    assert_eq!(differing(&with, &app.wait_until_still(), BAR), 0, "Escape closes nothing here, and does not leave");
    app.quit();
}

/// Where the list of paces drops up from the bar, and where the button is that opens it; and the tools.
const PACES: [u32; 4] = [145, 440, 215, 620];
const PACE: [u32; 4] = [145, 635, 215, 665];
const TOOLS: [u32; 4] = [10, 130, 60, 420];

#[test]
fn arrows_and_enter_choose_in_a_list_and_letters_typed_there_mean_nothing() {
    let Some(display) = Display::start() else { return };
    let app = display.open(&common::file("rim-still.json"));
    app.move_mouse(175, 650);
    let before = app.wait_until_still();
    display.xdotool(&["mousedown", "1"]);
    display.xdotool(&["mouseup", "1"]);
    let open = app.wait_until_still();
    assert!(differing(&before, &open, PACES) > 1_000, "the list is there");
    app.key("3");
    assert_eq!(differing(&open, &app.wait_until_still(), TOOLS), 0, "no tool is taken");
    ["Down", "Down", "Return"].into_iter().for_each(|key| app.key(key));
    let chosen = app.wait_until_still();
    assert_eq!(differing(&before, &chosen, PACES), 0, "the list has closed");
    assert!(differing(&before, &chosen, PACE) > 20, "another pace is chosen");
    app.key("3");
    assert!(differing(&before, &app.wait_until_still(), TOOLS) > 100, "and keys are the scene's again");
    app.quit();
}

/// A part of the world that no panel lies over in such a window, with lines of the grid in it.
const WORLD: [u32; 4] = [540, 130, 620, 318];

#[test]
fn panels_that_open_move_nothing_of_the_view() {
    let Some(display) = Display::start() else { return };
    let app = display.open(&common::file("rim-still.json"));
    app.move_mouse(1090, 600);
    let before = app.wait_until_still();
    let [left, top, ..] = WORLD;
    let ground = *before.get_pixel(left, top);
    let lines = pixels(WORLD).filter(|&(x, y)| *before.get_pixel(x, y) != ground).count();
    assert!(lines > 200, "there is something to be seen: {lines} pixels of the grid");
    // Plots, settings, the brush with its panel, the selector with its own, and all of them closed.
    for keys in [&["l"][..], &["g"], &["9"], &["6"], &["1", "g", "l"]] {
        keys.iter().for_each(|key| app.key(key));
        let after = app.wait_until_still();
        assert_eq!(differing(&before, &after, WORLD), 0, "after {keys:?}");
    }
    app.quit();
}

#[test]
fn the_gallery_opens_scenes_and_undo_goes_back() {
    let Some(display) = Display::start() else { return };
    let app = display.open(&common::file("rim-still.json"));
    app.wait_for_title("wobble · rim-still");
    app.key("ctrl+k");
    // A cursor blinks in the search: the picture never comes to rest.
    std::thread::sleep(Duration::from_millis(4000));
    // Letters are those of the search: R does not reset, P does not pause.
    display.xdotool(&["type", "whip"]);
    std::thread::sleep(Duration::from_millis(1000));
    app.key("Return");
    app.wait_for_title("wobble · Rope");
    app.key("Next");
    app.wait_for_title("wobble · Rope on the cursor");
    app.key("ctrl+z");
    app.wait_for_title("wobble · Rope");
    app.key("ctrl+y");
    app.wait_for_title("wobble · Rope on the cursor");
    app.key("Prior");
    app.wait_for_title("wobble · Rope");
    // The lessons are at the right: the last one in the list, which is scrolled to, opens its scene.
    app.key("h");
    app.move_mouse(1030, 450);
    std::thread::sleep(Duration::from_millis(800));
    display.xdotool(&["click", "--repeat", "40", "5"]);
    std::thread::sleep(Duration::from_millis(2500));
    app.move_mouse(1030, 575);
    std::thread::sleep(Duration::from_millis(300));
    display.xdotool(&["click", "1"]);
    app.wait_for_title("wobble · A brake that pushes");
    app.key("ctrl+z");
    app.wait_for_title("wobble · Rope");
    app.quit();
}

impl App<'_> {
    /// Presses the left button at a place, before the hover force has moved anything from there.
    fn press(&self, [x, y]: [u32; 2]) {
        let [x, y] = [x, y].map(|at| at.to_string());
        self.display.xdotool(&["mousemove", "--window", &self.window, &x, &y, "mousedown", "1"]);
        std::thread::sleep(Duration::from_millis(100));
    }

    fn let_go(&self) {
        self.display.xdotool(&["mouseup", "1"]);
    }
}

#[test]
fn the_window_asks_before_it_closes_over_work_and_saves_it() {
    let Some(display) = Display::start() else { return };
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.json");
    let mut app = display.open(&common::file("rim-still.json"));
    app.move_mouse(1090, 20);
    app.wait_until_still();
    app.key("ctrl+shift+n");
    app.wait_until_still();
    for (key, why) in [("ctrl+q", "it asks"), ("Escape", "Esc stays")] {
        app.key(key);
        assert!(!app.has_left(Duration::from_secs(2)), "{why}");
    }
    app.key("ctrl+q");
    app.wait_until_still();
    app.key("Return");
    // The caret of the name blinks: nothing comes to rest there.
    std::thread::sleep(Duration::from_secs(2));
    app.key("ctrl+a");
    display.xdotool(&["type", path.to_str().unwrap()]);
    std::thread::sleep(Duration::from_millis(500));
    app.key("Return");
    assert!(app.has_left(Duration::from_secs(10)), "it leaves once the file is written");
    let saved = wobble::history::Start::load(path.to_str().unwrap()).unwrap();
    assert!(saved.recording().state.is_some(), "the scene as it stands");
    assert!(app.process.wait().unwrap().success());
}

#[test]
fn what_is_pressed_on_is_led_flies_and_can_be_taken_away_and_brought_back() {
    let Some(display) = Display::start() else { return };
    let app = display.open(&common::file("rim-still.json"));
    app.move_mouse(1090, 300);
    let before = app.wait_until_still();
    // The point at the right of the rim.
    let at = [719, 324];
    app.press(at);
    for step in 1..=8 {
        app.move_mouse(at[0] + 20 * step, at[1] - 10 * step);
        std::thread::sleep(Duration::from_millis(40));
    }
    std::thread::sleep(Duration::from_millis(400));
    let led = display.screenshot();
    assert!(changed(&before, &led) > 800, "its other side comes along: {}", changed(&before, &led));
    app.let_go();
    app.move_mouse(1090, 300);
    let left = app.wait_until_still();
    // The tool that takes away, on what is still there after R. Paused, the mouse pushes nothing on its way to the click.
    app.key("r");
    let start = app.wait_until_still();
    assert_eq!(changed(&before, &start), 0, "the start, though it was led: {}", changed(&left, &start));
    app.key("space");
    app.key("4");
    app.press(at);
    app.let_go();
    app.move_mouse(1090, 300);
    let gone = app.wait_until_still();
    assert!(changed(&before, &gone) > 800, "the rim is taken away");
    app.key("ctrl+z");
    let again = app.wait_until_still();
    assert_eq!(changed(&before, &again), 0, "and comes back");
    app.key("space");
    let on = app.wait_until_still();
    assert_eq!(changed(&before, &on), 0, "and nothing pushes it that is not there");
    app.quit();
}

/// Pixels of exactly the colour of the button that is wanted most, above the bar and right of the tools: their middle.
fn wanted_button(picture: &RgbaImage) -> Option<[u32; 2]> {
    let is_its = |x: u32, y: u32| picture.get_pixel(x, y).0 == [125, 240, 200, 255];
    let all: Vec<[u32; 2]> =
        (100..1000).flat_map(|x| (60..200).map(move |y| [x, y])).filter(|&[x, y]| is_its(x, y)).collect();
    let mean = |k: usize| all.iter().map(|at| at[k]).sum::<u32>() / all.len().max(1) as u32;
    (all.len() > 500).then(|| [mean(0), mean(1)])
}

#[test]
fn what_a_killed_program_left_is_offered_and_gone_on_with() {
    let Some(display) = Display::start() else { return };
    let names = || std::fs::read_dir(display.state.path()).unwrap().map(|entry| entry.unwrap().file_name());
    let files = || names().filter(|name| name != "recent.json").count();
    let mut app = display.open(&common::file("rim-still.json"));
    app.move_mouse(1090, 300);
    app.wait_until_still();
    let recent = std::fs::read_to_string(display.state.path().join("recent.json")).unwrap();
    assert!(
        recent.contains("rim-still.json"),
        "a file that is named as the program starts is one of those opened last"
    );
    assert_eq!(files(), 0, "nothing was done yet");
    app.press([719, 324]);
    app.move_mouse(800, 250);
    std::thread::sleep(Duration::from_millis(300));
    app.let_go();
    app.move_mouse(1090, 300);
    std::thread::sleep(Duration::from_millis(2500));
    assert_eq!(files(), 4, "a log, its last state, what it is called and a lock");
    app.process.kill().unwrap();
    app.process.wait().unwrap();
    let again = display.open(Path::new("spring-damper"));
    again.wait_for_title("wobble · Springs and dampers");
    let start = Instant::now();
    let button = loop {
        if let Some(at) = wanted_button(&display.screenshot()) {
            break at;
        }
        assert!(start.elapsed() < Duration::from_secs(20), "nothing is offered");
        std::thread::sleep(Duration::from_millis(100));
    };
    again.press(button);
    again.let_go();
    again.wait_for_title("wobble · rim-still");
    again.move_mouse(1090, 300);
    assert_eq!(wanted_button(&again.wait_until_still()), None, "it is offered once");
    assert_eq!(files(), 4, "it is kept on");
    again.quit();
    assert_eq!(files(), 0, "and leaves nothing when it ends as it should");
}

#[test]
fn a_session_is_recorded_and_replays_to_its_marks() {
    let Some(display) = Display::start() else { return };
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("session.jsonl");
    let app = display.open_recorded(&common::file("rim-still.json"), None, Some(&path));
    app.press([719, 324]);
    app.move_mouse(800, 250);
    std::thread::sleep(Duration::from_millis(1500));
    app.let_go();
    app.move_mouse(1090, 300);
    std::thread::sleep(Duration::from_millis(300));
    app.quit();
    let done = Command::new(env!("CARGO_BIN_EXE_wobble")).arg("verify").arg(&path).output().unwrap();
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    let text = std::fs::read_to_string(&path).unwrap();
    assert!(text.contains("\"grab\"") && text.contains("\"release\""));
}

#[test]
fn every_tool_does_its_work_by_a_key_and_a_drag() {
    let Some(display) = Display::start() else { return };
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("tools.jsonl");
    let app = display.open_recorded(&common::file("rim-still.json"), None, Some(&path));
    app.move_mouse(1090, 300);
    app.wait_until_still();
    app.key("space");
    let gestures = [
        ("2", [719, 324], [719, 324]),
        ("0", [475, 322], [380, 322]),
        ("7", [595, 420], [595, 460]),
        ("8", [595, 440], [595, 440]),
        ("9", [660, 400], [700, 360]),
        ("5", [800, 150], [900, 250]),
        ("6", [850, 200], [850, 260]),
        ("3", [660, 324], [780, 324]),
        ("4", [870, 260], [870, 260]),
        ("1", [475, 322], [440, 300]),
    ];
    for (key, from, to) in gestures {
        app.key(key);
        app.move_mouse(from[0], from[1]);
        std::thread::sleep(Duration::from_millis(200));
        app.press(from);
        app.move_mouse((from[0] + to[0]) / 2, (from[1] + to[1]) / 2);
        std::thread::sleep(Duration::from_millis(150));
        app.move_mouse(to[0], to[1]);
        std::thread::sleep(Duration::from_millis(150));
        app.let_go();
        std::thread::sleep(Duration::from_millis(300));
        app.key("Escape");
    }
    app.quit();
    // Each is a step of undo that is called by what was done.
    let text = std::fs::read_to_string(&path).unwrap();
    let lines = text.lines().map(|line| serde_json::from_str::<serde_json::Value>(line).unwrap());
    let mut names: Vec<String> = lines.filter_map(|line| Some(line["name"].as_str()?.to_owned())).collect();
    names.dedup();
    assert_eq!(names, ["pin", "force", "muscles", "motor", "Rubber", "Box", "move", "cut", "erase", "move"]);
}

impl App<'_> {
    /// A drag with the left button by a few places on the way, from one place to another.
    fn drag(&self, from: [u32; 2], to: [u32; 2]) {
        self.move_mouse(from[0], from[1]);
        std::thread::sleep(Duration::from_millis(200));
        self.press(from);
        for share in [1, 2, 3] {
            let at = [0, 1].map(|axis| (from[axis] * (3 - share) + to[axis] * share) / 3);
            self.move_mouse(at[0], at[1]);
            std::thread::sleep(Duration::from_millis(120));
        }
        self.let_go();
        std::thread::sleep(Duration::from_millis(400));
    }

    /// Saves to a file, by the sheet, and opens what lies there.
    fn saved(&self, path: &Path) -> wobble::history::History {
        self.key("ctrl+s");
        // The caret of the name blinks: nothing comes to rest there.
        std::thread::sleep(Duration::from_secs(2));
        self.key("ctrl+a");
        self.display.xdotool(&["type", path.to_str().unwrap()]);
        std::thread::sleep(Duration::from_millis(500));
        self.key("Return");
        let start = Instant::now();
        while !path.exists() {
            assert!(start.elapsed() < Duration::from_secs(20), "{} is not written", path.display());
            std::thread::sleep(Duration::from_millis(100));
        }
        // The sheet goes once the window knows of the file, and takes the keys until then.
        std::thread::sleep(Duration::from_secs(1));
        let start = wobble::history::Start::load(path.to_str().unwrap()).unwrap();
        wobble::history::History::new(start).unwrap()
    }
}

/// Throws a body, opens another scene, cuts a cloth, builds a swing in an empty one, takes a part back and brings it again, and saves: one after
/// another, as who has just come does.
#[test]
fn the_first_minute_goes_from_a_throw_to_a_swing_that_is_saved() {
    let Some(display) = Display::start() else { return };
    let folder = tempfile::tempdir().unwrap();
    let app = display.open(&common::file("rim-still.json"));
    app.move_mouse(1090, 300);
    let before = app.wait_until_still();
    app.drag([719, 324], [880, 240]);
    assert!(changed(&before, &display.screenshot()) > 800, "it is thrown");
    app.key("ctrl+k");
    std::thread::sleep(Duration::from_secs(4));
    display.xdotool(&["type", "tearable"]);
    std::thread::sleep(Duration::from_secs(1));
    app.key("Return");
    app.wait_for_title("wobble · Net that tears");
    let net = wobble::scene::gallery().iter().find(|entry| entry.name == "tearable-net").unwrap();
    let whole = net.scene().unwrap().world(None).unwrap().bonds().len();
    let mut left = whole;
    // A busy machine calls the window by the scene's name before it is there to be cut.
    for trial in ["cut.json", "again cut.json", "at last cut.json"] {
        app.key("3");
        app.drag([480, 300], [700, 320]);
        left = app.saved(&folder.path().join(trial)).world().bonds().len();
        if left < whole {
            break;
        }
    }
    assert!(left < whole, "{left} of {whole} bonds are left");
    app.key_until_title("ctrl+n", "wobble · Untitled");
    // A rope from above, and a seat under its end. The signs of what is built stand beside the tools.
    app.key("5");
    std::thread::sleep(Duration::from_secs(1));
    app.drag([186, 129], [186, 129]);
    app.drag([600, 160], [600, 330]);
    app.drag([102, 129], [102, 129]);
    app.drag([540, 335], [660, 385]);
    let pieces = |path: &str| {
        let history = app.saved(&folder.path().join(path));
        let x = history.world().positions();
        let lowest = (0..history.world().point_count()).map(|k| x.get(2 * k + 1)).fold(f64::INFINITY, f64::min);
        (history.world().point_count(), lowest)
    };
    let (count, lowest) = pieces("swing.json");
    assert!(
        count > 12 && lowest > 1.0,
        "a rope and a seat that hangs on it: {count} points, {lowest} m over the floor"
    );
    app.key("ctrl+z");
    std::thread::sleep(Duration::from_secs(1));
    let (rope, _) = pieces("rope.json");
    assert!(rope < count && rope > 3, "the rope alone: {rope} of {count} points");
    app.key("ctrl+y");
    std::thread::sleep(Duration::from_secs(1));
    assert_eq!(pieces("again.json").0, count);
    app.quit();
}

#[test]
fn a_window_that_plays_asks_once_a_frame() {
    let Some(display) = Display::start() else { return };
    let app = display.open(Path::new("rim"));
    std::thread::sleep(Duration::from_secs(3));
    let stats = app.quit();
    assert!(stats.advances > 20 && stats.advances <= stats.frames, "{stats:?}");
}

#[test]
fn the_world_stands_still_behind_save_and_goes_on_after_it() {
    let Some(display) = Display::start() else { return };
    let app = display.open(Path::new("phase-portrait"));
    // Where the time is written.
    let goes_on = || {
        let before = display.screenshot();
        std::thread::sleep(Duration::from_millis(700));
        differing(&before, &display.screenshot(), [220, 640, 300, 665]) > 0
    };
    let wait_until = |wanted: bool| {
        let start = Instant::now();
        while goes_on() != wanted {
            assert!(
                start.elapsed() < Duration::from_secs(30),
                "time does not {}",
                if wanted { "go on" } else { "stand" }
            );
        }
    };
    wait_until(true);
    app.key("ctrl+s");
    wait_until(false);
    assert!(!goes_on(), "it stands for long");
    app.key("Escape");
    wait_until(true);
    app.quit();
}

#[test]
fn an_idle_window_does_nothing() {
    let Some(display) = Display::start() else { return };
    let run = |seconds| {
        let app = display.open(&common::file("rim-still.json"));
        std::thread::sleep(Duration::from_secs(2));
        std::thread::sleep(Duration::from_secs(seconds));
        app.quit()
    };
    let (short, long) = (run(0), run(5));
    assert_eq!(short.substeps, long.substeps, "it falls asleep at the same substep: {short:?} {long:?}");
    assert_eq!(short.substeps, 1001, "half a second of substeps of 0.5 ms, and the first: {short:?}");
    // A busy machine takes more or fewer frames to get there; five seconds that were not idle would be 300.
    assert!(long.submits <= short.submits + 20, "five idle seconds submit nothing: {short:?} {long:?}");
    assert_eq!(long.submits, long.frames);
}

#[test]
fn light_colours_are_kept_for_the_next_start() {
    let Some(display) = Display::start() else { return };
    let is_light = || {
        let picture = display.screenshot();
        // The ground between the tools and the ring, but for lines of the grid.
        let ground = (200..400).flat_map(|x| (200..400).map(move |y| [x, y]));
        ground.filter(|&[x, y]| picture.get_pixel(x, y)[0] > 200).count() > 30_000
    };
    let app = display.open(&common::file("rim-still.json"));
    app.move_mouse(1090, 20);
    app.wait_until_still();
    assert!(!is_light());
    app.key("c");
    app.wait_until_still();
    assert!(is_light());
    app.quit();
    let app = display.open(&common::file("rim-still.json"));
    app.wait_until_still();
    assert!(is_light(), "as it was left");
    app.quit();
}

#[test]
fn a_storm_of_sizes_and_keys_is_survived() {
    let Some(display) = Display::start() else { return };
    let app = display.open(&common::file("rim-still.json"));
    for (width, height) in [(300, 200), (1, 1), (1270, 790), (17, 900), (640, 480)] {
        display.xdotool(&["windowsize", &app.window, &width.to_string(), &height.to_string()]);
        std::thread::sleep(Duration::from_millis(60));
    }
    for key in ["space", "period", "period", "r", "f", "Home", "space", "x", "F1"] {
        app.key(key);
    }
    display.xdotool(&["mousemove", "--window", &app.window, "300", "200", "click", "4", "click", "5"]);
    display.xdotool(&["windowunmap", &app.window]);
    std::thread::sleep(Duration::from_millis(200));
    display.xdotool(&["windowmap", &app.window]);
    std::thread::sleep(Duration::from_millis(500));
    assert!(app.quit().frames > 3);
}

#[test]
fn without_a_display_one_line_says_what_to_do() {
    let done = Command::new(env!("CARGO_BIN_EXE_wobble"))
        .env_remove("DISPLAY")
        .env_remove("WAYLAND_DISPLAY")
        .env_remove("WAYLAND_SOCKET")
        .output()
        .unwrap();
    let message = String::from_utf8(done.stderr).unwrap();
    assert_eq!(done.status.code(), Some(1), "{message}");
    assert!(message.lines().any(|line| line.starts_with("wobble: no display") && line.contains("wobble render")));
}
