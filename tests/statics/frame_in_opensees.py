"""A frame of rods as an OpenSees model: Timoshenko beams, contacts, feet, loads.

Lengths in mm, forces in N. Nothing is taken over from rodwright but numbers: stiffnesses are
made here, of diameters and moduli, or taken as the springs that are given.
"""
from dataclasses import dataclass, field

import numpy as np
import openseespy.opensees as ops


@dataclass
class Beam:
    nodes: tuple
    area: float
    inertia: float
    polar: float
    shear_area: float


@dataclass
class Joint:
    """Rigid arms from both nodes to `touch`, springs there: N/mm, N mm."""

    nodes: tuple
    touch: np.ndarray
    axis: np.ndarray
    push: float
    twist: float
    rock: float


@dataclass
class Frame:
    young: float
    shear: float
    nodes: np.ndarray
    beams: list
    joints: list
    feet: list  # (node, six flags)


@dataclass
class Load:
    nodes: list = field(default_factory=list)  # (node, six numbers)
    beams: list = field(default_factory=list)  # N/mm, global, one a beam


@dataclass
class Answer:
    moved: np.ndarray  # n x 6
    reactions: np.ndarray  # feet x 6
    beam_ends: np.ndarray  # beams x 12, what the nodes do to a beam, in axes of its own
    contacts: np.ndarray  # joints x 6, of the over rod on the under rod


def circle(diameter, poisson):
    """Area, I, J and Cowper's shear area of a solid circle."""
    area = np.pi * diameter**2 / 4
    inertia = np.pi * diameter**4 / 64
    return area, inertia, 2 * inertia, area * 6 * (1 + poisson) / (7 + 6 * poisson)


def beam_axes(along):
    """Rows x, y, z as OpenSees makes them of `vecxz`; vertical members need another one."""
    x = along / np.linalg.norm(along)
    vecxz = np.array([0.0, 0.0, 1.0]) if np.hypot(x[0], x[1]) > 0.1 else np.array([1.0, 0.0, 0.0])
    y = np.cross(vecxz, x)
    y /= np.linalg.norm(y)
    return np.array([x, y, np.cross(x, y)]), vecxz


def across(axis):
    """A direction across an axis."""
    helper = np.zeros(3)
    helper[np.argmin(np.abs(axis))] = 1.0
    y = np.cross(axis, helper)
    return y / np.linalg.norm(y)


def solve(frame, load):
    """Builds the whole model anew and solves one load."""
    ops.wipe()
    ops.model("basic", "-ndm", 3, "-ndf", 6)
    count = len(frame.nodes)
    for i, p in enumerate(frame.nodes):
        ops.node(i + 1, *map(float, p))
    for node, held in frame.feet:
        ops.fix(node + 1, *map(int, held))
    axes = add_beams(frame)
    tips = add_joints(frame, count)
    ops.timeSeries("Constant", 1)
    ops.pattern("Plain", 1, 1)
    for node, six in load.nodes:
        ops.load(node + 1, *map(float, six))
    for i, q in enumerate(load.beams):
        if np.any(q):
            x, y, z = axes[i] @ np.asarray(q, float)
            ops.eleLoad("-ele", i + 1, "-type", "-beamUniform", float(y), float(z), float(x))
    run()
    ops.reactions()
    return Answer(
        moved=np.array([ops.nodeDisp(i + 1) for i in range(count)]),
        reactions=np.array([ops.nodeReaction(n + 1) for n, _ in frame.feet]).reshape(-1, 6),
        beam_ends=np.array([ops.eleResponse(i + 1, "localForce") for i in range(len(frame.beams))]),
        contacts=np.array(
            [spring_force(j, tip) for j, tip in zip(frame.joints, tips)]
        ).reshape(-1, 6),
    )


def add_beams(frame):
    axes = []
    for i, beam in enumerate(frame.beams):
        a, b = beam.nodes
        own, vecxz = beam_axes(np.asarray(frame.nodes[b]) - np.asarray(frame.nodes[a]))
        axes.append(own)
        ops.geomTransf("Linear", i + 1, *map(float, vecxz))
        ops.element(
            "ElasticTimoshenkoBeam", i + 1, a + 1, b + 1, frame.young, frame.shear, beam.area,
            beam.polar, beam.inertia, beam.inertia, beam.shear_area, beam.shear_area, i + 1,
        )
    return axes


def add_joints(frame, count):
    """A rigid arm from each node to a node of its own at `touch`, six springs between them."""
    tips = []
    element = len(frame.beams)
    material = 0
    for k, joint in enumerate(frame.joints):
        over, under = count + 2 * k + 1, count + 2 * k + 2
        for node, tip in zip(joint.nodes, (over, under)):
            ops.node(tip, *map(float, joint.touch))
            ops.rigidLink("beam", node + 1, tip)
        springs = [(d, joint.push) for d in (1, 2, 3)] + [(4, joint.twist), (5, joint.rock), (6, joint.rock)]
        springs = [(d, s) for d, s in springs if s > 0]
        for i, (_, stiff) in enumerate(springs):
            ops.uniaxialMaterial("Elastic", material + i + 1, stiff)
        materials = [material + i + 1 for i in range(len(springs))]
        material += len(springs)
        element += 1
        ops.element(
            "zeroLength", element, under, over, "-mat", *materials, "-dir", *[d for d, _ in springs],
            "-orient", *map(float, joint.axis), *map(float, across(joint.axis)),
        )
        tips.append((under, over))
    return tips


def spring_force(joint, tips):
    """Force and moment of the over rod on the under rod, by how far the tips come apart."""
    under, over = (np.array(ops.nodeDisp(t)) for t in tips)
    apart = over - under
    about = np.outer(joint.axis, joint.axis)
    turn = joint.twist * about + joint.rock * (np.eye(3) - about)
    return np.concatenate([joint.push * apart[:3], turn @ apart[3:]])


def run():
    """Solves what stands in OpenSees."""
    ops.constraints("Transformation")
    ops.numberer("RCM")
    ops.system("UmfPack")
    ops.test("FixedNumIter", 3)
    ops.algorithm("Newton")
    ops.integrator("LoadControl", 1.0)
    ops.analysis("Static")
    if ops.analyze(1) != 0:
        raise SystemExit("OpenSees cannot solve the model")
