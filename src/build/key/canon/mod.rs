//! The canonical encoding of a stage's input: the bytes that enter its key.
//!
//! Any [`Serialize`] value has exactly one encoding, the same on every machine. It is
//! self-describing and prefix-free, so two values share an encoding only if they are the same
//! tree of named fields and values; [`recipe`](super::recipe) reads it back to say *which* field
//! differs. There is no decoder to values.
//!
//! | value | bytes |
//! |---|---|
//! | `false`, `true` | `F`, `T` |
//! | unsigned, signed integer of up to 64 bits | `u`, `i` and 8 bytes, little-endian |
//! | unsigned, signed integer of 128 bits | `v`, `j` and 16 bytes |
//! | `f64`, `f32` | `d` and 8 bytes, `f` and 4 bytes of its bits; -0.0 is 0.0; NaN is refused |
//! | `char` | `c` and 4 bytes |
//! | string, byte string | `s`, `b`, length (8 bytes), the bytes |
//! | `None`, `Some(x)`, `()` | `N`, `S` x, `U` |
//! | sequence, array, tuple | `[` elements `]` |
//! | struct | `{`, for each field `.` name x, `}`; a name is length (8 bytes) and UTF-8 |
//! | enum variant | `V` name, then `U` or x or `[`…`]` or `{`…`}` |
//! | map | `(` key x … `)`; keys are strings or integers in strictly ascending order |
//! | newtype struct | as what it wraps |
//!
//! Names of types and widths of integers do not enter: a type can be renamed, a `u32` become a
//! `u64`, and keys stay. Names of fields and variants do.
//!
//! Maps out of order are refused because their order would be an accident of the run; an ordered
//! map whose order matters belongs into a sequence of pairs. Hash sets cannot be told from
//! sequences here: inputs do not contain them.

mod compound;

use compound::Compound;
use serde::ser::{self, Serialize};
use std::fmt;

/// Appends the canonical encoding of `value` to `out`. On an error `out` holds a part of it.
pub fn encode<T: Serialize + ?Sized>(value: &T, out: &mut Vec<u8>) -> Result<(), CanonError> {
    value.serialize(&mut Encoder { out })
}

/// Why a value has no canonical encoding.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CanonError {
    /// Field names from the outermost inwards.
    path: Vec<String>,
    what: String,
}

impl CanonError {
    fn new(what: impl Into<String>) -> Self {
        Self {
            path: Vec::new(),
            what: what.into(),
        }
    }

    fn inside(mut self, field: &str) -> Self {
        self.path.insert(0, field.to_owned());
        self
    }
}

impl fmt::Display for CanonError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.path.is_empty() {
            f.write_str(&self.what)
        } else {
            write!(f, "`{}`: {}", self.path.join("."), self.what)
        }
    }
}

impl std::error::Error for CanonError {}

impl ser::Error for CanonError {
    fn custom<T: fmt::Display>(message: T) -> Self {
        Self::new(message.to_string())
    }
}

struct Encoder<'a> {
    out: &'a mut Vec<u8>,
}

impl Encoder<'_> {
    fn tagged(&mut self, tag: u8, bytes: &[u8]) {
        self.out.push(tag);
        self.out.extend_from_slice(bytes);
    }

    fn text(&mut self, bytes: &[u8]) {
        self.out
            .extend_from_slice(&(bytes.len() as u64).to_le_bytes());
        self.out.extend_from_slice(bytes);
    }

    fn variant(&mut self, name: &str) {
        self.out.push(b'V');
        self.text(name.as_bytes());
    }
}

type Done = Result<(), CanonError>;

impl<'a, 'b> ser::Serializer for &'b mut Encoder<'a> {
    type Ok = ();
    type Error = CanonError;
    type SerializeSeq = Compound<'a, 'b>;
    type SerializeTuple = Compound<'a, 'b>;
    type SerializeTupleStruct = Compound<'a, 'b>;
    type SerializeTupleVariant = Compound<'a, 'b>;
    type SerializeMap = Compound<'a, 'b>;
    type SerializeStruct = Compound<'a, 'b>;
    type SerializeStructVariant = Compound<'a, 'b>;

    fn is_human_readable(&self) -> bool {
        false
    }

    fn serialize_bool(self, v: bool) -> Done {
        self.out.push(if v { b'T' } else { b'F' });
        Ok(())
    }

    fn serialize_i8(self, v: i8) -> Done {
        self.serialize_i64(v.into())
    }

    fn serialize_i16(self, v: i16) -> Done {
        self.serialize_i64(v.into())
    }

