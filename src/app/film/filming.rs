//! A clip of the last seconds, drawn and written beside the window by the renderer that draws in it.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, TryRecvError, channel};
use std::time::Duration;

use super::{Film, Gif, Shot, scale_factor};
use crate::app::aside::Aside;
use crate::history::Reel;
use crate::output::replace;
use crate::render::{Color, Gpu, Look};

/// Pictures a second.
const FPS: f64 = 25.0;
/// What of the work is the way to where trails begin, about, and what that to the first picture is as well.
const APPROACH_SHARE: f64 = 0.15;
const LEAD_SHARE: f64 = 0.2;
/// Parts in which it is told how far it is.
const PARTS: f64 = 100.0;
/// So often it is asked whether a clip is still wanted, while what it is of is on its way.
const ASKED_EVERY: Duration = Duration::from_millis(50);

/// How long a clip is at most, and how wide.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::app) struct ClipSettings {
    /// `[s of wall time]` at the scene's own pace.
    pub(in crate::app) seconds: f64,
    /// `[px]`
    pub(in crate::app) width: u32,
}

impl Default for ClipSettings {
    fn default() -> Self {
        ClipSettings { seconds: 5.0, width: 640 }
    }
}

impl ClipSettings {
    /// The shortest and the longest clip `[s]`.
    pub(in crate::app) const SECONDS: [f64; 2] = [0.5, 60.0];
    /// The narrowest and the widest `[px]`.
    pub(in crate::app) const WIDTHS: [u32; 2] = [64, 1920];

    /// Width and height of its pictures, of a view of this size `[px]`, within what can be set.
    pub(in crate::app) fn size(self, [width, height]: [u32; 2]) -> [u32; 2] {
        let wide = self.width.clamp(ClipSettings::WIDTHS[0], ClipSettings::WIDTHS[1]);
        let tall = f64::from(wide) * f64::from(height.max(1)) / f64::from(width.max(1));
        [wide, tall.round().max(1.0) as u32]
    }

    /// The times of its pictures, of a run from `from` to `to` `[s]` at this rate: the last is that of its end.
    pub(in crate::app) fn times(self, [from, to]: [f64; 2], rate: f64) -> Vec<f64> {
        let seconds = self.seconds.clamp(ClipSettings::SECONDS[0], ClipSettings::SECONDS[1]);
        let apart = rate / FPS;
        let most = (seconds * FPS).round().max(1.0);
        let count = ((to - from) / apart + 1.0).floor().clamp(1.0, most) as u32;
        (0..count).map(|k| (to - f64::from(count - 1 - k) * apart).max(from)).collect()
    }
}

/// How worlds look in the pictures of a clip of this size `[px]`: as in the window, without the numbers of the grid and without the region of a force
/// that is the hand's; one that goes along a track of the scene is seen.
pub(in crate::app) fn look_of_clip(look: Look, size: [u32; 2], is_of_hand: bool) -> Look {
    let clear = |[red, green, blue, _]: Color| [red, green, blue, 0.0];
    let region = if is_of_hand { clear(look.region) } else { look.region };
    // Nothing stands at the left edge there.
    Look { number: clear(look.number), region, scale_factor: scale_factor(size), inset: 0.0, ..look }
}

/// What became of a clip.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::app) enum Filmed {
    /// It is written.
    Written,
    /// It was given up: what stood there before is untouched.
    GivenUp,
    /// So it is where it cannot be drawn or written, in words.
    Failed(String),
}

/// What the window and the thread that draws share.
#[derive(Default)]
struct Shared {
    /// Whether it is given up, or goes to its file: whichever came first.
    is_settled: AtomicBool,
    /// How many parts are done.
    done: AtomicU32,
}

/// A clip on its way.
pub(in crate::app) struct Filming {
    path: PathBuf,
    shared: Arc<Shared>,
    filmed: Receiver<Filmed>,
    aside: Aside,
}

