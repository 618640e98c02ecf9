//! What the viewer must know of a dimension. The plane is seen as space without depth.

mod plane;
mod volume;

use crate::batch::Frame;
use crate::form::Form;
use crate::paint::Paint;
use asunder::glam::DVec3;
use asunder::{Collider, DebugLine, DebugOptions, Tier, World};
use asunder_examples::playable::Playable;

/// A dimension that can be looked at.
pub(crate) trait Sight: Playable {
    /// Whether it is seen from straight above, without perspective.
    const FLAT: bool;

    /// What is left of a vector of space.
    fn within(v: DVec3) -> DVec3;
    /// Where a body is.
    fn position(body: &Collider<Self>) -> DVec3;
    /// Where a body is, seen from a point.
    fn frame(body: &Collider<Self>, from: DVec3) -> Frame;
    /// The middle of a ball around a body, in the world, and its radius: infinite for what has no end.
    fn ball(body: &Collider<Self>) -> (DVec3, f64);
    /// Two corners of the box around a body.
    fn corners(body: &Collider<Self>) -> (DVec3, DVec3);
    /// Equal for shapes that look the same; nothing for those that are too many-sided to tell.
    fn likeness(body: &Collider<Self>) -> Option<[u64; 3]>;
    /// Triangles. What has no end is shown so far.
    fn form(body: &Collider<Self>, endless: f64) -> Form;
    /// A colour for bodies of this kind.
    fn paint(body: &Collider<Self>) -> Paint;
    /// The engine's own lines.
    fn lines(world: &World<Self>, options: &DebugOptions, line: &mut impl FnMut(DVec3, DVec3, DebugLine));
    /// Each contact's pair, by what it was settled whether they touch, and where its points are.
    fn tiers(world: &World<Self>, tell: impl FnMut([Self::Key; 2], Tier, &mut dyn Iterator<Item = DVec3>));
    /// What is seen first along a ray, but for what is hidden, and where.
    fn pick(
        world: &World<Self>,
        from: DVec3,
        direction: DVec3,
        hidden: &[Self::Key],
    ) -> Option<(Self::Key, DVec3)>;
    /// Scenery between two points; nothing in the plane, where nothing hides anything.
    fn between(world: &World<Self>, from: DVec3, to: DVec3, found: &mut Vec<Self::Key>);
}
