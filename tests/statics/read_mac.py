#!/usr/bin/env python3
"""Reads OUT/model.mac back, solves it in OpenSees and compares with OUT/statics.json.

    read_mac.py OUT [...]

It understands the commands that the deck uses and refuses others, so that the numbers of the
deck are proven: nodes, sections by radius and shear stiffness, elements, the stiffness of
contacts, supports, forces, and even loads in the axes that ANSYS gives to a BEAM188 (z in the
plane of the third node; face 1 presses against z, 2 against y, 3 pulls along x).

pip install openseespy==3.7.1.2 numpy
"""
import json
import sys
from collections import defaultdict
from pathlib import Path

import numpy as np
import openseespy.opensees as ops

from frame_in_opensees import run

SAME = 1e-8
MOVES = ["UX", "UY", "UZ", "ROTX", "ROTY", "ROTZ"]
FORCES = ["FX", "FY", "FZ", "MX", "MY", "MZ"]
IDLE = {"FINISH", "/CLEAR", "/TITLE", "/PREP7", "/SOLU", "/POST1", "OUTRES", "PRNSOL", "PRRSOL", "TIME", "SET"}


class Deck:
    """What an input file says, as far as it is understood."""

    def __init__(self, text):
        self.kinds, self.keys, self.material = {}, {}, {}
        self.radius, self.shear, self.constants = {}, {}, defaultdict(list)
        self.nodes, self.elements, self.held = {}, {}, set()
        self.components, self.selected = {}, None
        self.cases = []
        self.now = {"type": None, "mat": None, "sec": None, "real": None}
        self.section = self.real = None
        self.forces, self.pressures = {}, {}
        for line in text.splitlines():
            fields = [f.strip() for f in line.split("!")[0].split(",")]
            if fields[0] and fields[0] not in IDLE:
                self.read(fields[0], fields[1:], line)

    def read(self, command, f, line):
        if command == "ET":
            self.kinds[int(f[0])] = f[1]
        elif command == "KEYOPT":
            self.keys[int(f[0]), int(f[1])] = int(f[2])
        elif command == "MP":
            self.material[f[0], int(f[1])] = float(f[2])
        elif command == "SECTYPE" and f[1:] == ["BEAM", "CSOLID"]:
            self.section = int(f[0])
        elif command == "SECDATA":
            self.radius[self.section] = float(f[0])
        elif command == "SECCONTROL":
            self.shear[self.section] = [float(x) for x in f]
        elif command == "N":
            self.nodes[int(f[0])] = np.array([float(x) for x in f[1:]])
        elif command in ("TYPE", "MAT", "REAL"):
            self.now[command.lower()] = int(f[0])
        elif command == "SECNUM":
            self.now["sec"] = int(f[0])
        elif command == "EN":
            self.elements[int(f[0])] = ([int(x) for x in f[1:]], dict(self.now))
        elif command == "R":
            self.real = int(f[0])
            self.constants[self.real] = [float(x) for x in f[1:]]
        elif command == "RMORE":
            self.constants[self.real] += [float(x) for x in f]
        elif command == "ESEL" and f == ["ALL"]:
            self.selected = None
        elif command == "ESEL" and f[:3] == ["S", "ELEM", ""]:
            self.selected = range(int(f[3]), int(f[-1]) + 1)
        elif command == "CM" and f[1] == "ELEM":
            self.components[f[0]] = self.selected
        elif command == "D" and float(f[2]) == 0:
            self.held.add((int(f[0]), MOVES.index(f[1])))
        elif command == "ANTYPE" and f == ["STATIC"]:
            if self.selected is not None:
                raise SystemExit("only a part of the elements is selected")
        elif command == "FDELE" and f == ["ALL", "ALL"]:
            self.forces = {}
        elif command == "SFEDELE" and f == ["ALL", "ALL", "ALL"]:
            self.pressures = {}
        elif command == "F":
            self.forces[int(f[0]), FORCES.index(f[1])] = float(f[2])
        elif command == "SFBEAM" and f[2] == "PRES":
            self.pressures[int(f[0]), int(f[1])] = float(f[3])
        elif command == "SOLVE" and not f:
            self.cases.append((dict(self.forces), dict(self.pressures)))
        else:
            raise SystemExit(f"not understood: {line}")


