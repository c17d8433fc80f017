//! The gallery: one catalogue of scenes for the app, the command line, tests and benches.

use super::error::{SceneError, SceneErrorKind};
use super::keys::Scene;

/// A scene of the gallery.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Entry {
    /// What it is called by.
    pub name: &'static str,
    /// A few words for a list.
    pub title: &'static str,
    /// One sentence on what is seen.
    pub description: &'static str,
    /// A few words on what to try in the window.
    pub to_try: &'static str,
    /// How many points the scene has.
    pub point_count: usize,
    /// The scene file's text.
    pub json: &'static str,
}

/// Most points of a scene that is called small.
const SMALL: usize = 500;

impl Entry {
    /// Whether a second of its motion is computed in a moment, so that tests may run it several times.
    pub fn is_small(&self) -> bool {
        self.point_count <= SMALL
    }

    /// The scene, read from its text.
    ///
    /// Errors: the text is out of order, which a test excludes.
    pub fn scene(&self) -> Result<Scene, SceneError> {
        Scene::parse(self.json, &format!("{}.json", self.name))
    }
}

/// All scenes, in the order of a list.
pub fn gallery() -> &'static [Entry] {
    &GALLERY
}

/// The scene of a name.
pub(super) fn find(name: &str) -> Option<&'static Entry> {
    GALLERY.iter().find(|entry| entry.name == name)
}

impl Scene {
    /// The scene of a name that stands in a file.
    ///
    /// Errors: the gallery has none of this name.
    pub(crate) fn of_gallery(name: &str, label: &str) -> Result<Scene, SceneError> {
        let lacking = || SceneError {
            key: "scene".to_owned(),
            ..SceneError::whole(
                SceneErrorKind::NotFound,
                label,
                format!("`{name}` is no scene of the gallery: `wobble scenes` lists them"),
            )
        };
        find(name).ok_or_else(lacking)?.scene()
    }
}

/// An entry, its text embedded from `assets/scenes`.
macro_rules! entry {
    ($name:literal, $points:literal, $title:literal, $description:literal, $to_try:literal) => {
        Entry {
            name: $name,
            title: $title,
            description: $description,
            to_try: $to_try,
            point_count: $points,
            json: include_str!(concat!("../../assets/scenes/", $name, ".json")),
        }
    };
}

/// A scene with nothing in it yet: gravity, a floor and walls, bodies that meet, and a push of the mouse. No scene of the gallery; those who
/// look for it there find it.
pub static EMPTY: Entry = Entry {
    name: "empty",
    title: "An empty scene",
    description: "A floor, walls and gravity, and nothing else yet.",
    to_try: "build a body (5), draw one (N), or open a picture.",
    point_count: 0,
    json: include_str!("../../assets/empty.json"),
};

