#!/usr/bin/env python3
"""Solves the frame of a statics.json again in OpenSees and compares.

    compare.py STATICS.JSON [...]

Of the file only the model and the loads are used: nodes, diameters, moduli, springs of the
contacts, feet. Displacements are compared with the largest one, reactions and the forces in
beams and contacts with the whole load, stresses with the largest of the case. One line of
figures a case; exit status 1 where one is beyond its bound.

pip install openseespy==3.7.1.2 numpy
"""
import json
import sys

import numpy as np

from frame_in_opensees import Beam, Frame, Joint, Load, beam_axes, circle, solve

# Contacts are 1000 times as stiff as rods, which costs OpenSees some digits.
SAME = 1e-8
# Forces in the springs of contacts come of small differences in OpenSees.
SAME_IN_CONTACTS = 1e-6
BALANCE = 1e-9
# Largest stresses are looked for at places of each program's own.
SAME_STRESS = 1e-3
PLACES = 64


def frame_of(document):
    settings, model = document["settings"], document["model"]
    poisson = settings["poisson"]
    beams = [Beam(tuple(b["nodes"]), *circle(b["diameter"], poisson)) for b in model["beams"]]
    joints = [
        Joint(tuple(j["nodes"]), np.array(j["touch"]), np.array(j["axis"]), j["push"], j["twist"], j["rock"])
        for j in model["joints"]
    ]
    feet = [(f["node"], f["held"]) for f in model["feet"]]
    return Frame(settings["young_mpa"], settings["shear_mpa"], np.array(model["nodes"]), beams, joints, feet)


def load_of(case):
    nodes = [(l["node"], l["force"] + l["moment"]) for l in case["node_loads"]]
    return Load(nodes, [np.array(q) for q in case["beam_loads"]])


def size_of_load(frame, load):
    """Sum of the sizes of all forces, and their vector sum."""
    forces = [np.array(six[:3]) for _, six in load.nodes]
    for beam, q in zip(frame.beams, load.beams):
        a, b = beam.nodes
        forces.append(q * np.linalg.norm(frame.nodes[b] - frame.nodes[a]))
    return sum(np.linalg.norm(f) for f in forces), np.sum(forces, axis=0)


def plain(ends):
    """What does not depend on the axes across a beam: N, V, T, M at both ends."""
    e = np.asarray(ends).reshape(-1, 2, 6)
    return np.stack(
        [e[..., 0], np.hypot(e[..., 1], e[..., 2]), e[..., 3], np.hypot(e[..., 4], e[..., 5])], axis=-1
    )


def largest_stress(frame, diameters, load, answer):
    """|N|/A + M/W and T/2W + 4V/3A by von Mises, the largest along each beam."""
    found = []
    for beam, d, q, ends in zip(frame.beams, diameters, load.beams, answer.beam_ends):
        a, b = beam.nodes
        along = frame.nodes[b] - frame.nodes[a]
        own = beam_axes(along)[0] @ q
        s = np.linspace(0, np.linalg.norm(along), PLACES + 1)[:, None]
        force = -ends[:3] - own * s
        arm = np.hstack([s, 0 * s, 0 * s])
        moment = -ends[3:6] + np.cross(arm, ends[:3]) + np.cross(arm / 2, own * s)
        area, modulus = np.pi * d**2 / 4, np.pi * d**3 / 32
        sigma = np.abs(force[:, 0]) / area + np.hypot(moment[:, 1], moment[:, 2]) / modulus
        tau = np.abs(moment[:, 0]) / (2 * modulus) + 4 * np.hypot(force[:, 1], force[:, 2]) / (3 * area)
        found.append(np.sqrt(sigma**2 + 3 * tau**2).max())
    return np.array(found)


def off(ours, theirs, size):
    ours, theirs = np.asarray(ours, float), np.asarray(theirs, float)
    if ours.shape != theirs.shape:
        raise SystemExit(f"{ours.shape} figures are not {theirs.shape}")
    return float(np.abs(ours - theirs).max(initial=0.0) / size)


def compare_case(document, frame, case):
    """Name and figure and bound of everything compared."""
    load = load_of(case)
    answer = solve(frame, load)
    size, total = size_of_load(frame, load)
    longest = np.ptp(frame.nodes, axis=0).max()
    moved = np.array(case["displacements"])
    reactions = np.array([r["force"] + r["moment"] for r in case["reactions"]]).reshape(-1, 6)
    held = np.array([f["held"] for f in document["model"]["feet"]])
    theirs = np.where(held, answer.reactions, 0.0)
    forces = np.array([c["force"] for c in case["contacts"]]).reshape(-1, 3)
    moments = np.array([c["moment"] for c in case["contacts"]]).reshape(-1, 3)
    ends, their_ends = plain(case["beam_ends"]), plain(answer.beam_ends)
    names = [b["rod"] for b in document["model"]["beams"]]
    diameters = [b["diameter"] for b in document["model"]["beams"]]
    peaks = {}
    for name, peak in zip(names, largest_stress(frame, diameters, load, answer)):
        peaks[name] = max(peak, peaks.get(name, 0.0))
    stress = [r["stress_mpa"] for r in case["rods"]]
    return [
        ("moved", off(moved[:, :3], answer.moved[:, :3], np.abs(moved[:, :3]).max()), SAME),
        ("turned", off(moved[:, 3:], answer.moved[:, 3:], np.abs(moved[:, 3:]).max()), SAME),
        ("reactions", off(reactions[:, :3], theirs[:, :3], size), SAME),
        ("moments", off(reactions[:, 3:], theirs[:, 3:], size * longest), SAME),
        ("balance", float(np.linalg.norm(reactions[:, :3].sum(axis=0) + total) / size), BALANCE),
        ("in beams", off(ends[..., :2], their_ends[..., :2], size), SAME),
        ("their moments", off(ends[..., 2:], their_ends[..., 2:], size * longest), SAME),
        ("in contacts", off(forces, answer.contacts[:, :3], size), SAME_IN_CONTACTS),
        ("their moments", off(moments, answer.contacts[:, 3:], size * longest), SAME_IN_CONTACTS),
        ("stress", off(stress, [peaks[r["rod"]] for r in case["rods"]], max(stress)), SAME_STRESS),
    ]


def compare(path):
    """Prints a line a case; whether all is the same."""
    with open(path) as file:
        document = json.load(file)
    if (document["format"], document["version"]) != ("rodwright-statics", 1):
        raise SystemExit(f"{path} is no statics.json, version 1")
    frame = frame_of(document)
    same = bool(document["cases"])
    for case in document["cases"]:
        figures = compare_case(document, frame, case)
        beyond = [name for name, figure, bound in figures if not figure <= bound]
        line = "  ".join(f"{name} {figure:.1e}" for name, figure, _ in figures)
        print(f"{path} {case['name']}: {line}" + (f"  NOT THE SAME: {', '.join(beyond)}" if beyond else ""))
        same = same and not beyond
    return same


if __name__ == "__main__":
    if len(sys.argv) < 2:
        raise SystemExit(__doc__)
    sys.exit(0 if all([compare(path) for path in sys.argv[1:]]) else 1)
