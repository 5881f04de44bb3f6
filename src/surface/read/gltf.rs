//! glTF 2.0, as .gltf with buffers beside or inside it, or as .glb.
//!
//! All triangle primitives (lists, strips, fans) of the default scene are placed by
//! their nodes and joined to one soup, turned from y up and metres to z up and
//! millimetres. The `gltf` crate parses and validates the document; bytes are read
//! here, because its accessors trust sizes in the file. Skins, morph targets and
//! materials are not applied, and a note says so of the first two. Extensions that are required and change the shape are
//! refused by name.

use super::accessor::{self, Bytes};
use super::soup::Soup;
use super::uri::{self, UriError};
use crate::surface::Point3;
use crate::surface::shape::counted;
use gltf::mesh::Mode;
use gltf::{Document, Glb, Node, Semantic};
use nalgebra::{Matrix4, Quaternion, Translation3, UnitQuaternion, Vector3};
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::rc::Rc;

/// What is wrong with a glTF file.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum GltfError {
    /// The frame of a .glb file does not hold.
    #[error("the GLB frame is damaged: {0}")]
    Frame(String),
    /// The document is not JSON, or not glTF.
    #[error("the document cannot be read: {0}")]
    Json(String),
    /// The document contradicts the glTF specification.
    #[error("the document is not sound: {0}")]
    Invalid(String),
    /// An extension without which the shape cannot be read.
    #[error("the file needs the extension {0}")]
    Extension(String),
    /// A buffer's address is not followed.
    #[error("buffer {index}: {cause}")]
    Uri {
        /// The buffer, counted from 0 as in the document.
        index: usize,
        /// Why not.
        cause: UriError,
    },
    /// A buffer holds less than it says.
    #[error("buffer {index} says that it has {said} bytes, but there are {found}")]
    BufferTooShort {
        /// The buffer, counted from 0 as in the document.
        index: usize,
        /// Length in the document.
        said: usize,
        /// Bytes found.
        found: usize,
    },
    /// An accessor that cannot be read.
    #[error("accessor {index} {problem}")]
    Accessor {
        /// The accessor, counted from 0 as in the document.
        index: usize,
        /// What is wrong with it.
        problem: &'static str,
    },
    /// An index without a vertex.
    #[error("mesh {mesh:?}: an index names vertex {vertex}, but the vertices end at {vertices}")]
    VertexOutOfRange {
        /// The mesh, by name or number.
        mesh: String,
        /// The vertex, counted from 1.
        vertex: u64,
        /// How many the primitive has.
        vertices: usize,
    },
    /// A node that is its own ancestor, or has two parents.
    #[error("node {index} hangs in the scene twice")]
    NodeTwice {
        /// The node, counted from 0 as in the document.
        index: usize,
    },
    /// Placed copies grow out of proportion to the file.
    #[error("the scene repeats its meshes to more than {limit} triangle corners and vertices")]
    TooManyCopies {
        /// The most that is read.
        limit: usize,
    },
    /// Nothing to cover.
    #[error("the scene has no triangles")]
    NoTriangles,
}

impl GltfError {
    /// What to try.
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Extension(_) => "export again without compression, as plain glTF or GLB",
            Self::Uri { .. } => {
                "put the buffer beside the document, or export as GLB, which holds everything"
            }
            Self::TooManyCopies { .. } => "export the surface alone, without its copies",
            Self::NoTriangles => "export the surface as a mesh, within the scene",
            _ => "the file is damaged or was written wrongly: export it again",
        }
    }
}

/// Required extensions that leave positions as they are or are read here.
const HARMLESS: [&str; 5] = [
    "KHR_materials_",
    "KHR_texture_",
    "EXT_texture_",
    "KHR_mesh_quantization",
    "KHR_lights_punctual",
];

/// Extensions that hold the vertices in a packed form of their own.
const COMPRESSED: [&str; 2] = ["KHR_draco_mesh_compression", "EXT_meshopt_compression"];

/// Placed corners and vertices allowed beyond a few for each byte of the file: enough
/// for any scene that repeats a small mesh, too little to fill the memory.
const FREE_COPIES: usize = 4_000_000;

/// Placed corners and vertices allowed for each byte of the file and its buffers; a
/// strip of byte indices has three corners a byte.
const PER_BYTE: usize = 4;

