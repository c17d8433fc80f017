//! Whether soft bodies bear their own weight, estimated before they have to: how far each would sag.

use crate::app::player::Shown;
use crate::picture::Tint;
use crate::sim::vector::{cross3, sub};
use crate::sim::{BondKind, Limit, PointId};

/// Sagging by more than this share of its height a body folds up instead of standing `[1]`: so much is told.
pub(in crate::app) const TOLD: f64 = 0.3;
/// What bears a body lets it sag by this share of its height `[1]`.
const BORNE: f64 = 0.1;
/// Young's modulus over the stiffness against strain along one axis alone, of a net of springs without a grain `[1]`: 1 - ν^2, where ν = 1/3.
const FREE: f64 = 8.0 / 9.0;

/// How a soft body bears its weight.
///
/// Model: an upright bar of width w on the ground, whose parts of height dh bear all that is above: with h_i above its foot the points m_i press it
/// together by δ = g Σ m_i h_i / (E w), as a share of its height H by s = g Σ m_i h_i / (E A), A = w H; of even mass that is ρ g H / (2 E).
/// Young's modulus E `[N/m]` is that of the net: strained along gravity alone by ε the bonds, c_b the cosine of each to it, store
/// 1/2 ε^2 Σ k_b L_b^2 c_b^4 = 1/2 C A ε^2, and E = (1 - ν^2) C with ν = 1/3, to which central forces without a grain lead in the plane.
/// Valid range: small strains; a body that is weaker in one part sags there by more.
/// Accuracy: to half of it, see the tests.
/// Source: Timoshenko and Gere, Mechanics of Materials (1972), 1.4, a bar under its own weight; Ostoja-Starzewski, Lattice models in
/// micromechanics, Applied Mechanics Reviews 55 (2002), section 2, for the net.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(in crate::app) struct Bearing {
    /// g Σ m_i h_i as it is `[N m]`, and of what has 1 kg/m^2 `[N m/(kg/m^2)]`.
    weight: [f64; 2],
    /// E A as it is `[N m]`, and of springs of 1 N/m `[m^2]`.
    firm: [f64; 2],
}

impl Bearing {
    /// By what share of its height it sags `[1]`, with this mass by area `[kg/m^2]` and this stiffness of its springs `[N/m]` where there is one.
    pub(in crate::app) fn sags(&self, density: Option<f64>, stiffness: Option<f64>) -> f64 {
        let firm = stiffness.map_or(self.firm[0], |stiffness| stiffness * self.firm[1]);
        let sags = self.weight(density) / firm;
        // Without any weight nothing sags, however soft.
        if sags.is_nan() { 0.0 } else { sags }
    }

    /// The stiffness of springs that bears it `[N/m]`, in two digits.
    pub(in crate::app) fn carrying(&self, density: Option<f64>) -> f64 {
        let least = self.weight(density) / (BORNE * self.firm[1]);
        let digit = 10_f64.powf(least.max(f64::MIN_POSITIVE).log10().floor() - 1.0);
        (least / digit).ceil() * digit
    }

    fn weight(&self, density: Option<f64>) -> f64 {
        density.map_or(self.weight[0], |density| density * self.weight[1])
    }
}

/// How the soft bodies of a world bear their weights: those of springs all over, that cover something and hang on no pin.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::app) struct Bearings {
    list: Vec<Bearing>,
}

impl Bearings {
    /// Of what is shown, as it stands now; none in space, and where nothing falls.
    pub(in crate::app) fn of(shown: &Shown) -> Self {
        let gravity = shown.settings.gravity.unwrap_or_default();
        let g = gravity[0].hypot(gravity[1]);
        let scenery = &shown.scenery;
        if shown.dimensions != 2 || g == 0.0 || scenery.triangles.is_empty() {
            return Bearings::default();
        }
        let up = [-gravity[0] / g, -gravity[1] / g];
        let count = shown.point_count();
        let of = Tint::hanging(count, scenery.bonds.ends().iter().map(|ends| ends.map(|end| end.0)));
        let bodies = of.iter().max().map_or(0, |last| *last as usize + 1);
        let place = |point: PointId| shown.place(point.index());
        let height = |point: PointId| place(point)[0] * up[0] + place(point)[1] * up[1];
        let body = |point: PointId| of[point.index()] as usize;
        let mut foot = vec![f64::INFINITY; bodies];
        let (mut is_soft, mut covers) = (vec![true; bodies], vec![false; bodies]);
        for point in (0..count as u32).map(PointId) {
            foot[body(point)] = foot[body(point)].min(height(point));
        }
        let mut all = vec![Bearing::default(); bodies];
        for point in (0..count as u32).map(PointId) {
            all[body(point)].weight[0] += g * scenery.masses[point.index()] * (height(point) - foot[body(point)]);
        }
        for corners in &scenery.triangles {
            let [a, b, c] = corners.map(place);
            let area = 0.5 * cross3(sub(b, a), sub(c, a))[2].abs();
            let middle = corners.iter().map(|&corner| height(corner)).sum::<f64>() / 3.0;
            let own = body(corners[0]);
            covers[own] = true;
            all[own].weight[1] += g * area * (middle - foot[own]);
        }
        for bond in scenery.bonds.iter() {
            let own = body(bond.a);
            let (BondKind::Spring { stiffness, .. }, Limit::Both) = (bond.kind, bond.limit) else {
                is_soft[own] = false;
                continue;
            };
            let [x, y, _] = sub(place(bond.b), place(bond.a));
            let cosine = (x * up[0] + y * up[1]) / x.hypot(y);
            let firm = FREE * bond.rest_length.powi(2) * cosine.powi(4);
            if firm.is_finite() {
                all[own].firm[0] += stiffness * firm;
                all[own].firm[1] += firm;
            }
        }
        scenery.pinned.iter().for_each(|&pin| is_soft[body(pin)] = false);
        let list = (0..bodies).filter(|&own| is_soft[own] && covers[own] && all[own].firm[1] > 0.0);
        Bearings { list: list.map(|own| all[own]).collect() }
    }

