//! The manifolds of a body on ground, moved along.
//!
//! To answer anew for a body at rest on ground costs several times as much as for one on a box: triangles are found,
//! read and tested. But ground does not move, and neither do its normals: while the body slides a little, each point
//! stays where the same two features meet, and rises as they do.
//!
//! ```text
//! t   how far the body's position moved; R how it turned; u = t + (R - 1) a, how its matter at a point a moved
//! each point rises by g . u, where n is the normal from ground to body, and                                   (grip)
//!     a vertex of the body over a face of ground, or a corner of ground under a face of the body, with normal f:
//!                                                     g = f / (f . n)
//!     an edge u' of the body that crosses an edge v:  g = c / (c . n),  c = u' x v
//! that is exact for t, as long as the features meet: vertices stay over faces, edges go on crossing           (flat)
//! where edges cross, the point slides along both, to where they cross now                                     (grip)
//! turning by `spin` adds  |g| |u| spin  and lets points that are not reported get deeper by up to  3 spin * arm
//! overlap:     no, while the drift is less than the gap between them
//!              yes, while a segment of the body crosses a triangle, or a point of ground is in the box     (witness)
//! ```
//! **How far.**
//! - Up to 2^-8 of the radius, 3.4 mm for a cube of a metre. Only then it is decided again which directions ground
//!   accepts.
//! - No further than the margin: all ground that the body can come to overlap was within the margin, and so was
//!   reported. With a smaller margin, up to 2^-15, as for solids.
//! - Up to where the first point may leave its features, or further where the error stays bearable. The error then
//!   includes, from the start, a share of the drift: by how steeply ground bends at the next feature, or twice the
//!   drift where that is unknown. Bearable is up to 2^-14 of the radius. (Charged wherever the longest motion would
//!   lead past a feature, frames of boxes and hulls at rest on hills took 1.05 to 1.23 times as long: AMD EPYC, Zen 5,
//!   2026-11-25.)
//!
//! Ground between points rises differently from them: by twice the greatest of the low bends around them. A ball has no
//! features to leave, and is charged for its curvature.
//!
//! parry3d keeps a manifold per triangle until a point of it slips by a millimetre.

use super::flat::NearPoints;
use super::grip::{Grip, Place, Seam, Slide, UNKNOWN};
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

/// The manifolds of a body of one part on ground, and the poses when they were computed.
#[derive(Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Grounded {
    memory: Memory,
    is_ground_b: bool,
    /// Whether the body is a ball: nothing depends on its rotation.
    is_ball: bool,
    /// The error charged where points leave their features, as a share of the motion: zero where none does.
    cost: f32,
    margin: f32,
    /// The drift up to which they hold, in metres.
    reach: f32,
    /// Most that an error may grow by, in metres.
    most_loss: f32,
    /// How far the body reaches from its position, in metres.
    arm: f32,
    /// The bodies' poses then.
    poses: [Pose3; 2],
}

/// The manifolds, the grips of their points, and the proof that the two overlap; none where they do not.
#[derive(Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Memory {
    manifolds: Vec<Manifold3>,
    grips: Vec<[Grip; 4]>,
    /// One for each point that stays on two edges, in the order of the points.
    slides: Vec<Slide>,
    /// At most one. Stored here for its size: an enum takes the room of its largest variant.
    witness: Vec<Witness>,
}

/// Most places where points of a body may leave their features: four points per manifold, and the ground between them.
/// Bodies with more are not kept.
const MOST_SEAMS: usize = 80;

/// Most bodies have no more manifolds than this: room for so many is reserved from the start.
const MANY: usize = 6;

asunder_geometry::copied!(Grounded, { memory, is_ground_b, is_ball, cost, margin, reach, most_loss, arm, poses } but {});

asunder_geometry::copied!(Memory, { manifolds, grips, slides, witness } but {});

