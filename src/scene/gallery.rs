//! The gallery: scenes that come with the program, for the app, the command line, tests and benchmarks alike.

/// A scene of the gallery.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Entry {
    /// Its name.
    pub name: &'static str,
    /// What it shows, in a line.
    pub about: &'static str,
    /// Its scene file.
    pub text: &'static str,
}

macro_rules! entries {
    ($($name:literal: $about:literal,)*) => {
        &[$(Entry { name: $name, about: $about, text: include_str!(concat!("../../assets/scenes/", $name, ".json")) },)*]
    };
}

/// All scenes, in the order that they are listed in.
pub const ENTRIES: &[Entry] = entries! {
    "points": "ten points fall and bounce in a box",
    "random-graph": "ten points, thirty random bonds, swept in shuffled order",
    "rim": "a rim of springs to drag the mouse through",
    "rim-relaxed": "the same rim of hard bonds, one shuffled sweep a substep",
};

/// The scene of that name.
pub fn find(name: &str) -> Option<&'static Entry> {
    ENTRIES.iter().find(|entry| entry.name == name)
}

/// What to say when neither scene nor file has that name.
pub(super) fn no_such_scene(name: &str) -> String {
    let likely =
        ENTRIES.iter().map(|entry| (entry.name, likeness(name, entry.name))).max_by(|a, b| a.1.total_cmp(&b.1));
    match likely {
        Some((likely, likeness)) if likeness > 0.5 => {
            format!("no file and no scene of the gallery has this name: did you mean `{likely}`?")
        }
        _ => "no file and no scene of the gallery has this name: `wobble scenes` lists them".to_owned(),
    }
}

/// Share of neighbouring pairs of letters that two words have in common (Dice's coefficient), 0 to 1.
fn likeness(a: &str, b: &str) -> f64 {
    let pairs = |word: &str| -> Vec<[u8; 2]> {
        format!("^{}$", word.to_lowercase()).as_bytes().windows(2).map(|pair| [pair[0], pair[1]]).collect()
    };
    let (a, mut b) = (pairs(a), pairs(b));
    let whole = (a.len() + b.len()) as f64;
    let mut common = 0.0;
    for pair in a {
        if let Some(i) = b.iter().position(|&other| other == pair) {
            b.swap_remove(i);
            common += 2.0;
        }
    }
    common / whole
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slip_is_recognised() {
        assert!(no_such_scene("rimm").contains("`rim`"));
        assert!(no_such_scene("random_graph").contains("`random-graph`"));
        assert!(no_such_scene("xyz").contains("wobble scenes"));
    }
}
