//! The order of assembly as an animation: rods appear in their steps, and props stand while
//! they are needed.
//!
//! Where the scale of a node is zero, nothing of it is drawn: that is how glTF hides nodes over
//! time (glTF 2.0, section 3.11).

use super::super::structure::Structure;
use super::parts::{accessor, pad, view};
use super::{GlbError, document, metres, push_group, single, wrap};
use crate::shop::order::{Assembly, Prop};
use gltf_json::accessor::{ComponentType, Type};
use gltf_json::animation::{Channel, Interpolation, Property, Sampler, Target as Animated};
use gltf_json::buffer::{Target, View};
use gltf_json::mesh::{Mode, Primitive, Semantic};
use gltf_json::validation::Checked::Valid;
use gltf_json::{Accessor, Animation, Index, Mesh, Node, Root};
use std::collections::{BTreeMap, HashMap};

/// From a step to the next one, s.
const STEP: f32 = 0.5;
/// How long the whole model stands at the end, s.
const REST: f32 = 3.0;

/// The bytes of a model file whose rods appear in the order of assembly.
///
/// # Errors
/// [`GlbError`], also where the assembly has a rod that the structure does not have.
pub fn assembly_glb(structure: &Structure, assembly: &Assembly) -> Result<Vec<u8>, GlbError> {
    let (mut root, mut buffer) = document(structure, None, |_| None)?;
    pad(&mut buffer);
    let nodes: HashMap<String, Index<Node>> = root
        .nodes
        .iter()
        .enumerate()
        .filter_map(|(i, node)| Some((node.name.clone()?, Index::new(i as u32))))
        .collect();
    let has_props = assembly.steps.iter().any(|step| !step.props.is_empty());
    let line = has_props.then(|| push_line(&mut root, &mut buffer));
    let mut film = Film::new(&mut root, &mut buffer, assembly.steps.len());
    for (number, step) in assembly.steps.iter().enumerate() {
        for rod in &step.rods {
            let name = rod.to_string();
            let node = nodes.get(&name).ok_or(GlbError::MissingRod(name))?;
            film.show(*node, number, None);
        }
    }
    let props = line.map(|mesh| film.props(assembly, mesh));
    let animation = film.finish();
    if let Some(props) = props {
        let group = push_group(&mut root, "props", props);
        let top = root.scenes[0].nodes[0];
        root.nodes[top.value()].children.get_or_insert_default().push(group);
    }
    root.push(animation);
    wrap(&root, buffer)
}

/// An animation in the making.
struct Film<'a> {
    root: &'a mut Root,
    buffer: &'a mut Vec<u8>,
    /// Where its floats lie.
    view: Index<View>,
    start: usize,
    steps: usize,
    /// The times of what appears in a step, and of what goes after another.
    times: BTreeMap<(usize, Option<usize>), Index<Accessor>>,
    channels: Vec<Channel>,
    samplers: Vec<Sampler>,
}

impl<'a> Film<'a> {
    fn new(root: &'a mut Root, buffer: &'a mut Vec<u8>, steps: usize) -> Self {
        let start = buffer.len();
        let view = root.push(View {
            buffer: Index::new(0),
            byte_length: 0usize.into(),
            byte_offset: Some(start.into()),
            byte_stride: None,
            name: None,
            target: None,
            extensions: None,
            extras: None,
        });
        let (times, channels, samplers) = Default::default();
        Self { root, buffer, view, start, steps, times, channels, samplers }
    }

    /// When a step is shown, s.
    fn time(number: usize) -> f32 {
        (number + 1) as f32 * STEP
    }

    fn push(&mut self, values: &[f32], count: usize, kind: Type) -> Accessor {
        let offset = self.buffer.len() - self.start;
        self.buffer.extend(values.iter().flat_map(|x| x.to_le_bytes()));
        accessor(self.view, offset, count, (ComponentType::F32, kind))
    }

    /// Shows a node from a step on, up to the end of another one.
    fn show(&mut self, node: Index<Node>, from: usize, until: Option<usize>) {
        let input = self.times_of(from, until);
        let scale = self.root.nodes[node.value()].scale.unwrap_or([1.0; 3]);
        let last = if until.is_some() { [0.0; 3] } else { scale };
        let values = [[0.0; 3], scale, last].concat();
        let output = self.push(&values, 3, Type::Vec3);
        let output = self.root.push(output);
        let sampler = Index::new(self.samplers.len() as u32);
        let interpolation = Valid(Interpolation::Step);
        self.samplers.push(Sampler {
            input,
            interpolation,
            output,
            extensions: None,
            extras: None,
        });
        let target =
            Animated { node, path: Valid(Property::Scale), extensions: None, extras: None };
        self.channels.push(Channel { sampler, target, extensions: None, extras: None });
    }

    fn times_of(&mut self, from: usize, until: Option<usize>) -> Index<Accessor> {
        if let Some(known) = self.times.get(&(from, until)) {
            return *known;
        }
        let end = until.map_or(Self::time(self.steps) + REST, |last| Self::time(last + 1));
        let keys = [0.0, Self::time(from), end];
        let bound = |x: f32| Some(serde_json::Value::from(vec![f64::from(x)]));
        let times = self.push(&keys, 3, Type::Scalar);
        let times = self.root.push(Accessor { min: bound(keys[0]), max: bound(end), ..times });
        self.times.insert((from, until), times);
        times
    }

    /// Adds the props, each shown while it stands.
    fn props(&mut self, assembly: &Assembly, mesh: Index<Mesh>) -> Vec<Index<Node>> {
        let mut nodes = Vec::new();
        for (number, step) in assembly.steps.iter().enumerate() {
            for prop in &step.props {
                let node = self.root.push(prop_node(prop, mesh));
                self.show(node, number, assembly.removal(prop.id));
                nodes.push(node);
            }
        }
        nodes
    }

