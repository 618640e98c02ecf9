//! How two bodies move past each other, and how two of their parts stand at any moment.

use crate::counted::count_step;
use crate::level::Reach;
use crate::pair3::{Pair3, Part};
use crate::polyhedron::closest::Placed;
use crate::polyhedron::half_space::Plane;
use crate::polyhedron::solid::Solid;
use crate::precision::{IN_SPACE, Precision, off_closing, outlasts};
use asunder_geometry::glam::{DVec3, Vec3};
use asunder_geometry::tolerance::{IMPACT_GAP, IMPACT_REST};
use asunder_geometry::{Basis3, Core3, Motion3, Pose3, Shape3, Turn3};

/// The motion of two bodies, seen from A's position, in world axes.
pub(super) struct Passage {
    /// B's position less A's, at the start.
    pub(super) between: DVec3,
    /// How far A moves in all, relative to B.
    pub(super) drift: DVec3,
    /// Both bodies' axes at the start.
    pub(super) bases: [Basis3; 2],
    /// How they turn; `None` for a body that does not, and for a ball about its body's position.
    pub(super) turns: [Option<Turn3>; 2],
    /// What rounding the positions of moved bodies may add to a gap or take from it.
    pub(super) rounding: f64,
}

/// Steps for which bounding spheres that turn with their bodies are followed: after that, the parts themselves are
/// tested.
const MAX_LOOKS: u32 = 12;

/// Share of their radii within which such spheres count as met.
const NEAR_ENOUGH: f64 = 1.0 / 64.0;

/// Two convex parts of moving bodies.
pub(super) struct Course<'a> {
    pub(super) passage: &'a Passage,
    pub(super) parts: [Part<'a>; 2],
    cores: [&'a Core3<'a>; 2],
    /// Sum of both radii, in metres.
    pub(super) radii: f64,
    pub(super) fineness: Fineness,
    /// What rounding the poses of moved bodies may add to a gap or take from it, at most, in metres: only a larger gap is
    /// certain in those poses.
    pub(super) slack: f64,
    /// Sum of the bounding radii, in metres; a half-space has none.
    size: f64,
    /// Sum of the cores' bounding radii.
    core_size: f64,
    /// For each part, how far its core reaches from its body's axis of turning, in metres, and from its body's
    /// position.
    pub(super) arms: [Arm; 2],
    /// Whether an exact test has shown that the two do not touch at the start.
    pub(super) are_apart: bool,
}

/// How near is near enough: in metres, but at least a few roundings of a projection.
#[derive(Clone, Copy)]
pub(super) struct Fineness {
    gap: f64,
    rest: f64,
}

impl Fineness {
    /// Limited by rounding alone.
    pub(super) const FINEST: Self = Self { gap: 0.0, rest: 0.0 };

    /// A gap that counts as met, where a projection is off by up to `doubt`.
    pub(super) fn gap(self, doubt: f64) -> f64 {
        self.gap.max(16.0 * doubt)
    }

    /// The gap that a step leaves.
    pub(super) fn rest(self, doubt: f64) -> f64 {
        self.rest.max(4.0 * doubt)
    }
}

#[derive(Clone, Copy)]
pub(super) struct Arm {
    pub(super) from_axis: f64,
    pub(super) from_position: f64,
}

/// Both parts at a fraction of the motion.
pub(super) struct Moment<'a> {
    pub(super) a: Placed<'a>,
    pub(super) b: Placed<'a>,
    /// B's position less A's.
    pub(super) between: DVec3,
    pub(super) precision: Precision,
    /// Each body's angular velocity at that moment; zero for one that does not turn.
    pub(super) spins: [DVec3; 2],
}

impl Moment<'_> {
    /// The gap between the two cores along an axis.
    pub(super) fn gap_along(&self, axis: DVec3) -> f64 {
        -self.reach_of(0, axis) - self.reach_of(1, -axis)
    }

    /// How far a core reaches along an axis, from A's position.
    pub(super) fn reach_of(&self, which: usize, axis: DVec3) -> f64 {
        let (placed, origin) = if which == 0 { (&self.a, DVec3::ZERO) } else { (&self.b, self.between) };
        match placed {
            Placed::Core(solid) => solid.support(axis).reach,
            Placed::HalfSpace(_) => axis.dot(origin),
        }
    }
}

/// A sum of coordinates bounds a length, and needs no root.
pub(super) fn length(v: DVec3) -> f64 {
    v.abs().element_sum()
}

