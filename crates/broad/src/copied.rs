//! Clones that are written over others.

/// Makes a type `Clone`, field by field: what is copied, in the memory that there is, as derived clones do not; and what stays
/// each one's own, since no output depends on it. All fields are named, so that none is forgotten.
macro_rules! copied {
    ($type:ty, $(for $bounds:ident,)? { $($(#[$meta:meta])? $copied:ident),* } but { $($own:ident),* }) => {
        impl$(<$bounds: asunder_geometry::Bounds>)? Clone for $type {
            fn clone(&self) -> Self {
                let mut copy = Self::default();
                copy.clone_from(self);
                copy
            }

            fn clone_from(&mut self, source: &Self) {
                let Self { $($(#[$meta])? $copied,)* $($own: _,)* } = source;
                $($(#[$meta])? self.$copied.clone_from($copied);)*
            }
        }
    };
}

pub(crate) use copied;
