//! Several pictures in one, side by side, for those who have room for one only.

use super::Picture;

/// Longest side of an atlas but for the gaps `[px]`: pictures are shrunk to fit.
const SIDE: u32 = 4096;
/// Clear pixels beside each picture: what is drawn of one takes nothing of its neighbour.
const GAP: u32 = 4;

/// Pictures side by side in one.
#[derive(Clone, Debug, PartialEq)]
pub struct Atlas {
    /// All of them.
    pub picture: Picture,
    /// Left, top, width and height of each `[px]`.
    places: Vec<[u32; 4]>,
}

impl Atlas {
    /// Lays pictures out in rows of a square, each in a cell of the same size.
    ///
    /// Valid range: one picture stays as it is, whatever its size; more are shrunk to a side of 4096 in all. None at all
    /// give a clear one.
    pub fn new(pictures: &[&Picture]) -> Self {
        if let [one] = pictures {
            return Atlas { picture: (*one).clone(), places: vec![[0, 0, one.width, one.height]] };
        }
        let columns = (1..).find(|side| side * side >= pictures.len()).unwrap_or(1);
        let shrunk: Vec<Picture> = pictures.iter().map(|one| one.shrunk((SIDE / columns as u32).max(1))).collect();
        let largest = |side: fn(&Picture) -> u32| shrunk.iter().map(side).max().unwrap_or(0) + GAP;
        let cell = [largest(|one| one.width), largest(|one| one.height)];
        let rows = pictures.len().div_ceil(columns) as u32;
        let mut picture = Picture::filled(columns as u32 * cell[0], rows.max(1) * cell[1], [0; 4]);
        let mut places = Vec::new();
        for (k, one) in shrunk.iter().enumerate() {
            let [left, top] = [(k % columns) as u32 * cell[0], (k / columns) as u32 * cell[1]];
            for (y, row) in (top..).zip(one.rgba.chunks_exact(4 * one.width as usize)) {
                let start = 4 * (y as usize * picture.width as usize + left as usize);
                picture.rgba[start..start + row.len()].copy_from_slice(row);
            }
            places.push([left, top, one.width, one.height]);
        }
        Atlas { picture, places }
    }

    /// Where a place in the picture of this number, (0, 0) to (1, 1), lies in the atlas; beyond its edge the edge is taken.
    pub fn place(&self, number: usize, at: [f32; 2]) -> [f64; 2] {
        let Some(&[left, top, width, height]) = self.places.get(number) else { return [0.0; 2] };
        let along = |at: f32, from: u32, length: u32, whole: u32| {
            (f64::from(from) + f64::from(at.clamp(0.0, 1.0)) * f64::from(length)) / f64::from(whole)
        };
        [along(at[0], left, width, self.picture.width), along(at[1], top, height, self.picture.height)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_picture_has_its_place() {
        let colours = [[200, 0, 0, 255], [0, 200, 0, 255], [0, 0, 200, 255]];
        let pictures = [(30, 10), (5, 40), (8, 8)];
        let pictures: Vec<Picture> = pictures
            .iter()
            .zip(colours)
            .map(|(&(width, height), colour)| Picture::filled(width, height, colour))
            .collect();
        let atlas = Atlas::new(&pictures.iter().collect::<Vec<_>>());
        assert_eq!((atlas.picture.width, atlas.picture.height), (68, 88));
        for (k, colour) in colours.into_iter().enumerate() {
            for at in [[0.02, 0.02], [0.98, 0.5], [0.5, 0.99]] {
                let [u, v] = atlas.place(k, at);
                let pixel = (v * 88.0) as usize * 68 + (u * 68.0) as usize;
                assert_eq!(atlas.picture.rgba[4 * pixel..][..4], colour, "{k} at {at:?}");
            }
        }
    }

    #[test]
    fn one_stays_as_it_is_and_many_are_bounded() {
        let one = Picture::filled(5000, 3, [1, 2, 3, 4]);
        assert_eq!(Atlas::new(&[&one]).picture, one);
        assert_eq!(Atlas::new(&[&one]).place(0, [0.5, 0.25]), [0.5, 0.25]);
        let many = Atlas::new(&[&one; 10]).picture;
        assert!(many.width <= SIDE + 4 * GAP && many.height < 40, "{} x {}", many.width, many.height);
        assert!(Atlas::new(&[]).picture.rgba.iter().all(|&part| part == 0));
    }
}
