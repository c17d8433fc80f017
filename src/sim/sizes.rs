//! Sizes at which the method changes: how many bonds, points or substeps one way of moving them is meant for, and where the next takes
//! over.
//!
//! Each says what changes at it, what that trades, how it was measured, and what breaks beyond. "Work" is counted
//! ([`Counters::work`](super::counters::Counters::work)), "time" is processor time of a build by `opt-level = 1` in a busy machine of two
//! cores, to a factor of about 1.5; both are those just above the size in those just below, in the scenes that the size's test runs
//! (`tests/sizes`). `docs/sizes.md` has these figures in a table, and the tests hold errors and work to it. What changes only where
//! something is stored or looked up, and no result, is beside its code.

/// Most rigid bonds of an island without a rigid body in it that meets surfaces and is moved as bodies in joints, each point one; of more
/// each bond is a constraint of RATTLE.
///
/// Trades work for friction: at one point it is a share of all that presses there, also through bonds, and bodies in joints know it.
/// Measured: a rope of 12 and 13 rods on a floor, errors of 2e-6 and 4e-5 m, work 0.61, time 0.1. Beyond: all that lies on something is
/// solved together, and the cost grows with its square.
pub const MOST_RODS: usize = 12;

/// Most points without rigid bonds, of one method and among the walls of polygons, whose impacts are located in time; of more they are met
/// at the end of each substep.
///
/// Trades accuracy for work: a wall is met and left all the time, by each point for itself, and each time cuts the substep of all.
/// Measured: 40 and 41 points that fall on a hill, errors of 1e-12 and 3e-3 m, work 0.34, time 0.3. Beyond: a crowd of some hundred points
/// takes longer than a frame.
pub const MOST_AMONG_WALLS: usize = 40;

/// Most rigid bonds of an island that meets surfaces and is solved together, each impact and each lift located; of more, it goes by paths,
/// to a strain of 1e-4.
///
/// Trades accuracy of impacts for a bounded cost. Measured: a rope that swings onto a floor, errors of 1 and 6 cm after it has struck,
/// since each strike parts neighbouring motions; work 0.02, time 0.2. Beyond: there are so many impacts that hardly any time passes between
/// them.
pub const MOST_LOCATED_RODS: usize = 60;

/// Most contacts of an impact of points in rigid bonds, all that lie there included, whose friction goes through bonds; of more, each point's
/// is a share of what presses there by itself.
///
/// Trades friction through bonds for work, where a method that locates impacts is asked for by its name: `auto` has no more rods there than
/// [`MOST_LOCATED_RODS`]. Measured: a rope that swings onto a floor on which so many points lie, errors of 1e-6 and 2e-3 m, work 1.0.
/// Beyond: each impact solves for the answers of all contacts, and the cost grows with their square.
pub const MOST_STRUCK: usize = 90;

/// Most rigid bonds of a tree that nothing stops whose steps are of order 8, checked by their errors; of more, RATTLE of order 2.
///
/// Trades accuracy for steps that are never taken anew. Measured: ropes of 250 and 251 bonds, errors of 5e-9 and 1e-5 m, work 2.2, time
/// 1.9: where the motion is smooth, order 8 is the cheaper one as well. Beyond: some part of a long rope cracks like a whip all the time,
/// and each crack cuts the step of the whole.
pub const MOST_FINE_RODS: usize = 250;

/// Most rigid bodies in joints of an island, and most rods and joints between them; of more, each bond is a constraint of RATTLE.
///
/// Trades work for motion: bodies turn in closed form. Measured: rows of 300 and 301 jointed triangles, errors of 5e-6 and 2e-4 m, work
/// 1.8, time 0.6. Beyond: the elimination for the joints is no longer a handful of unknowns.
pub const MOST_PIECES: usize = 300;

/// Largest tree of rigid bonds that goes by paths where a strain is asked for; of more, all are solved together.
///
/// Trades time for lengths: elimination from the leaves on holds them to rounding. Measured: trees of 400 and 401 bonds thrown apart, to a
/// strain of 0.01: errors of 4e-4 and 4e-7 m, time 12: paths were the cheaper ones of this tree, and the size is older than that figure.
/// Beyond: paths of a branching tree are short, and errors wander from one to the next.
pub const MOST_SWEPT_TREE: usize = 400;

