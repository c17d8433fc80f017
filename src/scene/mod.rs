//! Scene files and the gallery.
