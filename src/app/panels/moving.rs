//! In the bar below, as one short line that opens on a click: what moves bodies otherwise than by plan, what gave way to the load, what
//! the live step does beside moving. Nothing of it, nothing there.

use std::time::Duration;

use egui::{
    Align, Button, Color32, Context, Id, Label, Layout, Popup, PopupCloseBehavior, Rect, RectAlign, RichText, Sense,
    Ui, vec2,
};

use super::fewer::that_fits;
use super::steady::steady;
use super::theme::colors;
use super::{Facts, Wish, short};
use crate::app::player::{Acts, Figures, Moved, Movers, Rung, Yielded};
use crate::sim::Why;

/// Widest line `[points]`.
const WIDTH: f32 = 290.0;
/// Lines that nobody points at stay so long `[s]`.
const READ: f64 = 10.0;

/// Said of what the program has seen to.
const NOTHING: &str = "You need not do anything.";

/// What is said, the figures behind it, and what can be asked for beside it.
#[derive(Clone, Debug, PartialEq)]
struct Line {
    words: String,
    figures: String,
    tone: Tone,
    offer: Option<Offer>,
}

/// How much it matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Tone {
    Weak,
    Text,
    Lead,
    Away,
}

impl Tone {
    fn color(self, context: &Context) -> Color32 {
        let colors = colors(context);
        match self {
            Tone::Weak => colors.weak,
            Tone::Text => colors.text,
            Tone::Lead => colors.lead,
            Tone::Away => colors.away,
        }
    }
}

/// From this width on the bar has room for words that say what others are about `[points]`.
pub(super) const ROOMY: f32 = 420.0;
/// Width of the short line, whatever it says: with those words and without, where there is room for either, and its share of the room where
/// there is not `[points]`.
const SHORT: [f32; 2] = [224.0, 150.0];
const SHARE: f32 = 0.4;

/// A button: its words, what it does, and what is asked for.
type Offer = (&'static str, &'static str, Wish);

/// Shows the short line in the bar below: resting on it reads the others, a click opens them above it until something else is pressed, Esc is, or
/// they were there for long enough to be read. It takes the same room where there is nothing to say: what stands beside it stays where it is.
pub(super) fn show(ui: &mut Ui, facts: &Facts, wishes: &mut Vec<Wish>) {
    let room = ui.available_width();
    let is_roomy = room >= ROOMY;
    let width = SHORT[usize::from(!is_roomy)].min(SHARE * room);
    let size = vec2(width, ui.spacing().interact_size.y);
    ui.allocate_ui_with_layout(size, Layout::right_to_left(Align::Center), |ui| {
        ui.set_min_width(width);
        let now = Note::of(&facts.figures);
        let is_urgent = facts.is_opening || now.short[0].1 == Tone::Away;
        let note = steady(ui.ctx(), "physics", (now, is_urgent), |a, b| a.short == b.short);
        if !note.lines.is_empty() {
            in_bar(ui, (note, is_roomy), wishes);
        }
    });
}

/// What is said: all lines, and in short where there is room and where there is little.
#[derive(Clone, Debug, PartialEq)]
struct Note {
    lines: Vec<Line>,
    short: [(String, Tone); 2],
}

impl Note {
    fn of(figures: &Figures) -> Self {
        let lines = lines(figures);
        let short = [true, false].map(|is_roomy| in_short(figures, lines.len(), is_roomy));
        Note { lines, short }
    }
}