/// Most bonds with a limit whose taut and slack moments are located; of more, each decides at any evaluation whether it acts.
///
/// Trades accuracy for work. Measured: a row of 380 strings thrown about, errors of 3e-7 and 2e-4 m, work and time 0.01. Beyond: so many
/// get taut and slack that cutting substeps there costs more than all else.
pub const MOST_LIMITED: usize = 400;

/// Most springs of an island that meets surfaces by a method of order 4, its touches located; of more, Verlet's method by forces in
/// vectors.
///
/// Trades accuracy for work. Measured: a net that falls on a floor, errors of 3e-6 and 1e-3 m, work and time 0.01; nothing between the two
/// is to be had. Beyond: so many points touch and slip that locating each costs more than all else.
pub const MOST_TOUCHING: usize = 800;

/// Most points of one method whose events are located, and whose violent substeps go to an implicit method.
///
/// Trades accuracy of a bounce for work. Measured: 1,000 and 1,001 points that fall on a floor, errors of 1e-5 and 1e-3 m, work and time
/// 0.05. Beyond: each event cuts the step of all.
pub const MOST_LOCATED: usize = 1_000;

/// Most rigid bonds that are solved together; of more, the island goes by paths, to a strain.
///
/// Trades lengths to rounding for a cost that grows no faster than the bonds. Measured: ropes of 2,000 and 2,001 bonds, errors of 1e-5 and
/// 2e-3 m, work 0.02, time 0.9. Beyond: a net's factors grow with the power 3/2 of its bonds.
pub const MOST_DIRECT: usize = 2_000;

/// Most pairs of rigid bonds that share a point in an island that is solved together (in trees so many for each [`MOST_DIRECT`]); of more
/// it goes by paths.
///
/// Trades lengths to rounding for work: a star of n spokes couples all with all, n^2/2 pairs and n^3/6 operations. Measured: stars of 346
/// spokes, errors of 1e-7 and 6e-6 m, work 0.03, time 0.5. Beyond: a star of 1,000 spokes takes a second for a frame.
pub const MOST_COUPLINGS: usize = 60_000;

/// Most rigid bonds of an island in which several rigid bodies are looked for.
///
/// Trades motion for the time to compile: a large body in two halves would be two rigid bodies. Measured: not by a motion, since a net of
/// more is no rigid body, and goes by paths on both sides. Beyond: a net is sorted in vain for longer than a frame.
pub const MOST_SOUGHT: usize = 100_000;

/// Most points of an island in space whose rank says that it is a rigid body, where its points cannot be laid out one after the other.
///
/// Trades motion for the time to compile, which grows like the third power: 64 points take 20 ms. Measured: not by a motion, since most
/// bodies are laid out, whatever their size. Beyond: a scene with many such bodies begins late.
pub const MOST_RANKED: usize = 64;

/// Most corners of the convex hull of a rigid body in space in a scene with planes or bounds: of more, its bonds are moved.
///
/// Trades motion for work: each corner that lies on something feels all others, and rolls over them one by one. Measured: frictionless discs of 12
/// and 24 corners on a plane take 0.5 and 2 ms a frame. Beyond: one of 16 corners that rolls takes 25 ms, one of 24 that spins as it falls 50 ms.
pub const MOST_CORNERS: usize = 12;

/// Most points of an island of stiff springs that is moved by an implicit method, however its bonds hang together; of more, where its
/// factors pay: those of a tree do, those of a net beyond [`STIFF_OF_A_NET`].
///
/// Trades nothing at the size, where both cost about the same: an implicit step has factors, an explicit method has substeps. Measured:
/// nets of 3,999 and 4,000 points at 600 substeps a frame, errors of 3e-5 and 1e-9 m, work 0.67. Beyond: factors no longer fit a cache.
pub const MOST_IMPLICIT: usize = 4_000;

/// Substeps a frame, over the square root of the points of a net of more than [`MOST_IMPLICIT`], beyond which its factors are cheaper than
/// explicit steps.
///
/// Trades nothing; it says where both cost the same. Measured: nets of 4,100 points just below and above, errors of 1e-9 and 3e-5 m, work
/// 1.4. Beyond: by explicit steps alone a row of 4,000 springs of 1 GN/m takes 38 times as long as implicitly.
pub const STIFF_OF_A_NET: f64 = 10.0;

