//! The keys of a body: its maker with parameters, its place and its material.

use super::bond::KindName;
use super::color::ColorKey;
use super::macros::{names, object};
use super::vector::Vector;

names! {
    /// What makes a body.
    #[derive(Default)]
    MakerName: "a maker" {
        /// Loose points.
        #[default]
        Points = "points",
        /// Points with random bonds.
        RandomGraph = "random-graph",
        /// Two rings.
        Rim = "rim",
        /// Four corners.
        Box = "box",
        /// A row.
        Rope = "rope",
        /// A hanging grid.
        Cloth = "cloth",
        /// A standing grid.
        Lattice = "lattice",
        /// A meshed disc.
        Disc = "disc",
        /// A meshed bitmap.
        Picture = "picture",
        /// A figure with joints.
        Ragdoll = "ragdoll",
    }
}

names! {
    /// A bond that every sector of a rim has.
    BraceName: "a bond of a rim" {
        /// Along the outer ring.
        Outer = "outer",
        /// Along the inner ring.
        Inner = "inner",
        /// Between the rings.
        Spoke = "spoke",
        /// From the inner ring to the next outer point.
        Rising = "rising",
        /// From the outer ring to the next inner point.
        Falling = "falling",
    }
}

names! {
    /// Bonds across each cell of a cloth.
    DiagonalsName: "a choice of diagonals" {
        /// None.
        None = "none",
        /// One.
        One = "one",
        /// Two.
        Both = "both",
    }
}

names! {
    /// What becomes of strokes of a picture that are too thin for triangles.
    StrokesName: "a choice for thin strokes" {
        /// Chains of bonds.
        Ropes = "ropes",
        /// Drawn wider.
        Widen = "widen",
        /// Left out.
        Drop = "drop",
        /// Small triangles.
        Mesh = "mesh",
    }
}

names! {
    /// Which points of a picture's mesh are bonded.
    PatternName: "a pattern of bonds" {
        /// The sides of triangles.
        Edges = "edges",
        /// Those, and the far corners of triangles side by side.
        Braced = "braced",
    }
}

object! {
    /// What the bonds and points of a body are made of.
    #[derive(Default)]
    Material: "a material: an object with keys such as `kind` and `stiffness`" {
        optional {
            /// As of a bond.
            kind: KindName,
            /// As of a bond `[N/m]`.
            stiffness: f64,
            /// As of a bond `[m/N]`.
            compliance: f64,
            /// As of a bond `[N s/m]`.
            damping: f64,
            /// picture, of springs, in place of `stiffness`: Young's modulus in the plane `[N/m]`. A mesh of it is as soft at any
            /// spacing; without `damping` its slowest wobble is damped to a tenth of the critical damping.
            young: f64,
            /// As of a bond `[1]`.
            relaxation: f64,
            /// As of a bond `[1]`.
            max_correction: f64,
            /// As of a bond `[1]`.
            break_strain: f64,
            /// rim, box, rope, lattice, disc, picture, in the plane: how hard chains of bonds and the skin of what has an area are to bend,
            /// E I `[N m^2]`, >= 0: 0 if not said. They get angles of that over the distance of their points, so that finer ones bend the same.
            bending: f64,
            /// Of the whole body `[kg]`, > 0, shared by area or length; not together with `point_mass`.
            mass: f64,
            /// Of each point `[kg]`, > 0: 1 if not said.
            point_mass: f64,
            /// Of its skin `[1]`, >= 0: that of `contact` if not said.
            friction: f64,
            /// Of its skin `[1]`, from 0 to 1: that of `contact` if not said.
            restitution: f64,
            /// Of its skin `[m]`, >= 0: that of `contact` if not said.
            radius: f64,
            /// Whether its parts are layers that pass each other, where bodies meet themselves: those of a ragdoll are if not said, no others.
            layered: bool,
            /// What it is filled in, and a picture is tinted by that is drawn on it: "#rrggbb"; one of a palette if not said.
            color: ColorKey,
            /// How wide its bonds are drawn `[m]`, >= 0: 0, as is usual, if not said. What meets it is as far off as `radius` says.
            width: f64,
            /// Whether it is drawn: true if not said. What is hidden moves and meets others as if it were seen.
            visible: bool,
        }
    }
}

