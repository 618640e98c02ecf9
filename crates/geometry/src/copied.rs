//! Clones that are written over others.

/// Makes a type `Clone`, field by field: what is copied, in the memory that there is, as derived clones do not; and
/// what stays each one's own, since no output depends on it. All fields are named, so that none is forgotten.
///
/// Where one value is written over another of the same type by other means than `Clone`, `from => to` does the same.
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
