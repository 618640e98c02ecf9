//! This frame's motions: how bodies are about to move, so that an update can report what they will run into.

use crate::bodies::note_slot;
use crate::collider::Collider;
use crate::space::{BodyKey2, BodyKey3, Space};
use crate::world::{StaleKey, World, slot_of};
use asunder_geometry::tolerance;
use asunder_narrow::{Impact2, Impact3};

/// An impact of a bullet during its motion: see [`Collider::bullet`](crate::Collider::bullet).
///
/// ```
/// use asunder::{Collider3, Hit3, Motion3, Pose3, Sphere, World3, glam::Vec3};
/// let mut world = World3::new();
/// let ball = Collider3::new(Sphere::new(0.5)?);
/// let target = world.insert(ball.clone().at(Pose3::at([5.0, 0.0, 0.0])?));
/// let bullet = world.insert(ball.bullet());
/// world.set_motion(bullet, Motion3::shift([8.0, 0.0, 0.0])?)?;
/// world.update();
/// let [Hit3 { bullet: who, other, sensor, impact }] = world.impacts() else { return Err("one impact".into()) };
/// assert_eq!((*who, *other, *sensor), (bullet, target, false));
/// assert!(impact.fraction <= 0.5 && impact.fraction > 0.4999, "after 4 of 8 m");
/// assert!((impact.normal - Vec3::X).length() < 1e-6, "from the bullet, though its slot is the higher one");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Hit<K, I> {
    /// The bullet: A of the impact.
    pub bullet: K,
    /// The body that it meets, which may be a bullet too: B of the impact.
    pub other: K,
    /// Whether either is a sensor, which stops no body.
    pub sensor: bool,
    /// The time and place of the impact, with its error. The normal points from the bullet to the other body. The point
    /// in the world is `anchor_a` from the bullet's position at that fraction of its motion; if the other body has no
    /// motion, it is also `anchor_b` from that body's position.
    pub impact: I,
}

/// An impact of a bullet in the plane.
pub type Hit2 = Hit<BodyKey2, Impact2>;

/// An impact of a bullet in space.
pub type Hit3 = Hit<BodyKey3, Impact3>;

/// The motions for the next update.
#[derive(Debug)]
pub(crate) struct Motions<S: Space> {
    /// By slot; shorter than the slots if the last ones have none.
    of_slot: Vec<Option<S::Motion>>,
    /// Slots that have one, or had one and lost it with their body.
    slots: Vec<u32>,
}

asunder_geometry::copied!(Motions<S>, for [S: Space], { of_slot, slots } but {});

impl<S: Space> Motions<S> {
    pub(crate) const NONE: Self = Self { of_slot: Vec::new(), slots: Vec::new() };

    /// The motion of the body in a slot.
    #[inline]
    pub(crate) fn of(&self, slot: u32) -> Option<S::Motion> {
        self.of_slot.get(slot as usize).copied().flatten()
    }

    /// Whether there are none.
    #[inline]
    pub(crate) fn is_empty(&self) -> bool {
        self.slots.is_empty()
    }

    /// Slots that have one or had one, ascending, each with its motion.
    #[cfg(feature = "serde")]
    pub(crate) fn list(&self) -> Vec<(u32, Option<S::Motion>)> {
        let mut slots = self.slots.clone();
        slots.sort_unstable();
        slots.dedup();
        slots.into_iter().map(|slot| (slot, self.of(slot))).collect()
    }

    /// The motions of such a list, whose slots have been checked.
    #[cfg(feature = "serde")]
    pub(crate) fn of_list(list: &[(u32, Option<S::Motion>)]) -> Self {
        let mut motions = Self::NONE;
        for &(slot, motion) in list {
            match motion {
                Some(motion) => motions.set(slot, motion),
                None => motions.slots.push(slot),
            }
        }
        motions
    }

    pub(crate) fn forget(&mut self, slot: u32) {
        if let Some(motion) = self.of_slot.get_mut(slot as usize) {
            *motion = None;
        }
    }