impl Filming {
    /// Draws a clip of what `reel` brings on a thread of its own, and writes it there. `wake` is called as it goes on, and at its end.
    pub(in crate::app) fn new(
        (gpu, shot): (Gpu, Shot),
        reel: Receiver<Reel>,
        settings: ClipSettings,
        path: PathBuf,
        wake: impl Fn() + Send + 'static,
    ) -> Self {
        let (shared, (sender, filmed)) = (Arc::<Shared>::default(), channel());
        let (told, to) = (Arc::clone(&shared), path.clone());
        let aside = Aside::new(wake, move |is_wanted, wake| {
            let mut goes_on = |share: f64| {
                let done = (PARTS * share) as u32;
                if told.done.swap(done, Ordering::Relaxed) != done {
                    wake();
                }
                is_wanted() && !told.is_settled.load(Ordering::Relaxed)
            };
            let drawn = awaited(&reel, &mut || goes_on(0.0)).and_then(|reel| match reel {
                Some(reel) => drawn_of(reel, (gpu, shot), settings, &mut goes_on),
                None => Ok(None),
            });
            // A window that has been closed hears no more.
            let drawn = drawn.map(|bytes| bytes.filter(|_| !told.is_settled.swap(true, Ordering::Relaxed)));
            let _ = sender.send(drawn.and_then(|bytes| written(bytes, &to)).unwrap_or_else(Filmed::Failed));
        });
        Filming { path, shared, filmed, aside }
    }

    /// Where it is written.
    pub(in crate::app) fn path(&self) -> &Path {
        &self.path
    }

    /// How much of it is done, 0 to 1.
    pub(in crate::app) fn share(&self) -> f32 {
        (f64::from(self.shared.done.load(Ordering::Relaxed)) / PARTS) as f32
    }

    /// It is not wanted any more. Returns whether that comes in time, and for the first time: nothing is written then, though the thread may
    /// end later.
    pub(in crate::app) fn give_up(&self) -> bool {
        !self.shared.is_settled.swap(true, Ordering::Relaxed)
    }

    /// The thread that draws it.
    pub(in crate::app) fn into_aside(self) -> Aside {
        self.aside
    }

    /// What became of it, once that is known.
    pub(in crate::app) fn take(&self) -> Option<Filmed> {
        match self.filmed.try_recv() {
            Ok(filmed) => Some(filmed),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => Some(Filmed::Failed(BROKEN.to_owned())),
        }
    }
}

/// Said where nothing is left of what was to be drawn.
const GONE: &str = "no clip was written: what it is of is gone";
/// Said where the thread that drew it panicked.
const BROKEN: &str = "no clip was written: it could not be drawn to its end";

/// What a clip is of, once it comes; `None`: `is_wanted` says no before that.
///
/// Errors: in words, what brings it is gone with the scene.
fn awaited(reel: &Receiver<Reel>, is_wanted: &mut dyn FnMut() -> bool) -> Result<Option<Reel>, String> {
    loop {
        match reel.recv_timeout(ASKED_EVERY) {
            Ok(reel) => return Ok(Some(reel)),
            Err(RecvTimeoutError::Disconnected) => return Err(GONE.to_owned()),
            Err(RecvTimeoutError::Timeout) if is_wanted() => {}
            Err(RecvTimeoutError::Timeout) => return Ok(None),
        }
    }
}

/// Writes a clip, where it was not given up.
fn written(bytes: Option<Vec<u8>>, path: &Path) -> Result<Filmed, String> {
    let Some(bytes) = bytes else { return Ok(Filmed::GivenUp) };
    replace(path, |file| file.write_all(&bytes)).map_err(|error| error.to_string())?;
    Ok(Filmed::Written)
}