def axes(deck, nodes):
    """x along the element, z in the plane of the third node and towards it."""
    a, b, third = (deck.nodes[n] for n in nodes)
    x = (b - a) / np.linalg.norm(b - a)
    y = np.cross(third - a, x)
    y /= np.linalg.norm(y)
    return np.array([x, y, np.cross(x, y)])


def full(constants):
    """A symmetric matrix of twelve by the rows of its upper triangle."""
    if len(constants) != 78:
        raise SystemExit(f"{len(constants)} constants are no triangle of twelve")
    k = np.zeros((12, 12))
    k[np.triu_indices(12)] = constants
    return k + np.triu(k, 1).T


def build(deck):
    """The model in OpenSees; the axes of its beams."""
    ops.wipe()
    ops.model("basic", "-ndm", 3, "-ndf", 6)
    used = sorted({n for nodes, _ in deck.elements.values() for n in nodes[:2]})
    for n in used:
        ops.node(n, *map(float, deck.nodes[n]))
    for n in sorted({n for n, _ in deck.held}):
        ops.fix(n, *[int((n, i) in deck.held) for i in range(6)])
    turned = {}
    for number, (nodes, now) in deck.elements.items():
        kind = deck.kinds[now["type"]]
        if kind == "BEAM188" and deck.keys[now["type"], 3] == 3:
            turned[number] = add_beam(deck, number, nodes, now)
        elif kind == "MATRIX27" and deck.keys[now["type"], 3] == 4:
            k = full(deck.constants[now["real"]])
            add_matrix(number, nodes, k)
        else:
            raise SystemExit(f"element {number} is a {kind}")
    return used, turned


def add_beam(deck, number, nodes, now):
    own = axes(deck, nodes)
    young, shear = (deck.material[name, now["mat"]] for name in ("EX", "GXY"))
    radius = deck.radius[now["sec"]]
    area, inertia = np.pi * radius**2, np.pi * radius**4 / 4
    shear_z, shear_y = (s / shear for s in deck.shear[now["sec"]])
    # OpenSees: vecxz lies in the plane of x and z.
    ops.geomTransf("Linear", number, *map(float, own[2]))
    ops.element(
        "ElasticTimoshenkoBeam", number, *nodes[:2], young, shear, area, 2 * inertia, inertia,
        inertia, shear_y, shear_z, number,
    )
    return own


def add_matrix(number, nodes, k):
    """A stiffness of twelve between two nodes, split into what stands between them.

    OpenSees has no element for any matrix in three dimensions. A joint of arms and springs is
    known by its matrix: its blocks are those of springs D at a point of touch that is found
    from them, and the matrix that these give must be the one that was read.
    """
    over, under = (np.array(ops.nodeCoord(n)) for n in nodes)
    push = k[0, 0]
    # In the blocks of the over node the arm r stands as push (r x).
    arms = []
    for block, place in ((k[0:3, 3:6], over), (k[6:9, 9:12], under)):
        skew = -block / push
        arms.append(place + np.array([skew[2, 1], skew[0, 2], skew[1, 0]]))
    touch = (arms[0] + arms[1]) / 2
    r = touch - over
    cross = np.array([[0, -r[2], r[1]], [r[2], 0, -r[0]], [-r[1], r[0], 0]])
    turn = k[3:6, 3:6] - push * cross.T @ cross
    values, vectors = np.linalg.eigh((turn + turn.T) / 2)
    strain = np.zeros((6, 12))
    for side, (place, sign) in enumerate(((over, 1.0), (under, -1.0))):
        r = touch - place
        cross = np.array([[0, -r[2], r[1]], [r[2], 0, -r[0]], [-r[1], r[0], 0]])
        strain[:3, 6 * side : 6 * side + 3] = sign * np.eye(3)
        strain[:3, 6 * side + 3 : 6 * side + 6] = -sign * cross
        strain[3:, 6 * side + 3 : 6 * side + 6] = sign * np.eye(3)
    springs = np.zeros((6, 6))
    springs[:3, :3] = push * np.eye(3)
    springs[3:, 3:] = turn
    made = strain.T @ springs @ strain
    if np.abs(made - k).max() > 1e-9 * np.abs(k).max():
        raise SystemExit(f"the matrix of element {number} is no joint of arms and springs")
    base = 10_000_000 + 10 * number
    for tip, node in ((base, nodes[0]), (base + 1, nodes[1])):
        ops.node(tip, *map(float, touch))
        ops.rigidLink("beam", node, tip)
    # What rounding leaves of a free turn is none.
    stiff = [push] * 3 + [v if v > 1e-9 * values.max() else 0.0 for v in values]
    directions = [i + 1 for i, s in enumerate(stiff) if s > 0]
    for i in directions:
        ops.uniaxialMaterial("Elastic", base + i, float(stiff[i - 1]))
    x, y = vectors[:, 0], vectors[:, 1]
    ops.element(
        "zeroLength", number, base + 1, base, "-mat", *[base + i for i in directions], "-dir",
        *directions, "-orient", *map(float, x), *map(float, y),
    )