    fn serialize_i32(self, v: i32) -> Done {
        self.serialize_i64(v.into())
    }

    fn serialize_i64(self, v: i64) -> Done {
        self.tagged(b'i', &v.to_le_bytes());
        Ok(())
    }

    fn serialize_i128(self, v: i128) -> Done {
        self.tagged(b'j', &v.to_le_bytes());
        Ok(())
    }

    fn serialize_u8(self, v: u8) -> Done {
        self.serialize_u64(v.into())
    }

    fn serialize_u16(self, v: u16) -> Done {
        self.serialize_u64(v.into())
    }

    fn serialize_u32(self, v: u32) -> Done {
        self.serialize_u64(v.into())
    }

    fn serialize_u64(self, v: u64) -> Done {
        self.tagged(b'u', &v.to_le_bytes());
        Ok(())
    }

    fn serialize_u128(self, v: u128) -> Done {
        self.tagged(b'v', &v.to_le_bytes());
        Ok(())
    }

    fn serialize_f32(self, v: f32) -> Done {
        if v.is_nan() {
            return Err(CanonError::new("not a number"));
        }
        self.tagged(b'f', &(v + 0.0).to_bits().to_le_bytes());
        Ok(())
    }

    fn serialize_f64(self, v: f64) -> Done {
        if v.is_nan() {
            return Err(CanonError::new("not a number"));
        }
        // -0.0 + 0.0 is 0.0; every other value is its own sum with 0.0.
        self.tagged(b'd', &(v + 0.0).to_bits().to_le_bytes());
        Ok(())
    }

    fn serialize_char(self, v: char) -> Done {
        self.tagged(b'c', &u32::from(v).to_le_bytes());
        Ok(())
    }

    fn serialize_str(self, v: &str) -> Done {
        self.out.push(b's');
        self.text(v.as_bytes());
        Ok(())
    }

    fn serialize_bytes(self, v: &[u8]) -> Done {
        self.out.push(b'b');
        self.text(v);
        Ok(())
    }

    fn serialize_none(self) -> Done {
        self.out.push(b'N');
        Ok(())
    }

    fn serialize_some<T: Serialize + ?Sized>(self, value: &T) -> Done {
        self.out.push(b'S');
        value.serialize(self)
    }

    fn serialize_unit(self) -> Done {
        self.out.push(b'U');
        Ok(())
    }

    fn serialize_unit_struct(self, _: &'static str) -> Done {
        self.serialize_unit()
    }

    fn serialize_unit_variant(self, _: &'static str, _: u32, variant: &'static str) -> Done {
        self.variant(variant);
        self.serialize_unit()
    }

    fn serialize_newtype_struct<T: Serialize + ?Sized>(self, _: &'static str, value: &T) -> Done {
        value.serialize(self)
    }

    fn serialize_newtype_variant<T: Serialize + ?Sized>(
        self,
        _: &'static str,
        _: u32,
        variant: &'static str,
        value: &T,
    ) -> Done {
        self.variant(variant);
        value.serialize(self).map_err(|error| error.inside(variant))
    }

    fn serialize_seq(self, _: Option<usize>) -> Result<Self::SerializeSeq, CanonError> {
        Ok(Compound::open(self, b'[', b']'))
    }

    fn serialize_tuple(self, _: usize) -> Result<Self::SerializeTuple, CanonError> {
        Ok(Compound::open(self, b'[', b']'))
    }

    fn serialize_tuple_struct(
        self,
        _: &'static str,
        _: usize,
    ) -> Result<Self::SerializeTupleStruct, CanonError> {
        Ok(Compound::open(self, b'[', b']'))
    }

    fn serialize_tuple_variant(
        self,
        _: &'static str,
        _: u32,
        variant: &'static str,
        _: usize,
    ) -> Result<Self::SerializeTupleVariant, CanonError> {
        self.variant(variant);
        Ok(Compound::open(self, b'[', b']'))
    }

    fn serialize_map(self, _: Option<usize>) -> Result<Self::SerializeMap, CanonError> {
        Ok(Compound::open(self, b'(', b')'))
    }

    fn serialize_struct(
        self,
        _: &'static str,
        _: usize,
    ) -> Result<Self::SerializeStruct, CanonError> {
        Ok(Compound::open(self, b'{', b'}'))
    }

    fn serialize_struct_variant(
        self,
        _: &'static str,
        _: u32,
        variant: &'static str,
        _: usize,
    ) -> Result<Self::SerializeStructVariant, CanonError> {
        self.variant(variant);
        Ok(Compound::open(self, b'{', b'}'))
    }
}
