//! Codes of the language: `E01xx` reading the file, `E02xx` its meaning.

use super::CodeInfo;

pub(super) const CODES: &[CodeInfo] = &[];
