//! A message: one text of the papers, with the values that it takes.
//!
//! The pages say what they mean with a struct for each message, so that no value is left
//! out or swapped, and a message that no page says any more does not compile. How it is put
//! stands in the files of texts.

use minijinja::Value;

/// A text with its values, ready to be put into words.
pub(in crate::sheets) trait Message {
    /// The file that holds the text.
    const FILE: &'static str;
    /// The key of the text in the file.
    const KEY: &'static str;

    /// The values by their names.
    fn values(self) -> Vec<(&'static str, Value)>;
}

/// What a value is, so that a text can be tried before there is a model.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(in crate::sheets) enum Kind {
    /// Words or a figure, printed as it is; may be empty.
    Words,
    /// A number of things, for plurals.
    Count,
    /// Whether something is so.
    Flag,
    /// Lines of words, none or some.
    List,
}

/// A type that values have.
pub(in crate::sheets) trait OfKind {
    /// What it is.
    const KIND: Kind;
}

impl OfKind for String {
    const KIND: Kind = Kind::Words;
}

impl OfKind for usize {
    const KIND: Kind = Kind::Count;
}

impl OfKind for Vec<String> {
    const KIND: Kind = Kind::List;
}

impl OfKind for bool {
    const KIND: Kind = Kind::Flag;
}

/// A message as the files of texts know it.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(in crate::sheets) struct Entry {
    /// Its key.
    pub key: &'static str,
    /// Names and kinds of its values.
    pub values: &'static [(&'static str, Kind)],
}

/// Declares the messages of a file of texts: a module with a struct for each of them, and
/// `ENTRIES` with all. The keys of the struct's fields are the values that the text may use.
macro_rules! messages {
    (
        mod $module:ident in $file:literal {
            $($key:literal => $name:ident { $($value:ident: $kind:ty),* $(,)? })*
        }
    ) => {
        #[doc = concat!("The messages of ", $file, ".")]
        // A message that no page says is an error: its text would be translated in vain.
        #[deny(dead_code)]
        pub(in crate::sheets) mod $module {
            use crate::sheets::text::message::{Entry, Message};

            $(
                #[doc = concat!("`", $key, "` of ", $file, ".")]
                #[derive(Default)]
                pub struct $name { $(pub $value: $kind),* }

                impl Message for $name {
                    const FILE: &'static str = $file;
                    const KEY: &'static str = $key;

                    fn values(self) -> Vec<(&'static str, minijinja::Value)> {
                        vec![$((stringify!($value), self.$value.into())),*]
                    }
                }
            )*

            /// All of them.
            pub const ENTRIES: &[Entry] = &[
                $(Entry {
                    key: $key,
                    values: &[$((stringify!($value), <$kind as crate::sheets::text::message::OfKind>::KIND)),*],
                }),*
            ];
        }
    };
}

pub(in crate::sheets) use messages;
