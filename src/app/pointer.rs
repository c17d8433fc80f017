//! The pointer: where it is, and how it drags and zooms the picture.

use winit::event::{ElementState, MouseButton, MouseScrollDelta};

use crate::render::{Camera, Pose};

/// Zoom of one notch of the wheel.
const NOTCH: f64 = 1.12;
/// Pixels of a touchpad's scroll that count as a notch.
const NOTCH_PIXELS: f64 = 40.0;

/// The pointer: where it is and what it drags.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pointer {
    /// Where it is `[px]`; `None` outside the window.
    pub at: Option<[f64; 2]>,
    drag: Option<MouseButton>,
}

impl Pointer {
    /// It moved; drags the camera if a button is down: right or middle pans, right orbits in space. Returns whether the
    /// camera changed.
    pub fn move_to(&mut self, at: [f64; 2], camera: &mut Camera) -> bool {
        let last = self.at.replace(at);
        let (Some(button), Some(last)) = (self.drag, last) else { return false };
        let by = [at[0] - last[0], at[1] - last[1]];
        match (button, camera.pose) {
            (MouseButton::Right, Pose::Orbit { .. }) => camera.orbit(by),
            _ => camera.pan(by),
        }
        true
    }

    /// A button went down or up: right and middle drag.
    pub fn press(&mut self, button: MouseButton, state: ElementState) {
        match state {
            ElementState::Pressed if matches!(button, MouseButton::Right | MouseButton::Middle) => {
                self.drag = Some(button);
            }
            ElementState::Released if self.drag == Some(button) => self.drag = None,
            _ => {}
        }
    }

    /// It left the window. A drag goes on when it comes back.
    pub fn leave(&mut self) {
        self.at = None;
    }

    /// Whether it drags the camera.
    pub fn is_dragging(&self) -> bool {
        self.drag.is_some()
    }

    /// The wheel turned with the pointer at a pixel of a camera's: it zooms there.
    pub fn scroll(at: [f64; 2], delta: MouseScrollDelta, camera: &mut Camera) {
        let notches = match delta {
            MouseScrollDelta::LineDelta(_, y) => f64::from(y),
            MouseScrollDelta::PixelDelta(by) => by.y / NOTCH_PIXELS,
        };
        camera.zoom_at(at, NOTCH.powf(notches.clamp(-20.0, 20.0)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec2;

    #[test]
    fn a_drag_takes_the_plane_along() {
        let pose = Pose::Plane { center: DVec2::ZERO, height: 10.0 };
        let mut camera = Camera::new(pose, [1000, 1000]);
        let mut pointer = Pointer::default();
        assert!(!pointer.move_to([500.0, 500.0], &mut camera));
        pointer.press(MouseButton::Right, ElementState::Pressed);
        assert!(pointer.move_to([600.0, 500.0], &mut camera));
        pointer.press(MouseButton::Right, ElementState::Released);
        pointer.move_to([900.0, 900.0], &mut camera);
        assert_eq!(camera.pose, Pose::Plane { center: DVec2::new(-1.0, 0.0), height: 10.0 });
        Pointer::scroll([900.0, 900.0], MouseScrollDelta::LineDelta(0.0, 1.0), &mut camera);
        assert!(camera.height() < 10.0);
    }
}
