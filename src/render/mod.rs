//! Drawing points and bonds on a GPU, in a window or off-screen.

pub mod view;