/// The same, in a room of its own.
fn in_bar(ui: &mut Ui, (note, is_roomy): (Note, bool), wishes: &mut Vec<Wish>) {
    let Note { lines, short } = note;
    let (words, tone) = short[usize::from(!is_roomy)].clone();
    // What it is about, where the line of time has room beside that.
    let about = if is_roomy { format!("physics: {words}") } else { words.clone() };
    let room = ui.available_width() - 2.0 * ui.spacing().button_padding.x - 2.0;
    let less = std::iter::successors(Some(about), |more| Some(more.rsplit_once(", ")?.0.to_owned()));
    let words = that_fits(ui, less.chain([words, notes_in_words(lines.len()), lines.len().to_string()]), room);
    let button = ui.add(Button::new(RichText::new(words).color(tone.color(ui))).truncate());
    let button = button.on_hover_ui(|ui| {
        ui.set_max_width(WIDTH);
        for Line { words, tone, .. } in &lines {
            ui.add(Label::new(RichText::new(words).color(tone.color(ui))).wrap());
        }
    });
    let id = lines_id();
    if is_over(ui.ctx(), id, button.rect) {
        Popup::close_id(ui.ctx(), id);
    }
    let popup = Popup::from_toggle_button_response(&button).id(id).align(RectAlign::TOP_END).width(WIDTH);
    popup.close_behavior(PopupCloseBehavior::CloseOnClickOutside).show(|ui| {
        for Line { words, figures, tone, offer } in lines {
            let label = Label::new(RichText::new(words).color(tone.color(ui))).wrap().selectable(false);
            ui.add(label.sense(Sense::hover())).on_hover_text(figures);
            if let Some((name, said, wish)) = offer
                && ui.button(name).on_hover_text(said).clicked()
            {
                wishes.push(wish);
            }
        }
    });
}

fn lines_id() -> Id {
    Id::unique("who moves what")
}

/// Whether the lines that the button opens are shown.
pub(in crate::app) fn is_open(context: &Context) -> bool {
    Popup::is_id_open(context, lines_id())
}

/// Closes them. Returns whether they were shown.
pub(in crate::app) fn close(context: &Context) -> bool {
    let was_open = is_open(context);
    if was_open {
        Popup::close_id(context, lines_id());
    }
    was_open
}

/// Whether the lines that were opened are to close: something else is pressed, or nobody has pointed at them for a while.
fn is_over(context: &Context, id: Id, button: Rect) -> bool {
    let read = id.with("read");
    if !Popup::is_id_open(context, id) {
        context.data_mut(|data| data.remove::<f64>(read));
        return false;
    }
    let own = context.memory(|memory| memory.area_rect(id)).map_or(button, |lines| lines.union(button));
    let (now, at, is_pressed) =
        context.input(|input| (input.time, input.pointer.interact_pos(), input.pointer.any_pressed()));
    let is_on_them = at.is_some_and(|at| own.contains(at));
    let since = context.data_mut(|data| {
        let since = data.get_temp_mut_or(read, now);
        if is_on_them {
            *since = now;
        }
        *since
    });
    let left = since + READ - now;
    if left > 0.0 {
        context.request_repaint_after(Duration::from_secs_f64(left));
    }
    left <= 0.0 || is_pressed && !is_on_them
}

/// How it is computed in a word, a shorter one where there is little room; else how many notes there are on it, whose number comes and goes.
fn in_short(figures: &Figures, notes: usize, is_roomy: bool) -> (String, Tone) {
    let has = |why: &[Why]| figures.movers.moved.iter().any(|one| why.contains(&one.why));
    let (words, color) = match () {
        () if has(&[Why::NotFinite]) => (Some(["frozen", "frozen"]), Tone::Away),
        () if figures.yielded.is_some() => (Some(["rougher, to keep up", "rougher"]), Tone::Lead),
        () if has(&[Why::Budget, Why::Alarm]) => (Some(["quick", "quick"]), Tone::Weak),
        () if has(&[Why::Contact, Why::Plan]) => (Some(["with collisions", "collisions"]), Tone::Weak),
        () => (None, Tone::Weak),
    };
    let notes = notes_in_words(notes);
    let words = match words {
        Some([word, _]) if is_roomy => word.to_owned(),
        Some([_, word]) => word.to_owned(),
        None => notes,
    };
    (words, color)
}

fn notes_in_words(notes: usize) -> String {
    if notes == 1 { "1 note".to_owned() } else { format!("{notes} notes") }
}

fn lines(figures: &Figures) -> Vec<Line> {
    let Movers { moved, islands, can_be_exact } = &*figures.movers;
    let mut lines: Vec<Line> = moved.iter().map(|one| told(one, *islands)).collect();
    if *can_be_exact {
        let said = "however slow that gets; what touches something is not concerned";
        // Beside what it would change.
        let last = moved.iter().rposition(|one| matches!(one.why, Why::Budget | Why::Alarm));
        if let Some(line) = last.and_then(|last| lines.get_mut(last)) {
            line.offer = Some(("Make this exact", said, Wish::Exact));
        }
    }
    if let Some(yielded) = &figures.yielded {
        let said = "as exact as before, in slow motion where that takes too long";
        lines.push(Line { offer: Some(("Take it back", said, Wish::TakeBack)), ..gave_way(yielded) });
    }
    lines.extend(done(&figures.acts));
    lines.extend(figures.relaxed.map(relaxed));
    lines
}

