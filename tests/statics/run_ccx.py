#!/usr/bin/env python3
"""Runs CalculiX on OUT/model.inp and compares with OUT/statics.json.

    run_ccx.py OUT [...]

CalculiX makes a solid of each beam: 20-node elements with eight nodes round the circle and
reduced integration. Such a solid is softer than the circle in bending and torsion. A cantilever
of 100 mm and 3 mm across with a force at its tip bends, against beam theory, by

    elements    1      2      4      8      16     32
    pine      -12 %  +1.3 % +2.3 % +2.4 % +2.4 % +2.4 %

and two rods that cross, with any kind of contact, by +2.3 %. The igloo of the samples, tied, with
1, 2 and 3 elements a piece comes to 0.920, 1.018 and 1.022 times the displacements of statics.json;
the same notched, of steel, with 2, 3 and 4 to 0.939, 1.006 and 1.017. So the displacements of the
deck, with 4, must be those of statics.json times one factor between 1.01 and 1.03, and reactions,
which hardly ask how soft rods are, the same. Contacts add nothing to the difference: they are as
stiff as in statics.json.

Needs `ccx` (Debian: calculix-ccx, tried with 2.20) and pip install numpy. One line of figures a
case; exit status 1 where one is beyond its bound.
"""
import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

SOFTER = (1.010, 1.030)
# What is left when the factor is taken off, by the largest displacement.
LEFT = 0.005
# By the whole load; moments by that times the longest side.
REACTIONS = 0.003
# The stiffest springs cost CalculiX digits: 1e-7 on a dome, 1.5e-4 on a flat frame of zigzags.
BALANCE = 5e-4


def run(deck):
    """The text of the .dat file."""
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "model.inp").write_text(deck)
        done = subprocess.run(["ccx", "-i", "model"], cwd=folder, capture_output=True, text=True)
        said = [l for l in done.stdout.splitlines() if "*ERROR" in l or "*WARNING" in l]
        data = Path(folder) / "model.dat"
        if done.returncode != 0 or said or not data.exists():
            raise SystemExit("ccx did not run:\n" + "\n".join(said or done.stdout.splitlines()[-5:]))
        return data.read_text()


def blocks(data):
    """What is printed: kind, set, and node -> three numbers, in order."""
    found = []
    for line in data.splitlines():
        head = re.match(r"\s*(displacements|forces) .* for set (\w+)", line)
        if head:
            found.append((head[1], head[2], {}))
        elif re.match(r"\s*total force", line):
            found.append(("total", "", {}))
        elif re.match(r"\s+\d+\s", line) and found[-1][0] != "total":
            fields = line.split()
            found[-1][2][int(fields[0])] = [float(x) for x in fields[1:4]]
    return [b for b in found if b[0] != "total"]


def members(deck, name):
    """The nodes of a set that stands one a line."""
    lines = deck.splitlines()
    try:
        at = lines.index(f"*NSET, NSET={name}") + 1
    except ValueError:
        return []
    found = []
    while re.fullmatch(r"\d+", lines[at]):
        found.append(int(lines[at]))
        at += 1
    return found


def vectors(printed, nodes):
    return np.array([printed[n] for n in nodes]).reshape(-1, 3)


def compare_case(document, case, printed, feet, turns):
    model = document["model"]
    ours = np.array(case["displacements"])[:, :3]
    theirs = vectors(printed[("displacements", "NODES")], range(1, len(ours) + 1))
    factor = float((ours * theirs).sum() / (ours**2).sum())
    largest = np.linalg.norm(ours, axis=1).max()
    left = float(np.linalg.norm(theirs - factor * ours, axis=1).max() / largest)
    nodes = np.array(model["nodes"])
    lengths = [np.linalg.norm(nodes[b["nodes"][1]] - nodes[b["nodes"][0]]) for b in model["beams"]]
    along = sum(np.linalg.norm(q) * l for q, l in zip(case["beam_loads"], lengths))
    size = along + sum(np.linalg.norm(l["force"]) for l in case["node_loads"])
    wanted = np.array([r["force"] for r in case["reactions"]])
    found = vectors(printed[("forces", "FEET")], feet)
    figures = [
        ("factor", factor, SOFTER[0] <= factor <= SOFTER[1]),
        ("left", left, left <= LEFT),
    ]
    off = float(np.abs(found - wanted).max() / size)
    figures.append(("reactions", off, off <= REACTIONS))
    off = float(np.linalg.norm((found - wanted).sum(axis=0)) / size)
    figures.append(("balance", off, off <= BALANCE))
    if turns:
        fixed = [i for i, f in enumerate(model["feet"]) if any(f["held"][3:])]
        wanted = np.array([case["reactions"][i]["moment"] for i in fixed])
        found = vectors(printed[("forces", "TURNS")], turns)
        off = float(np.abs(found - wanted).max() / (size * np.ptp(nodes, axis=0).max()))
        figures.append(("moments", off, off <= REACTIONS))
    return figures


def compare(folder):
    """Prints a line a case; whether all is as known."""
    document = json.loads((Path(folder) / "statics.json").read_text())
    deck = (Path(folder) / "model.inp").read_text()
    feet, turns = members(deck, "FEET"), members(deck, "TURNS")
    printed = blocks(run(deck))
    each = 3 if turns else 2
    if not document["cases"] or len(printed) != each * len(document["cases"]):
        raise SystemExit(f"{folder}: {len(printed)} tables for {len(document['cases'])} cases")
    good = True
    for i, case in enumerate(document["cases"]):
        tables = {(kind, name): rows for kind, name, rows in printed[each * i : each * (i + 1)]}
        figures = compare_case(document, case, tables, feet, turns)
        beyond = [name for name, _, fits in figures if not fits]
        line = "  ".join(f"{name} {figure:.3g}" for name, figure, _ in figures)
        print(f"{folder} {case['name']}: {line}" + (f"  BEYOND: {', '.join(beyond)}" if beyond else ""))
        good = good and not beyond
    return good


if __name__ == "__main__":
    if len(sys.argv) < 2:
        raise SystemExit(__doc__)
    sys.exit(0 if all([compare(folder) for folder in sys.argv[1:]]) else 1)
