//! The families in the plane: the twins of those in space.

mod body;
mod edges;
mod features;
mod mixed;
mod outlines;
mod scales;

pub(super) use body::Draft2;

use super::Family2;
use super::gap::{GAP_KNOB, GAPS};

/// Every hard family in the plane, in the order in which results are listed.
pub static FAMILIES2: &[Family2] = &[
    Family2 {
        name: "edge-ulps",
        about: "rectangles along the axes, edge on edge or corner on corner, a few ulps apart or sunk",
        knob: "at most 256 ulps at level 0, half as many each level on, one or none at the last",
        levels: edges::ULP_LEVELS,
        make: edges::edge_ulps,
    },
    Family2 {
        name: "edge-rotated",
        about: "rectangles edge on edge under one rotation, half of them such that touching is exact",
        knob: GAP_KNOB,
        levels: GAPS,
        make: edges::edge_rotated,
    },
    Family2 {
        name: "coincident-edges",
        about: "rectangles of a grid that share edges and corners exactly, turned by quarter turns",
        knob: "0: not turned; 1: turned; 2: with extents that are not dyadic",
        levels: 3,
        make: edges::coincident_edges,
    },
    Family2 {
        name: "identical",
        about: "one shape twice in one pose, or nearly",
        knob: "0: one pose; 1: moved by thousandths; 2: moved by less; 3: moved by ulps",
        levels: 4,
        make: edges::identical,
    },
    Family2 {
        name: "stack",
        about: "rectangles whose sides are tenths of a metre, stacked by adding up",
        knob: "up to 1, 10, 100, 1000 courses",
        levels: 4,
        make: edges::stack,
    },
    Family2 {
        name: "parallel-edges",
        about: "an edge on an edge, a little apart, touching or sunk",
        knob: "angle of 1e-2 rad at level 0, a tenth of that each level on, none at the last",
        levels: 8,
        make: features::parallel_edges,
    },
    Family2 {
        name: "vertex-edge",
        about: "a vertex over an edge",
        knob: GAP_KNOB,
        levels: GAPS,
        make: features::vertex_edge,
    },
    Family2 {
        name: "vertex-vertex",
        about: "a vertex over a vertex",
        knob: GAP_KNOB,
        levels: GAPS,
        make: features::vertex_vertex,
    },
    Family2 {
        name: "deep",
        about: "one within the other, or nearly concentric",
        knob: "middles 0.1 of size apart, 1e-3, 1e-6, 1e-12, none",
        levels: 5,
        make: mixed::deep,
    },
    Family2 {
        name: "far",
        about: "anything near touching, far from the origin",
        knob: "100 m away at level 0, ten times that each level on, 1e9 m at the last",
        levels: scales::FAR_LEVELS,
        make: scales::far,
    },
    Family2 {
        name: "size-ratio",
        about: "a small thing near touching a large one",
        knob: "one is 10 times the other at level 0, ten times that each level on, 1e6 at the last",
        levels: 6,
        make: scales::size_ratio,
    },
    Family2 {
        name: "needles",
        about: "long and thin shapes across and beside each other",
        knob: "one in 100 thick at level 0, a tenth of that each level on",
        levels: 5,
        make: mixed::needles,
    },
    Family2 {
        name: "polygons",
        about: "polygons of 3 to 4096 sides, near touching",
        knob: "3 sides, 5, 8, 16, 64, 256, 1024, 4096",
        levels: 8,
        make: features::polygons,
    },
    Family2 {
        name: "segments",
        about: "segments against everything, crossing, in line and side by side",
        knob: GAP_KNOB,
        levels: GAPS,
        make: mixed::segments,
    },
    Family2 {
        name: "points-and-balls",
        about: "circles, capsules and rounded shapes, most at distances that are whole numbers",
        knob: "at most 128 ulps off at level 0, half as many each level on, exact touching at the last",
        levels: mixed::BALL_LEVELS,
        make: mixed::points_and_balls,
    },
    Family2 {
        name: "half-plane",
        about: "everything on half-planes with tilted normals, and half-planes back to back",
        knob: GAP_KNOB,
        levels: GAPS,
        make: mixed::half_plane,
    },
    Family2 {
        name: "compounds",
        about: "compounds with parts that touch parts by ulps",
        knob: "at most 256 ulps at level 0, a quarter of that each level on",
        levels: 5,
        make: mixed::compounds,
    },
    Family2 {
        name: "drifted",
        about: "rotations that are products of f32 rotations, thousands of them",
        knob: "10, 100, 1000, 10000 products",
        levels: 4,
        make: mixed::drifted,
    },
    Family2 {
        name: "tiny",
        about: "pebbles, near touching",
        knob: "1e-3 m wide, 1e-4, 1e-5, at the least radius of 1e-6 m",
        levels: 4,
        make: scales::tiny,
    },
    Family2 {
        name: "huge",
        about: "mountains, near touching",
        knob: "1e3 m wide, 1e4, 1e5, at the largest radius of 1e6 m",
        levels: 4,
        make: scales::huge,
    },
    Family2 {
        name: "scaled",
        about: "ordinary contacts with every number multiplied by a power of two",
        knob: "by 2^3 or 2^-3, then with exponents of 8, 13, 17",
        levels: 4,
        make: scales::scaled,
    },
    Family2 {
        name: "denormal",
        about: "numbers next to nothing beside ordinary ones",
        knob: "0: in places; 1: in vertices; 2: in rotations; 3: in all",
        levels: 4,
        make: scales::denormal,
    },
    Family2 {
        name: "random",
        about: "anything anywhere near: the easy control",
        knob: "there is one level",
        levels: 1,
        make: mixed::random_pair,
    },
    Family2 {
        name: "resting",
        about: "bodies at rest, edge on edge, a little sunk",
        knob: "sunk by up to 1e-3 of size at level 0, a tenth of that each level on, 1e-7 at the last",
        levels: 5,
        make: mixed::resting,
    },
];
