use std::ffi::OsStr;
use std::marker::PhantomData;
use std::str::FromStr;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::error::ErrorKind;
use strum::VariantNames;

/// A parser for an enum with named variants. Help, completions and errors list the names.
pub(super) fn choice<T>() -> Choice<T> {
    Choice(PhantomData)
}

/// See [`choice`].
pub(super) struct Choice<T>(PhantomData<fn() -> T>);

impl<T> Clone for Choice<T> {
    fn clone(&self) -> Self {
        choice()
    }
}

impl<T: FromStr + VariantNames + Clone + Send + Sync + 'static> TypedValueParser for Choice<T> {
    type Value = T;

    fn parse_ref(&self, command: &clap::Command, arg: Option<&clap::Arg>, value: &OsStr) -> Result<T, clap::Error> {
        // Aliases are parsed too; only the canonical names are listed.
        if let Some(Ok(parsed)) = value.to_str().map(str::parse) {
            return Ok(parsed);
        }
        let listed = PossibleValuesParser::new(T::VARIANTS).parse_ref(command, arg, value);
        Err(listed.err().unwrap_or_else(|| clap::Error::new(ErrorKind::InvalidValue)))
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        Some(Box::new(T::VARIANTS.iter().map(PossibleValue::new)))
    }
}
