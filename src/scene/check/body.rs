//! Bodies: which keys each maker takes, and the maker that they amount to.

use super::bond::Resistance;
use super::cutout;
use super::number::{self, Range};
use super::repeat;
use crate::body::{
    BodyError, BoxFrame, Brace, Cloth, Diagonals, Disc, Lattice, Maker, Points, Ragdoll, RandomGraph, Rim, Rope,
    Stretch,
};
use crate::scene::error::{Fault, Source, Within};
use crate::scene::keys::{BodyKeys, BraceName, DiagonalsName, KindName, MakerName, Material, Vector};
use crate::scene::nearest;

/// Keys that every body has.
const COMMON: [&str; 6] = ["origin", "angle", "velocity", "spin", "material", "repeat"];

/// The parameters of each maker.
fn parameters(make: MakerName) -> &'static [&'static str] {
    match make {
        MakerName::Points => &["count", "min", "max", "seed"],
        MakerName::RandomGraph => &["count", "bonds", "min", "max", "seed"],
        MakerName::Rim => &["radius", "inner_radius", "sectors", "bracing"],
        MakerName::Box => &["width", "height", "supports"],
        MakerName::Rope => &["count", "spacing", "to", "slack"],
        MakerName::Cloth => &["columns", "rows", "spacing", "diagonals", "u", "v"],
        MakerName::Lattice => &["columns", "rows", "spacing"],
        MakerName::Disc => &["radius", "spacing"],
        MakerName::Picture => &[
            "file",
            "height",
            "spacing",
            "max_area",
            "grading",
            "threshold",
            "invert",
            "whole",
            "blur",
            "min_area",
            "holes",
            "strokes",
            "pattern",
            "part",
        ],
        MakerName::Ragdoll => &["height"],
    }
}

/// How many points the body has, with all its copies.
///
/// Errors: a key that its maker does not have, a missing parameter, a value out of its range, a pin that is not there.
pub(super) fn check(body: &BodyKeys, dimensions: usize, source: &Source) -> Result<u32, Fault> {
    check_belonging(body)?;
    for (key, vector) in [
        ("min", &body.min),
        ("max", &body.max),
        ("to", &body.to),
        ("u", &body.u),
        ("v", &body.v),
        ("origin", &body.origin),
        ("velocity", &body.velocity),
    ] {
        if let Some(vector) = vector {
            if dimensions == 2 && matches!(key, "u" | "v") {
                let message = "is an axis in space: leave it out in the plane";
                return Err(Fault::invalid(message).at(key));
            }
            number::vector(vector, dimensions).at(key)?;
        }
    }
    Range::Finite.maybe(body.angle).at("angle")?;
    Range::Finite.maybe(body.spin).at("spin")?;
    if let Some(material) = &body.material {
        check_material(material, body.make).at("material")?;
        check_bending(material, (body.make, dimensions)).at("bending").at("material")?;
    }
    let each = point_count(body, dimensions, source)?;
    for (i, &point) in body.pinned.iter().enumerate() {
        number::index(point, each).item(i).at("pinned")?;
    }
    Ok(each * repeat::check(body, each, dimensions)?)
}

/// How many points a copy of the body has, by its maker's parameters alone.
pub(super) fn point_count(body: &BodyKeys, dimensions: usize, source: &Source) -> Result<u32, Fault> {
    maker(body, dimensions, source)?.point_count().map_err(fault)
}

fn fault(error: BodyError) -> Fault {
    Fault::invalid(error.message).at(error.key)
}

fn check_belonging(body: &BodyKeys) -> Result<(), Fault> {
    let own = parameters(body.make);
    let belongs = |key: &&str| own.contains(key) || COMMON.contains(key);
    match body.given().find(|key| !belongs(key)) {
        None => Ok(()),
        Some(key) => {
            let list = nearest::list(own);
            let message = format!("is no parameter of `{}`, which takes {list}", body.make);
            Err(Fault::invalid(message).at(key))
        }
    }
}

fn check_material(material: &Material, make: MakerName) -> Result<(), Fault> {
    let masses = ["mass", "point_mass", "friction", "restitution", "radius", "bending"];
    let of_bonds = material.given().find(|key| !masses.contains(key));
    if let (MakerName::Points, Some(key)) = (make, of_bonds) {
        let message = "is a key of bonds, and `points` makes none: leave it out";
        return Err(Fault::invalid(message).at(key));
    }
    if make != MakerName::Picture && material.young.is_some() {
        let message = format!("is of meshes of pictures, and this is `{make}`: give `stiffness`");
        return Err(Fault::invalid(message).at("young"));
    }
    let is_stiff = material.stiffness.is_some() || material.compliance.is_some() || material.young.is_some();
    if make == MakerName::Picture && material.kind == Some(KindName::Spring) && !is_stiff {
        let message = "a spring needs `young` or `stiffness` [N/m], or `compliance` [m/N]: add one of them";
        return Err(Fault::invalid(message));
    }
    Resistance::from(material).check()?;
    Range::Positive.maybe(material.break_strain).at("break_strain")?;
    super::surfaces::check_skin([material.friction, material.restitution, material.radius])?;
    Range::NotNegative.maybe(material.width).at("width")?;
    Range::Positive.maybe(material.mass).at("mass")?;
    Range::Positive.maybe(material.point_mass).at("point_mass")?;
    if material.mass.is_some() && material.point_mass.is_some() {
        let message = "stands beside `mass`: give the body's mass or each point's, not both";
        return Err(Fault::invalid(message).at("point_mass"));
    }
    Ok(())
}

