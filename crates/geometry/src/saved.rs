//! The serde forms of poses, rays and shapes.
//!
//! Every type has a plain form: numbers and lists, named like the type's getters. A value is stored as its form. When
//! loaded, the form goes through the type's constructor, so that no value comes in that could not have been made here,
//! and it has the same bits. Derived data are not stored, except for the faces of a hull, as merging cannot be repeated
//! from the vertices alone.
//!
//! Numbers keep every bit in any binary format. Among text formats, serde_json reads floats to the last bit only with
//! its feature `float_roundtrip`.

mod plane;
mod space;

use core::fmt::Display;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// The plain form of a type, which is stored.
trait Form: Sized {
    type Of;
    type Error: Display;
    fn of(value: &Self::Of) -> Self;
    fn build(self) -> Result<Self::Of, Self::Error>;
}

fn store<F: Form + Serialize, S: Serializer>(value: &F::Of, serializer: S) -> Result<S::Ok, S::Error> {
    F::of(value).serialize(serializer)
}

fn load<'de, F: Form + Deserialize<'de>, D: Deserializer<'de>>(deserializer: D) -> Result<F::Of, D::Error> {
    F::deserialize(deserializer)?.build().map_err(D::Error::custom)
}

/// Implements serde's two traits for each type through its form.
macro_rules! stored_as {
    ($($type:ty: $form:ty,)*) => {$(
        impl serde::Serialize for $type {
            fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                super::store::<$form, S>(self, serializer)
            }
        }

        impl<'de> serde::Deserialize<'de> for $type {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                super::load::<$form, D>(deserializer)
            }
        }
    )*};
}
use stored_as;

/// The text of an error, for types with several kinds of errors.
fn said(error: impl Display) -> String {
    error.to_string()
}
