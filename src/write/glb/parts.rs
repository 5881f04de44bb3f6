//! The parts of a glTF document that hold geometry: buffers, views and accessors.

use gltf_json::accessor::{ComponentType, GenericComponentType, Type};
use gltf_json::buffer::{Stride, Target, View};
use gltf_json::validation::Checked::Valid;
use gltf_json::{Accessor, Buffer, Index};

/// A buffer's chunk is a multiple of four bytes long.
pub(super) fn pad(bytes: &mut Vec<u8>) {
    bytes.resize(bytes.len().next_multiple_of(4), 0);
}

/// A buffer: the chunk of a .glb file, or data at an address.
pub(super) fn buffer(length: usize, uri: Option<String>) -> Buffer {
    Buffer { byte_length: length.into(), name: None, uri, extensions: None, extras: None }
}

/// A part of a buffer: vertices of three floats, or indices.
pub(super) fn view(buffer: Index<Buffer>, offset: usize, length: usize, target: Target) -> View {
    View {
        buffer,
        byte_length: length.into(),
        byte_offset: Some(offset.into()),
        byte_stride: (target == Target::ArrayBuffer).then_some(Stride(3 * size_of::<f32>())),
        name: None,
        target: Some(Valid(target)),
        extensions: None,
        extras: None,
    }
}

/// `count` elements of a view, from `offset` on.
pub(super) fn accessor(
    view: Index<View>,
    offset: usize,
    count: usize,
    (component, kind): (ComponentType, Type),
) -> Accessor {
    Accessor {
        buffer_view: Some(view),
        byte_offset: Some(offset.into()),
        count: count.into(),
        component_type: Valid(GenericComponentType(component)),
        extensions: None,
        extras: None,
        type_: Valid(kind),
        min: None,
        max: None,
        name: None,
        normalized: false,
        sparse: None,
    }
}