/// How stiff relaxed bonds are `[N/m]`.
fn relaxed(stiffness: f64) -> Line {
    Line {
        words: format!(
            "Relaxed bonds give way like springs of {stiffness:.0} N/m. More sweeps in the settings make them stiffer."
        ),
        figures: "measured on a bond in the middle of the list, by the substep and the sweeps of now".to_owned(),
        tone: Tone::Weak,
        offer: None,
    }
}

/// How many bodies are moved otherwise than exactly, and why; since when and how behind it.
fn told(&Moved { why, islands, since }: &Moved, all: usize) -> Line {
    let (who, is_one) = match (islands, all) {
        (1, 1) => ("The body".to_owned(), true),
        (2, 2) => ("Both bodies".to_owned(), false),
        (count, all) if count == all => (format!("All {all} bodies"), false),
        (1, all) => (format!("1 of {all} bodies"), true),
        (count, all) => (format!("{count} of {all} bodies"), false),
    };
    let by = |one: &'static str, many: &'static str| if is_one { one } else { many };
    let [since, last] = since.map(|time| format!("{time:.1}\u{a0}s"));
    let since = if since == last { format!("since {since}") } else { format!("since {since}, the last since {last}") };
    let (words, how, tone) = match why {
        Why::Budget => (
            format!(
                "{who} {} moved by a faster, rougher method: an exact one would take longer than a frame. {NOTHING}",
                by("is", "are")
            ),
            "the live step: a bounded amount of work a frame",
            Tone::Text,
        ),
        Why::Alarm => (
            format!(
                "{who} {} moved by a sturdier method: the exact one could not follow the motion. {NOTHING}",
                by("is", "are")
            ),
            "the live step: its own method gained energy, stretched bonds too far or came to no end, or pins are led too far apart for it",
            Tone::Text,
        ),
        Why::Contact | Why::Plan => (
            format!(
                "{who} can touch others, so {} moved by a method that knows collisions. {NOTHING}",
                by("it is", "they are")
            ),
            "the live step, in substeps of 1/960 s or less: the exact methods know no collisions",
            Tone::Weak,
        ),
        Why::NotFinite => (
            format!(
                "{who} {} still: the motion grew beyond all numbers. Undo what came before, or grab or change {}.",
                by("stands", "stand"),
                by("it", "them")
            ),
            "the positions were no finite numbers any more",
            Tone::Away,
        ),
    };
    Line { words, figures: format!("{since}: {how}"), tone, offer: None }
}

/// What gave way, and to what.
fn gave_way(&Yielded { rung, since, work }: &Yielded) -> Line {
    let (words, how) = match rung {
        Rung::Order => (
            "Computed less exactly, to keep up with the clock. Take it back to have the exact motion, slower.",
            "order 2 in place of 4",
        ),
        Rung::Live => (
            "Computed more roughly, to keep up with the clock. Take it back to have the exact motion, slower.",
            "the live step wherever it is cheaper",
        ),
    };
    let cause = work.map_or(String::new(), |work| format!(": {} of work a frame", short(work)));
    let figures = format!("{how} since {since:.1}\u{a0}s{cause}");
    Line { words: words.to_owned(), figures, tone: Tone::Lead, offer: None }
}