/// Whether a gap, less the slack, certainly outlasts some of a straight motion, all of which would close `closing` metres
/// at most. Of a motion along both, up to rounding, the end is as certain as the start: it uses up none of the slack.
pub(super) fn outlasts_rounded((gap, slack): (f64, f64), closing: f64, (drift, span): (DVec3, f64)) -> bool {
    let spared = if closing <= 2.0 * off_closing(drift) { slack } else { 0.0 };
    outlasts(gap + spared, closing, span)
}

/// What rounding the position of a body that moves by up to `way` metres may add to a gap.
fn rounding_of(pose: &Pose3, way: f64) -> f64 {
    f64::EPSILON * (length(pose.position()) + way)
}

/// The same of a body A that moves past a body B at rest, as long as they may touch: that ends once A has come as far
/// as from one side of B to the other.
pub(super) fn rounding_past(pair: &Pair3, drift: DVec3) -> f64 {
    let reach = |shape: &Shape3| f64::from(shape.outer_radius()) + length(shape.center().as_dvec3());
    let past = length(pair.between) + reach(pair.shape_a) + reach(pair.shape_b);
    rounding_of(&pair.pose_a, length(drift).min(past))
}

/// Whether a shape stays where it is as its body turns: a ball about the body's position. It is treated as one that
/// does not turn, so that it meets the same; else all of its arm would count as a path along which it moves.
fn is_round(shape: &Shape3) -> bool {
    shape.center() == Vec3::ZERO && shape.outer_radius() <= shape.radius()
}

impl Passage {
    /// A moves and B stands still; neither turns.
    pub(super) fn straight(pair: &Pair3, drift: DVec3) -> Self {
        let rounding = rounding_past(pair, drift);
        Self { between: pair.between, drift, bases: pair.bases(), turns: [None; 2], rounding }
    }

    pub(super) fn of_motions(pair: &Pair3, motions: [&Motion3; 2]) -> Self {
        let poses = [&pair.pose_a, &pair.pose_b];
        let paths = [0, 1].map(|i| {
            let (start, way) = (poses[i].position(), motions[i].displacement());
            let end = motions[i].pose_at(poses[i], 1.0).position();
            // Poses end at the edge of their range.
            if end == start + way { way } else { end - start }
        });
        let moved = |i: usize| match paths[i] {
            DVec3::ZERO => 0.0,
            path if i == 0 && paths[1] == DVec3::ZERO => rounding_past(pair, path),
            path => rounding_of(poses[i], length(path)),
        };
        let shapes = [pair.shape_a, pair.shape_b];
        let turn = |i: usize| {
            Some(motions[i].turn(poses[i])).filter(|turn| !turn.is_still() && !is_round(shapes[i]))
        };
        Self {
            between: pair.between,
            drift: paths[0] - paths[1],
            bases: pair.bases(),
            turns: [turn(0), turn(1)],
            rounding: moved(0) + moved(1),
        }
    }

    /// Whether neither body moves relative to the other, and neither turns.
    pub(super) fn is_still(&self) -> bool {
        self.drift == DVec3::ZERO && self.turns.iter().all(Option::is_none)
    }

    /// Whether neither body turns.
    pub(super) fn is_straight(&self) -> bool {
        self.turns.iter().all(Option::is_none)
    }

    /// B's position less A's at a fraction.
    #[inline]
    pub(super) fn between_at(&self, fraction: f64) -> DVec3 {
        self.between - self.drift * fraction
    }

    /// The stretch on which two parts may touch, up to a fraction: from where their bounding spheres meet to where they
    /// part; `None` if they never meet. A body that turns has its sphere about its position.
    pub(super) fn stretch(&self, parts: [&Part; 2], until: f64) -> Option<Stretch> {
        let sphere = |i: usize| {
            let (center, radius) = (parts[i].center, f64::from(parts[i].shape.outer_radius()));
            match self.turns[i] {
                None => (center, radius),
                Some(_) => (DVec3::ZERO, radius + center.length()),
            }
        };
        let ((from, radius_a), (to, radius_b)) = (sphere(0), sphere(1));
        let radii = (radius_a + radius_b, self.rounding);
        let stretch = Stretch::of_spheres([from, to, self.between], radii, self.drift, until)?;
        (self.is_straight() || self.may_meet(parts, until)).then_some(stretch)
    }

