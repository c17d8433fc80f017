//! A ragdoll: a figure seen from its right side, of rigid pieces that share the points at their joints.
//!
//! ```text
//! torso 6 points, head 5    the neck belongs to both, and both arms hang from it
//! upper arms 4, forearms 4  kites from joint to joint
//! thighs 4, shanks 5        both legs hang from the hip; a shank ends in its foot
//! ```
//!
//! All numbers are those of a figure of [`HEIGHT`] that stands upright and looks along x, its hip at the origin `[m]`.

use super::{Body, BodyError, Joint, length};

/// Height that the numbers below are of `[m]`; other figures are like it.
const HEIGHT: f64 = 1.7;

/// A part of the body that bonds hold in its shape.
struct Piece {
    /// Its share of the mass `[1]`, the same for each of its points: those of a grown figure, to a hundredth.
    share: f64,
    /// Places of its points, the first of them the joint that it hangs from `[m]`.
    places: &'static [[f64; 2]],
    /// Bonds, two for each point but three less: none is too many.
    links: &'static [[usize; 2]],
    /// What it covers, anticlockwise.
    triangles: &'static [[usize; 3]],
}

/// Hip, belly, chest, neck, back, rump.
const TORSO: Piece = Piece {
    share: 0.41,
    places: &[[0.0, 0.0], [0.11, 0.08], [0.13, 0.37], [0.0, 0.51], [-0.12, 0.36], [-0.12, 0.05]],
    links: &[[0, 1], [1, 2], [2, 3], [3, 4], [4, 5], [5, 0], [0, 2], [0, 4], [2, 4]],
    triangles: &[[0, 1, 2], [0, 2, 4], [0, 4, 5], [2, 3, 4]],
};
/// Neck, jaw, brow, crown, nape.
const HEAD: Piece = Piece {
    share: 0.08,
    places: &[[0.0, 0.0], [0.09, 0.07], [0.11, 0.19], [0.0, 0.29], [-0.1, 0.17]],
    links: &[[0, 1], [1, 2], [2, 3], [3, 4], [4, 0], [1, 4], [2, 4]],
    triangles: &[[0, 1, 4], [1, 2, 4], [2, 3, 4]],
};
const UPPER_ARM: Piece = kite(0.03, &[[0.0, 0.0], [0.05, -0.09], [-0.05, -0.09], [0.0, -0.3]]);
const FOREARM: Piece = kite(0.022, &[[0.0, 0.0], [0.04, -0.09], [-0.04, -0.09], [0.0, -0.29]]);
const THIGH: Piece = kite(0.11, &[[0.0, 0.0], [0.08, -0.13], [-0.08, -0.13], [0.0, -0.43]]);
/// Knee, calf, shin, heel, toe.
const SHANK: Piece = Piece {
    share: 0.093,
    places: &[[0.0, 0.0], [-0.06, -0.14], [0.045, -0.14], [-0.05, -0.47], [0.17, -0.47]],
    links: &[[0, 1], [0, 2], [1, 2], [1, 3], [2, 3], [2, 4], [3, 4]],
    triangles: &[[0, 1, 2], [1, 3, 2], [3, 4, 2]],
};

/// A limb from a joint to the next: joint, front, rear, next joint.
const fn kite(share: f64, places: &'static [[f64; 2]; 4]) -> Piece {
    Piece { share, places, links: &[[0, 1], [0, 2], [1, 2], [1, 3], [2, 3]], triangles: &[[0, 2, 1], [2, 3, 1]] }
}

/// Turns of upper arm, forearm, thigh and shank, each from the piece that it hangs from `[rad]`: a figure that strides, no limb
/// across another one or its body.
const POSES: [[f64; 4]; 2] = [[-0.65, 0.5, 0.7, -0.7], [0.9, 0.9, -0.15, -0.35]];

/// Ranges of the joints `[rad]`, of the angle from the piece above to the one below, anticlockwise: a hanging arm is at 0 of the torso, what is
/// stretched at pi. Elbows bend forwards and knees backwards only.
const NECK_RANGE: [f64; 2] = [2.6, 3.7];
const SHOULDER_RANGE: [f64; 2] = [-0.9, 3.0];
const ELBOW_RANGE: [f64; 2] = [3.1, 5.7];
const HIP_RANGE: [f64; 2] = [2.8, 5.2];
const KNEE_RANGE: [f64; 2] = [0.7, 3.06];

/// A figure about its hip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ragdoll {
    /// Of the figure as it would stand upright `[m]`.
    pub height: f64,
}

impl Default for Ragdoll {
    /// 1.7 m.
    fn default() -> Self {
        Ragdoll { height: HEIGHT }
    }
}

impl Ragdoll {
    /// How many points it makes: 36.
    ///
    /// Errors: a height that is not positive.
    pub fn point_count(&self) -> Result<u32, BodyError> {
        length("height", self.height)?;
        let [limbs, ends] = [[UPPER_ARM, FOREARM], [THIGH, SHANK]].map(|pair| pair.map(|piece| piece.places.len() - 1));
        let each: usize = limbs.into_iter().chain(ends).sum();
        Ok((TORSO.places.len() + HEAD.places.len() - 1 + 2 * each) as u32)
    }