    /// The share of its height by which that one sags which sags most, with another mass by area or stiffness, and the stiffness that bears it
    /// `[N/m]`; `None` where that is not worth a word.
    pub(in crate::app) fn told(&self, density: Option<f64>, stiffness: Option<f64>) -> Option<(f64, f64)> {
        let sags = self.list.iter().map(|one| (one.sags(density, stiffness), one.carrying(density)));
        sags.filter(|(sags, _)| *sags > TOLD).max_by(|a, b| a.0.total_cmp(&b.0))
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;
    use crate::app::player::{Order, Stage};
    use crate::scene::Scene;

    fn shown(stage: &mut Stage) -> Shown {
        let mut shown = Shown::default();
        stage.show(&mut shown);
        shown
    }

    fn block(columns: u32, rows: u32, stiffness: f64) -> Stage {
        let text = format!(
            r#"{{"wobble": 1, "gravity": [0, -9.81], "contact": true, "bounds": {{"min": [-9, 0], "max": [9, 9]}}, "drag_rate": 2,
                "bodies": [{{"make": "lattice", "columns": {columns}, "rows": {rows}, "spacing": 0.2, "origin": [0, 0.01],
                "material": {{"kind": "spring", "stiffness": {stiffness}, "damping": 2, "mass": 2}}}}]}}"#
        );
        Stage::new(Scene::parse(&text, "x.json").unwrap().into()).unwrap()
    }

    fn top(shown: &Shown) -> f64 {
        (0..shown.point_count()).map(|point| shown.place(point)[1]).fold(0.0, f64::max)
    }

    #[test]
    fn a_block_sags_by_as_much_as_is_estimated() {
        for (columns, rows, stiffness) in [(6, 6, 600.0), (11, 6, 600.0), (6, 6, 1500.0), (4, 8, 1500.0)] {
            let mut stage = block(columns, rows, stiffness);
            let before = shown(&mut stage);
            let estimate = Bearings::of(&before).list[0].sags(None, None);
            (0..600).for_each(|_| _ = stage.obey(Order::Step(None)));
            let now = shown(&mut stage);
            let sags = (top(&before) - 0.01 - top(&now)) / (0.2 * f64::from(rows - 1));
            assert!((0.5..1.6).contains(&(sags / estimate)), "{columns} x {rows}, {stiffness}: {sags} for {estimate}");
        }
    }

    #[test]
    fn more_mass_is_told_and_the_stiffness_that_is_offered_bears_it() {
        let mut stage = block(6, 6, 600.0);
        let bearings = Bearings::of(&shown(&mut stage));
        assert_eq!(bearings.told(None, None), None, "2 kg/m^2 are borne");
        let (sags, stiffness) = bearings.told(Some(100.0), None).unwrap();
        assert!(sags > TOLD && stiffness > 600.0, "{sags} {stiffness}");
        assert_eq!(bearings.told(Some(100.0), Some(stiffness)), None);
        assert_eq!(bearings.told(Some(0.0), Some(0.0)), None, "without weight nothing sags");
        let even = bearings.list[0];
        assert!((even.sags(Some(2.0), None) / even.sags(None, None) - 1.0).abs() < 0.05, "by area as by points");
        assert!((even.sags(None, Some(600.0)) / even.sags(None, None) - 1.0).abs() < 1e-9);
    }

    #[test]
    fn what_is_rigid_or_pinned_or_does_not_fall_is_not_told_of() {
        for (from, to) in
            [(r#""kind": "spring", "stiffness": 600, "damping": 2"#, r#""kind": "rigid""#), ("-9.81", "0")]
        {
            let text = r#"{"wobble": 1, "gravity": [0, -9.81], "bodies": [{"make": "lattice", "columns": 4, "rows": 4, "spacing": 0.2,
                "material": {"kind": "spring", "stiffness": 600, "damping": 2, "mass": 2}}]}"#;
            let mut stage = Stage::new(Scene::parse(&text.replace(from, to), "x.json").unwrap().into()).unwrap();
            assert_eq!(Bearings::of(&shown(&mut stage)).told(Some(1e3), None), None, "{to}");
        }
    }
}
