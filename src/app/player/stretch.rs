//! How far bonds that keep their length are stretched all the same.

use super::Shown;
use crate::sim::{BondKind, Limit};

/// So many bonds are looked at, some of more.
const MOST: usize = 50_000;

impl Shown {
    /// The greatest strain of rigid bonds that hold what pulls at them `[1]`; `None` where there are none.
    pub fn stretch(&self) -> Option<f64> {
        let bonds = &self.scenery.bonds;
        let step = bonds.len() / MOST + 1;
        let some = (0..bonds.len()).step_by(step).map(|place| bonds.get(place));
        let rigid = some.filter(|bond| bond.kind == BondKind::Rigid && bond.limit != Limit::Min);
        let strains = rigid.filter(|bond| bond.rest_length > 0.0).map(|bond| {
            let [a, b] = [bond.a, bond.b].map(|end| glam::DVec3::from(self.place(end.index())));
            bond.strain(a.distance(b), bond.rest_length)
        });
        strains.filter(|strain| strain.is_finite()).reduce(f64::max)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on stops")]
mod tests {
    use crate::app::player::{Order, Shown, Stage};
    use crate::app::tools::PinWay;
    use crate::scene::Scene;
    use crate::sim::PointId;

    fn stretch(stage: &mut Stage) -> Option<f64> {
        let mut shown = Shown::default();
        stage.show(&mut shown);
        shown.stretch()
    }

    #[test]
    fn a_rope_between_pins_that_are_led_apart_is_stretched_until_they_come_back() {
        let text = r#"{"wobble": 1, "bodies": [{"make": "rope", "count": 5, "to": [1.8, 0], "slack": 0.11, "pinned": [0, 4]}]}"#;
        let mut stage = Stage::new(Scene::parse(text, "x.json").unwrap().into()).unwrap();
        let mut after = |x: f64| {
            let pins = vec![(PointId(4), [x, 0.0, 0.0])];
            stage.obey(Order::LeadPins(PinWay { pins, goes_on: false, follows: false }));
            (0..20).for_each(|_| _ = stage.obey(Order::Advance { wall: 0.1, cursor: None, back: false }));
            stretch(&mut stage).unwrap()
        };
        assert!(after(1.9).abs() < 0.01);
        assert!((after(4.0) - 1.0).abs() < 0.02, "twice its length");
        assert!(after(1.9).abs() < 0.01, "slack again");
        let springs = r#"{"wobble": 1, "points": {"position": [[0, 0], [2, 0]]}, "bonds": [{"a": 0, "b": 1, "rest": 1, "kind": "spring", "stiffness": 9}]}"#;
        let mut stage = Stage::new(Scene::parse(springs, "x.json").unwrap().into()).unwrap();
        assert_eq!(stretch(&mut stage), None, "springs are made to be stretched");
    }
}
