//! What the user can ask of the program: keys, buttons and panels ask for the same.

/// What the left button does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tool {
    /// Grabs what is pressed; pressed beside all bodies, the hover force pushes on.
    #[default]
    Hand,
    /// Holds points where they are, or lets them go.
    Pin,
    /// Cuts the bonds that a stroke crosses.
    Cut,
    /// Takes away what is clicked.
    Erase,
    /// A drag draws out a primitive, which comes into the world.
    Build,
    /// A click selects a body or an obstacle, a drag moves it; a drag beside all bodies selects what it goes around.
    Select,
    /// Makes a bond a muscle.
    Muscle,
    /// Hinges bodies together or to the ground, with a motor or without.
    Motor,
    /// A brush that gives bodies another matter.
    Paint,
    /// A drag from a body is a constant force, or a torque.
    Push,
}

impl Tool {
    /// All of them, in the order of the palette.
    pub const ALL: [Tool; 10] = [
        Tool::Hand,
        Tool::Pin,
        Tool::Cut,
        Tool::Erase,
        Tool::Build,
        Tool::Select,
        Tool::Muscle,
        Tool::Motor,
        Tool::Paint,
        Tool::Push,
    ];
}

/// What the tool for building makes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Primitive {
    /// A soft block, braced both ways.
    #[default]
    Box,
    /// A soft disc.
    Disc,
    /// A chain that keeps its length.
    Rope,
    /// A hanging sheet.
    Cloth,
    /// A soft ring.
    Rim,
    /// A figure of rigid pieces in joints.
    Figure,
    /// A box of four corners with both diagonals.
    Frame,
    /// Points and bonds, one after the other.
    Bonds,
    /// A box that nothing enters.
    SolidBox,
    /// A circle that nothing enters.
    SolidCircle,
    /// A plank that nothing enters.
    Slope,
    /// A plane without an end, solid on one side.
    Plane,
    /// An outline that nothing enters, drawn corner by corner or with a free stroke.
    Polygon,
}

impl Primitive {
    /// All of them, in the order of the palette: bodies, then obstacles.
    pub const ALL: [Primitive; 13] = [
        Primitive::Box,
        Primitive::Disc,
        Primitive::Rope,
        Primitive::Cloth,
        Primitive::Rim,
        Primitive::Figure,
        Primitive::Frame,
        Primitive::Bonds,
        Primitive::SolidBox,
        Primitive::SolidCircle,
        Primitive::Slope,
        Primitive::Plane,
        Primitive::Polygon,
    ];

    /// What it is called on its button, and when it is undone.
    pub fn name(self) -> &'static str {
        match self {
            Primitive::Box => "Box",
            Primitive::Disc => "Disc",
            Primitive::Rope => "Rope",
            Primitive::Cloth => "Cloth",
            Primitive::Rim => "Rim",
            Primitive::Figure => "Figure",
            Primitive::Frame => "Frame",
            Primitive::Bonds => "Bonds",
            Primitive::SolidBox => "Solid box",
            Primitive::SolidCircle => "Solid circle",
            Primitive::Slope => "Slope",
            Primitive::Plane => "Plane",
            Primitive::Polygon => "Polygon",
        }
    }

    /// The one after it in the palette, and after the last the first.
    pub fn next(self) -> Self {
        let place = Self::ALL.iter().position(|&other| other == self).map_or(0, |place| place + 1);
        Self::ALL[place % Self::ALL.len()]
    }

    /// Whether it is drawn click by click, not dragged out.
    pub fn is_drawn(self) -> bool {
        matches!(self, Primitive::Bonds | Primitive::Polygon)
    }
}

/// How bodies are shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Showing {
    /// Filled, in their colours or with their pictures.
    #[default]
    Bodies,
    /// By their strain.
    Strain,
    /// As points and bonds.
    Bonds,
}

impl Showing {
    /// All of them, in the order in which a key goes through them.
    pub const ALL: [Showing; 3] = [Showing::Bodies, Showing::Strain, Showing::Bonds];

    /// What it is called on its button.
    pub fn name(self) -> &'static str {
        match self {
            Showing::Bodies => "Bodies",
            Showing::Strain => "Strain",
            Showing::Bonds => "Bonds",
        }
    }

    /// What it shows.
    pub fn words(self) -> &'static str {
        match self {
            Showing::Bodies => "bodies in their colours",
            Showing::Strain => "where bodies are stretched and squeezed, and by how much",
            Showing::Bonds => "points and bonds alone",
        }
    }

    /// The next one.
    pub fn next(self) -> Self {
        match self {
            Showing::Bodies => Showing::Strain,
            Showing::Strain => Showing::Bonds,
            Showing::Bonds => Showing::Bodies,
        }
    }
}

