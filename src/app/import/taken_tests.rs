//! What is taken of a picture, and how that is shown.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]

use std::sync::Arc;
use std::time::{Duration, Instant};

use egui::{Event, Modifiers, PointerButton, Pos2, Rect, Shape};

use super::{Answer, Import};
use crate::app::matter::{Among, Bearings, Preset};
use crate::app::player::{Order, Shown, Stage};
use crate::picture::{Picture, Size, Threshold};
use crate::scene::{Material, Matter, Scene};
use crate::sim::PointId;

/// An opaque grey picture, whose lightness is told by where its pixels are, from 0 to 1 along both sides.
fn grey(light: impl Fn(f64, f64) -> f64) -> Arc<Picture> {
    let [width, height] = [96_u32, 64];
    let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let rgba = pixels.flat_map(|(x, y)| {
        let value = (255.0 * light(f64::from(x) / 96.0, f64::from(y) / 64.0)) as u8;
        [value, value, value, 255]
    });
    Arc::new(Picture { width, height, rgba: rgba.collect() })
}

/// A blot on paper, and a photograph that fills its frame.
fn blot() -> Arc<Picture> {
    grey(|x, y| if (x - 0.5).hypot(y - 0.5) < 0.3 { 0.1 } else { 0.95 })
}

fn photograph() -> Arc<Picture> {
    grey(|x, y| 0.2 + 0.6 * x * y + 0.1 * y)
}

/// An import's panel on a screen of its own.
struct Screen {
    context: egui::Context,
    import: Import,
    /// The scene beside it takes bodies.
    can_add: bool,
    answer: Option<Answer>,
}

impl Screen {
    fn of(picture: Arc<Picture>) -> Self {
        let import = Import::of_picture("picture".to_owned(), picture, || ());
        let mut screen = Screen { context: egui::Context::default(), import, can_add: true, answer: None };
        screen.settle();
        screen
    }

    /// Waits until it is cut out and shown.
    fn settle(&mut self) {
        let start = Instant::now();
        while self.import.worker.at_work.is_some() {
            _ = self.import.poll();
            assert!(start.elapsed() < Duration::from_secs(20), "it is never cut out");
            std::thread::sleep(Duration::from_millis(1));
        }
        (0..3).for_each(|_| _ = self.frame(Vec::new()));
    }

    fn frame(&mut self, events: Vec<Event>) -> Vec<Shape> {
        let screen_rect = Some(Rect::from_min_size(Pos2::ZERO, egui::vec2(1280.0, 720.0)));
        let input = egui::RawInput { screen_rect, events, ..Default::default() };
        let show = |ui: &mut egui::Ui| self.answer = self.import.show(ui.ctx(), self.can_add).or(self.answer);
        let mut output = self.context.run_ui(input, show);
        output.textures_delta.clear();
        output.shapes.into_iter().map(|clipped| clipped.shape).collect()
    }

    fn says(&mut self, words: &str) -> Option<Pos2> {
        self.frame(Vec::new()).into_iter().find_map(|shape| match shape {
            Shape::Text(text) if text.galley.text() == words => Some(text.visual_bounding_rect().center()),
            _ => None,
        })
    }

    fn click(&mut self, words: &str) {
        let pos = self.says(words).unwrap_or_else(|| panic!("{words} is not there"));
        let button = |pressed| {
            let (button, modifiers) = (PointerButton::Primary, Modifiers::NONE);
            Event::PointerButton { pos, button, pressed, modifiers }
        };
        for event in [Event::PointerMoved(pos), button(true), button(false)] {
            self.frame(vec![event]);
        }
        self.settle();
    }

    /// The share of the picture that is shown as bright as it is, beside all of it, which is dim.
    fn bright(&mut self) -> f32 {
        let textured = self.frame(Vec::new()).into_iter().filter_map(|shape| match shape {
            Shape::Mesh(mesh) if mesh.texture_id != egui::TextureId::default() => {
                let triangles = mesh.indices.chunks_exact(3).map(|corners| {
                    let [a, b, c] = [0, 1, 2].map(|k| mesh.vertices[corners[k] as usize].pos);
                    0.5 * ((b - a).x * (c - a).y - (b - a).y * (c - a).x).abs()
                });
                Some((mesh.vertices[0].color.r(), triangles.sum::<f32>()))
            }
            _ => None,
        });
        let textured: Vec<(u8, f32)> = textured.collect();
        let [(dim, whole), (light, bright)] = textured[..] else { panic!("{textured:?}") };
        assert!(light > 2 * dim, "what is taken stands out: {textured:?}");
        bright / whole
    }
}

