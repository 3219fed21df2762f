//! Bracketed values: sequences, structures, maps.

use super::{CanonError, Done, Encoder};
use serde::ser::{self, Serialize};

/// A bracketed value that is being written.
pub(super) struct Compound<'a, 'b> {
    encoder: &'b mut Encoder<'a>,
    close: u8,
    /// Number of elements so far.
    count: usize,
    /// Where the last map key lies in the output.
    last_key: Option<std::ops::Range<usize>>,
}

impl<'a, 'b> Compound<'a, 'b> {
    pub(super) fn open(encoder: &'b mut Encoder<'a>, open: u8, close: u8) -> Self {
        encoder.out.push(open);
        Self {
            encoder,
            close,
            count: 0,
            last_key: None,
        }
    }

    fn element<T: Serialize + ?Sized>(&mut self, value: &T) -> Done {
        let index = self.count;
        self.count += 1;
        value
            .serialize(&mut *self.encoder)
            .map_err(|error| error.inside(&format!("[{index}]")))
    }

    fn field<T: Serialize + ?Sized>(&mut self, name: &str, value: &T) -> Done {
        self.encoder.out.push(b'.');
        self.encoder.text(name.as_bytes());
        value
            .serialize(&mut *self.encoder)
            .map_err(|error| error.inside(name))
    }

    fn close(self) {
        self.encoder.out.push(self.close);
    }
}

macro_rules! sequence {
    ($($trait:ident :: $method:ident),*) => {$(
        impl ser::$trait for Compound<'_, '_> {
            type Ok = ();
            type Error = CanonError;

            fn $method<T: Serialize + ?Sized>(&mut self, value: &T) -> Done {
                self.element(value)
            }

            fn end(self) -> Done {
                self.close();
                Ok(())
            }
        }
    )*};
}

sequence!(
    SerializeSeq::serialize_element,
    SerializeTuple::serialize_element,
    SerializeTupleStruct::serialize_field,
    SerializeTupleVariant::serialize_field
);

macro_rules! fields {
    ($($trait:ident),*) => {$(
        impl ser::$trait for Compound<'_, '_> {
            type Ok = ();
            type Error = CanonError;

            fn serialize_field<T: Serialize + ?Sized>(
                &mut self,
                name: &'static str,
                value: &T,
            ) -> Done {
                self.field(name, value)
            }

            fn end(self) -> Done {
                self.close();
                Ok(())
            }
        }
    )*};
}

fields!(SerializeStruct, SerializeStructVariant);

impl ser::SerializeMap for Compound<'_, '_> {
    type Ok = ();
    type Error = CanonError;

    fn serialize_key<T: Serialize + ?Sized>(&mut self, key: &T) -> Done {
        let start = self.encoder.out.len();
        key.serialize(&mut *self.encoder)?;
        let here = start..self.encoder.out.len();
        let key = MapKey::read(&self.encoder.out[here.clone()])
            .ok_or_else(|| CanonError::new("a map key that is neither string nor integer"))?;
        if let Some(last) = self.last_key.take() {
            let last = MapKey::read(&self.encoder.out[last]);
            if last >= Some(key) {
                return Err(CanonError::new("map keys are not in ascending order"));
            }
        }
        self.last_key = Some(here);
        Ok(())
    }

    fn serialize_value<T: Serialize + ?Sized>(&mut self, value: &T) -> Done {
        let index = self.count;
        self.count += 1;
        value
            .serialize(&mut *self.encoder)
            .map_err(|error| error.inside(&format!("[{index}]")))
    }

    fn end(self) -> Done {
        self.close();
        Ok(())
    }
}

/// A map key in the order that ordered maps keep.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
enum MapKey<'a> {
    Unsigned(u64),
    Signed(i64),
    Text(&'a [u8]),
}

impl<'a> MapKey<'a> {
    fn read(encoded: &'a [u8]) -> Option<Self> {
        match encoded.split_first()? {
            (b'u', rest) => Some(Self::Unsigned(u64::from_le_bytes(rest.try_into().ok()?))),
            (b'i', rest) => Some(Self::Signed(i64::from_le_bytes(rest.try_into().ok()?))),
            (b's', rest) => Some(Self::Text(rest.get(8..)?)),
            _ => None,
        }
    }
}
