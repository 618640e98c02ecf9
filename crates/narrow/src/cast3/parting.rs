//! Two parts that all but touch at the start, and move apart.
//!
//! Where they are as near as rounding, the axis between their nearest points is rounding over their gap: it shows neither
//! that gap nor that it grows. The axes of their features do: normals of faces, and directions square to edges. As
//! bodies turn, so do these: beside a face that turns, a fixed axis shows no more than the far corner of that face
//! leaves, and between two edges only the axis square to both shows all. So an axis may sway.
//!
//! ```text
//! n  = of the axis between nearest points and those of features, the one that shows the greatest gap       (sharpest)
//! m  = how n sways: not at all, along with either body, or staying square to an edge of each     (apart_by_swaying)
//! at h = all of the motion, a fourth of it, a 16th, ...
//!   the gap along n + h m is clear, and so much greater than at the start that it was never smaller in between: apart
//! ```
//! From there on the usual steps go on.

use super::passage::{Course, Moment};
use crate::polyhedron::closest::{Closest, Placed};
use crate::polyhedron::solid::Solid;
use arrayvec::ArrayVec;
use asunder_geometry::Shape3;
use asunder_geometry::glam::DVec3;

/// Sine of the angle by which an axis between points may be off square to an edge and still be made so: far more than
/// rounding makes of it.
const TILTED: f64 = 1e-3;

/// The most edges at a point that are paired with those at the other.
const MAX_EDGES: usize = 4;

/// Times at which two that all but touch at the start are looked at, to find them apart.
const MAX_TRIES: usize = 20;

/// A unit axis, and the rate at which it moves, square to it.
type Sways = (DVec3, DVec3);

/// The unit axis square to an edge of A and one of B, to the side of another axis, and its rate, square to it, as the
/// edges turn; `None` if they are nearly parallel.
fn square_to([one, other]: [DVec3; 2], [spin_a, spin_b]: [DVec3; 2], side: DVec3) -> Option<Sways> {
    let (one, other) = (one.try_normalize()?, other.try_normalize()?);
    let across = one.cross(other);
    let sine = across.length();
    if sine <= TILTED {
        return None;
    }
    let axis = across * (side.dot(across).signum() / sine);
    // Along A's edge the rate makes up for its turning, and square to that, for B's.
    let lean = |edge: DVec3, spin: DVec3| -axis.dot(spin.cross(edge));
    let sway = other.cross(across) * lean(one, spin_a) + across.cross(one) * lean(other, spin_b);
    Some((axis, sway / (sine * sine)))
}

/// Some of the edges at most `near` metres from a point of a core.
fn edges_at(solid: &Solid, point: DVec3, near: f64) -> ArrayVec<DVec3, MAX_EDGES> {
    let local = solid.to_local(point);
    let is_on = |&edge: &usize| {
        let (from, to) = solid.topology.ends(edge);
        let [from, to] = [from, to].map(|end| solid.vertices[end].as_dvec3());
        let (along, aside) = (to - from, local - from);
        let share = (along.dot(aside) / along.length_squared()).clamp(0.0, 1.0);
        (along * share - aside).length_squared() <= near * near
    };
    let edges = solid.topology.edges().iter().map(|&edge| usize::from(edge));
    edges.filter(is_on).map(|edge| solid.edge_direction(edge)).take(MAX_EDGES).collect()
}