static GALLERY: [Entry; 53] = [
    entry!(
        "jelly",
        168,
        "Jelly",
        "A soft body cut out of a picture falls, lands and wobbles.",
        "hold it up by its top: it hangs 0.18 m longer; throw it; pin an eye and shake it."
    ),
    entry!(
        "jelly-stack",
        711,
        "Stack of jellies",
        "Nine soft bodies fall onto each other, sway, topple and come to rest as a heap.",
        "pull the middle one out from below: the heap gets 0.28 m lower; throw one into the heap; drop a picture on it."
    ),
    entry!(
        "pegs",
        421,
        "Pegs",
        "Soft discs and a rope fall between pegs, off each other and around the corners.",
        "cut the rope in the middle at once: 0.8 s later its ends are 0.64 m apart; catch a disc on the rope."
    ),
    entry!(
        "ragdoll",
        72,
        "Ragdoll",
        "A figure tumbles down a flight of stairs and comes to rest; another one hangs by a hand and swings.",
        "point at the pinned hand and press T: the figure falls 0.63 m in the first 0.4 s; throw the other one by a foot."
    ),
    entry!(
        "ragdoll-as-printed",
        16,
        "Ragdoll, as printed",
        "A tutorial's loop as printed (source 001): quadrilaterals and limbs like ropes, which bend any way. Where it lands, each frame multiplies what is wrong by 3.9; a fifth of its pace.",
        "R, and watch both land: 0.25 s later a bone is 40 % too long; beside it bonds keep their length."
    ),
    entry!(
        "wrecking-ball",
        118,
        "Wrecking ball",
        "A heavy ball on a chain swings into a tower of boxes, which falls.",
        "cut the chain before the ball swings: the tower stays 3.1 m high; pull the ball back and let it go."
    ),
    entry!(
        "bridge",
        79,
        "Bridge",
        "A box and a soft ball drop onto a bridge of planks between two banks; it sways and holds them.",
        "cut the rope at its left end: the first plank drops 0.86 m in 0.4 s; lift the box and drop it again."
    ),
    entry!(
        "catapult",
        39,
        "Catapult",
        "A weight on the short arm drops, the long one throws a box, and the tower that it hits falls.",
        "R, and cut the weight off at once: the box stays, it moves by 0.1 m; R, pull the arm down once it has thrown, stop time (Space), pin its tip (2), lay the box on it (1), and unpin it."
    ),
    entry!(
        "cradle",
        105,
        "Cradle",
        "A ball swings against four that hang in a row, and the last one leaves; after some swings all go together.",
        "R, pause, turn the second ball like the first (6): the last two leave, 0.79 m and 0.36 m far; after one alone 1.08 m and 0.09 m."
    ),
    entry!(
        "soft-car",
        39,
        "Soft car",
        "A car stands on two soft wheels with motors, before a hundred metres of hills, bumps and steps.",
        "hold the right arrow to drive: 15.6 m in 4 s; the left one brakes and goes back; throw it by hand."
    ),
    entry!(
        "walker",
        19,
        "Walker",
        "A body on six legs, each of two springs that are muscles; the legs stand still until a key is held.",
        "hold the right arrow: it walks 2.6 m in 4 s; the left one leads back; lift it by hand; pull a leg."
    ),
    entry!(
        "snake",
        36,
        "Snake",
        "A soft body crawls along a floor: waves of muscles run along its upper and its lower side.",
        "watch it crawl 1.4 m in 3 s, and take the friction of the floor away in the settings: 0 m; make another bond a muscle with tool 7."
    ),
    entry!(
        "tearable-net",
        375,
        "Net that tears",
        "A net hangs in a frame, and gives a little.",
        "grab its middle and pull it down and out of the picture: about 160 strings tear; cut it in two."
    ),
    entry!(
        "box",
        20,
        "Boxes",
        "Five boxes of springs, with one diagonal each, tumble into a heap and come to rest.",
        "cut the diagonal of a box on the floor: it folds flat, and is 0.89 m lower; throw one at the others."
    ),
    entry!(
        "box-two-supports",
        16,
        "One diagonal or two",
        "Boxes that drop alike: those with one diagonal sway to a side, and the upper one falls off; those with two stay on each other.",
        "R, and compare after 4 s: the upper boxes came down by 2.4 m and 1.4 m. Cut the top of the lower right one as it falls: 1.7 m at the right."
    ),
    entry!(
        "box-as-printed",
        4,
        "Box, as printed",
        "A tutorial's loop as printed (source 001): six moves to one sweep. It falls well, goes to pieces where it lands, and ends in a corner; a fifth of its pace.",
        "R, and watch both land: 0.3 s later a bond is 92 % off its length; beside it bonds keep theirs."
    ),
    entry!(
        "constraints",
        10,
        "Rods and strings",
        "From the left: a rod, a string, a ring of least and most distance, and a point on three strings. A slack string is blue.",
        "lift the second point: its string of 1.5 m is slack, and spans 0.88 m; throw each point: a rod is never slack."
    ),
    entry!(
        "points",
        10,
        "Falling points",
        "Ten loose points fall under unit gravity and bounce between walls.",
        "hold the mouse below them as they fall: it parts them, by 1.7 m more; grab one and throw it against a wall."
    ),
    entry!(
        "points-as-printed",
        10,
        "Falling points, as printed",
        "A tutorial's loop as printed (source 000): it starts with twice the fall of a first step, and stays half a step ahead of a fall for ever; walls stop all that comes.",
        "R, and stop after 1 s: they fell 0.525 m, and 0.5 m is right; the mouse attracts."
    ),
    entry!(
        "random-graph",
        10,
        "Random graph",
        "Ten points and thirty random bonds, swept by relaxation as in the source: it crumples, and its bonds, which contradict each other, keep it shivering.",
        "lead it to the left by a point: while it comes along a bond is 2.5 % off its length; see what shape it takes next."
    ),
    entry!(
        "random-graph-as-printed",
        10,
        "Random graph, as printed",
        "A tutorial's loop as printed (source 000): each bond ends a thousandth short, and only what is pressed together is limited; the mouse attracts.",
        "hold the mouse to the right of it: it is drawn 2.3 m in the first second; beside it are whole bonds, limited both ways."
    ),
    entry!(
        "rim",
        24,
        "Rim",
        "A braced rim of springs falls, lands and shies away from the mouse; one second a second.",
        "push the mouse down into it: it is 0.61 m flatter, and round again; lift it, throw it against a wall."
    ),
    entry!(
        "rim-relaxed",
        24,
        "Rim, relaxed",
        "The source's rim: one shuffled sweep a substep, at 3.6 times real time. \
         The square mouse force attracts there, here it repels.",
        "push it from the left as it falls: it is moved by 2.1 m; dent it and compare with the rim: here stiffness hangs on the step."
    ),
    entry!(
        "relaxation",
        18,
        "A share of the error",
        "Left, bonds that take a twentieth of their error in each sweep; right, springs as stiff as that amounts to with one sweep in steps of 1/240 s: 152 N/m. So they bounce and hang alike.",
        "give the left one 4 sweeps in the settings: it hangs 0.053 m lower than at the start, where one sweep gives 0.21 m. The springs stay those of one sweep: a share is no material of its own."
    ),
    entry!(
        "rim-as-printed",
        26,
        "Rim, as printed",
        "A tutorial's loop as printed (source 000): walls come before the sweep, so points get through the floor; one point hangs by one bond.",
        "R, and drag its top down onto the floor: points get to -5.014 m, and the floor is at -5. Drag one, and both follow."
    ),
    entry!(
        "spring-damper",
        10,
        "Springs and dampers",
        "Weights on springs: undamped, damped a little, damped critically, and three in a chain.",
        "pull the left weight down and let go: after half a second it is 0.49 m higher; four dampings side by side."
    ),
    entry!(
        "spring-damper-as-printed",
        10,
        "Springs, as printed",
        "A tutorial's loop as printed (source 003) in steps of 0.1 s, with forces by strain: called explicit Euler there, it is semi-implicit: swings of one weight do not grow. The chain at the right is too stiff for the step, and flies apart.",
        "R: after 2 s a bond of the chain is 330 % too long, and its end is 3.9 m from where the springs beside it have it: the same in N/m and in short steps."
    ),
    entry!(
        "spring-damper-relative",
        20,
        "A spring cut in pieces",
        "Two metres of spring in 1, 2 and 4 pieces. Left: pieces of one stiffness hang longer, the more there are. Right: of one axial stiffness, all alike.",
        "cut the right one as it swings: in half a second its weight drops 0.57 m; pull a weight down."
    ),
    entry!(
        "spring-damper-relative-as-printed",
        10,
        "By strain, as printed",
        "A tutorial's loop as printed (source 003): a weight on a spring in one piece, in two, in four. By strain all hang about as deep, as they do in the right world beside it; by the form that is called its alternative the same numbers are other springs.",
        "wait till they hang, and compare how deep the left ones hang: 0.49 m, beside it too, and 0.25 m by the alternative."
    ),
    entry!(
        "slide-circle",
        2,
        "Euler's circle",
        "Explicit Euler with steps of 0.1 s on a circle: it spirals out, by a factor of sqrt(1 + h^2) a step.",
        "R, and follow all three: after a turn it is 1.37 m from the middle instead of 1 m; throw one point, and all are thrown: led 1 m to the right in 0.4 s it is 2.73 m from the middle 1.6 s later."
    ),
    entry!(
        "slide-decay",
        8,
        "Euler's decay",
        "Explicit Euler on v' = -k v, h = 0.1 s: smooth at h k = 0.5, it oscillates at 1.5 and 1.95, and grows at 2.02.",
        "R, and watch which points come to rest: after 10 s the lowest is at 146 m/s, and two implicit methods bring all of them to rest. With a damping of 20 from the start (6) the uppermost swings for ever at 5.0 m/s."
    ),
    entry!(
        "phase-portrait",
        256,
        "Phase portrait",
        "Oscillators as points: where they are across, how fast upwards. They follow the arrows of the field round closed orbits.",
        "click anywhere: the innermost starts there, by all three methods. At 0.70 m it is back after a turn of 6.28 s; by explicit Euler orbits grow, by backward Euler they shrink: the trails at the left have a colour for each."
    ),
    entry!(
        "penalty",
        24,
        "Contact or penalty",
        "Boxes of 1, 2 and 4 kg. Left: contact, they stand on a step. Right: a penalty force, they sink in, the deeper the heavier.",
        "wait till they stand: at the right 4 kg sink in by 0.49 m, 1 kg by 0.12 m; drag the heaviest one off the step: it sinks in too, by a corner 0.60 m."
    ),
    entry!(
        "image-mesh",
        195,
        "Image mesh",
        "A letter cut out of a bitmap, its triangles' sides swept four times a step, in one order: a jelly that the mouse dents, and whose sides get their lengths back.",
        "cut it in two as it falls: it lands 4.1 m wide in two halves; dent the letter with the mouse."
    ),
    entry!(
        "image-mesh-as-printed",
        195,
        "Image mesh, as printed",
        "A tutorial's loop as printed (source 000): a letter cut into triangles, all of whose sides end a thousandth of a metre short; it lands as a jelly and gets through the floor.",
        "hold the mouse at its upper right: in a second it is drawn 1.2 m there; beside it are whole bonds, limited both ways."
    ),
    entry!(
        "brush",
        370,
        "Brush",
        "A fish of brush strokes, cut out as they were painted: on the canvas it is painted over and made a body anew.",
        "lift it by its nose: it hangs 2.5 m long; open its canvas (N) and paint eyes or fins."
    ),
    entry!(
        "gear",
        373,
        "Gear",
        "A gear with seven holes, cut out of a picture with its own colours, rolls along: rigid bonds.",
        "lift it by a tooth, by 0.47 m: it keeps its shape to the last digit, for it is rigid; stop it, and drop it on its rim."
    ),
    entry!(
        "jellyfish",
        571,
        "Jellyfish",
        "A picture of a jellyfish in thick water, soft down to its tentacles.",
        "pin its bell: it hangs there, 2.6 m long; stroke its tentacles."
    ),
    entry!(
        "ring",
        341,
        "Ring",
        "A ring of springs, cut out of a picture, spins, falls and rolls.",
        "catch it by its top as it falls: it hangs 2.23 m high; throw it hard at the wall; squeeze it flat and let go."
    ),
    entry!(
        "maze",
        846,
        "Maze",
        "The walls of a round maze are one soft body: it sags, and springs back.",
        "hold it up by its top: it hangs 0.72 m longer; cut one of its walls open and shake it."
    ),
    entry!(
        "pebble",
        392,
        "Pebbles",
        "The same stone twice, once firm and once soft as dough.",
        "R, and stop at 0.7 s: the soft stone lands 0.19 m flatter, the firm one keeps its 1.32 m. Throw the soft one to the left: 0.7 s after half a second of that it is 1.4 m further."
    ),
    entry!(
        "picture-obstacle",
        376,
        "Rain on a gear",
        "A picture stands as an obstacle: a soft stone, a rope and loose points fall on it and off its teeth.",
        "erase the gear after a second: what lay on it comes down some 1.5 m in the next; throw the stone back up."
    ),
    entry!(
        "rope",
        1000,
        "Rope",
        "A level rope of a thousand points, held at one end, swings down: rigid bonds, 100 m.",
        "cut it in the middle: the free half falls 4.9 m in the first second, as a stone does; crack the other half like a whip."
    ),
    entry!(
        "rope-on-cursor",
        30,
        "Rope on the cursor",
        "A rope of thirty points hangs on the cursor: its first point goes where the mouse is, and no link gets longer.",
        "swing it; press T: it is let go without a fling, and falls 0.64 m in 0.3 s; hold T and click its end, and it is back."
    ),
    entry!(
        "rope-as-printed",
        30,
        "Rope, as printed",
        "A tutorial's loop as printed (source 002): fifty sweeps a step, and the rope still hangs a hundredth too long.",
        "R, and look at its strain when it hangs: 1.7 %. Lead the pinned end away and press T on it: it is flung; beside it the rope is let go at rest."
    ),
    entry!(
        "net",
        10_000,
        "Net",
        "A net of ten thousand points hangs from its two upper corners; the mouse moves it.",
        "unpin its upper left corner: it drops 0.87 m in 0.4 s; grab it in the middle; cut a hole."
    ),
    entry!(
        "cloth-wind",
        520,
        "Cloth in the wind",
        "A cloth on a line sways, bulges and flaps in gusts.",
        "unpin three pegs at the left: the corner drops 1.7 m in 0.6 s; hold a corner down and let it go; roll it up with the mouse."
    ),
    entry!(
        "cloth-wind-as-printed",
        108,
        "Cloth in the wind, as printed",
        "A tutorial's loop as printed (source 001): six moves to one sweep tear a cloth on a line to pieces within a sixth of a second. Its wind pushes one point a frame; a tenth of its pace.",
        "R, and stop at 0.05 s: a bond is 189 % too long already, a point is 0.055 m off; beside it the cloth hangs, in as much wind for all of its points."
    ),
    entry!(
        "thousand-rims",
        24_000,
        "A thousand rims",
        "Forty columns and twenty-five rows of soft rims, each hung by a point of its rim, swing and wobble.",
        "cut one off its pin: in 0.4 s it drops by 1 m; sweep through it, zoom in on one."
    ),
    entry!(
        "cloth-space",
        121,
        "Cloth in space",
        "In space a cloth hangs from a bar above a box and a ball; the bar swings out once, and wind sways it.",
        "unpin the bar: it drops 0.78 m in half a second; drag it, with Shift it turns; pull at a corner until it tears; in the settings (G) switch the diagonals off."
    ),
    entry!(
        "cloth-space-as-printed",
        121,
        "Cloth, as printed",
        "A tutorial's loop as printed (source 004): a cloth that starts above its bar at half its size drops, and hangs as long as the frame rate wants.",
        "R: after 3 s a thread is 6.4 % too long; lead the bar a metre into the wall behind it: threads end 0.22 m behind the wall, beside it none does."
    ),
    entry!(
        "cloth-ball",
        416,
        "Cloth over a ball and a box",
        "In space a cloth falls on a ball and a box, folds over their edges and over itself, and comes to rest.",
        "take the ball away from under it: in 0.8 s the cloth comes down by 0.35 m; turn the view; pull the cloth off by a corner."
    ),
    entry!(
        "million-cloth",
        1_000_000,
        "A million points",
        "A cloth of a million points and four million rigid bonds hangs from its upper edge: for patient machines.",
        "cut it across: in 0.2 s what is below falls 0.20 m, as a stone does; zoom in to the threads; be patient."
    ),
];

#[cfg(test)]
#[allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;

    #[test]
    fn every_scene_is_in_order_and_bears_its_name() {
        for entry in gallery() {
            let scene = entry.scene().unwrap_or_else(|error| panic!("{error}"));
            assert_eq!(scene.name.as_deref(), Some(entry.name));
            assert!(!scene.tags.is_empty(), "{}", entry.name);
            assert!(scene.view.is_some(), "{}", entry.name);
            let made = match scene.dimensions() {
                2 => scene.model::<2>().map(|model| model.position.len()),
                _ => scene.model::<3>().map(|model| model.position.len()),
            };
            assert_eq!(made.unwrap_or_else(|error| panic!("{error}")), entry.point_count, "{}", entry.name);
        }
    }

    #[test]
    fn names_are_unique() {
        for (i, entry) in gallery().iter().enumerate() {
            assert!(gallery()[..i].iter().all(|other| other.name != entry.name));
        }
    }
}
