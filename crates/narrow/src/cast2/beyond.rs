//! What a body meets next that touches some of the other already, in the plane: see `cast3/beyond.rs`.

use super::at_start;
use super::course::Course;
use super::piece::{Piece, for_pieces};
use super::stretch::Travel;
use crate::answer::Manifold2;
use crate::feature::Hint;
use crate::impact2::Impact2;
use crate::pair2::Pair2;
use asunder_geometry::glam::{DVec2, Vec2};
use asunder_geometry::tolerance::{NEXT_LEVEL, NEXT_THICKNESS};
use asunder_geometry::{Chain, Motion2, Polygon, Shape2};
use core::cell::Cell;

/// Moments of each half of a motion with a turn that are looked at.
const MOMENTS: u32 = 16;

thread_local! {
    /// Memory for manifolds: who asks every frame allocates nothing.
    static LISTS: Cell<Vec<Vec<Manifold2>>> = const { Cell::new(Vec::new()) };
}

/// How two bodies touch at the start.
pub(super) struct Touched<'t> {
    pair: &'t Pair2<'t>,
    travel: &'t Travel,
    manifolds: &'t [Manifold2],
    /// Which of the two are ground, and so have no thickness that counts.
    are_ground: [bool; 2],
}

/// Asks with what two bodies touch at the start.
pub(super) fn with_touched<R>(pair: &Pair2, travel: &Travel, ask: impl FnOnce(&Touched) -> R) -> R {
    let are_ground = [pair.shape_a.is_ground(), pair.shape_b.is_ground()];
    with_manifolds(pair, |manifolds| ask(&Touched { pair, travel, manifolds, are_ground }))
}

/// The manifolds of a pair, in memory that is kept.
fn with_manifolds<R>(pair: &Pair2, ask: impl FnOnce(&[Manifold2]) -> R) -> R {
    let mut lists = LISTS.take();
    let mut manifolds = lists.pop().unwrap_or_default();
    LISTS.set(lists);
    manifolds.clear();
    if pair.has_ground() {
        pair.contact_on_ground(0.0, &mut manifolds);
    } else {
        let _ = pair.contact(0.0, Hint::NONE, true, |manifold| manifolds.push(manifold));
    }
    let answer = ask(&manifolds);
    let mut lists = LISTS.take();
    lists.push(manifolds);
    LISTS.set(lists);
    answer
}

/// Radius of a circle about the middle of a polygon's vertices, which is inside it, that the core holds.
fn inner_radius(polygon: &Polygon) -> f64 {
    let sum: DVec2 = polygon.vertices().iter().map(|vertex| vertex.as_dvec2()).sum();
    let middle = sum / polygon.vertices().len() as f64;
    let height = |(vertex, normal): (&Vec2, &DVec2)| (vertex.as_dvec2() - middle).dot(*normal);
    polygon.vertices().iter().zip(polygon.normals()).map(height).fold(f64::INFINITY, f64::min).max(0.0)
}

/// How what two parts meet with lies to what is touched.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Lies {
    /// Further on.
    Ahead,
    /// Beside it, and gone into no further.
    Level,
    /// Beside it, and gone into.
    Across,
}