    /// Whether the bounding spheres of two parts may meet up to a fraction, as they move while their bodies turn:
    /// advances from where they are to where they may meet at the earliest (as `advance`, for spheres).
    fn may_meet(&self, parts: [&Part; 2], until: f64) -> bool {
        count_step();
        let arms = parts.map(|part| part.center.length());
        let local = |i: usize| self.bases[i].turn_back(parts[i].center);
        let locals = [local(0), local(1)];
        let center = |i: usize, fraction: f64| match self.turns[i] {
            Some(turn) => turn.basis_at(fraction).turn(locals[i]),
            None => parts[i].center,
        };
        let speed = |i: usize| self.turns[i].map_or(0.0, |turn| turn.top_speed() * arms[i]);
        let fastest = self.drift.length() + speed(0) + speed(1);
        let radii: f64 = parts.iter().map(|part| f64::from(part.shape.outer_radius())).sum();
        // Rotations of poses are rounded to f32.
        let turned = 2.0 * f64::from(f32::EPSILON) * (arms[0] + arms[1]);
        let reach = radii + arms[0] + arms[1] + length(self.between) + length(self.drift);
        let near = radii + self.rounding + turned + 64.0 * f64::EPSILON * reach;
        let mut fraction = 0.0;
        for _ in 0..MAX_LOOKS {
            let apart = self.between_at(fraction) + (center(1, fraction) - center(0, fraction));
            let gap = apart.length() - near;
            if gap > fastest * (until - fraction) {
                return false;
            }
            if gap.is_nan() || gap < radii * NEAR_ENOUGH {
                break;
            }
            fraction += gap / fastest;
        }
        true
    }

    /// The furthest that the end of an arm of unit length moves, in poses whose rotations are rounded to f32.
    fn chord(&self, i: usize) -> f64 {
        self.turns[i].map_or(0.0, |turn| turn.chord() + 2.0 * f64::from(f32::EPSILON))
    }

    /// Bounds on how far apart points of two parts are, along any axis.
    pub(super) fn reach(&self, parts: &[Part; 2]) -> Reach {
        let finite = |radius: f32| if radius.is_finite() { f64::from(radius) } else { 0.0 };
        let radii: f64 = parts.iter().map(|part| finite(part.shape.outer_radius())).sum();
        let arms = [0, 1].map(|i| parts[i].center.length());
        let apart = (self.between + (parts[1].center - parts[0].center)).length();
        let drift = self.drift.length();
        let way = drift + self.chord(0) * arms[0] + self.chord(1) * arms[1];
        Reach::new(apart + radii, way, self.between.length() + drift + arms[0] + arms[1] + radii)
    }
}

/// The part of a motion on which two parts may touch.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch {
    pub(super) from: f64,
    pub(super) to: f64,
    /// B's bounding sphere's centre less A's at the start of the motion.
    pub(super) apart: DVec3,
    /// How far off a gap of those spheres may be on the way.
    pub(super) doubt: f64,
}

impl Stretch {
    /// From where two spheres meet to where they part, given their centres, each from its body's position, and B's
    /// position less A's; with both radii come what rounding may take from their gap in the poses of moved bodies. For
    /// spheres that pass by, the square of a cross product decides, without root or quotient.
    pub(super) fn of_spheres(
        [from, to, between]: [DVec3; 3],
        (radii, rounding): (f64, f64),
        drift: DVec3,
        until: f64,
    ) -> Option<Self> {
        let apart = between + (to - from);
        let doubt =
            64.0 * f64::EPSILON * (radii + length(from) + length(to)) + 8.0 * f64::EPSILON * length(between);
        let reach = radii + rounding + doubt;
        let is_outside = |squared: f64| squared > reach * reach;
        let whole = Self { from: 0.0, to: until, apart, doubt };
        if !is_outside(apart.length_squared()) {
            return Some(whole);
        }
        let (pace, ahead) = (drift.length_squared(), apart.dot(drift));
        if ahead <= 0.0 {
            return None;
        }
        let beside = apart.cross(drift).length_squared();
        if beside > reach * reach * pace
            || ahead > until * pace && is_outside((apart - drift * until).length_squared())
        {
            return None;
        }
        // Slightly wider spheres, so that whatever rounding does, the real ones are apart where these meet and part.
        let (wide, inverse) = (radii + rounding + 4.0 * doubt, 1.0 / pace);
        let half_chord = (((wide * wide - beside * inverse) * inverse).max(0.0)).sqrt();
        let nearest = ahead * inverse;
        let (first, last) = ((nearest - half_chord).next_down(), nearest + half_chord);
        let certain = |fraction: f64| is_outside((apart - drift * fraction).length_squared());
        Some(Self {
            from: if first > 0.0 && certain(first) { first.min(until) } else { 0.0 },
            to: if last < until && certain(last) { last } else { until },
            ..whole
        })
    }
}

