//! Callbacks of a game during an update: they decide which bodies may pair, and edit contacts.
//!
//! A hook is given a result of the engine and may reject or edit it; it never sees a half-finished stage. Hooks are
//! called in pair order, and their answers are not kept for the next update: pairs that they rejected are found again,
//! and edits start again from the narrow phase's result.

use crate::collider::Collider;
use crate::contact::Record;
use crate::frame::manifolds_at;
use crate::space::{Plane, Space, Volume};
use crate::world::World;
use asunder_broad::PairId;
use core::fmt::Debug;

/// One of the two bodies of a pair that a hook is called for.
#[derive(Clone, Copy, Debug)]
pub struct Side<'a, S: Space> {
    /// The key of the body.
    pub key: S::Key,
    /// The body.
    pub body: &'a Collider<S>,
}

/// A body of a pair in the plane.
pub type Side2<'a> = Side<'a, Plane>;

/// A body of a pair in space.
pub type Side3<'a> = Side<'a, Volume>;

/// A contact that a hook may edit before the game reads it.
#[derive(Debug)]
pub struct Meeting<'a, S: Space> {
    /// The body in the lower slot; normals point away from it.
    pub a: Side<'a, S>,
    /// The other body.
    pub b: Side<'a, S>,
    /// Whether the bodies share a point now.
    pub overlapping: bool,
    /// Whether their `Began` is among this update's events.
    pub is_new: bool,
    /// Whether the bodies are beyond their margins, so that only a motion may bring them together.
    pub speculative: bool,
    /// The manifolds of the contact. Manifolds and points may be changed, removed and added; whether the two bodies
    /// touch is not affected, and neither are the events.
    pub manifolds: &'a mut Vec<S::Manifold>,
}

/// A contact in the plane that a hook may edit.
pub type Meeting2<'a> = Meeting<'a, Plane>;

/// A contact in space that a hook may edit.
pub type Meeting3<'a> = Meeting<'a, Volume>;

/// Called for every pair whose boxes overlap and whose layers and owners agree.
type Pairing<'a, S> = dyn Fn(Side<'_, S>, Side<'_, S>) -> bool + Sync + 'a;

/// Called for every contact that has manifolds.
type Editing<'a, S> = dyn Fn(Meeting<'_, S>) + Sync + 'a;

/// The hooks of one update: see [`World::update_with`].
///
/// ```
/// use asunder::{Collider2, Hooks2, Pose2, Rect, World2, glam::Vec2};
/// let mut world = World2::new();
/// let ledge = Rect::from_half_extents(Vec2::new(4.0, 0.5))?;
/// let ledge = world.insert(Collider2::new(ledge).fixed().user_data(1));
/// let player = Rect::from_half_extents(Vec2::new(0.4, 0.9))?;
/// let player = world.insert(Collider2::new(player).at(Pose2::at([0.0, -1.3])?));
///
/// // A ledge that can be jumped through from below: contacts that would push the player down count for nothing.
/// let is_ledge = |body: &Collider2| body.get_user_data() == 1;
/// let one_way = |meeting: asunder::Meeting2<'_>| {
///     let up = if is_ledge(meeting.a.body) { Vec2::Y } else { Vec2::NEG_Y };
///     meeting.manifolds.retain(|manifold| manifold.normal.dot(up) > 0.7);
/// };
/// world.update_with(&Hooks2::new().contact(&one_way));
/// assert!(world.is_touching(ledge, player), "touching is a fact");
/// assert!(world.contact(ledge, player).is_some_and(|contact| contact.manifolds.is_empty()));
///
/// let ghosts = |_: asunder::Side2<'_>, b: asunder::Side2<'_>| b.key != player;
/// world.update_with(&Hooks2::new().pair(&ghosts));
/// assert!(!world.is_touching(ledge, player));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy)]
pub struct Hooks<'a, S: Space> {
    pair: Option<&'a Pairing<'a, S>>,
    contact: Option<&'a Editing<'a, S>>,
}

/// The hooks of one update in the plane.
pub type Hooks2<'a> = Hooks<'a, Plane>;

/// The hooks of one update in space.
pub type Hooks3<'a> = Hooks<'a, Volume>;

impl<'a, S: Space> Hooks<'a, S> {
    /// No hooks.
    pub const fn new() -> Self {
        Self { pair: None, contact: None }
    }

    /// Sets the hook that decides whether two bodies may meet. It is called for every pair whose boxes overlap and
    /// whose layers, owners and so on agree.
    ///
    /// - A rejected pair is not a candidate: a contact that it had ends, and a bullet among the two does not run into
    ///   the other.
    /// - A rejected pair still counts towards [`World::set_max_pairs`], which limits the pairs before hooks are called.
    /// - If the hook panics and the game continues, candidates and contacts stay those of the update before, none of
    ///   them new; there are no events and no impacts, and motions are kept. The next update reports everything that
    ///   has begun and ended since.
    #[must_use]
    pub fn pair(mut self, may_meet: &'a (dyn Fn(Side<'_, S>, Side<'_, S>) -> bool + Sync)) -> Self {
        self.pair = Some(may_meet);
        self
    }

