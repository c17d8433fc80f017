//! The table of keys.

use winit::keyboard::NamedKey;

use super::{Binding, Stroke};
use crate::app::action::{Action, Tool};
use Stroke::{Ctrl, CtrlShift, Named, Shift, Writes};

const fn binding(keys: &'static str, words: &'static str, strokes: &'static [(Stroke, Action)]) -> Binding {
    Binding { keys, strokes, words }
}

/// What every key does.
pub static TABLE: &[Binding] = &[
    binding(
        "Space, P",
        "play or pause",
        &[(Named(NamedKey::Space), Action::TogglePlay), (Writes("p"), Action::TogglePlay)],
    ),
    binding(".", "one frame on", &[(Writes("."), Action::Step)]),
    binding(",", "held: time runs back", &[(Writes(","), Action::Rewind)]),
    binding(
        "R",
        "back to the start, or to where the last thing was built; settings stay",
        &[(Writes("r"), Action::Reset)],
    ),
    binding("-, +", "half or twice the pace", &[(Writes("-"), Action::Slower), (Writes("+"), Action::Faster)]),
    binding(
        "PgUp, PgDn",
        "the scene before or after this one",
        &[(Named(NamedKey::PageUp), Action::PreviousScene), (Named(NamedKey::PageDown), Action::NextScene)],
    ),
    binding("Ctrl+K", "the gallery", &[(Ctrl("k"), Action::Gallery)]),
    binding(
        "Ctrl+Z, Ctrl+Shift+Z, Ctrl+Y",
        "undo, redo",
        &[(Ctrl("z"), Action::Undo), (CtrlShift("z"), Action::Redo), (Ctrl("y"), Action::Redo)],
    ),
    binding(
        "1, 2, 3, 4, 5, 6, 7, 8, 9, 0",
        "the tools: hand, pin, cut, erase, build (5 again: the next thing to build), select, muscle, hinge and motor, material brush, force",
        &[
            (Writes("1"), Action::Take(Tool::Hand)),
            (Writes("2"), Action::Take(Tool::Pin)),
            (Writes("3"), Action::Take(Tool::Cut)),
            (Writes("4"), Action::Take(Tool::Erase)),
            (Writes("5"), Action::Take(Tool::Build)),
            (Writes("6"), Action::Take(Tool::Select)),
            (Writes("7"), Action::Take(Tool::Muscle)),
            (Writes("8"), Action::Take(Tool::Motor)),
            (Writes("9"), Action::Take(Tool::Paint)),
            (Writes("0"), Action::Take(Tool::Push)),
        ],
    ),
    binding("W", "wind: drag an arrow through the air", &[(Writes("w"), Action::Wind)]),
    binding(
        "T",
        "pressed on a pin it lets that go; held: a click pins points or lets them go",
        &[(Writes("t"), Action::PinWhileHeld)],
    ),
    binding(
        "Enter, Backspace",
        "build: end the outline or the chain, or take its last point back",
        &[(Named(NamedKey::Enter), Action::Finish), (Named(NamedKey::Backspace), Action::StepBack)],
    ),
    binding(
        "Del",
        "take away what is selected, under the cursor or grabbed",
        &[(Named(NamedKey::Delete), Action::Delete)],
    ),
    binding(
        "Ctrl+C, Ctrl+V",
        "copy what is selected; paste what was copied, a picture or a file",
        &[(Ctrl("c"), Action::Copy), (Ctrl("v"), Action::Paste)],
    ),
    binding("Ctrl+D", "duplicate what is selected: a copy beside it", &[(Ctrl("d"), Action::Duplicate)]),
    binding("Ctrl+A", "select all bodies and obstacles", &[(Ctrl("a"), Action::SelectAll)]),
    binding(
        "Ctrl+G, Ctrl+Shift+G",
        "select what is selected as one from now on, or not any more",
        &[(Ctrl("g"), Action::Group), (CtrlShift("g"), Action::Ungroup)],
    ),
    binding(
        "Ctrl+H, Ctrl+Shift+H",
        "hide what is selected; show all that is hidden",
        &[(Ctrl("h"), Action::Hide), (CtrlShift("h"), Action::ShowHidden)],
    ),
    binding(
        "Ctrl+N, Ctrl+Shift+N",
        "an empty scene; take away all bodies of this one",
        &[(Ctrl("n"), Action::New), (CtrlShift("n"), Action::Clear)],
    ),
    binding("Ctrl+R", "draw anew what the scene draws by lot", &[(Ctrl("r"), Action::Dice)]),
    binding(
        "[, ]",
        "a smaller or larger reach of the push",
        &[(Writes("["), Action::SmallerRegion), (Writes("]"), Action::LargerRegion)],
    ),
    binding(
        "Shift+[, Shift+]",
        "a weaker or stronger push",
        &[(Writes("{"), Action::Weaker), (Writes("}"), Action::Stronger)],
    ),
    binding(
        "G",
        "what can be set: gravity, air, walls, contact, the push, the method",
        &[(Writes("g"), Action::Settings)],
    ),
    binding("Ctrl+F", "look for a setting by a word", &[(Ctrl("f"), Action::FindSetting)]),
    binding("L", "plots of the energies over time", &[(Writes("l"), Action::Plots)]),
    binding("H", "lessons: how it works, step by step", &[(Writes("h"), Action::Lessons)]),
    binding("F", "fit all points", &[(Writes("f"), Action::Fit)]),
    binding("Home", "the view that the scene opened with", &[(Named(NamedKey::Home), Action::Home)]),
    binding("V", "bodies, their strain, or points and bonds alone", &[(Writes("v"), Action::NextShowing)]),
    binding("B", "bonds and points, over bodies", &[(Writes("b"), Action::ToggleMesh)]),
    binding("X", "the grid and its numbers", &[(Writes("x"), Action::ToggleGrid)]),
    binding("J", "trails: where points have been", &[(Writes("j"), Action::ToggleTrails)]),
    binding("C", "dark or light colours", &[(Writes("c"), Action::Palette)]),
    binding("N", "draw a body on a canvas", &[(Writes("n"), Action::Paint)]),
    binding("I", "cut the scene's first picture out anew", &[(Writes("i"), Action::Import)]),
    binding("Ctrl+O", "open a scene, a recording or a picture", &[(Ctrl("o"), Action::Open)]),
    binding(
        "Ctrl+S",
        "save the scene as it stands, all that was done as a recording, or a clip",
        &[(Ctrl("s"), Action::Save)],
    ),
    binding(
        "F2",
        "a screenshot, beside the last file that was saved, or among your documents",
        &[(Named(NamedKey::F2), Action::Screenshot)],
    ),
    binding(
        "Shift+F2",
        "a clip: the last seconds as an animated picture (.gif), in the same place",
        &[(Shift(NamedKey::F2), Action::Clip)],
    ),
    binding(
        "Tab, M",
        "hide the panels, the figures",
        &[(Named(NamedKey::Tab), Action::TogglePanels), (Writes("m"), Action::ToggleHud)],
    ),
    binding(
        "F1, F11",
        "these keys, full screen",
        &[(Named(NamedKey::F1), Action::Help), (Named(NamedKey::F11), Action::FullScreen)],
    ),
    binding(
        "Esc",
        "end what is under way, close what was opened last; it never leaves",
        &[(Named(NamedKey::Escape), Action::Cancel)],
    ),
    binding("Ctrl+Q", "leave", &[(Ctrl("q"), Action::Quit)]),
];

/// What the mouse does, in the same form.
pub fn by_mouse() -> [[&'static str; 2]; 11] {
    [
        ["left button on a body, or with one in the circle", "grab it; let go and it flies"],
        ["left button on a pin", "lead it elsewhere; pins that bonds join go as one bar, with Shift it turns"],
        ["left button beside all bodies", "push through them, where the scene has a push of the mouse"],
        ["select: drag beside all bodies", "select what the box touches; with Alt what a free stroke goes around"],
        ["select: double click or Ctrl+click", "take one bond or one point; with Shift beside what is selected"],
        ["select: drag a corner", "scale it; with Shift in proportion"],
        ["select: drag the knob above", "turn it; with Shift in steps of 15°"],
        ["select, while plots are shown: click a point or a bond", "put a probe on it, or take it off"],
        [
            "right or middle drag",
            "pan; the right button cuts cloths in the plane, and turns the view in space, never below the floor",
        ],
        ["wheel", "zoom at the cursor"],
        ["wheel while a rope is drawn", "more or less slack"],
    ]
}
