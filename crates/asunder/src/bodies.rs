//! Inserting, removing and changing bodies; what depends on them is marked for the next update.

use crate::collider::{Collider, Tag};
use crate::odometer::Odometer;
use crate::space::Space;
use crate::world::{StaleKey, World, slot_of};
use asunder_geometry::Bounds;
use slotmap::Key;

impl<S: Space> World<S> {
    /// Removes every body. Contacts that had begun end at the next update.
    pub fn clear(&mut self) {
        self.bodies.clear();
        for slot in 0..self.keys.len() {
            if !core::mem::replace(&mut self.keys[slot], S::Key::null()).is_null() {
                self.motions.forget(slot as u32);
                self.mark_changed(slot as u32);
            }
        }
    }

    pub(crate) fn insert_body(&mut self, collider: Collider<S>) -> S::Key {
        let tag = Tag::of(&collider);
        let key = self.bodies.insert(collider);
        let slot = slot_of(key);
        let index = slot as usize;
        if index >= self.keys.len() {
            self.keys.resize(index + 1, S::Key::null());
            self.boxes.resize(index + 1, S::Aabb::NOTHING);
            self.tags.resize(index + 1, Tag::default());
            self.is_dirty.resize(index + 1, false);
            self.is_moved.resize(index + 1, false);
            self.odometers.resize(index + 1, Odometer::CHANGED);
        }
        self.keys[index] = key;
        self.tags[index] = tag;
        self.mark_changed(slot);
        key
    }

    pub(crate) fn remove_body(&mut self, key: S::Key) -> Option<Collider<S>> {
        let collider = self.bodies.remove(key)?;
        self.keys[slot_of(key) as usize] = S::Key::null();
        self.motions.forget(slot_of(key));
        self.mark_changed(slot_of(key));
        Some(collider)
    }

    /// Moves a body, which wakes it.
    pub(crate) fn move_body(&mut self, key: S::Key, pose: S::Pose) -> Result<(), StaleKey> {
        let body = self.bodies.get_mut(key).ok_or(StaleKey)?;
        if !S::same_bits(&body.pose, &pose) {
            self.odometers[slot_of(key) as usize].go(S::travel(&body.shape, &body.pose, &pose));
            body.pose = pose;
            body.asleep = false;
            self.mark_dirty(slot_of(key));
        }
        Ok(())
    }

    /// Gives a body another shape, and drops what is known from the old one. A body that becomes ground is fixed, and
    /// stays so.
    pub(crate) fn reshape_body(&mut self, key: S::Key, shape: S::Shape) -> Result<(), StaleKey> {
        let body = self.bodies.get_mut(key).ok_or(StaleKey)?;
        let is_reshaped = body.shape != shape;
        body.fixed |= S::is_ground(&shape);
        body.shape = shape;
        self.tags[slot_of(key) as usize] = Tag::of(body);
        if is_reshaped {
            self.note_reshaped(slot_of(key));
        }
        self.mark_changed(slot_of(key));
        Ok(())
    }

    /// Replaces the body, without a motion, and returns the old one.
    pub(crate) fn replace_body(
        &mut self,
        key: S::Key,
        collider: Collider<S>,
    ) -> Result<Collider<S>, StaleKey> {
        let body = self.bodies.get_mut(key).ok_or(StaleKey)?;
        let is_reshaped = body.shape != collider.shape;
        self.tags[slot_of(key) as usize] = Tag::of(&collider);
        let before = core::mem::replace(body, collider);
        if is_reshaped {
            self.note_reshaped(slot_of(key));
        }
        self.motions.forget(slot_of(key));
        self.mark_changed(slot_of(key));
        Ok(before)
    }

    fn note_reshaped(&mut self, slot: u32) {
        note_slot(&mut self.reshaped, slot, self.keys.len());
    }

    /// Changes properties other than shape and pose. All pairs of the body go through the narrow phase again, since
    /// whom it meets, and how, may have changed.
    pub(crate) fn change_body(
        &mut self,
        key: S::Key,
        change: impl FnOnce(&mut Collider<S>),
    ) -> Result<(), StaleKey> {
        let body = self.bodies.get_mut(key).ok_or(StaleKey)?;
        change(body);
        self.tags[slot_of(key) as usize] = Tag::of(body);
        self.mark_changed(slot_of(key));
        Ok(())
    }

    /// Sends a body to sleep, or wakes it. It does not count as changed: its contacts stay as they are.
    pub(crate) fn set_asleep(&mut self, key: S::Key, asleep: bool) -> Result<(), StaleKey> {
        self.bodies.get_mut(key).ok_or(StaleKey)?.asleep = asleep;
        Ok(())
    }

    /// Marks a body that changed other than by moving: all its pairs go through the narrow phase.
    pub(crate) fn mark_changed(&mut self, slot: u32) {
        self.odometers[slot as usize] = Odometer::CHANGED;
        self.mark_dirty(slot);
    }

    fn mark_dirty(&mut self, slot: u32) {
        self.questions.told(slot);
        if !core::mem::replace(&mut self.is_dirty[slot as usize], true) {
            self.dirty.push(slot);
        }
    }
}

/// Adds one of `slots` slots to a list, which may hold it already, without letting the list grow each time the same
/// slots are added before an update.
pub(crate) fn note_slot(list: &mut Vec<u32>, slot: u32, slots: usize) {
    if list.len() >= 2 * slots {
        list.sort_unstable();
        list.dedup();
    }
    list.push(slot);
}
