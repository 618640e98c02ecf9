//! The manifolds of a body on ground, moved along.
//!
//! A body that rests on a level is answered anew at several times the cost of one that rests on a box: triangles are
//! found, read, and each is asked about. But ground does not move, and its normals do not: while the body slides a
//! little, each point goes on being where the same two features meet, and rises as they do.
//!
//! ```text
//! t   how far the body's position moved; R how it turned; u = t + (R - 1) a, how its matter at a point moved
//! each point rises by g . u, where n is the normal from ground to body, and                                   (grip)
//!     a corner of the body over a face f of ground, or a corner of ground against a face f of the body:
//!                                                     g = f / (f . n)
//!     an edge u' of it that crosses an edge v:        g = c / (c . n),  c = u' x v
//! that is exact for t, as long as the features go on meeting: corners stay over faces, edges go on crossing    (flat)
//! turning by `spin` adds  |g| |u| spin  and lets what was not told get deeper by up to  3 spin * arm
//! yes or no:   no, while the drift is less than what parts them
//!              yes, while a segment of the body crosses a triangle, or a point of ground is in the box      (witness)
//! ```
//! **How far.** Up to 2^-8 of the radius, of a cube of a metre 3.4 mm. Which directions ground lets through is chosen
//! anew only then. And no further than the margin: all that the body can come to overlap has been within the margin,
//! and so has been told; with a smaller margin, up to 2^-15 as for solids. It ends, too, where the first point may
//! leave its features, unless what that costs is bearable for longer: then it costs, from the start, a share of the
//! drift, by how steeply ground bends at the next, and twice the drift where nobody knows; no further than that is
//! 2^-14 of the radius. (Charged wherever the longest way would lead past a feature, frames of boxes and hulls at rest
//! on hills took 1.05 to 1.23 times as long: AMD EPYC, Zen 5, 2026-11-25.) Ground between points rises otherwise than
//! they do: twice the greatest of the low bends around them. A ball has no features to leave, and pays for the way
//! around itself.
//!
//! parry3d keeps a manifold a triangle until a point of it slips by a millimetre.

use super::flat::NearPoints;
use super::grip::{Grip, Seam, UNKNOWN};
use super::hold::arm_of;
use super::witness::Witness;
use crate::answer::{Answer, ContactPoint3, Manifold3, Separation3};
use crate::ground3::OnGround;
use crate::jobs3::Job3;
use crate::pair3::Pair3;
use crate::persistent::{are_lengths, lost, reach_of};
use crate::precision::signed;
use arrayvec::ArrayVec;
use asunder_geometry::glam::DVec3;
use asunder_geometry::{Basis3, Ground, Pose3, Shape3};

/// Share of the bounding radius by which a body may slide on ground, 2^-8.
const SLIDE: f32 = 1.0 / 256.0;

/// Most that an error of a body of this bounding radius may grow by, in metres: as much as that of two solids.
fn most_loss(radius: f32) -> f32 {
    2.0 * reach_of([radius; 2])
}

/// The manifolds of a body of one part on ground, and how it stood when they were made.
#[derive(Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Grounded {
    memory: Memory,
    is_ground_b: bool,
    /// Nothing of it depends on how it is turned.
    is_ball: bool,
    /// What it costs where points leave their features, as a share of the way: zero where none does, which bounds no
    /// reach.
    cost: f32,
    margin: f32,
    /// Up to which drift they hold, in metres.
    reach: f32,
    /// Most that an error may grow by, in metres.
    most_loss: f32,
    /// How far the body reaches from its position, in metres.
    arm: f32,
    /// Where the bodies were.
    poses: [Pose3; 2],
}

/// The manifolds, what holds the points of each, and what shows that the two overlap; nothing where they do not.
#[derive(Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Memory {
    manifolds: Vec<Manifold3>,
    grips: Vec<[Grip; 4]>,
    /// At most one. Here for its size: whatever is kept takes the room of the largest that there is.
    witness: Vec<Witness>,
}

/// Places where points may leave their features, of one body: four points a manifold, and what is between them. Bodies
/// with more are not kept.
const MOST_SEAMS: usize = 80;

