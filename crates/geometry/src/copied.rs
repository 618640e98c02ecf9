//! `Clone` implementations that reuse the memory of the target.

/// Implements `Clone` for a type, field by field. Listed first are the fields to copy, reusing the target's memory
/// (which derived clones do not); after `but`, those that are not copied, since no output depends on them. All fields
/// must be listed, so that none is forgotten.
///
/// The form `from => to` copies one value over another of the same type by other means than `Clone`.
#[doc(hidden)]
#[macro_export]
macro_rules! copied {
    ($type:ty, $(for [$($bounds:tt)*],)? { $($(#[$meta:meta])? $copied:ident),* } but { $($own:ident),* }) => {
        impl$(<$($bounds)*>)? Clone for $type {
            fn clone(&self) -> Self {
                Self {
                    $($(#[$meta])? $copied: self.$copied.clone(),)*
                    $($own: Default::default(),)*
                }
            }

            fn clone_from(&mut self, source: &Self) {
                $crate::copied!(source => self, of Self { $($(#[$meta])? $copied),* } but { $($own),* });
            }
        }
    };
    ($from:expr => $to:expr, of $type:ident
        { $($(#[$meta:meta])? $copied:ident),* } but { $($(#[$own_meta:meta])? $own:ident),* }) => {
        let $type { $($(#[$meta])? $copied,)* $($(#[$own_meta])? $own: _,)* } = $from;
        $($(#[$meta])? $to.$copied.clone_from($copied);)*
    };
}