def solve(deck, forces, pressures):
    used, turned = build(deck)
    ops.timeSeries("Constant", 1)
    ops.pattern("Plain", 1, 1)
    loads = defaultdict(lambda: np.zeros(6))
    for (node, i), value in forces.items():
        loads[node][i] = value
    for node, six in loads.items():
        ops.load(node, *map(float, six))
    for number in turned:
        z, y, x = (pressures.get((number, face), 0.0) for face in (1, 2, 3))
        ops.eleLoad("-ele", number, "-type", "-beamUniform", -y, -z, x)
    run()
    ops.reactions()
    return used


def compare(folder):
    """Prints a line a case; whether all is the same."""
    document = json.loads((Path(folder) / "statics.json").read_text())
    deck = Deck((Path(folder) / "model.mac").read_text())
    model = document["model"]
    names = {b["rod"] for b in model["beams"]} | {j["contact"] for j in model["joints"]}
    good = names == set(deck.components) and len(deck.cases) == len(document["cases"]) > 0
    if not good:
        print(f"{folder}: components or cases are not those of statics.json")
    for rod in names:
        numbers = [i + 1 for i, b in enumerate(model["beams"]) if b["rod"] == rod]
        numbers += [len(model["beams"]) + i + 1 for i, j in enumerate(model["joints"]) if j["contact"] == rod]
        good = good and list(deck.components.get(rod, [])) == numbers
    for case, (forces, pressures) in zip(document["cases"], deck.cases):
        solve(deck, forces, pressures)
        ours = np.array(case["displacements"])
        theirs = np.array([ops.nodeDisp(i + 1) for i in range(len(ours))])
        moved = np.abs(ours - theirs)[:, :3].max() / np.abs(ours[:, :3]).max()
        turned = np.abs(ours - theirs)[:, 3:].max() / np.abs(ours[:, 3:]).max()
        wanted = np.array([r["force"] for r in case["reactions"]])
        found = np.array([ops.nodeReaction(r["node"] + 1)[:3] for r in case["reactions"]])
        held = np.array([f["held"][:3] for f in model["feet"]])
        off = np.abs(np.where(held, found, 0) - wanted).max() / np.abs(wanted).sum()
        same = bool(max(moved, turned, off) <= SAME)
        print(f"{folder} {case['name']}: moved {moved:.1e}  turned {turned:.1e}  reactions {off:.1e}" + ("" if same else "  NOT THE SAME"))
        good = good and same
    return good


if __name__ == "__main__":
    if len(sys.argv) < 2:
        raise SystemExit(__doc__)
    sys.exit(0 if all([compare(folder) for folder in sys.argv[1:]]) else 1)