/// Manifolds of most bodies: for so many there is room from the start.
const MANY: usize = 6;

asunder_geometry::copied!(Grounded, { memory, is_ground_b, is_ball, cost, margin, reach, most_loss, arm, poses } but {});

asunder_geometry::copied!(Memory, { manifolds, grips, witness } but {});

impl Memory {
    fn clear(&mut self) {
        self.manifolds.clear();
        self.grips.clear();
        self.witness.clear();
        self.manifolds.reserve(MANY);
        self.grips.reserve(MANY);
        self.witness.reserve(1);
    }
}

/// The body of a job that has ground, if it is of one part and has an end; whether the ground is B.
fn body_of<'a>(job: &Job3<'a>) -> Option<(&'a Shape3, bool)> {
    let (body, is_ground_b) = match (Ground::of(job.shape_a), Ground::of(job.shape_b)) {
        (None, Some(_)) => (job.shape_a, true),
        (Some(_), None) => (job.shape_b, false),
        _ => return None,
    };
    (!matches!(body, Shape3::Compound(_) | Shape3::HalfSpace(_))).then_some((body, is_ground_b))
}

/// Up to which drift manifolds of a job can be moved along at most, in metres; nothing where there is no ground.
pub(super) fn most_reach(job: &Job3<'_>) -> Option<f32> {
    body_of(job).map(|(body, _)| most_slide(body, job.margin))
}

fn most_slide(body: &Shape3, margin: f32) -> f32 {
    let radius = body.outer_radius();
    (SLIDE * radius).min(margin).max(reach_of([radius; 2]))
}

impl Grounded {
    pub(super) fn of(
        job: &Job3<'_>,
        answer: &Answer,
        manifolds: &[Manifold3],
        memory: &mut Memory,
    ) -> Option<Self> {
        let Answer::Contact { overlapping, manifolds: range, .. } = answer else { return None };
        let found = manifolds.get(range.start as usize..range.end as usize)?;
        let (body, is_ground_b) = body_of(job)?;
        let pair = Pair3::new(job.shape_a, job.pose_a, job.shape_b, job.pose_b);
        let on = OnGround::of(&pair)?;
        let arm = arm_of(body);
        let mut reach = most_slide(body, job.margin);
        if !overlapping {
            // What one-sided ground refuses is not told, and may part them by less than what is.
            let gap = match pair.separation(reach) {
                Separation3::Measured(near) => near.separation - near.error,
                Separation3::AtLeast(bound) => bound,
            };
            let most = found.iter().fold(f32::INFINITY, |bound: f32, of| bound.min(of.separation + of.error));
            reach = reach.min(gap).min(job.margin - most).next_down();
        }
        // What is not a number is no reach.
        let is_some = !found.is_empty() && reach > 0.0;
        if !is_some {
            return None;
        }
        let near = NearPoints::of(&on, found, reach);
        let mut seams: ArrayVec<Seam, MOST_SEAMS> = ArrayVec::new_const();
        memory.clear();
        for manifold in found {
            // What is hidden between points may rise otherwise than they do, by as much as either normal leans.
            let between = 2.0 * near.bend_between(on.basis.turn_back(on.towards(manifold)));
            seams.try_push(Seam { free: 0.0, cost: between }).ok()?;
            let mut grips = [Grip::NONE; 4];
            for (grip, point) in grips.iter_mut().zip(&manifold.points) {
                let seam;
                (*grip, seam) = Grip::of(&on, manifold, point, (&near, reach))?;
                seams.try_push(seam).ok()?;
            }
            memory.grips.push(grips);
        }
        // As far as no point leaves its features, or as what it costs is bearable.
        let most_loss = most_loss(body.outer_radius());
        let furthest = seams.iter().map(|seam| seam.reach(most_loss.into())).fold(f64::INFINITY, f64::min);
        reach = reach.min((furthest as f32).next_down());
        let left = seams.iter().filter(|seam| seam.free < reach.into());
        let cost = left.map(|seam| seam.cost).fold(0.0, f64::max);
        let cost = if cost == 0.0 { 0.0 } else { (cost.min(UNKNOWN) as f32).next_up() };
        if *overlapping {
            memory.witness.push(Witness::of(&on, found, &near, arm)?);
        }
        memory.manifolds.extend_from_slice(found);
        let (is_ball, margin) = (matches!(body, Shape3::Sphere(_)), job.margin);
        let poses = [*job.pose_a, *job.pose_b];
        let memory = core::mem::take(memory);
        Some(Self { memory, is_ground_b, is_ball, cost, margin, reach, most_loss, arm, poses })
    }