impl Course<'_> {
    /// Makes the axis of two that all but touch at the start as good as it may be; and, if they turn apart, when, and the
    /// axis as it is then.
    pub(super) fn turns_apart(
        &self,
        moment: &Moment,
        found: &mut Closest,
        at_most: f64,
        until: f64,
    ) -> Option<(f64, DVec3)> {
        // Else it shows all the gap there is.
        if found.at_least < 0.5 * at_most {
            (found.normal, found.at_least) = self.sharpest(moment, found);
        }
        // Where they may touch, an exact test has to say first that they do not; and beyond the aim, steps lead on.
        let aim = self.slack + self.fineness.rest(moment.precision.projection());
        let is_within = (found.at_least > 0.0 || self.are_apart) && found.at_least <= aim;
        if is_within { self.apart_by_swaying(moment, found, until) } else { None }
    }

    /// Whether two that may overlap at the start, by rounding, come no nearer than they are.
    pub(super) fn comes_no_nearer(&self, moment: &Moment, found: &Closest, until: f64) -> bool {
        let doubt = moment.precision.projection();
        let least = -4.0 * doubt;
        // An overlap beyond what an axis may be off by needs no test of features; without a bound, it does.
        let is_slight = found.at_least > -self.fineness.rest(doubt) || found.at_least == f64::NEG_INFINITY;
        let is_shown = found.at_least > least
            && (self.parts_along(found.normal, until) || self.leaves_plane(moment, found, until));
        is_shown || is_slight && self.features_part(moment, found, least, until)
    }

    /// Whether the gap along an axis never shrinks before the limit, however fast bodies turn.
    fn parts_along(&self, axis: DVec3, until: f64) -> bool {
        let mut pace = self.closing(axis);
        for ((turn, part), arm) in self.passage.turns.iter().zip(&self.parts).zip(&self.arms) {
            let Some(turn) = turn else { continue };
            if let Shape3::HalfSpace(_) = part.shape {
                return false;
            }
            pace += turn.bounds_within(0.0, until)[0] * arm.from_axis * (1.0 + 64.0 * f64::EPSILON);
        }
        pace <= 0.0
    }

    /// Whether a half-space and a core, of which one turns, never come nearer than they are at the start.
    fn leaves_plane(&self, moment: &Moment, found: &Closest, until: f64) -> bool {
        let cores = [&moment.a, &moment.b].iter().filter(|placed| matches!(placed, Placed::Core(_))).count();
        if cores != 1 || self.passage.is_straight() {
            return false;
        }
        let at_end = self.shown(moment, (found.normal, None), self.closing(found.normal), until);
        let bent = 0.5 * self.bend(moment, None, [0.0, until]) * until * until;
        at_end - bent >= found.at_least
    }

    /// Whether an axis of their features shows a gap of at least `least` that never shrinks before the limit.
    fn features_part(&self, moment: &Moment, found: &Closest, least: f64, until: f64) -> bool {
        let least = least + self.radii + moment.precision.projection();
        let parts = |axis: DVec3| self.parts_along(axis, until) && moment.gap_along(axis) > least;
        self.any_feature(moment, found, parts)
    }

    /// Of the axis between nearest points and those of features, the one that shows the greatest gap, and that.
    fn sharpest(&self, moment: &Moment, found: &Closest) -> (DVec3, f64) {
        let taken = self.radii + moment.precision.projection();
        let mut best = (found.normal, found.at_least);
        self.any_feature(moment, found, |axis| {
            let gap = moment.gap_along(axis) - taken;
            if gap > best.1 {
                best = (axis, gap);
            }
            false
        });
        best
    }

    /// Whether any axis of a feature is as wanted: the normal of a face, and those square to an edge, or to one of each,
    /// next to the axis between nearest points. That one is off by the rounding of the longer lengths over the shorter:
    /// it may show none of a small body's gap from a floor some thousand times as large, and next to none where the
    /// points are as near as rounding.
    fn any_feature(
        &self,
        moment: &Moment,
        found: &Closest,
        mut is_wanted: impl FnMut(DVec3) -> bool,
    ) -> bool {
        let (Placed::Core(a), Placed::Core(b)) = (&moment.a, &moment.b) else { return false };
        let (normal, [on_a, on_b]) = (found.normal, found.points);
        // Where cores have a common point within rounding, points of both are this far from it at most.
        let near = self.fineness.rest(moment.precision.projection()) + (found.at_most - self.radii).max(0.0);
        for (solid, point, sign) in [(a, on_a, 1.0), (b, on_b, -1.0)] {
            let mut is_edge_wanted = |&edge: &u16| {
                let along = solid.edge_direction(edge.into());
                let (off, squared) = (normal.dot(along), along.length_squared());
                off * off <= TILTED * TILTED * squared
                    && (normal - along * (off / squared)).try_normalize().is_some_and(&mut is_wanted)
            };
            if solid.topology.edges().iter().any(&mut is_edge_wanted)
                || (0..solid.face_count()).any(|face| {
                    let normal = solid.normal(face);
                    (solid.face_reach(face, normal) - normal.dot(point)).abs() <= near
                        && is_wanted(normal * sign)
                })
            {
                return true;
            }
        }
        let [of_a, of_b] = [edges_at(a, on_a, near), edges_at(b, on_b, near)];
        of_a.iter().any(|&one| {
            of_b.iter().any(|&other| {
                square_to([one, other], [DVec3::ZERO; 2], normal).is_some_and(|(axis, _)| is_wanted(axis))
            })
        })
    }

    /// When two that all but touch at the start are further apart along an axis than a step aims at, having come no
    /// nearer in between, and the axis as it is then.
    fn apart_by_swaying(&self, moment: &Moment, found: &Closest, until: f64) -> Option<(f64, DVec3)> {
        let (Placed::Core(a), Placed::Core(b)) = (&moment.a, &moment.b) else { return None };
        let normal = found.normal;
        let apart = |sways: Sways| {
            let opening = self.opening(moment, [a, b], sways);
            if opening > 0.0 { self.sways_apart(moment, (sways, opening), until) } else { None }
        };
        let along = [DVec3::ZERO, moment.spins[0].cross(normal), moment.spins[1].cross(normal)];
        if let Some(apart) = along.into_iter().find_map(|sway| apart((normal, sway))) {
            return Some(apart);
        }
        let near = self.fineness.rest(moment.precision.projection());
        let [of_a, of_b] = [edges_at(a, found.points[0], near), edges_at(b, found.points[1], near)];
        let mut pairs = of_a.iter().flat_map(|&one| of_b.iter().map(move |&other| [one, other]));
        pairs.find_map(|edges| square_to(edges, moment.spins, normal).and_then(apart))
    }

    /// How fast the vertices that are nearest along an axis open at first. If they do not, the gap along it gets back to
    /// what it was no faster than it may bend, and shows nothing.
    fn opening(&self, moment: &Moment, [a, b]: [&Solid; 2], (normal, sway): Sways) -> f64 {
        let on_a = a.point(a.support(normal).vertex);
        let on_b = b.point(b.support(-normal).vertex);
        let [spin_a, spin_b] = moment.spins;
        let velocity = spin_b.cross(on_b - moment.between) - spin_a.cross(on_a) - self.passage.drift;
        normal.dot(velocity) + sway.dot(on_b - on_a)
    }

    /// The same as [`apart_by_swaying`](Self::apart_by_swaying) along one axis, and how fast the gap opens along it.
    ///
    /// Along n + h m a vertex x of A reaches x.(n + h m), whose second derivative is no more than that of x times the
    /// axis' length and twice the speeds of both; and the radii count as many times as the axis is long. So in between,
    /// at h, the gap is below the line between its ends by no more than bend h (later - h) / 2; and it grows by no more
    /// than opening h + bend h^2 / 2.
    fn sways_apart(
        &self,
        moment: &Moment,
        ((normal, sway), opening): (Sways, f64),
        until: f64,
    ) -> Option<(f64, DVec3)> {
        let doubt = moment.precision.projection();
        let least = moment.gap_along(normal) - self.radii - doubt;
        if least < -4.0 * doubt {
            return None;
        }
        let (rate, aim) = (sway.length(), self.slack + self.fineness.rest(doubt));
        let mut later = until;
        for _ in 0..MAX_TRIES {
            let bend = self.bend(moment, None, [0.0, later]) * (1.0 + rate * later)
                + 2.0 * rate * self.pace(later)
                + self.radii * rate * rate;
            let bent = 0.5 * bend * later * later;
            if least + opening * later + bent + 4.0 * doubt <= aim {
                return None;
            }
            let (then, axis) = (self.at(later), normal + sway * later);
            let length = axis.length();
            let doubt = then.precision.projection();
            let gap = then.gap_along(axis / length) - self.radii - doubt;
            if gap > self.slack + self.fineness.rest(doubt) && gap * length - least >= bent {
                return Some((later, axis / length));
            }
            later *= 0.25;
        }
        None
    }

    /// A bound on how fast a point of A moves past one of B, from the start until a fraction.
    fn pace(&self, until: f64) -> f64 {
        let of = |i: usize| {
            let speed = self.passage.turns[i].map_or(0.0, |turn| turn.bounds_within(0.0, until)[0]);
            speed * self.arms[i].from_axis
        };
        (self.passage.drift.length() + of(0) + of(1)) * (1.0 + 64.0 * f64::EPSILON)
    }
}
