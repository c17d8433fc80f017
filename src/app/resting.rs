//! The cursor in the world while the pointer rests: a view that changes under it leads the cursor through no body.

use crate::render::Camera;
use crate::sim::Cursor;

/// A place of the world that lies so near to a pixel is under it `[px]`: views are put together from numbers that round.
const SAME: f64 = 0.5;

/// Where the pointer was when the world was told of its cursor last, and what became of that.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Resting {
    /// The pointer `[px]`, and the cursor; `None`: it was away.
    last: Option<([f64; 2], Option<Cursor>)>,
    /// Time has stood still since.
    stood: bool,
}

/// Where the cursor goes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Way {
    /// `None`: it is away.
    pub(super) to: Option<Cursor>,
    /// It is there at once: nothing lies on its way.
    pub(super) jumps: bool,
}

/// What the pointer is doing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Pointing {
    /// Nothing lies between it and the world.
    pub(super) is_free: bool,
    /// Something is grabbed: it stays where it is in the world.
    pub(super) grabs: bool,
}

impl Resting {
    /// Where the cursor goes with the pointer at a pixel of a camera's. While the pointer rests it stays where it is in the world, and
    /// goes away where the view shows another place there, or something lay over the world; it comes back as a new one as soon as the
    /// pointer moves.
    pub(super) fn way(&self, camera: &Camera, at: Option<[f64; 2]>, pointing: Pointing) -> Way {
        let Some(at) = at.filter(|_| pointing.is_free) else { return Way::default() };
        match self.last {
            Some((pixel, was)) if pixel == at => {
                let to = was.filter(|was| pointing.grabs || is_under(camera, at, was));
                Way { to, jumps: false }
            }
            Some((pixel, Some(was))) => {
                let jumps = !pointing.grabs && (self.stood || !is_under(camera, pixel, &was));
                Way { to: Some(camera.cursor(at)), jumps }
            }
            _ => Way { to: Some(camera.cursor(at)), jumps: true },
        }
    }

    /// The world is told where the cursor goes, with the pointer at a pixel.
    pub(super) fn tell(&mut self, at: Option<[f64; 2]>, way: Way) {
        *self = Resting { last: at.map(|at| (at, way.to)), stood: false };
    }

    /// Time stands still: where the pointer goes meanwhile is no way through the world.
    pub(super) fn stand(&mut self) {
        self.stood = true;
    }

    /// A button went down at a pixel: a cursor that was away is there.
    pub(super) fn press(&mut self, at: [f64; 2]) {
        self.last.take_if(|(pixel, was)| *pixel == at && was.is_none());
    }
}

