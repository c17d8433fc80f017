//! Bonds: their ends, and what they and the materials of bodies are made of.

use super::number::{self, Range};
use crate::scene::error::{Fault, Within};
use crate::scene::keys::{BondKeys, BondList, KindName, LimitName, Material};
use crate::scene::young::stiffness_of_young;
use crate::sim::BondKind;

/// Errors: the first bond that is at fault.
pub(in crate::scene) fn check_all(bonds: &BondList, count: u32) -> Result<(), Fault> {
    // Materials are judged once, ends and lengths in one pass; what is wrong is asked of a faulty bond alone.
    let is_sound: Vec<bool> = bonds.materials().iter().map(|material| check_material(material).is_ok()).collect();
    let is_fine = |&k: &usize| {
        let [a, b] = bonds.ends(k);
        let rest = bonds.rest(k).unwrap_or(0.0);
        a < count && b < count && a != b && rest >= 0.0 && rest.is_finite() && is_sound[bonds.material(k)]
    };
    match (0..bonds.len()).find(|k| !is_fine(k)) {
        None => Ok(()),
        Some(k) => check(&bonds.get(k), count).item(k),
    }
}

/// Errors: an end that is not there, both ends the same, and those of [`Resistance::check`].
fn check(bond: &BondKeys, count: u32) -> Result<(), Fault> {
    number::index(bond.a, count).at("a")?;
    number::index(bond.b, count).at("b")?;
    if bond.a == bond.b {
        let message = format!("is point {} as `a` is: a bond needs two points, so give another", bond.b);
        return Err(Fault::invalid(message).at("b"));
    }
    Range::NotNegative.maybe(bond.rest).at("rest")?;
    check_material(bond)
}

/// Errors: those of a bond but for its ends and its rest length.
fn check_material(bond: &BondKeys) -> Result<(), Fault> {
    Range::Positive.maybe(bond.break_strain).at("break_strain")?;
    Resistance::from(bond).check()?;
    check_drive(bond).at("drive")
}

/// Errors: a drive that is none, or that such a bond cannot have.
fn check_drive(bond: &BondKeys) -> Result<(), Fault> {
    let Some(drive) = &bond.drive else { return Ok(()) };
    drive.of_bond()?;
    if bond.kind == Some(KindName::Relaxed) {
        return Err(Fault::invalid("a relaxed bond has none: make it a spring or rigid"));
    }
    if bond.limit.is_some_and(|limit| limit != LimitName::Both) {
        return Err(Fault::invalid("a bond that acts on one side has none: leave `limit` or `drive` out"));
    }
    Ok(())
}

/// How a bond resists, in the file's keys.
#[derive(Clone, Copy, Debug)]
pub(in crate::scene) struct Resistance {
    kind: Option<KindName>,
    stiffness: Option<f64>,
    young: Option<f64>,
    compliance: Option<f64>,
    axial_stiffness: Option<f64>,
    damping: Option<f64>,
    relaxation: Option<f64>,
    max_correction: Option<f64>,
}

impl From<&BondKeys> for Resistance {
    fn from(bond: &BondKeys) -> Self {
        Resistance {
            kind: bond.kind,
            stiffness: bond.stiffness,
            young: None,
            compliance: bond.compliance,
            axial_stiffness: bond.axial_stiffness,
            damping: bond.damping,
            relaxation: bond.relaxation,
            max_correction: bond.max_correction,
        }
    }
}

impl From<&Material> for Resistance {
    fn from(material: &Material) -> Self {
        Resistance {
            kind: material.kind,
            stiffness: material.stiffness,
            young: material.young,
            compliance: material.compliance,
            axial_stiffness: None,
            damping: material.damping,
            relaxation: material.relaxation,
            max_correction: material.max_correction,
        }
    }
}

impl Resistance {
    /// Errors: a number out of its range; a key of another kind; a spring without stiffness, or with it said twice.
    pub(in crate::scene) fn check(&self) -> Result<(), Fault> {
        let kind = self.kind.unwrap_or(KindName::Rigid);
        self.check_belonging(kind)?;
        Range::NotNegative.maybe(self.stiffness).at("stiffness")?;
        Range::NotNegative.maybe(self.compliance).at("compliance")?;
        Range::NotNegative.maybe(self.axial_stiffness).at("axial_stiffness")?;
        Range::NotNegative.maybe(self.damping).at("damping")?;
        Range::Share.maybe(self.relaxation).at("relaxation")?;
        Range::Positive.maybe(self.max_correction).at("max_correction")?;
        if self.stiffness.is_some() && self.compliance.is_some() {
            let message = "stands beside `stiffness`, its reciprocal: leave one of them out";
            return Err(Fault::invalid(message).at("compliance"));
        }
        if self.axial_stiffness.is_some() && (self.stiffness.is_some() || self.compliance.is_some()) {
            let message = "says how stiff the spring is, as another key does: leave one of them out";
            return Err(Fault::invalid(message).at("axial_stiffness"));
        }
        Range::Young.maybe(self.young).at("young")?;
        if self.young.is_some() && (self.stiffness.is_some() || self.compliance.is_some()) {
            return Err(
                Fault::invalid("says how stiff the springs are, as another key does: leave one out").at("young")
            );
        }
        if kind == KindName::Spring && [self.stiffness, self.compliance, self.axial_stiffness, self.young] == [None; 4]
        {
            let message =
                "a spring needs `stiffness` [N/m], `compliance` [m/N] or `axial_stiffness` [N]: add one of them";
            return Err(Fault::invalid(message));
        }
        match self.compliance {
            Some(compliance) if compliance > 0.0 && !(1.0 / compliance).is_finite() => {
                let message = format!("is {compliance:?}, too small to divide by: give 0");
                Err(Fault::invalid(message).at("compliance"))
            }
            _ => Ok(()),
        }
    }

