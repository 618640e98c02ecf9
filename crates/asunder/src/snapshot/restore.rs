//! From plain data to a world: everything that can be checked is checked.

use super::content::{Content, FORMAT, SlotForm};
use super::error::SnapshotError;
use super::pairs::Judge;
use super::shapes::{Revived, Saved};
use super::slots::slot_map;
use crate::collider::{Collider, Tag};
use crate::hooks::Edited;
use crate::motion::{Motions, swept_bounds};
use crate::odometer::Odometer;
use crate::query::Boxes;
use crate::records::{Candidates, Records};
use crate::slab::Slab;
use crate::world::World;
use asunder_geometry::Bounds;
use asunder_narrow::Batch;
use slotmap::Key;

/// The world, if the data are valid. Memory and time are linear in the data.
pub(super) fn world_of<S: Saved>(content: &Content<S>) -> Result<World<S>, SnapshotError> {
    let Content {
        format,
        shapes,
        slots,
        free,
        dirty,
        moved,
        reshaped,
        motions,
        odometers,
        max_pairs,
        candidates,
        contacts,
        edited,
        events,
        impacts,
        counts,
    } = content;
    if *format != FORMAT {
        return Err(SnapshotError::Format { found: *format });
    }
    check_slots(slots, free)?;
    let is_dirty = flags("changed bodies", dirty, slots.len())?;
    let is_moved = flags("moved bodies", moved, slots.len())?;
    flags("reshaped bodies", reshaped, slots.len())?;
    check_motions(motions, slots)?;
    let judge = Judge { slots };
    judge.events(events)?;
    judge.impacts(impacts)?;
    let (mut candidates, persistent) = judge.candidates(candidates)?;
    let odometers = revived_odometers(odometers, slots.len())?;
    let (records, manifolds) = judge.records(contacts, &mut candidates)?;
    if let Some(index) = edited.as_ref().map(Vec::len).filter(|&lists| lists != records.len()) {
        return Err(SnapshotError::Contact { index });
    }
    let mut by_second: Vec<u32> = (0..records.len() as u32).collect();
    by_second.sort_unstable_by_key(|&index| (records[index as usize].pair.b, index));
    let revived = revived(&Revived::of(shapes)?, slots)?;
    let motions = Motions::of_list(motions);
    let Derived { keys, boxes, tags } = Derived::of(slots, &revived, &motions);
    let versions = slots.iter().map(|slot| slot.version);
    let bodies = slot_map(versions.zip(revived).collect(), free)
        .map_err(|_| SnapshotError::Slot { slot: slots.len() })?;
    Ok(World {
        bodies,
        keys,
        boxes,
        tags,
        dirty: dirty.clone(),
        is_dirty,
        moved: moved.clone(),
        is_moved,
        reshaped: reshaped.clone(),
        motions,
        max_pairs: usize::try_from(*max_pairs).unwrap_or(usize::MAX),
        candidates: Candidates::of(&candidates),
        records: Records::of(&records),
        answered: vec![Batch { answers: Vec::new(), manifolds }],
        persistent: Slab::of(persistent),
        odometers,
        edited: edited.as_deref().map(Edited::of_lists),
        questions: Boxes::default(),
        events: events.clone(),
        impacts: impacts.clone(),
        by_second,
        stats: counts.stats(),
        scratch: World::new().scratch,
    })
}

/// Odometers by slot; slots that are not named count as changed. Slot 0 is never used.
fn revived_odometers(list: &[(u32, f64, f64)], slots: usize) -> Result<Vec<Odometer>, SnapshotError> {
    let named: Vec<u32> = list.iter().map(|&(slot, ..)| slot).collect();
    flags("odometers", &named, slots)?;
    let mut odometers = vec![Odometer::CHANGED; slots + 1];
    for &(slot, travel, step) in list {
        let odometer = odometers.get_mut(slot as usize).zip(Odometer::restored(travel, step));
        let (odometer, restored) = odometer.ok_or(SnapshotError::Slot { slot: slot as usize })?;
        *odometer = restored;
    }
    Ok(odometers)
}

/// The greatest version of a slot: above it versions would soon wrap around to 1, and old keys would look like future
/// ones. A slot gets there when it has been filled two thousand million times.
const MOST_VERSION: u32 = u32::MAX - (1 << 16);