    /// Its memory, for what comes after it. What is left carries nothing on.
    pub(super) fn take_memory(&mut self) -> Memory {
        self.reach = -1.0;
        core::mem::take(&mut self.memory)
    }

    pub(super) const fn reach(&self) -> f32 {
        self.reach
    }

    pub(super) fn manifolds(&self) -> &[Manifold3] {
        &self.memory.manifolds
    }

    pub(super) const fn overlapping(&self) -> bool {
        !self.memory.witness.is_empty()
    }

    pub(super) const fn margin(&self) -> f32 {
        self.margin
    }

    pub(super) fn is_sound(&self) -> bool {
        let Memory { manifolds, grips, witness } = &self.memory;
        !manifolds.is_empty()
            && manifolds.len() == grips.len()
            && manifolds.iter().all(|of| are_lengths(&[of.separation, of.error]))
            && are_lengths(&[self.margin, self.arm])
            && (0.0..=self.arm).contains(&self.reach)
            && (0.0..=most_loss(self.arm)).contains(&self.most_loss)
            && (0.0..=UNKNOWN as f32 * 1.001).contains(&self.cost)
            && grips.iter().flatten().all(Grip::is_sound)
            && witness.len() <= 1
            && witness.iter().all(Witness::is_sound)
    }

    /// Which of two things is the body's and which the ground's.
    #[inline(always)]
    const fn sides<T: Copy>(&self, [a, b]: [T; 2]) -> [T; 2] {
        if self.is_ground_b { [a, b] } else { [b, a] }
    }

    pub(super) fn carry_on(&self, poses: [&Pose3; 2], to: &mut Vec<Manifold3>) -> bool {
        let [body_then, ground_then] = self.sides([&self.poses[0], &self.poses[1]]);
        let [body, ground] = self.sides(poses);
        if !ground.same_bits(ground_then) || self.reach < 0.0 {
            return false;
        }
        if body.same_bits(body_then) {
            to.extend_from_slice(&self.memory.manifolds);
            return true;
        }
        let turn = if self.is_ball || body.same_rotation(body_then) {
            Basis3::UNIT
        } else {
            body.turn_since(body_then)
        };
        let offset = body.position() - ground.position();
        let step = body.position() - body_then.position();
        let (arm, spin) = (f64::from(self.arm), turn.spin_from(&Basis3::UNIT));
        let drift = step.length() + spin * arm + lost(offset.abs().element_sum(), arm);
        let moved = Moved { turn, step, offset, drift, spin };
        // What is not a number is not close.
        let is_close = drift <= f64::from(self.reach);
        let is_certain =
            || self.memory.witness.iter().all(|witness| witness.holds(&moved, body.basis(), arm));
        is_close && is_certain() && self.move_along(&moved, to)
    }

    /// Appends all of them as they are now; or nothing, where they would be off by too much.
    fn move_along(&self, moved: &Moved, to: &mut Vec<Manifold3>) -> bool {
        let start = to.len();
        for (of, grips) in self.memory.manifolds.iter().zip(&self.memory.grips) {
            let loss = self.loss(of, grips, moved);
            let is_told = loss <= f64::from(self.most_loss);
            if !is_told {
                to.truncate(start);
                return false;
            }
            to.push(Manifold3::BLANK);
            if let Some(to) = to.last_mut() {
                self.fill(of, grips, moved, to);
                let known = f64::from(of.error);
                to.error = ((known + loss) as f32).next_up();
            }
        }
        // The deepest of all has the sign of the decision.
        let deepest = to[start..]
            .iter_mut()
            .reduce(|least, next| if next.separation < least.separation { next } else { least });
        if let Some(deepest) = deepest {
            deepest.separation = signed(deepest.separation.into(), self.overlapping());
        }
        true
    }