/// What the user asks of the program. Panels return these too: a click and a key do the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// Plays or pauses.
    TogglePlay,
    /// Pauses and goes on by one frame.
    Step,
    /// Time runs back as long as the key is held.
    Rewind,
    /// Back to the start.
    Reset,
    /// Half the pace, down to an eighth.
    Slower,
    /// Twice the pace, up to four times.
    Faster,
    /// The scene before this one in the gallery.
    PreviousScene,
    /// The scene after this one in the gallery.
    NextScene,
    /// Opens or closes the gallery.
    Gallery,
    /// Goes back to just before the last edit.
    Undo,
    /// Goes to just after the edit that was undone.
    Redo,
    /// Takes another tool.
    Take(Tool),
    /// The tool for forces, to make wind.
    Wind,
    /// The tool for pins as long as the key is held.
    PinWhileHeld,
    /// Ends what is drawn click by click.
    Finish,
    /// Takes the last click of that back.
    StepBack,
    /// Takes away what is selected, under the cursor or grabbed.
    Delete,
    /// Puts a copy of what is selected beside it.
    Duplicate,
    /// Keeps a copy of what is selected, to be pasted.
    Copy,
    /// Selects all bodies and obstacles.
    SelectAll,
    /// Mirrors what is selected, left and right.
    FlipAcross,
    /// Mirrors what is selected, up and down.
    FlipOver,
    /// What is selected is selected as one from now on.
    Group,
    /// It is not any more.
    Ungroup,
    /// What is selected is not drawn any more.
    Hide,
    /// All that is hidden is drawn again.
    ShowHidden,
    /// Opens an empty scene: gravity, a floor and walls.
    New,
    /// Takes away all bodies.
    Clear,
    /// Opens the scene with what is drawn by lot drawn anew.
    Dice,
    /// A smaller region of the hover force.
    SmallerRegion,
    /// A larger region of the hover force.
    LargerRegion,
    /// A weaker hover force.
    Weaker,
    /// A stronger hover force.
    Stronger,
    /// Shows all points.
    Fit,
    /// The view that the scene opened with.
    Home,
    /// Shows bonds and points over bodies, or hides them.
    ToggleMesh,
    /// Shows bodies in another way.
    Show(Showing),
    /// Goes through the ways to show bodies.
    NextShowing,
    /// Shows the grid with its numbers, or hides it.
    ToggleGrid,
    /// Shows where points have been, or not.
    ToggleTrails,
    /// Dark colours or light ones.
    Palette,
    /// Cuts the scene's picture out anew.
    Import,
    /// Opens a canvas to draw a body on.
    Paint,
    /// Opens the system's dialog for a scene or a picture.
    Open,
    /// Takes the picture, or the file, that lies on the clipboard.
    Paste,
    /// Writes all that was done to a file.
    Save,
    /// Writes the picture to a file.
    Screenshot,
    /// Writes the last seconds to a file, as an animated picture.
    Clip,
    /// Opens or closes what can be set of the scene.
    Settings,
    /// Opens the settings at the field of their search.
    FindSetting,
    /// Opens or closes the plots of energies.
    Plots,
    /// Opens or closes the lessons.
    Lessons,
    /// Hides the panels, or shows them.
    TogglePanels,
    /// Hides the figures, or shows them.
    ToggleHud,
    /// Shows the keys.
    Help,
    /// All of the screen, or a window.
    FullScreen,
    /// Ends what is under way; closes what lies over the world.
    Cancel,
    /// Leaves.
    Quit,
}

impl Action {
    /// Whether it is asked for again and again while its key is held down.
    pub fn repeats(self) -> bool {
        use Action::{
            LargerRegion, NextScene, PreviousScene, Redo, SmallerRegion, Step, StepBack, Stronger, Undo, Weaker,
        };
        matches!(
            self,
            Step | StepBack
                | SmallerRegion
                | LargerRegion
                | Weaker
                | Stronger
                | Undo
                | Redo
                | PreviousScene
                | NextScene
        )
    }

    /// Whether it is done while a panel lies over the world: nothing there reaches the world.
    pub fn reaches_through(self) -> bool {
        use Action::{Cancel, Clip, FullScreen, Gallery, Help, Open, Paste, Quit, Save, Screenshot};
        matches!(self, Cancel | Clip | FullScreen | Gallery | Help | Open | Paste | Quit | Save | Screenshot)
    }
}
