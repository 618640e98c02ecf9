//! What the viewer needs to know of a dimension. The plane is shown as space without depth.

mod plane;
mod volume;

use crate::batch::Frame;
use crate::form::Form;
use crate::paint::Paint;
use asunder::glam::DVec3;
use asunder::{Collider, DebugLine, DebugOptions, Tier, World};
use asunder_examples::playable::Playable;

/// A dimension that can be shown.
pub(crate) trait Sight: Playable {
    /// Whether it is shown from straight above, without perspective.
    const FLAT: bool;

    /// A vector of space, reduced to what the dimension has of it.
    fn within(v: DVec3) -> DVec3;
    /// The position of a body.
    fn position(body: &Collider<Self>) -> DVec3;
    /// The pose of a body, relative to a point.
    fn frame(body: &Collider<Self>, from: DVec3) -> Frame;
    /// The centre and radius of a ball around a body, in the world; the radius is infinite for an unbounded body.
    fn ball(body: &Collider<Self>) -> (DVec3, f64);
    /// Two opposite corners of the box around a body.
    fn corners(body: &Collider<Self>) -> (DVec3, DVec3);
    /// A key that is equal for shapes that look the same; `None` for shapes with too many corners for one.
    fn likeness(body: &Collider<Self>) -> Option<[u64; 3]>;
    /// The faces of a body; an unbounded one is shown up to `endless`.
    fn form(body: &Collider<Self>, endless: f64) -> Form;
    /// A colour for bodies of this kind.
    fn paint(body: &Collider<Self>) -> Paint;
    /// The engine's debug lines.
    fn lines(world: &World<Self>, options: &DebugOptions, line: &mut impl FnMut(DVec3, DVec3, DebugLine));
    /// For each contact: its pair, the tier that decided whether they touch, and where its points are.
    fn tiers(world: &World<Self>, tell: impl FnMut([Self::Key; 2], Tier, &mut dyn Iterator<Item = DVec3>));
    /// The first body along a ray that is not hidden, and the point where it is hit.
    fn pick(
        world: &World<Self>,
        from: DVec3,
        direction: DVec3,
        hidden: &[Self::Key],
    ) -> Option<(Self::Key, DVec3)>;
    /// The scenery between two points; none in the plane, where nothing hides anything.
    fn between(world: &World<Self>, from: DVec3, to: DVec3, found: &mut Vec<Self::Key>);
}
