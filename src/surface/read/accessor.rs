//! Numbers out of glTF buffers, with every size checked against the bytes that are
//! there before anything is read or allocated.

use super::gltf::GltfError;
use gltf::Accessor;
use gltf::accessor::{DataType, Dimensions};

/// Positions: three floats, or three small integers as KHR_mesh_quantization allows.
pub(super) fn positions<'a>(
    accessor: &Accessor,
    data: impl Fn(usize) -> Option<&'a [u8]>,
) -> Result<Vec<[f64; 3]>, GltfError> {
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
    let positions = elements(accessor, data)?.map(|e| {
        let c = |k: usize| number(&e[k * size..(k + 1) * size]);
        Some([c(0)?, c(1)?, c(2)?])
    });
    positions.collect::<Option<_>>().ok_or_else(|| wrong("holds positions of an unsuited type"))
}

/// Indices: unsigned bytes, shorts or ints.
pub(super) fn indices<'a>(
    accessor: &Accessor,
    data: impl Fn(usize) -> Option<&'a [u8]>,
) -> Result<Vec<u32>, GltfError> {
    let wrong = |problem| GltfError::Accessor { index: accessor.index(), problem };
    if accessor.dimensions() != Dimensions::Scalar {
        return Err(wrong("holds indices, but not one number each"));
    }
    let indices = elements(accessor, data)?.map(|e| match (accessor.data_type(), e) {
        (DataType::U8, &[a]) => Some(u32::from(a)),
        (DataType::U16, &[a, b]) => Some(u32::from(u16::from_le_bytes([a, b]))),
        (DataType::U32, &[a, b, c, d]) => Some(u32::from_le_bytes([a, b, c, d])),
        _ => None,
    });
    indices.collect::<Option<_>>().ok_or_else(|| wrong("holds indices of an unsuited type"))
}

/// The bytes of each element.
fn elements<'a>(
    accessor: &Accessor,
    data: impl Fn(usize) -> Option<&'a [u8]>,
) -> Result<impl Iterator<Item = &'a [u8]>, GltfError> {
    let wrong = |problem| GltfError::Accessor { index: accessor.index(), problem };
    if accessor.sparse().is_some() {
        return Err(wrong("is sparse, which is not read"));
    }
    let view = accessor.view().ok_or_else(|| wrong("has no data"))?;
    let buffer = data(view.buffer().index()).ok_or_else(|| wrong("lies in a missing buffer"))?;
    let view_end = view.offset().checked_add(view.length());
    let view_bytes = view_end
        .and_then(|end| buffer.get(view.offset()..end))
        .ok_or_else(|| wrong("lies in a view that reaches past its buffer"))?;
    let (size, count) = (accessor.size(), accessor.count());
    let stride = view.stride().unwrap_or(size);
    if stride < size {
        return Err(wrong("overlaps itself"));
    }
    // The last element need not be followed by a whole stride.
    let length = match count.checked_sub(1) {
        Some(last) => last.checked_mul(stride).and_then(|l| l.checked_add(size)),
        None => Some(0),
    };
    let bytes = length
        .and_then(|l| accessor.offset().checked_add(l))
        .and_then(|end| view_bytes.get(accessor.offset()..end))
        .ok_or_else(|| wrong("reaches past its view"))?;
    Ok((0..count).map(move |i| &bytes[i * stride..i * stride + size]))
}
