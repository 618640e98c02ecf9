//! Parts that do not turn, of which one comes down on the inside of an edge of the other: in closed form.
//!
//! ```text
//! for each edge of either part, h = how high the other's lowest vertex is above its line, less both radii, at the start
//!   h certainly above zero, and the motion parts the two along the edge's normal, or ends before h is gone: no touch
//! of the others, the edge at which h is gone last: before, its line separates the two
//! if the vertex is then over the inside of the edge, they touch there; else left to steps
//! ```
//! What walks or falls on a floor mostly meets it so. Only for parts of few edges, since all of them are tried:
//! rectangles, segments, capsules.

use super::{Course, Touching};
use crate::polygon::outline::Outline;
use asunder_geometry::glam::DVec2;

/// The most edges that are tried.
const FEW: usize = 4;

/// What the edges of both parts show.
pub(super) enum Landing {
    /// They touch inside of one.
    On(Touching),
    /// They never touch.
    Never,
    Open,
}

/// What one edge shows.
enum Shown {
    /// It separates the two for good.
    Never,
    /// It separates them until then.
    Until(Over),
    Nothing,
}

/// An edge, and the vertex of the other part that is lowest over it.
struct Over {
    /// How long until they meet, at the earliest.
    until: f64,
    /// Both ends of the edge, its outward normal, and which part has it.
    edge: [DVec2; 2],
    normal: DVec2,
    which: usize,
    vertex: DVec2,
}

