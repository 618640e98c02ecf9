//! True separations of many pairs in space, in double-double.
//!
//! This is the oracle of the tests (`asunder_tests::precise`), with one addition: it keeps the facets of hulls, since
//! sets draw from few different hulls, and finding facets exactly takes far longer than anything else.

use asunder_geometry::Shape3;
use asunder_scenes::pairs::{PairSet, PosedPair3, SolidKind};
use asunder_tests::precise::depth::{Body, Hull, deepest3};
use asunder_tests::precise::facets::Polyhedron;
use asunder_tests::precise::nearest::{NOISE, nearest};
use asunder_tests::precise::place::{Piece, pieces3};
use asunder_tests::precise::separation3;

/// Keeps the facets of the hulls it has seen, and the truths of the sets it has judged.
///
/// ```
/// use asunder_benches::judge::Judge;
/// use asunder_scenes::pairs::{PairSet, SolidKind, pairs3};
/// let pair = &pairs3(SolidKind::Box, PairSet::Deep, 1, 1)[0];
/// assert!(Judge::default().separation(pair) < -0.4);
/// ```
#[derive(Debug, Default)]
pub struct Judge {
    forms: Vec<(Shape3, Polyhedron)>,
    sets: Vec<((SolidKind, PairSet), Vec<f64>)>,
}

impl Judge {
    /// The separation in metres, accurate to a unit or two in the last place of an f64. Cost in overlap: 50 us for
    /// boxes, 0.5 ms for hulls of 32 vertices, 6 ms for 128, 20 ms for 256, and about half as much again for each hull
    /// seen for the first time.
    pub fn separation(&mut self, pair: &PosedPair3) -> f64 {
        let origin = pair.pose_a.position();
        let (a, b) =
            (pieces3((&pair.shape_a, &pair.pose_a), origin), pieces3((&pair.shape_b, &pair.pose_b), origin));
        let ([a], [b]) = (a.as_slice(), b.as_slice()) else { return of_oracle(pair) };
        let (Some((a, radius_a)), Some((b, radius_b))) = (hull(a), hull(b)) else { return of_oracle(pair) };
        let found = nearest(a.cloud, b.cloud);
        let cores = if found.lower.to_f64() > NOISE * (a.cloud.reach() + b.cloud.reach()) {
            found.upper
        } else {
            let (i, j) = (self.form(&pair.shape_a, a.stored), self.form(&pair.shape_b, b.stored));
            let gap =
                deepest3(Body { hull: a, form: &self.forms[i].1 }, Body { hull: b, form: &self.forms[j].1 })
                    .gap;
            // A tiny gap that the distance alone might not show.
            if gap.to_f64() > 0.0 { found.upper.max(gap) } else { gap }
        };
        (cores - radius_a - radius_b).to_f64()
    }

    /// The separations of some pairs of a set, computed once and then remembered.
    ///
    /// The same pairs must be given for a set every time.
    pub fn separations(&mut self, set: (SolidKind, PairSet), pairs: &[PosedPair3]) -> Vec<f64> {
        if let Some((_, known)) = self.sets.iter().find(|(known, _)| *known == set) {
            return known.clone();
        }
        let found: Vec<f64> = pairs.iter().map(|pair| self.separation(pair)).collect();
        self.sets.push((set, found.clone()));
        found
    }

    /// The index of a shape's facets, which are computed if new.
    fn form(&mut self, shape: &Shape3, stored: &[glam::DVec3]) -> usize {
        if let Some(known) = self.forms.iter().position(|(known, _)| known == shape) {
            return known;
        }
        self.forms.push((shape.clone(), Polyhedron::of(stored)));
        self.forms.len() - 1
    }
}

fn of_oracle(pair: &PosedPair3) -> f64 {
    separation3((&pair.shape_a, &pair.pose_a), (&pair.shape_b, &pair.pose_b)).separation
}

/// A piece's core and radius; `None` for a half-space.
fn hull(piece: &Piece) -> Option<(Hull<'_>, asunder_tests::precise::dd::Dd)> {
    match piece {
        Piece::Round { cloud, stored, turn, radius } => Some((Hull { cloud, stored, turn }, *radius)),
        Piece::Half { .. } => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asunder_scenes::pairs::pairs3;

    #[test]
    fn it_says_what_the_oracle_says() {
        let mut judge = Judge::default();
        for kind in [SolidKind::Box, SolidKind::Authored, SolidKind::Hull16] {
            for set in PairSet::ALL {
                for pair in &pairs3(kind, set, 12, 3)[..12] {
                    assert_eq!(judge.separation(pair), of_oracle(pair), "{}/{}", kind.name(), set.name());
                }
            }
        }
    }
}
