//! Colours that corners of a skin are seen in: where painted ones are beside others they go softly from one to the other, for what a brush went over
//! ends at sides of triangles.

/// A colour as it is stored: red, green, blue.
pub(super) type Rgb = [u8; 3];

/// Share of what is beside a point in its colour `[1]`.
const BESIDE: f32 = 0.5;

/// The colour of each of so many points from `first` on: its own, mixed with the mean of those that triangles join it to where these differ.
pub(super) fn softened((first, count): (u32, usize), triangles: &[[u32; 3]], own: impl Fn(u32) -> Rgb) -> Vec<Rgb> {
    let mut colors: Vec<Rgb> = (0..count as u32).map(|place| own(first + place)).collect();
    if colors.iter().all(|color| *color == colors[0]) {
        return colors;
    }
    let mut sums = vec![([0.0_f32; 3], 0.0_f32); count];
    for [a, b, c] in triangles {
        for [to, from] in [[a, b], [b, c], [c, a], [b, a], [c, b], [a, c]] {
            let [to, from] = [to, from].map(|point| point.wrapping_sub(first) as usize);
            let Some(color) = colors.get(from).filter(|_| to < count) else { continue };
            let (sum, weight) = &mut sums[to];
            *sum = std::array::from_fn(|part| sum[part] + f32::from(color[part]));
            *weight += 1.0;
        }
    }
    for (color, (sum, weight)) in colors.iter_mut().zip(sums).filter(|(_, (_, weight))| *weight > 0.0) {
        for (part, sum) in color.iter_mut().zip(sum) {
            *part = (f32::from(*part) + BESIDE * (sum / weight - f32::from(*part))).round() as u8;
        }
    }
    colors
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_beside_each_other_are_mixed_and_others_are_as_they_were() {
        // Two triangles that share a side, and one apart.
        let triangles = [[4, 5, 6], [5, 7, 6], [8, 9, 10]];
        let own = |point: u32| if point == 4 || point > 7 { [200, 0, 0] } else { [0, 100, 0] };
        let seen = softened((4, 7), &triangles, own);
        assert_eq!(seen[0], [100, 50, 0], "both beside it are green");
        assert!(seen[1][0] > 0 && seen[1][0] < 100 && seen[1] == seen[2], "{seen:?}");
        assert_eq!((seen[3], seen[4]), ([0, 100, 0], [200, 0, 0]));
        assert_eq!(softened((0, 3), &[[0, 1, 2]], |_| [7, 8, 9]), [[7, 8, 9]; 3]);
        assert!(softened((0, 0), &[], |_| [0; 3]).is_empty());
    }
}