#[test]
fn a_drawing_is_cut_out_and_a_photograph_without_ground_is_taken_whole_which_one_click_changes() {
    let mut drawn = Screen::of(blot());
    assert_eq!(drawn.import.wish.settings.threshold, Threshold::Otsu);
    assert!(drawn.says("it stands out from light ground").is_some());
    let share = std::f32::consts::PI * 0.3 * 0.3;
    assert!((drawn.bright() - share).abs() < 0.03, "the blot is bright: {}", drawn.bright());
    let before = drawn.import.wish.settings.size;
    drawn.click("the whole picture");
    assert_eq!(drawn.import.wish.settings.threshold, Threshold::Whole);
    assert!((drawn.bright() - 1.0).abs() < 0.01 && drawn.says("all of it, its ground too").is_some());
    drawn.click("what stands out");
    assert_eq!((drawn.import.wish.settings.threshold, drawn.import.wish.settings.size), (Threshold::Otsu, before));

    let mut photograph = Screen::of(photograph());
    assert_eq!(photograph.import.wish.settings.threshold, Threshold::Whole);
    assert!((photograph.bright() - 1.0).abs() < 0.01);
    assert!(photograph.says("no even ground that a shape stands out from: all is taken").is_some());
    let points = photograph.import.coming();
    assert!((200..900).contains(&points), "{points}");
    photograph.import.wish.settings.size = Size::Spacing(9.0);
    photograph.click("what stands out");
    assert!(photograph.bright() < 0.9 && photograph.import.wish.settings.size == Size::Spacing(9.0));
}

#[test]
fn beside_a_scene_in_space_it_is_said_that_a_picture_opens_by_itself() {
    let mut screen = Screen::of(blot());
    let words = "Bodies of pictures lie in the plane: beside a scene in space it opens by itself.";
    assert!(screen.says(words).is_none() && screen.says("Add to this scene").is_some());
    screen.can_add = false;
    screen.frame(Vec::new());
    let place = screen.says(words).unwrap();
    assert!(Rect::from_min_size(Pos2::ZERO, egui::vec2(1280.0, 720.0)).contains(place), "it is in view: {place:?}");
}

#[test]
fn why_nothing_can_be_brought_is_said_beside_the_buttons_that_are_off() {
    let mut screen = Screen::of(blot());
    screen.import.wish.settings.threshold = Threshold::At(0.99);
    // What is wished for is cut out from the next frame on.
    let before = screen.import.wish;
    screen.import.worker.ask(&screen.import.picture, before);
    screen.settle();
    let why = screen.import.forecast.as_ref().and_then(|made| made.as_ref().err()).cloned().unwrap();
    let (said, add) = (screen.says(&why).unwrap(), screen.says("Add to this scene").unwrap());
    assert!((said.y - add.y).abs() < 60.0, "{why} at {said:?}, the button at {add:?}");
    screen.import.enter();
    screen.frame(Vec::new());
    assert_eq!(screen.answer, None, "nothing to bring");
}

#[test]
fn enter_does_what_the_first_button_does() {
    let mut screen = Screen::of(blot());
    screen.import.enter();
    screen.frame(Vec::new());
    assert_eq!(screen.answer.take(), Some(Answer::Add));
    screen.frame(Vec::new());
    assert_eq!(screen.answer, None, "once");
    screen.can_add = false;
    screen.import.enter();
    screen.frame(Vec::new());
    assert_eq!(screen.answer, Some(Answer::Open));
}

