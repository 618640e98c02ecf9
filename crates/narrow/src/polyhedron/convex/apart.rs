//! Closest points, for queries that need nothing else.

use super::Convex;
use crate::polyhedron::distance::{Until, distance};
use crate::polyhedron::gap::Gap;
use crate::polyhedron::portal::{self, Found};
use crate::precision::at_least;

impl Convex<'_> {
    /// The closest points of two solids as [`Convex::probe`] would find them, by the fastest path; unclear for pairs
    /// that are not both solids, and for those that nearly touch.
    pub(crate) fn gap(&self, limit: f64) -> Gap {
        let radii = [self.shape_a.radius(), self.shape_b.radius()];
        if let Some(cuboids) = self.cuboids() {
            return cuboids.gap(radii, limit, &self.precision);
        }
        if self.simple().is_some() {
            return Gap::Unclear;
        }
        let beyond = limit + self.radii + self.precision.projection();
        self.with_solids(|a, b| {
            // What is far apart needs no search for a common point.
            let found = match self.direction_apart() {
                Some(direction) => Found::Nothing(direction),
                None => portal::search(a, b, beyond, &self.precision),
            };
            let towards = match found {
                Found::Beyond(_, separation) => {
                    return Gap::Beyond(at_least(separation - self.radii, &self.precision));
                }
                Found::Overlap => return Gap::Overlapping,
                Found::Nothing(direction) => direction,
            };
            let until = Until { beyond, ..Until::met(&self.precision) };
            Gap::of(&distance(a, b, towards, &until), radii, beyond, &self.precision)
        })
    }
}