/// Whether a cursor is what a pixel of a camera's points to.
fn is_under(camera: &Camera, at: [f64; 2], cursor: &Cursor) -> bool {
    let here = camera.cursor(at);
    let [from, along, origin, direction] =
        [here.origin, here.direction, cursor.origin, cursor.direction].map(glam::DVec3::from);
    let between = origin - from;
    let beside = (between - along * between.dot(along)).length() * camera.pixels_per_metre();
    let turned = along.cross(direction).length() * f64::from(camera.viewport()[1] as u32);
    beside < SAME && turned < SAME
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::Pose;
    use glam::{DVec2, DVec3};

    const FREE: Pointing = Pointing { is_free: true, grabs: false };
    const GRABS: Pointing = Pointing { is_free: true, grabs: true };
    const COVERED: Pointing = Pointing { is_free: false, grabs: false };
    const AT: [f64; 2] = [900.0, 300.0];

    fn plane() -> Camera {
        Camera::new(Pose::Plane { center: DVec2::new(1.0, 2.0), height: 4.0 }, [1280, 720])
    }

    fn space() -> Camera {
        Camera::new(Pose::Orbit { target: DVec3::Y, distance: 5.0, yaw: 0.4, pitch: 0.3 }, [1280, 720])
    }

    /// A frame: the world is told. Returns what.
    fn frame(resting: &mut Resting, camera: &Camera, at: [f64; 2], pointing: Pointing) -> Way {
        let way = resting.way(camera, Some(at), pointing);
        resting.tell(Some(at), way);
        way
    }

    #[test]
    fn a_view_that_changes_under_a_pointer_at_rest_takes_the_cursor_away_until_the_pointer_moves() {
        for camera in [plane(), space()] {
            let mut resting = Resting::default();
            let first = frame(&mut resting, &camera, AT, FREE);
            assert_eq!(first, Way { to: Some(camera.cursor(AT)), jumps: true });
            let moved = frame(&mut resting, &camera, [910.0, 300.0], FREE);
            assert_eq!(moved, Way { to: Some(camera.cursor([910.0, 300.0])), jumps: false }, "a way through the world");
            let mut other = camera;
            other.pan([30.0, 0.0]);
            assert_eq!(frame(&mut resting, &other, [910.0, 300.0], FREE).to, None);
            // Whether the view comes back or not.
            assert_eq!(frame(&mut resting, &camera, [910.0, 300.0], FREE).to, None);
            let back = frame(&mut resting, &other, [911.0, 300.0], FREE);
            assert_eq!(back, Way { to: Some(other.cursor([911.0, 300.0])), jumps: true });
        }
    }

    #[test]
    fn a_pointer_that_moves_as_the_view_changes_jumps() {
        let (camera, mut resting) = (plane(), Resting::default());
        frame(&mut resting, &camera, AT, FREE);
        let mut other = camera;
        other.pan([-200.0, 0.0]);
        assert!(frame(&mut resting, &other, [901.0, 300.0], FREE).jumps);
        assert!(!frame(&mut resting, &other, [902.0, 300.0], FREE).jumps);
    }

    #[test]
    fn the_wheel_keeps_the_cursor_to_the_last_bit() {
        for camera in [plane(), space()] {
            let mut resting = Resting::default();
            let was = frame(&mut resting, &camera, AT, FREE).to;
            let mut other = camera;
            for _ in 0..20 {
                other.zoom_at(AT, 1.12);
                assert_eq!(frame(&mut resting, &other, AT, FREE), Way { to: was, jumps: false });
            }
        }
    }

    #[test]
    fn what_is_grabbed_stays_where_it_is_until_the_pointer_moves() {
        let (camera, mut resting) = (plane(), Resting::default());
        let was = frame(&mut resting, &camera, AT, FREE).to;
        let mut other = camera;
        other.pan([-200.0, 0.0]);
        assert_eq!(frame(&mut resting, &other, AT, GRABS), Way { to: was, jumps: false });
        let led = frame(&mut resting, &other, [901.0, 300.0], GRABS);
        assert_eq!(led, Way { to: Some(other.cursor([901.0, 300.0])), jumps: false }, "it is led there");
        assert_eq!(frame(&mut resting, &camera, [901.0, 300.0], FREE).to, None, "let go of");
    }

    #[test]
    fn what_lay_over_the_world_gives_it_back_to_a_pointer_that_moves_or_presses() {
        let (camera, mut resting) = (plane(), Resting::default());
        frame(&mut resting, &camera, AT, FREE);
        assert_eq!(frame(&mut resting, &camera, AT, COVERED).to, None);
        assert_eq!(frame(&mut resting, &camera, AT, FREE).to, None, "a panel closed over a pointer at rest");
        resting.press(AT);
        assert_eq!(frame(&mut resting, &camera, AT, FREE).to, Some(camera.cursor(AT)));
        resting.tell(None, Way::default());
        assert_eq!(frame(&mut resting, &camera, AT, FREE).to, Some(camera.cursor(AT)), "it came into the window again");
    }

    #[test]
    fn where_the_pointer_goes_while_time_stands_still_is_no_way() {
        let (camera, mut resting) = (plane(), Resting::default());
        frame(&mut resting, &camera, AT, FREE);
        resting.stand();
        assert_eq!(resting.way(&camera, Some(AT), FREE), Way { to: Some(camera.cursor(AT)), jumps: false });
        assert!(frame(&mut resting, &camera, [200.0, 300.0], FREE).jumps);
        assert!(!frame(&mut resting, &camera, [210.0, 300.0], FREE).jumps);
    }
}