#[test]
fn a_matter_by_name_is_what_the_panel_of_what_is_selected_calls_it_and_a_number_is_none() {
    let mut screen = Screen::of(blot());
    // A firm jelly at first: its springs are to its mass as the law of matters by name has them, between soft jelly and what hardly gives.
    let material = screen.import.scene().unwrap().bodies[0].material.clone().unwrap();
    let firm = 0.75_f64.sqrt() * material.young.unwrap() / material.mass.unwrap();
    assert!((1000.0..1300.0).contains(&firm), "{firm} 1/s^2");
    for preset in [Preset::Jelly, Preset::Rubber, Preset::Wood, Preset::Steel] {
        screen.click(preset.name());
        assert_eq!(screen.import.wish.of, Some(preset));
        let scene = screen.import.scene().unwrap();
        let material = scene.bodies[0].material.clone().unwrap();
        let area = std::f64::consts::PI * 0.09 * 2.0 * 3.0;
        let all_of = preset.material(area, 1.0);
        assert!((material.mass.unwrap() / all_of.mass.unwrap() - 1.0).abs() < 0.05, "{material:?}, {area} m^2");
        let soft = |material: &Material| material.stiffness.map(|stiffness| stiffness / material.mass.unwrap());
        assert!(soft(&material).zip(soft(&all_of)).is_none_or(|(one, other)| (one / other - 1.0).abs() < 1e-9));
        assert_eq!((material.kind, material.color), (all_of.kind, None), "it keeps the colours of its picture");
        let mut stage = Stage::new(scene.into()).unwrap();
        let points = (0..stage.history().world().point_count() as u32).map(PointId).collect();
        stage.obey(Order::Inspect(Among { points, ..Among::default() }));
        let mut shown = Shown::default();
        stage.show(&mut shown);
        assert_eq!(shown.matter.unwrap().preset(), Some(preset));
    }
    screen.click("springs");
    assert_eq!((screen.import.wish.of, screen.import.wish.matter), (None, Matter::Soft));
}

#[test]
fn a_body_is_pressed_by_its_weight_by_the_same_share_at_any_height_until_a_stiffness_is_chosen() {
    let sags = [0.5, 2.0, 8.0].map(|height| {
        let mut screen = Screen::of(blot());
        screen.import.wish.grow(height);
        let mut stage = Stage::new(screen.import.scene().unwrap().into()).unwrap();
        let points = (0..stage.history().world().point_count() as u32).map(PointId).collect();
        stage.obey(Order::Inspect(Among { points, ..Among::default() }));
        let mut shown = Shown::default();
        stage.show(&mut shown);
        // A thousand times as heavy as it is: else it is not worth a word.
        let heavy = 1e3 * shown.matter.as_ref().unwrap().density().unwrap();
        Bearings::of(&shown).told(Some(heavy), None).unwrap().0
    });
    assert!(sags.iter().all(|sags_so| (sags_so / sags[1] - 1.0).abs() < 0.03), "{sags:?}");
    let mut wish = Screen::of(blot()).import.wish;
    wish.grow(3.0);
    assert!((wish.young - 2700.0).abs() < 1e-6, "in two digits: {}", wish.young);
    wish.young = 5000.0;
    wish.grow(1.0);
    assert_eq!((wish.young, wish.height), (5000.0, 1.0), "a number that was set stays");
}

#[test]
fn a_matter_by_name_is_weighed_as_it_is_cut_out_now_not_as_it_was_last() {
    let mut screen = Screen::of(blot());
    screen.click(Preset::Steel.name());
    let steel = |import: &Import| import.scene().unwrap().bodies[0].material.as_ref().unwrap().mass.unwrap();
    let before = steel(&screen.import);
    // All of it is taken, and nobody has looked how much that is.
    screen.import.wish.settings.threshold = Threshold::Whole;
    let after = steel(&screen.import);
    assert!(after > 2.0 * before, "{before} kg, then {after} kg");
    let text = r#"{"wobble": 1, "points": {"position": [[9, 9]]}}"#;
    let mut stage = Stage::new(Scene::parse(text, "x.json").unwrap().into()).unwrap();
    stage.obey(Order::Add(Box::new(screen.import.adder([[-3.0, -3.0], [3.0, 3.0]]))));
    let mass: f64 = stage.history().world().masses()[1..].iter().sum();
    assert!((mass / after - 1.0).abs() < 1e-3, "{mass} kg of {after} kg");
}

#[test]
fn a_piece_of_a_picture_is_called_as_the_picture_is() {
    let mut picture = Picture::filled(120, 60, [0; 4]);
    for (i, pixel) in picture.rgba.chunks_exact_mut(4).enumerate() {
        let [x, y] = [i % 120, i / 120];
        if (5..55).contains(&y) && ((5..55).contains(&x) || (65..115).contains(&x)) {
            pixel.copy_from_slice(&[20, 20, 20, 255]);
        }
    }
    let mut import = Import::of_picture("cat".to_owned(), Arc::new(picture), || ());
    assert_eq!(import.scene().unwrap().body_names().unwrap(), [Some("cat".to_owned())]);
    import.wish.apart = true;
    assert_eq!(import.scene().unwrap().body_names().unwrap(), vec![Some("cat".to_owned()); 2]);
}