    /// Errors: a key that bonds of this kind do not have.
    fn check_belonging(&self, kind: KindName) -> Result<(), Fault> {
        let (rigid, spring, relaxed) = (kind == KindName::Rigid, kind == KindName::Spring, kind == KindName::Relaxed);
        for (key, given, belongs, owner) in [
            ("stiffness", self.stiffness.is_some(), spring, "spring"),
            ("young", self.young.is_some(), spring, "spring"),
            ("compliance", self.compliance.is_some(), rigid || spring, "spring"),
            ("axial_stiffness", self.axial_stiffness.is_some(), spring, "spring"),
            ("damping", self.damping.is_some(), spring, "spring"),
            ("relaxation", self.relaxation.is_some(), relaxed, "relaxed"),
            ("max_correction", self.max_correction.is_some(), relaxed, "relaxed"),
        ] {
            if given && !belongs {
                let why = if self.kind.is_none() { " as no `kind` is said" } else { "" };
                return Err(Fault::invalid(format!(
                    "is a key of kind {owner}, and this is {kind}{why}: leave it out or set \"kind\": \"{owner}\""
                ))
                .at(key));
            }
        }
        Ok(())
    }

    /// What the engine makes of it; checked before. A compliance above 0 is a spring, one of 0 a rigid bond. An axial stiffness is still to
    /// be divided by the rest length.
    pub(in crate::scene) fn resolve(&self) -> BondKind {
        let damping = self.damping.unwrap_or(0.0);
        match (self.kind.unwrap_or(KindName::Rigid), self.compliance) {
            (KindName::Relaxed, _) => BondKind::Relaxed {
                relaxation: self.relaxation.unwrap_or(1.0),
                max_correction: self.max_correction.unwrap_or(f64::INFINITY),
            },
            (_, Some(compliance)) if compliance > 0.0 => BondKind::Spring { stiffness: 1.0 / compliance, damping },
            (KindName::Spring, None) => {
                let of_young = self.young.map(stiffness_of_young);
                BondKind::Spring {
                    stiffness: self.stiffness.or(of_young).or(self.axial_stiffness).unwrap_or(0.0),
                    damping,
                }
            }
            _ => BondKind::Rigid,
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on stops")]
mod tests {
    use super::*;

    fn resolved(edit: impl FnOnce(&mut BondKeys)) -> BondKind {
        let mut bond = BondKeys::new(0, 1);
        edit(&mut bond);
        check(&bond, 2).unwrap();
        Resistance::from(&bond).resolve()
    }

    #[test]
    fn compliance_is_a_spring_above_zero_and_rigid_at_zero() {
        let spring = |stiffness, damping| BondKind::Spring { stiffness, damping };
        assert_eq!(resolved(|_| ()), BondKind::Rigid);
        assert_eq!(resolved(|b| b.compliance = Some(0.0)), BondKind::Rigid);
        assert_eq!(resolved(|b| b.compliance = Some(0.25)), spring(4.0, 0.0));
        let soft = |b: &mut BondKeys| {
            b.kind = Some(KindName::Spring);
            b.compliance = Some(0.5);
            b.damping = Some(3.0);
        };
        assert_eq!(resolved(soft), spring(2.0, 3.0));
        let hard = |b: &mut BondKeys| {
            b.kind = Some(KindName::Spring);
            b.compliance = Some(0.0);
        };
        assert_eq!(resolved(hard), BondKind::Rigid);
        let slack = |b: &mut BondKeys| {
            b.kind = Some(KindName::Spring);
            b.stiffness = Some(0.0);
        };
        assert_eq!(resolved(slack), spring(0.0, 0.0));
    }

    #[test]
    fn a_relaxed_bond_is_hard_and_unlimited_if_not_said() {
        let kind = resolved(|b| b.kind = Some(KindName::Relaxed));
        let BondKind::Relaxed { relaxation, max_correction } = kind else {
            panic!("{kind:?}");
        };
        assert_eq!((relaxation, max_correction), (1.0, f64::INFINITY));
    }
}
