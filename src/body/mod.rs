//! Makers of points and bonds.