object! {
    /// Copies of a body side by side.
    RepeatKeys: "a repeat: an object with the keys `count` and `step`" {
        required {
            /// How many along x and y, in space also along z: 1 or more each.
            count: Vec<u64>,
            /// From a copy to the next along each axis `[m]`.
            step: Vector,
        }
    }
}

object! {
    /// A body: points and bonds made from a few parameters. Which of them a maker takes is checked; see `make`.
    #[derive(Default)]
    BodyKeys: "a body: an object with the key `make`" {
        required {
            /// Its maker.
            make: MakerName,
        }
        optional {
            /// points, random-graph, rope: how many points.
            count: u64,
            /// random-graph: how many bonds.
            bonds: u64,
            /// points, random-graph: lower corner `[m]`.
            min: Vector,
            /// points, random-graph: upper corner `[m]`.
            max: Vector,
            /// points, random-graph: seed of the draws, 0 if not said.
            seed: u64,
            /// rim, disc: outer radius `[m]`; of a rim 2 if not said.
            radius: f64,
            /// rim: inner radius `[m]`, 1.8 if not said.
            inner_radius: f64,
            /// rim: points on each ring, 12 if not said.
            sectors: u64,
            /// rim: the bonds of each sector; all but "falling" if not said.
            bracing: Vec<BraceName>,
            /// box: along x `[m]`.
            width: f64,
            /// box: along y `[m]`; picture: of the whole picture `[m]`, 2 if not said; ragdoll: as it would stand upright `[m]`, 1.7 if not said.
            height: f64,
            /// box: diagonals, 0, 1 or 2; 1 if not said.
            supports: u64,
            /// rope, cloth, lattice, disc, picture: distance of neighbours `[m]`; of a picture a fortieth of its longer side if
            /// not said.
            spacing: f64,
            /// rope, in place of `spacing`: where it ends, seen from the body's origin `[m]`.
            to: Vector,
            /// rope, beside `to`: by what share it is longer than the straight way there `[1]`, > 0; it hangs on an arc. Straight if not said.
            slack: f64,
            /// cloth, lattice: points in a row.
            columns: u64,
            /// cloth, lattice: rows.
            rows: u64,
            /// cloth: bonds across each cell, both if not said.
            diagonals: DiagonalsName,
            /// cloth in space: direction of the rows, `[1,0,0]` if not said.
            u: Vector,
            /// cloth in space: direction from row to row, `[0,-1,0]` if not said.
            v: Vector,
            /// picture: the bitmap, a path relative to the scene or data:image/png;base64,…
            file: String,
            /// picture: coverage above which a pixel belongs to the body `[1]`, 0 to 1; where the picture splits best if not said.
            threshold: f64,
            /// picture: whether light pixels, or clear ones, are the body.
            invert: bool,
            /// picture, in place of `threshold` and `invert`: whether all of it is the body, a rectangle.
            whole: bool,
            /// picture, in place of `spacing`: largest area of a triangle `[px^2]`.
            max_area: f64,
            /// picture: specks and holes smaller than this are left out `[px^2]`, 12 if not said.
            min_area: f64,
            /// picture: over how many pixels it is blurred first, 0 if not said: for grainy photographs.
            blur: u32,
            /// picture: how many times as far apart neighbours may be deep inside as along the boundary, 1 to 9; 1 if not said.
            grading: f64,
            /// picture: whether holes stay holes; they do if not said.
            holes: bool,
            /// picture: what becomes of strokes too thin for triangles; ropes if not said.
            strokes: StrokesName,
            /// picture: which points are bonded: the sides of triangles if not said; "braced" bonds the far corners of every
            /// two triangles that share a side too, which resists folding. `young` means the same stiffness with either.
            pattern: PatternName,
            /// picture: only this of its connected parts, from 0, the largest first; it lies where it does in the whole.
            part: u32,
            /// Where the body's own origin goes `[m]`; the world's if not said.
            origin: Vector,
            /// Rotation about the body's own origin, anticlockwise, in space about z `[rad]`.
            angle: f64,
            /// Of the body's own origin `[m/s]`.
            velocity: Vector,
            /// Rate of rotation about the body's own origin, in space about z `[rad/s]`.
            spin: f64,
            /// What it is made of: rigid bonds and 1 kg a point if not said.
            material: Material,
            /// Copies of it, the first where it would be alone, then along x, y and z; a mass is that of each copy.
            repeat: RepeatKeys,
        }
        lists {
            /// Points that never move, counted within the body, and in each copy.
            pinned: u32,
        }
    }
}