/// Bytes of the header of a .glb file: the magic word, version and length.
const GLB_HEADER: usize = 12;

/// Millimetres in a metre.
const MILLIMETRES: f64 = 1000.0;

/// Vertices and triangles of the default scene, mm, z up.
pub(super) fn read(
    bytes: &[u8],
    folder: Option<&Path>,
    notes: &mut Vec<String>,
) -> Result<Soup, GltfError> {
    let (json, blob) = unwrap_glb(bytes)?;
    let document = parse(json, notes)?;
    let buffers = Buffers::load(&document, blob, folder)?;
    let size = bytes.len() + buffers.beside();
    let mut scene = Scene {
        buffers,
        soup: Soup::default(),
        size,
        skinned: 0,
        morphed: 0,
        others: 0,
        limit: size.saturating_mul(PER_BYTE).saturating_add(FREE_COPIES),
    };
    for (node, matrix) in placed_nodes(&document)? {
        if let Some(mesh) = node.mesh() {
            scene.add_mesh(&mesh, &matrix)?;
            scene.skinned += usize::from(node.skin().is_some());
            let morphs = mesh.primitives().any(|p| p.morph_targets().len() > 0);
            scene.morphed += usize::from(morphs);
        }
    }
    for (count, what) in [(scene.skinned, "skins"), (scene.morphed, "morph targets")] {
        if count > 0 {
            let meshes = counted(count, "mesh", "meshes");
            notes.push(format!("{meshes} read at rest: {what} are not applied"));
        }
    }
    if scene.others > 0 {
        let sets = counted(scene.others, "set", "sets");
        notes.push(format!("{sets} of points or lines left out"));
    }
    if scene.soup.face_count() == 0 {
        return Err(GltfError::NoTriangles);
    }
    Ok(scene.soup)
}

/// The document and the binary chunk of a .glb file; all bytes of a .gltf file.
fn unwrap_glb(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), GltfError> {
    if !bytes.starts_with(b"glTF") {
        return Ok((bytes, None));
    }
    // The library subtracts its header's 12 bytes from this length unchecked.
    let length = bytes.get(8..12).and_then(|b| b.try_into().ok()).map(u32::from_le_bytes);
    let length = length.map_or(0, |l| l as usize);
    let whole = bytes.get(..length).filter(|_| length >= GLB_HEADER).ok_or_else(|| {
        let found = bytes.len();
        GltfError::Frame(format!("its header says that it has {length} bytes, there are {found}"))
    })?;
    let glb = Glb::from_slice(whole).map_err(|e| GltfError::Frame(e.to_string()))?;
    let borrowed = |c| match c {
        std::borrow::Cow::Borrowed(b) => Some(b),
        std::borrow::Cow::Owned(_) => None,
    };
    let json = borrowed(glb.json).ok_or(GltfError::Frame("no document".into()))?;
    Ok((json, glb.bin.and_then(borrowed)))
}

fn parse(json: &[u8], notes: &mut Vec<String>) -> Result<Document, GltfError> {
    let mut root: gltf::json::Root =
        gltf::json::deserialize::from_slice(json).map_err(|e| GltfError::Json(e.to_string()))?;
    for extension in root.extensions_required.drain(..) {
        if !HARMLESS.iter().any(|h| extension.starts_with(h)) {
            return Err(GltfError::Extension(extension));
        }
    }
    if root.extensions_used.iter().any(|e| e == "EXT_mesh_gpu_instancing") {
        notes.push("copies by EXT_mesh_gpu_instancing left out".into());
    }
    let mut used = root.extensions_used.iter();
    let compressed = used.find(|e| COMPRESSED.contains(&e.as_str())).cloned();
    prepare_bounds(&mut root)?;
    Document::from_json(root).map_err(|e| match (e, compressed) {
        // Not declared as required, but the data is nowhere else.
        (gltf::Error::Validation(_), Some(extension)) => GltfError::Extension(extension),
        (gltf::Error::Validation(problems), None) => {
            let text = |(path, e): &(gltf::json::Path, _)| format!("{path}: {e}");
            GltfError::Invalid(problems.iter().take(3).map(text).collect::<Vec<_>>().join("; "))
        }
        (other, _) => GltfError::Invalid(other.to_string()),
    })
}