impl<'a> Course<'a> {
    pub(super) fn new(passage: &'a Passage, parts: [Part<'a>; 2], cores: [&'a Core3<'a>; 2]) -> Self {
        let [a, b] = parts.map(|part| part.shape);
        let finite = |radius: f32| if radius.is_finite() { f64::from(radius) } else { 0.0 };
        let radii = f64::from(a.radius()) + f64::from(b.radius());
        let size = finite(a.outer_radius()) + finite(b.outer_radius());
        let arms = [0, 1].map(|i| passage.arm(i, &parts[i], cores[i]));
        let fineness = Fineness { gap: IMPACT_GAP * size, rest: IMPACT_REST * size };
        let core_size = (size - radii).max(0.0);
        let (slack, are_apart) = (0.0, false);
        let mut course =
            Self { passage, parts, cores, radii, fineness, slack, size, core_size, arms, are_apart };
        let furthest = passage.between.length() + passage.drift.length();
        course.slack = passage.rounding + course.turned(furthest);
        course
    }

    /// The same course, with another limit for how near counts as met.
    pub(super) fn refined_to(self, fineness: Fineness) -> Self {
        Self { fineness, ..self }
    }

    /// The same course of two that, as an exact test has shown, do not touch at the start.
    pub(super) fn known_apart(self) -> Self {
        Self { are_apart: true, ..self }
    }

    /// Both parts as they stand at a fraction.
    pub(super) fn at(&self, fraction: f64) -> Moment<'a> {
        let passage = self.passage;
        let between = passage.between_at(fraction);
        let basis = |i: usize| passage.turns[i].map_or(passage.bases[i], |turn| turn.basis_at(fraction));
        let spin =
            |i: usize| passage.turns[i].map_or(DVec3::ZERO, |turn| turn.axis() * turn.speed_at(fraction));
        let ((basis_a, shift_a), (basis_b, shift_b)) =
            (self.parts[0].placed(&basis(0)), self.parts[1].placed(&basis(1)));
        let [a, b] = self.parts.map(|part| part.shape);
        // The positions and their difference lose a few roundings of the way, where a projection loses over a hundred.
        let way = (length(passage.between) + fraction * length(passage.drift)) / 32.0;
        let off_center = length(a.center().as_dvec3()) + length(b.center().as_dvec3());
        let reach = self.size + off_center + length(shift_a) + length(shift_b) + length(between) + way;
        Moment {
            a: placed((a, self.cores[0]), basis_a, shift_a, false),
            b: placed((b, self.cores[1]), basis_b, between + shift_b, true),
            between,
            precision: Precision {
                size: self.core_size,
                reach,
                planarity: 0.0,
                roundings: IN_SPACE.of_parts,
            },
            spins: [spin(0), spin(1)],
        }
    }

    /// What the rounding of poses at a fraction may add to a gap, in metres: positions to f64 and, for bodies that
    /// turn, rotations to f32.
    pub(super) fn rounding(&self, fraction: f64, between: DVec3) -> f64 {
        let is_between = fraction > 0.0 && fraction < 1.0;
        let turned = if is_between { self.turned(between.length()) } else { 0.0 };
        (if fraction > 0.0 { self.passage.rounding } else { 0.0 }) + turned
    }

    /// What rounding rotations to f32 may add to a gap, in metres, for bodies whose positions are `apart`.
    fn turned(&self, apart: f64) -> f64 {
        let turned = |i: usize| match (self.passage.turns[i], self.parts[i].shape) {
            (None, _) => 0.0,
            (Some(_), Shape3::HalfSpace(_)) => apart + self.arms[1 - i].from_position,
            (Some(_), _) => self.arms[i].from_position,
        };
        f64::from(f32::EPSILON) * (turned(0) + turned(1))
    }
}

impl Passage {
    fn arm(&self, i: usize, part: &Part, core: &Core3) -> Arm {
        let radius = f64::from(part.shape.outer_radius());
        let from_position = part.center.length() + if radius.is_finite() { radius } else { 0.0 };
        let Some(turn) = self.turns[i] else { return Arm { from_axis: 0.0, from_position } };
        let (basis, shift) = part.placed(&self.bases[i]);
        let across = |vertex: DVec3| turn.axis().cross(shift + basis.turn(vertex)).length();
        let furthest = core.vertices().iter().map(|&vertex| across(vertex.as_dvec3())).fold(0.0, f64::max);
        // Rounding: of the axis, of the bases and of these few operations, each below some forty units.
        let from_axis = furthest + 128.0 * f64::EPSILON * from_position;
        Arm { from_axis, from_position }
    }
}

fn placed<'a>(
    (shape, core): (&Shape3, &'a Core3<'a>),
    basis: Basis3,
    origin: DVec3,
    is_b: bool,
) -> Placed<'a> {
    match shape {
        Shape3::HalfSpace(half_space) => {
            Placed::HalfSpace(Plane { normal: basis.turn(half_space.unit_normal()), origin, is_b })
        }
        _ => Placed::Core(Solid::new(core, basis, origin, f64::from(shape.radius()))),
    }
}