    /// What a manifold's separation may be off by more than it was.
    fn loss(&self, of: &Manifold3, grips: &[Grip; 4], moved: &Moved) -> f64 {
        let Moved { drift, spin, .. } = *moved;
        let (mut lean, mut steep) = (0.0_f64, 1.0_f64);
        for grip in grips.iter().take(of.points.len()) {
            (lean, steep) = (lean.max(grip.lean().into()), steep.max(grip.steep().into()));
        }
        // Of more points than four, and of those that lay on the line between two others, the ones that are not told
        // may rise by less; and by more: then those that are told may be the nearest, and it is no deeper than they
        // are.
        let least = of.points.iter().fold(f32::INFINITY, |least, point| least.min(point.separation));
        let beside = f64::from(least) - f64::from(of.separation);
        let untold = if of.points.is_full() || beside > 0.0 { lean * drift + beside.max(0.0) } else { 0.0 };
        let left = f64::from(self.cost) * drift;
        // The way around a ball.
        let round =
            if self.is_ball { around(f64::from(self.arm) + f64::from(of.separation), drift) } else { 0.0 };
        let rounding = f64::from(f32::EPSILON) * (f64::from(of.separation.abs()) + steep * drift);
        let turned = spin * (3.0 * f64::from(self.arm) + 4.0 * steep * steep * drift);
        untold + left + round + rounding + turned
    }

    fn fill(&self, of: &Manifold3, grips: &[Grip; 4], moved: &Moved, to: &mut Manifold3) {
        (to.part_a, to.part_b, to.normal) = (of.part_a, of.part_b, of.normal);
        let towards = if self.is_ground_b { -of.normal.as_dvec3() } else { of.normal.as_dvec3() };
        let (mut deepest, mut deepest_then) = (f64::INFINITY, f64::INFINITY);
        to.points.extend(of.points.iter().zip(grips).map(|(point, grip)| {
            let [on_body, on_ground] = self.sides([point.anchor_a, point.anchor_b]);
            let (on_body, then) = (on_body.as_dvec3(), f64::from(point.separation));
            let turned = moved.turn.turn(on_body);
            let rise = grip.rise(moved.step + (turned - on_body));
            let height = then + rise;
            let (body, ground) = if grip.is_of_ground() {
                ((on_body - moved.step + towards * rise).as_vec3(), on_ground)
            } else {
                let way = moved.step + (turned - on_body) - towards * rise;
                (turned.as_vec3(), (on_ground.as_dvec3() + way).as_vec3())
            };
            (deepest, deepest_then) = (deepest.min(height), deepest_then.min(then));
            let [anchor_a, anchor_b] = self.sides([body, ground]);
            ContactPoint3 { separation: height as f32, anchor_a, anchor_b, feature: point.feature }
        }));
        to.separation = (f64::from(of.separation) + (deepest - deepest_then)) as f32;
    }
}

/// By how much more than in a line the distance to a point so far away changes on the way: too much, where that is not
/// far beyond the way.
fn around(distance: f64, way: f64) -> f64 {
    if distance > 2.0 * way { way * way / distance } else { f64::INFINITY }
}

/// How a body moved since, in world axes.
pub(super) struct Moved {
    pub(super) turn: Basis3,
    /// Of its position.
    pub(super) step: DVec3,
    /// From the ground's position to its own, now.
    pub(super) offset: DVec3,
    /// No point of it moved further than that, in metres.
    drift: f64,
    /// By how much it turned, in radians.
    spin: f64,
}

impl Moved {
    /// Not at all.
    pub(super) const fn none(offset: DVec3) -> Self {
        Self { turn: Basis3::UNIT, step: DVec3::ZERO, offset, drift: 0.0, spin: 0.0 }
    }
}
