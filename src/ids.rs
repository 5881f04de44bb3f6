//! Typed indices, and vectors that are indexed by them.
//!
//! A bare `usize` does not say whether it counts rods or contacts. Each kind of
//! element has its own index type; [`IdVec`] takes only its own.

use std::fmt;
use std::marker::PhantomData;
use std::ops::{Deref, DerefMut, Index, IndexMut};

/// An index type: a number that knows what it counts.
pub trait Id: Copy + Eq + Ord + fmt::Debug {
    /// The index of position `i`, counted from zero.
    fn new(i: usize) -> Self;
    /// The position, counted from zero.
    fn index(self) -> usize;
}

macro_rules! id {
    ($(#[$doc:meta])* $name:ident, $prefix:literal, $width:literal) => {
        $(#[$doc])*
        #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
        pub struct $name(u32);

        impl Id for $name {
            fn new(i: usize) -> Self {
                Self(u32::try_from(i).expect("fewer than 2^32 elements: memory ends first"))
            }
            fn index(self) -> usize {
                self.0 as usize
            }
        }

        impl $name {
            /// The one of a number as it is printed; zeros in front may be left out.
            pub fn read(name: &str) -> Option<Self> {
                let (prefix, digits) = name.split_at_checked($prefix.len())?;
                // `parse` would take a sign.
                if !prefix.eq_ignore_ascii_case($prefix) || !digits.bytes().all(|b| b.is_ascii_digit()) {
                    return None;
                }
                let number: u32 = digits.parse().ok()?;
                number.checked_sub(1).map(Self)
            }
        }

        /// The number as printed, counted from one and filled with zeros.
        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.pad(&format!(concat!($prefix, "{:0", $width, "}"), u64::from(self.0) + 1))
            }
        }
    };
}

id!(
    /// A vertex of a mesh; printed as a number counted from 1, as mesh files do.
    VertexId, "", 1
);
id!(
    /// A face of a mesh; printed as a number counted from 1.
    FaceId, "", 1
);
id!(
    /// A tile of a tiling.
    TileId, "T", 3
);
id!(
    /// An edge of a tiling.
    TileEdgeId, "E", 3
);
id!(
    /// A rod, printed `R001`.
    RodId, "R", 3
);
id!(
    /// A contact, printed `C0001`.
    ContactId, "C", 4
);
id!(
    /// An RF-unit, printed `U001`.
    UnitId, "U", 3
);
id!(
    /// A prop that holds a rod up while the frame is put together, printed `P01`.
    PropId, "P", 2
);

/// A vector whose positions are of one index type.
#[derive(Clone, PartialEq, Debug)]
pub struct IdVec<I, T> {
    items: Vec<T>,
    kind: PhantomData<I>,
}

impl<I: Id, T> IdVec<I, T> {
    /// An empty vector.
    pub fn new() -> Self {
        Self::from(Vec::new())
    }

    /// Appends an element and returns its index.
    pub fn push(&mut self, item: T) -> I {
        self.items.push(item);
        I::new(self.items.len() - 1)
    }

    /// All indices in order.
    pub fn ids(&self) -> impl DoubleEndedIterator<Item = I> + ExactSizeIterator + use<I, T> {
        (0..self.items.len()).map(I::new)
    }

    /// Elements with their indices, in order.
    pub fn enumerate(&self) -> impl Iterator<Item = (I, &T)> {
        self.items.iter().enumerate().map(|(i, t)| (I::new(i), t))
    }
}

impl<I: Id, T> Default for IdVec<I, T> {
    fn default() -> Self {
        Self::new()
    }
}

impl<I, T> From<Vec<T>> for IdVec<I, T> {
    fn from(items: Vec<T>) -> Self {
        Self { items, kind: PhantomData }
    }
}

impl<I, T> FromIterator<T> for IdVec<I, T> {
    fn from_iter<S: IntoIterator<Item = T>>(iter: S) -> Self {
        Self::from(Vec::from_iter(iter))
    }
}

impl<I: Id, T> Index<I> for IdVec<I, T> {
    type Output = T;
    fn index(&self, i: I) -> &T {
        &self.items[i.index()]
    }
}

impl<I: Id, T> IndexMut<I> for IdVec<I, T> {
    fn index_mut(&mut self, i: I) -> &mut T {
        &mut self.items[i.index()]
    }
}

/// As a slice: length, iteration, sorting.
impl<I, T> Deref for IdVec<I, T> {
    type Target = [T];
    fn deref(&self) -> &[T] {
        &self.items
    }
}

impl<I, T> DerefMut for IdVec<I, T> {
    fn deref_mut(&mut self) -> &mut [T] {
        &mut self.items
    }
}

impl<'a, I, T> IntoIterator for &'a IdVec<I, T> {
    type Item = &'a T;
    type IntoIter = std::slice::Iter<'a, T>;
    fn into_iter(self) -> Self::IntoIter {
        self.items.iter()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_printed_from_one() {
        assert_eq!(RodId::new(0).to_string(), "R001");
        assert_eq!(ContactId::new(1233).to_string(), "C1234");
        assert_eq!(UnitId::new(1999).to_string(), "U2000");
        assert_eq!(VertexId::new(4).to_string(), "5");
    }

    #[test]
    fn printed_numbers_are_read_back() {
        for id in [0, 8, 998, 123_456].map(ContactId::new) {
            assert_eq!(ContactId::read(&id.to_string()), Some(id));
        }
        assert_eq!(RodId::read("r12"), Some(RodId::new(11)));
        for bad in ["", "R", "R0", "R000", "R+1", "C0001", "12", "R1x", "R99999999999", "Ä1"] {
            assert_eq!(RodId::read(bad), None, "{bad}");
        }
    }

    #[test]
    fn push_returns_the_index_that_reads_it_back() {
        let mut v: IdVec<RodId, &str> = IdVec::new();
        v.push("a");
        let b = v.push("b");
        assert_eq!(v[b], "b");
        assert_eq!(v.ids().collect::<Vec<_>>(), [RodId::new(0), b]);
    }
}