/// Most points of a scene whose springs are moved by methods of order 4; in one of more, Verlet's method by forces in vectors.
///
/// Trades accuracy for work. Measured: rows of 20,000 springs, errors of 3e-10 and 3e-6 m, work and time 0.2. Beyond: what is shown of such
/// meshes is coarser than what Verlet's method errs.
pub const LARGE: usize = 20_000;

/// Substeps a frame of a method of order 4 beyond which springs are stiff, and an implicit method moves them.
///
/// Trades fast oscillations, which an implicit step rounds off, for work. Measured: a row of 50 springs, errors of 2e-8 and 7e-5 m, work
/// 0.03, time 0.1. Beyond: a spring of 1 GN/m would take 100 times as long.
pub const STIFF: f64 = 256.0;

/// Counted work of a frame up to which stiff springs that surfaces may strike are moved by explicit steps, all bodies as stiff together; beyond,
/// by an implicit method.
///
/// Trades what a blow makes of springs, which an implicit step rounds off, so that a body bounces too low, for work. Measured: a net of
/// 144 points that falls on a floor, errors of 3e-5 and 9e-3 m, work 0.16. Beyond: a frame takes more than the 4 ms that this is.
pub const MOST_STIFF_STRUCK: f64 = 24_000_000.0;

/// Substeps a frame beyond which springs of more than [`MOST_TOUCHING`] that meet surfaces are moved by an implicit method.
///
/// Trades touches that are met in short substeps for work. Measured: nets of 18 x 18 points above a floor, errors of 3e-5 and 6e-5 m, work
/// 2.3, time 0.3. Beyond: a frame takes longer than it lasts.
pub const MOST_TOUCHES: f64 = 2_000.0;

/// Most substeps that a frame is cut into by a rule.
///
/// Trades the fastest oscillations for a step that ends: of what is stiffer, a substep spans more phase. Measured: a pair of points on a
/// spring on either side of it: both within 3e-8 m. Beyond: explicit methods asked for by name get less accurate, and diverge at five times
/// as stiff.
pub const MOST_SUBSTEPS: f64 = 100_000.0;

/// Most substeps of a frame that follow a strain.
///
/// Trades strain for a frame that ends. Measured: by no pair of scenes: it is approached by a few per cent a step, not jumped to. Beyond:
/// the strain asked for is not held, which `simulate` says.
pub const MOST_FOR_STRAIN: f64 = 512.0;

/// Points of a scene above which it is made of 32 bits, where nothing is said.
///
/// Trades digits for memory, which rules there: of fewer points scalar code gains 9 to 15 %. Measured: rows of 20,000 springs, 2 km long,
/// errors of 3e-6 and 1e-4 m. Beyond: nothing breaks, and it takes twice the memory.
pub const LARGE_SINGLE: usize = 20_000;

/// The same of scenes with more than [`MOST_DIRECT`] rigid bonds in one net or rope, which are moved by vectors: these take twice as many
/// numbers of 32 bits.
///
/// Trades digits for time. Measured: a cloth of 1,000 points in space: 1e-5 m apart, time 0.6. Beyond: nothing breaks, and it takes up to
/// twice the time.
pub const LARGE_RIGID_SINGLE: usize = 1_000;

/// Fewest equal bodies that go side by side, one a lane of a vector; of fewer, each is a mesh by itself.
///
/// Trades nothing: of fewer bodies most lanes of a wide vector would be idle. Measured: 7 and 8 rims, 2e-4 m apart, time of all 0.2.
/// Beyond: nothing breaks.
pub const FEWEST_ALIKE: usize = 8;

/// Most bonds of a body that goes side by side with equal ones; of more, each is a mesh by itself.
///
/// Trades time: the points of a block of bodies have to stay in the innermost cache. Measured: 8 ladders of 400 and of 401 bonds, 1e-4 m
/// apart, time 2. Beyond: each substep reads all bodies from further out.
pub const MOST_ALIKE_BONDS: usize = 400;

