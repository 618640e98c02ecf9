//! How two bodies move, as the casts see it: one stretch, or two if a body turns; within each, everything is smooth.
//!
//! Within a stretch, times run from 0 to 1. Positions move at constant speed; cosine and sine move along a chord q(s)
//! and are normalised. With L the least length of q, and q x q' the area that it spans, a constant,
//!
//! ```text
//! angular speed         |q x q'| / |q|^2                     <= |q x q'| / L^2
//! second derivative     speed^2 and, square to it,
//! of the unit vector    2 |q x q'| |q.q'| / |q|^4            <= |q x q'|^2 / L^4 + 2 |q x q'| |q'| / L^3
//! ```

use super::{position_of, sum};
use crate::pair2::Pair2;
use crate::polygon::outline::Turn;
use arrayvec::ArrayVec;
use asunder_geometry::glam::{DVec2, Vec2};
use asunder_geometry::{Motion2, Pose2, Rotation2, Shape2};

/// How far a pose's rotation may be off the smooth path, in radians or as a stretch: it is rounded to f32 twice, and
/// where the path begins and ends it is of unit length only up to one rounding.
const ROTATION_ROUNDING: f64 = f32::EPSILON as f64;

/// The motion of both bodies.
pub(super) struct Travel {
    stretches: ArrayVec<Stretch, 2>,
}

/// A share of the motion.
pub(super) struct Stretch {
    /// Where it begins, and how much of the motion it is, as shares of the motion.
    pub(super) start: f64,
    pub(super) share: f64,
    /// B's position less A's, where the stretch begins.
    pub(super) offset: DVec2,
    /// How far A moves relative to B, over the stretch.
    pub(super) velocity: DVec2,
    pub(super) spins: [Spin; 2],
    /// Sums of coordinates by magnitude: of the positions of bodies that move, and of how far they move.
    positions: f64,
    paths: f64,
}

/// How one body turns.
#[derive(Clone, Copy)]
pub(super) struct Spin {
    /// Cosine and sine at the beginning.
    from: DVec2,
    /// How they change; zero for a body that does not turn.
    change: DVec2,
    /// Bounds on the angular speed and on the second derivative of the unit vector.
    pub(super) speed: f64,
    pub(super) swerve: f64,
    /// How far a point of the body may be off its smooth path, as a share of its arm.
    pub(super) rounding: f64,
}

impl Travel {
    /// A moves by a displacement; B stands still.
    pub(super) fn shift([a, b]: [&Pose2; 2], displacement: DVec2) -> Self {
        let mut stretches = ArrayVec::new();
        let is_still = displacement == DVec2::ZERO;
        stretches.push(Stretch {
            start: 0.0,
            share: 1.0,
            offset: b.position() - a.position(),
            velocity: displacement,
            spins: [Spin::still(a.rotation()), Spin::still(b.rotation())],
            positions: if is_still { 0.0 } else { position_of(a) },
            paths: sum(displacement),
        });
        Self { stretches }
    }

    /// Both bodies move, and perhaps turn.
    pub(super) fn of(pair: &Pair2, motions: [&Motion2; 2]) -> Self {
        let (poses, shapes) = ([&pair.pose_a, &pair.pose_b], [pair.shape_a, pair.shape_b]);
        let [a, b] = [0, 1].map(|which| {
            let way = Way::new(poses[which], motions[which]);
            Way { is_turning: way.is_turning && !is_round(shapes[which]), ..way }
        });
        let offset = b.start.position() - a.start.position();
        let velocity = a.path - b.path;
        let mut stretches = ArrayVec::new();
        let mut push = |start: f64, share: f64, spins: [Spin; 2]| {
            stretches.push(Stretch {
                start,
                share,
                offset: offset - velocity * start,
                velocity: velocity * share,
                spins,
                positions: a.positions + b.positions,
                paths: (sum(a.path) + sum(b.path)) * share,
            });
        };
        if a.is_turning || b.is_turning {
            push(0.0, 0.5, [a.spin(0, 1), b.spin(0, 1)]);
            push(0.5, 0.5, [a.spin(1, 2), b.spin(1, 2)]);
        } else {
            push(0.0, 1.0, [a.spin(0, 2), b.spin(0, 2)]);
        }
        Self { stretches }
    }