impl Course<'_> {
    /// How the motion ends, where an edge shows it.
    pub(super) fn landing(&self) -> Landing {
        if self.is_turning() || self.line().is_some() {
            return Landing::Open;
        }
        let now = self.times[0];
        let outlines = self.outlines(now);
        let mut last: Option<Over> = None;
        for which in [1, 0] {
            let ([outline, other], count) =
                ([&outlines[which], &outlines[1 - which]], outlines[which].edge_count());
            for edge in 0..if count > FEW { 0 } else { count } {
                match self.shown((outline, edge), other, which) {
                    Shown::Never => return Landing::Never,
                    Shown::Until(over) if last.as_ref().is_none_or(|last| over.until > last.until) => {
                        last = Some(over);
                    }
                    Shown::Until(_) | Shown::Nothing => {}
                }
            }
        }
        last.and_then(|over| self.touching_inside(&over, now)).map_or(Landing::Open, Landing::On)
    }

    fn shown(&self, (outline, edge): (&Outline, usize), other: &Outline, which: usize) -> Shown {
        let normal = outline.normal(edge);
        let axis = if which == 0 { normal } else { -normal };
        let ends = [outline.point(edge), outline.point(outline.after(edge))];
        let vertex = other.point(other.support(-normal).vertex);
        let gap = normal.dot(vertex - ends[0]) - self.radii - self.precision.projection() - self.slack;
        if gap <= 0.0 {
            return Shown::Nothing;
        }
        let closing = self.closing(axis);
        if closing <= 0.0 || gap > closing * (self.times[1] - self.times[0]) {
            return Shown::Never;
        }
        Shown::Until(Over { until: gap / closing, edge: ends, normal, which, vertex })
    }

    /// The touch of a vertex that is over the inside of an edge once it has come down to it.
    fn touching_inside(&self, over: &Over, now: f64) -> Option<Touching> {
        let &Over { until, edge: [from, to], normal, which, vertex } = over;
        let until = until.min(self.times[1] - now);
        // B moves, seen from A.
        let moved = self.stretch.velocity * until;
        let (from, to, vertex) =
            if which == 0 { (from, to, vertex - moved) } else { (from - moved, to - moved, vertex) };
        let height = normal.dot(vertex - from);
        let foot = vertex - normal * height;
        let doubt = self.precision.projection() + self.slack;
        let (along, length) = (to - from, (to - from).length());
        let place = along.dot(foot - from);
        let margin = 4.0 * doubt * length;
        if !(place > margin && place < length * length - margin) {
            return None;
        }
        let (axis, points) = if which == 0 { (normal, [foot, vertex]) } else { (-normal, [vertex, foot]) };
        let apart = (height - self.radii).max(0.0) + doubt;
        Some(Touching { at: now + until, axis, apart, points: self.on_surfaces(points, axis) })
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::piece::Piece;
    use super::super::super::stretch::Travel;
    use super::{Course, Landing};
    use crate::numbers::Numbers;
    use crate::pair2::Pair2;
    use asunder_geometry::glam::Vec2;
    use asunder_geometry::{Capsule2, Circle, Polygon, Pose2, Rect, Rotation2, Segment2, Shape2};

    fn shape(numbers: &mut Numbers, size: f64) -> Shape2 {
        let mut point = || (numbers.vector().truncate() * size).as_vec2();
        let (from, to) = (point(), point());
        let half = from.abs() + 0.1 * size as f32;
        match numbers.below(6) {
            0 => Circle::new(half.x).unwrap().into(),
            1 => Rect::from_half_extents(half).unwrap().into(),
            2 => Rect::from_half_extents(half).unwrap().rounded(half.y).unwrap().into(),
            3 => Capsule2::new(from, to, half.x).unwrap().into(),
            4 => Segment2::new(from, to).unwrap().into(),
            _ => Polygon::hull_of(&[from, to, -half]).unwrap().into(),
        }
    }

    fn pose(numbers: &mut Numbers, size: f64, far: f64) -> Pose2 {
        let [c, s] = [(); 2].map(|()| numbers.number() as f32);
        let shift = numbers.vector().truncate() * size + asunder_geometry::glam::DVec2::splat(far);
        Pose2::new(shift, Rotation2::new(c, s).unwrap()).unwrap()
    }

    #[test]
    fn what_comes_down_on_an_edge_touches_it_where_steps_find_it() {
        let mut numbers = Numbers::new(412);
        let (mut touches, mut misses) = (0, 0);
        for round in 0..40_000 {
            let size = [1e-3, 1.0, 1e3][round % 3];
            let far = if round % 7 == 0 { 3e5 } else { 0.0 };
            let [a, b] = [(); 2].map(|()| shape(&mut numbers, size));
            let [at_a, at_b] = [(); 2].map(|()| pose(&mut numbers, 3.0 * size, far));
            let towards = at_b.position() - at_a.position() + numbers.vector().truncate() * size;
            let pair = Pair2::new(&a, &at_a, &b, &at_b);
            let travel = Travel::shift([&at_a, &at_b], towards * 1.5);
            let pieces = [Piece::whole(&a), Piece::whole(&b)];
            let stretch = &travel.stretches()[0];
            let Some(course) = Course::new(stretch, [&pieces[0], &pieces[1]], 1.0) else { continue };
            let found = match course.landing() {
                Landing::On(found) => Some(found),
                Landing::Never => None,
                Landing::Open => continue,
            };
            let steps = course.by_steps();
            let story = format_args!("{round}: {a:?} at {at_a:?}, {b:?} at {at_b:?}");
            assert!(!pair.overlaps(), "{story}");
            let Some(found) = found else {
                // What passes within the error of steps may count as met by them.
                let there = |at: f64| {
                    let shifted = at_a.shifted(towards * 1.5 * at).unwrap();
                    Pair2::new(&a, &shifted, &b, &at_b).overlaps()
                };
                assert!(steps.as_ref().is_none_or(|met| !there(met.at)), "{story}");
                assert!(!there(1.0), "{story}");
                misses += 1;
                continue;
            };
            let Some(steps) = steps else { panic!("{story}: by steps they pass") };
            let closing = found.axis.dot(stretch.velocity);
            let off = (found.at - steps.at).abs() * closing;
            assert!(off <= found.apart + steps.apart, "{story}: {off}, {} and {}", found.apart, steps.apart);
            let apart = (found.points[1] - found.points[0]).length();
            assert!(apart <= found.apart + 1e-9 * size, "{story}: points {apart} apart");
            // Not before, up to the rounding of the position.
            let before = at_a.shifted(towards * 1.5 * found.at).unwrap();
            let early = found.apart + f64::EPSILON * before.position().abs().element_sum();
            let back = before.shifted(-found.axis * 2.0 * early).unwrap();
            assert!(!Pair2::new(&a, &back, &b, &at_b).overlaps(), "{story}: they touch before");
            touches += 1;
        }
        assert!(touches > 8000 && misses > 1500, "{touches} {misses}");
    }

    #[test]
    fn what_moves_along_an_edge_or_starts_on_it_is_left_to_others_or_parts() {
        let square = Shape2::from(Rect::from_half_extents(Vec2::splat(0.5)).unwrap());
        let landing = |y: f64, way: [f64; 2]| {
            let (above, below) = (Pose2::at([0.0, y]).unwrap(), Pose2::IDENTITY);
            let travel = Travel::shift([&above, &below], way.into());
            let pieces = [Piece::whole(&square), Piece::whole(&square)];
            Course::new(&travel.stretches()[0], [&pieces[0], &pieces[1]], 1.0).unwrap().landing()
        };
        assert!(matches!(landing(1.0, [0.0, -1.0]), Landing::Open), "they touch at the start");
        assert!(matches!(landing(1.25, [1.0, 0.0]), Landing::Never), "it slides above");
        assert!(matches!(landing(1.25, [0.25, -1.0]), Landing::On(_)), "it falls on it");
        assert!(matches!(landing(1.25, [0.0, -0.2]), Landing::Never), "not so far");
        assert!(matches!(landing(0.9, [0.0, -1.0]), Landing::Open), "it is in it");
    }
}
