//! A picture becomes a soft body that falls into a box; what it looks like where it lands is drawn off-screen.
//!
//! `cargo run --release --example picture_body -- assets/pictures/jellyfish.png body.png`

use std::error::Error;
use std::path::Path;

use wobble::app::opening;
use wobble::picture::{Settings, Size};
use wobble::render::{Capture, Look, View};
use wobble::scene::{BodyKeys, Matter, Scene, record};

/// Width and height of what is drawn [px].
const SIZE: [u32; 2] = [720, 440];
/// Distance of neighbours in the mesh [px].
const SPACING: f64 = 16.0;
/// Height of the picture in the world [m].
const HEIGHT: f64 = 2.0;
/// When it is drawn [s].
const TIME: f64 = 0.6;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let picture = arguments.next().unwrap_or_else(|| "assets/pictures/jellyfish.png".to_owned());
    let out = arguments.next().unwrap_or_else(|| "body.png".to_owned());
    draw(Path::new(&picture), Path::new(&out))
}

/// Writes what the body of a picture looks like after its fall.
///
/// Errors: no picture, no ink, no GPU, or a file that cannot be written.
pub(crate) fn draw(picture: &Path, out: &Path) -> Result<(), Box<dyn Error>> {
    let settings = Settings { size: Size::Spacing(SPACING), ..Settings::default() };
    let keys = BodyKeys::cut(&settings, HEIGHT, &*Scene::picture_file(picture)?);
    let scene = Scene::of_picture(picture, keys, Matter::Soft)?;
    let mut world = scene.world(None)?;
    record::run_to(&mut *world, TIME, &mut |_| ())?;

    let skins = scene.skins()?;
    let view = View { skins: &skins, ..View::of(&*world) };
    let camera = opening::camera(&scene, &view, SIZE);
    let mut capture = Capture::new(SIZE, scene.dimensions())?;
    capture.picture(&view, &camera, &Look::default())?.save(out)?;
    Ok(())
}