/// The bytes of a clip; `None`: `goes_on` says no, which is told how much of it is done, 0 to 1.
///
/// Errors: in words, why it cannot be drawn.
fn drawn_of(
    reel: Reel,
    (gpu, shot): (Gpu, Shot),
    settings: ClipSettings,
    goes_on: &mut dyn FnMut(f64) -> bool,
) -> Result<Option<Vec<u8>>, String> {
    if !goes_on(0.0) {
        return Ok(None);
    }
    let Reel { recording, beside, run, span, rate } = reel;
    let times = settings.times(span, rate);
    let mut film = Film::new((&recording, run), &beside, Some(gpu), shot).map_err(|error| error.to_string())?;
    let first = times.first().copied().unwrap_or(span[1]);
    let trail = film.trail();
    let mut approaches = |share: f64| goes_on(APPROACH_SHARE * share);
    if !film.approach(first - trail, &mut approaches).map_err(|error| error.to_string())? {
        return Ok(None);
    }
    let mut leads_up = |share: f64| goes_on(APPROACH_SHARE + (LEAD_SHARE - APPROACH_SHARE) * share);
    if !film.lead_up(first, &mut leads_up).map_err(|error| error.to_string())? {
        return Ok(None);
    }
    let mut bytes = Vec::new();
    let mut gif = Gif::begin(&mut bytes, FPS).map_err(|error| error.to_string())?;
    for (k, time) in times.iter().enumerate() {
        if !goes_on(LEAD_SHARE + (1.0 - LEAD_SHARE) * k as f64 / times.len() as f64) {
            return Ok(None);
        }
        let picture = film.picture(*time).map_err(|error| error.to_string())?;
        gif.add(picture).map_err(|error| error.to_string())?;
    }
    drop(gif);
    Ok(goes_on(1.0).then_some(bytes))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use image::AnimationDecoder as _;
    use image::codecs::gif::GifDecoder;

    use super::*;
    use crate::app::opening;
    use crate::history::History;
    use crate::render::{Capture, Overlay, Palette, Tiles, View};
    use crate::scene::Scene;
    use crate::sim::{Cursor, MouseForce, PointId, Profile, Region, Track};

    const SIZE: [u32; 2] = [96, 64];

    #[test]
    fn a_clip_is_of_the_last_seconds_or_of_all_that_there_is() {
        let times = ClipSettings { seconds: 2.0, ..ClipSettings::default() }.times([0.0, 10.0], 1.0);
        assert_eq!((times.len(), times.last()), (50, Some(&10.0)));
        assert!((times[0] - (10.0 - 49.0 / 25.0)).abs() < 1e-12 && times.is_sorted(), "{times:?}");
        let slow = ClipSettings { seconds: 2.0, ..ClipSettings::default() }.times([0.0, 10.0], 0.5);
        assert!(slow.len() == 50 && (slow[49] - slow[48] - 0.02).abs() < 1e-12, "at the pace of the scene");
        let short = ClipSettings::default().times([3.0, 3.5], 1.0);
        assert_eq!((short.len(), short.last()), (13, Some(&3.5)));
        assert!(short[0] >= 3.0);
        assert_eq!(ClipSettings::default().times([3.0, 3.0], 1.0), [3.0]);
        let sizes = [[1180, 800], [1920, 1080], [300, 3000]].map(|area| ClipSettings::default().size(area));
        assert_eq!(sizes, [[640, 434], [640, 360], [640, 6400]]);
        assert_eq!(ClipSettings { width: 1, ..ClipSettings::default() }.size([100, 100]), [64, 64]);
    }

    /// A ball that falls for a second, and how it is looked at.
    fn falling() -> (History, Shot) {
        let text = r#"{"wobble": 1, "gravity": [0, -9.81], "points": {"position": [[0, 3], [0.5, 3], [0, 3.5]]},
            "bonds": [{"a": 0, "b": 1}, {"a": 1, "b": 2}, {"a": 2, "b": 0}], "view": {"center": [0, 1], "height": 5}}"#;
        let mut history = History::new(Scene::parse(text, "x.json").unwrap().into()).unwrap();
        while history.world().time() < 1.0 {
            history.step();
        }
        let camera = opening::camera(history.scene(), &View::of(history.world()), SIZE);
        let look = Look { scale_factor: scale_factor(SIZE), ..Look::in_palette(Palette::Dark) };
        let shot = Shot {
            tiles: Tiles::ALONE,
            camera,
            followed: None,
            look,
            beside: Overlay::None,
            palette: Palette::Dark,
            has_labels: false,
            followers: Box::new(|_| Vec::new()),
            trail: 1.0,
            size: SIZE,
        };
        (history, shot)
    }

    #[test]
    fn a_clip_shows_what_happened_and_ends_with_what_is_seen() {
        let Some(gpu) = Gpu::of_test() else { return };
        let (history, shot) = falling();
        let settings = ClipSettings { seconds: 0.5, ..ClipSettings::default() };
        let mut told = Vec::new();
        let mut goes_on = |share: f64| {
            told.push(share);
            true
        };
        let bytes = drawn_of(history.reel(0.5), (gpu, shot), settings, &mut goes_on).unwrap().unwrap();
        assert!(told.is_sorted() && told.last() == Some(&1.0), "{told:?}");
        let frames = GifDecoder::new(std::io::Cursor::new(bytes)).unwrap().into_frames().collect_frames().unwrap();
        assert_eq!(frames.len(), 13);
        assert_eq!(frames[0].buffer().dimensions(), (SIZE[0], SIZE[1]));
        assert_eq!(frames[0].delay().numer_denom_ms(), (40, 1));
        assert!(frames.windows(2).all(|pair| pair[0].buffer() != pair[1].buffer()), "it falls from picture to picture");
    }

    #[test]
    fn what_is_given_up_on_the_way_to_the_first_picture_goes_no_further() {
        let Some(gpu) = Gpu::of_test() else { return };
        let settings = ClipSettings { seconds: 0.5, ..ClipSettings::default() };
        // Before all, while worlds beside are led to the first, and while trails are.
        for last in [0.0, 0.5 * APPROACH_SHARE, 0.5 * (APPROACH_SHARE + LEAD_SHARE)] {
            let (history, shot) = falling();
            let shot = Shot { followers: Box::new(|_| vec![PointId(0)]), trail: 0.2, ..shot };
            let mut reel = history.reel(0.5);
            reel.beside = vec![serde_json::from_str(r#"{"method": {"substep": 0.005}}"#).unwrap()];
            let mut noes = 0;
            let mut goes_on = |share: f64| {
                noes += u32::from(share >= last);
                share < last
            };
            assert_eq!(drawn_of(reel, (gpu.clone(), shot), settings, &mut goes_on), Ok(None));
            assert_eq!(noes, 1, "nothing is asked after that");
        }
    }

    #[test]
    fn what_is_given_up_before_it_is_known_what_it_is_of_is_not_waited_for() {
        // What would bring it is there, and busy.
        let (sender, reel) = channel();
        let mut asked = 0;
        let mut is_wanted = || {
            asked += 1;
            asked < 2
        };
        assert!(matches!(awaited(&reel, &mut is_wanted), Ok(None)));
        assert_eq!(asked, 2);
        sender.send(falling().0.reel(0.5)).unwrap();
        assert!(matches!(awaited(&reel, &mut || false), Ok(Some(_))), "it is there");
        drop(sender);
        assert!(awaited(&reel, &mut || true).is_err_and(|why| why == GONE));
    }

    #[test]
    fn worlds_beside_are_led_from_the_start_a_little_at_a_time() {
        let Some(gpu) = Gpu::of_test() else { return };
        let (history, shot) = falling();
        let Reel { recording, run, .. } = history.reel(0.0);
        let beside = [serde_json::from_str(r#"{"method": {"substep": 0.005}}"#).unwrap()];
        let mut film = Film::new((&recording, run), &beside, Some(gpu), shot).unwrap();
        assert_eq!(film.beside.time(), Some(0.0));
        assert_eq!(film.approach(1.0, &mut |share| share < 0.5).map_err(|error| error.to_string()), Ok(false));
        assert!(film.beside.time().is_some_and(|time| (0.4..0.5).contains(&time)), "{:?}", film.beside.time());
    }

    #[test]
    fn a_clip_shows_neither_the_circle_of_the_hand_nor_the_numbers_of_the_grid() {
        let look = Look::in_palette(Palette::Dark);
        let clips = [true, false].map(|is_of_hand| look_of_clip(look, SIZE, is_of_hand));
        assert!(clips.iter().all(|clip| clip.number[3] == 0.0 && clip.has_grid && clip.inset == 0.0));
        assert_eq!(clips.map(|clip| clip.region[3]), [0.0, look.region[3]], "one on a track of the scene is seen");
        let Some(gpu) = Gpu::of_test() else { return };
        let (history, Shot { camera, .. }) = falling();
        let force = MouseForce {
            strength: 60.0,
            radius: 1.0,
            region: Region::default(),
            profile: Profile::default(),
            track: Track::default(),
        };
        let picture = |look: &Look, has_force: bool| {
            let mouse = has_force.then(|| (&force, Cursor::at([0.0, 1.0])));
            let view = View { mouse, ..View::of(history.world()) };
            Capture::on(gpu.clone(), SIZE, 2).unwrap().picture(&view, &camera, look).unwrap()
        };
        assert_ne!(picture(&look, true), picture(&look, false), "it is seen in the window");
        assert_eq!(picture(&clips[0], true), picture(&clips[0], false));
    }

    #[test]
    fn a_clip_that_is_given_up_leaves_what_stood_there() {
        let Some(gpu) = Gpu::of_test() else { return };
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("clip.gif");
        std::fs::write(&path, b"old").unwrap();
        let filmed = |is_given_up: bool| {
            let (history, shot) = falling();
            let (sender, reel) = channel();
            let settings = ClipSettings { seconds: 0.5, ..ClipSettings::default() };
            let filming = Filming::new((gpu.clone(), shot), reel, settings, path.clone(), || {});
            if is_given_up {
                assert!(filming.give_up() && !filming.give_up(), "once");
            }
            // One that was given up need not wait for it.
            sender.send(history.reel(0.5)).unwrap_or_default();
            (filming.filmed.recv().unwrap(), std::fs::read(&path).unwrap())
        };
        assert_eq!(filmed(true), (Filmed::GivenUp, b"old".to_vec()));
        let (outcome, bytes) = filmed(false);
        assert!(outcome == Filmed::Written && bytes.starts_with(b"GIF89a"), "{outcome:?}");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    }
}
