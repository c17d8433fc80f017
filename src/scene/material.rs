//! What a bond is, from the keys that a listed bond and a body's material share.

use super::error::Problem;
use super::file::{BondFile, KindFile, LimitFile};
use super::maker::MaterialFile;
use crate::sim::{BondKind, Limit};

/// The keys that say how a bond resists.
pub(crate) struct BondKeys {
    kind: KindFile,
    stiffness: Option<f64>,
    compliance: Option<f64>,
    damping: Option<f64>,
    relaxation: Option<f64>,
    max_correction: Option<f64>,
    break_strain: Option<f64>,
}

macro_rules! bond_keys {
    ($($type:ty)*) => {$(
        impl From<&$type> for BondKeys {
            fn from(file: &$type) -> Self {
                BondKeys {
                    kind: file.kind,
                    stiffness: file.stiffness,
                    compliance: file.compliance,
                    damping: file.damping,
                    relaxation: file.relaxation,
                    max_correction: file.max_correction,
                    break_strain: file.break_strain,
                }
            }
        }
    )*};
}

bond_keys!(BondFile MaterialFile);

impl BondKeys {
    /// The kind of bond that the keys mean.
    ///
    /// Errors: a key of another kind, a number out of range, too few or too many of stiffness and compliance, and
    /// `break_strain`, which bonds do not have yet.
    pub(crate) fn kind(&self) -> Result<BondKind, Problem> {
        self.check_ranges()?;
        let kind = match self.kind {
            KindFile::Rigid => self.rigid()?,
            KindFile::Spring => self.spring()?,
            KindFile::Relaxed => self.relaxed()?,
        };
        if self.break_strain.is_some() {
            return Err(Problem::new("break_strain", "bonds that break are not in this version: leave it out"));
        }
        Ok(kind)
    }

    fn check_ranges(&self) -> Result<(), Problem> {
        let keys = [
            ("stiffness", self.stiffness),
            ("compliance", self.compliance),
            ("damping", self.damping),
            ("max_correction", self.max_correction),
            ("break_strain", self.break_strain),
        ];
        for (key, value) in keys {
            if let Some(value) = value {
                at_least_zero(key, value)?;
            }
        }
        Ok(())
    }

    fn rigid(&self) -> Result<BondKind, Problem> {
        self.refuse(
            "rigid",
            &[
                ("stiffness", self.stiffness),
                ("damping", self.damping),
                ("relaxation", self.relaxation),
                ("max_correction", self.max_correction),
            ],
        )?;
        Ok(from_compliance(self.compliance.unwrap_or(0.0), 0.0))
    }

    fn spring(&self) -> Result<BondKind, Problem> {
        self.refuse("spring", &[("relaxation", self.relaxation), ("max_correction", self.max_correction)])?;
        let damping = self.damping.unwrap_or(0.0);
        match (self.stiffness, self.compliance) {
            (Some(stiffness), None) => Ok(BondKind::Spring { stiffness, damping }),
            (None, Some(compliance)) => Ok(from_compliance(compliance, damping)),
            (None, None) => Err(Problem::new("", "a spring needs `stiffness` or `compliance`: give one")),
            (Some(_), Some(_)) => Err(Problem::new("compliance", "excludes `stiffness`: give one of them")),
        }
    }

    fn relaxed(&self) -> Result<BondKind, Problem> {
        self.refuse(
            "relaxed",
            &[("stiffness", self.stiffness), ("compliance", self.compliance), ("damping", self.damping)],
        )?;
        let relaxation = self.relaxation.unwrap_or(1.0);
        if !(relaxation > 0.0 && relaxation <= 1.0) {
            return Err(Problem::new("relaxation", format!("is {relaxation}: give a number above 0, up to 1")));
        }
        Ok(BondKind::Relaxed { relaxation, max_correction: self.max_correction.unwrap_or(f64::INFINITY) })
    }

    fn refuse(&self, kind: &str, keys: &[(&str, Option<f64>)]) -> Result<(), Problem> {
        match keys.iter().find(|(_, value)| value.is_some()) {
            Some((key, _)) => {
                let home = if key.starts_with(['r', 'm']) { "relaxed" } else { "spring" };
                let problem = format!("has no meaning for a {kind} bond: leave it out, or set kind to \"{home}\"");
                Err(Problem::new(*key, problem))
            }
            None => Ok(()),
        }
    }
}

/// Compliance 0 is rigid, more is a spring.
fn from_compliance(compliance: f64, damping: f64) -> BondKind {
    let stiffness = 1.0 / compliance;
    if stiffness.is_finite() { BondKind::Spring { stiffness, damping } } else { BondKind::Rigid }
}

/// A number that must be finite and not negative.
pub(crate) fn at_least_zero(key: &str, value: f64) -> Result<(), Problem> {
    if value >= 0.0 && value.is_finite() {
        return Ok(());
    }
    Err(Problem::new(key, format!("is {value}: give a finite number, 0 or more")))
}

/// A number that must be finite and positive.
pub(crate) fn above_zero(key: &str, value: f64) -> Result<(), Problem> {
    if value > 0.0 && value.is_finite() {
        return Ok(());
    }
    Err(Problem::new(key, format!("is {value}: give a finite number above 0")))
}

impl From<LimitFile> for Limit {
    fn from(limit: LimitFile) -> Self {
        match limit {
            LimitFile::Both => Limit::Both,
            LimitFile::Max => Limit::Max,
            LimitFile::Min => Limit::Min,
        }
    }
}

/// The keys of a bond written out.
pub(crate) fn write(bond: &crate::sim::Bond) -> BondFile {
    let mut file = BondFile {
        a: bond.a.0,
        b: bond.b.0,
        kind: KindFile::Rigid,
        rest: Some(bond.rest_length),
        stiffness: None,
        compliance: None,
        damping: None,
        relaxation: None,
        max_correction: None,
        break_strain: None,
        limit: match bond.limit {
            Limit::Both => LimitFile::Both,
            Limit::Max => LimitFile::Max,
            Limit::Min => LimitFile::Min,
        },
    };
    match bond.kind {
        BondKind::Rigid => {}
        BondKind::Spring { stiffness, damping } => {
            file.kind = KindFile::Spring;
            (file.stiffness, file.damping) = (Some(stiffness), Some(damping));
        }
        BondKind::Relaxed { relaxation, max_correction } => {
            file.kind = KindFile::Relaxed;
            file.relaxation = Some(relaxation);
            file.max_correction = Some(max_correction).filter(|limit| limit.is_finite());
        }
    }
    file
}