/// The library refuses positions without bounds, which are not needed here, and indexes
/// with the number of the accessor before it has checked it.
fn prepare_bounds(root: &mut gltf::json::Root) -> Result<(), GltfError> {
    let positions = gltf::json::validation::Checked::Valid(Semantic::Positions);
    for primitive in root.meshes.iter().flat_map(|m| &m.primitives) {
        let Some(index) = primitive.attributes.get(&positions).map(|i| i.value()) else {
            continue;
        };
        let accessor = root
            .accessors
            .get_mut(index)
            .ok_or(GltfError::Accessor { index, problem: "is not there" })?;
        for bound in [&mut accessor.min, &mut accessor.max] {
            *bound = Some([0.0_f32; 3].as_slice().into());
        }
    }
    Ok(())
}

/// The bytes of all buffers. Buffers that name the same file share it.
struct Buffers {
    contents: Vec<Rc<Vec<u8>>>,
    lengths: Vec<usize>,
    files: HashMap<PathBuf, Rc<Vec<u8>>>,
}

impl Buffers {
    fn load(
        document: &Document,
        blob: Option<&[u8]>,
        folder: Option<&Path>,
    ) -> Result<Self, GltfError> {
        let mut buffers = Self { contents: Vec::new(), lengths: Vec::new(), files: HashMap::new() };
        for buffer in document.buffers() {
            let (index, said) = (buffer.index(), buffer.length());
            let content = match buffer.source() {
                // Only the first buffer may be the one inside.
                gltf::buffer::Source::Bin if index == 0 => blob.unwrap_or_default().to_vec().into(),
                gltf::buffer::Source::Bin => Rc::default(),
                gltf::buffer::Source::Uri(uri) => {
                    buffers.at_uri(uri, folder).map_err(|cause| GltfError::Uri { index, cause })?
                }
            };
            if content.len() < said {
                return Err(GltfError::BufferTooShort { index, said, found: content.len() });
            }
            buffers.contents.push(content);
            buffers.lengths.push(said);
        }
        Ok(buffers)
    }

    fn at_uri(&mut self, uri: &str, folder: Option<&Path>) -> Result<Rc<Vec<u8>>, UriError> {
        let path = match uri::resolve(uri, folder)? {
            uri::Source::Embedded(data) => return Ok(data.into()),
            uri::Source::File(path) => path,
        };
        if let Some(content) = self.files.get(&path) {
            return Ok(content.clone());
        }
        let content = Rc::new(uri::load(uri, &path)?);
        self.files.insert(path, content.clone());
        Ok(content)
    }

    fn get(&self, index: usize) -> Option<&[u8]> {
        self.contents.get(index)?.get(..*self.lengths.get(index)?)
    }

    /// Bytes of all files beside the document.
    fn beside(&self) -> usize {
        self.files.values().map(|f| f.len()).sum()
    }
}

/// Nodes of the default scene with their matrices. Without a scene, all nodes that no
/// other node holds.
fn placed_nodes(document: &Document) -> Result<Vec<(Node<'_>, Matrix4<f64>)>, GltfError> {
    let roots: Vec<Node> = match document.default_scene().or_else(|| document.scenes().next()) {
        Some(scene) => scene.nodes().collect(),
        None => {
            let mut held = vec![false; document.nodes().len()];
            for child in document.nodes().flat_map(|n| n.children().collect::<Vec<_>>()) {
                held[child.index()] = true;
            }
            document.nodes().filter(|n| !held[n.index()]).collect()
        }
    };
    let mut seen = vec![false; document.nodes().len()];
    let mut stack: Vec<_> = roots.into_iter().rev().map(|n| (n, z_up_mm())).collect();
    let mut placed = Vec::new();
    while let Some((node, parent)) = stack.pop() {
        let index = node.index();
        if std::mem::replace(&mut seen[index], true) {
            return Err(GltfError::NodeTwice { index });
        }
        let matrix = parent * local(&node);
        let children: Vec<_> = node.children().map(|child| (child, matrix)).collect();
        stack.extend(children.into_iter().rev());
        placed.push((node, matrix));
    }
    Ok(placed)
}