impl Touched<'_> {
    /// Whether two parts that meet at a time of a stretch, along a unit axis from A to B, are no impact: they overlap at the
    /// start, exactly, and have not parted since; or they are level with what is touched.
    pub(super) fn passes_over(&self, pieces: [&Piece; 2], (at, axis): (f64, DVec2)) -> bool {
        at <= 0.0 && self.pair.do_pieces_overlap(pieces.map(|it| (it.shape, it.local)))
            || self.lies(pieces, axis) == Lies::Level
    }

    /// How it lies what two parts meet with along a unit axis from A to B.
    fn lies(&self, pieces: [&Piece; 2], normal: DVec2) -> Lies {
        let stretches = self.travel.stretches();
        let [Some(first), Some(last)] = [stretches.first(), stretches.last()] else { return Lies::Level };
        let [first, last] = [first, last].map(|stretch| Course::over(stretch, pieces, [0.0, 1.0]));
        let thickness = self.thickness(pieces);
        let slack = NEXT_LEVEL * thickness;
        // Who turns may be in deepest on the way.
        let is_turning = stretches.iter().any(|stretch| stretch.is_turning());
        let between = if is_turning { 1..MOMENTS } else { 0..0 };
        let closing = |axis: DVec2| {
            let at = |i: u32| f64::from(i) / f64::from(MOMENTS);
            let on_the_way = between.clone().map(|i| first.gap(axis, at(i)).min(last.gap(axis, at(i))));
            let least = on_the_way.fold(first.gap(axis, 1.0).min(last.gap(axis, 1.0)), f64::min);
            first.gap(axis, 0.0) - least
        };
        let is_flush = |manifold: &Manifold2| {
            let touched = manifold.normal.as_dvec2();
            let above = first.gap(touched, 0.0);
            let lowest = f64::from(manifold.separation) - slack;
            above <= slack && above >= lowest && closing(touched) <= 0.5 * thickness
        };
        if self.are_ground == [false; 2] && self.manifolds.iter().any(is_flush) {
            return Lies::Level;
        }
        if first.gap(normal, 0.0) > slack {
            return Lies::Ahead;
        }
        let into = closing(normal);
        let anyway = |manifold: &Manifold2| {
            let touched = manifold.normal.as_dvec2();
            closing(touched).max(0.0) * touched.dot(normal).max(0.0)
        };
        let is_level = into <= slack || self.manifolds.iter().any(|it| into - anyway(it) <= slack);
        if is_level { Lies::Level } else { Lies::Across }
    }

    /// That of the thinner of two parts, from the middle, in metres; ground has none that counts.
    fn thickness(&self, pieces: [&Piece; 2]) -> f64 {
        let of = |i: usize| {
            let shape = pieces[i].shape;
            let size = f64::from(shape.outer_radius());
            if self.are_ground[i] || !size.is_finite() {
                return f64::INFINITY;
            }
            let inner = match shape {
                Shape2::Rect(rect) => f64::from(rect.half_extents().min_element()),
                Shape2::Polygon(polygon) => inner_radius(polygon),
                _ => 0.0,
            };
            let thickness = inner + f64::from(shape.radius());
            thickness.max(NEXT_THICKNESS * size)
        };
        let least = of(0).min(of(1));
        if least.is_finite() { least } else { 0.0 }
    }

    /// What of a chain is touched, not told, and gone into: seen from where half a thickness of the way is done, unless
    /// something else is met before.
    pub(super) fn across(&self, motions: [&Motion2; 2], first: Option<&Impact2>) -> Option<Impact2> {
        let pair = self.pair;
        let (side, chain, body) = match (pair.shape_a, pair.shape_b) {
            (Shape2::Chain(_), Shape2::Chain(_)) => return None,
            (Shape2::Chain(chain), body) => (0, chain, body),
            (body, Shape2::Chain(chain)) => (1, chain, body),
            _ => return None,
        };
        let ahead = self.ahead(body);
        if first.is_some_and(|first| first.fraction <= ahead) || !ahead.is_finite() {
            return None;
        }
        let [pose_a, pose_b] =
            [motions[0].pose_at(&pair.pose_a, ahead), motions[1].pose_at(&pair.pose_b, ahead)];
        let later = Pair2::new(pair.shape_a, &pose_a, pair.shape_b, &pose_b);
        with_manifolds(&later, |manifolds| {
            let across = manifolds.iter().find(|manifold| self.is_across((side, chain, body), manifold))?;
            Some(Impact2 { fraction: 0.0, error: 0.0, overlapping: false, ..at_start(across)? })
        })
    }

    /// The share of the motion that is half a body's thickness.
    fn ahead(&self, body: &Shape2) -> f64 {
        let mut thickness = f64::INFINITY;
        for_pieces(body, |piece| thickness = thickness.min(self.thickness([piece, piece])));
        let stretches = self.travel.stretches();
        let drift: f64 = stretches.iter().map(|stretch| stretch.velocity.length()).sum();
        let is_turning = stretches.iter().any(|stretch| stretch.is_turning());
        let turned =
            if is_turning { 2.0 * f64::from(body.center().length() + body.outer_radius()) } else { 0.0 };
        (0.5 * thickness / (drift + turned)).min(1.0)
    }

    fn is_across(&self, (side, chain, body): (usize, &Chain, &Shape2), manifold: &Manifold2) -> bool {
        let parts = [manifold.part_a, manifold.part_b];
        let Some(segment) = chain.segment(parts[side]).map(Shape2::Segment) else { return false };
        let ground = Piece::segment(&segment, parts[side]);
        let mut lies = Lies::Level;
        for_pieces(body, |piece| {
            if piece.index == parts[1 - side] {
                let pieces = if side == 0 { [&ground, piece] } else { [piece, &ground] };
                lies = self.lies(pieces, manifold.normal.as_dvec2());
            }
        });
        lies == Lies::Across
    }
}
