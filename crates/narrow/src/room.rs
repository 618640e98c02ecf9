//! Where the manifolds of a pair go: they are large, and written in place.

use crate::answer::Manifold3;
use crate::polyhedron::cuboids::queries::Contact;

/// Where manifolds go.
pub(crate) trait Room {
    fn is_wanted(&self) -> bool;

    /// A blank place for a manifold of this separation, unless that is not wanted.
    fn room(&mut self, separation: f32) -> Option<&mut Manifold3>;
}

/// All manifolds, or none.
impl Room for Option<&mut Vec<Manifold3>> {
    fn is_wanted(&self) -> bool {
        self.is_some()
    }

    fn room(&mut self, _: f32) -> Option<&mut Manifold3> {
        let manifolds = self.as_mut()?;
        manifolds.push(Manifold3::BLANK);
        manifolds.last_mut()
    }
}

/// The deepest manifold; of equals, the first.
pub(crate) struct Deepest(pub(crate) Option<Manifold3>);

impl Room for Deepest {
    fn is_wanted(&self) -> bool {
        true
    }

    fn room(&mut self, separation: f32) -> Option<&mut Manifold3> {
        let is_deeper = self.0.as_ref().is_none_or(|known| separation < known.separation);
        is_deeper.then(|| self.0.insert(Manifold3::BLANK))
    }
}

/// Asks for a contact whose manifold is written in place, at the end of the list.
#[inline(always)]
pub(crate) fn in_place(
    manifolds: &mut Vec<Manifold3>,
    run: impl FnOnce(Option<&mut Manifold3>) -> Contact,
) -> Contact {
    manifolds.push(Manifold3::BLANK);
    let contact = run(manifolds.last_mut());
    if matches!(contact, Contact::Apart(..) | Contact::Unclear(_)) {
        manifolds.pop();
    }
    contact
}
