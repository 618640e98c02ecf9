//! Snapshots: a whole world as plain data, and back.
//!
//! ```text
//! kept      bodies with their slots, versions and the order in which empty slots are filled again; shared shapes, once
//!           each; which bodies moved or changed since the last update, and how far they moved; motions; candidates
//!           with hints, persistent manifolds and how long they stay apart; contacts; events; impacts; counts
//! derived   boxes, filters, the contacts of each body: functions of the bodies, their motions and contacts
//! dropped   the memory of the broad phase, whose pairs depend on the boxes alone, and of the queries; scratch; times
//! ```
//! The world and its bodies are destructured field by field, without `..`: a field that is added must be sorted into
//! one of these rows before this compiles again.

mod body;
mod content;
mod digest;
mod error;
mod pairs;
mod restore;
mod shapes;
mod slots;

pub use error::SnapshotError;

use crate::space::{Plane, Volume};
use crate::world::World;
use content::Content;
use serde::{Deserialize, Serialize};
use shapes::Saved;

/// The complete state of a world, on which its future and its current outputs depend; use it as [`Snapshot2`] or
/// [`Snapshot3`].
///
/// It is made for save games and for sending a world to a player who joins. To roll back some frames, keep clones of
/// the world: that is many times faster, and a clone has an equal future too.
///
/// ```
/// use asunder::{Collider3, Cuboid, Pose3, Snapshot3, World3, glam::Vec3};
/// let mut world = World3::new();
/// let unit = Cuboid::from_half_extents(Vec3::ONE)?;
/// let a = world.insert(Collider3::new(unit));
/// let b = world.insert(Collider3::new(unit).at(Pose3::at([1.5, 0.0, 0.0])?));
/// world.update();
///
/// let text = serde_json::to_string(&world.snapshot())?;
/// let loaded: Snapshot3 = serde_json::from_str(&text)?;
/// let mut restored = World3::restore(&loaded)?;
/// assert!(restored.is_touching(a, b) && restored.events() == world.events());
///
/// for world in [&mut world, &mut restored] {
///     world.set_pose(b, Pose3::at([1.25, 0.5, 0.0])?)?;
///     world.update();
/// }
/// assert_eq!(world.contact(a, b), restored.contact(a, b), "equal futures, bit for bit");
/// assert_eq!(world.snapshot().checksum(), restored.snapshot().checksum());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Formats
/// Any binary format for serde keeps all numbers, and so does RON. serde_json does with its feature `float_roundtrip`;
/// without it [`World::restore`] returns [`SnapshotError::Checksum`]. JSON has no infinity and no NaN: if a contact hook
/// leaves one in a manifold, the text cannot be loaded.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(bound = "", deny_unknown_fields)]
pub struct Snapshot<S: Saved> {
    content: Content<S>,
    checksum: u64,
}

/// A snapshot of a world in the plane.
pub type Snapshot2 = Snapshot<Plane>;

/// A snapshot of a world in space.
pub type Snapshot3 = Snapshot<Volume>;

impl<S: Saved> Snapshot<S> {
    /// A checksum of every bit of the snapshot. Worlds that went through equal operations have equal checksums, on any
    /// machine: two peers that compare them every now and then detect when they diverge. It is no protection against
    /// forgery.
    pub fn checksum(&self) -> u64 {
        self.checksum
    }
}

impl<S: Saved> World<S> {
    /// Everything on which the world's future depends, as data for serde: see [`Snapshot`]. Shapes that bodies share,
    /// and equal ones, are stored once.
    ///
    /// Cost: a copy of all bodies and contacts, and a pass over all their numbers.
    pub fn snapshot(&self) -> Snapshot<S> {
        S::save(self)
    }

    /// Restores the world of a snapshot: equal keys, contacts and events, and an equal future, including the keys of
    /// new bodies. Bodies that shared a hull, polygon or compound, or had equal ones, share it afterwards.
    ///
    /// Cost: that of a first update without the narrow phase, and a check of every hull.
    ///
    /// # Errors
    /// Data that no snapshot has.
    /// - A damaged file is rejected.
    /// - A forged file with a matching checksum is rejected or gives a world that works; but that world may treat
    ///   overlapping bodies as apart until they have moved as far as the file states.
    pub fn restore(snapshot: &Snapshot<S>) -> Result<Self, SnapshotError> {
        S::restore(snapshot)
    }
}

/// Implements [`World::snapshot`].
fn save<S: Saved>(world: &World<S>) -> Snapshot<S> {
    let content = Content::of(world);
    let checksum = digest::digest(&content);
    Snapshot { content, checksum }
}

/// Implements [`World::restore`].
fn restore<S: Saved>(snapshot: &Snapshot<S>) -> Result<World<S>, SnapshotError> {
    let Snapshot { content, checksum } = snapshot;
    let world = restore::world_of(content)?;
    let found = digest::digest(content);
    if found != *checksum {
        return Err(SnapshotError::Checksum { stored: *checksum, found });
    }
    Ok(world)
}