/// From y up and metres to z up and millimetres.
fn z_up_mm() -> Matrix4<f64> {
    let m = MILLIMETRES;
    Matrix4::new(
        m, 0.0, 0.0, 0.0, //
        0.0, 0.0, -m, 0.0, //
        0.0, m, 0.0, 0.0, //
        0.0, 0.0, 0.0, 1.0,
    )
}

fn local(node: &Node) -> Matrix4<f64> {
    match node.transform() {
        gltf::scene::Transform::Matrix { matrix } => {
            Matrix4::from_fn(|row, column| f64::from(matrix[column][row]))
        }
        gltf::scene::Transform::Decomposed { translation: t, rotation: r, scale: s } => {
            let [t, s] = [t, s].map(|v| Vector3::from(v.map(f64::from)));
            let [i, j, k, w] = r.map(f64::from);
            let turn = UnitQuaternion::from_quaternion(Quaternion::new(w, i, j, k));
            Translation3::from(t).to_homogeneous()
                * turn.to_homogeneous()
                * Matrix4::new_nonuniform_scaling(&s)
        }
    }
}

struct Scene {
    buffers: Buffers,
    soup: Soup,
    /// Bytes of the document and of all files beside it.
    size: usize,
    /// Meshes with skins, and with morph targets.
    skinned: usize,
    morphed: usize,
    /// Primitives of points and lines met.
    others: usize,
    limit: usize,
}

impl Scene {
    fn add_mesh(&mut self, mesh: &gltf::Mesh, matrix: &Matrix4<f64>) -> Result<(), GltfError> {
        let name = || mesh.name().map_or_else(|| mesh.index().to_string(), str::to_owned);
        // A mirroring node turns triangles inside out.
        let mirrored = matrix.fixed_view::<3, 3>(0, 0).determinant() < 0.0;
        for primitive in mesh.primitives() {
            if !matches!(
                primitive.mode(),
                Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan
            ) {
                self.others += 1;
                continue;
            }
            let Some(positions) = primitive.get(&Semantic::Positions) else { continue };
            let bytes = Bytes { buffer: &|buffer| self.buffers.get(buffer), size: self.size };
            let positions = accessor::positions(&positions, &bytes)?;
            let indices = match primitive.indices() {
                Some(indices) => accessor::indices(&indices, &bytes)?,
                None => (0..positions.len() as u32).collect(),
            };
            if let Some(&i) = indices.iter().find(|&&i| i as usize >= positions.len()) {
                let (vertex, vertices) = (u64::from(i) + 1, positions.len());
                return Err(GltfError::VertexOutOfRange { mesh: name(), vertex, vertices });
            }
            let corners = if primitive.mode() == Mode::Triangles { 1 } else { 3 };
            let more = positions.len() + corners * indices.len();
            let base = self.soup.points.len();
            if base + self.soup.corner_count() + more > self.limit {
                return Err(GltfError::TooManyCopies { limit: self.limit });
            }
            self.soup.points.extend(positions.iter().map(|&p| transform(matrix, p)));
            for mut t in assemble(primitive.mode(), &indices) {
                if mirrored {
                    t.swap(1, 2);
                }
                // The limit keeps vertices below 2^32.
                self.soup.push(t.map(|i| base as u32 + i), None);
            }
        }
        Ok(())
    }
}

fn transform(matrix: &Matrix4<f64>, p: [f64; 3]) -> Point3 {
    let v = matrix * nalgebra::Vector4::new(p[0], p[1], p[2], 1.0);
    Point3::new(v.x, v.y, v.z)
}

/// Triangles of a list, strip or fan (glTF 2.0, 3.7.2.1). A strip's odd triangles run
/// the other way round. What is left over at the end is no triangle.
fn assemble(mode: Mode, indices: &[u32]) -> impl Iterator<Item = [u32; 3]> + '_ {
    let count = match mode {
        Mode::Triangles => indices.len() / 3,
        _ => indices.len().saturating_sub(2),
    };
    (0..count).map(move |i| match mode {
        Mode::TriangleStrip => {
            let (b, c) = if i % 2 == 0 { (i + 1, i + 2) } else { (i + 2, i + 1) };
            [indices[i], indices[b], indices[c]]
        }
        Mode::TriangleFan => [indices[i + 1], indices[i + 2], indices[0]],
        _ => [indices[3 * i], indices[3 * i + 1], indices[3 * i + 2]],
    })
}