/// Shortest chain that is cut in pieces which are solved side by side, in bonds; a shorter one is a mesh of one path.
///
/// Trades time alone: pieces have ends to be joined. Measured: ropes of 63 and 64 bonds by paths, 6e-4 m apart, time 0.5. Beyond: a short
/// one is slower in pieces than as a whole.
pub const SHORTEST_CHAIN: usize = 64;

/// Mean number of bonds of a mesh's paths below which its bonds are swept.
///
/// Trades lengths for time: long paths pass a pull on at once, short ones no further than sweeps do. Measured: a net of nine rows and
/// columns, errors of 1e-3 and 3e-3 m, work 0.4, time 1.5. Beyond: sweeps of a mesh of long paths take the square of their length.
pub const SHORTEST_TRAILS: f64 = 8.0;

/// Most loose points that make a group; more make several.
///
/// Trades sleep for time: one that sleeps should not be woken by too many others, and a group costs about as much as a few points.
/// Measured: 256 and 257 points in free fall: the same to the bit. Beyond: nothing breaks.
pub const MOST_LOOSE: usize = 256;

/// Most bonds, rigid ones among them, of a group that is handed over to the live step where it costs too much.
///
/// Trades accuracy for a bounded frame. Measured: by no pair of scenes. Beyond: sweeps leave too much strain; large bodies have ways of
/// their own that bear much.
pub const MOST_HANDED_OVER_RIGID: usize = 2_000;

/// The same where no bond is rigid.
///
/// Trades accuracy for a bounded frame. Measured: by no pair of scenes. Beyond: a frame is long by any method.
pub const MOST_HANDED_OVER_SOFT: usize = 40_000;

/// Bonds of a path of rigid bonds from which on the live step solves it as one, in space.
///
/// Trades work for lengths: a sweep passes a pull on by one bond. Measured: by no motion. Beyond: nothing breaks: shorter ones are swept as
/// quickly.
pub const LEAST_LIVE_PATH: usize = 4;

/// Points up to which the live step solves a ring of rigid bonds at once that bears a weight and meets nothing, in the plane: larger ones are
/// swept.
///
/// Trades lengths for work. Measured: by no pair of scenes. Beyond: what light points bear stretches its bonds and loses its energy.
pub const MOST_LIVE_RING: usize = 32;

/// Bonds of the largest tree whose contacts the live step passes over eight times, each pass followed by a round over the tree; for larger
/// ones there are three passes, and a round before the last.
///
/// Trades lengths in a blow for work: a crumpled rope that strikes itself at 40 m/s is strained by 0.5 with three passes. Measured: ropes
/// of 64 and 65 bonds on a floor, both off by 7 cm, work and time 0.9. Beyond: eight passes would take large ones over the time of a frame.
pub const MOST_LIVE_TREE: u32 = 64;

/// Sides from which on a regular polygon is a circle to bodies in the live step.
///
/// Trades nothing that is seen: they lie within 5e-6 of its radius. A circle of a scene has twice as many. Measured: a point that slides
/// off, errors of 3e-3 and 2e-3 m, work 0.05, time 0.5. Beyond: a polygon of more sides has as many walls to be looked at.
pub const LEAST_SIDES: usize = 1024;

/// Work of a step below which one thread takes it, in bonds that are swept (about 0.3 ns each).
///
/// Trades processors for time; no bit depends on it. Measured: others have to be woken, which takes a tenth of a millisecond on some
/// machines. Beyond: nothing breaks.
pub const LEAST_WORK: usize = 1_000_000;

/// Work between two waits for each other below which one thread does it, in the same unit.
///
/// Trades processors for time; no bit depends on it. Measured: a wait takes microseconds, so much work 20. Beyond: nothing breaks.
pub const LEAST_SHARE: usize = 60_000;

/// Counted work of groups in a step below which one thread takes them one after another.
///
/// Trades processors for time; no bit depends on it. Measured: 240 bodies of 200 springs take two thirds of the time on two threads, and
/// the same processor time, in a machine that others keep busy; so much is a quarter of a millisecond by counting, half of one and more by
/// the clock, and waking others a tenth. Beyond: nothing breaks.
pub const LEAST_TOGETHER: u64 = 1_500_000;
