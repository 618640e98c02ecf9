//! What a body that already touches some of another meets next, in the plane: see [`level`](crate::level).

use super::at_start;
use super::course::Course;
use super::piece::{Piece, for_pieces};
use super::stretch::{Stretch, Travel};
use crate::answer::Manifold2;
use crate::impact2::Impact2;
use crate::level::{Contacts, Lies, Passing, Reach, half_through, thickness, thinner};
use crate::lists::with_manifolds2;
use crate::pair2::Pair2;
use crate::touch::Touch2;
use asunder_geometry::glam::DVec2;
use asunder_geometry::{Chain, Motion2, Shape2};

/// Sampled moments in each half of a motion with a turn.
pub(super) const MOMENTS: u32 = 16;

/// What is touched at the start.
pub(super) struct Touched<'t> {
    pair: &'t Pair2<'t>,
    travel: &'t Travel,
    /// The contacts between the two bodies, if they touch.
    contacts: Option<Contacts<'t, Manifold2>>,
    /// All that A touches, B perhaps among it.
    beside: Contacts<'t, Touch2>,
    /// Which of the two are ground, whose thickness does not count.
    are_ground: [bool; 2],
}

/// Calls `run` with what is touched at the start: the contacts between the two, if they touch, and all that A touches.
pub(super) fn with_touched<R>(
    (pair, travel): (&Pair2, &Travel),
    (do_touch, touches): (bool, &[Touch2]),
    run: impl FnOnce(&Touched) -> R,
) -> R {
    let are_ground = [pair.shape_a.is_ground(), pair.shape_b.is_ground()];
    let size = pair.shape_a.outer_radius().min(pair.shape_b.outer_radius());
    let beside = Contacts::new(touches, size);
    if !do_touch {
        return run(&Touched { pair, travel, contacts: None, beside, are_ground });
    }
    with_manifolds2(pair, 0.0, |manifolds| {
        run(&Touched { pair, travel, contacts: Some(Contacts::new(manifolds, size)), beside, are_ground })
    })
}

impl Touched<'_> {
    /// Whether the meeting of two parts at a time of a stretch, along a unit axis from A to B, is no impact: they
    /// overlap at the start, exactly, and have not been apart since; or they are level with what is touched.
    pub(super) fn passes_over(
        &self,
        pieces: [&Piece; 2],
        (stretch, at): (&Stretch, f64),
        axis: DVec2,
    ) -> bool {
        at <= 0.0 && self.pair.do_pieces_overlap(pieces.map(|it| (it.shape, it.local)))
            || self.lies(pieces, (stretch.start + at * stretch.share, axis)) == Lies::Level
    }

    /// Classifies the meeting of two parts at a fraction, along a unit axis from A to B; at fraction 0, their touch at
    /// the start.
    fn lies(&self, pieces: [&Piece; 2], (fraction, normal): (f64, DVec2)) -> Lies {
        let stretches = self.travel.stretches();
        let [Some(first), Some(last)] = [stretches.first(), stretches.last()] else { return Lies::Level };
        let [first, last] = [first, last].map(|stretch| Course::over(stretch, pieces, [0.0, 1.0]));
        // A body that turns may be deepest on the way.
        let is_turning = stretches.iter().any(|stretch| stretch.is_turning());
        let between = if is_turning { 1..2 * MOMENTS } else { 0..0 };
        let gap_at = |axis: DVec2, fraction: f64| match stretches.len() {
            2 if fraction >= 0.5 => last.gap(axis, 2.0 * fraction - 1.0),
            2 => first.gap(axis, 2.0 * fraction),
            _ => first.gap(axis, fraction),
        };
        let closing = |axis: DVec2, from: f64| {
            let after =
                between.clone().map(|i| f64::from(i) / f64::from(2 * MOMENTS)).filter(|&at| at > from);
            gap_at(axis, from) - after.map(|at| gap_at(axis, at)).fold(gap_at(axis, 1.0), f64::min)
        };
        let passing = Passing {
            thickness: self.thickness(pieces),
            is_on_ground: self.are_ground != [false; 2],
            is_endless: pieces.iter().any(|it| matches!(it.shape, Shape2::HalfPlane(_))),
            gap: &|axis| first.gap(axis, 0.0),
            closing: &closing,
            met_at: if is_turning { fraction } else { 0.0 },
            reach: self.reach(pieces),
        };
        passing.lies(normal, self.contacts.as_ref(), &self.beside)
    }

    /// Bounds on how far apart points of two parts are, along any axis.
    fn reach(&self, pieces: [&Piece; 2]) -> Reach {
        let stretches = self.travel.stretches();
        let finite = |radius: f64| if radius.is_finite() { radius } else { 0.0 };
        let radii = finite(pieces[0].outer) + finite(pieces[1].outer);
        let arms = pieces.map(|piece| piece.center.length());
        let way_of = |stretch: &Stretch| {
            let chords = [0, 1].map(|i| stretch.spins[i].chord() * arms[i]);
            stretch.velocity.length() + chords[0] + chords[1]
        };
        let way: f64 = stretches.iter().map(way_of).sum();
        let offset = stretches.first().map_or(DVec2::ZERO, |stretch| {
            let [a, b] = [0, 1].map(|i| stretch.spins[i].turn_at(0.0).turn(pieces[i].center));
            stretch.offset + (b - a)
        });
        let start = offset.length() + radii;
        Reach::new(start, way, start + way + 2.0 * (arms[0] + arms[1]))
    }

    /// The thickness of the thinner of two parts, from its middle, in metres; ground's does not count.
    fn thickness(&self, pieces: [&Piece; 2]) -> f64 {
        thinner([0, 1].map(|i| {
            let shape = pieces[i].shape;
            if self.are_ground[i] || !shape.outer_radius().is_finite() {
                return None;
            }
            let core = shape.core();
            let sum: DVec2 = core.vertices().iter().map(|vertex| vertex.as_dvec2()).sum();
            let middle = sum / core.vertices().len().max(1) as f64;
            let edges = core.normals().iter().zip(core.vertices());
            let heights = edges.map(|(normal, vertex)| normal.dot(vertex.as_dvec2() - middle));
            Some(thickness(heights, shape.radius(), shape.outer_radius()))
        }))
    }

    /// An impact at the start with a chain that is touched without a contact, and moved into: found from the manifolds
    /// after half a thickness of the way, unless something else is met before.
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
        with_manifolds2(&later, 0.0, |manifolds| {
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
        half_through(thickness, drift + turned)
    }

    fn is_across(&self, (side, chain, body): (usize, &Chain, &Shape2), manifold: &Manifold2) -> bool {
        let parts = [manifold.part_a, manifold.part_b];
        let Some(segment) = chain.segment(parts[side]).map(Shape2::Segment) else { return false };
        let ground = Piece::segment(&segment, parts[side]);
        let mut lies = Lies::Level;
        for_pieces(body, |piece| {
            if piece.index == parts[1 - side] {
                let pieces = if side == 0 { [&ground, piece] } else { [piece, &ground] };
                lies = self.lies(pieces, (0.0, manifold.normal.as_dvec2()));
            }
        });
        lies == Lies::Across
    }
}