    fn set(&mut self, slot: u32, motion: S::Motion) {
        let index = slot as usize;
        if index >= self.of_slot.len() {
            self.of_slot.resize(index + 1, None);
        }
        if self.of_slot[index].replace(motion).is_none() {
            note_slot(&mut self.slots, slot, self.of_slot.len());
        }
    }
}

impl<S: Space> World<S> {
    pub(crate) fn set_motion_of(&mut self, key: S::Key, motion: S::Motion) -> Result<(), StaleKey> {
        self.bodies.get_mut(key).ok_or(StaleKey)?.asleep = false;
        self.motions.set(slot_of(key), motion);
        self.mark_changed(slot_of(key));
        Ok(())
    }

    pub(crate) fn hits_of(&self, bullet: S::Key) -> impl Iterator<Item = &Hit<S::Key, S::Impact>> + Clone {
        // A stale key gets an empty range.
        let slot = if self.bodies.contains_key(bullet) { slot_of(bullet) } else { u32::MAX };
        let before = self.impacts.partition_point(|hit| slot_of(hit.bullet) < slot);
        let later = &self.impacts[before..];
        // The slot may have been another bullet's then, and the other body may have been removed since.
        later
            .iter()
            .take_while(move |hit| hit.bullet == bullet)
            .filter(|hit| self.bodies.contains_key(hit.other))
    }

    /// Marks the bodies whose motions are left over from an update that did not finish, since a hook panicked: all
    /// their pairs are processed again.
    pub(crate) fn mark_kept_motions(&mut self) {
        for index in 0..self.motions.slots.len() {
            let slot = self.motions.slots[index];
            if !self.is_dirty[slot as usize] {
                self.mark_changed(slot);
            }
        }
    }

    /// Drops the motions after an update, and marks the boxes around them, which are too wide now.
    pub(crate) fn forget_motions(&mut self) {
        while let Some(slot) = self.motions.slots.pop() {
            self.motions.forget(slot);
            self.mark_changed(slot);
        }
    }
}

/// The box around a body throughout its motion, rounded outwards.
///
/// It is the box around both ends, grown by what may stick out in between. A point that turns is at R(t) v, and the
/// boxes hold (1 - t) R(0) v + t R(1) v. With w the speed, R(t) v is no further than w t |v| from the first and w
/// (1 - t) |v| from the second, and so 2 t (1 - t) w |v| from their mean: at most half of w |v|.
pub(crate) fn swept_bounds<S: Space>(body: &Collider<S>, motion: &S::Motion) -> S::Aabb {
    let turn_speed = S::turn_speed(motion, &body.pose);
    // Rotations in between are rounded to f32 at times, by less than 1.2e-7.
    let out = swing(turn_speed, turn_speed / 2.0 + 2.4e-7, S::arm(&body.shape));
    let margin = rounded_up(f64::from(body.margin) + out);
    let around = |pose: &S::Pose| S::bounds(&body.shape, pose, margin);
    S::union(&around(&body.pose), &around(&S::end(motion, &body.pose)))
}

/// The most by which two bodies may come nearer to each other in their motions, in metres; capped at the greatest
/// margin.
pub(crate) fn approach<S: Space>(bodies: [&Collider<S>; 2], motions: [Option<S::Motion>; 2]) -> f32 {
    let mut most = S::drift(motions);
    for (body, motion) in bodies.into_iter().zip(motions) {
        let turn_speed = motion.map_or(0.0, |motion| S::turn_speed(&motion, &body.pose));
        most += swing(turn_speed, turn_speed, S::arm(&body.shape));
    }
    rounded_up(most).min(tolerance::MAX_RADIUS)
}

/// How far a point within `reach` may move by turning, in metres: `share` of the reach, and at most twice the reach.
fn swing(turn_speed: f64, share: f64, reach: f64) -> f64 {
    // Without turning it is zero, even if the reach is infinite.
    if turn_speed > 0.0 { share.min(2.0) * reach } else { 0.0 }
}

fn rounded_up(metres: f64) -> f32 {
    let rounded = metres as f32;
    if f64::from(rounded) < metres { rounded.next_up() } else { rounded }
}