    pub(super) fn make(&self) -> Body {
        let mut body = Body::default();
        let scale = self.height / HEIGHT;
        body.positions.push([0.0; 3]);
        body.weights.push(0.0);
        let torso = hang(&mut body, &TORSO, 0, (0.0, scale));
        let (hip, neck) = (torso[0], torso[3]);
        let head = hang(&mut body, &HEAD, neck, (0.0, scale));
        body.joints.push(Joint { points: [hip, neck, head[3]], range: NECK_RANGE });
        for [arm, forearm, ..] in POSES {
            let upper = hang(&mut body, &UPPER_ARM, neck, (arm, scale));
            let lower = hang(&mut body, &FOREARM, upper[3], (arm + forearm, scale));
            body.joints.push(Joint { points: [hip, neck, upper[3]], range: SHOULDER_RANGE });
            body.joints.push(Joint { points: [neck, upper[3], lower[3]], range: ELBOW_RANGE });
        }
        for [.., thigh, shank] in POSES {
            let upper = hang(&mut body, &THIGH, hip, (thigh, scale));
            let lower = hang(&mut body, &SHANK, upper[3], (thigh + shank, scale));
            body.joints.push(Joint { points: [neck, hip, upper[3]], range: HIP_RANGE });
            body.joints.push(Joint { points: [hip, upper[3], lower[3]], range: KNEE_RANGE });
        }
        body
    }
}

/// Adds a piece that hangs from a point, turned from upright by an angle `[rad]`; the numbers of its points.
fn hang(body: &mut Body, piece: &Piece, from: u32, (angle, scale): (f64, f64)) -> Vec<u32> {
    let origin = body.positions[from as usize];
    let (sin, cos) = (libm::sin(angle), libm::cos(angle));
    let mut points = vec![from];
    for &[x, y] in &piece.places[1..] {
        points.push(body.positions.len() as u32);
        let turned = [scale * (x * cos - y * sin), scale * (x * sin + y * cos)];
        body.positions.push([origin[0] + turned[0], origin[1] + turned[1], 0.0]);
        body.weights.push(0.0);
    }
    for &point in &points {
        body.weights[point as usize] += piece.share / points.len() as f64;
    }
    piece.links.iter().for_each(|&[a, b]| body.link(points[a], points[b]));
    body.triangles.extend(piece.triangles.iter().map(|corners| corners.map(|corner| points[corner])));
    points
}

#[cfg(test)]
#[allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]
mod tests {
    use std::f64::consts::{PI, TAU};

    use super::*;
    use crate::body::distance;
    use crate::sim::vector::{cross, sub, truncate};

    const PIECES: [(&Piece, u32); 6] =
        [(&TORSO, 1), (&HEAD, 1), (&UPPER_ARM, 2), (&FOREARM, 2), (&THIGH, 2), (&SHANK, 2)];

    #[test]
    fn its_bones_add_up_to_its_height() {
        for height in [1.7, 0.3] {
            let body = Ragdoll { height }.make();
            let between = |a: u32, b: u32| distance(body.positions[a as usize], body.positions[b as usize]);
            let [neck, knee] = [0, 6].map(|joint| body.joints[joint].points[1]);
            let crown = body.joints[0].points[2];
            let [heel, toe] = [0, 1].map(|k| body.joints[6].points[2] + k);
            let [shank, foot, toe] = [between(knee, heel), between(heel, toe), between(knee, toe)];
            // The distance of the knee from its sole, by Heron's formula.
            let half = 0.5 * (shank + foot + toe);
            let sole = 2.0 / foot * (half * (half - shank) * (half - foot) * (half - toe)).sqrt();
            let whole = sole + between(knee, 0) + between(0, neck) + between(neck, crown);
            assert!((whole - height).abs() < 1e-12, "{whole}");
        }
    }

    #[test]
    fn its_pieces_have_all_of_its_mass() {
        let whole: f64 = PIECES.iter().map(|(piece, count)| piece.share * f64::from(*count)).sum();
        assert!((whole - 1.0).abs() < 1e-12, "{whole}");
        let masses = Ragdoll::default().make().masses(70.0);
        assert!((masses.iter().sum::<f64>() - 70.0).abs() < 1e-9);
        assert!(masses.iter().all(|&m| m > 0.3), "{masses:?}");
    }

    #[test]
    fn every_piece_is_braced_and_none_too_much() {
        for (piece, _) in PIECES {
            assert_eq!(piece.links.len(), 2 * piece.places.len() - 3);
            // Triangles that share sides hold each other.
            for triangle in piece.triangles {
                for k in 0..3 {
                    let (a, b) = (triangle[k], triangle[(k + 1) % 3]);
                    assert!(piece.links.iter().any(|link| *link == [a, b] || *link == [b, a]), "{triangle:?}");
                }
            }
            assert_eq!(piece.triangles.len(), piece.places.len() - 2);
        }
        let body = Ragdoll::default().make();
        assert_eq!(body.positions.len() as u32, Ragdoll::default().point_count().unwrap());
        for corners in &body.triangles {
            let [a, b, c] = corners.map(|corner| truncate::<2>(body.positions[corner as usize]));
            assert!(cross(sub(b, a), sub(c, a)) > 0.0, "{corners:?}");
        }
    }

    #[test]
    fn every_joint_starts_within_its_range_and_bends_one_way() {
        let body = Ragdoll::default().make();
        for Joint { points, range: [least, most] } in &body.joints {
            let [from, at, to] = points.map(|point| truncate::<2>(body.positions[point as usize]));
            let turn = |x: [f64; 2]| libm::atan2(x[1] - at[1], x[0] - at[0]);
            let middle = 0.5 * (least + most);
            let off = (turn(to) - turn(from) - middle + PI).rem_euclid(TAU) - PI;
            assert!(off.abs() < 0.5 * (most - least), "{points:?}: {}", middle + off);
        }
        let [elbow, knee] = [2, 6].map(|joint| body.joints[joint].range);
        assert!(elbow[0] > PI - 0.1 && knee[1] < PI + 0.1, "neither is stretched beyond straight");
    }

    #[test]
    fn a_figure_without_a_height_is_refused() {
        assert_eq!(Ragdoll { height: 0.0 }.point_count().unwrap_err().key, "height");
    }
}