/// What was done of late to keep bodies whole and apart.
fn done(&Acts { cut, guarded, mends, parts, settles }: &Acts) -> Vec<Line> {
    let times = |count: u64| {
        if count == 1 { "once within a second".to_owned() } else { format!("{count} times within a second") }
    };
    let line = |words: &str, figures: String| Line { words: words.to_owned(), figures, tone: Tone::Weak, offer: None };
    let mut lines = Vec::new();
    if cut > 0 {
        let words = "A fast body was stopped before it went through another one.";
        lines.push(line(&format!("{words} {NOTHING}"), times(cut)));
    }
    if guarded > 0 {
        let words = "A collision gave a body more speed than it had to give: the excess was taken away.";
        lines.push(line(&format!("{words} {NOTHING}"), times(guarded)));
    }
    if mends {
        lines.push(line(
            "A body was turned inside out: it is led back to its shape. Grab it if it does not come free.",
            "triangles are led to their shape at rest".to_owned(),
        ));
    }
    if parts {
        lines.push(line(
            "Bodies overlap: they are moved apart. Pull one of them away if they are stuck.",
            "as wholes, without speed".to_owned(),
        ));
    }
    if settles {
        lines.push(line(
            &format!("Bodies that lie on each other are brought to rest. {NOTHING}"),
            "what is slow where it touches is slowed down".to_owned(),
        ));
    }
    lines
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use egui_kittest::Harness;
    use egui_kittest::kittest::Queryable as _;

    use super::*;

    fn words(figures: &Figures) -> Vec<String> {
        lines(figures).into_iter().map(|line| line.words).collect()
    }

    fn moved(why: Why, islands: usize) -> Moved {
        Moved { why, islands, since: [3.25, 3.25] }
    }

    #[test]
    fn where_nothing_of_it_happens_nothing_is_said() {
        assert_eq!(words(&Figures::default()), Vec::<String>::new());
        let movers = Movers { islands: 5, ..Movers::default() };
        assert_eq!(words(&Figures { movers: Arc::new(movers), ..Figures::default() }), Vec::<String>::new());
    }

    #[test]
    fn one_word_says_what_matters_most() {
        let with = |list: Vec<Moved>| {
            let movers = Movers { moved: list, islands: 4, can_be_exact: true };
            Figures { movers: Arc::new(movers), ..Figures::default() }
        };
        let short = |figures: &Figures| in_short(figures, lines(figures).len(), true).0;
        let tight = |figures: &Figures| in_short(figures, lines(figures).len(), false).0;
        assert_eq!(short(&with(vec![moved(Why::Contact, 1)])), "with collisions");
        assert_eq!(short(&with(vec![moved(Why::Contact, 1), moved(Why::Budget, 1)])), "quick");
        let yielded = Some(Yielded { rung: Rung::Live, since: 1.0, work: None });
        let both = Figures { yielded, ..with(vec![moved(Why::Budget, 1)]) };
        assert_eq!(short(&both), "rougher, to keep up");
        let frozen = Figures { yielded, ..with(vec![moved(Why::Budget, 1), moved(Why::NotFinite, 1)]) };
        assert_eq!((short(&frozen), tight(&frozen)), ("frozen".to_owned(), "frozen".to_owned()));
        let acts = Acts { settles: true, ..Acts::default() };
        assert_eq!(short(&Figures { acts, ..Figures::default() }), "1 note");
    }

    #[test]
    fn it_opens_on_a_click_and_closes_on_another() {
        let figures = Figures { acts: Acts { settles: true, ..Acts::default() }, ..Figures::default() };
        let facts = Facts { figures, ..Facts::default() };
        let mut harness = Harness::builder().with_size([900.0, 600.0]).build_ui(|ui| {
            ui.add_space(500.0);
            show(ui, &facts, &mut Vec::new());
        });
        harness.run();
        for is_open in [true, false] {
            harness.get_by_label("physics: 1 note").click();
            harness.run();
            // While the pointer rests on it all is read anyway.
            harness.remove_cursor();
            harness.run_steps(8);
            let all =
                harness.query_by_label("Bodies that lie on each other are brought to rest. You need not do anything.");
            assert_eq!(all.is_some(), is_open);
        }
    }

    #[test]
    fn what_was_opened_closes_when_something_else_is_pressed_and_by_itself() {
        let figures = Figures { acts: Acts { settles: true, ..Acts::default() }, ..Figures::default() };
        let facts = Facts { figures, ..Facts::default() };
        let mut harness = Harness::builder().with_size([900.0, 600.0]).with_step_dt(0.5).build_ui(|ui| {
            ui.add_space(500.0);
            show(ui, &facts, &mut Vec::new());
        });
        harness.run_steps(2);
        let is_open = |harness: &Harness<'_>| {
            harness
                .query_by_label("Bodies that lie on each other are brought to rest. You need not do anything.")
                .is_some()
        };
        let open = |harness: &mut Harness<'_>| {
            harness.get_by_label("physics: 1 note").click();
            harness.run_steps(2);
            harness.remove_cursor();
            harness.run_steps(4);
            assert!(is_open(harness));
        };
        open(&mut harness);
        // A drag is no click.
        harness.drag_at(egui::pos2(700.0, 100.0));
        harness.run_steps(3);
        assert!(!is_open(&harness), "something else was pressed");
        harness.drop_at(egui::pos2(600.0, 200.0));
        harness.run_steps(2);
        open(&mut harness);
        harness.run_steps(10);
        assert!(is_open(&harness), "there is time to read it");
        harness.run_steps(14);
        assert!(!is_open(&harness), "nobody looks at it any more");
        open(&mut harness);
        assert!(super::is_open(&harness.ctx) && close(&harness.ctx), "a key of the scene closes it");
        harness.run_steps(3);
        assert!(!is_open(&harness) && !close(&harness.ctx));
        open(&mut harness);
        harness.key_press(egui::Key::Escape);
        harness.run_steps(3);
        assert!(!is_open(&harness));
    }

    #[test]
    fn who_is_moved_since_when_and_why_is_said_with_the_way_back() {
        let list = vec![moved(Why::Budget, 2), moved(Why::Contact, 1), moved(Why::NotFinite, 1)];
        let movers = Movers { moved: list, islands: 4, can_be_exact: true };
        let lines = lines(&Figures { movers: Arc::new(movers), ..Figures::default() });
        let said: Vec<&str> = lines.iter().map(|line| line.words.as_str()).collect();
        assert_eq!(
            said,
            [
                "2 of 4 bodies are moved by a faster, rougher method: an exact one would take longer than a frame. You need not do anything.",
                "1 of 4 bodies can touch others, so it is moved by a method that knows collisions. You need not do anything.",
                "1 of 4 bodies stands still: the motion grew beyond all numbers. Undo what came before, or grab or change it.",
            ]
        );
        assert!(lines.iter().all(|line| line.figures.starts_with("since 3.2\u{a0}s: ")));
        let offers: Vec<bool> = lines.iter().map(|line| line.offer.is_some()).collect();
        assert_eq!(offers, [true, false, false]);
        let movers = Movers { moved: vec![moved(Why::Contact, 3)], islands: 3, can_be_exact: false };
        let figures = Figures { movers: Arc::new(movers), ..Figures::default() };
        assert!(words(&figures)[0].starts_with("All 3 bodies can touch others"));
        let joined = Moved { since: [3.25, 48.0], ..moved(Why::Contact, 3) };
        let behind = told(&joined, 3).figures;
        assert!(behind.starts_with("since 3.2\u{a0}s, the last since 48.0\u{a0}s: the live step"), "{behind}");
        assert_eq!(super::lines(&figures)[0].offer, None);
    }

    #[test]
    fn what_gave_way_is_said_with_its_cause_and_the_way_back() {
        let yielded = Yielded { rung: Rung::Order, since: 12.0, work: Some(0.041) };
        let lines = lines(&Figures { yielded: Some(yielded), ..Figures::default() });
        assert_eq!(lines[0].figures, "order 2 in place of 4 since 12.0\u{a0}s: 41 ms of work a frame");
        assert_eq!(lines[0].offer.as_ref().map(|offer| &offer.2), Some(&Wish::TakeBack));
        let followed = Figures { yielded: Some(Yielded { work: None, ..yielded }), ..Figures::default() };
        assert_eq!(super::lines(&followed)[0].figures, "order 2 in place of 4 since 12.0\u{a0}s");
    }

    #[test]
    fn what_the_live_step_did_of_late_is_said_in_plain_words() {
        let acts = Acts { cut: 3, guarded: 1, mends: true, parts: true, settles: true };
        let lines = lines(&Figures { acts, ..Figures::default() });
        let behind: Vec<&str> = lines.iter().map(|line| line.figures.as_str()).take(2).collect();
        assert_eq!(behind, ["3 times within a second", "once within a second"]);
        assert_eq!(lines.len(), 5);
        for line in lines {
            let jargon = ["live step", "island", "order", "substep", "energy"];
            assert!(jargon.iter().all(|word| !line.words.contains(word)), "{}", line.words);
        }
    }
}