/// Versions are odd, as in keys, and the list of empty slots names each of them once.
fn check_slots<S: Saved>(slots: &[SlotForm<S>], free: &[u32]) -> Result<(), SnapshotError> {
    let is_none = |slot: &SlotForm<S>| slot.version.is_multiple_of(2) || slot.version > MOST_VERSION;
    if let Some(none) = slots.iter().position(is_none) {
        return Err(SnapshotError::Slot { slot: none + 1 });
    }
    let mut is_open: Vec<bool> = slots.iter().map(|slot| slot.body.is_none()).collect();
    for &slot in free {
        match is_open.get_mut((slot as usize).wrapping_sub(1)) {
            Some(is_open) if *is_open => *is_open = false,
            _ => return Err(SnapshotError::Free),
        }
    }
    if is_open.contains(&true) { Err(SnapshotError::Free) } else { Ok(()) }
}

/// A list of slots, which must be ascending, as one flag per slot.
fn flags(list: &'static str, named: &[u32], slots: usize) -> Result<Vec<bool>, SnapshotError> {
    let mut flags = vec![false; with_slot_zero(slots)];
    let mut last = 0;
    for (index, &slot) in named.iter().enumerate() {
        let is_next = slot > last;
        match flags.get_mut(slot as usize) {
            Some(flag) if is_next => (*flag, last) = (true, slot),
            _ => return Err(SnapshotError::Order { list, index }),
        }
    }
    Ok(flags)
}

/// Only a body has a motion: a new one must not find one in its slot.
fn check_motions<S: Saved>(
    motions: &[(u32, Option<S::Motion>)],
    slots: &[SlotForm<S>],
) -> Result<(), SnapshotError> {
    let list = "motions";
    let named: Vec<u32> = motions.iter().map(|&(slot, _)| slot).collect();
    flags(list, &named, slots.len())?;
    let has_body =
        |slot: u32| slots.get((slot as usize).wrapping_sub(1)).is_some_and(|slot| slot.body.is_some());
    match motions.iter().position(|&(slot, motion)| motion.is_some() && !has_body(slot)) {
        Some(index) => Err(SnapshotError::Key { list, index }),
        None => Ok(()),
    }
}

/// The length of lists by slot: a world that never had a body has empty ones.
fn with_slot_zero(slots: usize) -> usize {
    if slots == 0 { 0 } else { slots + 1 }
}

/// The body in each slot.
fn revived<S: Saved>(
    shapes: &Revived<'_, S>,
    slots: &[SlotForm<S>],
) -> Result<Vec<Option<Collider<S>>>, SnapshotError> {
    let body = |(slot, form): (usize, &SlotForm<S>)| {
        let Some(body) = &form.body else { return Ok(None) };
        let refused = |reason: String| SnapshotError::Shape { index: slot, reason };
        let shape = shapes.shape(&body.shape).map_err(refused)?;
        body.body(shape).map(Some).map_err(|error| SnapshotError::Margin { slot, error })
    };
    (1..).zip(slots).map(body).collect()
}

/// The data that the world keeps for each slot besides the body, and that can be derived from it.
struct Derived<S: Saved> {
    keys: Vec<S::Key>,
    boxes: Vec<S::Aabb>,
    tags: Vec<Tag>,
}

impl<S: Saved> Derived<S> {
    fn of(slots: &[SlotForm<S>], bodies: &[Option<Collider<S>>], motions: &Motions<S>) -> Self {
        let count = with_slot_zero(slots.len());
        let mut derived = Self {
            keys: vec![S::Key::null(); count],
            boxes: vec![S::Aabb::NOTHING; count],
            tags: vec![Tag::default(); count],
        };
        for (slot, (form, body)) in (1..).zip(slots.iter().zip(bodies)) {
            let Some(body) = body else { continue };
            derived.keys[slot] = form.key(slot);
            derived.tags[slot] = Tag::of(body);
            if !body.disabled {
                // A motion is left over if a hook panicked, and then the next update does not make this box again.
                derived.boxes[slot] = match motions.of(slot as u32) {
                    Some(motion) => swept_bounds(body, &motion),
                    None => S::bounds(&body.shape, &body.pose, body.margin),
                };
            }
        }
        derived
    }
}