impl Memory {
    fn clear(&mut self) {
        self.manifolds.clear();
        self.grips.clear();
        self.slides.clear();
        self.witness.clear();
        self.manifolds.reserve(MANY);
        self.grips.reserve(MANY);
        self.slides.reserve(MANY);
        self.witness.reserve(1);
    }
}

/// The body of a job that has ground, if it is of one part and bounded; and whether the ground is B.
fn body_of<'a>(job: &Job3<'a>) -> Option<(&'a Shape3, bool)> {
    let (body, is_ground_b) = match (Ground::of(job.shape_a), Ground::of(job.shape_b)) {
        (None, Some(_)) => (job.shape_a, true),
        (Some(_), None) => (job.shape_b, false),
        _ => return None,
    };
    (!matches!(body, Shape3::Compound(_) | Shape3::HalfSpace(_))).then_some((body, is_ground_b))
}

/// The largest drift up to which manifolds of a job can be moved along, in metres; `None` without ground.
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
            // Directions that one-sided ground rejects are not reported, and the gap along them may be smaller.
            let gap = match pair.separation(reach) {
                Separation3::Measured(near) => near.separation - near.error,
                Separation3::AtLeast(bound) => bound,
            };
            let most = found.iter().fold(f32::INFINITY, |bound: f32, of| bound.min(of.separation + of.error));
            reach = reach.min(gap).min(job.margin - most).next_down();
        }
        // NaN is no reach.
        let is_some = !found.is_empty() && reach > 0.0;
        if !is_some {
            return None;
        }
        let near = NearPoints::of(&on, found, reach);
        let mut seams: ArrayVec<Seam, MOST_SEAMS> = ArrayVec::new_const();
        memory.clear();
        for manifold in found {
            // Ground that is hidden between points may rise differently from them, by as much as either normal leans.
            let between = 2.0 * near.bend_between(on.basis.turn_back(on.towards(manifold)));
            seams.try_push(Seam { free: 0.0, cost: between }).ok()?;
            let mut grips = [Grip::NONE; 4];
            for (grip, point) in grips.iter_mut().zip(&manifold.points) {
                let (seam, slide);
                (*grip, seam, slide) = Grip::of(&on, manifold, point, (&near, reach))?;
                seams.try_push(seam).ok()?;
                memory.slides.extend(slide);
            }
            memory.grips.push(grips);
        }
        // As far as no point leaves its features, or as the error stays bearable.
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

    /// Its memory, for reuse. What is left cannot be moved along.
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
        let Memory { manifolds, grips, slides, witness } = &self.memory;
        let held = manifolds.iter().zip(grips).flat_map(|(of, grips)| grips.iter().take(of.points.len()));
        !manifolds.is_empty()
            && held.filter(|grip| grip.place() == Place::Edges).count() == slides.len()
            && slides.iter().all(|slide| slide.is_sound(self.arm))
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

    /// Reorders a pair from (A, B) to (body, ground).
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
        // NaN is not close.
        let is_close = drift <= f64::from(self.reach);
        let is_certain =
            || self.memory.witness.iter().all(|witness| witness.holds(&moved, body.basis(), arm));
        is_close && is_certain() && self.move_along(&moved, to)
    }

    /// Appends all manifolds as they are now, or none where the error would be too large.
    fn move_along(&self, moved: &Moved, to: &mut Vec<Manifold3>) -> bool {
        let (start, mut slides) = (to.len(), self.memory.slides.iter());
        for (of, grips) in self.memory.manifolds.iter().zip(&self.memory.grips) {
            let loss = self.loss(of, grips, moved);
            let is_accurate = loss <= f64::from(self.most_loss);
            if !is_accurate {
                to.truncate(start);
                return false;
            }
            to.push(Manifold3::BLANK);
            if let Some(to) = to.last_mut() {
                self.fill(of, (grips, &mut slides), moved, to);
                let known = f64::from(of.error);
                to.error = ((known + loss) as f32).next_up();
            }
        }
        // The deepest of all has the sign of the overlap decision.
        let deepest = to[start..]
            .iter_mut()
            .reduce(|least, next| if next.separation < least.separation { next } else { least });
        if let Some(deepest) = deepest {
            deepest.separation = signed(deepest.separation.into(), self.overlapping());
        }
        true
    }

    /// By how much the error of a manifold's separation grows.
    fn loss(&self, of: &Manifold3, grips: &[Grip; 4], moved: &Moved) -> f64 {
        let Moved { drift, spin, .. } = *moved;
        let (mut lean, mut steep) = (0.0_f64, 1.0_f64);
        for grip in grips.iter().take(of.points.len()) {
            (lean, steep) = (lean.max(grip.lean().into()), steep.max(grip.steep().into()));
        }
        // Points that are not reported, beyond four or on the line between two others, may rise by less than the
        // reported ones; or by more: then the reported ones may be the nearest, and the manifold is no deeper than they
        // are.
        let least = of.points.iter().fold(f32::INFINITY, |least, point| least.min(point.separation));
        let beside = f64::from(least) - f64::from(of.separation);
        let unreported =
            if of.points.is_full() || beside > 0.0 { lean * drift + beside.max(0.0) } else { 0.0 };
        let left = f64::from(self.cost) * drift;
        // The curvature of a ball.
        let round =
            if self.is_ball { around(f64::from(self.arm) + f64::from(of.separation), drift) } else { 0.0 };
        let rounding = f64::from(f32::EPSILON) * (f64::from(of.separation.abs()) + steep * drift);
        let turned = spin * (3.0 * f64::from(self.arm) + 4.0 * steep * steep * drift);
        unreported + left + round + rounding + turned
    }

    fn fill<'s>(
        &self,
        of: &Manifold3,
        (grips, slides): (&[Grip; 4], &mut impl Iterator<Item = &'s Slide>),
        moved: &Moved,
        to: &mut Manifold3,
    ) {
        (to.part_a, to.part_b, to.normal) = (of.part_a, of.part_b, of.normal);
        let towards = if self.is_ground_b { -of.normal.as_dvec3() } else { of.normal.as_dvec3() };
        let (mut deepest, mut deepest_then) = (f64::INFINITY, f64::INFINITY);
        to.points.extend(of.points.iter().zip(grips).map(|(point, grip)| {
            let [on_body, on_ground] = self.sides([point.anchor_a, point.anchor_b]);
            let (on_body, then) = (on_body.as_dvec3(), f64::from(point.separation));
            let turned = moved.turn.turn(on_body);
            let way = moved.step + (turned - on_body);
            let rise = grip.rise(way);
            let height = then + rise;
            let (mut body, mut ground) = (turned, on_ground.as_dvec3());
            match grip.place() {
                Place::Body => ground += way - towards * rise,
                Place::Ground => body = on_body - moved.step + towards * rise,
                Place::Edges => {
                    let slide = slides.next().map_or(DVec3::ZERO, |slide| slide.by(way));
                    (body, ground) = (turned + slide, ground + way + slide - towards * rise);
                }
            }
            let (body, ground) = (body.as_vec3(), ground.as_vec3());
            (deepest, deepest_then) = (deepest.min(height), deepest_then.min(then));
            let [anchor_a, anchor_b] = self.sides([body, ground]);
            ContactPoint3 { separation: height as f32, anchor_a, anchor_b, feature: point.feature }
        }));
        to.separation = (f64::from(of.separation) + (deepest - deepest_then)) as f32;
    }
}

/// By how much more than linearly the distance to a point this far away changes over a motion: infinite where that
/// point is not far beyond the motion.
fn around(distance: f64, way: f64) -> f64 {
    if distance > 2.0 * way { way * way / distance } else { f64::INFINITY }
}

/// How a body moved since its manifolds were computed, in world axes.
pub(super) struct Moved {
    pub(super) turn: Basis3,
    /// The motion of its position.
    pub(super) step: DVec3,
    /// From the ground's position to its own, now.
    pub(super) offset: DVec3,
    /// No point of the body moved further than this, in metres.
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