/// Errors: a bending that is none, or of what has no chain and no skin in the plane.
fn check_bending(material: &Material, (make, dimensions): (MakerName, usize)) -> Result<(), Fault> {
    Range::NotNegative.maybe(material.bending)?;
    if material.bending.is_none() {
        return Ok(());
    }
    if dimensions == 3 {
        return Err(Fault::invalid("is of the plane: leave it out in space"));
    }
    match make {
        MakerName::Cloth | MakerName::RandomGraph | MakerName::Points | MakerName::Ragdoll => {
            let message = format!("is of chains and skins, and `{make}` has none: leave it out");
            Err(Fault::invalid(message))
        }
        _ => Ok(()),
    }
}

/// The maker with its parameters, those that are not said filled in; their ranges are the maker's to check.
///
/// Errors: a parameter that has to be said is not; a ragdoll in space.
pub(in crate::scene) fn maker(body: &BodyKeys, dimensions: usize, source: &Source) -> Result<Maker, Fault> {
    let corner = |key, corner: Option<Vector>| need(body, key, corner).map(|corner| corner.embed());
    let seed = body.seed.unwrap_or(0);
    Ok(match body.make {
        MakerName::Points => Maker::Points(Points {
            count: need(body, "count", body.count)?,
            min: corner("min", body.min)?,
            max: corner("max", body.max)?,
            seed,
        }),
        MakerName::RandomGraph => Maker::RandomGraph(RandomGraph {
            count: need(body, "count", body.count)?,
            bonds: need(body, "bonds", body.bonds)?,
            min: corner("min", body.min)?,
            max: corner("max", body.max)?,
            seed,
        }),
        MakerName::Rim => Maker::Rim(rim(body)),
        MakerName::Box => Maker::Box(BoxFrame {
            width: need(body, "width", body.width)?,
            height: need(body, "height", body.height)?,
            supports: body.supports.unwrap_or(1),
        }),
        MakerName::Rope => Maker::Rope(Rope { count: need(body, "count", body.count)?, stretch: stretch(body)? }),
        MakerName::Cloth => Maker::Cloth(cloth(body, dimensions)?),
        MakerName::Lattice => Maker::Lattice(Lattice {
            columns: need(body, "columns", body.columns)?,
            rows: need(body, "rows", body.rows)?,
            spacing: need(body, "spacing", body.spacing)?,
        }),
        MakerName::Disc => Maker::Disc(Disc {
            radius: need(body, "radius", body.radius)?,
            spacing: need(body, "spacing", body.spacing)?,
        }),
        MakerName::Picture => Maker::Cutout(cutout::maker(body, dimensions, source)?),
        MakerName::Ragdoll => Maker::Ragdoll(ragdoll(body, dimensions)?),
    })
}

/// Errors: the parameter is not said.
pub(super) fn need<T>(body: &BodyKeys, key: &str, value: Option<T>) -> Result<T, Fault> {
    value.ok_or_else(|| Fault::invalid(format!("`{}` needs `{key}`: add it", body.make)))
}

fn cloth(body: &BodyKeys, dimensions: usize) -> Result<Cloth, Fault> {
    Ok(Cloth {
        columns: need(body, "columns", body.columns)?,
        rows: need(body, "rows", body.rows)?,
        spacing: need(body, "spacing", body.spacing)?,
        diagonals: match body.diagonals {
            Some(DiagonalsName::None) => Diagonals::None,
            Some(DiagonalsName::One) => Diagonals::One,
            Some(DiagonalsName::Both) => Diagonals::Both,
            None => Diagonals::default(),
        },
        is_covered: dimensions == 3,
        u: body.u.map_or(Cloth::U, |u| u.embed()),
        v: body.v.map_or(Cloth::V, |v| v.embed()),
    })
}

/// Errors: in space, where no angle acts.
fn ragdoll(body: &BodyKeys, dimensions: usize) -> Result<Ragdoll, Fault> {
    if dimensions == 3 {
        return Err(
            Fault::invalid("`ragdoll` has joints, which act in the plane only: leave it out in space").at("make")
        );
    }
    Ok(Ragdoll { height: body.height.unwrap_or(Ragdoll::default().height) })
}

fn rim(body: &BodyKeys) -> Rim {
    let brace = |name: &BraceName| match name {
        BraceName::Outer => Brace::Outer,
        BraceName::Inner => Brace::Inner,
        BraceName::Spoke => Brace::Spoke,
        BraceName::Rising => Brace::Rising,
        BraceName::Falling => Brace::Falling,
    };
    let standard = Rim::default();
    Rim {
        radius: body.radius.unwrap_or(standard.radius),
        inner_radius: body.inner_radius.unwrap_or(standard.inner_radius),
        sectors: body.sectors.unwrap_or(standard.sectors),
        bracing: match &body.bracing {
            Some(names) => names.iter().map(brace).collect(),
            None => standard.bracing,
        },
    }
}

fn stretch(body: &BodyKeys) -> Result<Stretch, Fault> {
    match (body.spacing, body.to) {
        (Some(_), None) if body.slack.is_some() => {
            Err(Fault::invalid("is of a rope with an end: give `to` in place of `spacing`, or leave it out")
                .at("slack"))
        }
        (Some(spacing), None) => Ok(Stretch::Spacing(spacing)),
        (None, Some(to)) => Ok(body.slack.map_or(Stretch::To(to.embed()), |slack| Stretch::Hanging(to.embed(), slack))),
        (Some(_), Some(_)) => Err(Fault::invalid(
            "stands beside `spacing`: give how far apart the points are or where the rope ends, not both",
        )
        .at("to")),
        (None, None) => Err(Fault::invalid("`rope` needs `spacing` or `to`: add one of them")),
    }
}