    /// Sets the hook that may edit contacts. It is called for every contact that has manifolds, including speculative
    /// ones, after the update's events have been written.
    ///
    /// - It is not called for impacts of bullets, which are not contacts: to let bullets through, reject the pair in
    ///   [`pair`](Self::pair).
    /// - A bullet counts as resting only on manifolds that the hook has kept: if it removes those of the floor, the
    ///   next tile may stop the bullet.
    /// - An update that finds more pairs than [`World::set_max_pairs`] allows does not call it: contacts stay as the
    ///   update before left them, with its edits.
    /// - If the hook panics and the game continues, contacts are as the narrow phase found them, there are no impacts,
    ///   and motions are kept for the next update.
    #[must_use]
    pub fn contact(mut self, edit: &'a (dyn Fn(Meeting<'_, S>) + Sync)) -> Self {
        self.contact = Some(edit);
        self
    }
}

impl<S: Space> Default for Hooks<'_, S> {
    fn default() -> Self {
        Self::new()
    }
}

impl<S: Space> Debug for Hooks<'_, S> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let mut hooks = f.debug_struct("Hooks");
        hooks.field("pair", &self.pair.is_some()).field("contact", &self.contact.is_some()).finish()
    }
}

/// The manifolds as a contact hook left them, and where those of each record end.
#[derive(Debug)]
pub(crate) struct Edited<S: Space> {
    manifolds: Vec<S::Manifold>,
    ends: Vec<u32>,
}

asunder_geometry::copied!(Edited<S>, for [S: Space], { manifolds, ends } but {});

impl<S: Space> Edited<S> {
    /// From one list per record.
    #[cfg(feature = "serde")]
    pub(crate) fn of_lists(lists: &[Vec<S::Manifold>]) -> Self {
        let mut edited = Self { manifolds: Vec::new(), ends: Vec::new() };
        for list in lists {
            edited.manifolds.extend_from_slice(list);
            edited.ends.push(edited.manifolds.len() as u32);
        }
        edited
    }

    /// How many manifolds there are.
    pub(crate) fn len(&self) -> usize {
        self.manifolds.len()
    }

    /// The manifolds of a record.
    pub(crate) fn of(&self, record: usize) -> &[S::Manifold] {
        let start = if record == 0 { 0 } else { self.ends[record - 1] };
        &self.manifolds[start as usize..self.ends[record] as usize]
    }
}

/// Removes the pairs that the hook rejects.
pub(crate) fn refuse_pairs<S: Space>(world: &mut World<S>, hooks: &Hooks<'_, S>) {
    let Some(may_meet) = hooks.pair else { return };
    let World { bodies, keys, records, scratch, .. } = world;
    // If the hook panics, contacts stay, and the events of the new ones were reported before.
    records.all_mut().for_each(|record| record.is_new = false);
    let side = |slot: u32| {
        let key = keys[slot as usize];
        bodies.get(key).map(|body| Side { key, body })
    };
    scratch.pairs.retain(|&PairId { a, b }| match (side(a), side(b)) {
        (Some(a), Some(b)) => may_meet(a, b),
        _ => false,
    });
}

/// Calls the hook for every contact with manifolds, on a copy of these.
pub(crate) fn edit_contacts<S: Space>(world: &mut World<S>, hooks: &Hooks<'_, S>) {
    if world.stats.overflow {
        world.stats.manifolds = world.edited.as_ref().map_or(world.stats.manifolds, Edited::len);
        return;
    }
    // A hook that panics leaves contacts as they were found.
    let last = world.edited.take();
    let Some(edit) = hooks.contact else { return };
    let World { bodies, records, answered, scratch, .. } = world;
    let mut edited = last.unwrap_or_else(|| Edited { manifolds: Vec::new(), ends: Vec::new() });
    edited.manifolds.clear();
    edited.ends.clear();
    for (number, record) in records.iter() {
        let Record { keys, manifolds: place, overlapping, is_new, speculative, .. } = record;
        // Numbers without a record get no manifolds.
        edited.ends.resize(number, edited.manifolds.len() as u32);
        let found = manifolds_at(place, answered);
        if let (false, Some(a), Some(b)) = (found.is_empty(), bodies.get(keys.0), bodies.get(keys.1)) {
            scratch.editing.clear();
            scratch.editing.extend_from_slice(found);
            edit(Meeting {
                a: Side { key: keys.0, body: a },
                b: Side { key: keys.1, body: b },
                overlapping: *overlapping,
                is_new: *is_new,
                speculative: *speculative,
                manifolds: &mut scratch.editing,
            });
            edited.manifolds.append(&mut scratch.editing);
        }
        edited.ends.push(edited.manifolds.len() as u32);
    }
    world.stats.manifolds = edited.len();
    world.edited = Some(edited);
}
