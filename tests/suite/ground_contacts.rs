//! Contacts of bodies on triangle ground: no ghost collisions while they slide, which normals edges and corners may
//! give, and everything else against a loop over all triangles.

mod beyond;
mod brute;
mod curves;
mod edges;
mod fields;
mod large;
mod low_bends;
mod needles;
mod normals;
mod order;
mod rims;
mod scenes;
mod slide;
mod turned;
mod walls;
