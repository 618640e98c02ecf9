//! What poses, rays and shapes look like to serde.
//!
//! Every type has a plain form: numbers and lists, named as the type's own readers are. What is stored is the form
//! made of a value; what is loaded is a form, from which the value is made by the type's constructor, so that
//! nothing comes in that could not have been made here, and by the same bits. Whatever can be worked out is not stored.
//! One exception: the faces of a hull, which a flat face may be several of.
//!
//! Numbers keep every bit in any binary format. Of text formats, serde_json reads floats to the last bit only with
//! its feature
//! `float_roundtrip`.

mod plane;
mod space;

use core::fmt::Display;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// The plain twin of a type: what is stored of it.
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

/// Serde's two traits for each type, by way of its form.
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

/// What an error says, where a type has errors of several kinds.
fn said(error: impl Display) -> String {
    error.to_string()
}
