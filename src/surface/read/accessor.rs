//! Numbers out of glTF buffers, with every size checked against the bytes that are
//! there before anything is read or allocated. Sparse accessors (glTF 2.0, 3.6.2.3) are
//! a base, all zeros if it has no data, with some elements replaced.

use super::gltf::GltfError;
use gltf::Accessor;
use gltf::accessor::{DataType, Dimensions};
use gltf::buffer::View;

/// Where accessors find their bytes.
pub(super) struct Bytes<'a> {
    /// The content of each buffer.
    pub buffer: &'a dyn Fn(usize) -> Option<&'a [u8]>,
    /// Bytes of the whole file: the most elements that an accessor without data of its
    /// own may have.
    pub size: usize,
}

/// Positions: three floats, or three small integers as KHR_mesh_quantization allows.
pub(super) fn positions(accessor: &Accessor, bytes: &Bytes) -> Result<Vec<[f64; 3]>, GltfError> {
    let wrong = |problem| GltfError::Accessor { index: accessor.index(), problem };
    if accessor.dimensions() != Dimensions::Vec3 {
        return Err(wrong("holds positions, but not three numbers each"));
    }
    let (normalized, kind) = (accessor.normalized(), accessor.data_type());
    // Normalized integers stand for 0..1, or -1..1 with both lowest values at -1.
    let share = |value: f64, most: f64| {
        if normalized { (value / most).max(-1.0) } else { value }
    };
    let number = move |b: &[u8]| match (kind, b) {
        (DataType::F32, &[a, b, c, d]) => Some(f64::from(f32::from_le_bytes([a, b, c, d]))),
        (DataType::I8, &[a]) => Some(share(f64::from(a as i8), 127.0)),
        (DataType::U8, &[a]) => Some(share(f64::from(a), 255.0)),
        (DataType::I16, &[a, b]) => Some(share(f64::from(i16::from_le_bytes([a, b])), 32767.0)),
        (DataType::U16, &[a, b]) => Some(share(f64::from(u16::from_le_bytes([a, b])), 65535.0)),
        _ => None,
    };
    let size = kind.size();
    let position = |e: &[u8]| {
        let c = |k: usize| number(&e[k * size..(k + 1) * size]);
        Some([c(0)?, c(1)?, c(2)?])
    };
    let positions = elements(accessor, bytes, [0.0; 3], position)?;
    positions.ok_or_else(|| wrong("holds positions of an unsuited type"))
}

/// Indices: unsigned bytes, shorts or ints.
pub(super) fn indices(accessor: &Accessor, bytes: &Bytes) -> Result<Vec<u32>, GltfError> {
    let wrong = |problem| GltfError::Accessor { index: accessor.index(), problem };
    if accessor.dimensions() != Dimensions::Scalar {
        return Err(wrong("holds indices, but not one number each"));
    }
    let kind = accessor.data_type();
    let index = |e: &[u8]| match kind {
        DataType::U8 | DataType::U16 | DataType::U32 => unsigned(e),
        _ => None,
    };
    let indices = elements(accessor, bytes, 0, index)?;
    indices.ok_or_else(|| wrong("holds indices of an unsuited type"))
}

/// An unsigned number of one, two or four bytes.
fn unsigned(bytes: &[u8]) -> Option<u32> {
    match *bytes {
        [a] => Some(u32::from(a)),
        [a, b] => Some(u32::from(u16::from_le_bytes([a, b]))),
        [a, b, c, d] => Some(u32::from_le_bytes([a, b, c, d])),
        _ => None,
    }
}

/// All elements through `decode`, `None` if it takes none of this type.
fn elements<T: Clone>(
    accessor: &Accessor,
    bytes: &Bytes,
    zero: T,
    decode: impl Fn(&[u8]) -> Option<T>,
) -> Result<Option<Vec<T>>, GltfError> {
    let wrong = |problem| GltfError::Accessor { index: accessor.index(), problem };
    let (size, count) = (accessor.size(), accessor.count());
    let base: Option<Vec<T>> = match accessor.view() {
        Some(view) => {
            let stride = view.stride().unwrap_or(size);
            let at = Table { view, offset: accessor.offset(), stride, size, count };
            at.rows(bytes).map_err(wrong)?.map(&decode).collect()
        }
        None if accessor.sparse().is_none() => return Err(wrong("has no data")),
        None if count > bytes.size => return Err(wrong("has more elements than the file bytes")),
        None => Some(vec![zero; count]),
    };
    let Some(sparse) = accessor.sparse() else { return Ok(base) };
    let Some(mut base) = base else { return Ok(None) };
    let (indices, values) = (sparse.indices(), sparse.values());
    let index_size = indices.index_type().size();
    let packed =
        |view, offset, size| Table { view, offset, stride: size, size, count: sparse.count() };
    let places = packed(indices.view(), indices.offset(), index_size).rows(bytes).map_err(wrong)?;
    let values = packed(values.view(), values.offset(), size).rows(bytes).map_err(wrong)?;
    for (place, value) in places.zip(values) {
        let place = unsigned(place).and_then(|i| base.get_mut(i as usize));
        let place = place.ok_or_else(|| wrong("replaces an element that it does not have"))?;
        let Some(value) = decode(value) else { return Ok(None) };
        *place = value;
    }
    Ok(Some(base))
}

/// Elements of one size in a view.
struct Table<'d> {
    view: View<'d>,
    offset: usize,
    stride: usize,
    size: usize,
    count: usize,
}

impl Table<'_> {
    /// The bytes of each element, or what is wrong.
    fn rows<'a>(
        &self,
        bytes: &Bytes<'a>,
    ) -> Result<impl Iterator<Item = &'a [u8]> + use<'a>, &'static str> {
        let &Self { ref view, offset, stride, size, count } = self;
        let buffer = (bytes.buffer)(view.buffer().index()).ok_or("lies in a missing buffer")?;
        let view_end = view.offset().checked_add(view.length());
        let view_bytes = view_end
            .and_then(|end| buffer.get(view.offset()..end))
            .ok_or("lies in a view that reaches past its buffer")?;
        if stride < size {
            return Err("overlaps itself");
        }
        // The last element need not be followed by a whole stride.
        let length = match count.checked_sub(1) {
            Some(last) => last.checked_mul(stride).and_then(|l| l.checked_add(size)),
            None => Some(0),
        };
        let taken = length
            .and_then(|l| offset.checked_add(l))
            .and_then(|end| view_bytes.get(offset..end))
            .ok_or("reaches past its view")?;
        Ok((0..count).map(move |i| &taken[i * stride..i * stride + size]))
    }
}
