//! A checksum of every bit of some data, computed by a serializer, so that nothing that is stored can be left out.
//!
//! Multiply and rotate, as in FxHash; order matters, and so do lengths and signs of zero. Names do not.

use core::fmt::Display;
use serde::Serialize;
use serde::ser::{
    Error, SerializeMap, SerializeSeq, SerializeStruct, SerializeStructVariant, SerializeTuple,
    SerializeTupleStruct, SerializeTupleVariant, Serializer,
};

pub(super) fn digest(data: &impl Serialize) -> u64 {
    let mut digest = Digest(SEED);
    match data.serialize(&mut digest) {
        Ok(()) => digest.last(),
        Err(Never) => 0,
    }
}

struct Digest(u64);

/// Not zero, which zeros in the data would leave unchanged.
const SEED: u64 = 0x2545_F491_4F6C_DD1D;

impl Digest {
    fn word(&mut self, word: u64) -> Result<(), Never> {
        self.0 = (self.0.rotate_left(5) ^ word).wrapping_mul(0x517C_C1B7_2722_0A95);
        Ok(())
    }

    fn bytes(&mut self, bytes: &[u8]) -> Result<(), Never> {
        self.word(bytes.len() as u64)?;
        bytes.iter().try_for_each(|&byte| self.word(u64::from(byte)))
    }

    /// The low bits of a product depend on low bits alone, so the high ones are folded in.
    fn last(&self) -> u64 {
        let mixed = (self.0 ^ self.0 >> 32).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        mixed ^ mixed >> 29
    }
}

/// An error that cannot occur: our data always serialise.
#[derive(Debug)]
struct Never;

impl Display for Never {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "what cannot be serialised has no digest")
    }
}

impl core::error::Error for Never {}

impl Error for Never {
    fn custom<T: Display>(_: T) -> Self {
        Self
    }
}

macro_rules! words {
    ($($name:ident($type:ty) = $word:expr;)*) => {$(
        fn $name(self, value: $type) -> Result<(), Never> {
            let word: fn($type) -> u64 = $word;
            self.word(word(value))
        }
    )*};
}

impl Serializer for &mut Digest {
    type Ok = ();
    type Error = Never;
    type SerializeSeq = Self;
    type SerializeTuple = Self;
    type SerializeTupleStruct = Self;
    type SerializeTupleVariant = Self;
    type SerializeMap = Self;
    type SerializeStruct = Self;
    type SerializeStructVariant = Self;

    words! {
        serialize_bool(bool) = u64::from;
        serialize_i8(i8) = |value| value as u64;
        serialize_i16(i16) = |value| value as u64;
        serialize_i32(i32) = |value| value as u64;
        serialize_i64(i64) = |value| value as u64;
        serialize_u8(u8) = u64::from;
        serialize_u16(u16) = u64::from;
        serialize_u32(u32) = u64::from;
        serialize_u64(u64) = |value| value;
        serialize_f32(f32) = |value| u64::from(value.to_bits());
        serialize_f64(f64) = f64::to_bits;
        serialize_char(char) = u64::from;
    }

    fn serialize_str(self, text: &str) -> Result<(), Never> {
        self.bytes(text.as_bytes())
    }

    fn serialize_bytes(self, bytes: &[u8]) -> Result<(), Never> {
        self.bytes(bytes)
    }

    fn serialize_none(self) -> Result<(), Never> {
        self.word(0)
    }

    fn serialize_some<T: Serialize + ?Sized>(self, value: &T) -> Result<(), Never> {
        self.word(1)?;
        value.serialize(self)
    }

    fn serialize_unit(self) -> Result<(), Never> {
        self.word(0)
    }

    fn serialize_unit_struct(self, _: &'static str) -> Result<(), Never> {
        self.word(0)
    }

    fn serialize_unit_variant(self, _: &'static str, index: u32, _: &'static str) -> Result<(), Never> {
        self.word(u64::from(index))
    }

    fn serialize_newtype_struct<T: Serialize + ?Sized>(
        self,
        _: &'static str,
        value: &T,
    ) -> Result<(), Never> {
        value.serialize(self)
    }

    fn serialize_newtype_variant<T: Serialize + ?Sized>(
        self,
        _: &'static str,
        index: u32,
        _: &'static str,
        value: &T,
    ) -> Result<(), Never> {
        self.word(u64::from(index))?;
        value.serialize(self)
    }

    fn serialize_seq(self, length: Option<usize>) -> Result<Self, Never> {
        self.word(length.map_or(u64::MAX, |length| length as u64))?;
        Ok(self)
    }

    fn serialize_tuple(self, _: usize) -> Result<Self, Never> {
        Ok(self)
    }

    fn serialize_tuple_struct(self, _: &'static str, _: usize) -> Result<Self, Never> {
        Ok(self)
    }

    fn serialize_tuple_variant(
        self,
        _: &'static str,
        index: u32,
        _: &'static str,
        _: usize,
    ) -> Result<Self, Never> {
        self.word(u64::from(index))?;
        Ok(self)
    }

    fn serialize_map(self, length: Option<usize>) -> Result<Self, Never> {
        self.serialize_seq(length)
    }

    fn serialize_struct(self, _: &'static str, _: usize) -> Result<Self, Never> {
        Ok(self)
    }

    fn serialize_struct_variant(
        self,
        _: &'static str,
        index: u32,
        _: &'static str,
        _: usize,
    ) -> Result<Self, Never> {
        self.word(u64::from(index))?;
        Ok(self)
    }
}

/// Elements and fields alike: one after the other.
macro_rules! one_by_one {
    ($($trait:ident::$method:ident($($name:ty)?);)*) => {$(
        impl $trait for &mut Digest {
            type Ok = ();
            type Error = Never;

            fn $method<T: Serialize + ?Sized>(&mut self, $(_: $name,)? value: &T) -> Result<(), Never> {
                value.serialize(&mut **self)
            }

            fn end(self) -> Result<(), Never> {
                Ok(())
            }
        }
    )*};
}

one_by_one! {
    SerializeSeq::serialize_element();
    SerializeTuple::serialize_element();
    SerializeTupleStruct::serialize_field();
    SerializeTupleVariant::serialize_field();
    SerializeStruct::serialize_field(&'static str);
    SerializeStructVariant::serialize_field(&'static str);
}

impl SerializeMap for &mut Digest {
    type Ok = ();
    type Error = Never;

    fn serialize_key<T: Serialize + ?Sized>(&mut self, key: &T) -> Result<(), Never> {
        key.serialize(&mut **self)
    }

    fn serialize_value<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), Never> {
        value.serialize(&mut **self)
    }

    fn end(self) -> Result<(), Never> {
        Ok(())
    }
}
