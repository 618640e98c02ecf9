//! The families in space.

mod body;
mod faces;
mod features;
mod mixed;
mod rounds;
mod scales;
mod solids;
mod thin;

pub(super) use body::Draft3;

use super::Family3;
use super::gap::{GAP_KNOB, GAPS};
use thin::{THIN_KNOB, THIN_LEVELS};

/// Every hard family in space, in the order in which results are listed.
pub static FAMILIES3: &[Family3] = &[
    Family3 {
        name: "face-ulps",
        about: "bricks along the axes, face on face or edge on edge, a few ulps apart or sunk",
        knob: "at most 256 ulps at level 0, half as many each level on, one or none at the last",
        levels: faces::ULP_LEVELS,
        make: faces::face_ulps,
    },
    Family3 {
        name: "face-rotated",
        about: "bricks face on face under one rotation, half of them such that touching is exact",
        knob: GAP_KNOB,
        levels: GAPS,
        make: faces::face_rotated,
    },
    Family3 {
        name: "coincident-faces",
        about: "bricks of a grid that share faces, edges and corners exactly, turned by quarter turns",
        knob: "0: not turned; 1: quaternions of whole numbers; 2: normalised ones, and extents that are not dyadic",
        levels: 3,
        make: faces::coincident_faces,
    },
    Family3 {
        name: "identical",
        about: "one shape twice in one pose, or nearly",
        knob: "0: one pose; 1: moved by thousandths; 2: moved by less; 3: moved by ulps",
        levels: 4,
        make: faces::identical,
    },
    Family3 {
        name: "stack",
        about: "bricks whose sides are tenths of a metre, stacked by adding up",
        knob: "up to 1, 10, 100, 1000 courses",
        levels: 4,
        make: faces::stack,
    },
    Family3 {
        name: "parallel-edges",
        about: "an edge along an edge, a little apart, touching or sunk",
        knob: "angle of 1e-2 rad at level 0, a tenth of that each level on, none at the last",
        levels: 8,
        make: features::parallel_edges,
    },
    Family3 {
        name: "crossed-edges",
        about: "cubes, an edge of one across an edge of the other, half of them with whole numbers for everything",
        knob: GAP_KNOB,
        levels: GAPS,
        make: features::crossed_edges,
    },
    Family3 {
        name: "vertex-face",
        about: "a vertex over a face",
        knob: GAP_KNOB,
        levels: GAPS,
        make: features::vertex_face,
    },
    Family3 {
        name: "vertex-edge",
        about: "a vertex over an edge",
        knob: GAP_KNOB,
        levels: GAPS,
        make: features::vertex_edge,
    },
    Family3 {
        name: "vertex-vertex",
        about: "a vertex over a vertex",
        knob: GAP_KNOB,
        levels: GAPS,
        make: features::vertex_vertex,
    },
    Family3 {
        name: "deep",
        about: "one within the other, or nearly concentric",
        knob: "middles 0.1 of size apart, 1e-3, 1e-6, 1e-12, none",
        levels: 5,
        make: mixed::deep,
    },
    Family3 {
        name: "far",
        about: "anything near touching, far from the origin",
        knob: "100 m away at level 0, ten times that each level on, 1e9 m at the last",
        levels: scales::FAR_LEVELS,
        make: scales::far,
    },
    Family3 {
        name: "size-ratio",
        about: "a small thing near touching a large one",
        knob: "one is 10 times the other at level 0, ten times that each level on, 1e6 at the last",
        levels: 6,
        make: scales::size_ratio,
    },
    Family3 {
        name: "needles",
        about: "long and thin solids across and beside each other",
        knob: THIN_KNOB,
        levels: THIN_LEVELS,
        make: thin::needles,
    },
    Family3 {
        name: "plates",
        about: "thin plates on and across each other",
        knob: THIN_KNOB,
        levels: THIN_LEVELS,
        make: thin::plates,
    },
    Family3 {
        name: "slivers",
        about: "hulls with vertices that are nearly in line or in one plane",
        knob: "such vertices stand out by up to a 300th of size at level 0, a tenth of that each level on",
        levels: THIN_LEVELS,
        make: thin::slivers,
    },
    Family3 {
        name: "flat",
        about: "flat hulls and triangles against solids and each other, in one plane too",
        knob: GAP_KNOB,
        levels: GAPS,
        make: thin::flat,
    },
    Family3 {
        name: "segments",
        about: "segments against everything, crossing, in line and side by side",
        knob: GAP_KNOB,
        levels: GAPS,
        make: thin::segments,
    },
    Family3 {
        name: "points-and-balls",
        about: "balls, capsules and rounded solids, most at distances that are whole numbers",
        knob: "at most 128 ulps off at level 0, half as many each level on, exact touching at the last",
        levels: rounds::BALL_LEVELS,
        make: rounds::points_and_balls,
    },
    Family3 {
        name: "half-space",
        about: "everything on half-spaces with tilted normals, and half-spaces back to back",
        knob: GAP_KNOB,
        levels: GAPS,
        make: mixed::half_space,
    },
    Family3 {
        name: "compounds",
        about: "compounds with parts that touch parts by ulps",
        knob: "at most 256 ulps at level 0, a quarter of that each level on",
        levels: 5,
        make: mixed::compounds,
    },
    Family3 {
        name: "drifted",
        about: "rotations that are products of f32 rotations, never normalised, of any length",
        knob: "10, 100, 1000, 10000 products",
        levels: 4,
        make: mixed::drifted,
    },
    Family3 {
        name: "tiny",
        about: "pebbles, near touching",
        knob: "1e-3 m wide, 1e-4, 1e-5, at the least radius of 1e-6 m",
        levels: 4,
        make: scales::tiny,
    },
    Family3 {
        name: "huge",
        about: "mountains, near touching",
        knob: "1e3 m wide, 1e4, 1e5, at the largest radius of 1e6 m",
        levels: 4,
        make: scales::huge,
    },
    Family3 {
        name: "scaled",
        about: "ordinary contacts with every number multiplied by a power of two",
        knob: "by 2^3 or 2^-3, then with exponents of 8, 13, 17",
        levels: 4,
        make: scales::scaled,
    },
    Family3 {
        name: "denormal",
        about: "numbers next to nothing beside ordinary ones",
        knob: "0: in places; 1: in vertices; 2: in rotations; 3: in all",
        levels: 4,
        make: scales::denormal,
    },
    Family3 {
        name: "round-hulls",
        about: "hulls of many vertices, near touching",
        knob: "64, 128, 192, 256 vertices",
        levels: 4,
        make: rounds::round_hulls,
    },
    Family3 {
        name: "prisms",
        about: "prisms with caps of one face, cap on cap, cap on side, side on side",
        knob: "up to 3 sides, 5, 8, 16, 32, 64",
        levels: 6,
        make: rounds::prisms,
    },
    Family3 {
        name: "random",
        about: "anything anywhere near: the easy control",
        knob: "there is one level",
        levels: 1,
        make: mixed::random_pair,
    },
    Family3 {
        name: "resting",
        about: "bodies at rest, face on face, a little sunk",
        knob: "sunk by up to 1e-3 of size at level 0, a tenth of that each level on, 1e-7 at the last",
        levels: 5,
        make: mixed::resting,
    },
];