    /// The animation; the lengths of buffer and view are put right.
    fn finish(self) -> Animation {
        let length = self.buffer.len();
        self.root.buffers[0].byte_length = length.into();
        self.root.buffer_views[self.view.value()].byte_length = (length - self.start).into();
        Animation {
            extensions: None,
            extras: None,
            channels: self.channels,
            name: Some("assembly".to_owned()),
            samplers: self.samplers,
        }
    }
}

/// Adds a line from the origin to (0, 1, 0), in a part of the buffer of its own: vertices and
/// times of an animation may not share one.
fn push_line(root: &mut Root, buffer: &mut Vec<u8>) -> Index<Mesh> {
    let points = [0.0, 0.0, 0.0, 0.0, 1.0, 0.0_f32];
    let view = view(Index::new(0), buffer.len(), size_of_val(&points), Target::ArrayBuffer);
    let view = root.push(view);
    buffer.extend(points.iter().flat_map(|x| x.to_le_bytes()));
    let bound = |y: f64| Some(serde_json::Value::from(vec![0.0, y, 0.0]));
    let points = root.push(Accessor {
        min: bound(0.0),
        max: bound(1.0),
        ..accessor(view, 0, 2, (ComponentType::F32, Type::Vec3))
    });
    let primitive = Primitive {
        attributes: BTreeMap::from([(Valid(Semantic::Positions), points)]),
        extensions: None,
        extras: None,
        indices: None,
        material: None,
        mode: Valid(Mode::Lines),
        targets: None,
    };
    root.push(Mesh {
        extensions: None,
        extras: None,
        name: Some("prop".to_owned()),
        primitives: vec![primitive],
        weights: None,
    })
}

/// A prop as an upright line from its foot.
fn prop_node(prop: &Prop, mesh: Index<Mesh>) -> Node {
    let [x, y, z] = prop.point.into();
    Node {
        name: Some(prop.id.to_string()),
        mesh: Some(mesh),
        translation: Some(single(metres([x, y, z - prop.height]))),
        scale: Some([1.0, (prop.height / 1000.0) as f32, 1.0]),
        ..Node::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shop::fixture;
    use crate::shop::lengths::classes;
    use crate::shop::{Order, OrderSettings, assembly};
    use gltf::Gltf;
    use gltf::animation::util::ReadOutputs;

    /// When each node is shown, s, read back from the file.
    fn shown(bytes: &[u8]) -> BTreeMap<String, (f32, f32, [[f32; 3]; 3])> {
        let file = Gltf::from_slice(bytes).unwrap();
        let blob = file.blob.as_deref().unwrap();
        let animation = file.animations().next().unwrap();
        let channels = animation.channels().map(|channel| {
            let reader = channel.reader(|_| Some(blob));
            let times: Vec<f32> = reader.read_inputs().unwrap().collect();
            let Some(ReadOutputs::Scales(scales)) = reader.read_outputs() else { panic!() };
            let scales: Vec<[f32; 3]> = scales.collect();
            let name = channel.target().node().name().unwrap().to_owned();
            (name, (times[1], times[2], scales.try_into().unwrap()))
        });
        channels.collect()
    }

    /// A part of a buffer holds either vertices or an animation's times and values.
    fn assert_parts_serve_one_end(bytes: &[u8]) {
        let file = Gltf::from_slice(bytes).unwrap();
        let of = |accessor: gltf::Accessor| accessor.view().unwrap().index();
        let primitives = file.meshes().flat_map(|mesh| mesh.primitives());
        let vertices = primitives.flat_map(|primitive| {
            let accessors = primitive.attributes().map(|(_, accessor)| of(accessor));
            accessors.collect::<Vec<_>>()
        });
        let animated: Vec<usize> = file
            .animations()
            .flat_map(|animation| {
                let ends = animation.samplers().map(|s| [of(s.input()), of(s.output())]);
                ends.collect::<Vec<_>>()
            })
            .flatten()
            .collect();
        assert!(!animated.is_empty());
        for view in vertices {
            assert!(!animated.contains(&view));
            assert!(file.views().nth(view).unwrap().target().is_some());
        }
    }

    #[test]
    fn rods_appear_in_their_steps_and_props_go() {
        let frame = fixture::on_sample("igloo", "4.4.4.4");
        let structure = Structure::from_frame(&frame, &classes(&frame), &[]);
        for order in [Order::Crown, Order::Ground] {
            let settings = OrderSettings { order: Some(order), ..OrderSettings::default() };
            let plan = assembly(&frame, &[], settings).unwrap();
            let bytes = assembly_glb(&structure, &plan).unwrap();
            assert_parts_serve_one_end(&bytes);
            let shown = shown(&bytes);
            let props: usize = plan.steps.iter().map(|step| step.props.len()).sum();
            assert_eq!(shown.len(), frame.rods.len() + props);
            let end = plan.steps.len() as f32 * STEP;
            for (number, step) in plan.steps.iter().enumerate() {
                for rod in &step.rods {
                    let (from, last, [hidden, there, kept]) = shown[&rod.to_string()];
                    assert_eq!(from, (number + 1) as f32 * STEP);
                    assert!(last > end && hidden == [0.0; 3] && there == kept && there[1] > 0.0);
                }
                for prop in &step.props {
                    let (from, until, [hidden, there, gone]) = shown[&prop.id.to_string()];
                    assert!(from < until && until <= end + 2.0 * STEP, "{from} {until}");
                    assert!((f64::from(there[1]) * 1000.0 - prop.height).abs() < 1e-3);
                    assert_eq!((hidden, gone), ([0.0; 3], [0.0; 3]));
                }
            }
        }
    }
}