    pub(super) fn stretches(&self) -> &[Stretch] {
        &self.stretches
    }

    /// Whether neither body moves relative to the other, and neither turns.
    pub(super) fn is_still(&self) -> bool {
        self.stretches.iter().all(|stretch| stretch.paths == 0.0 && !stretch.is_turning())
    }
}

/// The poses of one body that a motion leads through.
struct Way {
    start: Pose2,
    path: DVec2,
    positions: f64,
    is_turning: bool,
    rotations: [Rotation2; 3],
}

impl Way {
    fn new(from: &Pose2, motion: &Motion2) -> Self {
        let [middle, end] = [0.5, 1.0].map(|fraction| motion.pose_at(from, fraction));
        let path = end.position() - from.position();
        let is_moving = path != DVec2::ZERO;
        Self {
            start: *from,
            path,
            positions: if is_moving { position_of(from) + position_of(&end) } else { 0.0 },
            is_turning: end.rotation() != from.rotation(),
            rotations: [from.rotation(), middle.rotation(), end.rotation()],
        }
    }

    fn spin(&self, from: usize, to: usize) -> Spin {
        if self.is_turning {
            Spin::new(self.rotations[from], self.rotations[to])
        } else {
            Spin::still(self.start.rotation())
        }
    }
}

impl Stretch {
    /// B's position less A's at a time.
    #[inline]
    pub(super) fn offset_at(&self, at: f64) -> DVec2 {
        self.offset - self.velocity * at
    }

    pub(super) fn is_turning(&self) -> bool {
        self.spins.iter().any(|spin| spin.rounding > 0.0)
    }

    /// An upper bound on the rounding error of the difference of positions up to a time, both in the poses that are
    /// reported and here.
    pub(super) fn lost(&self, end: f64) -> f64 {
        4.0 * f64::EPSILON * (self.positions + sum(self.offset) + self.paths * end)
    }
}

impl Spin {
    fn still(rotation: Rotation2) -> Self {
        Self { from: vector(rotation), change: DVec2::ZERO, speed: 0.0, swerve: 0.0, rounding: 0.0 }
    }

    fn new(from: Rotation2, to: Rotation2) -> Self {
        let (from, to) = (vector(from), vector(to));
        let change = to - from;
        // Where the chord is nearest to the origin.
        let foot = -from.dot(change) / change.length_squared().max(f64::MIN_POSITIVE);
        let least = (from + change * foot.clamp(0.0, 1.0)).length_squared();
        let area = from.perp_dot(to).abs();
        let grown = 1.0 + 1e-9;
        let speed = area / least * grown;
        let swerve = (speed * speed + 2.0 * area * change.length() / (least * least.sqrt())) * grown;
        Self { from, change, speed, swerve, rounding: ROTATION_ROUNDING }
    }

    /// The furthest that the end of an arm of unit length moves, in poses whose rotations are rounded to f32.
    pub(super) fn chord(&self) -> f64 {
        self.change.length() + 4.0 * self.rounding
    }

    /// How fast it turns at a time, in radians for the whole stretch, counterclockwise.
    pub(super) fn speed_at(&self, at: f64) -> f64 {
        let squared = (self.from + self.change * at).length_squared();
        self.from.perp_dot(self.change) / squared.max(f64::MIN_POSITIVE)
    }

    /// The rotation at a time: the stored one of a body that does not turn, else of unit length.
    #[inline]
    pub(super) fn turn_at(&self, at: f64) -> Turn {
        if self.rounding == 0.0 {
            return Turn::to(self.from);
        }
        Turn::to((self.from + self.change * at).normalize())
    }
}

/// Whether a shape stays where it is as its body turns: a ball about the body's position. It is treated as one that
/// does not turn, so that it meets the same; else all of its arm would count as a path along which it moves.
fn is_round(shape: &Shape2) -> bool {
    shape.center() == Vec2::ZERO && shape.outer_radius() <= shape.radius()
}

fn vector(rotation: Rotation2) -> DVec2 {
    DVec2::new(f64::from(rotation.cos()), f64::from(rotation.sin()))
}
